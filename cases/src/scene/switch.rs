//! `[switches.NAME]`: elements that become particles while the scene runs.

use super::body::Cuboid;
use super::connection::{Multipliers, TieMethod};
use super::de::De;
use super::number::Number;
use schemars::JsonSchema;
use seam_solver::transfer::fields::Mode;
use serde::{Deserialize, Serialize};

/// One switch: when and where (`at_s` or `at_load` with a `box`, or a `criterion` that finds its place), and what
/// the elements become.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Switch {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// Name of a body of finite elements.
    pub body: String,
    /// At the end of the first step that reaches this time, in s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_s: Option<Number>,
    /// When the load factor first reaches this value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_load: Option<Number>,
    /// Whenever elements meet a criterion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub criterion: Option<Criterion>,
    /// Where: the elements whose centre lies inside. With `at_s` and `at_load`.
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<Cuboid>,
    /// What the particles take over. While cracking nothing is: the equilibrium is found anew.
    #[serde(default)]
    pub fields: Fields,
    /// How the new faces are tied.
    #[serde(default)]
    pub ties: NewTies,
    /// The particles; `rows` count across the height of the whole body.
    pub de: De,
}

/// A criterion: one indicator, `stress` or `error`, and when it fires.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Criterion {
    /// Largest principal stress, averaged over a length, over the strength.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<StressIndicator>,
    /// Estimated error of an element over that of an even share (Zienkiewicz and Zhu 1987).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorIndicator>,
    /// Elements with an indicator of at least this fire.
    pub trigger: Number,
    /// Elements closer than this to one that fired go too, in m; its neighbours always.
    #[serde(default = "zero")]
    pub buffer_m: Number,
    /// In time: how often it is asked, in s. While cracking it is asked before every event.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub every_s: Option<Number>,
    /// While cracking: when the region has to grow, it takes elements this much farther than it has to, in m, and grows less often.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stride_m: Option<Number>,
    /// While cracking: the region always holds this box, e.g. a notch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holds: Option<Cuboid>,
    /// Most switches.
    #[serde(default = "once")]
    pub most: Number,
    /// Axes along which the region always reaches through the whole body: `["y"]` takes the whole height of a beam.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through: Vec<Axis>,
    /// Elements are forgotten below this value, lower than the trigger; never if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<Number>,
}

fn zero() -> Number {
    Number::Literal(0.0)
}

fn once() -> Number {
    Number::Literal(1.0)
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Along the length.
    X,
    /// Across the height.
    Y,
    /// Through the thickness; solid only.
    Z,
}

/// Stress over strength.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StressIndicator {
    /// Tensile strength, in Pa.
    #[serde(rename = "strength_Pa", default, skip_serializing_if = "Option::is_none")]
    pub strength_pa: Option<Number>,
    /// Diameter over which the stress is averaged, in m; zero for none.
    #[serde(default = "zero")]
    pub length_m: Number,
}

/// Recovery-based error estimate; it has no settings.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ErrorIndicator {}

/// What the particles take over from the elements.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Fields {
    /// Displacement alone: bonds are strained by rotations that the particles do not have.
    #[serde(rename = "displacement")]
    Displacement,
    /// Displacement and rotation, at rest.
    #[serde(rename = "displacement+rotation")]
    Rotation,
    /// Displacement, rotation, velocity and spin; momentum is kept.
    #[default]
    #[serde(rename = "displacement+rotation+velocity")]
    Velocity,
    /// As before, with the displacements relaxed to equilibrium inside a held interface.
    #[serde(rename = "displacement+rotation+velocity+re-equilibrate")]
    ReEquilibrate,
}

impl From<Fields> for Mode {
    fn from(fields: Fields) -> Self {
        match fields {
            Fields::Displacement => Mode::Displacement,
            Fields::Rotation => Mode::Rotation,
            Fields::Velocity => Mode::Velocity,
            Fields::ReEquilibrate => Mode::ReEquilibrate,
        }
    }
}

/// Ties of the new faces; the elements are their first side, the particles the second.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NewTies {
    /// Node by node, or averaged.
    #[serde(default)]
    pub method: TieMethod,
    /// Which side carries the multipliers.
    #[serde(default)]
    pub multipliers: Multipliers,
    /// Whether particle rotations are tied to the rotation of the elements.
    #[serde(default)]
    pub rotations: bool,
}
