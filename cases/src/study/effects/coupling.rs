//! Whether ties hold rotations, and whether the two sides turn alike without.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};
use seam_solver::coupling::{Row, assemble};
use seam_solver::model::{Model, Part};

/// A tie across which particles turn this much differently, as a share of the largest rotation, is a hinge.
const LARGE_MISMATCH: f64 = 0.25;

const NAME: &str = "rotation-coupling";

/// Rotation coupling, on or off.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    let scene = &file.scene;
    let asked = scene.ties.values().any(|tie| tie.rotations)
        || scene.switches.values().any(|switch| switch.ties.rotations);
    if !asked {
        return left_out(solved);
    }
    // A model that has run with these ties can have them made.
    let tied = match solved.course.is_some() || solved.cracked.is_some() {
        false => solved.solution.multipliers.iter().filter(|(row, _)| holds_rotation(row)).count(),
        true => rotation_rows(&solved.built.model, solved).len(),
    };
    on(NAME, "a tie asks for it", tied as u64)
}

fn left_out(solved: &Solved) -> EffectUse {
    if solved.built.model.ties.is_empty() {
        return off(NAME, "there is no tie");
    }
    match mismatch(solved) {
        Some(value) => {
            let about = "how differently the two sides of a tie turn, over the largest rotation,".to_owned();
            watched(NAME, Indicator { about, value, limit: LARGE_MISMATCH })
        }
        None => off(NAME, "no tie asks for it, and nothing turns at the ties"),
    }
}

fn holds_rotation(row: &Row) -> bool {
    row.label.contains('θ')
}

fn rotation_rows(model: &Model, solved: &Solved) -> Vec<Row> {
    let rows = assemble::rows(model, &solved.solution.numbering).unwrap_or_default();
    rows.into_iter().filter(holds_rotation).collect()
}

/// Largest gap of the rows that would hold rotations, in rad, over the largest rotation of the model. `None` without particles at
/// the ties, and at rest.
fn mismatch(solved: &Solved) -> Option<f64> {
    let mut coupled = solved.built.model.clone();
    coupled.ties.iter_mut().for_each(|tie| tie.rotations = true);
    let largest = solved.guard.largest_rotation;
    let gap = |row: &Row| {
        let turning = row.terms.iter().filter(|(i, _)| is_rotation(&coupled, solved, *i));
        // A row weighs rotations with a length.
        let weight: f64 = turning.map(|(_, b)| b.abs()).sum();
        let jump: f64 = row.terms.iter().map(|(i, b)| b * solved.solution.u[*i]).sum();
        (weight > 0.0).then_some(jump.abs() / weight)
    };
    let rows = rotation_rows(&coupled, solved);
    let widest = rows.iter().filter_map(gap).reduce(f64::max)?;
    (largest > 0.0).then_some(widest / largest)
}

fn is_rotation(model: &Model, solved: &Solved, unknown: usize) -> bool {
    let (part, _, component) = solved.solution.numbering.locate(unknown);
    matches!(model.parts[part], Part::Discrete { .. }) && component >= model.space.dim()
}
