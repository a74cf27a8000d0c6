//! `[probes.NAME]`: what is read off a solution, and where.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One probe: a value at a `point`, along a `line`, or of the whole model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// What is read.
    pub read: Read,
    /// At a point, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<Vec<Number>>,
    /// At stations of a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<Line>,
    /// The exact answer as a field of x, y, z: one number, or the displacement vector for
    /// `displacement-error`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exact: Vec<Number>,
    /// Caption of the curve.
    #[serde(default)]
    pub title: String,
    /// Half width of the band drawn around the reference, as a share of its largest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub band: Option<f64>,
}

/// What a probe reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Read {
    /// Displacement along x, in m.
    Ux,
    /// Displacement along y, in m.
    Uy,
    /// Displacement along z, in m.
    Uz,
    /// Stress, in Pa; inside finite elements.
    Sxx,
    /// Stress, in Pa; inside finite elements.
    Syy,
    /// Stress, in Pa; inside finite elements.
    Sxy,
    /// Rotation of the line as `Δu_y/Δx` between neighbouring stations, in rad, given half-way between them.
    SecantRotation,
    /// Rotation of the cross-section as `−∂u_x/∂y` of a plane fitted to it, in rad.
    SectionRotation,
    /// Largest `|u − u_exact|` over nodes and particles, relative to the largest `|u_exact|`.
    DisplacementError,
    /// `√Σ|u − u_exact|² / √Σ|u_exact|²` over nodes and particles.
    DisplacementErrorRms,
    /// Elastic energy, in J.
    StrainEnergy,
}

impl Read {
    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Ux | Self::Uy | Self::Uz => "m",
            Self::Sxx | Self::Syy | Self::Sxy => "Pa",
            Self::SecantRotation | Self::SectionRotation => "rad",
            Self::DisplacementError | Self::DisplacementErrorRms => "1",
            Self::StrainEnergy => "J",
        }
    }

    /// Whether it needs neither point nor line.
    pub fn is_global(self) -> bool {
        self.is_error() || self == Self::StrainEnergy
    }

    /// Whether it is the distance from an exact displacement.
    pub fn is_error(self) -> bool {
        matches!(self, Self::DisplacementError | Self::DisplacementErrorRms)
    }

    /// Whether it is defined along a line only.
    pub fn is_rotation(self) -> bool {
        matches!(self, Self::SecantRotation | Self::SectionRotation)
    }
}

/// Stations at equal distances, independent of any mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// First station, in m.
    pub from: Vec<Number>,
    /// Last station, in m.
    pub to: Vec<Number>,
    /// Intervals between stations.
    pub intervals: usize,
}
