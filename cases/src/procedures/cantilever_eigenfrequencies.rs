//! Natural frequencies of a cantilever: a chain of bonds and a mesh of elements against beam theory.
//!
//! Euler–Bernoulli: `ω_k = (βL)_k² √(EI/ρA)/L²`, `cos βL cosh βL = −1`. A chain of bonds *is* a chain of such beams with lumped
//! masses: error O(h²). Elements also shear and have rotatory inertia, which lower ω_k to first order by the share
//! `δ_k = ½ (r_g/L)² B_k (1 + E/κG)`, `B = βLσ(2 + βLσ)`, `σ = (sinh βL − sin βL)/(cosh βL + cos βL)`: Rayleigh's quotient of the
//! Timoshenko beam with the shape of the slender one (Weaver, Timoshenko & Young 1990, §5.12).

use super::Setting;
use super::compared::{exact, within};
use super::straight::{Chain, hold, plane, rectangle};
use crate::error::Result;
use crate::result::{CaseResult, Convergence};
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::modes::{self, Mode};
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part};
use seam_solver::space::Vec3;
use seam_solver::work::Work;
use std::f64::consts::PI;

/// Roots of `cos βL cosh βL = −1`.
const BETA_L: [f64; 3] = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613];
const LEVELS: [usize; 3] = [8, 16, 32];
/// Steps per period of the implicit free run; the explicit one is bound by the critical step.
const STEPS_PER_PERIOD: f64 = 40.0;
const EULER: &str = "Euler–Bernoulli: cos βL cosh βL = −1";

/// Chain, elements, and a free run of each.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let beam = Beam {
        young_pa: setting.number("young_Pa")?,
        density: setting.number("density_kg_m3")?,
        length: setting.number("length_m")?,
        height: setting.number("height_m")?,
    };
    let periods = setting.count("periods", 1)?;
    chain(setting, &beam, periods, result)?;
    elements(setting, &beam, periods, result)
}

/// Refined frequencies of the chain, and a free run of its middle level.
fn chain(setting: &Setting, beam: &Beam, periods: usize, result: &mut CaseResult) -> Result<()> {
    let gyration = beam.chain(1).1;
    let mut omegas = Vec::new();
    for bonds in LEVELS {
        let model = supported(vec![beam.chain(bonds).0.part()]);
        let found = beam_modes(&model, &mut result.work).map_err(|e| setting.solver(e))?;
        omegas.push(found.iter().map(|mode| mode.omega).collect::<Vec<_>>());
    }
    for (k, beta_l) in BETA_L.iter().enumerate() {
        let theory = beam.frequency(*beta_l, gyration);
        let error: Vec<f64> = omegas.iter().map(|level| (level[k] / theory - 1.0).abs()).collect();
        // Without its h² term.
        let extrapolated = (4.0 * omegas[2][k] - omegas[1][k]) / 3.0;
        let label = format!("Frequency {} of the chain, extrapolated from 16 and 32 bonds", k + 1);
        let why =
            "Lumped masses and inertias err by h², which is taken out; the h⁴ left is largest for the third.";
        result.quantities.push(exact(
            [&format!("chain-{}", k + 1), &label, "rad/s"],
            extrapolated,
            theory,
            5e-4,
            [why, EULER],
        ));
        result.convergence.push(Convergence {
            id: format!("chain-{}", k + 1),
            label: format!("frequency {} of a chain of bonds", k + 1),
            h: LEVELS.iter().map(|n| beam.length / *n as f64).collect(),
            error,
            formal_order: 2.0,
            tolerance: Some(setting.number("tolerance")?),
        });
    }
    let model = supported(vec![beam.chain(LEVELS[1]).0.part()]);
    let measured = explicit_run(&model, periods, &mut result.work).map_err(|e| setting.solver(e))?;
    result.quantities.push(exact(
        ["chain-free-run", "First frequency of the chain of 16 bonds from zero crossings, explicit", "rad/s"],
        measured,
        omegas[1][0],
        1e-5,
        [
            "Steps far below the period: their error, (ωΔt)²/24, and that of a straight line through a zero are below 1e-6.",
            "first natural frequency of the same matrices",
        ],
    ));
    Ok(())
}

/// Elements against the beam with shear and rotatory inertia.
fn elements(setting: &Setting, beam: &Beam, periods: usize, result: &mut CaseResult) -> Result<()> {
    let divisions = [setting.count("columns", 2)?, setting.count("rows", 1)?];
    let body = beam.elements(divisions).map_err(|e| setting.solver(e))?;
    let model = supported(vec![body]);
    let found = beam_modes(&model, &mut result.work).map_err(|e| setting.solver(e))?;
    let gyration = beam.height / 12f64.sqrt();
    for (k, (mode, beta_l)) in found.iter().zip(BETA_L).enumerate() {
        let slender = beam.frequency(beta_l, gyration);
        let lowered = beam.shear_and_inertia(beta_l);
        let name = format!("frequency {} of the elements", k + 1);
        result.quantities.push(within(
            [&format!("elements-{}-slender", k + 1), &format!("F{} over Euler–Bernoulli", &name[1..]), "1"],
            mode.omega / slender,
            [1.0 - 2.0 * lowered, 1.0],
            ["Shear and rotatory inertia lower it by the share δ of the page: between nothing and twice that.", EULER],
        ));
        result.quantities.push(exact(
            [&format!("elements-{}", k + 1), &format!("F{}", &name[1..]), "rad/s"],
            mode.omega,
            slender * (1.0 - lowered),
            1e-3,
            [
                "What is left: the square of δ, the mesh (h²) and lumping.",
                "Timoshenko beam to first order, κ = 5/6 for ν = 0 (Cowper 1966)",
            ],
        ));
    }
    let measured =
        implicit_run(&model, &found[0], periods, &mut result.work).map_err(|e| setting.solver(e))?;
    // The trapezoidal rule turns by 2 atan(ωΔt/2) each step.
    let turn = 2.0 * PI / STEPS_PER_PERIOD;
    result.quantities.push(exact(
        ["elements-free-run", "First frequency of the elements from zero crossings, implicit", "rad/s"],
        measured,
        found[0].omega * 2.0 * (0.5 * turn).atan() / turn,
        1e-4,
        [
            "A straight line through a zero at 40 steps per period misses it by up to 1e-3 of a step.",
            "ω_d = (2/Δt) atan(ωΔt/2) of the trapezoidal rule, ω from the same matrices",
        ],
    ));
    Ok(())
}

