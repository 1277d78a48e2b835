//! What hard cases cost, as tables: the textbook's constructions in f32 and f64 beside this crate's.
//!
//! `cargo run --release -p testkit --bin stability` prints all tables, `-- 2 25` those for some rows of the list of hard cases.

use testkit::stability::ALL;

const METHOD: &str = "\
Errors are those of the matrix itself, against the same formulas in numbers of 512 bits: the largest difference of x, y or
z after the division by w, in parts of the clip volume (x and y of 2, z of 1), over the corners of what is visible and
points between them. Each construction is measured against itself; all begin with the same numbers, which f32 holds.

textbook         transform the light by the camera's matrix, divide by w, look from there at the middle of the unit cube,
                 fit a frustum to the cube, multiply (Stamminger & Drettakis 2002, section 3.2)
ours f32 upload  what a renderer gets: our f64 matrix, rounded once
NaN              the matrix is none
wrapped          points of what is visible with w <= 0
out of order     casters that come out behind their receivers, of two for each point

Of bodies: what is lost of the exact focus body (hull of view and light, in the scene), and how far beyond it a construction
reaches, in parts of the scene's size. Naive: a vertex for every three planes, kept if it is no farther than 1e-6 outside of
any other.
";

fn main() {
    let asked: Vec<u32> = std::env::args().skip(1).filter_map(|row| row.parse().ok()).collect();
    println!("{METHOD}");
    for (rows, table) in ALL {
        if asked.is_empty() || rows.iter().any(|row| asked.contains(row)) {
            let numbers: Vec<String> = rows.iter().map(u32::to_string).collect();
            println!("[{}] {}", numbers.join(", "), table());
        }
    }
}
