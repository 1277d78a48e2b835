//! The chapter's tables.

use render_check::maps::ClipConvention;
use render_check::trace::Faces;

use super::Measured;
use super::cases::{CASCADES_OF_SAME_SIZE, CASCADES_OF_SAME_SUM, FILTERS, FORMATS, KINDS, TESTS, WARPS};
use super::record::{Contender, Record, Refused};
use super::summary::Mean;
use super::survey::SurveyRecord;
use crate::chapter::{Figure, Table, percent};

/// The columns of all tables of means, but for the first ones.
const COLUMNS: [&str; 9] = [
    "wrong pixels",
    "over the first line's",
    "no edge near",
    "worst aliasing, over the first line's",
    "over the limit",
    "fit, µs",
    "maps, ms",
    "test, ms",
    "time, over the first line's",
];

fn cells(mean: &Mean) -> Vec<String> {
    vec![
        percent(mean.wrong_share),
        Figure(mean.wrong_ratio).to_string(),
        percent(mean.false_share),
        Figure(mean.aliasing_ratio).to_string(),
        Figure(mean.over_limit).to_string(),
        Figure(mean.fit_us).to_string(),
        Figure(mean.map_ms).to_string(),
        Figure(mean.test_ms).to_string(),
        Figure(mean.time_ratio).to_string(),
    ]
}

/// The means of a comparison, with what varies in the first columns.
fn of_means(caption: String, heads: &[&str], means: &[Mean], names: impl Fn(&Contender) -> Vec<String>) -> Table {
    let line = |mean: &Mean| names(&mean.contender).into_iter().chain(cells(mean)).collect();
    Table {
        caption,
        columns: heads.iter().chain(&COLUMNS).map(|&head| head.to_owned()).collect(),
        lines: means.iter().map(line).collect(),
    }
}

/// What maps were fitted to, in words.
pub(super) const fn fitted_to(narrowed: bool) -> &'static str {
    if narrowed { "what is seen" } else { "all between the camera's planes" }
}

