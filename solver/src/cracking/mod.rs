//! Quasi-static cracking by events.
//!
//! A linear model under a load in proportion: demands of all laws ([`crate::failure`]) grow with the load factor λ, so the next failure is
//! where the demand at λ = 1 is largest, at `λ = 1/demand`. That site fails, the equilibrium is found anew, and so on. Between
//! events the path runs along rays from the origin; softening is followed by its secants (sequentially linear analysis,
//! Rots & Invernizzi 2004). Load and displacement may both fall from event to event: snap-back needs no special care.
//!
//! Force F and displacement q are conjugate: with loads F = λ and `q = λ f·û`; with prescribed displacements q = λ and F the
//! generalised reaction. At each event q is held, and what strain energy is lost follows from the failing bonds alone (Betti):
//!
//! `½ q² (S_before − S_after) = ½ u_b·ΔK u_a = ½ u_b·ΔK u_b + ½ u_b·ΔK (u_a − u_b)`, S = F/q,
//!
//! with both states at the same q: the energy of the failing bonds, and what the bodies around them let go.

pub mod adaptive;
mod base;
mod capacitance;
mod inherit;
pub(crate) mod modes;
mod options;
mod path;
mod pieces;
mod system;

pub use options::Options;
pub use path::{EnergyLedger, Event, Exchange, Outcome, Stop, energies, envelope};
pub use system::Updating;

use crate::error::{Error, Result};
use crate::failure::forces::BondForce;
use crate::failure::{Failure, Site};
use crate::model::{Model, Numbering, Part};
use crate::space::Vec3;
use crate::work::Work;
use modes::{modes, product};
use system::{Holding, System, Weakened};

/// Bodies are unloaded when no demand exceeds this share of the first: what is left is rounding.
const UNLOADED: f64 = 1e-9;

/// A model on its way to failure.
pub struct Cracking {
    system: System,
    laws: Vec<(usize, Failure)>,
    options: Options,
    /// Whether displacements are prescribed, not loads.
    driven: bool,
    /// Stiffness F/q, and q at load factor one.
    stiffness: f64,
    displacement: f64,
    first_stiffness: f64,
    first_demand: Option<f64>,
    events: Vec<Event>,
    exchanges: Vec<Exchange>,
    next: Option<Next>,
    stop: Option<Stop>,
}

/// The site that fails next.
struct Next {
    law: usize,
    site: Site,
    /// At load factor one.
    demand: f64,
}

impl Cracking {
    /// Solves the intact model; `laws` go with parts of it.
    ///
    /// # Errors
    /// As [`crate::solve::statics::solve`]; loads and prescribed displacements together, or neither; a law for a part that is no
    /// network, or made for another; a tolerance or limit out of range.
    pub fn new(model: &Model, laws: Vec<(usize, Failure)>, options: Options) -> Result<Self> {
        options::check(model, &laws, &options)?;
        let driven = model.supports.iter().any(|s| s.value != 0.0);
        if driven == model.loads.iter().any(|l| l.value != 0.0) {
            let message = if driven {
                "loads and prescribed displacements act together; a load in proportion has one factor: give one kind"
            } else {
                "nothing loads it; give loads or prescribed displacements"
            };
            return Err(Error::Load { what: "cracking".to_owned(), message: message.to_owned() });
        }
        let system = System::new(model, options.updating)?;
        let mut cracking = Cracking {
            system,
            laws,
            options,
            driven,
            stiffness: 0.0,
            displacement: 0.0,
            first_stiffness: 0.0,
            first_demand: None,
            events: Vec::new(),
            exchanges: Vec::new(),
            next: None,
            stop: None,
        };
        (cracking.displacement, cracking.stiffness) = cracking.response();
        cracking.first_stiffness = cracking.stiffness;
        Ok(cracking)
    }

    /// Displacement q at load factor one, and stiffness `S = û·Kû / q²`.
    fn response(&self) -> (f64, f64) {
        let u = &self.system.u;
        let q = if self.driven { 1.0 } else { dot(&self.system.load, u) };
        (q, dot(u, &self.system.internal) / (q * q))
    }

    /// Displacements and rotations of all unknowns at load factor one (m, rad) in the last equilibrium there was; zero for what was
    /// torn off.
    pub fn displacements(&self) -> &[f64] {
        &self.system.u
    }

    /// The laws with their parts, as far as they have come.
    pub fn laws(&self) -> &[(usize, Failure)] {
        &self.laws
    }

    /// Stiffness F/q of the present state.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The present model; weights of bonds are what is left of them.
    pub fn model(&self) -> &Model {
        &self.system.model
    }

