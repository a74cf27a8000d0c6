//! Central differences for a whole model, coupled by multipliers with equal steps.
//!
//! `v₊ = v₋ + Δt M⁻¹ (f_ext − f_int(u_n) + d)`, then the ties ([`super::interface`]), then `u_{n+1} = u_n + Δt v₊`.
//! Velocities live at the half steps; the state at `t_n` has `v_n = ½(v₋ + v₊)`, `a_n = (v₊ − v₋)/Δt`.

use super::State;
use super::breaking::Breaking;
use super::critical::{self, CriticalStep};
use super::damping::Damping;
use super::forces::{InternalForces, Rotations};
use super::interface::Interface;
use super::ledger::{Ledger, WorkDone};
use super::load::LoadFactor;
use super::semidiscrete::row_product;
use super::system::System;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// How to integrate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Time step Δt, in s.
    pub step_s: f64,
    /// Factor on the loads of the model.
    pub loads: LoadFactor,
    /// Factor on the prescribed displacements and rotations.
    pub supports: LoadFactor,
    /// Damping.
    pub damping: Damping,
    /// Small or finite rotations of particles. Finite ones start from unturned particles, `u` then holds the integral of
    /// the spin, and the critical step is that of the undeformed network.
    pub rotations: Rotations,
}

/// State, energies and gap at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// The motion.
    pub state: State,
    /// The energies.
    pub ledger: Ledger,
    /// Largest gap of the ties, in m.
    pub gap: f64,
    /// Forces of supports and ties on each unknown, in N and N m.
    pub reactions: Vec<f64>,
}

/// An explicit run.
pub struct Explicit {
    options: Options,
    pub(super) motion: Motion,
    system: System,
    pub(super) forces: InternalForces,
    interface: Interface,
    critical: CriticalStep,
    loaded: Vec<(usize, f64)>,
    held: Vec<(usize, f64)>,
    /// Unknowns with a share in a tie, ascending.
    tied: Vec<usize>,
    kick: Kick,
    breaking: Option<Breaking>,
    pub(super) work: Work,
}

/// What a run carries from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Motion {
    /// Time of step zero, in s.
    pub start: f64,
    /// Steps taken.
    pub step: u64,
    /// Displacements and rotations at `t_n`.
    pub u: Vec<f64>,
    /// Velocities half a step earlier, `v₋`.
    pub v: Vec<f64>,
    /// Work up to half a step earlier.
    pub done: WorkDone,
    /// Energy at the start.
    pub initial: f64,
}

/// What the forces at `t_n` do to the velocities. Made once and filled in every step.
#[derive(Default)]
struct Kick {
    /// `v₊`.
    v: Vec<f64>,
    /// `f_int(u_n)`.
    internal: Vec<f64>,
    /// Forces of the ties.
    ties: Vec<f64>,
    /// Forces of local damping; empty without.
    drag: Vec<f64>,
    /// Force of each support.
    supports: Vec<f64>,
    /// Multipliers of the ties, as impulses, and room for what they are solved from.
    multipliers: [Vec<f64>; 2],
    /// Power of each kind of force on `v₋` and on `v₊`, in W.
    power: [WorkDone; 2],
}

impl Explicit {
    /// As [`Explicit::new`], with bonds that break at the ends of steps.
    ///
    /// # Errors
    /// As [`Explicit::new`]; finite rotations.
    pub fn with_breaking(
        model: &Model,
        options: Options,
        initial: &State,
        breaking: Breaking,
    ) -> Result<Self> {
        if options.rotations == Rotations::Finite {
            let message = "bonds break under small rotations only; take these".to_owned();
            return Err(Error::Solve { message });
        }
        let mut run = Explicit::new(model, options, initial)?;
        run.breaking = Some(breaking);
        Ok(run)
    }

    /// Prepares a run from `initial`: displacements and velocities at its time; its accelerations follow from the forces.
    ///
    /// # Errors
    /// As [`System::new`]; a step beyond the critical one; loads that are undefined; a state that does not fit;
    /// finite rotations of a model with elements or from a state that is already turned.
    pub fn new(model: &Model, options: Options, initial: &State) -> Result<Self> {
        let motion = Motion {
            start: initial.time,
            step: 0,
            u: initial.u.clone(),
            v: initial.v.clone(),
            done: WorkDone::default(),
            initial: 0.0,
        };
        let mut run = Explicit::prepare(model, options, motion)?;
        run.refuse_turned_start(model)?;
        run.start()?;
        Ok(run)
    }

