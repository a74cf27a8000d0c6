//! `[contact]`: how particles press and slide once they have lost a bond; explicit steps only.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One law for all: exactly one of `linear`, `hertz` along the normal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Force in proportion to the overlap.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear: Option<Linear>,
    /// Two elastic spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hertz: Option<Hertz>,
    /// Coefficient of restitution of a free collision, above 0.1353 (critical damping), up to 1.
    pub restitution: Number,
    /// Coefficient of friction.
    #[serde(default = "frictionless")]
    pub friction: Number,
    /// Tangential over normal stiffness.
    #[serde(default = "two_sevenths")]
    pub stiffness_ratio: Number,
}

impl Contact {
    /// Whether a coefficient of friction is given.
    pub fn has_friction(&self) -> bool {
        self.friction != frictionless()
    }
}

fn frictionless() -> Number {
    Number::Literal(0.0)
}

fn two_sevenths() -> Number {
    Number::Literal(2.0 / 7.0)
}

/// `F = kδ`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Linear {
    /// Stiffness k, in N/m.
    #[serde(rename = "stiffness_N_m")]
    pub stiffness_n_m: Number,
}

/// `F = 4/3 E√R δ^{3/2}`, `1/E = 2(1 − ν²)/E_p`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hertz {
    /// Young's modulus of the particles `E_p`, in Pa.
    #[serde(rename = "young_Pa")]
    pub young_pa: Number,
    /// Their Poisson's ratio.
    pub poisson: Number,
}
