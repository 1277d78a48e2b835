//! Plots with everything in them that may be, drawn.

use std::collections::BTreeSet;
use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder};
use roxmltree::Document;

use super::scale::Scale;
use super::{PIXELS, colour, png, svg};
use crate::chapter::{Axis, Plot, Point, Series};

fn plot(axes: [Axis; 2], series: Vec<Series>) -> Plot {
    let [x, y] = axes;
    let [name, title, caption] = ["made-up", "Made up & <unlikely>", ""].map(str::to_owned);
    Plot { name, title, caption, x, y, series, front: true }
}

fn series(name: &str, joined: bool, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
    let points = points.into_iter().map(|(x, y)| Point { x, y, label: None }).collect();
    Series { name: name.to_owned(), points, joined }
}

fn logarithmic() -> [Axis; 2] {
    [
        Axis::logarithmic("time of the fit and of the card, ms"),
        Axis::logarithmic("wrong pixels, % of what is compared"),
    ]
}

/// Sizes of maps by six ways to spread their texels.
fn sizes() -> Plot {
    let ways = [
        "uniform",
        "psm",
        "light-space",
        "trapezoidal",
        "best, good effort",
        "four cascades, uniform, split in halves",
    ];
    let sizes = [256.0, 512.0, 1024.0, 2048.0, 4096.0_f64];
    let mut series: Vec<Series> = ways
        .iter()
        .enumerate()
        .map(|(way, name)| {
            let gain = 1.0 + 0.6 * way as f64;
            let point =
                |size: f64| (0.05 + 0.02 * gain + (size / 1500.0).powi(2), 9.0 / gain * (size / 256.0).powf(-0.9));
            series(name, true, sizes.map(point))
        })
        .collect();
    for (point, size) in series[0].points.iter_mut().zip(sizes) {
        point.label = Some(format!("{size}²"));
    }
    plot(logarithmic(), series)
}

/// Errors of four kinds of numbers, some of which make none.
fn errors() -> Plot {
    let kinds = [
        ("f32", 90e-9, [3e-4, 0.8]),
        ("f64", 110e-9, [2e-12, 1e-6]),
        ("crate", 160e-9, [0.0, 0.0]),
        ("exact", 4e-4, [0.0, 0.0]),
    ];
    let series = kinds.map(|(name, time, errors)| {
        let points = ["random", "hard"].into_iter().zip(errors).enumerate();
        let points = points.map(|(index, (set, y))| Point {
            x: time * (1.0 + 0.2 * index as f64),
            y,
            label: Some(set.to_owned()),
        });
        Series { name: name.to_owned(), points: points.collect(), joined: false }
    });
    plot([Axis::logarithmic("time per body, s"), Axis::logarithmic("largest error, world units")], series.into())
}

/// Growth of eight things over five decades.
fn growth() -> Plot {
    let exponents = [0.0, 0.3, 0.5, 0.9, 1.0, 1.1, 1.6, 2.0];
    let lines = exponents.map(|exponent: f64| {
        let points = (0..=10).map(|step| 10_f64.powf(0.5 * f64::from(step)));
        series(
            &format!("stage with {exponent}"),
            true,
            points.map(|x| (x, 1e-6 * (1.0 + exponent) * x.powf(exponent))),
        )
    });
    Plot { front: false, ..plot([Axis::logarithmic("casters"), Axis::logarithmic("time, s")], lines.into()) }
}

/// More series than there are colours, all of them at points with words, close together.
fn many() -> Plot {
    let series = (0..24_i32).map(|index| {
        let [x, y] = [index % 6, index / 6].map(|step| 1.0 + 0.1 * f64::from(step));
        let point = Point { x, y, label: Some(format!("{index} cascades")) };
        Series { name: format!("the {index}th of many ways to fit"), points: vec![point], joined: false }
    });
    plot([Axis::linear("times, of the fastest"), Axis::logarithmic("ratio of areas")], series.collect())
}

