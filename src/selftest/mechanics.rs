//! Defects of mechanics: done to a model, its solution, a run in time, a network, or the matrix of a bond.

use super::changes::*;
use super::{Seeded, Spoil, Trial};
use seam_cases::defect::Defect;
use seam_reports::exit::Exit;
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
    seeded(
        "swap-interface-nodes",
        "two particles inside an interface change places",
        PATCH,
        Defect::Model(swap_inside),
        "tension-nested",
    ),
    refused(
        "swap-interface-corners",
        "the corner particles of an interface change places",
        PATCH,
        Defect::Model(swap_corners),
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