/// A beam of rectangular section and unit width (elements), or of cylinders as wide as it is high (chain).
struct Beam {
    young_pa: f64,
    density: f64,
    length: f64,
    height: f64,
}

impl Beam {
    /// ω of a slender beam with radius of gyration `√(I/A)` (m), in rad/s.
    fn frequency(&self, beta_l: f64, gyration: f64) -> f64 {
        (beta_l / self.length).powi(2) * gyration * (self.young_pa / self.density).sqrt()
    }

    /// δ for ν = 0: `E/κG = 2/κ`.
    fn shear_and_inertia(&self, beta_l: f64) -> f64 {
        let sigma = (beta_l.sinh() - beta_l.sin()) / (beta_l.cosh() + beta_l.cos());
        let shape = beta_l * sigma * (2.0 + beta_l * sigma);
        0.5 * (self.height / self.length).powi(2) / 12.0 * shape * (1.0 + 2.0 / (5.0 / 6.0))
    }

    /// The chain and its radius of gyration: spheres that touch carry the mass of the cylinders.
    fn chain(&self, bonds: usize) -> (Chain, f64) {
        let (h, r) = (self.length / bonds as f64, 0.5 * self.height);
        let stiffness = BondMaterial { young_pa: self.young_pa, poisson: 0.3 }.cylinder(r, h);
        let mass = self.density * PI * r * r * h;
        (Chain { bonds, spacing: h, stiffness, mass, inertia: 0.4 * mass * (0.5 * h).powi(2) }, 0.5 * r)
    }

    fn elements(&self, divisions: [usize; 2]) -> seam_solver::error::Result<Part> {
        let elasticity = Elasticity { young_pa: self.young_pa, poisson: 0.0, density: self.density };
        let corners = [Vec3::zeros(), Vec3::new(self.length, self.height, 0.0)];
        rectangle("beam", corners, divisions, elasticity, 1.0, Formulation::Incompatible).map(Part::Continuum)
    }
}

fn supported(parts: Vec<Part>) -> Model {
    let mut model = plane(parts);
    hold(&mut model, 0, |x| x.x == 0.0);
    model
}

fn beam_modes(model: &Model, work: &mut Work) -> seam_solver::error::Result<Vec<Mode>> {
    let system = Semidiscrete::new(model, work)?;
    modes::lowest(model, &system, BETA_L.len(), work)
}

/// Released from the first mode; central differences at half the bound on the step.
fn explicit_run(model: &Model, periods: usize, work: &mut Work) -> seam_solver::error::Result<f64> {
    let system = Semidiscrete::new(model, work)?;
    let mode = modes::lowest(model, &system, 1, work)?.remove(0);
    let (n, tip) = (system.numbering.len(), system.numbering.len() - 2);
    let mut initial = State::at_rest(n);
    system.free.iter().zip(&mode.shape).for_each(|(&i, x)| initial.u[i] = *x);
    let step_s = 0.5 * critical::bound(model)?.step_s;
    let mut run = Explicit::new(model, Options { step_s, ..Options::default() }, &initial)?;
    let mut crossings = Crossings::default();
    while crossings.count <= 2 * periods {
        crossings.see(run.time(), run.u()[tip]);
        run.advance(1)?;
    }
    *work += run.work();
    Ok(crossings.frequency())
}

/// The same for the trapezoidal rule at its own step.
fn implicit_run(
    model: &Model,
    mode: &Mode,
    periods: usize,
    work: &mut Work,
) -> seam_solver::error::Result<f64> {
    let system = Semidiscrete::new(model, work)?;
    let step = 2.0 * PI / mode.omega / STEPS_PER_PERIOD;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
    let still = vec![0.0; mode.shape.len()];
    let (mut motion, _) = start(&system, (mode.shape.clone(), still), 0.0, 0.0, 0.0, work)?;
    let tip = motion.u.len() - 1;
    let mut crossings = Crossings::default();
    while crossings.count <= 2 * periods {
        crossings.see(motion.time, motion.u[tip]);
        newmark.step(&mut motion, [0.0; 2], work)?;
    }
    Ok(crossings.frequency())
}

/// Times at which a signal changes its sign, by a straight line between two steps.
#[derive(Default)]
struct Crossings {
    count: usize,
    first: f64,
    last: f64,
    before: Option<(f64, f64)>,
}

impl Crossings {
    fn see(&mut self, time: f64, value: f64) {
        if let Some((t, x)) = self.before.filter(|(_, x)| x * value < 0.0) {
            self.last = t + (time - t) * x / (x - value);
            if self.count == 0 {
                self.first = self.last;
            }
            self.count += 1;
        }
        self.before = Some((time, value));
    }

    /// Half a turn between crossings.
    fn frequency(&self) -> f64 {
        PI * (self.count - 1) as f64 / (self.last - self.first)
    }
}
