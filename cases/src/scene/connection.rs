//! `[sets]`, `[ties]`, `[supports]`, `[loads]`: what joins, holds and moves the bodies.
//!
//! A place is written `"body.boundary"`, e.g. `"left.right"`, or as the name of a set.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `[sets.NAME]`: nodes or particles of one body, chosen in one way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Set {
    /// The body.
    pub body: String,
    /// All inside a box, its faces included.
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<super::body::Cuboid>,
    /// All on a boundary.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub boundary: Option<String>,
    /// Indices of nodes or particles, from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ids: Option<Vec<usize>>,
    /// CSV file next to the scene with a column `id`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub csv: Option<String>,
}

/// `[ties.NAME]`: two faces of two bodies joined by Lagrange multipliers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tie {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// The two faces, as `"body.boundary"`.
    pub faces: [String; 2],
    /// Node by node, or averaged.
    #[serde(default)]
    pub method: TieMethod,
    /// Which side carries the multipliers.
    #[serde(default)]
    pub multipliers: Multipliers,
    /// Whether particle rotations are tied to the rotation of the other side.
    #[serde(default)]
    pub rotations: bool,
}

/// How the displacement jump is made zero.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TieMethod {
    /// At each particle or node: `u_d = Σ N_i(x_d) u_i`.
    #[default]
    Pointwise,
    /// In the mean, weighted by the multiplier's trace functions, integrated segment by segment.
    Mortar,
}

/// The side whose trace the multipliers live on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Multipliers {
    /// The coarser side.
    #[default]
    Auto,
    /// The first face.
    First,
    /// The second face.
    Second,
}

/// `[supports.NAME]`: prescribed displacements and rotations, fields of x, y, z allowed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// Where: `"body.boundary"` or a set.
    pub on: String,
    /// Displacement along x, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ux: Option<Number>,
    /// Displacement along y, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uy: Option<Number>,
    /// Displacement along z, in m; solid only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uz: Option<Number>,
    /// Rotation of particles about x, in rad; solid only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rx: Option<Number>,
    /// Rotation of particles about y, in rad; solid only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ry: Option<Number>,
    /// Rotation of particles about z, in rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rz: Option<Number>,
}

impl Support {
    /// Component keys with their values, displacements before rotations.
    pub fn components(&self) -> [(&'static str, &Option<Number>); 6] {
        [
            ("ux", &self.ux),
            ("uy", &self.uy),
            ("uz", &self.uz),
            ("rx", &self.rx),
            ("ry", &self.ry),
            ("rz", &self.rz),
        ]
    }
}

/// `[loads.NAME]`: a total force or a traction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// Where: `"body.boundary"`, or a set for a total force.
    pub on: String,
    /// Resultant, in N, spread evenly over the boundary; over a set, in equal shares.
    #[serde(rename = "total_N", default, skip_serializing_if = "Option::is_none")]
    pub total_n: Option<Vec<Number>>,
    /// Force per area, in Pa, fields of x, y, z allowed; a boundary of finite elements.
    #[serde(rename = "traction_Pa", default, skip_serializing_if = "Option::is_none")]
    pub traction_pa: Option<Vec<Number>>,
}