    /// Everything but the first half step.
    pub(super) fn prepare(model: &Model, options: Options, motion: Motion) -> Result<Self> {
        let system = System::new(model)?;
        options.loads.check("loads", f64::INFINITY)?;
        options.supports.check("supports", f64::INFINITY)?;
        options.damping.check()?;
        let mut critical = critical::bound(model)?;
        critical.step_s *= options.damping.step_factor();
        critical.admit(options.step_s)?;
        let n = system.numbering.len();
        let finite = |x: &[f64]| x.len() == n && x.iter().all(|x| x.is_finite());
        if !(finite(&motion.u) && finite(&motion.v) && motion.start.is_finite()) {
            return Err(Error::Solve {
                message: format!(
                    "the initial state needs {n} finite displacements and velocities, and a finite time"
                ),
            });
        }
        let mut work = Work::default();
        let forces = InternalForces::new(model, &system.numbering, options.rotations)?;
        let interface = Interface::new(&system, &mut work)?;
        let nonzero = |(i, f): (usize, &f64)| (*f != 0.0).then_some((i, *f));
        let loaded = system.load.iter().enumerate().filter_map(nonzero).collect();
        let held = system.prescribed.iter().enumerate().filter_map(|(i, p)| Some((i, (*p)?))).collect();
        let mut tied: Vec<usize> =
            system.rows.iter().flat_map(|row| row.terms.iter().map(|term| term.0)).collect();
        tied.sort_unstable();
        tied.dedup();
        let [v, internal, ties] = [(); 3].map(|()| vec![0.0; n]);
        let kick = Kick { v, internal, ties, ..Kick::default() };
        Ok(Explicit {
            options,
            motion,
            system,
            forces,
            interface,
            critical,
            loaded,
            held,
            tied,
            kick,
            breaking: None,
            work,
        })
    }

    fn refuse_turned_start(&self, model: &Model) -> Result<()> {
        let numbering = &self.system.numbering;
        let turned = |i: &usize| numbering.locate(*i).2 >= model.space.dim() && self.motion.u[*i] != 0.0;
        match (self.options.rotations, (0..numbering.len()).find(turned)) {
            (Rotations::Finite, Some(i)) => {
                let (part, point, _) = numbering.locate(i);
                let message = format!(
                    "with finite rotations particle {point} of body '{}' starts turned; start from unturned particles",
                    model.parts[part].name()
                );
                Err(Error::Solve { message })
            }
            _ => Ok(()),
        }
    }

    /// Half a step back: `v₋ = 2 v₀ − v₊` with `v₊ = v₀ + (Δt/2) a₀`, so that `v₀` is met at second order.
    fn start(&mut self) -> Result<()> {
        // With v₋ = v₀ a kick of half a step gives v₀ + (Δt/2) a₀, on the ties and supports.
        self.kick(0.5 * self.options.step_s)?;
        self.motion.v.iter_mut().zip(&self.kick.v).for_each(|(v0, v)| *v0 = 2.0 * *v0 - v);
        let start = self.observe()?;
        // Work is counted from t₀, half a step after v₋.
        let Ledger { work, kinetic, strain, .. } = start.ledger;
        self.motion.done = -1.0 * work;
        self.motion.initial = kinetic + strain;
        Ok(())
    }

    /// Time `t_n`, in s.
    pub fn time(&self) -> f64 {
        self.time_of(self.motion.step)
    }

    fn time_of(&self, step: u64) -> f64 {
        self.motion.start + step as f64 * self.options.step_s
    }

    /// Displacements and rotations at `t_n`.
    pub fn u(&self) -> &[f64] {
        &self.motion.u
    }

    /// Masses, supports and rows.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// How it is integrated.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The safe bound on the step, damping included.
    pub fn critical(&self) -> &CriticalStep {
        &self.critical
    }

    /// What was done so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Bonds that have broken, and contacts; `None` where nothing breaks.
    pub fn breaking(&self) -> Option<&Breaking> {
        self.breaking.as_ref()
    }

    /// Takes `steps` steps.
    ///
    /// # Errors
    /// Motion that is no longer finite; ties that cannot be met.
    pub fn advance(&mut self, steps: u64) -> Result<()> {
        for _ in 0..steps {
            self.step()?;
        }
        match self.motion.u.iter().position(|u| !u.is_finite()) {
            Some(i) => {
                let (part, point, _) = self.system.numbering.locate(i);
                let message =
                    format!("part {part}, point {point} moves to infinity; look for infinite loads");
                Err(Error::Solve { message })
            }
            None => Ok(()),
        }
    }

    fn step(&mut self) -> Result<()> {
        let dt = self.options.step_s;
        self.kick(dt)?;
        let [before, after] = self.kick.power;
        self.motion.done += 0.5 * dt * (before + after);
        std::mem::swap(&mut self.motion.v, &mut self.kick.v);
        let Motion { u, v, .. } = &mut self.motion;
        u.iter_mut().zip(&*v).for_each(|(u, v)| *u += dt * v);
        self.forces.turn(v, dt);
        self.motion.step += 1;
        self.work.steps += 1;
        if let Some(breaking) = &mut self.breaking {
            let time = self.motion.start + self.motion.step as f64 * dt;
            let Motion { u, v, done, .. } = &mut self.motion;
            done.fracture -= breaking.after_step(time, (u, v, dt), &mut self.forces, &mut self.work);
        }
        Ok(())
    }

