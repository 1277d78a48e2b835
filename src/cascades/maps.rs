//! The maps of cascades, and what they cost and give together.

use super::layout::{AtlasTile, CascadeLayout, TextureExtent};
use super::{Cascade, Cascades};
use crate::fit::{Empty, Outcome};
use crate::map::{Report, shadow_map::ShadowMap};
use crate::settings::Settings;

/// What came of the fits of all cascades.
#[derive(Clone, Debug)]
pub struct CascadeMaps<'s, 'a> {
    pub(super) cascades: &'s Cascades<'a>,
    pub(super) outcomes: [Outcome; Cascades::MAX],
    pub(super) settings: Settings,
}

/// What the maps of cascades cost and give together.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CascadesReport {
    /// Cascades.
    pub cascades: usize,
    /// How many of them have a map.
    pub maps: usize,
    /// How many were dropped because nothing in them is visible and lit.
    pub nothing_visible: usize,
    /// How many were dropped because nothing can cast on what is visible in them: all of it is lit.
    pub nothing_casts: usize,
    /// In how many the light stands among what is visible, so that they need something else.
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

    /// What came of each cascade. One without a map is dropped where that is [`Outcome::Empty`]: it has no layer and no tile.
    #[must_use]
    pub fn outcomes(&self) -> &[Outcome] {
        &self.outcomes[..self.cascades.len()]
    }

    /// The maps, each with the index of its cascade.
    pub fn maps(&self) -> impl Iterator<Item = (usize, &ShadowMap)> {
        self.outcomes().iter().enumerate().filter_map(|(index, outcome)| outcome.map().map(|map| (index, map)))
    }

    /// The whole report of a cascade's map, if it has one.
    #[must_use]
    pub fn report_of(&self, index: usize) -> Option<Report> {
        Some(self.outcomes().get(index)?.map()?.report(&self.cascades.as_slice().get(index)?.focus))
    }

    /// What the maps cost and give together.
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

    /// The texture that holds all maps; without layers where there are none.
    #[must_use]
    pub fn extent(&self, layout: CascadeLayout) -> TextureExtent {
        layout.extent(self.count(), self.settings.map_sides())
    }

    /// Where the map of a cascade lies; `None` where it has none.
    #[must_use]
    pub fn tile(&self, index: usize, layout: CascadeLayout) -> Option<AtlasTile> {
        let place = self.maps().position(|(cascade, _)| cascade == index)?;
        Some(layout.tile(place as u32, self.count(), self.settings.map_sides()))
    }

    fn count(&self) -> u32 {
        self.maps().count() as u32
    }
}
