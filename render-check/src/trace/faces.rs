//! Faces of triangles.

use shadowfit::{
    depth::{Culling, DepthTest},
    mesh::Solidity,
};

/// Which faces of triangles rays hit, or a map holds, as seen along the ray or from the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Faces {
    /// Both.
    #[default]
    All,
    /// Front faces, which are counter-clockwise
    Front,
    /// Back faces
    Back,
    /// Second depth: the back faces of watertight meshes, and both faces of open ones
    Second,
    /// The first two surfaces along a ray; tests use their midpoint
    Layers,
}

impl Faces {
    /// The culling of an object drawn into a map.
    #[must_use]
    pub fn culling(self, solidity: Solidity) -> Culling {
        match self {
            Self::All => DepthTest::First.culling(solidity),
            Self::Front => Culling::Back,
            Self::Back => Culling::Front,
            Self::Second => DepthTest::Second.culling(solidity),
            Self::Layers => DepthTest::BetweenLayers.culling(solidity),
        }
    }
}
