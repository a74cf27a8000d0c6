//! What a defect does to a model, its solution, a plan in time, a network, or the matrix of a bond.

use seam_solver::coupling::Method;
use seam_solver::dem::network::Network;
use seam_solver::fem::elasticity::Hypothesis;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part};
use seam_solver::transfer::fields::Mode;

fn networks(model: &mut Model) -> impl Iterator<Item = &mut Network> {
    model.parts.iter_mut().filter_map(|part| match part {
        Part::Discrete { network, .. } => Some(network),
        Part::Continuum(_) => None,
    })
}

pub fn halve_ei(model: &mut Model) {
    networks(model)
        .flat_map(|n| &mut n.bonds.stiffness)
        .for_each(|k| (k.ks, k.kb) = (0.5 * k.ks, 0.5 * k.kb));
}

pub fn halve_bending(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.stiffness).for_each(|k| k.kb *= 0.5);
}

pub fn halve_shear(network: &mut Network) {
    network.bonds.stiffness.iter_mut().for_each(|k| k.ks *= 0.5);
}

/// Of the moment on the first particle due to its own deflection.
pub fn flip_moment(k: &mut [[f64; 12]; 12]) {
    k[1][5] = -k[1][5];
    k[2][4] = -k[2][4];
}

/// The same, symmetric.
pub fn flip_moments(k: &mut [[f64; 12]; 12]) {
    for (deflection, rotation) in [(1, 5), (2, 4)] {
        k[deflection][rotation] = -k[deflection][rotation];
        k[rotation][deflection] = -k[rotation][deflection];
    }
}

pub fn skip_weights(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.weight).for_each(|w| *w = 1.0);
}

pub fn skip_one_weight(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.weight).filter(|w| **w < 1.0).take(1).for_each(|w| *w = 1.0);
}

pub fn drop_one_tie(model: &mut Model) {
    model.ties.pop();
}

pub fn drop_ties(model: &mut Model) {
    model.ties.clear();
}

pub fn pointwise(model: &mut Model) {
    model.ties.iter_mut().for_each(|tie| tie.method = Method::Pointwise);
}

pub fn swap_corners(model: &mut Model) {
    swap(model, |face| Some((*face.first()?, *face.last()?)));
}

pub fn swap_inside(model: &mut Model) {
    swap(model, |face| Some((*face.get(1)?, *face.get(2)?)));
}

fn swap(model: &mut Model, two: impl Fn(&[usize]) -> Option<(usize, usize)>) {
    for network in networks(model) {
        if let Some((a, b)) = network.faces.get("left").and_then(|face| two(face)) {
            network.particles.position.swap(a, b);
        }
    }
}

fn elements(model: &mut Model, change: impl Fn(&mut seam_solver::fem::continuum::Continuum)) {
    for part in &mut model.parts {
        if let Part::Continuum(body) = part {
            change(body);
        }
    }
}

pub fn kilopascals(model: &mut Model) {
    elements(model, |body| body.elasticity.young_pa *= 1e-3);
}

pub fn forget_poisson(model: &mut Model) {
    elements(model, |body| body.elasticity.poisson = 0.0);
}

pub fn plane_strain(model: &mut Model) {
    elements(model, |body| {
        let thickness_m = body.hypothesis.thickness();
        body.hypothesis = Hypothesis::PlaneStrain { thickness_m };
    });
}

pub fn plain(model: &mut Model) {
    elements(model, |body| body.formulation = Formulation::Plain);
}

pub fn lose_load(model: &mut Model) {
    // Forces of zero are loads too.
    if let Some(at) = model.loads.iter().rposition(|load| load.value != 0.0) {
        model.loads.remove(at);
    }
}

pub fn flip_loads(model: &mut Model) {
    model.loads.iter_mut().for_each(|load| load.value = -load.value);
}

pub fn move_support(model: &mut Model) {
    if let Some(support) = model.supports.iter_mut().find(|support| support.value != 0.0) {
        support.value *= 1.1;
    }
}

/// The one that moves most.
pub fn stale(_: &Model, solution: &mut seam_solver::solve::statics::Solution) {
    if let Some(u) = solution.u.iter_mut().max_by(|a, b| a.abs().total_cmp(&b.abs())) {
        *u = 0.0;
    }
}

pub fn mode(plan: &mut seam_solver::simulation::Plan, mode: Mode) {
    plan.switches.iter_mut().for_each(|switch| switch.mode = mode);
}

pub fn lose_mass(network: &mut Network) {
    network.particles.mass.iter_mut().for_each(|m| *m *= 0.99);
}
