//! Which surface of a caster a shadow map holds.

use crate::solidity::Solidity;

/// The surface that a map holds, and what a point's depth is compared with.
///
/// ```text
///                     first depth       second depth      between layers
///
///     light ──▶       █────┐            ┌────█            ┌──█─┐
///     a solid         █    │            │    █            │  █ │
///     from the side   █────┘            └────█            └──█─┘
/// ```
///
/// All compare alike: a point is lit where its depth is **at most** the stored one (≤). Wang & Molnar write ≤ in one of
/// their loops and < in the other; with <, a sheet, whose own depth is stored, would shadow itself wherever it is read
/// exactly. What differs is how far the stored depth lies from that of points next to it, which is what texels of finite
/// size and rounding eat into:
///
/// - **the lit side of a solid.** First depth stores it, so that it needs bias, or virtual samples where it is flat.
///   Second depth stores what lies the solid's thickness away, and between layers half of that: neither needs anything
///   where that is more than depth changes across the texels that a filter reads. Thinner plates, and edges that taper to
///   nothing, need virtual samples there too.
/// - **a sheet** has no thickness and is its own second surface: it is stored in first and in second depth, and virtual
///   samples are exact where it is flat ([`Sheet::is_flat`](crate::Sheet)). Curved, it needs bias. Between layers it
///   needs neither, as what is stored is halfway to what lies behind it.
/// - **sides turned away from the light.** Second depth stores them, so that they may come out lit or dark: they must be
///   made dark by their normals, as every shading model does. (A smooth normal that looks towards the light where the
///   face looks away is lit by it, in patches.)
///
/// # Where caster and receiver touch
///
/// A solid that stands on its receiver:
///
/// - **first depth** with a bias: the shadow begins as far from the contact as the bias is deep. It detaches. With
///   virtual samples on flat receivers no bias is needed, and it does not.
/// - **second depth**: what is stored beside the contact is the solid's far wall. It meets the receiver at the contact
///   and nowhere before, so that the shadow reaches it to within the texels that are read. The foot, at the receiver's own
///   depth, is stored below the solid, where nothing is seen; a filter that reads it from beside the solid finds the
///   receiver's own plane, which virtual samples pass by ≤.
/// - **between layers**: as first depth with a bias of half of the thickness, which shrinks to nothing at an edge.
///
/// A receiver that touches the far side of a caster, as a wall does the ceiling it carries: first depth has all of the
/// caster's thickness to spare. **Second depth leaks light** within about a texel of the contact, and where the receiver
/// reaches into the caster, as far as it does. Between layers half of the thickness is to spare.
///
/// A mesh with a hole that is drawn as if it were a solid lets **light through the hole** in second depth. That is why
/// what to leave out is decided by what the mesh is ([`Self::culling`]).
///
/// Source: Wang & Molnar, *Second-Depth Shadow Mapping*, UNC TR94-019, 1994. The middle of two layers: Woo, *The Shadow
/// Depth Map Revisited*, Graphics Gems III, 1992.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DepthTest {
    /// The surface next to the light (Williams 1978).
    #[default]
    First,
    /// The far side of solids, and sheets as they are.
    Second,
    /// Halfway between the first two surfaces along a ray, whatever they belong to: the map is drawn twice, the second
    /// time without what the first holds, and the two are averaged, where there is no second one with the depth that the
    /// map is cleared to. It asks nothing of the meshes.
    BetweenLayers,
}

/// Which faces a rasteriser leaves out of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Culling {
    /// None: both sides are drawn.
    None,
    /// Those that turn their front, the side from which they are counter-clockwise, to the light.
    Front,
    /// Those that turn their back to it.
    Back,
}

impl DepthTest {
    /// The faces to leave out of a mesh.
    ///
    /// First depth leaves out none. The light meets a front of a solid first, so the backs could go; but where a lamp, or
    /// the distance at which its map begins, lies inside the solid, backs are all there is to cast.
    ///
    /// ```
    /// use shadowfit::{Culling, DepthTest, Solidity};
    ///
    /// assert_eq!(DepthTest::Second.culling(Solidity::Solid), Culling::Front);
    /// assert_eq!(DepthTest::Second.culling(Solidity::InsideOut), Culling::Back);
    /// assert_eq!(DepthTest::Second.culling(Solidity::Open), Culling::None);
    /// ```
    #[must_use]
    pub const fn culling(self, solidity: Solidity) -> Culling {
        match (self, solidity) {
            (Self::First | Self::BetweenLayers, _) | (Self::Second, Solidity::Open) => Culling::None,
            (Self::Second, Solidity::Solid) => Culling::Front,
            (Self::Second, Solidity::InsideOut) => Culling::Back,
        }
    }
}
