//! `[materials.NAME]`: the continuum a body is made of.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Isotropic linear elasticity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E, in Pa; positive.
    #[serde(rename = "young_Pa")]
    pub young_pa: Number,
    /// Poisson's ratio ν, between −1 and ½.
    pub poisson: Number,
    /// Mass density, in kg/m³.
    #[serde(default = "water")]
    pub density_kg_m3: Number,
    /// Where the constants come from.
    #[serde(default)]
    pub citation: String,
}

/// Statics do not ask for a density; masses stay well defined with that of water.
fn water() -> Number {
    Number::Literal(1000.0)
}
