//! What the search for the best map minimises.

/// What [`Warp::Best`](crate::Warp::Best) minimises, over points of the surfaces in view.
///
/// At a point a map's error is the mean side of a texel on the surface plus the distance by which the bias detaches shadows, in
/// pixels ([`ShadowMap::surface_error`](crate::ShadowMap::surface_error)).
///
/// ```
/// use shadowfit::{Settings, warp::Objective};
///
/// assert_eq!(Settings::default().objective(), Objective::Mean);
/// assert_eq!(Settings::default().with_objective(Objective::Worst).objective(), Objective::Worst);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Objective {
    /// The mean over pixels, which goes with the number of wrong pixels.
    #[default]
    Mean,
    /// The largest anywhere.
    Worst,
}

/// The weight of the distance by which the bias detaches shadows, against the side of a texel, both in pixels.
pub(crate) const BIAS: f64 = 0.5;

/// The part of the bias for each texel of a step across and down, with the 2 × 2 texels of a sampler: half of the slope that
/// [`ShadowMap::bias`](crate::ShadowMap::bias) derives.
pub(crate) const SLOPE: f64 = 1.125;

/// The least sine of the angle between a surface and the light. With less light a shadow hardly shows, and grazed surfaces would
/// outweigh all others.
pub(crate) const LEAST_INCIDENCE: f64 = 0.05;
