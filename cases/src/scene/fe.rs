//! `[bodies.NAME.fe]`: how a body is meshed. The element is Q4 in the plane, H8 in the solid.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Finite elements of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fe {
    /// Cells along each direction of the shape; a third one counts only in the solid. Not with
    /// `gmsh`, which brings its mesh, nor with `notched_beam`, which takes `refinement`.
    #[serde(default)]
    pub divisions: Vec<Number>,
    /// Ratio of each cell to the one before it, along each direction; 1 is uniform.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grading: Vec<Number>,
    /// Of a `notched_beam`: how its cells grow away from the tip.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refinement: Option<Refinement>,
    /// How the element is integrated and enriched.
    #[serde(default)]
    pub formulation: Formulation,
    /// Moves the inner nodes at random, for patch tests.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distortion: Option<Distortion>,
}

/// Cells of `finest_m · growthᵏ` away from the tip along x and y, k = 0, 1, …, up to `coarsest_m`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Refinement {
    /// Length of the cells at the tip, in m.
    pub finest_m: Number,
    /// Ratio of each cell to the one before it; 1 is uniform.
    #[serde(default = "uniform")]
    pub growth: Number,
    /// Length of the cells far away, in m.
    pub coarsest_m: Number,
    /// x that must be grid lines, in m: supports, ends of a region that becomes particles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through_x_m: Vec<Number>,
    /// y that must be grid lines, in m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through_y_m: Vec<Number>,
    /// Layers through the thickness, solid only.
    #[serde(default = "uniform")]
    pub layers: Number,
}

fn uniform() -> Number {
    Number::Literal(1.0)
}

/// Formulation of Q4 and H8.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Fully integrated displacements.
    #[default]
    Plain,
    /// With incompatible bending modes (Taylor, Beresford and Wilson 1976).
    Incompatible,
    /// With the mean dilatation (Hughes 1980).
    BBar,
}

/// Random displacement of inner nodes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Distortion {
    /// Largest displacement, as a share of the cell.
    pub amplitude: Number,
    /// Seed.
    #[serde(default)]
    pub seed: u64,
}
