//! Two sides, each with its own time step and scheme, tied by multipliers on velocities.
//!
//! The coarse side makes one step ΔT while the fine side makes m steps `δt = ΔT/m`; each is explicit or implicit.
//!
//! - Gravouil & Combescure (2001): `L_A v_A + L_B v_B = 0` at every fine step, the free velocity of the coarse side being
//!   interpolated. Dissipates at the interface for m > 1.
//! - Prakash & Hjelmstad (2004): the same at the end of every coarse step only, multipliers linear in between (their
//!   unbalanced reactions vanish for loads that are linear over a coarse step). The interface takes no algorithmic energy.
//!
//! What "energy" means is in [`Ledger`].

mod checkpoint;
pub mod side;

use super::semidiscrete::{Motion, Semidiscrete, dot};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::work::Work;
use nalgebra::{DMatrix, DVector, Dyn, LU};
use serde::{Deserialize, Serialize};
use side::{Side, SideMotion, Stepping};

/// How the two rates meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// A multiplier every fine step.
    GravouilCombescure,
    /// A multiplier every coarse step.
    PrakashHjelmstad,
}

/// What to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Rates {
    /// How the sides meet.
    pub method: Method,
    /// ΔT, in s.
    pub coarse_step: f64,
    /// Fine steps per coarse step.
    pub ratio: usize,
    /// Scheme of the coarse side.
    pub coarse: Stepping,
    /// Scheme of the fine side.
    pub fine: Stepping,
    /// Indices of the parts on the fine side.
    pub fine_parts: Vec<usize>,
}

/// Energies of a run so far.
///
/// For γ = ½ each side obeys `[½aᵀAa + ½vᵀKv] = (1/Δt)[v]ᵀ[f]` exactly (Hughes 1983), brackets being
/// changes over a step: the algorithmic energy changes by what loads and interface do in this sense, in J/s². The physical work of the
/// interface, `−Σ ½(λ_n + λ_{n+1})·L[u]` of both sides in J, is another matter and not zero: it and the work of the loads are what
/// changes [`Multirate::kinetic`] and strain energy.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Ledger {
    /// Algorithmic energy now, in J/s².
    pub algorithmic: f64,
    /// The part of its change that came from loads, in J/s².
    pub external: f64,
    /// The part of its change that came from the interface, in J/s².
    pub interface: f64,
    /// Physical work of the interface on both sides, in J.
    pub physical_interface: f64,
    /// Physical work of the loads on both sides, `Σ ½(f_n + f_{n+1})·Δu`, in J.
    pub physical_external: f64,
    /// Largest gap of a constraint in displacement now, in m: velocities are tied, displacements drift.
    pub gap: f64,
}

/// A run at two rates.
pub struct Multirate<'a> {
    system: &'a Semidiscrete,
    method: Method,
    ratio: usize,
    coarse: Side,
    fine: Side,
    coarse_motion: SideMotion,
    fine_motion: SideMotion,
    interface: LU<f64, Dyn, Dyn>,
    /// Prakash–Hjelmstad: what a multiplier that grows from 0 to 1 over a coarse step does to the fine side.
    ramps: Vec<Ramp>,
    lambda: Vec<f64>,
    time: f64,
    ledger: Ledger,
    /// Loads at factor one on the coarse and the fine side, in N and N m.
    loads: [Vec<f64>; 2],
}

/// Response of the fine side to one multiplier that grows from 0 to 1.
struct Ramp {
    end: SideMotion,
    /// `L u` after each fine step.
    traces: Vec<Vec<f64>>,
    /// `f·u` with the loads at factor one after each fine step.
    loaded: Vec<f64>,
}

