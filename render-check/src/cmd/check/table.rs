//! The table that a check prints: a row for each technique and size.

use std::fmt;

use comfy_table::Table;

use crate::maps::NoMap;
use crate::output::table;
use crate::output::table::{number, percent};
use crate::run::{MapRun, Options};
use crate::verdict::{Cluster, Fault};

/// The rows of one light.
pub(super) struct CheckTable {
    table: Table,
    /// Why there is no map, for rows without one.
    reasons: Vec<String>,
}

const COLUMNS: [&str; 14] = [
    "map",
    "passes",
    "drawn",
    "predicted",
    "limit",
    "aliasing",
    "missing",
    "false",
    "edge",
    "virtual",
    "worst",
    "fit",
    "map pass",
    "test",
];

impl CheckTable {
    /// A table without rows.
    #[must_use]
    pub(super) fn new() -> Self {
        Self { table: table::new(COLUMNS, 1..COLUMNS.len()), reasons: Vec::new() }
    }

    /// Adds a row for a light's maps.
    pub(super) fn add_maps(&mut self, options: &Options, run: &MapRun) {
        let counts = &run.verdict.counts;
        let share = |count: usize| percent(counts.fraction(count));
        let milliseconds = |time: Option<f64>| time.map_or_else(|| "-".into(), |ms| format!("{ms:.2} ms"));
        self.table.add_row([
            options.name(),
            run.depths.len().to_string(),
            format!("{:.0} %", 100.0 * run.drawn.triangles as f64 / run.drawn.of_triangles as f64),
            run.prediction.predicted.map_or_else(|| "-".into(), number),
            number(run.prediction.limit),
            run.verdict.aliasing.map_or_else(
                || "-".into(),
                |aliasing| format!("{}, {}", number(aliasing.worst), number(aliasing.median)),
            ),
            counts.missing.to_string(),
            format!("{}, {}", share(counts.false_shadow), share(counts.false_light)),
            share(counts.edges()),
            run.used_plane.map_or_else(|| "-".into(), percent),
            run.verdict.worst_cluster.as_ref().map_or_else(|| "-".into(), place),
            format!("{:.1} µs", run.times.fit_us),
            milliseconds(run.times.shadow_map_ms),
            milliseconds(run.times.shadow_test_ms),
        ]);
    }

    /// Adds a row for a light without a map.
    pub(super) fn add_no_map(&mut self, options: &Options, none: &NoMap) {
        let mut row = vec![options.name()];
        row.resize(COLUMNS.len(), "-".into());
        self.table.add_row(row);
        self.reasons.push(format!("{}: no map: {none}", options.name()));
    }
}

impl Default for CheckTable {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for CheckTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.table.fmt(f)?;
        self.reasons.iter().try_for_each(|reason| write!(f, "\n{reason}"))
    }
}

fn place(cluster: &Cluster) -> String {
    let fault = match cluster.fault {
        Fault::FalseShadow => "shadow",
        Fault::FalseLight => "light",
        Fault::Missing => "missing",
    };
    let [x, y] = cluster.centre;
    format!("{} {fault} at {x},{y}", cluster.pixels)
}
