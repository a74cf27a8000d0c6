//! An oscillator stepped by each scheme: fitted orders, frequencies of the schemes, energy.
//!
//! One particle of mass m on one bond of stiffness k, free along the bond only, released at rest: `u = u₀ cos ωt`.
//! Every scheme obeys `u_{n+1} − 2A₁u_n + A₂u_{n−1} − A₃u_{n−2} = 0` with the invariants of its amplification matrix
//! (Hughes 2000, §9.3). For central differences `Ω = (2/Δt) sin(ω_dΔt/2)` with `Ω = √(k/m)`, for the trapezoidal rule
//! `Ω = (2/Δt) tan(ω_dΔt/2)`.

use super::compared::{exact, plot, series};
use super::straight::{Chain, hold, plane};
use super::{Setting, rounding};
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::{CaseResult, Convergence, Role};
use seam_solver::dem::network::BondStiffness;
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::model::Model;
use seam_solver::work::Work;
use std::f64::consts::TAU;

/// Unknown of the particle's motion along the bond; two particles with three unknowns each.
const FREE: usize = 3;

/// Steps per period of the levels.
const LEVELS: [usize; 4] = [40, 80, 160, 320];

/// A scheme and its order in theory.
struct Entry {
    id: &'static str,
    name: String,
    scheme: Scheme,
    order: f64,
}

/// Orders, identities and energies of all schemes.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let hughes = "Hughes (2000), The Finite Element Method, §9.3";
    let oscillator = Oscillator::new(setting)?;
    let entries = entries(setting)?;
    let largest_step = setting.number("largest_step")?;
    let compared_steps = setting.count("compared_steps", 3)?;
    for Entry { id, name, scheme, order } in &entries {
        result.convergence.push(orders(setting, &oscillator, id, name, *scheme, *order, &mut result.work)?);
        let step = largest_step / oscillator.omega;
        let path = oscillator.path(*scheme, step, compared_steps, &mut result.work);
        let miss = recurrence(&path.map_err(|e| setting.solver(e))?, *scheme, largest_step);
        let why = "The recurrence is exact; each step rounds a few sums of size one.";
        let label =
            format!("Miss of the recurrence of the amplification matrix at ωΔt = {largest_step}, {name}");
        result.quantities.push(rounding(&format!("recurrence-{id}"), &label, miss, 1e-11, why, hughes));
    }
    frequencies(setting, &oscillator, result)?;
    energies(setting, &oscillator, &entries, result)
}

fn entries(setting: &Setting) -> Result<Vec<Entry>> {
    let (alpha, gamma) = (setting.number("hht_alpha")?, setting.number("damped_gamma")?);
    let hht = Scheme::hht(alpha).map_err(|e| setting.solver(e))?;
    // β = ¼(γ+½)² keeps it stable at any step.
    let damped = Scheme { beta: 0.25 * (gamma + 0.5).powi(2), gamma, alpha: 0.0 };
    let entry = |id, name: &str, scheme, order| Entry { id, name: name.to_owned(), scheme, order };
    Ok(vec![
        entry("central", "central differences", Scheme::CENTRAL, 2.0),
        entry("trapezoidal", "Newmark β = ¼, γ = ½", Scheme::TRAPEZOIDAL, 2.0),
        entry("hht", &format!("HHT α = {alpha}"), hht, 2.0),
        entry("damped", &format!("Newmark γ = {gamma}"), damped, 1.0),
    ])
}

/// Error of the state, `√((u−u_exact)² + (v−v_exact)²/ω²)/u₀`, after four thirds of a period: amplitude and phase together.
fn orders(
    setting: &Setting,
    oscillator: &Oscillator,
    id: &str,
    name: &str,
    scheme: Scheme,
    formal_order: f64,
    work: &mut Work,
) -> Result<Convergence> {
    let omega = oscillator.omega;
    let (mut h, mut error) = (Vec::new(), Vec::new());
    for per_period in LEVELS {
        let step = TAU / omega / per_period as f64;
        let steps = (4 * per_period).div_ceil(3);
        let path = oscillator.path(scheme, step, steps, work).map_err(|e| setting.solver(e))?;
        let (sin, cos) = (omega * step * steps as f64).sin_cos();
        let [u, v] = [path.u[steps] / oscillator.start, path.v[steps] / (omega * oscillator.start)];
        h.push(step);
        error.push((u - cos).hypot(v + sin));
    }
    Ok(Convergence {
        id: id.to_owned(),
        label: format!("state after 4/3 periods, {name}; refined is the time step in s"),
        h,
        error,
        formal_order,
        tolerance: Some(setting.number("tolerance")?),
    })
}

