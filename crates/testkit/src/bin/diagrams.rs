//! Draws the diagrams of the documentation, as SVG, from the crate's own results.
//!
//! `cargo run -p testkit --bin diagrams -- docs/images`

#![allow(clippy::disallowed_methods, reason = "angles put corners in order here, they are no part of a fit")]

use std::fmt::Write;
use std::path::PathBuf;

use shadowfit::cascades::{CascadeSplits, Cascades, SplitScheme};
use shadowfit::depth::TangentPlane;
use shadowfit::focus::ConvexBody;
use shadowfit::glam::{DMat4, DVec2, DVec3};
use shadowfit::omni::CubeFace;
use shadowfit::{
    Aabb, DepthFormat, Filter, Focus, FocusForm, InputError, Light, Outcome, Scene, Settings, ShadowMap, View, Warp,
};

/// Pixels for a metre.
const SCALE: f64 = 17.0;
const WIDTH: f64 = 44.0;
const HEIGHT: f64 = 15.0;

/// What is shown, in metres: everything lies along x, and is symmetric to the plane z = 0 of the picture.
const SCENE: [[f64; 3]; 2] = [[0.0, -0.4, -20.0], [40.0, 11.0, 20.0]];

/// How the outline of the view is drawn.
const VIEW: &str = "fill=\"none\" stroke=\"#1c4f8f\" stroke-width=\"1.6\"";

const FOCUS: &str = "concepts-focus.svg";
const WARP: &str = "concepts-warp.svg";
const CASCADES: &str = "concepts-cascades.svg";
const BIAS: &str = "concepts-bias.svg";
const OMNI: &str = "concepts-omni.svg";

/// Light and dark, in turn, for parts that lie side by side.
const PARTS: [&str; 2] = ["fill=\"#4a90d9\" fill-opacity=\"0.3\"", "fill=\"#4a90d9\" fill-opacity=\"0.6\""];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("usage: diagrams FOLDER")?);
    for (name, svg) in diagrams()? {
        std::fs::write(folder.join(name), svg)?;
    }
    Ok(())
}

