//! The inputs of a comparison.

use super::rendered::Rendered;
use super::truth::TruthImage;
use crate::trace::Tracer;

/// The inputs needed to judge a pixel.
pub(super) struct Comparison<'a> {
    pub(super) truth: &'a TruthImage,
    pub(super) rendered: &'a Rendered<'a>,
    pub(super) tracer: &'a Tracer<'a>,
}
