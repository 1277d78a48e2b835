//! The maps of cascades, and what they cost and resolve together.

use super::layout::{AtlasTile, CascadeLayout, TextureExtent};
use super::{Cascade, Cascades};
use crate::fit::{Empty, Outcome};
use crate::map::{Report, shadow_map::ShadowMap};
use crate::settings::Settings;

/// The fitted maps of all cascades ([`Cascades::fit`]).
///
/// ```
#[doc = include_str!("../examples/cascades.txt")]
/// assert_eq!(maps.cascades().len(), maps.outcomes().len());
/// assert_eq!(maps.settings(), &settings);
/// for (index, map) in maps.maps() {
///     let tile = maps.tile(index, CascadeLayout::Array).expect("it has a map");
///     assert_eq!((tile.layer, tile.size), (index as u32, (1024, 1024))); // draw `map` into this layer
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CascadeMaps<'s, 'a> {
    pub(super) cascades: &'s Cascades<'a>,
    pub(super) outcomes: [Outcome; Cascades::MAX],
    pub(super) settings: Settings,
}

/// What the maps of cascades cost and resolve together ([`CascadeMaps::report`]).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CascadesReport {
    /// The number of cascades.
    pub cascades: usize,
    /// How many of them have a map.
    pub maps: usize,
    /// How many were dropped because they have no receivers.
    pub nothing_visible: usize,
    /// How many were dropped because nothing can cast on their receivers: all of them are lit.
    pub nothing_casts: usize,
    /// In how many the light stands among the receivers, so that they need cube faces or paraboloids.
    pub surrounded: usize,
    /// Texels of all maps together. In an atlas some tiles may be left over, see [`CascadeMaps::extent`].
    pub texels: u64,
    /// The longest side of a texel's footprint in any cascade, in world units; 0 without maps.
    pub texel: f64,
    /// The worst aliasing in any cascade, see [`Report::aliasing`]; 0 without maps.
    pub aliasing: f64,
    /// The cascade with the worst aliasing.
    pub worst: Option<usize>,
}

impl<'a> CascadeMaps<'_, 'a> {
    /// The cascades that were fitted.
    #[must_use]
    pub fn cascades(&self) -> &[Cascade<'a>] {
        self.cascades.as_slice()
    }

    /// The settings that all were fitted with.
    #[must_use]
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The result of each cascade's fit. A cascade is dropped where that is [`Outcome::Empty`]: it has no layer and no tile.
    #[must_use]
    pub fn outcomes(&self) -> &[Outcome] {
        &self.outcomes[..self.cascades.len()]
    }

    /// The maps, each with the index of its cascade.
    pub fn maps(&self) -> impl Iterator<Item = (usize, &ShadowMap)> {
        self.outcomes().iter().enumerate().filter_map(|(index, outcome)| outcome.map().map(|map| (index, map)))
    }

    /// The full report of a cascade's map, if it has one.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let (first, last) = (maps.report_of(0).expect("a map"), maps.report_of(3).expect("a map"));
    /// assert!(first.texel < last.texel); // finer texels near the eye
    /// assert!(maps.report_of(4).is_none());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn report_of(&self, index: usize) -> Option<Report> {
        Some(self.outcomes().get(index)?.map()?.report(&self.cascades.as_slice().get(index)?.focus))
    }

    /// What the maps cost and resolve together.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let report = maps.report();
    /// assert_eq!((report.cascades, report.maps, report.texels), (4, 4, 4 * 1024 * 1024));
    /// assert_eq!(report.worst.and_then(|index| maps.report_of(index)).map(|worst| worst.aliasing), Some(report.aliasing));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn report(&self) -> CascadesReport {
        let count = |outcome: Outcome| self.outcomes().iter().filter(|one| **one == outcome).count();
        let empty = |why: Empty| count(Outcome::Empty(why));
        let (nothing_visible, nothing_casts) = (empty(Empty::NoReceivers), empty(Empty::NoCasters));
        let (cascades, maps) = (self.outcomes().len(), self.maps().count());
        let (width, height) = self.settings.map_sides();
        let mut report = CascadesReport {
            cascades,
            maps,
            nothing_visible,
            nothing_casts,
            surrounded: cascades - maps - nothing_visible - nothing_casts,
            texels: maps as u64 * u64::from(width) * u64::from(height),
            texel: 0.0,
            aliasing: 0.0,
            worst: None,
        };
        for (index, _) in self.maps() {
            let Some(one) = self.report_of(index) else { continue };
            report.texel = report.texel.max(one.texel);
            if report.worst.is_none() || one.aliasing > report.aliasing {
                (report.aliasing, report.worst) = (one.aliasing, Some(index));
            }
        }
        report
    }

    /// The size of the texture that holds all maps; no layers where there are none.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let array = maps.extent(CascadeLayout::Array);
    /// assert_eq!((array.width, array.height, array.layers), (1024, 1024, 4));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn extent(&self, layout: CascadeLayout) -> TextureExtent {
        layout.extent(self.count(), self.settings.map_sides())
    }

    /// The part of the texture that a cascade's map lies in; `None` where it has no map.
    ///
    /// ```
    #[doc = include_str!("../examples/cascades.txt")]
    /// let tile = maps.tile(3, CascadeLayout::Atlas).expect("a map");
    /// assert_eq!((tile.layer, tile.corner), (0, (1024, 1024))); // the viewport to draw it through
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn tile(&self, index: usize, layout: CascadeLayout) -> Option<AtlasTile> {
        let place = self.maps().position(|(cascade, _)| cascade == index)?;
        Some(layout.tile(place as u32, self.count(), self.settings.map_sides()))
    }

    fn count(&self) -> u32 {
        self.maps().count() as u32
    }
}
