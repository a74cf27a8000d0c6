//! A free block vibrates undamped for many steps: energy and momenta must stay.
//!
//! Linear bonds: central differences keep `½ v₋ᵀMv₊ + ½ uᵀKu` exactly. Finite rotations: the block spins and vibrates; its energy
//! swings with O(Δt²) and must not drift, momenta stay exactly: internal forces and moments balance about the present places.

use super::compared::{plot, series, within};
use super::hard::bodies::{SPACES, bonded, close_packed};
use super::specimen::{block, wave};
use super::{Setting, rounding};
use crate::error::Result;
use crate::margin::{ROUNDING, Search};
use crate::observe::curve::nan_max;
use crate::result::{CaseResult, Role};
use crate::study::stability::trend;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::Network;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::newmark::{self, Newmark, Scheme};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::Error;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::{Space, Vec3};

const PER: usize = 6;
/// Looks at the run.
const SAMPLES: u64 = 200;

/// What is seen on the way.
struct Sample {
    step: f64,
    energy: f64,
    /// Linear and angular momentum, in kg m/s and kg m²/s.
    momentum: [Vec3; 2],
}

/// Both kinds of bonds.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let network = block(setting)?;
    let steps = setting.count_of_tier("steps", 1000)? as u64;
    let model = Model {
        space: Space::Solid,
        parts: vec![Part::Discrete { name: "block".to_owned(), network }],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    let Part::Discrete { network, .. } = &model.parts[0] else { return Ok(()) };
    let mut lines = Vec::new();
    for (id, name, rotations) in
        [("small", "linear bonds", Rotations::Small), ("finite", "finite rotations", Rotations::Finite)]
    {
        let initial = start(setting, network, rotations)?;
        let seen = watch(setting, &model, network, (initial, rotations, steps), result)?;
        let energy = seen[0].energy;
        let off = |s: &Sample| s.energy / energy - 1.0;
        let swing = seen.iter().map(|s| off(s).abs()).fold(0.0, nan_max);
        let label = |what: &str| format!("{what}, {name}");
        if rotations == Rotations::Small {
            let why = "Exact in theory; up to a million steps add up their rounding.";
            let source = "central differences keep ½ v₋ᵀMv₊ + ½ uᵀKu";
            let label = label("Largest change of the energy");
            result.quantities.push(rounding("energy-small", &label, swing, 1e-9, why, source));
            let points: Vec<(f64, f64)> = seen.iter().map(|s| (s.step / steps as f64, off(s))).collect();
            let label = "Drift of the energy over the run, linear bonds";
            result.quantities.extend(trend::observed("trend-small", label, &points));
        } else {
            let mean = |part: &[Sample]| part.iter().map(off).sum::<f64>() / part.len() as f64;
            let tenth = seen.len() / 10;
            let drift = mean(&seen[seen.len() - tenth..]) - mean(&seen[..tenth]);
            let source =
                "Hairer, Lubich and Wanner (2006), ch. IX: symplectic steps bound the error of the energy";
            let why = "O(Δt²) of the strain energy at half the critical step: up to 4e-4 of the energy of this run.";
            let text = label("Largest swing of the energy");
            result.quantities.push(rounding("swing-finite", &text, swing, 1e-3, why, source));
            let why = [
                "A drift would grow with the steps; means over twenty looks at a swing of some 1e-4 differ by a few per cent of it.",
                source,
            ];
            let text = label("Drift of the energy, last tenth against first");
            result.quantities.push(within(["drift-finite", &text, "1"], drift, [-2e-5, 2e-5], why));
        }
        for (k, what) in ["linear", "angular"].into_iter().enumerate() {
            let scale = scale(network, k, energy);
            let moved = seen.iter().map(|s| (s.momentum[k] - seen[0].momentum[k]).norm() / scale);
            let why = "Exact in theory; up to a million steps add up their rounding.";
            let source = "forces and moments of each bond balance";
            result.quantities.push(rounding(
                &format!("{what}-momentum-{id}"),
                &label(&format!("Largest change of the {what} momentum")),
                moved.fold(0.0, nan_max),
                1e-11,
                why,
                source,
            ));
        }
        lines.push(series(name, Role::Model, seen.iter().map(|s| (s.step, 100.0 * off(s)))));
    }
    result.curves.push(plot(
        ["energy", "Energy of the run", "step (1)", "E / E₀ − 1 (%)"],
        [false; 2],
        lines,
    ));
    margins(setting, result)
}

