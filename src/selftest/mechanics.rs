//! Defects of mechanics: done to a model, its solution, a run in time, a network, or the matrix of a bond.

use super::{Seeded, Spoil, Trial};
use seam_cases::defect::Defect;
use seam_reports::exit::Exit;
use seam_solver::coupling::Method;
use seam_solver::dem::network::Network;
use seam_solver::fem::elasticity::Hypothesis;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part};
use seam_solver::transfer::fields::Mode;

const PATCH: Trial = Trial::of("patch-coupled");
const LATTICE: Trial = Trial::of("patch-lattice");
const ELEMENTS: Trial = Trial::of("patch-fe");
const CANTILEVER: Trial = Trial::of("timoshenko-goodier");
const CALCULIX: Trial = Trial::of("calculix-elements");
const BONDS: Trial = Trial::of("bond-for-bond-static");
const TRANSFER: Trial = Trial {
    case: "ramp-transfer",
    sets: &["parameters.rows=4", "parameters.ramp_periods=1"],
    part: super::Part::Quantities(&["energy-jump-velocity", "momentum-jump"]),
};

pub const DEFECTS: &[Seeded] = &[
    seeded(
        "halve-ei",
        "EI of every bond is halved",
        BONDS,
        Defect::Model(halve_ei),
        "triangular-yade-displacement",
    ),
    seeded(
        "halve-bending",
        "bonds bend half as stiffly, shear as before",
        BONDS,
        Defect::Model(halve_bending),
        "rotation",
    ),
    seeded(
        "halve-shear",
        "lattice bonds shear half as stiffly",
        Trial::of("lattice-constants"),
        Defect::Network(halve_shear),
        "triangular",
    ),
    seeded(
        "flip-moment",
        "a moment of the bond has the wrong sign",
        Trial::of("bond-matrix"),
        Defect::Bond(flip_moment),
        "symmetry",
    ),
    seeded(
        "flip-moments",
        "both moments of a deflection have the wrong sign",
        Trial::of("bond-matrix"),
        Defect::Bond(flip_moments),
        "matrix",
    ),
    seeded(
        "skip-skin-weights",
        "skin bonds carry their whole stiffness",
        LATTICE,
        Defect::Model(skip_weights),
        "tension-and-shear",
    ),
    seeded(
        "skip-one-skin-weight",
        "one skin bond carries its whole stiffness",
        LATTICE,
        Defect::Model(skip_one_weight),
        "tension",
    ),
    seeded(
        "drop-multipliers",
        "one interface has no Λ",
        PATCH,
        Defect::Model(drop_one_tie),
        "tension-nested",
    ),
    refused("drop-all-multipliers", "no interface has Λ", PATCH, Defect::Model(drop_ties), "is free to move"),
    seeded(
        "pointwise-for-mortar",
        "a mortar tie is made point by point",
        PATCH,
        Defect::Model(pointwise),
        "tension-mortar",
    ),
    refused(
        "swap-interface-nodes",
        "two particles of an interface change places",
        PATCH,
        Defect::Model(swap_interface),
        "constraint 'tie 'left'",
    ),
    seeded(
        "wrong-modulus",
        "the elements' modulus is in kPa",
        CANTILEVER,
        Defect::Model(kilopascals),
        "tip-deflection",
    ),
    seeded(
        "forget-poisson",
        "the elements have ν = 0",
        ELEMENTS,
        Defect::Model(forget_poisson),
        "shear-stress",
    ),
    seeded(
        "plane-strain",
        "plane strain instead of plane stress",
        CANTILEVER,
        Defect::Model(plane_strain),
        "tip-deflection",
    ),
    seeded(
        "locking-elements",
        "plain elements instead of incompatible ones",
        CANTILEVER,
        Defect::Model(plain),
        "displacement-error",
    ),
    seeded(
        "lose-a-load",
        "the last nodal force is lost",
        CALCULIX,
        Defect::Model(lose_load),
        "calculix-elements / q4",
    ),
    seeded(
        "flip-loads",
        "loads push where they should pull",
        CANTILEVER,
        Defect::Model(flip_loads),
        "tip-deflection",
    ),
    seeded(
        "move-a-support",
        "one prescribed displacement is off by a tenth",
        ELEMENTS,
        Defect::Model(move_support),
        "displacement-error",
    ),
    unmeasured(
        "nan-in-a-solution",
        "one displacement is not a number",
        PATCH,
        Defect::Solution(|_, s| s.u[0] = f64::NAN),
        "patch-coupled / ",
    ),
    seeded(
        "stale-displacement",
        "one displacement was not updated",
        PATCH,
        Defect::Solution(stale),
        "tension-nested",
    ),
    seeded(
        "zero-transferred-rotations",
        "particles take over no rotation",
        TRANSFER,
        Defect::Plan(|plan| mode(plan, Mode::Displacement)),
        "energy-jump-velocity",
    ),
    seeded(
        "zero-transferred-velocities",
        "particles take over no velocity",
        TRANSFER,
        Defect::Plan(|plan| mode(plan, Mode::Rotation)),
        "momentum-jump",
    ),
    refused(
        "lose-mass",
        "particles weigh less than the elements that went",
        TRANSFER,
        Defect::Network(lose_mass),
        "its mass is",
    ),
];

