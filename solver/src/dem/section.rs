//! The section of a bond: one ratio for all, or from the Voronoi facet.

use super::arrangement::Arrangement;
use super::bonding::Pair;
use super::skin::bond_shares;
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

/// Area (m²) of the Voronoi facet of each pair, completed beyond the faces of the body (plane: length × thickness): what stresses
/// in its bond refer to. `None` if one of the pairs has no facet.
pub fn facets(arrangement: &Arrangement, pairs: &[Pair]) -> Option<Vec<f64>> {
    let whole = Section::Voronoi { ratio: 1.0 };
    let shares = bond_shares(&arrangement.faces, arrangement.particles.len(), pairs);
    pairs
        .iter()
        .zip(shares)
        .map(|(&pair, share)| Some(PI * whole.radius(arrangement, pair, share)?.powi(2)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::block::Block;
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::space::Vec3;

    /// `Σ A L / d` over the bonds inside is the volume of the body, d = 2 or 3: pyramids from each particle to its facets. What
    /// lies between a particle and a face belongs to no bond: nothing where particles sit on the faces; at the zigzag ends of
    /// triangular rows the short ones, 3 of 7, end half a spacing a off the face, with a facet there as high as a row h:
    /// six times `½ · a/2 · h`.
    #[test]
    fn facets_fill_the_body() {
        let matter = Matter { density: 1.0, thickness_m: 0.3 };
        let (a, h) = (3.0 / 16.0, 1.0 / 6.0);
        for (kind, depth, thickness, missing) in [
            (LatticeKind::Triangular, 0.0, 0.3, 6.0 * 0.25 * a * h),
            (LatticeKind::SimpleCubic, 1.0, 1.0, 0.0),
        ] {
            let block = Block::at_origin(kind.space(), Vec3::new(3.0, 1.0, depth)).unwrap();
            let l = lattice(kind, block, 6, matter).unwrap();
            let areas = facets(&l.arrangement, &l.pairs).unwrap();
            let shares = bond_shares(&l.arrangement.faces, l.arrangement.particles.len(), &l.pairs);
            let x = &l.arrangement.particles.position;
            let length = |p: &Pair| (x[p.ends[1]] - x[p.ends[0]]).norm();
            let bonds = l.pairs.iter().zip(&areas).zip(shares);
            let volume: f64 = bonds.map(|((p, a), s)| s * a * length(p) / kind.space().dim() as f64).sum();
            assert!((volume / thickness + missing - 3.0).abs() < 1e-9, "{kind:?}: {volume}");
        }
    }
}