/// The longest step at which a run keeps its energy to 1e-9, plane and solid, explicit and implicit.
fn margins(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let material =
        BondMaterial { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? };
    let matter = Matter { density: setting.number("density_kg_m3")?, thickness_m: 1.0 };
    let (side, ratio) = (setting.number("side_m")?, setting.number("radius_ratio")?);
    let (needed, steps) = (setting.number("step_share")?, setting.count("searched_steps", 10)? as u64);
    for (space, id) in SPACES {
        let refuse = |e| setting.solver(e);
        let rows = if space == Space::Plane { 3 } else { setting.count("rows", 1)? };
        let model = bonded(close_packed(space, side, rows, material, ratio, matter).map_err(refuse)?);
        let bound = critical::bound(&model).map_err(refuse)?.step_s;
        type Swing = fn(&Model, f64, u64, &mut CaseResult) -> seam_solver::error::Result<f64>;
        for (code, name, swing, to, tolerance) in [
            ("explicit", "explicit", explicit as Swing, 2.0, 0.01),
            ("implicit", "trapezoidal rule", implicit, 1e4, ROUNDING),
        ] {
            let search = Search { from: 0.25, to, tolerance };
            let found = search.largest(|share| match swing(&model, share * bound, steps, result) {
                Ok(swing) => Ok(swing <= 1e-9),
                Err(Error::UnstableStep { .. }) => Ok(false),
                Err(e) => Err(refuse(e)),
            })?;
            let criterion = "an undamped run keeps its energy to 1e-9; a step beyond the bound is refused";
            let margin = [
                &format!("step-{code}-{id}"),
                &format!("linear bonds, {id}, {name}"),
                "step over the explicit bound",
            ];
            result.margins.push(found.margin(["1e6 undamped steps", criterion], margin, needed));
        }
    }
    Ok(())
}

/// Largest change of `½ v₋ᵀMv₊ + ½ uᵀKu`, relative.
fn explicit(
    model: &Model,
    step_s: f64,
    steps: u64,
    result: &mut CaseResult,
) -> seam_solver::error::Result<f64> {
    let n = Numbering::new(model).len();
    let start = State { u: (0..n).map(|i| wave(i, 1e-3)).collect(), ..State::at_rest(n) };
    let mut run = Explicit::new(model, Options { step_s, ..Options::default() }, &start)?;
    let energy = run.observe()?.ledger.energy();
    let mut worst = 0.0;
    for _ in 0..10 {
        run.advance(steps / 10)?;
        worst = nan_max(worst, (run.observe()?.ledger.energy() / energy - 1.0).abs());
    }
    result.work += run.work();
    Ok(worst)
}

/// Largest change of `½ vᵀMv + ½ uᵀKu`, relative; a tenth of the steps.
fn implicit(
    model: &Model,
    step_s: f64,
    steps: u64,
    result: &mut CaseResult,
) -> seam_solver::error::Result<f64> {
    let work = &mut result.work;
    let system = Semidiscrete::new(model, work)?;
    let stepper = Newmark::new(&system, Scheme::TRAPEZOIDAL, step_s, 0.0, work)?;
    let n = system.mass.len();
    let start = ((0..n).map(|i| wave(i, 1e-3)).collect(), vec![0.0; n]);
    let (mut motion, _) = newmark::start(&system, start, 0.0, 0.0, 0.0, work)?;
    let energy = system.strain(&motion.u);
    let mut worst = 0.0;
    for _ in 0..steps / 10 {
        stepper.step(&mut motion, [0.0; 2], work)?;
        let now = system.kinetic(&motion.v) + system.strain(&motion.u);
        worst = nan_max(worst, (now / energy - 1.0).abs());
    }
    Ok(worst)
}

