//! What to run.

use crate::contact::law::ContactLaw;
use crate::coupling::{Method, Multipliers};
use crate::dem::arrangement::Matter;
use crate::dem::block::Block;
use crate::dem::network::Network;
use crate::dynamics::damping::Damping;
use crate::dynamics::forces::Rotations;
use crate::dynamics::load::LoadFactor;
use crate::dynamics::multirate;
use crate::dynamics::newmark::Scheme;
use crate::error::Result;
use crate::failure::Failure;
use crate::transfer::criterion::Criterion;
use crate::transfer::fields::Mode;

/// Length of a time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// In s.
    Seconds(f64),
    /// As a share of the critical step of the model as it is; a switch brings a new one.
    ShareOfCritical(f64),
}

/// How time is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepping {
    /// Equilibria under the loads of each time, without inertia.
    QuasiStatic {
        /// Between two equilibria, in s.
        step_s: f64,
    },
    /// Newmark or HHT for the whole model.
    Implicit {
        /// The scheme.
        scheme: Scheme,
        /// Δt, in s.
        step_s: f64,
    },
    /// Central differences for the whole model.
    Explicit {
        /// Δt.
        step: Step,
    },
    /// Elements implicitly at `step_s`, particles explicitly at a fraction of it; without particles, [`Stepping::Implicit`], and
    /// without elements, [`Stepping::Explicit`]. Undamped, and the scheme is the trapezoidal rule.
    TwoRates {
        /// How the two meet.
        method: multirate::Method,
        /// Scheme of the elements.
        scheme: Scheme,
        /// ΔT of the elements, in s.
        step_s: f64,
        /// δt of the particles: `step_s` is divided by the least whole number that makes it no longer.
        fine: Step,
    },
}

/// When a switch happens, and where.
#[derive(Debug, Clone, PartialEq)]
pub enum When {
    /// At the end of the first step that reaches this time (s), in a box.
    Time {
        /// Time, in s.
        time_s: f64,
        /// Where.
        block: Block,
    },
    /// When the load factor first reaches this value, in a box.
    LoadLevel {
        /// Load factor, dimensionless.
        factor: f64,
        /// Where.
        block: Block,
    },
    /// Whenever a criterion chooses elements that are not yet particles: it finds the region and may do so again. The region is the
    /// box around all that it chose so far; what of it is not particles yet is filled in boxes, each a body.
    Criterion {
        /// What chooses.
        criterion: Criterion,
        /// How often it is asked, in s; never tied to output.
        every_s: f64,
        /// Most times that the region may be made or grow.
        most: usize,
        /// Axes along which the region always reaches through the whole body, as over the section of a beam.
        through: [bool; 3],
    },
}

/// A rule by which elements become particles.
pub struct SwitchRule<'a> {
    /// Name of the rule; the bodies of particles are named after it.
    pub name: String,
    /// Name of the body of elements, as in the model at the start: its pieces belong to it.
    pub body: String,
    /// When and where.
    pub when: When,
    /// Packs particles into a box.
    pub fill: &'a dyn Fn(Block, Matter) -> Result<Network>,
    /// How the new faces are tied.
    pub method: Method,
    /// Which side of the new ties carries the multipliers.
    pub multipliers: Multipliers,
    /// Whether the new ties hold rotations.
    pub rotations: bool,
    /// What the particles take over.
    pub mode: Mode,
    /// Whether rotations are taken from the polar decomposition.
    pub finite: bool,
}

/// A run.
pub struct Plan<'a> {
    /// How time is stepped.
    pub stepping: Stepping,
    /// End of the run, in s; it begins at zero, at rest.
    pub end_s: f64,
    /// Velocity of each point at the start, in m/s, by part and point; at rest if `None`.
    pub initial_velocity: Option<&'a dyn Fn(usize, crate::space::Vec3) -> crate::space::Vec3>,
    /// Factor on the loads over time. Supports keep their values from the start on.
    pub loads: LoadFactor,
    /// Damping. Implicit steps know no local damping, two rates and equilibria none at all; they refuse it.
    pub damping: Damping,
    /// Small or finite rotations of particles; finite ones need explicit steps and no elements.
    pub rotations: Rotations,
    /// Equal intervals between snapshots over the run; one is taken at the start too.
    pub outputs: usize,
    /// What is switched on the way.
    pub switches: Vec<SwitchRule<'a>>,
    /// Laws by which bonds break, with the part of each; explicit steps without switches.
    pub laws: Vec<(usize, Failure)>,
    /// How particles touch that have lost a bond; with `laws` only.
    pub contact: Option<ContactLaw>,
}