/// Width, height, and the colours of all pixels.
fn picture(plot: &Plot) -> ([u32; 2], BTreeSet<[u8; 3]>) {
    let bytes = png(plot).expect("it can be drawn");
    let mut reader = Decoder::new(Cursor::new(bytes)).read_info().expect("it is a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut pixels).expect("it is whole");
    assert_eq!((info.color_type, info.bit_depth), (ColorType::Rgba, BitDepth::Eight));
    let (pixels, _) = pixels.as_chunks::<4>();
    assert!(pixels.iter().all(|pixel| pixel[3] == 255), "it is opaque");
    ([info.width, info.height], pixels.iter().map(|&[red, green, blue, _]| [red, green, blue]).collect())
}

/// The sides of an SVG, in the pixels of its PNG, and all words in it.
fn text(svg: &str) -> ([u32; 2], Vec<String>) {
    let document = Document::parse(svg).expect("it is XML");
    let side = |name| {
        let side: f64 = document.root_element().attribute(name).and_then(|side| side.parse().ok()).expect(name);
        (side * f64::from(PIXELS)).ceil() as u32
    };
    let words = document.descendants().filter_map(|node| node.text()).map(str::to_owned).collect();
    (["width", "height"].map(side), words)
}

#[test]
fn plots_are_opaque_pictures_with_the_colours_of_their_series() {
    for plot in [sizes(), errors(), growth(), many()] {
        let (size, colours) = picture(&plot);
        assert_eq!(size, text(&svg(&plot)).0);
        for (index, series) in plot.series.iter().enumerate() {
            let code = u32::from_str_radix(&colour(index)[1..], 16).expect("it is in hexadecimal");
            let [_, red, green, blue] = code.to_be_bytes();
            assert!(colours.contains(&[red, green, blue]), "{}", series.name);
        }
    }
}

#[test]
fn all_that_is_named_is_written() {
    for plot in [sizes(), errors(), growth(), many()] {
        let svg = svg(&plot);
        let (_, words) = text(&svg);
        let has = |word: &String| words.contains(word);
        assert!(has(&plot.title) && has(&plot.x.label) && has(&plot.y.label), "{words:?}");
        assert!(plot.series.iter().all(|series| has(&series.name)), "{words:?}");
        assert_eq!(has(&"Pareto front".to_owned()), plot.front);
        let mut labels =
            plot.series.iter().flat_map(|series| &series.points).filter_map(|point| point.label.as_ref());
        assert!(labels.all(has), "{words:?}");
        assert_eq!(svg, super::svg(&plot), "the same plot is the same text");
    }
}

#[test]
fn whatever_the_figures_are_there_is_a_plot() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN, 0.0, -0.0, -1.0, 5e-324, 1.0];
    let pairs = || odd.into_iter().flat_map(|x| odd.map(|y| (x, y)));
    let kinds = [
        vec![],
        vec![series("none", true, [])],
        vec![series("one", true, [(1.0, 1.0)])],
        vec![series("equal", true, [(2.5, 2.5); 9])],
        vec![series("nothing", true, [(0.0, 0.0)])],
        vec![series("no number", false, [(f64::NAN, 1.0)]), series("number", false, [(3.0, 1.0)])],
        vec![series("odd", true, pairs()), series("odd, apart", false, pairs())],
    ];
    for series in kinds {
        for axes in [logarithmic(), logarithmic().map(|axis| Axis { logarithmic: false, ..axis })] {
            let plot = plot(axes, series.clone());
            let svg = svg(&plot);
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            let (size, colours) = picture(&plot);
            assert_eq!(size, text(&svg).0);
            assert!(colours.len() > 4, "{series:?}");
        }
    }
}

#[test]
fn what_has_no_place_is_open() {
    let at = |y| svg(&plot(logarithmic(), vec![series("one", false, [(1.0, 1.0), (2.0, y)])]));
    let circles = |svg: &str| svg.matches("<circle").count();
    assert_eq!(circles(&at(0.0)), circles(&at(2.0)) + 1, "a white one on that of the series");
    let says = |y, word: &str| text(&at(y)).1.iter().any(|words| words == word);
    assert!(says(0.0, "0") && says(-1.0, "≤ 0") && !says(2.0, "0"));
    assert!(says(f64::INFINITY, "∞") && !says(2.0, "∞"));
}

#[test]
fn ticks_are_round() {
    let ticks = |logarithmic, values: &[f64]| {
        let scale = Scale::new(logarithmic, values);
        let [first, last] = scale.ends.map(|end| end / scale.step);
        let steps = first.ceil() as i32..=last.floor() as i32;
        steps.map(|step| scale.text(f64::from(step) * scale.step)).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(ticks(true, &[300.0, 4096.0]), "256 512 1024 2048 4096");
    assert_eq!(ticks(true, &[0.01, 0.2]), "0.00781 0.0156 0.0312 0.0625 0.125 0.25");
    assert_eq!(ticks(true, &[2e-6, 0.0, 3e3]), "0 1e-6 1e-5 1e-4 0.001 0.01 0.1 1 10 100 1000 10000");
    assert_eq!(ticks(true, &[1e-15, -1.0, 0.5]), "≤ 0 1e-16 1e-14 1e-12 1e-10 1e-8 1e-6 1e-4 0.01 1");
    assert_eq!(ticks(false, &[0.31, 0.9]), "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9");
    assert_eq!(ticks(false, &[-3e7, 5e7, f64::INFINITY]), "-3e7 -2e7 -1e7 0 1e7 2e7 3e7 4e7 5e7 ∞");
}
