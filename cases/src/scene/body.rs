//! `[bodies.NAME]`: a shape, a material, and the method it is computed with.

use super::de::De;
use super::fe::Fe;
use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One body: exactly one shape, and a section for its method.
///
/// Both `fe` and `de` may be given; `method` says which one counts, so that a variant can
/// exchange one method for the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// How it is computed.
    pub method: Method,
    /// Name of its material.
    pub material: String,
    /// Shape: a box along the axes. Boundaries: left, right (x), bottom, top (y), back, front (z).
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<Cuboid>,
    /// Shape: a quadrilateral of four corners, counter-clockwise from bottom left, plane only.
    /// Boundaries: bottom, right, top, left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quadrilateral: Option<Quadrilateral>,
    /// Shape: a quarter of an elliptic ring, plane only. Boundaries: inner, outer, start (on the
    /// x axis), end (on the y axis).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sector: Option<Sector>,
    /// Shape: a beam notched from below at mid-span. Boundaries: left, right, bottom, top, notch (both
    /// flanks), in the solid back and front.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub notched_beam: Option<NotchedBeam>,
    /// Shape and mesh: a Gmsh file (4.1) next to the scene; boundaries are its physical groups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gmsh: Option<String>,
    /// Shape and bonds: a network from two CSV files next to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub network: Option<NetworkFiles>,
    /// Finite elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fe: Option<Fe>,
    /// Discrete elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub de: Option<De>,
}

impl Body {
    /// The keys of the shapes that are given.
    pub fn shapes(&self) -> Vec<&'static str> {
        [
            (self.cuboid.is_some(), "box"),
            (self.quadrilateral.is_some(), "quadrilateral"),
            (self.sector.is_some(), "sector"),
            (self.notched_beam.is_some(), "notched_beam"),
            (self.gmsh.is_some(), "gmsh"),
            (self.network.is_some(), "network"),
        ]
        .into_iter()
        .filter_map(|(given, key)| given.then_some(key))
        .collect()
    }

    /// Names of the boundaries, where the shape fixes them.
    pub fn boundaries(&self) -> Option<&'static [&'static str]> {
        match self.shapes().first() {
            Some(&"box") => Some(&["left", "right", "bottom", "top", "back", "front"]),
            Some(&"quadrilateral") => Some(&["bottom", "right", "top", "left"]),
            Some(&"notched_beam") => Some(&["left", "right", "bottom", "top", "notch", "back", "front"]),
            Some(&"sector") => Some(&["inner", "outer", "start", "end"]),
            _ => None,
        }
    }
}

/// How a body is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Finite elements.
    Fe,
    /// Discrete elements.
    De,
}

/// A box along the axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cuboid {
    /// Smallest coordinates, in m; a third one counts only in the solid.
    pub min: Vec<Number>,
    /// Largest coordinates, in m; a third one counts only in the solid.
    pub max: Vec<Number>,
}

/// A quadrilateral.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Quadrilateral {
    /// Four points, in m, counter-clockwise from bottom left.
    pub corners: Vec<Vec<Number>>,
}

/// A quarter of a ring between two ellipses around the origin, in the first quadrant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sector {
    /// Half axes along x and y of the inner ellipse, in m.
    pub inner: Vec<Number>,
    /// Half axes along x and y of the outer ellipse, in m.
    pub outer: Vec<Number>,
}

/// The beam `|x| ≤ length/2`, `0 ≤ y ≤ depth`, with a notch from below at x = 0; in the solid from z = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NotchedBeam {
    /// Along x, in m.
    pub length_m: Number,
    /// Along y, in m.
    pub depth_m: Number,
    /// Of the notch, in m.
    pub notch_depth_m: Number,
    /// Between the flanks, in degrees; 0 is a crack.
    #[serde(default = "closed")]
    pub notch_angle_deg: Number,
    /// Distance from mid-span beyond which the grid stays rectangular, in m: more than half the mouth, `a tan(ω/2)`.
    pub reach_m: Number,
}

fn closed() -> Number {
    Number::Literal(0.0)
}

/// A network from another code.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NetworkFiles {
    /// CSV with `id,x,y,z,radius,mass`, optionally `inertia`.
    pub particles: String,
    /// CSV with `i,j,young_Pa,poisson,radius_m`, optionally `weight` or `kn,ks,kb,kt`.
    pub bonds: String,
}
