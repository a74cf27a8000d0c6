//! `[failure.NAME]`: when the bonds of a body break.

use super::body::Cuboid;
use super::none::{self, none_or};
use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One law for one body: exactly one of `bond_stress`, `virial_stress`, `softening`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Failure {
    /// Whether it takes part; a variant can leave it out.
    #[serde(default = "super::yes")]
    pub enabled: bool,
    /// The body whose bonds break: its particles, and those that its elements become.
    pub body: String,
    /// Stress in the section of a bond over its strength, and the bond is broken.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<BondStress>")]
    pub bond_stress: Option<BondStress>,
    /// Mean stress of a particle over its strength, and it loses bonds.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<VirialStress>")]
    pub virial_stress: Option<VirialStress>,
    /// Stress in the section of a bond over its strength, and it loses stiffness step by step.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<Softening>")]
    pub softening: Option<Softening>,
    /// Area that stresses in a bond refer to.
    #[serde(default)]
    pub area: Area,
    /// Where bonds may break: those whose middle lies in this box. Without it all may but those of particles that are held or loaded.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<Cuboid>")]
    pub zone: Option<Cuboid>,
    /// Scatter of strength from bond to bond, after Weibull; none if not given.
    #[serde(default, deserialize_with = "none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<Scatter>")]
    pub scatter: Option<Scatter>,
}

/// Strengths of a bond (Potyondy and Cundall 2004); with both, an ellipse.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BondStress {
    /// Against tension with bending.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tensile: Option<Strength>,
    /// Against shear with torsion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear: Option<Strength>,
}

/// Strength of a particle (André and others 2013).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VirialStress {
    /// The strength.
    pub strength: Strength,
    /// What is compared with it.
    #[serde(default)]
    pub measure: Measure,
    /// What breaks.
    #[serde(default)]
    pub release: Release,
}

/// A bilinear softening curve in steps (Rots and Invernizzi 2004).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Softening {
    /// Tensile strength.
    pub tensile: Strength,
    /// Fracture energy, in J/m².
    #[serde(rename = "fracture_energy_J_m2")]
    pub fracture_energy_j_m2: Number,
    /// Stress at the kink over the strength, and opening there over fracture energy over strength; Petersson (1981): 1/3 and 0.8. A
    /// straight line if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kink: Option<[Number; 2]>,
    /// Number of steps.
    #[serde(default = "ten")]
    pub teeth: Number,
}

fn ten() -> Number {
    Number::Literal(10.0)
}

/// A stress, or a toughness that the particle size turns into one: `c K/√R`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Strength {
    /// The same for all sizes, in Pa.
    #[serde(rename = "stress_Pa", default, skip_serializing_if = "Option::is_none")]
    pub stress_pa: Option<Number>,
    /// Toughness K, in Pa√m; needs `factor`.
    #[serde(rename = "toughness_Pa_sqrt_m", default, skip_serializing_if = "Option::is_none")]
    pub toughness_pa_sqrt_m: Option<Number>,
    /// Factor c, from calibration on a known crack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor: Option<Number>,
}

/// Measure of the stress of a particle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// The largest principal stress.
    #[default]
    LargestPrincipal,
    /// The mean of the normal stresses.
    Hydrostatic,
}

/// What a particle lets go when it fails.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Release {
    /// All its bonds.
    AllBonds,
    /// The one in highest tension.
    #[default]
    MostTensile,
}

/// Area of a stress.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Area {
    /// The Voronoi facet between the two particles: in the plane only this is independent of thickness and particle size.
    #[default]
    Facet,
    /// The section of the cylinder, `πr²`.
    Section,
}

/// Scatter of strength after Weibull (1951).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    /// Modulus m: the larger, the less scatter.
    pub modulus: Number,
    /// Seed.
    #[serde(default = "first")]
    pub seed: u64,
}

fn first() -> u64 {
    1
}
