//! The check itself, on small crates.

use std::path::Path;

use crate::circles::circles;
use crate::source::parse;

/// The circles of a crate of these files.
fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    let read =
        |path: &Path| files.iter().find(|(name, _)| Path::new(name) == path).map(|(_, text)| (*text).to_owned());
    circles(&parse(Path::new("src/lib.rs"), &read))
}

#[test]
fn a_circle_is_found_through_a_re_export() {
    let found = circles_of(&[
        ("src/lib.rs", "mod a; mod b; mod c; pub use c::{C as D};"),
        ("src/a.rs", "use super::b::B;\npub struct A(B);"),
        ("src/b/mod.rs", "mod inner;\npub struct B;"),
        ("src/b/inner.rs", "fn f() {\n    assert!(crate::D::new().is_some());\n}"),
        ("src/c.rs", "pub struct C;\nimpl C { fn new() -> Option<crate::a::A> { None } }"),
    ]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("3 modules"), "{}", found[0]);
    for text in ["src/a.rs:1: super::b::B", "src/b/inner.rs:2: crate::D::new", "src/c.rs:2: crate::a::A"] {
        assert!(found[0].contains(text), "{text} is not in {}", found[0]);
    }
}

#[test]
fn a_circle_is_found_in_a_folder_and_by_names_of_modules() {
    let found = circles_of(&[(
        "src/lib.rs",
        "mod a { pub mod b { use super::c; fn f() { c::g(); } }\n pub mod c { pub fn g() { super::b::f() } } }",
    )]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("crate::a::b uses crate::a::c"), "{}", found[0]);
}

#[test]
fn a_glob_is_a_use() {
    let found = circles_of(&[(
        "src/lib.rs",
        "mod a { pub use super::b::*; pub struct A; }\n mod b { type B = super::a::A; }",
    )]);
    assert_eq!(found.len(), 1, "{found:?}");
}

#[test]
fn parents_and_unit_tests_are_left_out() {
    let found = circles_of(&[
        ("src/lib.rs", "mod a; mod b; pub struct Root;"),
        ("src/a.rs", "use crate::Root;\nuse crate::b::B;\npub struct A(B);"),
        (
            "src/b.rs",
            "pub struct B(super::Root, other::a::A);\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n#[cfg(test)]\nuse crate::a::A;",
        ),
    ]);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
#[should_panic(expected = "`mod a` has a `#[path]`")]
fn a_path_is_refused() {
    circles_of(&[("src/lib.rs", "#[path = \"other.rs\"] mod a;")]);
}
