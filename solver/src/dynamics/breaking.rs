//! Bonds that break, and particles that touch, while a network moves.
//!
//! At the end of every step the laws look at the bonds; what fails loses stiffness before the next forces. With the velocity sum of
//! [`super::ledger`] the energies then balance exactly if a failing bond takes
//!
//! `½ u_nᵀ ΔK u_{n+1}`, ΔK the stiffness it loses,
//!
//! since its force is in the sum of the step before but not in that of the step after. Contact forces act from the step after on, between
//! particles that have lost a bond and any other; broken pairs press but do not heal.

use super::forces::InternalForces;
use crate::contact::law::ContactLaw;
use crate::contact::{ContactEnergy, Contacts};
use crate::cracking::modes::{modes, product};
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::failure::Failure;
use crate::model::{Model, Numbering, Part};
use crate::space::Vec3;
use crate::work::Work;
use std::ops::Range;

/// A bond that lost stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// When, in s.
    pub time: f64,
    /// Part of the model.
    pub part: usize,
    /// The bond.
    pub bond: usize,
    /// Its middle in the undeformed body, in m.
    pub place: Vec3,
    /// What is left of its stiffness: zero broken.
    pub integrity: f64,
    /// Energy it took, in J.
    pub energy: f64,
}

/// Laws of a model in motion.
#[derive(Debug, Clone)]
pub struct Breaking {
    bodies: Vec<Body>,
    losses: Vec<Loss>,
    /// Contact forces on all unknowns, in N and N m.
    contact: Vec<f64>,
    /// Step that they belong to.
    contact_step: Option<u64>,
    /// Bonds that fail in this step.
    failing: Vec<usize>,
}

#[derive(Debug, Clone)]
struct Body {
    part: usize,
    unknowns: Range<usize>,
    /// Weights are what is left of the bonds.
    network: Network,
    failure: Failure,
    contacts: Option<Contacts>,
}

impl Breaking {
    /// Laws for parts of a model; with `contact`, their particles touch once they have lost a bond.
    ///
    /// # Errors
    /// A law for a part without bonds or made for another one; a contact law out of range.
    pub fn new(model: &Model, laws: Vec<(usize, Failure)>, contact: Option<ContactLaw>) -> Result<Self> {
        let numbering = Numbering::new(model);
        let mut bodies = Vec::with_capacity(laws.len());
        for (part, failure) in laws {
            let refuse = |message: String| Err(Error::Load { what: "breaking bonds".to_owned(), message });
            let network = match model.parts.get(part) {
                Some(Part::Discrete { network, .. }) if network.bonds.len() == failure.integrity().len() => {
                    network
                }
                Some(other) => {
                    let message = "the failure law is not made for its bonds; make it for this body";
                    return refuse(format!("body '{}': {message}", other.name()));
                }
                None => return refuse(format!("there is no part {part} for a failure law")),
            };
            let first = numbering.offset(part);
            let unknowns = first..first + network.particles.len() * network.space.dofs_per_particle();
            let contacts = contact.map(|law| Contacts::new(law, network)).transpose()?;
            bodies.push(Body { part, unknowns, network: network.clone(), failure, contacts });
        }
        Ok(Breaking {
            bodies,
            losses: Vec::new(),
            contact: vec![0.0; if contact.is_some() { numbering.len() } else { 0 }],
            contact_step: None,
            failing: Vec::new(),
        })
    }

    /// What was lost so far, in order.
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// Networks with what is left of their bonds, by part.
    pub fn networks(&self) -> impl Iterator<Item = (usize, &Network)> {
        self.bodies.iter().map(|b| (b.part, &b.network))
    }

    /// Energies in contacts.
    pub fn contact_energy(&self) -> ContactEnergy {
        let mut sum = ContactEnergy::default();
        for e in self.bodies.iter().filter_map(|b| b.contacts.as_ref()).map(Contacts::energy) {
            sum.stored += e.stored;
            sum.damped += e.damped;
            sum.friction += e.friction;
            sum.sliding += e.sliding;
        }
        sum
    }

    /// Number of pairs that touch now.
    pub fn touching(&self) -> usize {
        self.bodies.iter().filter_map(|b| b.contacts.as_ref()).map(Contacts::touching).sum()
    }

    /// Contact forces at the displacements `u` of a step and the velocities half a step before; the same when asked again. `None`
    /// where nothing can touch yet.
    pub(super) fn contact(
        &mut self,
        step: u64,
        u: &[f64],
        v: &[f64],
        dt: f64,
        work: &mut Work,
    ) -> Option<&[f64]> {
        if self.losses.is_empty() || self.contact.is_empty() {
            return None;
        }
        if self.contact_step != Some(step) {
            self.contact_step = Some(step);
            self.contact.fill(0.0);
            for Body { unknowns: own, contacts, .. } in &mut self.bodies {
                if let Some(contacts) = contacts {
                    let f = &mut self.contact[own.clone()];
                    contacts.add_forces(&u[own.clone()], &v[own.clone()], dt, f, work);
                }
            }
        }
        Some(&self.contact)
    }

    /// Lets bonds fail at the end of a step of length `dt` to `u`, whose velocity was `v`. Returns the energy they took, in J.
    pub(super) fn after_step(
        &mut self,
        time: f64,
        (u, v, dt): (&[f64], &[f64], f64),
        forces: &mut InternalForces,
        work: &mut Work,
    ) -> f64 {
        let mut spent = 0.0;
        for Body { part, unknowns, network, failure, contacts } in &mut self.bodies {
            let (now, rate) = (&u[unknowns.clone()], &v[unknowns.clone()]);
            work.bond_updates += failure.failing_at(network, now, &mut self.failing);
            for &bond in &self.failing {
                let (before, integrity) = (network.bonds.weight[bond], failure.integrity()[bond]);
                let left = failure.fail(bond);
                let after = before * (left / integrity);
                let of = |m: &Vec<(usize, f64)>| {
                    let at_end = product(m, now);
                    (at_end - dt * product(m, rate)) * at_end
                };
                let energy =
                    0.5 * (1.0 - after / before) * modes(network, bond, before).iter().map(of).sum::<f64>();
                network.bonds.weight[bond] = after;
                forces.set_weight(*part, network, bond);
                spent += energy;
                let ends = network.bonds.ends[bond];
                if let Some(contacts) = contacts.as_mut().filter(|_| after == 0.0) {
                    contacts.bond_lost(ends);
                }
                let x = &network.particles.position;
                let place = 0.5 * (x[ends[0]] + x[ends[1]]);
                self.losses.push(Loss { time, part: *part, bond, place, integrity: left, energy });
            }
        }
        spent
    }
}
