//! Implicit steps: Newmark's method and HHT-α (Newmark 1959; Hilber, Hughes & Taylor 1977).
//!
//! With `x_α = (1+α) x_{n+1} − α x_n` for forces, displacements and velocities:
//!
//! `M a_{n+1} + c M v_α + K u_α + Bᵀλ = f_α`, `B a_{n+1} = 0`,
//! `u_{n+1} = ũ + βΔt² a_{n+1}`, `ũ = u_n + Δt v_n + (½−β)Δt² a_n`,
//! `v_{n+1} = ṽ + γΔt a_{n+1}`, `ṽ = v_n + (1−γ)Δt a_n`.
//!
//! The unknown is the acceleration: `(1 + (1+α)cγΔt) M + (1+α)βΔt² K` is factorised once, together with
//! the constraints. From a state with `B u = g`, `B v = 0` and `B a = 0` these hold at every step to rounding.

use super::semidiscrete::{Motion, Semidiscrete};
use crate::error::{Error, Result};
use crate::solve::kkt::Kkt;
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Parameters of the scheme. Second order for `γ = ½ − α`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Scheme {
    /// β, dimensionless.
    pub beta: f64,
    /// γ, dimensionless.
    pub gamma: f64,
    /// α of HHT: 0 for Newmark, down to −⅓ for most damping of high frequencies.
    pub alpha: f64,
}

impl Scheme {
    /// Trapezoidal rule `β = ¼, γ = ½`: conserves energy, stable at any step.
    pub const TRAPEZOIDAL: Scheme = Scheme { beta: 0.25, gamma: 0.5, alpha: 0.0 };
    /// Central differences `β = 0, γ = ½`: explicit, since M is lumped.
    pub const CENTRAL: Scheme = Scheme { beta: 0.0, gamma: 0.5, alpha: 0.0 };

    /// HHT with `β = ¼(1−α)²`, `γ = ½ − α`.
    ///
    /// # Errors
    /// α outside [−⅓, 0], where the scheme loses its stability.
    pub fn hht(alpha: f64) -> Result<Self> {
        if !(-1.0 / 3.0..=0.0).contains(&alpha) {
            return Err(Error::Material {
                what: "HHT scheme".into(),
                name: "alpha",
                value: alpha,
                mend: "give a number from -1/3 (most damping) to 0 (none)",
            });
        }
        Ok(Scheme { beta: 0.25 * (1.0 - alpha).powi(2), gamma: 0.5 - alpha, alpha })
    }
}

/// A factorised stepper of fixed step.
pub struct Newmark<'a> {
    system: &'a Semidiscrete,
    scheme: Scheme,
    step: f64,
    damping: f64,
    kkt: Kkt,
}

impl<'a> Newmark<'a> {
    /// Factorises for a step (s) and a mass-proportional damping rate `c` (1/s).
    ///
    /// # Errors
    /// A step that is not positive, a damping rate that is negative, a scheme that needs none of K (β = 0: step it
    /// explicitly), or a factorisation that fails.
    pub fn new(
        system: &'a Semidiscrete,
        scheme: Scheme,
        step: f64,
        damping: f64,
        work: &mut Work,
    ) -> Result<Self> {
        check_step(step)?;
        let bad = |name, value, mend| Error::Material { what: "implicit stepping".into(), name, value, mend };
        if !(damping.is_finite() && damping >= 0.0) {
            return Err(bad("damping", damping, "give a rate in 1/s, zero or more"));
        }
        if scheme.beta <= 0.0 {
            return Err(bad("beta", scheme.beta, "give a positive number; step explicitly for zero"));
        }
        let ahead = 1.0 + scheme.alpha;
        let (on_mass, on_stiffness) =
            (1.0 + ahead * damping * scheme.gamma * step, ahead * scheme.beta * step * step);
        let mut triplets = Triplets::default();
        system.mass.iter().enumerate().for_each(|(i, m)| triplets.push(i, i, on_mass * m));
        system.stiffness.entries().for_each(|(r, c, k)| triplets.push(r, c, on_stiffness * k));
        let matrix = SymmetricMatrix::from_triplets(system.mass.len(), &triplets);
        let kkt = Kkt::new(&matrix, &system.rows, &system.layout(), work)?;
        Ok(Newmark { system, scheme, step, damping, kkt })
    }