    /// State, energies and gap at `t_n`. Costs one evaluation of the forces and changes nothing.
    ///
    /// # Errors
    /// As [`Explicit::advance`].
    pub fn observe(&mut self) -> Result<Observation> {
        let dt = self.options.step_s;
        self.kick(dt)?;
        let (Motion { u, v: v_before, .. }, kick) = (&self.motion, &self.kick);
        let pairs = || v_before.iter().zip(&kick.v);
        let kinetic = 0.5 * pairs().zip(&self.system.mass).map(|((a, b), m)| m * a * b).sum::<f64>();
        let strain = self.forces.energy(u, &kick.internal);
        let work = self.motion.done + 0.5 * dt * kick.power[0];
        let mut reactions = kick.ties.clone();
        self.held.iter().zip(&kick.supports).for_each(|(&(i, _), s)| reactions[i] += s);
        Ok(Observation {
            ledger: Ledger { kinetic, strain, work, initial: self.motion.initial },
            gap: self.system.gap(u),
            reactions,
            state: State {
                time: self.time(),
                u: u.clone(),
                v: pairs().map(|(a, b)| 0.5 * (a + b)).collect(),
                a: pairs().map(|(a, b)| (b - a) / dt).collect(),
            },
        })
    }

    /// `v₊` from `v₋`, `dt` apart, under the forces at `t_n`.
    fn kick(&mut self, dt: f64) -> Result<()> {
        let (now, factor) = (self.time(), self.options.loads.at(self.time()));
        let (system, before, u) = (&self.system, &self.motion.v, &self.motion.u);
        let Kick { v, internal, ties, drag, supports, multipliers, power } = &mut self.kick;
        internal.fill(0.0);
        self.forces.add(u, internal, &mut self.work);
        // A viscous force on v_n = ½(v₋ + v₊) divides by 1 + αΔt/2.
        let viscous = 0.5 * dt * self.options.damping.rate();
        let (keep, push) = ((1.0 - viscous) / (1.0 + viscous), dt / (1.0 + viscous));
        let inverse_mass = self.interface.inverse_mass();
        let old = before.iter().zip(inverse_mass.iter().zip(&*internal));
        v.iter_mut().zip(old).for_each(|(v, (before, (w, f)))| *v = keep * before - push * w * f);
        self.loaded.iter().for_each(|&(i, f)| v[i] += push * inverse_mass[i] * factor * f);
        let contact = self.breaking.as_mut().and_then(|breaking| {
            breaking.contact(self.motion.step, u, before, self.options.step_s, &mut self.work)
        });
        if let Some(contact) = contact {
            v.iter_mut().zip(inverse_mass.iter().zip(contact)).for_each(|(v, (w, f))| *v += push * w * f);
        }
        let goal = self.options.supports.at(now + self.options.step_s);
        self.held.iter().for_each(|&(i, value)| v[i] = (goal * value - u[i]) / self.options.step_s);

        self.tied.iter().for_each(|&i| ties[i] = 0.0);
        let [lambda, room] = multipliers;
        lambda.clear();
        lambda.resize(system.rows.len(), 0.0);
        self.interface.project_adding(system, v, ties, [lambda, room], &mut self.work)?;
        let drag = self.options.damping.drag(dt, (before, v), system, drag);
        if let Some(drag) = drag {
            (0..v.len()).for_each(|i| v[i] += dt * drag[i] / system.mass[i]);
            self.interface.project_adding(system, v, ties, [lambda, room], &mut self.work)?;
        }
        let per_impulse = (1.0 + viscous) / dt;
        self.tied.iter().for_each(|&i| ties[i] *= per_impulse);

        supports.clear();
        supports.extend(self.held.iter().map(|&(i, _)| {
            let force = factor * system.load[i] - internal[i] + contact.map_or(0.0, |f| f[i]);
            system.mass[i] * (v[i] - before[i]) / dt - force - ties[i]
        }));
        *power = [before, &*v].map(|w| {
            let loads: f64 = self.loaded.iter().map(|&(i, f)| factor * f * w[i]).sum();
            let moving: f64 = self.held.iter().zip(&*supports).map(|(&(i, _), s)| s * w[i]).sum();
            let rows = system.rows.iter().zip(&*lambda);
            let touch = contact.map_or(0.0, |f| f.iter().zip(w).map(|(f, w)| f * w).sum());
            WorkDone {
                external: loads + moving,
                damping: self.options.damping.power(drag, before, v, w, system),
                interface: -per_impulse * rows.map(|(row, l)| l * row_product(&row.terms, w)).sum::<f64>(),
                contact: touch,
                // Taken at the ends of steps.
                fracture: 0.0,
            }
        });
        Ok(())
    }
}
