//! Contact of particles that have lost a bond: with each other and with any other particle.
//!
//! A search lists pairs that are close, a [`law`] gives their forces. Pairs that are still bonded do not touch; a broken pair
//! that closes presses, but does not heal. Particles that overlap in the reference state (as bonded ones may) touch at their
//! reference distance: breaking a bond makes no force by itself.
//!
//! Nothing is searched until a bond is lost.

pub mod law;
mod search;

use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use crate::work::Work;
use law::{ContactLaw, Pair, Spring};
use search::Search;
use std::collections::{BTreeMap, BTreeSet};

/// Contacts of one network in motion.
#[derive(Debug, Clone)]
pub struct Contacts {
    law: ContactLaw,
    damping: f64,
    space: Space,
    reference: Vec<Vec3>,
    radius: Vec<f64>,
    mass: Vec<f64>,
    bonded: BTreeSet<(usize, usize)>,
    active: BTreeSet<usize>,
    search: Search,
    /// Tangential spring of each touching pair.
    springs: BTreeMap<(usize, usize), Spring>,
    energy: ContactEnergy,
}

/// Energy in contacts, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactEnergy {
    /// In the normal and tangential springs now.
    pub stored: f64,
    /// Spent by normal damping so far.
    pub damped: f64,
    /// Spent by sliding so far.
    pub friction: f64,
    /// `∫F_n |ds|` over all sliding so far: what friction of coefficient one would spend on the same way.
    pub sliding: f64,
}

impl Contacts {
    /// Prepares the particles of a network; its bonds of positive weight are intact.
    ///
    /// # Errors
    /// As [`ContactLaw::check`]; a particle without radius or mass.
    pub fn new(law: ContactLaw, network: &Network) -> Result<Self> {
        law.check()?;
        let particles = &network.particles;
        for (name, values) in [("radius", &particles.radius), ("mass", &particles.mass)] {
            if let Some(p) = values.iter().position(|v| !(v.is_finite() && *v > 0.0)) {
                return Err(Error::Geometry {
                    what: "contact".to_owned(),
                    message: format!("particle {p} has {name} {}; give it a positive one", values[p]),
                });
            }
        }
        let ends = network.bonds.ends.iter().zip(&network.bonds.weight);
        Ok(Contacts {
            law,
            damping: law.damping_ratio(),
            space: network.space,
            reference: particles.position.clone(),
            radius: particles.radius.clone(),
            mass: particles.mass.clone(),
            bonded: ends.filter(|(_, w)| **w > 0.0).map(|(e, _)| ordered(*e)).collect(),
            active: BTreeSet::new(),
            search: Search::default(),
            springs: BTreeMap::new(),
            energy: ContactEnergy::default(),
        })
    }

    /// Tells of a broken bond: its particles may touch each other and all others from now on.
    pub fn bond_lost(&mut self, ends: [usize; 2]) {
        self.bonded.remove(&ordered(ends));
        ends.iter().for_each(|&p| self.activate(p));
    }

    /// Lets a particle touch without a broken bond.
    pub fn activate(&mut self, particle: usize) {
        if self.active.insert(particle) {
            self.search.forget();
        }
    }

    /// Number of pairs that touch.
    pub fn touching(&self) -> usize {
        self.springs.len()
    }

    /// Energies of the last call of [`Contacts::add_forces`] and before.
    pub fn energy(&self) -> ContactEnergy {
        self.energy
    }

    /// `f += contact forces` (N, N m) at displacements `u` and velocities `v` of the network's unknowns, `dt` (s) after the call before:
    /// tangential springs stretch and sliding spends energy over this time.
    pub fn add_forces(&mut self, u: &[f64], v: &[f64], dt: f64, f: &mut [f64], work: &mut Work) {
        if self.active.is_empty() {
            return;
        }
        let dim = self.space.dim();
        let per = self.space.dofs_per_particle();
        let vector = |x: &[f64], p: usize| Vec3::from_fn(|c, _| if c < dim { x[p * per + c] } else { 0.0 });
        let spin = |p: usize| {
            let mut w = Vec3::zeros();
            let axes = self.space.rotation_axes().iter().enumerate();
            axes.for_each(|(k, &axis)| w[axis] = v[p * per + dim + k]);
            w
        };
        let position: Vec<Vec3> = self.reference.iter().enumerate().map(|(p, x)| x + vector(u, p)).collect();
        self.search.renew(self.space, &position, &self.radius, &self.active, &self.bonded, work);
        self.energy.stored = 0.0;
        let mut springs = BTreeMap::new();
        for &(i, j) in self.search.pairs() {
            work.contact_checks += 1;
            let d = position[j] - position[i];
            let sum = self.radius[i] + self.radius[j];
            let touch = sum.min((self.reference[j] - self.reference[i]).norm());
            let distance = d.norm();
            // Coincident centres have no direction to push along.
            if distance >= touch || distance == 0.0 {
                continue;
            }
            let n = d / distance;
            let arms = [i, j].map(|p| self.radius[p] / sum * distance);
            let approach = vector(v, j) - vector(v, i) - (arms[0] * spin(i) + arms[1] * spin(j)).cross(&n);
            let pair = Pair {
                overlap: touch - distance,
                rate: -approach.dot(&n),
                mass: self.mass[i] * self.mass[j] / (self.mass[i] + self.mass[j]),
                radius: self.radius[i] * self.radius[j] / sum,
            };
            let normal = self.law.normal(&pair, self.damping);
            let slide = approach - n * n.dot(&approach);
            let mut spring = self.springs.get(&(i, j)).copied().unwrap_or_default();
            spring.stretch = turned(spring.stretch, &n);
            let tangential = self.law.tangential(&pair, normal.force, spring, slide * dt);
            springs.insert((i, j), tangential.spring);
            self.energy.stored += normal.stored + tangential.stored;
            self.energy.damped += normal.damping_power * dt;
            self.energy.friction += tangential.slid;
            self.energy.sliding += normal.force * tangential.way;
            // On particle i: pushed back along −n, dragged along with the slide of j.
            let force = tangential.force - normal.force * n;
            for (p, force, arm) in [(i, force, arms[0] * n), (j, -force, -arms[1] * n)] {
                (0..dim).for_each(|c| f[p * per + c] += force[c]);
                let moment = arm.cross(&force);
                let axes = self.space.rotation_axes().iter().enumerate();
                axes.for_each(|(k, &axis)| f[p * per + dim + k] += moment[axis]);
            }
        }
        self.springs = springs;
    }
}

/// A tangential spring turned into the present tangent plane, at its length.
fn turned(spring: Vec3, n: &Vec3) -> Vec3 {
    let flat = spring - n * n.dot(&spring);
    let length = flat.norm();
    if length > 0.0 { flat * (spring.norm() / length) } else { Vec3::zeros() }
}

fn ordered([i, j]: [usize; 2]) -> (usize, usize) {
    (i.min(j), i.max(j))
}
