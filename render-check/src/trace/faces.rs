//! The sides of triangles.

use shadowfit::{
    depth::{Culling, DepthTest},
    mesh::Solidity,
};

/// Which sides of triangles a ray can meet, or a map is drawn with, as the ray or the light sees them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Faces {
    /// Both.
    #[default]
    All,
    /// Only the fronts, which are counter-clockwise as the ray sees them.
    Front,
    /// Only the backs.
    Back,
    /// The far sides of solids, and both sides of sheets: second depth
    Second,
    /// Both, twice: the first two surfaces along a ray, tested against the middle of them
    Layers,
}

impl Faces {
    /// What a map leaves out of an object.
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
