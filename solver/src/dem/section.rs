//! The section of a bond: one ratio for all, or from the Voronoi facet.

use super::arrangement::Arrangement;
use super::bonding::Pair;
use crate::space::Space;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Where the radius of a bond comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// `r = r̃ (R_i + R_j)/2`.
    Uniform {
        /// Dimensionless bond radius `r̃`.
        ratio: f64,
    },
    /// `r = r̃ √(A/π)`, where `A` is the area of the facet between the Voronoi (power) cells of the two particles,
    /// completed beyond the faces of the body (plane: facet length × thickness). With `r̃ = 1` the bonds
    /// together fill the body's sections, as in rigid-body-spring networks (Bolander & Saito 1998).
    Voronoi {
        /// Factor `r̃` on the radius.
        ratio: f64,
    },
}

impl Section {
    /// The ratio `r̃`.
    pub const fn ratio(self) -> f64 {
        match self {
            Section::Uniform { ratio } | Section::Voronoi { ratio } => ratio,
        }
    }

    /// The same kind of section with another ratio.
    pub const fn with_ratio(self, ratio: f64) -> Self {
        match self {
            Section::Uniform { .. } => Section::Uniform { ratio },
            Section::Voronoi { .. } => Section::Voronoi { ratio },
        }
    }

    /// Radius (m) of a bond of which `share` lies inside the body; `None` if its section needs a facet
    /// and there is none.
    pub fn radius(self, arrangement: &Arrangement, pair: Pair, share: f64) -> Option<f64> {
        let [i, j] = pair.ends;
        match self {
            Section::Uniform { ratio } => {
                let radius = &arrangement.particles.radius;
                Some(ratio * 0.5 * (radius[i] + radius[j]))
            }
            Section::Voronoi { ratio } => {
                let facets = &arrangement.cells[i].facets;
                let at = facets.binary_search_by_key(&(j, pair.shift), |f| (f.neighbour, f.shift)).ok()?;
                let depth = if arrangement.space == Space::Plane { arrangement.thickness_m } else { 1.0 };
                let area = facets[at].measure * depth / share;
                (area > 0.0).then(|| ratio * (area / PI).sqrt())
            }
        }
    }
}
