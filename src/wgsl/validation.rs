//! What must hold of every text.

extern crate std;

use naga::Module;
use naga::front::wgsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// The module that a valid text is.
pub(super) fn validated(source: &str) -> Module {
    let module = wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let result = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    assert!(result.is_ok(), "{}", result.unwrap_err().emit_to_string(source));
    module
}

/// Functions and types with names of the crate's own, and nothing else.
pub(super) fn assert_adds_only_its_own_names(module: &Module) {
    assert!(module.global_variables.is_empty() && module.entry_points.is_empty());
    let functions = module.functions.iter().filter_map(|(_, function)| function.name.as_ref());
    let types = module.types.iter().filter_map(|(_, of)| of.name.as_ref());
    assert!(functions.chain(types).all(|name| name.starts_with("shadowfit_")));
}