impl<'a> Multirate<'a> {
    /// Starts from a motion and its multipliers, as [`super::newmark::start`] gives them.
    ///
    /// # Errors
    /// A ratio of zero; a side without unknowns; an unstable explicit step; a row tied within the fine side where multipliers
    /// act on coarse steps only; an interface matrix that cannot be inverted.
    pub fn new(
        model: &Model,
        system: &'a Semidiscrete,
        rates: &Rates,
        (motion, lambda): (&Motion, Vec<f64>),
        work: &mut Work,
    ) -> Result<Self> {
        if rates.ratio == 0 {
            return Err(Error::Material {
                what: "two time steps".to_owned(),
                name: "ratio",
                value: 0.0,
                mend: "give at least one fine step per coarse step",
            });
        }
        let is_fine = |p: usize| rates.fine_parts.contains(&p);
        let coarse = Side::new(model, system, |p| !is_fine(p), rates.coarse, rates.coarse_step, work)?;
        let fine_step = rates.coarse_step / rates.ratio as f64;
        let fine = Side::new(model, system, is_fine, rates.fine, fine_step, work)?;
        let of = |side: &Side| SideMotion {
            u: side.restrict(&motion.u),
            v: side.restrict(&motion.v),
            a: side.restrict(&motion.a),
        };
        let (coarse_motion, fine_motion) = (of(&coarse), of(&fine));
        let loads = [&coarse, &fine].map(|side| side.restrict(&system.load));
        let ramps = match rates.method {
            Method::GravouilCombescure => Vec::new(),
            Method::PrakashHjelmstad => {
                refuse_inner_rows(system, &coarse, rates.ratio)?;
                ramps(&fine, &loads[1], system.rows.len(), rates.ratio, work)?
            }
        };
        let interface = interface(&coarse, &fine, &ramps, system.rows.len(), work)?;
        let algorithmic = coarse.algorithmic_energy(&coarse_motion) + fine.algorithmic_energy(&fine_motion);
        let ledger = Ledger { algorithmic, gap: system.gap(&motion.u), ..Ledger::default() };
        let (method, ratio, time) = (rates.method, rates.ratio, motion.time);
        Ok(Multirate {
            system,
            method,
            ratio,
            coarse,
            fine,
            coarse_motion,
            fine_motion,
            interface,
            ramps,
            lambda,
            time,
            ledger,
            loads,
        })
    }

    /// One coarse step, with the loads scaled by `factor(time)`.
    ///
    /// # Errors
    /// A solve whose residual stays too large; motion that is no longer finite.
    pub fn step(&mut self, factor: impl Fn(f64) -> f64, work: &mut Work) -> Result<()> {
        match self.method {
            Method::GravouilCombescure => self.step_with_fine_multipliers(factor, work)?,
            Method::PrakashHjelmstad => self.step_with_coarse_multipliers(factor, work)?,
        }
        self.time += self.coarse.step;
        let motion = self.motion();
        self.ledger.gap = self.system.gap(&motion.u);
        self.ledger.algorithmic = self.coarse.algorithmic_energy(&self.coarse_motion)
            + self.fine.algorithmic_energy(&self.fine_motion);
        if !self.ledger.algorithmic.is_finite() {
            let message =
                format!("the motion is no longer finite at {:.3e} s; use a smaller step", self.time);
            return Err(Error::Solve { message });
        }
        Ok(())
    }

    /// Energies so far.
    pub fn ledger(&self) -> Ledger {
        self.ledger
    }

    /// Kinetic energy of both sides, in J: with `½vᵀM v + ½(β−¼)Δt² aᵀM a`, which is `½ v₋ᵀM v₊` for central differences, physical
    /// work balances exactly.
    pub fn kinetic(&self) -> f64 {
        self.coarse.kinetic(&self.coarse_motion) + self.fine.kinetic(&self.fine_motion)
    }

    /// Multipliers at the end of the last step, in the units of the rows.
    pub fn multipliers(&self) -> &[f64] {
        &self.lambda
    }

    /// The motion of both sides.
    pub fn motion(&self) -> Motion {
        let n = self.system.mass.len();
        let mut motion = Motion { time: self.time, u: vec![0.0; n], v: vec![0.0; n], a: vec![0.0; n] };
        for (side, own) in [(&self.coarse, &self.coarse_motion), (&self.fine, &self.fine_motion)] {
            for (place, &i) in side.unknowns.iter().enumerate() {
                (motion.u[i], motion.v[i], motion.a[i]) = (own.u[place], own.v[place], own.a[place]);
            }
        }
        motion
    }

    /// `H λ_j = (1−j/m) L_A v_A⁰ + (j/m) L_A v_A¹ + L_B v_B` with free velocities, at every fine step j.
    fn step_with_fine_multipliers(&mut self, factor: impl Fn(f64) -> f64, work: &mut Work) -> Result<()> {
        let (before, first) = (self.coarse_motion.clone(), self.lambda.clone());
        // v_A⁰ is the velocity at the beginning without its link.
        let link = self.coarse.trace(&self.coarse.link(&first, work)?.v);
        let start: Vec<f64> = self.coarse.trace(&before.v).iter().zip(&link).map(|(v, l)| v - l).collect();
        let end_force = self.system.force(factor(self.time + self.coarse.step));
        self.coarse.step(&mut self.coarse_motion, &self.coarse.restrict(&end_force), work)?;
        let end = self.coarse.trace(&self.coarse_motion.v);
        let mut scale = factor(self.time);
        let mut force = self.system.force(scale);
        for j in 1..=self.ratio {
            let (old, last) = (self.fine_motion.clone(), self.lambda.clone());
            let (last_scale, last_force) = (scale, force);
            scale = factor(self.time + j as f64 * self.fine.step);
            force = self.system.force(scale);
            self.fine.step(&mut self.fine_motion, &self.fine.restrict(&force), work)?;
            let share = j as f64 / self.ratio as f64;
            let own = self.fine.trace(&self.fine_motion.v);
            let rhs = (0..own.len()).map(|k| (1.0 - share) * start[k] + share * end[k] + own[k]);
            self.lambda = self.invert(rhs.collect())?;
            self.fine_motion.add(1.0, &self.fine.link(&self.lambda, work)?);
            self.book(Which::Fine, &old, [&last_force, &force], [&last, &self.lambda.clone()]);
            let moved = difference(&self.fine.trace(&self.fine_motion.u), &self.fine.trace(&old.u));
            self.ledger.physical_interface -= mean_dot(&last, &self.lambda, &moved);
            let moved = difference(&self.fine_motion.u, &old.u);
            self.ledger.physical_external += 0.5 * (last_scale + scale) * dot(&self.loads[1], &moved);
        }
        self.coarse_motion.add(1.0, &self.coarse.link(&self.lambda, work)?);
        self.close_coarse(&before, &first, factor);
        Ok(())
    }