    /// Where its unknowns are.
    pub fn numbering(&self) -> &Numbering {
        &self.system.numbering
    }

    /// The failures so far.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Exchanges of the model so far.
    pub fn exchanges(&self) -> &[Exchange] {
        &self.exchanges
    }

    /// Stiffness F/q of the intact model.
    pub fn first_stiffness(&self) -> f64 {
        self.first_stiffness
    }

    /// Forces that supports and ties exert on all unknowns at load factor one in the last equilibrium there was, in N and N m.
    pub fn reactions(&self) -> Vec<f64> {
        self.system.internal.iter().zip(&self.system.load).map(|(k, f)| k - f).collect()
    }

    /// Displacement q at load factor one.
    pub fn displacement(&self) -> f64 {
        self.displacement
    }

    /// Points that were torn off, as (part, point) of the present model.
    pub fn torn_off(&self) -> &[(usize, usize)] {
        self.system.torn_off()
    }

    /// Why the path has ended; `None` while it goes on.
    pub fn stop(&self) -> Option<&Stop> {
        self.stop.as_ref()
    }

    /// Ends the path.
    fn end(&mut self, stop: Stop) {
        self.stop = Some(stop);
    }

    /// Goes on with another model of the same bodies, whose laws have kept what was lost, at the load factor `factor` of the
    /// present one: q is held.
    ///
    /// # Errors
    /// As [`Cracking::new`].
    fn exchange(&mut self, model: &Model, laws: Vec<(usize, Failure)>, factor: f64) -> Result<()> {
        options::check_fit(model, &laws)?;
        let (q, before) = (factor * self.displacement, self.stiffness);
        self.system = System::resumed(model, self.options.updating, &mut self.system)?;
        (self.laws, self.next) = (laws, None);
        (self.displacement, self.stiffness) = self.response();
        self.exchanges.push(Exchange {
            after_events: self.events.len(),
            factor,
            displacement: q,
            force: [before * q, self.stiffness * q],
            stiffness: [before, self.stiffness],
        });
        Ok(())
    }

    /// Load factor of the next event; `None` where nothing that may fail is loaded.
    fn next_factor(&mut self) -> Option<f64> {
        if self.next.is_none() {
            self.next = self.next_failure();
        }
        self.next.as_ref().map(|next| 1.0 / next.demand)
    }

    /// Work done so far.
    pub fn work(&self) -> Work {
        self.system.work
    }

    /// Finds and makes the next event; `None` at the end.
    ///
    /// # Errors
    /// Solves that fail.
    pub fn advance(&mut self) -> Result<Option<&Event>> {
        if self.stop.is_some() {
            return Ok(None);
        }
        let share = self.stiffness / self.first_stiffness;
        let least = self.options.least_stiffness;
        if least > 0.0 && !self.events.is_empty() && share <= least {
            self.end(Stop::StiffnessLimit { share });
            return Ok(None);
        }
        let Some(factor) = self.next_factor() else {
            self.end(self.nothing_fails());
            return Ok(None);
        };
        if factor > self.options.factor_limit {
            self.end(Stop::FactorLimit { factor });
            return Ok(None);
        }
        if self.events.len() >= self.options.events {
            self.end(Stop::EventLimit);
            return Ok(None);
        }
        let Some(Next { law, site, .. }) = self.next.take() else { return Ok(None) };
        let failing = self.fail(law, site);
        let before = self.system.u.clone();
        let stiffness = self.stiffness;
        let q = factor * self.displacement;
        let energy = 0.5 * q * q * stiffness;
        let holding = match self.system.weaken(&failing) {
            Ok(holding) => holding,
            Err(error) => {
                // What has failed is not in the state: there is no going on from it.
                self.end(Stop::Unsolved);
                return Err(error);
            }
        };
        let lost = |u: &[f64], v: &[f64]| {
            let of = |f: &Weakened| {
                (1.0 - f.after / f.before)
                    * f.modes.iter().map(|m| product(m, u) * product(m, v)).sum::<f64>()
            };
            0.5 * factor * failing.iter().map(of).sum::<f64>()
        };
        let fracture_energy = factor * lost(&before, &before);
        let radiated_energy = match holding {
            Holding::Held => {
                (self.displacement, self.stiffness) = self.response();
                q / self.displacement * lost(&before, &self.system.u) - fracture_energy
            }
            Holding::Separated(what) => {
                self.stiffness = 0.0;
                self.end(Stop::Separated { what });
                energy - fracture_energy
            }
        };
        self.system.work.steps += 1;
        let (part, failure) = &self.laws[law];
        let bonds: Vec<usize> = failing.iter().map(|f| f.bond).collect();
        let integrity = bonds.iter().map(|&b| failure.integrity()[b]).collect();
        let places = self.places(*part, &bonds);
        self.events.push(Event {
            part: *part,
            site,
            bonds,
            integrity,
            places,
            factor,
            displacement: q,
            force: stiffness * q,
            force_after: self.stiffness * q,
            energy_released: energy - 0.5 * q * q * self.stiffness,
            fracture_energy,
            radiated_energy,
            torn_off: self.system.torn_off().len(),
        });
        Ok(self.events.last())
    }

