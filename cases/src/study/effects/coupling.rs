//! Whether ties hold rotations, and whether the two sides turn alike without.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};
use seam_solver::coupling::{Row, assemble};
use seam_solver::model::{Model, Part};
use seam_solver::space::Vec3;
use std::collections::BTreeMap;

/// A tie across which particles turn this much differently, as a share of how far the model turns, is a hinge.
const LARGE_MISMATCH: f64 = 0.1;

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
            let about =
                "how differently the two sides of a tie turn, over how far the model turns,".to_owned();
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

/// Mean turn of one side of a tie against the other, the largest of all ties and axes, over the largest rotation of the model or
/// over its largest displacement per extent, whichever is larger. The mean, since particles of a disordered packing turn to and
/// fro by themselves; the displacement, since a model that is only stretched turns by rounding. `None` without particles at the
/// ties, and at rest.
fn mismatch(solved: &Solved) -> Option<f64> {
    let mut coupled = solved.built.model.clone();
    coupled.ties.iter_mut().for_each(|tie| tie.rotations = true);
    let mut turns: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for row in rotation_rows(&coupled, solved) {
        let turning = row.terms.iter().filter(|(i, _)| is_rotation(&coupled, solved, *i));
        // A row weighs rotations with a length.
        let weight: f64 = turning.map(|(_, b)| b.abs()).sum();
        let jump: f64 = row.terms.iter().map(|(i, b)| b * solved.solution.u[*i]).sum();
        if weight > 0.0 {
            turns.entry(tie_and_axis(&row)).or_default().push(jump / weight);
        }
    }
    let mean = |jumps: &Vec<f64>| (jumps.iter().sum::<f64>() / jumps.len() as f64).abs();
    let widest = turns.values().map(mean).reduce(f64::max)?;
    let scale = solved.guard.seen.largest_rotation.max(displacement_per_extent(solved));
    (scale > 0.0).then_some(widest / scale)
}

/// Name of the tie and of the rotation that a row holds.
fn tie_and_axis(row: &Row) -> String {
    let tie = row.label.split('\'').nth(1).unwrap_or_default();
    let axis = row.label.rsplit(", ").next().unwrap_or_default();
    format!("{tie} {axis}")
}

/// Largest displacement over the diagonal of the box around the model.
fn displacement_per_extent(solved: &Solved) -> f64 {
    let model = &solved.built.model;
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let mut largest = 0.0f64;
    for (p, part) in model.parts.iter().enumerate() {
        for (k, x) in part.positions().iter().enumerate() {
            (low, high) = (low.inf(x), high.sup(x));
            largest = largest.max(solved.solution.displacement(model, p, k).norm());
        }
    }
    let extent = (high - low).norm();
    if extent > 0.0 { largest / extent } else { 0.0 }
}

fn is_rotation(model: &Model, solved: &Solved, unknown: usize) -> bool {
    let (part, _, component) = solved.solution.numbering.locate(unknown);
    matches!(model.parts[part], Part::Discrete { .. }) && component >= model.space.dim()
}