    /// `H λ = L_A v_A + L_B v_B` at the end of the coarse step, the fine side having felt `(1−j/m) λ⁰`.
    fn step_with_coarse_multipliers(&mut self, factor: impl Fn(f64) -> f64, work: &mut Work) -> Result<()> {
        let (coarse_before, fine_before, first) =
            (self.coarse_motion.clone(), self.fine_motion.clone(), self.lambda.clone());
        let end_force = self.system.force(factor(self.time + self.coarse.step));
        self.coarse.step(&mut self.coarse_motion, &self.coarse.restrict(&end_force), work)?;
        let fading = self.fine.push(&first);
        let mut traces = vec![self.fine.trace(&fine_before.u)];
        let (mut scales, mut loaded) = (vec![factor(self.time)], vec![dot(&self.loads[1], &fine_before.u)]);
        for j in 1..=self.ratio {
            let share = j as f64 / self.ratio as f64;
            scales.push(factor(self.time + j as f64 * self.fine.step));
            let force = self.system.force(scales[j]);
            let mut force = self.fine.restrict(&force);
            force.iter_mut().zip(&fading).for_each(|(f, p)| *f += (1.0 - share) * p);
            self.fine.step(&mut self.fine_motion, &force, work)?;
            traces.push(self.fine.trace(&self.fine_motion.u));
            loaded.push(dot(&self.loads[1], &self.fine_motion.u));
        }
        let own = self.fine.trace(&self.fine_motion.v);
        let rhs = self.coarse.trace(&self.coarse_motion.v).iter().zip(&own).map(|(a, b)| a + b).collect();
        self.lambda = self.invert(rhs)?;
        for (ramp, &l) in self.ramps.iter().zip(&self.lambda) {
            self.fine_motion.add(l, &ramp.end);
            for (trace, response) in traces[1..].iter_mut().zip(&ramp.traces) {
                trace.iter_mut().zip(response).for_each(|(t, r)| *t += l * r);
            }
            loaded[1..].iter_mut().zip(&ramp.loaded).for_each(|(f, r)| *f += l * r);
        }
        self.coarse_motion.add(1.0, &self.coarse.link(&self.lambda, work)?);
        let at = |share: f64| -> Vec<f64> {
            first.iter().zip(&self.lambda).map(|(a, b)| (1.0 - share) * a + share * b).collect()
        };
        for j in 1..=self.ratio {
            let moved = difference(&traces[j], &traces[j - 1]);
            let shares = [j - 1, j].map(|k| k as f64 / self.ratio as f64);
            self.ledger.physical_interface -= mean_dot(&at(shares[0]), &at(shares[1]), &moved);
            self.ledger.physical_external += 0.5 * (scales[j - 1] + scales[j]) * (loaded[j] - loaded[j - 1]);
        }
        // [v] of the fine steps adds up, since [λ] and, for loads linear over the step, [f] are the same in each:
        // Σ (1/δt) [v_j]·[λ]/m = (1/ΔT) [v]·[λ].
        let (start, end) = (self.system.force(factor(self.time)), end_force);
        let lambda = self.lambda.clone();
        self.book(Which::FineOverCoarse, &fine_before, [&start, &end], [&first, &lambda]);
        self.close_coarse(&coarse_before, &first, factor);
        Ok(())
    }