    /// Goes on by one step, with the loads scaled by `factors` at its beginning and end. Returns the multipliers.
    ///
    /// # Errors
    /// A solve whose residual stays too large.
    pub fn step(&self, motion: &mut Motion, factors: [f64; 2], work: &mut Work) -> Result<Vec<f64>> {
        let Scheme { beta, gamma, alpha } = self.scheme;
        let (dt, c, mass) = (self.step, self.damping, &self.system.mass);
        let ahead = 1.0 + alpha;
        let n = motion.u.len();
        let mut u_alpha = vec![0.0; n];
        let mut v_alpha = vec![0.0; n];
        for i in 0..n {
            let (u, v, a) = (motion.u[i], motion.v[i], motion.a[i]);
            motion.u[i] = u + dt * v + (0.5 - beta) * dt * dt * a;
            motion.v[i] = v + (1.0 - gamma) * dt * a;
            u_alpha[i] = ahead * motion.u[i] - alpha * u;
            v_alpha[i] = ahead * motion.v[i] - alpha * v;
        }
        let mut rhs = self.system.force(ahead * factors[1] - alpha * factors[0]);
        let internal = self.system.internal(&u_alpha, work);
        for i in 0..n {
            rhs[i] -= internal[i] + c * mass[i] * v_alpha[i];
        }
        // Near rest the acceleration is a small difference of large forces.
        let motions: Vec<f64> = motion.u.iter().map(|u| u / (beta * dt * dt)).collect();
        let still = vec![0.0; self.system.rows.len()];
        let solution = self.kkt.solve_beside(&rhs, &still, [&internal, &motions], work)?;
        for i in 0..n {
            let a = solution.u[i];
            motion.u[i] += beta * dt * dt * a;
            motion.v[i] += gamma * dt * a;
            motion.a[i] = a;
        }
        motion.time += dt;
        work.steps += 1;
        Ok(solution.multipliers)
    }
}

/// The state with given displacements and velocities at `time`, and the acceleration that fits:
/// `M a + Bᵀλ = f − K u − c M v`, `B a = 0`. Returns the multipliers too.
///
/// # Errors
/// A solve that fails.
pub fn start(
    system: &Semidiscrete,
    (u, v): (Vec<f64>, Vec<f64>),
    time: f64,
    factor: f64,
    damping: f64,
    work: &mut Work,
) -> Result<(Motion, Vec<f64>)> {
    let internal = system.internal(&u, work);
    let mut rhs = system.force(factor);
    for i in 0..rhs.len() {
        rhs[i] -= internal[i] + damping * system.mass[i] * v[i];
    }
    let kkt = Kkt::new(&system.mass_matrix(), &system.rows, &system.layout(), work)?;
    // Held in equilibrium, the acceleration is rounding beside what K u would cause alone.
    let alone: Vec<f64> = internal.iter().zip(&system.mass).map(|(k, m)| k / m).collect();
    let solution = kkt.solve_beside(&rhs, &vec![0.0; system.rows.len()], [&internal, &alone], work)?;
    Ok((Motion { time, u, v, a: solution.u }, solution.multipliers))
}

/// # Errors
/// A step that is not positive and finite.
pub(crate) fn check_step(step: f64) -> Result<()> {
    if step.is_finite() && step > 0.0 {
        return Ok(());
    }
    Err(Error::Material {
        what: "time stepping".into(),
        name: "step_s",
        value: step,
        mend: "give a positive step in seconds",
    })
}
