//! Which surface of a caster a shadow map holds.

use crate::mesh::Solidity;

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
///   Second depth stores what lies the solid's thickness away, and needs nothing where that is more than depth changes
///   across the texels that a filter reads. Thinner plates, and edges that taper to nothing, need virtual samples there
///   too. Between layers it is half of the way to whatever is next, which need not be the solid's own far side: of two
///   slabs that reach into each other it may be the top of the lower one, a hair below.
/// - **a sheet** has no thickness and is its own second surface: it is stored in first and in second depth, and virtual
///   samples are exact where it is flat ([`OpenShape::is_flat`](crate::mesh::OpenShape)). Curved, it needs bias. Between layers it
///   needs neither where what lies behind it is far enough away; where sheets meet or cross, that is nowhere.
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
///   receiver's own plane, which virtual samples pass by ≤. So does it from within the shadow: a pixel for which half of
///   what is read is foot is lit. Likewise in a crease between two solids or two faces of one: the receiver's plane goes
///   on into the other side, and there it lies before the far wall. Both make the shadow begin up to half of the filter
///   from the contact: 0.02 to 0.07 % of a chess board's pixels under maps of 512², and nothing else was found wrong in it.
/// - **between layers**: as first depth with a bias of half of the thickness, which shrinks to nothing at an edge: there
///   the solid shadows itself.
///
/// A receiver that touches the far side of a caster, as a wall does the ceiling it carries: first depth has all of the
/// caster's thickness to spare. **Second depth leaks light** within about a texel of the contact, and where the receiver
/// reaches into the caster, as far as it does. Between layers half of the thickness is to spare.
///
/// # Between layers does not pay
///
/// Everything that is seen must be drawn for it: a receiver that is not drawn is no layer, and under a single sheet it is
/// lit down to halfway between the sheet and the far end of the map. Where there is no second layer the texel's middle sees
/// one surface, which is lit, but for the deepest rows of a map: the far end is no farther from them than depth changes
/// across a texel.
///
/// In percent of the pixels, false shadow and false light together, uniform maps of 1024², all lights of a scene; the
/// first depth with the bias of [`ShadowMap::bias`](crate::ShadowMap::bias), the others without any. Virtual samples are over 2 × 2
/// texels:
///
/// | scene | first depth, bias | between layers | second depth, virtual samples | 3 × 3: first, bias | 3 × 3: between layers |
/// |---|---|---|---|---|---|
/// | a plate alone | 0.000 | 0.012 | 0.000 | 0.000 | 0.014 |
/// | leaves over paving | 0.033 | 0.110 | 0.006 | 0.052 | 0.026 |
/// | a table | 0.102 | 0.128 | 0.000 | 0.023 | 0.103 |
/// | a street | 0.152 | 13.9 | 0.001 | 0.028 | 10.6 |
/// | a chess board | 0.071 | 0.243 | 0.041 | 0.008 | 0.083 |
/// | Sponza, from the inside | 0.344 | 0.321 | 0.002 | 0.150 | 0.043 |
/// | ivy | 0.164 | 0.426 | 0.000 | 0.126 | 0.028 |
/// | a vase with flowers | 0.230 | 0.517 | 0.000 | 0.050 | 0.285 |
/// | a garden | 0.286 | 0.353 | 0.000 | 0.030 | 0.256 |
///
/// The street's road lies 5 cm above the ground that it is laid in, less than depth changes across half a texel. At 512²
/// the leaves' paving does the same: 3.9, and 17 in a warped map. All that it wins against is a bias under a wide filter
/// among leaves and curtains, and there virtual samples are better still, at one pass in place of two. They are from
/// `render-check SCENE --technique uniform --size 1024 --faces layers`, with `--filter pcf3` for 3 × 3, and with
/// `--faces second --filter virtual2` for the others. [`plan`](crate::plan) never asks for it.
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
    /// map is cleared to. It asks nothing of the meshes but that all that is seen is drawn, and pays nowhere where virtual
    /// samples can be had, see above. The shader functions of the `wgsl` feature do both halves of it.
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
    /// use shadowfit::{depth::{Culling, DepthTest}, mesh::Solidity};
    ///
    /// assert_eq!(DepthTest::Second.culling(Solidity::Watertight), Culling::Front);
    /// assert_eq!(DepthTest::Second.culling(Solidity::Inverted), Culling::Back);
    /// assert_eq!(DepthTest::Second.culling(Solidity::Open), Culling::None);
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