/// Over what the means of a comparison are.
fn shots(measured: &Measured, comparison: &str) -> String {
    let mut names: Vec<String> = Vec::new();
    for record in measured.records.iter().filter(|it| it.comparison == comparison) {
        let name = format!("{} `{}`", record.scene, record.light);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.join(", ")
}

fn name_and_size(contender: &Contender) -> Vec<String> {
    vec![contender.to_string(), format!("{}²", contender.size)]
}

/// All warps at one size, and all sizes and cascades, narrowed and not.
pub(super) fn of_warps(measured: &Measured) -> Vec<Table> {
    let table = |narrowed: bool| {
        let (fitted_to, shots) = (fitted_to(narrowed), shots(measured, WARPS));
        let caption = format!(
            "Warps, sizes and cascades, fitted to {fitted_to}. Means over {shots}. Sizes are those of each map."
        );
        of_means(caption, &["map", "size"], &measured.warps(narrowed), name_and_size)
    };
    [true, false].map(table).to_vec()
}

/// Random views.
pub(super) fn of_fits(measured: &Measured) -> Table {
    let columns = [
        "light",
        "view",
        "warp",
        "views",
        "no map at all",
        "fit, µs",
        "over the uniform fit",
        "worst aliasing over the uniform map's: 10 %",
        "median",
        "90 %",
        "coarser than uniform",
        "mean aliasing over the uniform map's: median",
        "worst over the limit: median",
        "90 %",
    ];
    let line = |it: &SurveyRecord| {
        vec![
            it.kind.to_owned(),
            if it.narrowed { "narrowed to the ground" } else { "whole" }.to_owned(),
            it.technique.to_string(),
            it.views.to_string(),
            it.without_map.to_string(),
            Figure(it.fit_us).to_string(),
            Figure(it.fit_ratio).to_string(),
            Figure(it.worst_10).to_string(),
            Figure(it.worst_50).to_string(),
            Figure(it.worst_90).to_string(),
            percent(it.coarser_share),
            Figure(it.mean_50).to_string(),
            Figure(it.over_limit_50).to_string(),
            Figure(it.over_limit_90).to_string(),
        ]
    };
    Table {
        caption: "Aliasing and fit time on random outdoor views. The limit is the least worst aliasing that any spread of the same \
                  texels could have."
            .to_owned(),
        columns: columns.map(str::to_owned).to_vec(),
        lines: measured.survey.iter().map(line).collect(),
    }
}

/// Cascades with as many texels in all, and each.
pub(super) fn of_cascades(measured: &Measured) -> Vec<Table> {
    let table = |comparison: &str, texels: &str, narrowed: bool| {
        let (fitted_to, shots) = (fitted_to(narrowed), shots(measured, comparison));
        let caption = format!(
            "One cascade to eight with as many texels {texels}, fitted to {fitted_to}. Means over {shots}."
        );
        of_means(caption, &["maps", "size of each"], &measured.means(comparison, narrowed), name_and_size)
    };
    let of = |narrowed| {
        [table(CASCADES_OF_SAME_SUM, "in all", narrowed), table(CASCADES_OF_SAME_SIZE, "each", narrowed)]
    };
    [true, false].map(of).concat()
}

/// Each kind of map of each lamp, and those that there are none of.
pub(super) fn of_kinds(measured: &Measured) -> Table {
    let columns = [
        "lamp",
        "maps",
        "size of each",
        "drawn",
        "triangles",
        "wrong pixels",
        "no edge near",
        "fit, µs",
        "maps, ms",
        "test, ms",
        "time, over the cube's",
    ];
    let drawn = |it: &Record| {
        vec![
            format!("{} `{}`", it.scene, it.light),
            it.contender.to_string(),
            format!("{}²", it.contender.size),
            it.passes.to_string(),
            it.triangles.to_string(),
            percent(it.wrong_share),
            percent(it.false_share()),
            Figure(it.fit_us).to_string(),
            Figure(it.map_ms).to_string(),
            Figure(it.test_ms).to_string(),
            Figure(it.time_ratio).to_string(),
        ]
    };
    let refused = |it: &Refused| {
        let known =
            [format!("{} `{}`", it.scene, it.light), it.contender.to_string(), format!("{}²", it.contender.size)];
        known.into_iter().chain(["none".to_owned()]).chain(vec!["–".to_owned(); columns.len() - 4]).collect()
    };
    let lines = measured.records.iter().filter(|it| it.comparison == KINDS).map(drawn);
    let without = measured.refused.iter().filter(|it| it.comparison == KINDS).map(refused);
    Table {
        caption: "Kinds of maps for a lamp among what it lights, fitted to what is seen. A light that needs no map on some side \
                  has none drawn there."
            .to_owned(),
        columns: columns.map(str::to_owned).to_vec(),
        lines: lines.chain(without).collect(),
    }
}

/// Depth formats, depth tests and filters.
pub(super) fn of_tests(measured: &Measured) -> Vec<Table> {
    let table = |comparison: &str, what: &str, head: &str, name: fn(&Contender) -> String| {
        let caption = format!(
            "{what}, in a map by the best matrix, {}², fitted to what is seen. Means over {}.",
            measured.middle_size,
            shots(measured, comparison)
        );
        of_means(caption, &[head], &measured.means(comparison, true), |contender| vec![name(contender)])
    };
    vec![
        table(FORMATS, "Depth formats", "format", format_name),
        table(TESTS, "Depth tests", "test", test_name),
        table(FILTERS, "Filters", "filter", |contender| contender.filter.to_string()),
    ]
}

/// A depth format in words.
pub(super) fn format_name(contender: &Contender) -> String {
    let reversed = if contender.clip == ClipConvention::WgpuReversed { ", reversed" } else { "" };
    format!("{}{reversed}", contender.format)
}

/// A depth test in words.
pub(super) fn test_name(contender: &Contender) -> String {
    let is_virtual = matches!(contender.filter, render_check::gpu::Filter::Virtual(_));
    let name = match (contender.faces, is_virtual) {
        (Faces::All, true) => "first depth, virtual samples",
        (Faces::All, false) if contender.biased => "first depth, derived bias",
        (Faces::All, false) => "first depth, no bias",
        (Faces::Second, true) => "second depth, virtual samples",
        (Faces::Second, false) => "second depth",
        (Faces::Layers, _) => "between two layers",
        (Faces::Front, _) => "front faces",
        (Faces::Back, _) => "back faces",
    };
    name.to_owned()
}
