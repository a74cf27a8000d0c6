//! The path through the events, its envelope and its energy.

use crate::failure::Site;
use crate::space::Vec3;
use crate::work::Work;

/// One failure.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Part of the model.
    pub part: usize,
    /// What failed.
    pub site: Site,
    /// The bonds that broke or softened with it, ascending.
    pub bonds: Vec<usize>,
    /// What is left of the stiffness of each: zero broken.
    pub integrity: Vec<f64>,
    /// Mid-points of these bonds in the undeformed body, in m.
    pub places: Vec<Vec3>,
    /// Load factor λ.
    pub factor: f64,
    /// Conjugate displacement q: work is `∫F dq`, in J.
    pub displacement: f64,
    /// Force F before the failure.
    pub force: f64,
    /// Force at the same displacement after it.
    pub force_after: f64,
    /// Strain energy lost at held displacement, in J: from the response of the whole model.
    pub energy_released: f64,
    /// Energy of the failing bonds themselves, in J: `½ u_b·ΔK u_b`. A softening bond spends its `A G_f` here.
    pub fracture_energy: f64,
    /// What the bodies around them let go while they relax, in J: `½ u_b·ΔK (u_a − u_b)`. In motion it would be waves. In a separation
    /// there is no state after; it is then what is left.
    pub radiated_energy: f64,
    /// Number of points torn off so far.
    pub torn_off: usize,
}

/// Another model that took the place of the one before, at held displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exchange {
    /// Events before it.
    pub after_events: usize,
    /// Load factor λ.
    pub factor: f64,
    /// Conjugate displacement q.
    pub displacement: f64,
    /// Force F of the old model and of the new one.
    pub force: [f64; 2],
    /// Stiffness F/q of both.
    pub stiffness: [f64; 2],
}

impl Exchange {
    /// Strain energy that the exchange added, in J: `½ q² (S_after − S_before)`.
    pub fn energy(&self) -> f64 {
        0.5 * self.displacement * (self.force[1] - self.force[0])
    }

    /// Jump over the value before: one number for energy, reaction and stiffness, which at held q are in proportion.
    pub fn jump(&self) -> f64 {
        let [before, after] = self.stiffness;
        if before != 0.0 { after / before - 1.0 } else { 0.0 }
    }
}

/// Why it ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// Nothing is left that may break.
    EveryBondBroken,
    /// What carries load is no longer held.
    Separated {
        /// Which point.
        what: String,
    },
    /// No bond that may break carries any load: the supports hold separate pieces, or all is in compression.
    Unloaded,
    /// The next event lies beyond the limit.
    FactorLimit {
        /// Its load factor.
        factor: f64,
    },
    /// Less than the asked share of the first stiffness is left.
    StiffnessLimit {
        /// The share that is left.
        share: f64,
    },
    /// As many events as were asked for.
    EventLimit,
    /// The equilibrium after a failure was not found: the error said why.
    Unsolved,
}

/// What became of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The failures in order.
    pub events: Vec<Event>,
    /// Models that took the place of others on the way.
    pub exchanges: Vec<Exchange>,
    /// Points no longer held by anything that bears load, as (part, point), in the order they came off.
    pub torn_off: Vec<(usize, usize)>,
    /// Why it ended.
    pub stop: Stop,
    /// Stiffness F/q of the intact model.
    pub first_stiffness: f64,
    /// Events that were followed by a low-rank update alone.
    pub updates: u64,
    /// Constraint rows that were dropped, and why.
    pub notes: Vec<String>,
    /// What was done.
    pub work: Work,
}

/// Energies along the path, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EnergyLedger {
    /// Work of loads or moving supports: `∫F dq`.
    pub external: f64,
    /// Strain energy left after the last event.
    pub strain: f64,
    /// Energy of the bonds that failed.
    pub fracture: f64,
    /// Energy let go around them.
    pub radiated: f64,
    /// What exchanges of the model added.
    pub transfer: f64,
}

impl EnergyLedger {
    /// What no entry accounts for, over the largest entry; zero if all are zero.
    pub fn closure(&self) -> f64 {
        let EnergyLedger { external, strain, fracture, radiated, transfer } = *self;
        let entries = [external, strain, fracture, radiated, transfer];
        let largest = entries.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        let gap = external + transfer - strain - fracture - radiated;
        if largest > 0.0 { gap.abs() / largest } else { 0.0 }
    }
}

impl Outcome {
    /// Largest force along the path, with its displacement: the peak under displacement control too. `None` without events.
    pub fn peak(&self) -> Option<[f64; 2]> {
        let highest = self.events.iter().max_by(|a, b| a.force.total_cmp(&b.force));
        highest.map(|e| [e.displacement, e.force])
    }

    /// As [`envelope()`].
    pub fn envelope(&self) -> Vec<[f64; 2]> {
        envelope(&self.events)
    }

    /// Energies along the path from the origin to just after the last event.
    pub fn energies(&self) -> EnergyLedger {
        energies(&self.events, &self.exchanges)
    }
}

/// Energies along a path from the origin: rays are elastic, and at an event or exchange the displacement is held.
pub fn energies(events: &[Event], exchanges: &[Exchange]) -> EnergyLedger {
    let mut ledger = EnergyLedger::default();
    let (mut q, mut force) = (0.0, 0.0);
    let mut go = |to: [f64; 2], after: f64| {
        let work = 0.5 * (force + to[1]) * (to[0] - q);
        (q, force) = (to[0], after);
        (work, 0.5 * force * q)
    };
    let mut exchanges = exchanges.iter().peekable();
    for k in 0..=events.len() {
        while let Some(exchange) = exchanges.next_if(|e| e.after_events == k) {
            let (work, strain) = go([exchange.displacement, exchange.force[0]], exchange.force[1]);
            ledger.external += work;
            ledger.strain = strain;
            ledger.transfer += exchange.energy();
        }
        let Some(event) = events.get(k) else { break };
        let (work, strain) = go([event.displacement, event.force], event.force_after);
        ledger.external += work;
        ledger.strain = strain;
        ledger.fracture += event.fracture_energy;
        ledger.radiated += event.radiated_energy;
    }
    ledger
}

/// Force against displacement under displacement control, as corners `[q, F]` from the origin on: events that the path reaches at a
/// smaller displacement than one before happen at once.
pub fn envelope(events: &[Event]) -> Vec<[f64; 2]> {
    let mut corners = vec![[0.0, 0.0]];
    let mut events = events.iter().peekable();
    let mut reached = f64::NEG_INFINITY;
    while let Some(event) = events.next() {
        reached = reached.max(event.displacement);
        corners.push([event.displacement, event.force]);
        let mut last = event;
        while let Some(next) = events.next_if(|e| e.displacement <= reached) {
            last = next;
        }
        corners.push([reached, stiffness_after(last) * reached]);
    }
    corners
}

fn stiffness_after(event: &Event) -> f64 {
    if event.displacement > 0.0 { event.force_after / event.displacement } else { 0.0 }
}