/// Observed frequencies over the step, and at the largest step as numbers.
fn frequencies(setting: &Setting, oscillator: &Oscillator, result: &mut CaseResult) -> Result<()> {
    let largest_step = setting.number("largest_step")?;
    let compared_steps = setting.count("compared_steps", 3)?;
    let source = "eigenvalues of the amplification matrix (Hughes 2000, §9.3)";
    let why = "The formula is exact; an arc cosine of a mean over the steps rounds like the steps.";
    type Formula = fn(f64) -> f64;
    // ω_d/Ω as a function of ΩΔt.
    let schemes: [(&str, &str, Scheme, Formula); 2] = [
        ("central", "central differences", Scheme::CENTRAL, |x| 2.0 / x * (0.5 * x).asin()),
        ("trapezoidal", "trapezoidal rule", Scheme::TRAPEZOIDAL, |x| 2.0 / x * (0.5 * x).atan()),
    ];
    let mut lines = Vec::new();
    for (id, name, scheme, formula) in schemes {
        let mut measured = Vec::new();
        for k in 1..=8 {
            let x = largest_step * k as f64 / 8.0;
            let path = oscillator.path(scheme, x / oscillator.omega, compared_steps, &mut result.work);
            measured.push((x, frequency(&path.map_err(|e| setting.solver(e))?) / x));
        }
        let (x, ratio) = measured[7];
        let label = format!("Frequency at ΩΔt = {x}, {name}");
        result.quantities.push(exact(
            [&format!("frequency-{id}"), &label, "rad/s"],
            ratio * oscillator.omega,
            formula(x) * oscillator.omega,
            1e-12,
            [why, source],
        ));
        let percent =
            |points: Vec<(f64, f64)>| points.into_iter().map(|(x, ratio)| (x, 100.0 * (ratio - 1.0)));
        lines.push(series(&format!("{name}, run"), Role::Data, percent(measured)));
        let fine = (1..=50).map(|k| largest_step * k as f64 / 50.0).map(|x| (x, formula(x))).collect();
        lines.push(series(&format!("{name}, exact"), Role::Reference, percent(fine)));
    }
    let words = ["frequency", "Error of the frequency", "ΩΔt (1)", "ω_d/Ω − 1 (%)"];
    result.curves.push(plot(words, [false; 2], lines));
    Ok(())
}

/// Undamped energies stay; algorithmic damping is drawn beside them.
fn energies(
    setting: &Setting,
    oscillator: &Oscillator,
    entries: &[Entry],
    result: &mut CaseResult,
) -> Result<()> {
    let per_period = setting.count("energy_steps_per_period", 4)?;
    let periods = setting.count("energy_periods", 1)?;
    let step = TAU / oscillator.omega / per_period as f64;
    let mut lines = Vec::new();
    for Entry { id, name, scheme, .. } in entries {
        let path = oscillator.path(*scheme, step, periods * per_period, &mut result.work);
        let energy = path.map_err(|e| setting.solver(e))?.energy;
        if scheme.alpha == 0.0 && scheme.gamma == 0.5 {
            let worst = energy.iter().map(|e| (e / energy[0] - 1.0).abs()).fold(0.0, nan_max);
            let why = "The scheme conserves this energy exactly; thousands of steps add up their rounding.";
            let source = "central differences: ½ m v₋v₊ + ½ k u²; trapezoidal rule: ½ m v² + ½ k u² (Hughes 2000, §9.2)";
            let label = format!("Largest change of the energy over {periods} periods, {name}");
            result.quantities.push(rounding(&format!("energy-{id}"), &label, worst, 1e-11, why, source));
        }
        let shown = energy.iter().take(20 * per_period + 1).enumerate();
        let points = shown.map(|(n, e)| (n as f64 / per_period as f64, e / energy[0]));
        lines.push(series(name, Role::Model, points));
    }
    let title = format!("Energy at {per_period} steps per period");
    result.curves.push(plot(["energy", &title, "t / T (1)", "E / E₀ (1)"], [false; 2], lines));
    Ok(())
}