/// Linear bonds start strained and at rest, so that nothing moves away; the others start unstrained, spinning and shaken.
fn start(setting: &Setting, network: &Network, rotations: Rotations) -> Result<State> {
    let n = PER * network.particles.len();
    let (spin, shake) = (setting.number("spin_rad_s")?, setting.number("shake")?);
    let spin = Vec3::new(1.0, 2.0, -0.5).normalize() * spin;
    let mut state = State::at_rest(n);
    let (centre, _) = centre(network);
    for (p, x) in network.particles.position.iter().enumerate() {
        let turning = spin.cross(&(x - centre));
        let length = network.bond_length(0);
        for i in 0..3 {
            if rotations == Rotations::Small {
                state.u[PER * p + i] = wave(PER * p + i, shake * length);
            } else {
                state.v[PER * p + i] = turning[i] + wave(PER * p + i, shake * length * spin.norm());
                state.v[PER * p + 3 + i] = spin[i];
            }
        }
    }
    Ok(state)
}

fn watch(
    setting: &Setting,
    model: &Model,
    network: &Network,
    (initial, rotations, steps): (State, Rotations, u64),
    result: &mut CaseResult,
) -> Result<Vec<Sample>> {
    let share = setting.number("step_share")?;
    let mut seen = Vec::new();
    let mut go = || -> seam_solver::error::Result<()> {
        let step_s = share * critical::bound(model)?.step_s;
        let mut run = Explicit::new(model, Options { step_s, rotations, ..Options::default() }, &initial)?;
        for k in 0..=SAMPLES {
            let now = run.observe()?;
            let momentum = momentum(network, &now.state, rotations);
            let step = (k * (steps / SAMPLES)) as f64;
            seen.push(Sample { step, energy: now.ledger.energy(), momentum });
            run.advance(if k < SAMPLES { steps / SAMPLES } else { 0 })?;
        }
        result.work += run.work();
        Ok(())
    };
    go().map_err(|e| setting.solver(e))?;
    Ok(seen)
}

/// Linear momentum, and angular momentum about the origin: at the present places, or the undeformed ones of linear bonds.
fn momentum(network: &Network, state: &State, rotations: Rotations) -> [Vec3; 2] {
    let mut sums = [Vec3::zeros(); 2];
    let particles = &network.particles;
    for (p, (u, v)) in state.u.chunks(PER).zip(state.v.chunks(PER)).enumerate() {
        let shift = if rotations == Rotations::Finite { Vec3::new(u[0], u[1], u[2]) } else { Vec3::zeros() };
        let linear = Vec3::new(v[0], v[1], v[2]) * particles.mass[p];
        let spin = Vec3::new(v[3], v[4], v[5]) * particles.inertia[p];
        sums[0] += linear;
        sums[1] += (particles.position[p] + shift).cross(&linear) + spin;
    }
    sums
}

/// What to compare a change with: `√(2mE)`, times the length of the block for angular momentum.
fn scale(network: &Network, kind: usize, energy: f64) -> f64 {
    let (_, mass) = centre(network);
    let linear = (2.0 * mass * energy).sqrt();
    let far = network.particles.position.iter().map(|x| x.norm()).fold(0.0, f64::max);
    if kind == 0 { linear } else { linear * far }
}

/// Centre (m) and mass (kg).
fn centre(network: &Network) -> (Vec3, f64) {
    let particles = &network.particles;
    let mass: f64 = particles.mass.iter().sum();
    let sum: Vec3 = particles.position.iter().zip(&particles.mass).map(|(x, m)| x * *m).sum();
    (sum / mass, mass)
}
