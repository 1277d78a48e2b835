//! What the tests, the fuzz targets and the report share.
//!
//! - [`arbitrary`]: views, lights and scenes at random, with more than their share of the hard cases.
//! - [`outdoors`]: a town, and views and lights in it at random.
//! - [`claims`]: what must hold of any case.
//! - [`oracle`]: the exact focus body.
//! - [`stability`]: what arithmetic costs in the hard cases, as tables.

#![allow(
    clippy::disallowed_methods,
    reason = "the fitting path needs the same bits on every platform; cases and references do not"
)]
#![allow(missing_docs, reason = "not published: what a name says is not said again")]

pub mod arbitrary;
pub mod claims;
pub mod oracle;
pub mod outdoors;
pub mod stability;