/// Caught by a number outside of its interval.
const fn seeded(
    name: &'static str,
    about: &'static str,
    trial: Trial,
    defect: Defect,
    by: &'static str,
) -> Seeded {
    Seeded { name, about, trial, spoil: Spoil::Run(defect), exit: Exit::Failed, by }
}

/// Caught as something that is no number.
const fn unmeasured(
    name: &'static str,
    about: &'static str,
    trial: Trial,
    defect: Defect,
    by: &'static str,
) -> Seeded {
    Seeded { exit: Exit::Unmeasured, ..seeded(name, about, trial, defect, by) }
}

/// Refused by the solver, so that nothing is measured.
const fn refused(
    name: &'static str,
    about: &'static str,
    trial: Trial,
    defect: Defect,
    by: &'static str,
) -> Seeded {
    unmeasured(name, about, trial, defect, by)
}

fn networks(model: &mut Model) -> impl Iterator<Item = &mut Network> {
    model.parts.iter_mut().filter_map(|part| match part {
        Part::Discrete { network, .. } => Some(network),
        Part::Continuum(_) => None,
    })
}

fn halve_ei(model: &mut Model) {
    networks(model)
        .flat_map(|n| &mut n.bonds.stiffness)
        .for_each(|k| (k.ks, k.kb) = (0.5 * k.ks, 0.5 * k.kb));
}

fn halve_bending(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.stiffness).for_each(|k| k.kb *= 0.5);
}

fn halve_shear(network: &mut Network) {
    network.bonds.stiffness.iter_mut().for_each(|k| k.ks *= 0.5);
}

/// Of the moment on the first particle due to its own deflection.
fn flip_moment(k: &mut [[f64; 12]; 12]) {
    k[1][5] = -k[1][5];
    k[2][4] = -k[2][4];
}

/// The same, symmetric.
fn flip_moments(k: &mut [[f64; 12]; 12]) {
    for (deflection, rotation) in [(1, 5), (2, 4)] {
        k[deflection][rotation] = -k[deflection][rotation];
        k[rotation][deflection] = -k[rotation][deflection];
    }
}

fn skip_weights(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.weight).for_each(|w| *w = 1.0);
}

fn skip_one_weight(model: &mut Model) {
    networks(model).flat_map(|n| &mut n.bonds.weight).filter(|w| **w < 1.0).take(1).for_each(|w| *w = 1.0);
}

fn drop_one_tie(model: &mut Model) {
    model.ties.pop();
}

fn drop_ties(model: &mut Model) {
    model.ties.clear();
}

fn pointwise(model: &mut Model) {
    model.ties.iter_mut().for_each(|tie| tie.method = Method::Pointwise);
}

fn swap_interface(model: &mut Model) {
    for network in networks(model) {
        if let Some([first, .., last]) = network.faces.get("left").map(Vec::as_slice) {
            network.particles.position.swap(*first, *last);
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

fn kilopascals(model: &mut Model) {
    elements(model, |body| body.elasticity.young_pa *= 1e-3);
}

fn forget_poisson(model: &mut Model) {
    elements(model, |body| body.elasticity.poisson = 0.0);
}

fn plane_strain(model: &mut Model) {
    elements(model, |body| {
        let thickness_m = body.hypothesis.thickness();
        body.hypothesis = Hypothesis::PlaneStrain { thickness_m };
    });
}

fn plain(model: &mut Model) {
    elements(model, |body| body.formulation = Formulation::Plain);
}

fn lose_load(model: &mut Model) {
    // Forces of zero are loads too.
    if let Some(at) = model.loads.iter().rposition(|load| load.value != 0.0) {
        model.loads.remove(at);
    }
}

fn flip_loads(model: &mut Model) {
    model.loads.iter_mut().for_each(|load| load.value = -load.value);
}

fn move_support(model: &mut Model) {
    if let Some(support) = model.supports.iter_mut().find(|support| support.value != 0.0) {
        support.value *= 1.1;
    }
}

/// The one that moves most.
fn stale(_: &Model, solution: &mut seam_solver::solve::statics::Solution) {
    if let Some(u) = solution.u.iter_mut().max_by(|a, b| a.abs().total_cmp(&b.abs())) {
        *u = 0.0;
    }
}

fn mode(plan: &mut seam_solver::simulation::Plan, mode: Mode) {
    plan.switches.iter_mut().for_each(|switch| switch.mode = mode);
}

fn lose_mass(network: &mut Network) {
    network.particles.mass.iter_mut().for_each(|m| *m *= 0.99);
}
