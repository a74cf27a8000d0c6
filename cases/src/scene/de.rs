//! `[bodies.NAME.de]`: how a body is filled with bonded particles.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Discrete elements of a box.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct De {
    /// Where the particles sit.
    pub arrangement: Arrangement,
    /// Particle spacings across the height of the box: the resolution.
    pub rows: Number,
    /// Triangular lattice only: how the ends of the offset rows meet the flat faces.
    #[serde(default)]
    pub ends: Ends,
    /// The bonds.
    pub bond: Bond,
    /// Whether bonds in a face keep only the share that lies inside the body.
    #[serde(default)]
    pub skin: Skin,
    /// Where the cross-section of a bond comes from.
    #[serde(default)]
    pub section: Section,
    /// Random packing only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packing: Option<Packing>,
}

/// Where the particles sit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Arrangement {
    /// Triangular lattice, plane.
    Triangular,
    /// Square lattice, plane.
    Square,
    /// Simple cubic lattice, solid.
    Sc,
    /// Body-centred cubic lattice, solid.
    Bcc,
    /// Face-centred cubic lattice, solid.
    Fcc,
    /// Seeded random packing with flat faces, plane or solid.
    Random,
}

/// How a triangular lattice ends at its left and right faces.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ends {
    /// Offset rows get a particle on each face, with half cells between.
    #[default]
    Completed,
    /// Offset rows stop half a spacing short of the faces.
    Zigzag,
}

/// Material and radius of the bonds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bond {
    /// What is searched so that the packing has the constants of the body's material.
    #[serde(default)]
    pub calibrate: Calibrate,
    /// Bond radius over particle radius, r̃; found when `calibrate = "both"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_ratio: Option<Number>,
    /// Young's modulus of the bond E_μ, in Pa; found by every calibration.
    #[serde(rename = "young_Pa", default, skip_serializing_if = "Option::is_none")]
    pub young_pa: Option<Number>,
    /// Poisson's ratio of the bond ν_μ; it acts in torsion only.
    #[serde(default = "bond_poisson")]
    pub poisson: Number,
}

fn bond_poisson() -> Number {
    Number::Literal(0.3)
}

/// What calibration searches.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Calibrate {
    /// r̃ for ν, then E_μ for E.
    #[default]
    Both,
    /// E_μ for E; r̃ is given and ν is what it gives.
    Young,
    /// Nothing: r̃ and E_μ are given.
    None,
}

/// Stiffness of bonds that lie in a face.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Skin {
    /// The share inside the body: ½ in a face, ¼ on an edge of a solid.
    #[default]
    Weighted,
    /// The same, corrected so that the rows of a lattice have the second moment of area of the beam.
    SecondMoment,
    /// Full stiffness.
    Full,
}

/// Cross-section of the bonds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Section {
    /// One r̃ for all bonds.
    #[default]
    Uniform,
    /// Area of the Voronoi facet, clipped by the body.
    Voronoi,
}

/// A seeded random packing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Packing {
    /// Seed.
    #[serde(default = "one")]
    pub seed: u64,
    /// Share of the box filled by particles; 0.84 (plane) or 0.64 (solid) if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid_fraction: Option<Number>,
    /// Radii vary by ± this share of the mean, uniformly.
    #[serde(default = "twenty_percent")]
    pub radius_spread: Number,
    /// How neighbours are bonded.
    #[serde(default)]
    pub bonding: Bonding,
    /// Bonding by distance only: mean number of bonds per inner particle; 4.5 (plane) or 6.2 (solid)
    /// if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coordination: Option<Number>,
}

fn one() -> u64 {
    1
}

fn twenty_percent() -> Number {
    Number::Literal(0.2)
}

/// How the particles of a random packing are bonded.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Bonding {
    /// Neighbours across a Voronoi facet.
    #[default]
    Delaunay,
    /// The nearest gaps, up to the coordination number.
    Distance,
}
