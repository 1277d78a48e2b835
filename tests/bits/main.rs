//! The same bits everywhere: what a stored table says of three hundred set-ups holds under every profile, feature set and
//! target, and with every version of glam that is accepted.
//!
//! A change of any bit is a change that users see, and is stored on purpose: `cargo run -p bits
//! >tests/bits/table.txt`. How to make the same table on another target is in `target.sh` beside it.

use bits::table;

/// That a table is what it was, or else which set-up is not.
fn assert_same(stored: &str, found: &str) {
    let mut setup = "";
    for (number, (stored, found)) in (1..).zip(stored.lines().zip(found.lines())) {
        setup = if found.starts_with(|first: char| first.is_ascii_digit()) { found } else { setup };
        assert_eq!(stored, found, "line {number} of the table, set-up {setup}");
    }
    assert_eq!(stored.lines().count(), found.lines().count(), "lines of the table");
}

#[test]
fn results_have_the_same_bits_everywhere() {
    assert_same(include_str!("table.txt"), &table::table(false));
}

/// `SHADOWFIT_STORE=1 cargo test --test bits` stores a change of these, and the next run compares with it.
#[cfg(feature = "alloc")]
#[test]
fn plans_have_the_same_bits_everywhere() {
    let found = bits::plans::plans();
    if std::env::var_os("SHADOWFIT_STORE").is_some() {
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bits/plans.txt"), &found).expect("written");
    }
    assert_same(include_str!("plans.txt"), &found);
}

/// The table shows something only where there is something to see.
#[test]
fn set_ups_come_to_every_kind_of_result() {
    let table = table::table(false);
    let count = |start: &str| table.lines().filter(|line| line.starts_with(start)).count();
    assert!(count("matrices") >= 150, "{} maps", count("matrices"));
    assert!(count("paraboloid 2") >= 20, "{} pairs of paraboloid maps", count("paraboloid 2"));
    assert!(count("Surrounded") >= 20, "{} lights among all", count("Surrounded"));
    assert!(
        count("NoCasters") + count("NoReceivers") >= 5,
        "{} maps not needed",
        count("NoCasters") + count("NoReceivers")
    );
}
