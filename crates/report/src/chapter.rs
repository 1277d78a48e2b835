//! What a chapter of the report is: findings, tables, plots, and the raw figures they were made from.

use std::fmt;

use anyhow::{Context, Result};
use serde::Serialize;

/// A chapter.
#[derive(Clone, Debug)]
pub struct Chapter {
    /// Its heading.
    pub title: String,
    /// What is asked, what was compared and how, in Markdown.
    pub opening: String,
    /// What was found, a sentence each, made from the figures.
    pub findings: Vec<String>,
    /// Tables and plots, in the order they are shown in.
    pub parts: Vec<Part>,
    /// The raw figures.
    pub raw: Vec<Raw>,
}

/// A table or a plot.
#[derive(Clone, Debug)]
pub enum Part {
    /// A table.
    Table(Table),
    /// A plot.
    Plot(Plot),
}

/// A table.
#[derive(Clone, Debug)]
pub struct Table {
    /// What it shows, in Markdown.
    pub caption: String,
    /// The heads of its columns.
    pub columns: Vec<String>,
    /// Its lines, a cell for each column.
    pub lines: Vec<Vec<String>>,
}

/// A plot of points and lines, both axes linear or logarithmic.
#[derive(Clone, Debug)]
pub struct Plot {
    /// The name of its files, without an extension.
    pub name: String,
    /// What it shows, in a line.
    pub title: String,
    /// What a reader should see in it, in Markdown, beneath it.
    pub caption: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is compared.
    pub series: Vec<Series>,
    /// Whether the Pareto front of all points of all series is drawn: least x, least y.
    pub front: bool,
}

/// An axis of a plot.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What it measures, with the unit.
    pub label: String,
    /// Whether it is logarithmic; values that are not positive are then drawn at the edge.
    pub logarithmic: bool,
}

impl Axis {
    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: true }
    }

    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), logarithmic: false }
    }
}

/// Points of a plot that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// The points, in the order of the line.
    pub points: Vec<Point>,
    /// Whether a line joins them.
    pub joined: bool,
}

/// A point of a plot.
#[derive(Clone, Debug)]
pub struct Point {
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// What is written beside it, if anything.
    pub label: Option<String>,
}

/// Raw figures: a list of flat records that have the same fields.
#[derive(Clone, Debug)]
pub struct Raw {
    /// The name of its files, without an extension.
    pub name: String,
    /// The records.
    pub records: Vec<serde_json::Map<String, serde_json::Value>>,
}

impl Raw {
    /// Of records that are flat structures.
    ///
    /// # Errors
    ///
    /// Where they are not.
    pub fn new<T: Serialize>(name: &str, records: &[T]) -> Result<Self> {
        let record = |record: &T| match serde_json::to_value(record) {
            Ok(serde_json::Value::Object(record)) => Ok(record),
            Ok(other) => anyhow::bail!("'{other}' is no record"),
            Err(error) => Err(error).context("a record cannot be put in words"),
        };
        let records = records.iter().map(record).collect::<Result<_>>()?;
        Ok(Self { name: name.to_owned(), records })
    }
}

/// A number as the report writes it: three digits, exponents where they are short.
#[derive(Clone, Copy, Debug)]
pub struct Figure(pub f64);

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        let size = value.abs();
        if value == 0.0 || !value.is_finite() {
            write!(f, "{value}")
        } else if !(1e-3..1e6).contains(&size) {
            write!(f, "{value:.1e}")
        } else {
            let digits = (2 - size.log10().floor() as i32).max(0) as usize;
            write!(f, "{value:.digits$}")
        }
    }
}

/// A part of something in percent, as the report writes it.
#[must_use]
pub fn percent(part: f64) -> String {
    format!("{} %", Figure(100.0 * part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        let written = [0.0, 1.0, 0.012_345, 123.456, 98_765.4, 1.5e-7, 2.5e9, -3.25, f64::INFINITY];
        let written = written.map(|value| Figure(value).to_string());
        assert_eq!(written, ["0", "1.00", "0.0123", "123", "98765", "1.5e-7", "2.5e9", "-3.25", "inf"]);
    }

    #[test]
    fn records_are_flat() {
        #[derive(Serialize)]
        struct Record {
            name: &'static str,
            time: f64,
        }
        let raw = Raw::new("times", &[Record { name: "f32", time: 1.5 }]).expect("it is flat");
        assert_eq!(raw.records[0]["time"], 1.5);
        assert_eq!(raw.records[0]["name"], "f32");
        assert!(Raw::new("numbers", &[1.5]).is_err());
    }
}