/// `|u_{n+1} − 2A₁u_n + A₂u_{n−1} − A₃u_{n−2}|` over the largest `|u|`, with `x = ΩΔt`, `D = 1 + (1+α)βx²`,
/// `2A₁ = 2 − x²[(1+α)(γ+½) − αβ]/D`, `A₂ = 1 − x²[γ − ½ + 2α(γ−β)]/D`, `A₃ = αx²(β − γ + ½)/D`.
fn recurrence(path: &Path, Scheme { beta, gamma, alpha }: Scheme, x: f64) -> f64 {
    let share = x * x / (1.0 + (1.0 + alpha) * beta * x * x);
    let twice_a1 = 2.0 - share * ((1.0 + alpha) * (gamma + 0.5) - alpha * beta);
    let a2 = 1.0 - share * (gamma - 0.5 + 2.0 * alpha * (gamma - beta));
    let a3 = alpha * share * (beta - gamma + 0.5);
    let largest = path.u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
    let miss = |u: &[f64]| (u[3] - twice_a1 * u[2] + a2 * u[1] - a3 * u[0]).abs();
    path.u.windows(4).map(miss).fold(0.0, nan_max) / largest
}

/// `ω_dΔt` of an undamped path: least squares for `u_{n+1} + u_{n−1} = 2 cos(ω_dΔt) u_n`.
fn frequency(path: &Path) -> f64 {
    let sums = path.u.windows(3).map(|u| (u[1] * (u[0] + u[2]), 2.0 * u[1] * u[1]));
    let (top, bottom) = sums.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    (top / bottom).acos()
}

struct Oscillator {
    model: Model,
    /// `Ω = √(k/m)`, in rad/s.
    omega: f64,
    /// `u₀`, in m.
    start: f64,
}

/// Displacement (m), velocity (m/s) and energy (J) after each step, the start first.
#[derive(Default)]
struct Path {
    u: Vec<f64>,
    v: Vec<f64>,
    energy: Vec<f64>,
}

impl Oscillator {
    fn new(setting: &Setting) -> Result<Self> {
        let (mass, kn) = (setting.number("mass_kg")?, setting.number("stiffness_N_m")?);
        let l = setting.number("length_m")?;
        // Bending plays no part, but must not ask for a smaller step.
        let stiffness = BondStiffness { kn, ks: 1e-3 * kn, kb: 1e-3 * kn * l * l, kt: 0.0 };
        let chain = Chain { bonds: 1, spacing: l, stiffness, mass: 2.0 * mass, inertia: 2.0 * mass * l * l };
        let mut model = plane(vec![chain.part()]);
        hold(&mut model, 0, |x| x.x == 0.0);
        hold(&mut model, 1, |x| x.x > 0.0);
        Ok(Oscillator { model, omega: (kn / mass).sqrt(), start: setting.number("start_m")? })
    }

    fn path(
        &self,
        scheme: Scheme,
        step: f64,
        steps: usize,
        work: &mut Work,
    ) -> seam_solver::error::Result<Path> {
        if scheme == Scheme::CENTRAL {
            self.explicit(step, steps, work)
        } else {
            self.implicit(scheme, step, steps, work)
        }
    }

    fn explicit(&self, step_s: f64, steps: usize, work: &mut Work) -> seam_solver::error::Result<Path> {
        let mut initial = State::at_rest(2 * FREE);
        initial.u[FREE] = self.start;
        let mut run = Explicit::new(&self.model, Options { step_s, ..Options::default() }, &initial)?;
        let mut path = Path::default();
        for n in 0..=steps {
            let seen = run.observe()?;
            path.u.push(seen.state.u[FREE]);
            path.v.push(seen.state.v[FREE]);
            path.energy.push(seen.ledger.energy());
            run.advance(u64::from(n < steps))?;
        }
        *work += run.work();
        Ok(path)
    }

    fn implicit(
        &self,
        scheme: Scheme,
        step: f64,
        steps: usize,
        work: &mut Work,
    ) -> seam_solver::error::Result<Path> {
        let system = Semidiscrete::new(&self.model, work)?;
        let newmark = Newmark::new(&system, scheme, step, 0.0, work)?;
        let (mut motion, _) = start(&system, (vec![self.start], vec![0.0]), 0.0, 0.0, 0.0, work)?;
        let mut path = Path::default();
        for n in 0..=steps {
            path.u.push(motion.u[0]);
            path.v.push(motion.v[0]);
            path.energy.push(system.kinetic(&motion.v) + system.strain(&motion.u));
            if n < steps {
                newmark.step(&mut motion, [0.0; 2], work)?;
            }
        }
        Ok(path)
    }
}
