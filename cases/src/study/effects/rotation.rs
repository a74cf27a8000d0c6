//! Whether rotations are finite, and whether they may be taken as small.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};
use crate::scene::dynamics::Rotations;

/// Rotations beyond this (rad) are no longer small: `1 − cos θ` is half a percent.
const LARGE_ROTATION: f64 = 0.1;

/// Finite rotation, on or off.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    let largest = solved.guard.seen.largest_rotation;
    if file.scene.dynamics.as_ref().is_some_and(|d| d.rotations == Rotations::Finite) {
        let why = format!("the scene asks for it; the largest rotation is {largest:.1e} rad");
        return on("finite-rotation", why, solved.solution.work.bond_updates);
    }
    if let Some(why) = &file.scene.linear {
        return off("finite-rotation", format!("the problem is posed in linear theory: {why}"));
    }
    let about = "the largest rotation of a particle or an element, in rad,".to_owned();
    watched("finite-rotation", Indicator { about, value: largest, limit: LARGE_ROTATION })
}
