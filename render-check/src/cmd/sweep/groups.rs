//! The groups of a sweep.

use anyhow::Result;

use super::cases::{
    cascades, clip_spaces, far_planes, filters, flat, lights_inside, open_sheets, paraboloids, points, scales,
    sizes, solids, stable, street, virtual_samples,
};
use super::faults::{far_off, faults, from_the_origin};
use super::lights::{lamps_through_the_plane, suns_across, through_the_back};
use super::shot::{Shot, Stand, chess_board, lit_chess_board};
use super::surfaces::through_surfaces;

/// Cases that belong together.
pub struct Group {
    /// A name without spaces.
    pub name: &'static str,
    /// Builds the cases; fails where a scene has no camera that sees it.
    pub shots: fn() -> Result<Vec<Shot>>,
}

/// All groups.
pub const GROUPS: [Group; 24] = [
    Group {
        name: "classes-of-suns",
        shots: || Ok(vec![chess_board()?.shot("arc", suns_across)?.warped().and_stable()]),
    },
    Group {
        name: "classes-of-lamps",
        shots: || Ok(vec![chess_board()?.shot("line", lamps_through_the_plane)?.warped()]),
    },
    Group {
        name: "through-the-back",
        shots: || Ok(vec![chess_board()?.shot("viewer's back", through_the_back)?.warped()]),
    },
    Group { name: "behind-the-eye", shots: || Ok(vec![Stand::built_in("behind")?.own_lights("figure")?.warped()]) },
    Group { name: "lights-inside", shots: lights_inside },
    Group { name: "paraboloids", shots: paraboloids },
    Group { name: "flat", shots: flat },
    Group { name: "stable", shots: stable },
    Group { name: "cascades", shots: cascades },
    Group { name: "far-planes", shots: far_planes },
    Group { name: "scales", shots: scales },
    Group { name: "clip-spaces", shots: || Ok(vec![lit_chess_board()?.with_options(clip_spaces())]) },
    Group { name: "sizes", shots: || Ok(vec![lit_chess_board()?.with_options(sizes())]) },
    Group { name: "filters", shots: || Ok(vec![lit_chess_board()?.with_options(filters())]) },
    Group { name: "street", shots: street },
    Group { name: "leaves", shots: || Ok(vec![Stand::built_in("leaves")?.own_lights("leaves")?]) },
    Group {
        name: "table",
        shots: || Ok(vec![Stand::built_in("table")?.own_lights("table")?.with_options(solids())]),
    },
    Group { name: "open-sheets", shots: open_sheets },
    Group { name: "virtual", shots: virtual_samples },
    Group {
        name: "points",
        shots: || Ok(vec![Stand::built_in("cloud")?.own_lights("cloud")?.with_options(points())]),
    },
    Group { name: "faults", shots: faults },
    Group { name: "far-off", shots: far_off },
    Group { name: "from-the-origin", shots: from_the_origin },
    Group { name: "through-surfaces", shots: through_surfaces },
];
