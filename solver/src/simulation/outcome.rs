//! What comes out of a run.

use crate::contact::ContactEnergy;
use crate::dynamics::State;
use crate::dynamics::breaking::{Breaking, Loss};
use crate::model::Model;
use crate::transfer::report::SwitchReport;
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Energies since the start, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Energies {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Strain energy.
    pub strain: f64,
    /// Work of loads and moving supports.
    pub external: f64,
    /// Work of damping, that of the scheme itself included: negative.
    pub damping: f64,
    /// Work of the ties.
    pub interface: f64,
    /// Work of contacts: negative while they close.
    pub contact: f64,
    /// Taken by bonds that failed: negative.
    pub fracture: f64,
    /// What the switches added: energy after less energy before.
    pub transfer: f64,
    /// Kinetic and strain energy at the start.
    pub initial: f64,
}

impl Energies {
    /// Energy that no entry accounts for.
    pub fn imbalance(&self) -> f64 {
        let work = self.external + self.damping + self.interface + self.contact + self.fracture;
        self.kinetic + self.strain - (self.initial + work + self.transfer)
    }

    /// [`Energies::imbalance`] over the largest entry; zero if all are zero.
    pub fn closure(&self) -> f64 {
        let entries = [
            self.kinetic,
            self.strain,
            self.external,
            self.damping,
            self.interface,
            self.contact,
            self.fracture,
            self.transfer,
            self.initial,
        ];
        let largest = entries.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        if largest > 0.0 { self.imbalance().abs() / largest } else { 0.0 }
    }
}

/// A moment of a run.
pub struct Snapshot<'a> {
    /// The model as it is now.
    pub model: &'a Model,
    /// Its motion.
    pub state: &'a State,
    /// Load factor.
    pub factor: f64,
    /// Energies.
    pub energies: Energies,
    /// Largest gap of the ties now, in m: rows of mortar ties are means, rows of rotations times a length.
    pub gap: f64,
    /// Largest gap of the ties so far, between outputs too, in m.
    pub widest_gap: f64,
    /// Forces of supports and ties on each unknown, in N and N m.
    pub reactions: &'a [f64],
    /// Switches so far.
    pub switches: usize,
    /// Bonds that fail and what is left of them; `None` where none may.
    pub breaking: Option<&'a Breaking>,
    pub(super) freeze: &'a dyn Fn() -> Vec<u8>,
}

impl Snapshot<'_> {
    /// Bonds that have lost stiffness so far, each time counted.
    pub fn losses(&self) -> usize {
        self.breaking.map_or(0, |b| b.losses().len())
    }

    /// What [`super::resume`] needs to go on from here, bit by bit.
    pub fn checkpoint(&self) -> Vec<u8> {
        (self.freeze)()
    }
}

/// The end of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The model at the end; weights of bonds are what is left of them.
    pub model: Model,
    /// Its motion.
    pub state: State,
    /// Energies at the end.
    pub energies: Energies,
    /// Largest [`Energies::closure`] of all snapshots.
    pub worst_closure: f64,
    /// Name of the rule and report of every switch, in order.
    pub switches: Vec<(String, SwitchReport)>,
    /// Bonds that lost stiffness, in order.
    pub losses: Vec<Loss>,
    /// Energies in contacts at the end.
    pub contact: ContactEnergy,
    /// Rows that were dropped and steps that were chosen, in words.
    pub notes: Vec<String>,
    /// What was done.
    pub work: Work,
    /// Wall time of the switches, in s. Not deterministic.
    pub switch_seconds: f64,
}
