//! Depth tests: the surface of a caster that a shadow map stores.

use crate::mesh::Solidity;

/// The surface of a caster that a map stores, and that receivers are compared with.
///
/// ```text
///                     first depth       second depth      between layers
///
///     light ──▶       █────┐            ┌────█            ┌──█─┐
///     a solid         █    │            │    █            │  █ │
///     from the side   █────┘            └────█            └──█─┘
/// ```
///
/// All compare alike: a point is lit where its depth is at most the stored one (≤). They differ in what needs a bias: with
/// first depth every lit surface; with second depth only open meshes, as a solid's lit side is compared with its far side;
/// `docs/depth.md` compares them, at contacts too, with measurements. A mesh with a hole that is drawn as if it were a solid
/// leaks light in second depth: [`Self::culling`] goes by the mesh's solidity.
///
/// ```
/// use shadowfit::{depth::{Culling, DepthTest}, mesh::Solidity};
///
/// assert_eq!(DepthTest::default(), DepthTest::First);
/// assert_eq!(DepthTest::Second.culling(Solidity::Watertight), Culling::Front);
/// ```
///
/// Sources: Williams 1978; Wang & Molnar, *Second-Depth Shadow Mapping*, UNC TR94-019, 1994; for the middle of two layers
/// Woo, *The Shadow Depth Map Revisited*, Graphics Gems III, 1992.
#[doc(alias = "second-depth shadow mapping")]
#[doc(alias = "back-face shadow")]
#[doc(alias = "midpoint shadow map")]
#[doc(alias = "dual depth layer")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DepthTest {
    /// The surface nearest to the light (Williams 1978).
    #[default]
    First,
    /// The far side of solids, and open meshes as they are (Wang & Molnar 1994).
    Second,
    /// Halfway between the first two surfaces along a ray, whatever they belong to (Woo 1992): the map is drawn twice,
    /// the second time without the surface that the first holds, and the two are averaged; where there is no second
    /// surface, with the depth that the map is cleared to.
    ///
    /// It asks nothing of the meshes, but every receiver must be drawn too. It does not pay where virtual samples can be had:
    /// [`plan`](crate::plan) never chooses it. The shader functions of the `wgsl` feature do both halves of it.
    BetweenLayers,
}

/// The faces that a rasteriser leaves out of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Culling {
    /// None: both sides are drawn.
    None,
    /// Front faces, counter-clockwise as the light sees them.
    Front,
    /// Back faces.
    Back,
}

impl DepthTest {
    /// The faces to leave out when a mesh is drawn into the map.
    ///
    /// First depth leaves out none. The light meets a front of a solid first, so the backs could go; but where a point
    /// light, or the distance at which its map begins, lies inside the solid, backs are all there is to cast.
    ///
    /// ```
    /// use shadowfit::{depth::{Culling, DepthTest}, mesh::Solidity};
    ///
    /// assert_eq!(DepthTest::Second.culling(Solidity::Watertight), Culling::Front);
    /// assert_eq!(DepthTest::Second.culling(Solidity::Inverted), Culling::Back);
    /// assert_eq!(DepthTest::Second.culling(Solidity::Open), Culling::None);
    /// assert_eq!(DepthTest::First.culling(Solidity::Watertight), Culling::None);
    /// ```
    #[must_use]
    pub const fn culling(self, solidity: Solidity) -> Culling {
        match (self, solidity) {
            (Self::First | Self::BetweenLayers, _) | (Self::Second, Solidity::Open) => Culling::None,
            (Self::Second, Solidity::Watertight) => Culling::Front,
            (Self::Second, Solidity::Inverted) => Culling::Back,
        }
    }
}
