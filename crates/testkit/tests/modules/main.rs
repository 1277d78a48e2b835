//! No modules of any crate use each other in a circle, so that each can be read with no more than what it stands on.
//!
//! Compared are the modules beside each other: of every module, its child modules with all that is in them. One uses another where
//! a `use`, a path in an expression, a type or a pattern names something that the other defines; a re-export counts as a use of the
//! module that defines the item. What is compiled for unit tests alone (`#[cfg(test)]`) is left out, and so is what a module uses
//! of the modules it is in.
//!
//! - `source`: the modules of a crate, parsed.
//! - `names`: which module defines what a path names.
//! - `circles`: modules that use each other in a circle.
//! - `checks`: the check itself, on small crates.

mod checks;
mod circles;
mod names;
mod source;

use cargo_metadata::MetadataCommand;
use std::path::Path;

#[test]
fn no_modules_form_a_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = Vec::new();
    let mut targets = 0;
    // Fuzzing has a workspace of its own.
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml"] {
        let metadata =
            MetadataCommand::new().manifest_path(root.join(manifest)).no_deps().exec().expect("a workspace");
        for target in metadata.packages.iter().flat_map(|package| &package.targets) {
            let krate = source::parse(target.src_path.as_std_path(), &|path| std::fs::read_to_string(path).ok());
            found.extend(circles::circles(&krate));
            targets += 1;
        }
    }
    assert!(targets > 30, "only {targets} targets were found");
    assert!(found.is_empty(), "{}", found.join("\n"));
}
