//! The ramp: a cantilever loaded over four first periods, its middle third switched at half of the load.

use super::{YOUNG, continuum, prescribe};
use seam_solver::coupling::{Method, Multipliers};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::calibration::stretched;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate;
use seam_solver::dynamics::newmark::Scheme;
use seam_solver::error::Result;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::simulation::{Plan, Step, Stepping, SwitchRule, When};
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::fields::Mode;
use seam_solver::work::Work;

const ROWS: usize = 8;
const POISSON: f64 = 0.2;

/// Cantilever of length 9 and height 1, clamped at the left, with a transverse force of 10 N at its right end.
pub fn cantilever() -> Model {
    let mut body =
        continuum("beam", Space::Plane, Vec3::zeros(), Vec3::new(9.0, 1.0, 0.0), [9 * ROWS, ROWS, 0]);
    body.elasticity.poisson = POISSON;
    let end = body.mesh.boundary_nodes("right").unwrap();
    let parts = vec![Part::Continuum(body)];
    let mut model =
        Model { space: Space::Plane, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() };
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    for &point in &end {
        model.loads.push(PointValue { part: 0, point, component: 1, value: 10.0 / end.len() as f64 });
    }
    model
}

/// The triangular lattice that shows the beam's material.
pub fn triangular(block: Block, matter: Matter) -> Result<Network> {
    let kind = LatticeKind::Triangular;
    let l = lattice(kind, block, ROWS, matter)?;
    let target = Moduli { young_pa: YOUNG, poisson: POISSON };
    let spacing = 2.0 * l.arrangement.particles.radius[0];
    let found = stretched::calibrate(kind, spacing, l.stretch, matter, target, 0.3, &mut Work::default())?;
    let material = BondMaterial { young_pa: found.bond_young_pa, poisson: 0.3 };
    let section = Section::Uniform { ratio: found.radius_ratio };
    bond_network(&l.arrangement, &l.pairs, &BondRecipe { material, section, skin: Skin::Weighted })
}

/// First bending period of the beam: `(βL)² = 3.516`, ρ = 1.
pub fn period() -> f64 {
    2.0 * std::f64::consts::PI / (3.516 * (YOUNG / 12.0).sqrt() / 81.0)
}

/// The box of the beam between two sections.
pub fn block(from: f64, to: f64) -> Block {
    Block::new(Space::Plane, Vec3::new(from, 0.0, 0.0), Vec3::new(to, 1.0, 0.0)).unwrap()
}

/// A rule that fills boxes with the triangular lattice and ties them point by point.
pub fn rule(when: When) -> SwitchRule<'static> {
    SwitchRule {
        name: "middle".to_owned(),
        body: "beam".to_owned(),
        when,
        fill: &triangular,
        method: Method::Pointwise,
        multipliers: Multipliers::Auto,
        rotations: false,
        mode: Mode::Velocity,
        finite: false,
    }
}

/// The load over four first periods, the middle third switched at half of it.
pub fn ramp(stepping: Stepping) -> Plan<'static> {
    let end_s = 4.0 * period();
    Plan {
        stepping,
        end_s,
        initial_velocity: None,
        loads: LoadFactor::Ramp { start_s: 0.0, rise_s: end_s },
        damping: Damping::None,
        rotations: Rotations::Small,
        outputs: 20,
        switches: vec![rule(When::LoadLevel { factor: 0.5, block: block(3.0, 6.0) })],
        laws: Vec::new(),
        contact: None,
    }
}

/// The trapezoidal rule in equal steps over the ramp.
pub fn implicit(steps: f64) -> Stepping {
    Stepping::Implicit { scheme: Scheme::TRAPEZOIDAL, step_s: 4.0 * period() / steps }
}

/// Elements as [`implicit`], particles below their critical step.
pub fn two_rates(method: multirate::Method, steps: f64) -> Stepping {
    let step_s = 4.0 * period() / steps;
    Stepping::TwoRates { method, scheme: Scheme::TRAPEZOIDAL, step_s, fine: Step::ShareOfCritical(0.9) }
}
