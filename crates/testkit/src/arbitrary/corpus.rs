//! The inputs that fuzzing has kept, given again to what each target calls.

use std::path::Path;

/// Gives every input of a target's corpus to what the target calls.
///
/// `SHADOWFIT_INPUT=FILE` in the environment gives it that one instead, which shows the case of a crash.
///
/// # Panics
///
/// When the corpus is missing or empty, and as `check` does.
pub fn replay(target: &str, check: impl Fn(&[u8])) {
    if let Some(input) = std::env::var_os("SHADOWFIT_INPUT") {
        return check(&std::fs::read(input).expect("a readable input"));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut inputs: Vec<_> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    assert!(!inputs.is_empty(), "{} is empty", folder.display());
    inputs.sort();
    for input in &inputs {
        // So that a failure says which input it was.
        println!("{}", input.display());
        check(&std::fs::read(input).expect("a readable input"));
    }
    println!("{target}: {} inputs", inputs.len());
}