fn diagrams() -> Result<[(&'static str, String); 5], InputError> {
    Ok([(FOCUS, focus()?), (WARP, warp()?), (CASCADES, cascades()?), (BIAS, bias()?), (OMNI, omni()?)])
}

fn view() -> Result<View, InputError> {
    View::perspective((8.0, 4.6, 0.0), (1.0, -0.16, 0.0), (0.0, 1.0, 0.0), 0.62, 1.6, 1.6, 31.0)
}

/// V, l, S, R and H, and which casters touch H.
fn focus() -> Result<String, InputError> {
    let (view, sun) = (view()?, Light::directional((-1.0, 1.0, 0.0))?);
    let scene = Scene::from_box(SCENE[0], SCENE[1])?;
    let focus = Focus::new(&view, &sun, &scene);
    let body = focus.caster_volume(FocusForm::ReceiverHull);

    let mut svg = Svg::new(
        "The view V, the light l, the scene S, the receiver volume R and the caster volume H, from the side",
    );
    svg.polygon(&rectangle(SCENE), "fill=\"none\" stroke=\"#999\" stroke-dasharray=\"6 4\"");
    svg.polygon(&section(&body), "fill=\"#f4a261\" fill-opacity=\"0.45\" stroke=\"#c8691c\"");
    svg.polygon(&section(&focus.receiver_volume()), "fill=\"#4a90d9\" fill-opacity=\"0.45\" stroke=\"none\"");
    svg.polygon(&outline(&view), VIEW);
    // Behind the eye, in view, above it, and two whose shadows fall where nobody looks.
    for caster in [
        [[4.2, 0.0], [5.4, 8.8]],
        [[19.5, 0.0], [20.7, 3.4]],
        [[25.0, 9.0], [27.0, 9.7]],
        [[0.8, 0.0], [2.2, 2.2]],
        [[10.6, 0.0], [12.0, 1.3]],
    ] {
        let corners = caster.map(|[x, y]: [f64; 2]| [x, y, 0.0]);
        let drawn = body.intersects_aabb(corners[0], corners[1]);
        let style = if drawn { "fill=\"#444\"" } else { "fill=\"#fff\" stroke=\"#999\"" };
        svg.polygon(&rectangle(corners), style);
        let below = DVec2::new(
            (corners[0][0] + corners[1][0]) / 2.0,
            corners[0][1] - if corners[0][1] > 0.0 { 1.2 } else { 1.5 },
        );
        svg.text(below, if drawn { "drawn" } else { "culled" }, "#555");
    }
    svg.polygon(&rectangle([[0.0, -0.4, 0.0], [40.0, 0.0, 0.0]]), "fill=\"#bbb\"");
    for x in [9.0, 15.0, 21.0] {
        let from = DVec2::new(x, 13.6);
        svg.arrow(from, from + DVec2::new(1.4, -1.4), "#d4a017");
    }
    svg.dot(view.eye().truncate(), "#1c4f8f");
    for (at, label, colour) in [
        ([6.6, 4.4], "eye", "#1c4f8f"),
        ([39.2, 11.4], "S", "#777"),
        ([29.0, 3.4], "R", "#1c4f8f"),
        ([13.0, 8.6], "H", "#a8500f"),
        ([12.2, 6.1], "V", "#1c4f8f"),
        ([7.9, 13.0], "l", "#a37b0c"),
    ] {
        svg.text(DVec2::from(at), label, colour);
    }
    Ok(svg.finish())
}

/// The texels of a uniform map and of a warped one, along the light's rays.
fn warp() -> Result<String, InputError> {
    let (view, sun) = (view()?, Light::directional((-0.25, 1.0, 0.0))?);
    let ground = [Aabb::new(SCENE[0], [SCENE[1][0], 0.0, SCENE[1][2]])];
    let trees = [Aabb::new([20.0, 0.0, -1.0], [21.0, 6.0, 1.0]), ground[0]];
    let scene = Scene::new(&trees, &ground)?;
    let focus = Focus::new(&view, &sun, &scene);
    let mut svg = Svg::new("Texels of a uniform map above, of a warped one below: the warp draws them to the eye");
    for (warp, label, up) in [(Warp::Uniform, "uniform", 7.6), (Warp::LightSpace, "warped", 0.6)] {
        let settings = Settings::new(32, 600)?.with_warp(warp);
        let Some(map) = focus.fit(&settings).map().cloned() else { continue };
        let moved = |point: DVec3| point.truncate() * DVec2::new(1.0, 0.55) + DVec2::new(0.0, up);
        for texel in (0..settings.map_size()).step_by(2) {
            let [from, to] =
                [texel, texel + 1].map(|row| ray(&map, f64::from(row) / f64::from(settings.map_size())));
            svg.polygon(&[from[0], from[1], to[1], to[0]].map(moved), "fill=\"#4a90d9\" fill-opacity=\"0.55\"");
        }
        svg.polygon(&rectangle([[0.0, up - 0.25, 0.0], [WIDTH, up, 0.0]]), "fill=\"#bbb\"");
        let view_there: Vec<DVec2> = outline(&view).into_iter().map(|corner| moved(corner.extend(0.0))).collect();
        svg.polygon(&view_there, VIEW);
        svg.dot(moved(view.eye()), "#1c4f8f");
        svg.text(DVec2::new(3.2, up + 3.4), label, "#1c4f8f");
    }
    Ok(svg.finish())
}

/// A view from above, cut into cascades, with the zones in which they are blended.
fn cascades() -> Result<String, InputError> {
    let (view, sun) = (view()?, Light::directional((-1.0, 1.0, 0.0))?);
    let scene = Scene::from_box(SCENE[0], SCENE[1])?;
    let splits = CascadeSplits::View { count: 3, split: SplitScheme::Practical(0.5) };
    let cascades = Cascades::new(&view, &sun, &scene, splits, 0.2)?;
    let mut svg =
        Svg::new("A view from above, cut into three cascades; in the dark zones the next cascade is blended in");
    for (index, cascade) in cascades.iter().enumerate() {
        svg.polygon(&from_above(&view.narrowed(cascade.near, cascade.far)?), PARTS[index % 2]);
        if cascade.blend < cascade.far {
            let blended = from_above(&view.narrowed(cascade.blend, cascade.far)?);
            svg.polygon(&blended, "fill=\"#1c4f8f\" fill-opacity=\"0.55\"");
        }
        let middle = view.eye() + view.forward() * (0.5 * (cascade.near + cascade.blend));
        svg.text(above(middle) - DVec2::new(0.0, 0.3), &index.to_string(), "#1c4f8f");
    }
    svg.polygon(&from_above(&view), VIEW);
    svg.dot(above(view.eye()), "#1c4f8f");
    svg.text(above(view.eye()) - DVec2::new(1.6, 0.2), "eye", "#1c4f8f");
    Ok(svg.finish())
}

/// A point from above, drawn together to fit into the picture.
fn above(point: DVec3) -> DVec2 {
    DVec2::new(point.x, 7.2 - 0.42 * point.z)
}

/// The outline of a view from above, at half of its height; empty where it has no end.
fn from_above(view: &View) -> Vec<DVec2> {
    let middle = |corners: &[DVec3; 8], edge: usize| above((corners[edge] + corners[edge + 2]) / 2.0);
    view.corners().map_or_else(Vec::new, |corners| [0, 1, 5, 4].map(|edge| middle(&corners, edge)).to_vec())
}

/// What a map stores of a plane that the light meets at a slope, without a bias and with it.
fn bias() -> Result<String, InputError> {
    const TEXELS: u32 = 8;
    let (view, sun) = (view()?, Light::directional((-0.9, 1.0, 0.0))?);
    let scene = Scene::from_box(SCENE[0], SCENE[1])?;
    let settings = Settings::new(32, 600)?.with_warp(Warp::Uniform);
    let mut svg =
        Svg::new("Depths that a map stores of a plane: without a bias they lie before parts of it, with it behind");
    let ground = DVec3::new(24.0, 0.0, 0.0);
    let Outcome::Map(map) = Focus::new(&view, &sun, &scene).fit(&settings) else { return Ok(svg.finish()) };
    let Some(plane) = TangentPlane::new(&map, ground, DVec3::Y) else { return Ok(svg.finish()) };
    let bias = map.bias(DepthFormat::Unorm24, Filter::Nearest.reach())?;
    let size = f64::from(settings.map_size());
    let slope = plane.slopes().y / size;
    let first = (plane.place().y * size).floor() - 0.5 * f64::from(TEXELS);
    let depth = |row: f64| plane.depth_at(DVec2::new(plane.place().x, row / size)) - plane.depth();
    for (left, label, moved) in [
        (1.0, "no bias: shadow acne", 0.0),
        (23.4, "derived bias: no acne", f64::from(bias.slope_scale) * slope.abs() + bias.most),
    ] {
        let at = |row: f64, depth: f64| DVec2::new(left + 2.2 * (row - first), 7.6 - 0.95 * depth / slope.abs());
        let last = first + f64::from(TEXELS);
        svg.line(at(first, depth(first)), at(last, depth(last)), "stroke=\"#777\" stroke-width=\"1.6\"");
        for texel in 0..TEXELS {
            let row = first + f64::from(texel);
            let stored = depth(row + 0.5) + moved;
            svg.line(at(row, stored), at(row + 1.0, stored), "stroke=\"#1c4f8f\" stroke-width=\"2.4\"");
            let dark = [row, row + 1.0].map(|end| at(end, depth(end)));
            // The half in which the plane is deeper than what is stored.
            let middle = at(row + 0.5, depth(row + 0.5));
            let deeper = if depth(row + 1.0) > depth(row) { dark[1] } else { dark[0] };
            if (depth(row + 1.0) - depth(row)).abs() * 0.5 > moved {
                svg.line(middle, deeper, "stroke=\"#c0392b\" stroke-width=\"5\" stroke-opacity=\"0.7\"");
            }
        }
        svg.text(DVec2::new(left + 8.8, 0.4), label, "#333");
    }
    svg.text(DVec2::new(4.6, 13.4), "stored depths", "#1c4f8f");
    svg.text(DVec2::new(4.6, 12.3), "the plane", "#777");
    svg.text(DVec2::new(4.6, 11.2), "in shadow", "#c0392b");
    svg.text(DVec2::new(21.0, 13.4), "light from above, depth grows downwards", "#a37b0c");
    Ok(svg.finish())
}

/// A point light in a room from above: the faces of its cube that need a map, and the paraboloids that do.
fn omni() -> Result<String, InputError> {
    let view = View::perspective((-4.5, 1.6, 0.0), (1.0, 0.0, 0.62), (0.0, 1.0, 0.0), 0.5, 1.4, 0.3, 20.0)?;
    let lamp = Light::point((0.0, 2.0, 0.0), 0.05, 12.0)?;
    let scene = Scene::from_box((-6.0, 0.0, -5.0), (6.0, 3.0, 5.0))?;
    let settings = Settings::new(256, 600)?;
    let mut svg = Svg::new(
        "A point light in a room from above: the cube faces with receivers on the left, the one paraboloid that holds them on the right",
    );
    let corners = [[-6.0, -5.0], [6.0, -5.0], [6.0, 5.0], [-6.0, 5.0]].map(DVec2::from);
    let panel = |right: bool| {
        move |place: DVec2| DVec2::new(if right { 32.0 } else { 10.5 }, 7.6) + 1.28 * DVec2::new(place.x, -place.y)
    };
    for right in [false, true] {
        let to_picture = panel(right);
        let parts: Vec<(Vec<DVec2>, bool)> = if right {
            let half = |axis: DVec3| inside(&corners, |corner| corner.dot(DVec2::new(axis.x, axis.z)));
            let maps = Focus::new(&view, &lamp, &scene).paraboloids(&settings);
            maps.maps().iter().map(|map| (half(map.axis()), true)).collect()
        } else {
            [CubeFace::PositiveX, CubeFace::NegativeX, CubeFace::PositiveZ, CubeFace::NegativeZ]
                .into_iter()
                .map(|face| {
                    let part = lamp.cube_face(face, 0.0)?;
                    let has_map = Focus::new(&view, &part, &scene).fit(&settings).map().is_some();
                    let axis = DVec2::new(face.axis().x, face.axis().z);
                    let mut outline = vec![DVec2::ZERO];
                    outline.extend([-1.0, 1.0].map(|side| 5.0 * (axis + side * axis.perp())));
                    if axis.x != 0.0 {
                        // The room is longer than wide.
                        outline.splice(2..2, [-1.0, 1.0].map(|side| DVec2::new(6.0 * axis.x, side * 5.0 * axis.x)));
                    }
                    Ok((outline, has_map))
                })
                .collect::<Result<_, InputError>>()?
        };
        for (outline, has_map) in parts {
            let outline: Vec<DVec2> = outline.into_iter().map(to_picture).collect();
            let style = if has_map {
                "fill=\"#d4a017\" fill-opacity=\"0.3\" stroke=\"#a37b0c\""
            } else {
                "fill=\"none\" stroke=\"#bbb\""
            };
            svg.polygon(&outline, style);
        }
        svg.polygon(&corners.map(to_picture), "fill=\"none\" stroke=\"#777\" stroke-width=\"1.6\"");
        let receivers: Vec<DVec2> =
            plan(&Focus::new(&view, &lamp, &scene).receiver_volume()).into_iter().map(to_picture).collect();
        svg.polygon(&receivers, "fill=\"#4a90d9\" fill-opacity=\"0.45\" stroke=\"#1c4f8f\"");
        let (light, eye) = (to_picture(DVec2::ZERO), to_picture(DVec2::new(view.eye().x, view.eye().z)));
        svg.dot(light, "#a37b0c");
        svg.text(light + DVec2::new(1.7, 0.5), "light", "#a37b0c");
        svg.dot(eye, "#1c4f8f");
        svg.text(eye + DVec2::new(0.0, 0.6), "eye", "#1c4f8f");
    }
    svg.text(DVec2::new(10.5, -0.6), "cube faces: those with receivers", "#333");
    svg.text(DVec2::new(32.0, -0.6), "one paraboloid for all receivers", "#333");
    Ok(svg.finish())
}

/// The outline of a body from above: the corners of the convex hull of its vertices, in order.
fn plan(body: &ConvexBody) -> Vec<DVec2> {
    let mut points: Vec<DVec2> = body.vertices().iter().map(|vertex| DVec2::new(vertex.x, vertex.z)).collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    // Andrew's monotone chain, there and back.
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(point - b) <= 1e-9
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut outline = half(&mut points.iter().copied());
    outline.extend(half(&mut points.iter().rev().copied()));
    outline
}

/// Where the middle of a row of texels meets the light's rays: at a height and on the ground.
fn ray(map: &ShadowMap, row: f64) -> [DVec3; 2] {
    let world: DMat4 = map.texture_from_world().inverse();
    let [a, b] = [0.1, 0.9].map(|depth| world.project_point3(DVec3::new(0.5, row, depth)));
    [5.0, 0.0].map(|height| a + (b - a) * ((height - a.y) / (b.y - a.y)))
}

/// The view in the picture, above the ground; empty where it has no end.
fn outline(view: &View) -> Vec<DVec2> {
    let middle = |corners: &[DVec3; 8], edge: usize| ((corners[edge] + corners[edge + 1]) / 2.0).truncate();
    view.corners().map_or_else(Vec::new, |corners| above_ground(&[0, 4, 6, 2].map(|edge| middle(&corners, edge))))
}

/// The part of a convex polygon that is not below the ground.
fn above_ground(corners: &[DVec2]) -> Vec<DVec2> {
    inside(corners, |corner| corner.y)
}

/// The part of a convex polygon where a linear function is not negative.
fn inside(corners: &[DVec2], value: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .flat_map(|(&from, &to)| {
            let (at_from, at_to) = (value(from), value(to));
            let crossing = ((at_from < 0.0) != (at_to < 0.0)).then(|| from.lerp(to, at_from / (at_from - at_to)));
            (at_from >= 0.0).then_some(from).into_iter().chain(crossing)
        })
        .collect()
}

/// The corners of a box in the picture.
fn rectangle([min, max]: [[f64; 3]; 2]) -> [DVec2; 4] {
    [[min[0], min[1]], [max[0], min[1]], [max[0], max[1]], [min[0], max[1]]].map(DVec2::from)
}

/// The corners of what the plane z = 0 cuts out of a body, in order around their middle.
fn section(body: &ConvexBody) -> Vec<DVec2> {
    let mut corners: Vec<DVec2> = body
        .edges()
        .filter(|(from, to)| (from.z < 0.0) != (to.z < 0.0))
        .map(|(from, to)| from.lerp(to, from.z / (from.z - to.z)).truncate())
        .collect();
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    corners.sort_by(|a, b| (*a - middle).to_angle().total_cmp(&(*b - middle).to_angle()));
    corners
}

/// A picture of metres, y up.
struct Svg(String);

impl Svg {
    fn new(title: &str) -> Self {
        let (width, height) = (WIDTH * SCALE, (HEIGHT + 2.0) * SCALE);
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" role=\"img\" \
             style=\"max-width: 100%\" font-family=\"sans-serif\" font-size=\"14\">\n<title>{title}</title>\n<rect width=\"100%\" height=\"100%\" \
             rx=\"6\" fill=\"#fff\"/>\n"
        ))
    }

    fn place(point: DVec2) -> String {
        format!("{:.1},{:.1}", (point.x + 1.0) * SCALE, (HEIGHT - point.y) * SCALE)
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing into a string does not fail.
        let _ = writeln!(self.0, "{element}");
    }

    fn polygon(&mut self, corners: &[DVec2], style: &str) {
        let points: Vec<String> = corners.iter().map(|&corner| Self::place(corner)).collect();
        self.element(format_args!("<polygon points=\"{}\" {style}/>", points.join(" ")));
    }

    fn arrow(&mut self, from: DVec2, to: DVec2, colour: &str) {
        let along = (to - from).normalize_or_zero() * 0.5;
        let head = [to, to - along + along.perp() * 0.6, to - along - along.perp() * 0.6];
        self.polygon(&head, &format!("fill=\"{colour}\""));
        let [from, to] = [from, to].map(Self::place);
        self.element(format_args!("<path d=\"M{from} L{to}\" stroke=\"{colour}\" stroke-width=\"1.6\"/>"));
    }

    fn line(&mut self, from: DVec2, to: DVec2, style: &str) {
        let [from, to] = [from, to].map(Self::place);
        self.element(format_args!("<path d=\"M{from} L{to}\" {style}/>"));
    }

    fn dot(&mut self, at: DVec2, colour: &str) {
        let at = Self::place(at);
        let (x, y) = at.split_once(',').unwrap_or_default();
        self.element(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"4.5\" fill=\"{colour}\"/>"));
    }

    fn text(&mut self, at: DVec2, text: &str, colour: &str) {
        let at = Self::place(at);
        let (x, y) = at.split_once(',').unwrap_or_default();
        self.element(format_args!(
            "<text x=\"{x}\" y=\"{y}\" fill=\"{colour}\" text-anchor=\"middle\">{text}</text>"
        ));
    }

    fn finish(self) -> String {
        self.0 + "</svg>\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_diagrams_are_those_of_the_documentation() {
        let stored = [
            (FOCUS, include_str!("../../../../docs/images/concepts-focus.svg")),
            (WARP, include_str!("../../../../docs/images/concepts-warp.svg")),
            (CASCADES, include_str!("../../../../docs/images/concepts-cascades.svg")),
            (BIAS, include_str!("../../../../docs/images/concepts-bias.svg")),
            (OMNI, include_str!("../../../../docs/images/concepts-omni.svg")),
        ];
        let drawn = diagrams().expect("the set-ups are valid");
        for ((name, stored), (_, drawn)) in stored.into_iter().zip(drawn) {
            assert_eq!(stored, drawn, "{name}: cargo run -p testkit --bin diagrams -- docs/images");
        }
    }
}
