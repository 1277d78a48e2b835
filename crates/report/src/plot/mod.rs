//! Plots as SVG and PNG.

mod scale;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use anyhow::{Result, anyhow};
use kuva::backend::raster::RasterBackend;
use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LabelStyle, LinePlot, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot as Drawn;
use kuva::render::render::{Primitive, Scene, render_multiple};
use kuva::render::theme::Theme;

use self::scale::Scale;
use crate::chapter::{Plot, Point};
use crate::front::front;

/// The width of a plot, in pixels.
const WIDTH: f64 = 960.0;
/// Pixels of a PNG for one of the SVG, along each side.
const PIXELS: f32 = 2.0;
/// How many letters of the title are in a line.
const TITLE: usize = 90;
/// How many letters of what the vertical axis measures are in a line.
const Y_LABEL: usize = 60;
/// How far a marker reaches from its middle, in pixels.
const REACH: f64 = 5.0;
/// The colour of the front.
const FRONT: &str = "#cfcfcf";

/// Okabe and Ito's colours, which the colour-blind can tell apart, the strong ones first, and grey for their yellow, which
/// is lost on white.
const COLOURS: [&str; 8] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"];

/// Seven shapes and eight colours have no common factor, so that 56 series differ.
const SHAPES: [MarkerShape; 7] = [
    MarkerShape::Circle,
    MarkerShape::Square,
    MarkerShape::Triangle,
    MarkerShape::Diamond,
    MarkerShape::TriangleDown,
    MarkerShape::Star,
    MarkerShape::Pentagon,
];

/// The plot as the text of an SVG.
#[must_use]
pub fn svg(plot: &Plot) -> String {
    SvgBackend::new().render_scene(&scene(plot))
}

/// The plot as the bytes of a PNG, with letters in DejaVu Sans.
///
/// # Errors
///
/// When it is too large.
pub fn png(plot: &Plot) -> Result<Vec<u8>> {
    let drawn = RasterBackend::new().with_scale(PIXELS).render_scene(&scene(plot));
    drawn.map_err(|error| anyhow!("the plot '{}' cannot be drawn: {error}", plot.name))
}

/// The plot, laid out.
fn scene(plot: &Plot) -> Scene {
    let axes = Axes::new(plot);
    let mut drawn = Vec::new();
    if plot.front {
        drawn.push(axes.front(plot));
    }
    for (index, series) in plot.series.iter().enumerate().filter(|(_, series)| series.joined) {
        // What is no number leaves a gap.
        for run in series.points.split(|point| axes.spot(point).is_none()) {
            let run = run.iter().filter_map(|point| axes.spot(point)).map(|spot| spot.at);
            drawn.push(LinePlot::new().with_data(run).with_color(colour(index)).into());
        }
    }
    for (index, series) in plot.series.iter().enumerate() {
        let spots: Vec<Spot> = series.points.iter().filter_map(|point| axes.spot(point)).collect();
        drawn.push(markers(&spots, index, colour(index), REACH));
        let open: Vec<Spot> = spots.into_iter().filter(|spot| spot.at_edge).collect();
        drawn.push(markers(&open, index, "white", 0.55 * REACH));
    }
    drawn.push(axes.labels(plot));
    let mut scene = render_multiple(drawn, axes.layout(plot));
    // Scales keep everything within the frame. What would cut it off there is numbered by how many plots were drawn
    // before, and the same plot shall be the same text.
    scene.defs.clear();
    scene.elements.retain(|element| !matches!(element, Primitive::ClipStart { .. } | Primitive::ClipEnd));
    scene
}

/// The colour of a series.
fn colour(series: usize) -> &'static str {
    COLOURS[series % COLOURS.len()]
}

/// The shape of a series.
fn shape(series: usize) -> MarkerShape {
    SHAPES[series % SHAPES.len()]
}

fn markers(spots: &[Spot], series: usize, colour: &str, reach: f64) -> Drawn {
    let at = spots.iter().map(|spot| spot.at);
    ScatterPlot::new().with_data(at).with_marker(shape(series)).with_color(colour).with_size(reach).into()
}

