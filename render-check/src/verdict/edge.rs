//! Edges of shadows, where a map of finite resolution is bound to be wrong.
//!
//! A map resolves whole texels, and a renderer's pixels are slightly off, so along the edge of every true shadow
//! some pixels are wrong. A wrong pixel counts as an edge pixel where the truth itself changes nearby:
//!
//! - **in texels**: at one of the texel centres that the filter reads, or at one of eight points around, half a
//!   texel beyond its reach. All are projected along the light onto the receiver's tangent plane, so that the truth
//!   of a plane is tested and not of whatever surface is there. A point whose light ray misses that plane counts as
//!   a change, as the plane turns away from the light within the filter.
//! - **in pixels**: at one of the eight neighbouring pixels.
//!
//! This hides faults within that distance of a true edge. That includes creases and contacts, where the tangent
//! plane runs into another surface and is in shadow there; and, at grazing incidence, the long stretch of surface
//! that one texel covers. It cannot hide acne on flat and convex surfaces, whose tangent planes are lit all around,
//! nor light leaks inside a shadow, which is dark all around.

use shadowfit::glam::DVec2;

use super::comparison::Comparison;
use super::projection::Projection;
use super::source::Illumination;
use super::surface::Surface;
use super::truth::Truth;

/// How far beyond the filter's reach the truth is tested, in texels.
const BEYOND: f64 = 0.5;

impl Comparison<'_> {
    /// Whether the truth differs from `lit`, its value at the receiver, anywhere within the filter's reach.
    pub(super) fn is_edge_in_texels(&self, projection: &dyn Projection, receiver: &Surface, lit: bool) -> bool {
        let Some(place) = projection.place(receiver.point).map(|place| place.truncate()) else {
            return false;
        };
        let here = if lit { Illumination::Lit } else { Illumination::Shadow };
        let changes_at = |place: DVec2| match projection.on_plane(receiver.point, receiver.normal, place) {
            Some(point) => self.truth.source().illumination(self.tracer, point, receiver.normal) != here,
            None => true,
        };
        let reach = self.rendered.reach;
        around(place, reach + BEYOND).chain(centres_within(place, reach)).any(changes_at)
    }

    /// Whether the truth differs from `lit`, its value in the pixel at `index`, in one of the neighbouring compared
    /// pixels.
    pub(super) fn is_edge_in_pixels(&self, index: usize, lit: bool) -> bool {
        self.truth.around(index).any(|pixel| match pixel {
            Truth::Seen(_, Illumination::Either) => true,
            _ => pixel.compared().is_some_and(|(_, other)| other != lit),
        })
    }
}

/// Eight points on a square around a point.
fn around(place: DVec2, distance: f64) -> impl Iterator<Item = DVec2> {
    (-1..=1)
        .flat_map(|y| (-1..=1).map(move |x| DVec2::new(f64::from(x), f64::from(y))))
        .filter(|&step| step != DVec2::ZERO)
        .map(move |step| place + distance * step)
}

/// The texel centres within `reach` of a point, along each axis.
pub(super) fn centres_within(place: DVec2, reach: f64) -> impl Iterator<Item = DVec2> {
    let span = move |at: f64| {
        let (first, last) = ((at - reach - 0.5).ceil(), (at + reach - 0.5).floor());
        (0..=(last - first) as u32).map(move |i| first + f64::from(i) + 0.5)
    };
    span(place.y).flat_map(move |row| span(place.x).map(move |column| DVec2::new(column, row)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filter_reads_the_texels_whose_centres_it_reaches() {
        let read = |x: f64, reach: f64| {
            let mut columns: Vec<f64> = centres_within(DVec2::new(x, 7.6), reach).map(|centre| centre.x).collect();
            let count = columns.len();
            columns.sort_by(f64::total_cmp);
            columns.dedup();
            (count, columns)
        };
        assert_eq!(read(3.1, 0.5), (1, vec![3.5]));
        assert_eq!(read(3.9, 0.5), (1, vec![3.5]));
        assert_eq!(read(3.1, 1.0), (4, vec![2.5, 3.5]));
        assert_eq!(read(3.1, 1.5), (9, vec![2.5, 3.5, 4.5]));
    }

    #[test]
    fn eight_places_lie_around() {
        let places: Vec<DVec2> = around(DVec2::new(5.0, 6.0), 1.5).collect();
        assert_eq!(places.len(), 8);
        assert!(places.iter().all(|&place| (place - DVec2::new(5.0, 6.0)).abs().max_element() == 1.5));
    }
}
