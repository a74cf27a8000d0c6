//! What is watched over a run so that effects which were left out can be missed.

use crate::error::Result;
use crate::file::SceneFile;
use crate::model::{Built, switches_left_out};
use crate::observe::curve::nan_max;
use seam_solver::dem::network::Network;
use seam_solver::failure::Failure;
use seam_solver::fem::continuum::Continuum;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::Vec3;
use seam_solver::transfer::criterion::Criterion;
use serde::{Deserialize, Serialize};

/// The largest values over all outputs.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct Seen {
    /// Of particles and of elements at their centres, in rad.
    pub largest_rotation: f64,
    /// Of the switches that were left out: indicator over trigger, or load or time over that of the switch.
    pub nearest_switch: Option<f64>,
    /// Of the bonds whose strength was left out: stress over strength.
    pub largest_demand: Option<f64>,
    /// Strain energy, in J.
    pub strain: f64,
    /// Energy that broken pairs which have closed would hold if they were bonds, in J: `Σ ½ k_n δ²`.
    pub closed: f64,
    /// Gap of the ties, in m.
    pub gap: f64,
    /// Displacement of a point along an axis beside the mean of all points, in m: a body that flies is not deformed by it.
    pub displacement: f64,
}

/// Watches a run.
#[derive(Debug, Clone, Default)]
pub struct Guard {
    /// What it has seen.
    pub seen: Seen,
    left_out: Vec<LeftOut>,
    /// Strengths that were left out, with the part of each.
    laws: Vec<(usize, Failure)>,
    demands: Vec<f64>,
}

/// A switch that was left out.
#[derive(Debug, Clone)]
pub enum LeftOut {
    /// Body of elements, and what would choose among them.
    Criterion(String, Criterion),
    /// Load factor.
    AtLoad(f64),
    /// Time, in s.
    AtTime(f64),
}

impl Guard {
    /// Nothing seen yet.
    ///
    /// # Errors
    /// A switch that was left out and is not sound.
    pub fn new(file: &SceneFile, built: &Built) -> Result<Self> {
        Ok(Self { left_out: switches_left_out(file)?, laws: built.laws_left_out.clone(), ..Self::default() })
    }

    /// Looks at a state with its strain energy, in J; time in s.
    ///
    /// # Errors
    /// An inverted element.
    pub fn watch(
        &mut self,
        model: &Model,
        u: &[f64],
        strain: f64,
        [time, factor]: [f64; 2],
    ) -> seam_solver::error::Result<()> {
        let numbering = Numbering::new(model);
        for (p, part) in model.parts.iter().enumerate() {
            let first = numbering.offset(p);
            let turned = match part {
                Part::Continuum(body) => of_elements(body, &u[first..first + body.dof_count()]),
                Part::Discrete { .. } => of_particles(model, part, &u[first..]),
            };
            self.seen.largest_rotation = self.seen.largest_rotation.max(turned);
        }
        self.seen.strain = self.seen.strain.max(strain);
        self.watch_pairs(networks(model), &numbering, u, 1.0);
        for (part, law) in &self.laws {
            let Some(Part::Discrete { network, .. }) = model.parts.get(*part) else { continue };
            law.demands_at(network, &u[numbering.offset(*part)..], &mut self.demands);
            let largest = self.demands.iter().fold(0.0, |m, d| nan_max(m, *d));
            self.seen.largest_demand =
                Some(self.seen.largest_demand.map_or(largest, |m| nan_max(m, largest)));
        }
        for left_out in &self.left_out {
            let near = match left_out {
                LeftOut::AtLoad(level) => factor / level,
                LeftOut::AtTime(at) => time / at,
                LeftOut::Criterion(name, criterion) => nearest(model, &numbering, u, name, criterion)?,
            };
            self.seen.nearest_switch = Some(self.seen.nearest_switch.map_or(near, |before| before.max(near)));
        }
        Ok(())
    }

    /// Looks at how far the ties of a motion have opened so far, in m.
    pub fn watch_ties(&mut self, model: &Model, u: &[f64], widest_gap: f64) {
        let (dim, numbering) = (model.space.dim(), Numbering::new(model));
        let along = |axis: usize| {
            let parts = model.parts.iter().enumerate();
            parts.flat_map(move |(p, part)| (0..part.positions().len()).map(move |point| (p, point, axis)))
        };
        for axis in 0..dim {
            let of = |(p, point, axis)| u[numbering.unknown(p, point, axis)];
            let (sum, points) = along(axis).fold((0.0, 0.0), |(sum, n), at| (sum + of(at), n + 1.0));
            let apart = along(axis).map(|at| (of(at) - sum / points).abs());
            self.seen.displacement = apart.fold(self.seen.displacement, nan_max);
        }
        self.seen.gap = nan_max(self.seen.gap, widest_gap);
    }

    /// Looks at a state of a path that cracks: `factor` times the motion `u`, with its strain energy in J.
    pub fn watch_crack(
        &mut self,
        model: &Model,
        numbering: &Numbering,
        u: &[f64],
        [factor, strain]: [f64; 2],
    ) {
        self.seen.strain = self.seen.strain.max(strain);
        self.watch_pairs(networks(model), numbering, u, factor);
    }

    /// Looks at what has become of broken pairs of networks, given with their parts, at `factor` times the motion `u`.
    pub fn watch_pairs<'a>(
        &mut self,
        networks: impl Iterator<Item = (usize, &'a Network)>,
        numbering: &Numbering,
        u: &[f64],
        factor: f64,
    ) {
        let energy =
            networks.map(|(part, network)| closed(network, &u[numbering.offset(part)..])).sum::<f64>();
        self.seen.closed = self.seen.closed.max(factor * factor * energy);
    }
}