    /// Mid-points of bonds, in m.
    fn places(&self, part: usize, bonds: &[usize]) -> Vec<Vec3> {
        let Part::Discrete { network, .. } = &self.system.model.parts[part] else { return Vec::new() };
        let middle = |&b: &usize| {
            let [i, j] = network.bonds.ends[b];
            0.5 * (network.particles.position[i] + network.particles.position[j])
        };
        bonds.iter().map(middle).collect()
    }

    /// Why nothing fails any more.
    fn nothing_fails(&self) -> Stop {
        let left = self.laws.iter().any(|(_, f)| (0..f.integrity().len()).any(|b| f.may_break(b)));
        if left { Stop::Unloaded } else { Stop::EveryBondBroken }
    }

    /// The site that fails next; `None` where none is loaded.
    fn next_failure(&mut self) -> Option<Next> {
        let mut demands = vec![Vec::new(); self.laws.len()];
        let mut largest = 0.0f64;
        for ((part, failure), demands) in self.laws.iter().zip(&mut demands) {
            let Part::Discrete { network, .. } = &self.system.model.parts[*part] else { continue };
            let offset = self.system.numbering.offset(*part);
            self.system.work.bond_updates += failure.demands_at(network, &self.system.u[offset..], demands);
            largest = demands.iter().fold(largest, |m, d| m.max(*d));
        }
        // Without laws nothing has a demand yet.
        if largest == 0.0 {
            return None;
        }
        let first = *self.first_demand.get_or_insert(largest);
        if largest <= UNLOADED * first {
            return None;
        }
        let least = (1.0 - self.options.tie_tolerance) * largest;
        for (law, of_law) in demands.iter().enumerate() {
            if let Some(index) = of_law.iter().position(|d| *d >= least) {
                return Some(Next { law, site: self.laws[law].1.site(index), demand: of_law[index] });
            }
        }
        None
    }

    /// Lets a site fail: its bonds, with what is left of them.
    fn fail(&mut self, law: usize, site: Site) -> Vec<Weakened> {
        let (part, failure) = &mut self.laws[law];
        let Part::Discrete { network, .. } = &self.system.model.parts[*part] else { return Vec::new() };
        let offset = self.system.numbering.offset(*part);
        // A particle lets go by the forces in its bonds; a bond is its own answer.
        let forces = match site {
            Site::Particle(_) => {
                self.system.work.bond_updates += network.bonds.len() as u64;
                // What is left of a bond is in its weight.
                BondForce::all(network, &self.system.u[offset..], &vec![1.0; network.bonds.len()])
            }
            Site::Bond(_) => Vec::new(),
        };
        let bonds = failure.bonds_of(site, network, &forces);
        let weaken = |bond: usize| {
            let integrity = failure.integrity()[bond];
            let before = network.bonds.weight[bond];
            let after = before * (failure.fail(bond) / integrity);
            let own = modes(network, bond, before).into_iter();
            let modes = own.map(|m| m.into_iter().map(|(i, v)| (i + offset, v)).collect()).collect();
            Weakened { part: *part, bond, before, after, modes }
        };
        bonds.into_iter().map(weaken).collect()
    }

    /// Goes on to the end.
    ///
    /// # Errors
    /// As [`Cracking::advance`].
    pub fn run(mut self) -> Result<Outcome> {
        while self.advance()?.is_some() {}
        Ok(self.outcome())
    }

    /// What has happened so far; without a reason to stop, the number of events is it.
    pub fn outcome(self) -> Outcome {
        Outcome {
            torn_off: self.system.torn_off().to_vec(),
            events: self.events,
            exchanges: self.exchanges,
            stop: self.stop.unwrap_or(Stop::EventLimit),
            first_stiffness: self.first_stiffness,
            updates: self.system.updates,
            notes: self.system.notes,
            work: self.system.work,
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
