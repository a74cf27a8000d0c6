//! Relaxing new particles: an affine field is no equilibrium of a disordered packing.

use crate::dynamics::State;
use crate::error::Result;
use crate::model::{Model, Numbering, Part, PointValue};
use crate::solve::statics;
use crate::work::Work;
use std::collections::BTreeSet;

/// Solves part `part` of `model` for equilibrium under the loads scaled by `factor` and the inertia of `state`, with its
/// supported and tied displacements held as they are, and writes displacements and rotations into `state`.
///
/// # Errors
/// As [`statics::solve`].
pub fn relax(model: &Model, part: usize, state: &mut State, factor: f64, mass: &[f64]) -> Result<Work> {
    let numbering = Numbering::new(model);
    let body = &model.parts[part];
    let dim = model.space.dim();
    let mut held = BTreeSet::new();
    for tie in &model.ties {
        for (index, face) in [&tie.first, &tie.second] {
            if *index == part {
                let components = if tie.rotations { body.dofs_per_point() } else { dim };
                let points = body.face(face).unwrap_or_default();
                held.extend(points.into_iter().flat_map(|p| (0..components).map(move |c| (p, c))));
            }
        }
    }
    held.extend(model.supports.iter().filter(|s| s.part == part).map(|s| (s.point, s.component)));
    let place = |point: usize, component: usize| numbering.unknown(part, point, component);
    let on = |point: usize, component: usize, value: f64| PointValue { part: 0, point, component, value };
    let supports = held.into_iter().map(|(p, c)| on(p, c, state.u[place(p, c)])).collect();
    let loads = model.loads.iter().filter(|l| l.part == part);
    let mut loads: Vec<PointValue> =
        loads.map(|l| PointValue { part: 0, value: factor * l.value, ..*l }).collect();
    for point in 0..body.positions().len() {
        for c in 0..body.dofs_per_point() {
            let i = place(point, c);
            loads.push(on(point, c, -mass[i] * state.a[i]));
        }
    }
    let parts: Vec<Part> = vec![body.clone()];
    let alone = Model { space: model.space, parts, ties: Vec::new(), supports, loads };
    let solution = statics::solve(&alone)?;
    let offset = numbering.offset(part);
    state.u[offset..offset + solution.u.len()].copy_from_slice(&solution.u);
    Ok(solution.work)
}
