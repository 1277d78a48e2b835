//! Damaged scenes, and scenes far from the origin in f32.

use anyhow::Result;
use shadowfit::Origin;
use shadowfit::glam::DVec3;

use super::shot::{EXTREMES, MAP_SIZE, Shot, Stand};
use crate::gpu::Filter;
use crate::maps::Technique;
use crate::run::Options;
use crate::scene::damage::{Fault, damaged, in_single_precision};
use crate::trace::Faces;

/// Every kind of damage in two scenes, after the same scene undamaged. Damaged objects are no longer watertight, so
/// second depth is drawn with virtual samples, which do not need watertight objects.
pub(super) fn faults() -> Result<Vec<Shot>> {
    let second =
        Options { faces: Faces::Second, filter: Filter::Virtual(2), ..Options::new(Technique::Uniform, MAP_SIZE) };
    let [uniform, psm, best] = EXTREMES.map(|technique| Options::new(technique, MAP_SIZE));
    let mut shots = Vec::new();
    for name in ["chess-board", "street"] {
        let sound = Stand::built_in(name)?;
        shots.push(Stand::before(sound.scene.clone())?.own_lights(&format!("{name}, sound"))?);
        for fault in Fault::ALL {
            let stand = Stand::before(damaged(&sound.scene, fault))?;
            shots.push(stand.own_lights(&format!("{name}, {}", fault.words()))?);
        }
    }
    Ok(shots.into_iter().map(|shot| shot.with_options(vec![uniform, psm, best, second])).collect())
}

/// Millimetres in a unit of the chess board.
const MILLIMETRES: f64 = 1e3;

/// The chess board in millimetres, a kilometre and a thousand kilometres from the origin, with vertices in f32 as
/// in files: drawn relative to the eye, drawn in world space, and, for comparison, the same rounded shape drawn at
/// the origin.
pub(super) fn far_off() -> Result<Vec<Shot>> {
    let mut options = [Technique::Uniform, Technique::Psm, Technique::Best, Technique::Cube]
        .map(|way| Options::new(way, MAP_SIZE))
        .to_vec();
    options.push(Options { filter: Filter::Pcf(3), ..options[0] });
    let mut shots = Vec::new();
    for (words, distance) in [("1e6 mm", 1e6), ("1e9 mm", 1e9)] {
        // Multiples of the f32 step at that distance, so that moving back is exact.
        let offset = distance * DVec3::new(1.0, -0.3, 0.7);
        let far = in_single_precision(&Stand::built_in("chess-board")?.scene.moved(MILLIMETRES, offset));
        let home = far.moved(1.0, -offset);
        shots.push(Stand::before(home)?.own_lights(&format!("rounded at {words}, at home"))?);
        shots.push(Stand::before(far.clone())?.own_lights(&format!("{words}, about the eye"))?);
        let in_world = Stand::before(far)?.own_lights(&format!("{words}, in world space"))?;
        shots.push(Shot { origin: Origin::World, ..in_world });
    }
    Ok(shots.into_iter().map(|shot| shot.with_options(options.clone())).collect())
}

/// The chess board a hundred metres to a hundred kilometres from the origin, its vertices in f32, with maps, casters and
/// receivers in world space.
pub(super) fn from_the_origin() -> Result<Vec<Shot>> {
    let options = [Technique::Uniform, Technique::Best, Technique::Cube].map(|way| Options::new(way, MAP_SIZE));
    let shot = |distance: f64| {
        let offset = distance * DVec3::new(1.0, -0.3, 0.7);
        let far = in_single_precision(&Stand::built_in("chess-board")?.scene.moved(1.0, offset));
        let shot = Stand::before(far)?.own_lights(&format!("{distance:e} m from the origin, in world space"))?;
        Ok(Shot { origin: Origin::World, ..shot.with_options(options.to_vec()) })
    };
    [1e2, 1e3, 1e4, 1e5].into_iter().map(shot).collect()
}