    /// Books the coarse side's part of a step.
    fn close_coarse(&mut self, before: &SideMotion, first: &[f64], factor: impl Fn(f64) -> f64) {
        let scales = [self.time, self.time + self.coarse.step].map(factor);
        let forces = scales.map(|s| self.system.force(s));
        let lambda = self.lambda.clone();
        self.book(Which::Coarse, before, [&forces[0], &forces[1]], [first, &lambda]);
        let moved = difference(&self.coarse.trace(&self.coarse_motion.u), &self.coarse.trace(&before.u));
        self.ledger.physical_interface -= mean_dot(first, &lambda, &moved);
        let moved = difference(&self.coarse_motion.u, &before.u);
        self.ledger.physical_external += 0.5 * (scales[0] + scales[1]) * dot(&self.loads[0], &moved);
    }

    /// `(1/Δt)[v]ᵀ[f]` and `−(1/Δt)[L v]·[λ]` of one side.
    fn book(&mut self, which: Which, before: &SideMotion, force: [&[f64]; 2], lambda: [&[f64]; 2]) {
        let (side, now, step) = match which {
            Which::Coarse => (&self.coarse, &self.coarse_motion, self.coarse.step),
            Which::Fine => (&self.fine, &self.fine_motion, self.fine.step),
            Which::FineOverCoarse => (&self.fine, &self.fine_motion, self.coarse.step),
        };
        let gained = difference(&now.v, &before.v);
        let load = side.restrict(&difference(force[1], force[0]));
        self.ledger.external += dot(&gained, &load) / step;
        self.ledger.interface -= dot(&side.trace(&gained), &difference(lambda[1], lambda[0])) / step;
    }

    fn invert(&self, rhs: Vec<f64>) -> Result<Vec<f64>> {
        let solved = self.interface.solve(&DVector::from_vec(rhs)).ok_or_else(singular)?;
        Ok(solved.as_slice().to_vec())
    }
}

/// Which step a line of the ledger is for.
enum Which {
    Coarse,
    Fine,
    FineOverCoarse,
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// `½(p + q)·x`.
fn mean_dot(p: &[f64], q: &[f64], x: &[f64]) -> f64 {
    0.5 * (dot(p, x) + dot(q, x))
}

fn singular() -> Error {
    Error::Solve {
        message: "the interface matrix L M̃⁻¹Lᵀ is singular; look for ties that repeat".to_owned()
    }
}

/// Response of the fine side from rest to each multiplier growing linearly over a coarse step.
fn ramps(fine: &Side, load: &[f64], rows: usize, ratio: usize, work: &mut Work) -> Result<Vec<Ramp>> {
    (0..rows)
        .map(|k| {
            let unit = fine.push(&unit(rows, k));
            let mut motion = SideMotion::zero(unit.len());
            let (mut traces, mut loaded) = (Vec::with_capacity(ratio), Vec::with_capacity(ratio));
            for j in 1..=ratio {
                let share = j as f64 / ratio as f64;
                let force: Vec<f64> = unit.iter().map(|f| share * f).collect();
                fine.step(&mut motion, &force, work)?;
                traces.push(fine.trace(&motion.u));
                loaded.push(dot(load, &motion.u));
            }
            Ok(Ramp { end: motion, traces, loaded })
        })
        .collect()
}

/// Minus what unit multipliers do to the constrained velocities: the matrix to invert.
fn interface(
    coarse: &Side,
    fine: &Side,
    ramps: &[Ramp],
    rows: usize,
    work: &mut Work,
) -> Result<LU<f64, Dyn, Dyn>> {
    let mut h = DMatrix::zeros(rows, rows);
    for k in 0..rows {
        let lambda = unit(rows, k);
        let of_coarse = coarse.trace(&coarse.link(&lambda, work)?.v);
        let of_fine = match ramps.get(k) {
            Some(ramp) => fine.trace(&ramp.end.v),
            None => fine.trace(&fine.link(&lambda, work)?.v),
        };
        (0..rows).for_each(|r| h[(r, k)] = -(of_coarse[r] + of_fine[r]));
    }
    let lu = h.lu();
    if !lu.is_invertible() {
        return Err(singular());
    }
    Ok(lu)
}

fn unit(rows: usize, k: usize) -> Vec<f64> {
    (0..rows).map(|r| if r == k { 1.0 } else { 0.0 }).collect()
}

/// # Errors
/// A tie between bodies of the fine side: it would hold at the end of coarse steps only.
fn refuse_inner_rows(system: &Semidiscrete, coarse: &Side, ratio: usize) -> Result<()> {
    match (0..system.rows.len()).find(|&k| ratio > 1 && !coarse.touches(k)) {
        None => Ok(()),
        Some(k) => Err(Error::EmptyInterface {
            tie: system.labels[k].clone(),
            message: "it ties bodies of the fine side to each other, but Prakash-Hjelmstad ties at coarse steps only; use Gravouil-Combescure, or \
                      implicit steps for all"
                .to_owned(),
        }),
    }
}
