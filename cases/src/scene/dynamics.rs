//! `[dynamics]`: a run in time instead of one equilibrium.

use super::none::{self, none_or};
use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a scene moves. It begins at time zero, undeformed; probes then give histories.
///
/// A key that the stepping does not know is refused. A variant takes an optional key away by the value `"none"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dynamics {
    /// How time is stepped.
    pub stepping: Stepping,
    /// End of the run, in s.
    pub end_s: Number,
    /// Time step, in s; with two rates that of the elements.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    pub step_s: Option<Number>,
    /// Explicit only: time step as a share of the critical one, which a switch changes.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    pub step_share: Option<Number>,
    /// Two rates only: time step of the particles, in s; `step_s` is divided into whole parts no longer than this.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    pub fine_s: Option<Number>,
    /// Two rates only: the same as a share of the critical step.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    pub fine_share: Option<Number>,
    /// Implicit only: α of HHT, from −1/3 (most damping of high frequencies) to 0 (trapezoidal rule).
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    pub alpha: Option<Number>,
    /// Two rates only: how the two meet.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<Rates>")]
    pub method: Option<Rates>,
    /// Equal intervals between the stations of a history.
    #[serde(default = "two_hundred")]
    pub outputs: Number,
    /// Damping; none if not given.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<Damping>")]
    pub damping: Option<Damping>,
    /// Factor on all loads over time.
    #[serde(default)]
    pub loads: Loads,
    /// Velocity at the start, in m/s, fields of x, y, z; at rest if not given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub initial_velocity: Vec<Number>,
    /// How far particles may turn.
    #[serde(default)]
    pub rotations: Rotations,
}

fn two_hundred() -> Number {
    Number::Literal(200.0)
}

/// How time is stepped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Stepping {
    /// Equilibria under the loads of each time, without inertia.
    QuasiStatic,
    /// Newmark's trapezoidal rule, or HHT-α.
    Implicit,
    /// Central differences.
    Explicit,
    /// Elements implicitly at the time step, particles explicitly at a fraction of it.
    TwoRates,
}

impl Stepping {
    /// Name as in the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::QuasiStatic => "quasi-static",
            Self::Implicit => "implicit",
            Self::Explicit => "explicit",
            Self::TwoRates => "two-rates",
        }
    }
}

/// How two rates meet.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rates {
    /// Multipliers on coarse steps, linear in between (2004): no energy lost at the interface.
    #[default]
    PrakashHjelmstad,
    /// Multipliers on every fine step (2001): dissipates at the interface.
    GravouilCombescure,
}

/// Damping, in one of three ways.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Damping {
    /// Mass-proportional: rate α of `−α M v`, in 1/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_per_s: Option<Number>,
    /// Mass-proportional: damping ratio at the period `period_s`; α = 2·ratio·2π/period.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ratio: Option<Number>,
    /// Period that `ratio` is meant for, in s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_s: Option<Number>,
    /// Local (Cundall 1987), explicit only: share of the unbalanced force that opposes the motion, below 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<Number>,
}

/// Factor on all loads over time.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Loads {
    /// One from the start on.
    #[default]
    Sudden,
    /// From zero linearly to one, then constant.
    Ramp(Ramp),
    /// Rows of time (s) and factor, ascending; linear in between, constant outside.
    Table(Vec<[Number; 2]>),
}

/// A linear rise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// Begin of the rise, in s.
    #[serde(default = "zero")]
    pub start_s: Number,
    /// Length of the rise, in s.
    pub rise_s: Number,
}

fn zero() -> Number {
    Number::Literal(0.0)
}

/// How far particles may turn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rotations {
    /// Small rotations: linear bonds.
    #[default]
    Small,
    /// Any angle; explicit steps of particles alone.
    Finite,
}