/// Where a point is drawn, in the coordinates of the axes.
#[derive(Clone, Copy, Debug)]
struct Spot {
    at: (f64, f64),
    /// Whether it is at the plot's edge because it has no place on an axis.
    at_edge: bool,
}

/// Both axes of a plot.
struct Axes {
    x: Scale,
    y: Scale,
}

impl Axes {
    fn new(plot: &Plot) -> Self {
        let points = || plot.series.iter().flat_map(|series| &series.points);
        Self {
            x: Scale::new(plot.x.logarithmic, &points().map(|point| point.x).collect::<Vec<_>>()),
            y: Scale::new(plot.y.logarithmic, &points().map(|point| point.y).collect::<Vec<_>>()),
        }
    }

    /// Where a point is drawn; nowhere where it is no number.
    fn spot(&self, point: &Point) -> Option<Spot> {
        let (x, is_x_at_edge) = self.x.at(point.x)?;
        let (y, is_y_at_edge) = self.y.at(point.y)?;
        Some(Spot { at: (x, y), at_edge: is_x_at_edge || is_y_at_edge })
    }

    /// The Pareto front of all points, joined, beneath the data.
    fn front(&self, plot: &Plot) -> Drawn {
        let points: Vec<&Point> = plot.series.iter().flat_map(|series| &series.points).collect();
        let on_it = front(&points.iter().map(|point| (point.x, point.y)).collect::<Vec<_>>());
        let spots = on_it.into_iter().filter_map(|index| self.spot(points[index])).map(|spot| spot.at);
        LinePlot::new().with_data(spots).with_color(FRONT).with_stroke_width(9.0).into()
    }

    /// The words beside points, which make way for each other, at markers that are not seen.
    fn labels(&self, plot: &Plot) -> Drawn {
        let points = plot.series.iter().flat_map(|series| &series.points);
        let (at, words): (Vec<_>, Vec<_>) =
            points.filter_map(|point| Some((self.spot(point)?.at, point.label.clone()?))).unzip();
        ScatterPlot::new()
            .with_data(at)
            .with_labels(words)
            .with_label_style(LabelStyle::Repel)
            .with_size(REACH)
            .with_marker_opacity(0.0)
            .into()
    }

    fn layout(&self, plot: &Plot) -> Layout {
        let [x, y] = [&self.x, &self.y];
        let ticks = |scale: &Scale| {
            let scale = *scale;
            TickFormat::Custom(Arc::new(move |coordinate| scale.text(coordinate)))
        };
        let theme = Theme {
            axis_color: "#888888".into(),
            tick_color: "#888888".into(),
            grid_color: "#e2e2e2".into(),
            text_color: "#222222".into(),
            legend_border: "none".into(),
            ..Theme::light()
        };
        Layout::new((x.ends[0], x.ends[1]), (y.ends[0], y.ends[1]))
            .with_width(WIDTH)
            .with_theme(theme)
            .with_title(&plot.title)
            .with_title_wrap(TITLE)
            .with_title_size(17)
            .with_x_label(&plot.x.label)
            .with_y_label(&plot.y.label)
            .with_y_label_wrap(Y_LABEL)
            .with_label_size(14)
            .with_tick_size(13)
            .with_body_size(13)
            .with_x_axis_min(x.ends[0])
            .with_x_axis_max(x.ends[1])
            .with_y_axis_min(y.ends[0])
            .with_y_axis_max(y.ends[1])
            .with_x_tick_step(x.step)
            .with_y_tick_step(y.step)
            .with_x_tick_format(ticks(x))
            .with_y_tick_format(ticks(y))
            .with_legend_entries(legend(plot))
            .with_legend_position(LegendPosition::OutsideBottomColumns)
    }
}

/// What the legend says: each series, and the front.
fn legend(plot: &Plot) -> Vec<LegendEntry> {
    let entry = |label: &str, color: &str, shape| LegendEntry {
        label: label.to_owned(),
        color: color.to_owned(),
        shape,
        dasharray: None,
    };
    let series = plot.series.iter().enumerate();
    let series =
        series.map(|(index, series)| entry(&series.name, colour(index), LegendShape::Marker(shape(index))));
    series.chain(plot.front.then(|| entry("Pareto front", FRONT, LegendShape::Rect))).collect()
}