/// Networks of a model with their parts.
fn networks(model: &Model) -> impl Iterator<Item = (usize, &Network)> {
    model.parts.iter().enumerate().filter_map(|(p, part)| match part {
        Part::Discrete { network, .. } => Some((p, network)),
        Part::Continuum(_) => None,
    })
}

/// `Σ ½ k_n δ²` over the broken pairs that are closer than they were, by δ along the line between them; `u` are the unknowns of the
/// network.
fn closed(network: &Network, u: &[f64]) -> f64 {
    let (dim, each) = (network.space.dim(), network.space.dofs_per_particle());
    let bonds = &network.bonds;
    let mut energy = 0.0;
    for b in (0..bonds.len()).filter(|&b| bonds.weight[b] == 0.0) {
        let [i, j] = bonds.ends[b];
        let n = (network.particles.position[j] - network.particles.position[i]).normalize();
        let by: f64 = (0..dim).map(|c| n[c] * (u[i * each + c] - u[j * each + c])).sum();
        energy += 0.5 * bonds.stiffness[b].kn * by.max(0.0).powi(2);
    }
    energy
}

fn of_particles(model: &Model, part: &Part, u: &[f64]) -> f64 {
    let (dim, each) = (model.space.dim(), part.dofs_per_point());
    let turned =
        |point: usize| u[point * each + dim..(point + 1) * each].iter().map(|r| r * r).sum::<f64>().sqrt();
    (0..part.positions().len()).map(turned).fold(0.0, f64::max)
}

/// Largest `½ |curl u|` at the centres of the elements.
fn of_elements(body: &Continuum, u: &[f64]) -> f64 {
    let mesh = &body.mesh;
    let dim = mesh.space.dim();
    let turned = |cell: usize| {
        let sample = mesh.sample(cell, [0.0; 3]);
        let curl = mesh.cell(cell).iter().zip(&sample.gradients).map(|(&node, gradient)| {
            let mut own = Vec3::zeros();
            (0..dim).for_each(|c| own[c] = u[node * dim + c]);
            gradient.cross(&own)
        });
        0.5 * curl.sum::<Vec3>().norm()
    };
    (0..mesh.cell_count()).map(turned).fold(0.0, f64::max)
}

/// Largest indicator over its trigger.
fn nearest(
    model: &Model,
    numbering: &Numbering,
    u: &[f64],
    name: &str,
    criterion: &Criterion,
) -> seam_solver::error::Result<f64> {
    let mut largest = 0.0f64;
    for (p, part) in model.parts.iter().enumerate() {
        if let Part::Continuum(body) = part
            && body.name == name
        {
            let first = numbering.offset(p);
            let values = criterion.values(body, &u[first..first + body.dof_count()])?;
            largest = values.into_iter().fold(largest, f64::max);
        }
    }
    Ok(largest / criterion.trigger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::model;

    /// What moves as a whole is no measure of a gap.
    #[test]
    fn flying_is_not_deforming() {
        let file = catalogue::case("clamped-beam-rotation", &[]).unwrap();
        let built = model::build(&file).unwrap();
        let numbering = Numbering::new(&built.model);
        let mut u = vec![0.0; numbering.len()];
        for (p, part) in built.model.parts.iter().enumerate() {
            (0..part.positions().len()).for_each(|point| u[numbering.unknown(p, point, 0)] = 7.0);
        }
        let mut guard = Guard::new(&file, &built).unwrap();
        guard.watch_ties(&built.model, &u, 1e-3);
        assert!(guard.seen.displacement < 1e-12 && guard.seen.gap == 1e-3, "{:?}", guard.seen);
        // One point moves on by itself.
        u[numbering.unknown(0, 0, 1)] = 2.0;
        guard.watch_ties(&built.model, &u, 0.0);
        assert!((1.9..2.0).contains(&guard.seen.displacement) && guard.seen.gap == 1e-3, "{:?}", guard.seen);
    }

    /// A small rigid rotation turns elements and particles by just its angle.
    #[test]
    fn a_rigid_rotation_is_seen_by_both_sides() {
        let file = catalogue::case("clamped-beam-rotation", &[]).unwrap();
        let built = model::build(&file).unwrap();
        let model = &built.model;
        let numbering = Numbering::new(model);
        let angle = 0.03;
        let mut u = vec![0.0; numbering.len()];
        for (p, part) in model.parts.iter().enumerate() {
            for (k, x) in part.positions().iter().enumerate() {
                u[numbering.unknown(p, k, 0)] = -angle * x.y;
                u[numbering.unknown(p, k, 1)] = angle * x.x;
                if matches!(part, Part::Discrete { .. }) {
                    u[numbering.unknown(p, k, 2)] = angle;
                }
            }
        }
        for only in 0..model.parts.len() {
            let mut alone = model.clone();
            alone.ties.clear();
            alone.parts = vec![model.parts[only].clone()];
            let first = numbering.offset(only);
            let mut guard = Guard::new(&file, &built).unwrap();
            guard.watch(&alone, &u[first..], 0.0, [0.0, 1.0]).unwrap();
            let seen = guard.seen.largest_rotation;
            assert!((seen - angle).abs() < 1e-12, "{only}: {seen}");
        }
    }
}
