//! Tables of errors: what f32 and f64 make of hard cases, in the textbook's constructions and in this crate's.
//!
//! - `arithmetic`, `linear`: f32, f64 and 512 bits; vectors and matrices of them.
//! - `setup`: a camera, a light and a box as plain numbers.
//! - `textbook`, `ours`: the two constructions, ours in exact numbers.
//! - `measure`, `bodies`: errors of matrices, and of bodies.
//! - `lights`, `views`, `solids`: the tables.

#![allow(clippy::disallowed_methods, reason = "angles and powers make the sweeps, they are no part of a fit")]

pub mod arithmetic;
pub mod bodies;
pub mod lights;
pub mod linear;
pub mod measure;
pub mod ours;
pub mod setup;
pub mod solids;
pub mod textbook;
pub mod views;

/// A table.
pub struct Table {
    /// What is swept and what is measured.
    pub heading: String,
    pub columns: Vec<&'static str>,
    pub lines: Vec<Vec<String>>,
    /// What the crate answers for: errors of ours, and their bounds.
    pub held: Vec<Held>,
}

/// An error that may be no larger than its bound.
#[derive(Debug)]
pub struct Held {
    pub line: String,
    pub error: f64,
    pub bound: f64,
}

impl Table {
    fn new(heading: &str, columns: &[&'static str]) -> Self {
        Self { heading: heading.into(), columns: columns.to_vec(), lines: Vec::new(), held: Vec::new() }
    }

    fn hold(&mut self, line: &str, error: f64, bound: f64) {
        self.held.push(Held { line: line.into(), error, bound });
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "{}", self.heading)?;
        let width = |column: usize| {
            let cells = self.lines.iter().map(|line| line[column].chars().count());
            cells.chain([self.columns[column].chars().count()]).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let heads = self.columns.iter().map(|head| (*head).to_string()).collect();
        for line in std::iter::once(&heads).chain(&self.lines) {
            for (cell, width) in line.iter().zip(&widths) {
                write!(f, "  {cell:>width$}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

/// The rows of the list of hard cases that a table shows, and what makes it.
type Entry = (&'static [u32], fn() -> Table);

/// All tables, in the order of the list.
pub const ALL: [Entry; 15] = [
    (&[1, 2, 3], lights::through_the_camera_plane),
    (&[5], lights::lamp_through_the_camera_plane),
    (&[6, 11], lights::on_the_infinity_plane),
    (&[7, 8], lights::along_the_view),
    (&[9, 10], lights::caster_through_the_camera_plane),
    (&[15], lights::lamp_far_away),
    (&[18, 19], solids::flat_scenes),
    (&[20], solids::planes_that_touch),
    (&[21], solids::narrow_views),
    (&[24, 25], solids::scales),
    (&[25, 29], views::far_from_the_origin),
    (&[26], views::one_camera_in_every_convention),
    (&[27], views::far_planes),
    (&[28], views::fields_of_view),
    (&[29], views::positions_in_f32),
];
