//! Which particles are bonded, and the network that comes of it.

use super::arrangement::Arrangement;
use super::bond::BondMaterial;
use super::clusters::Clusters;
use super::grid::{Boundary, Grid};
use super::network::{Bonds, Network};
use super::section::Section;
use super::skin::{self, Skin};
use crate::error::{Error, Result};
use crate::space::Vec3;
use serde::{Deserialize, Serialize};

/// Two particles to be bonded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pair {
    /// First and second particle, the smaller index first.
    pub ends: [usize; 2],
    /// Period in which the second particle lies; zero in a closed box.
    pub shift: [i8; 3],
}

impl Pair {
    /// A pair that crosses no period.
    pub const fn inside(i: usize, j: usize) -> Self {
        Self { ends: [i, j], shift: [0; 3] }
    }

    /// Of the two directions in which a pair can be written, whether this is the one that is kept.
    fn is_first(i: usize, j: usize, shift: [i8; 3]) -> bool {
        i < j || (i == j && shift > [0; 3])
    }
}

/// A rule for who is bonded to whom.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bonding {
    /// [`by_gap`], the gap given as a share of the mean radius.
    Gap {
        /// Largest gap over the mean radius.
        share: f64,
    },
    /// [`by_coordination`].
    Coordination {
        /// Mean coordination number.
        z: f64,
    },
    /// [`delaunay`].
    Delaunay {
        /// Smallest facet, as a share of the face of a mean cell.
        least_share: f64,
    },
}

impl Bonding {
    /// The pairs of an arrangement, ascending. Particles that a gap or coordination number leaves over (rattlers) are then
    /// joined to the rest by their smallest gaps, see [`connect`], so that nothing floats.
    ///
    /// # Errors
    /// A coordination number out of reach.
    pub fn pairs(self, arrangement: &Arrangement) -> Result<Vec<Pair>> {
        let pairs = match self {
            Bonding::Gap { share } => {
                let radius = &arrangement.particles.radius;
                by_gap(arrangement, share * radius.iter().sum::<f64>() / radius.len().max(1) as f64)
            }
            Bonding::Coordination { z } => by_coordination(arrangement, z)?.0,
            Bonding::Delaunay { least_share } => delaunay(arrangement, least_share),
        };
        Ok(connect(arrangement, pairs))
    }
}

/// How bonds are made from pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondRecipe {
    /// Micro material `E_μ, ν_μ`.
    pub material: BondMaterial,
    /// Radius of each bond.
    pub section: Section,
    /// Weight of bonds in the faces.
    pub skin: Skin,
}

/// A periodic body: one period of its network, with the period in which each bond's second particle lies.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicNetwork {
    /// Particles and bonds; [`Network::bond_length`] is not to be used, since it knows no periods.
    pub network: Network,
    /// Sides of the period, in metres; the third is zero in the plane.
    pub cell: Vec3,
    /// Period of the second particle of each bond.
    pub shift: Vec<[i8; 3]>,
    /// Thickness of a plane body, in metres; 1 in the solid.
    pub thickness_m: f64,
}

impl PeriodicNetwork {
    /// From the first particle of a bond to the second, in metres.
    pub fn bond_vector(&self, bond: usize) -> Vec3 {
        let [i, j] = self.network.bonds.ends[bond];
        let x = &self.network.particles.position;
        x[j] - x[i] + period(self.cell, self.shift[bond])
    }

    /// Volume of the period, in m³; in the plane its area times the thickness.
    pub fn volume(&self) -> f64 {
        self.cell.iter().take(self.network.space.dim()).product::<f64>() * self.thickness_m
    }
}

fn period(cell: Vec3, shift: [i8; 3]) -> Vec3 {
    Vec3::from_fn(|axis, _| cell[axis] * f64::from(shift[axis]))
}

/// From the first particle of a pair to the second, in metres.
pub fn pair_vector(arrangement: &Arrangement, pair: Pair) -> Vec3 {
    let x = &arrangement.particles.position;
    x[pair.ends[1]] - x[pair.ends[0]] + period(arrangement.block.sides(), pair.shift)
}

/// Pairs whose surfaces are no farther apart than `gap` (m): `|x_j − x_i| − R_i − R_j ≤ gap`; ascending.
pub fn by_gap(arrangement: &Arrangement, gap: f64) -> Vec<Pair> {
    gaps(arrangement, gap).into_iter().map(|(_, pair)| pair).collect()
}

/// Pairs with a gap no larger than `most`, with their gaps, in ascending order of the pairs.
fn gaps(arrangement: &Arrangement, most: f64) -> Vec<(f64, Pair)> {
    let Arrangement { space, block, boundary, particles, .. } = arrangement;
    let largest = particles.radius.iter().copied().fold(0.0, f64::max);
    let grid = Grid::new(*space, *block, *boundary, &particles.position, 2.0 * largest + most);
    let mut found = Vec::new();
    for i in 0..particles.len() {
        let reach = particles.radius[i] + largest + most;
        grid.for_each_within(particles.position[i], reach, |near| {
            let gap = near.offset.norm() - particles.radius[i] - particles.radius[near.point];
            if gap <= most && Pair::is_first(i, near.point, near.shift) {
                found.push((gap, Pair { ends: [i, near.point], shift: near.shift }));
            }
        });
    }
    found.sort_by_key(|&(_, pair)| pair);
    found
}

/// Mean coordination number `2 Σ_b w_b / Σ_i s_i` of a body completed by its mirror images: bonds and particles
/// count with their shares inside the body, so that flat faces do not lower it.
pub fn coordination(arrangement: &Arrangement, pairs: &[Pair]) -> f64 {
    let n = arrangement.particles.len();
    let bonds: f64 = skin::bond_shares(&arrangement.faces, n, pairs).iter().sum();
    2.0 * bonds / skin::particle_shares(&arrangement.faces, n).iter().sum::<f64>()
}

/// The pairs of smallest gap that give a mean [`coordination`] of at least `z`, and the largest gap among them (m).
///
/// # Errors
/// `z` not positive, or more than the pairs up to one mean diameter apart can give.
pub fn by_coordination(arrangement: &Arrangement, z: f64) -> Result<(Vec<Pair>, f64)> {
    let n = arrangement.particles.len();
    let diameter = 2.0 * arrangement.particles.radius.iter().sum::<f64>() / n.max(1) as f64;
    let mut candidates = gaps(arrangement, diameter);
    // Equal gaps in ascending order of the pairs: the sort is stable.
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: Vec<Pair> = candidates.iter().map(|&(_, pair)| pair).collect();
    let shares = skin::bond_shares(&arrangement.faces, n, &all);
    let wanted = 0.5 * z * skin::particle_shares(&arrangement.faces, n).iter().sum::<f64>();
    let mut sum = 0.0;
    let last = shares.iter().position(|share| {
        sum += share;
        sum >= wanted
    });
    match last {
        Some(last) if z > 0.0 => {
            let mut pairs = all[..=last].to_vec();
            pairs.sort_unstable();
            Ok((pairs, candidates[last].0))
        }
        _ => Err(Error::Geometry {
            what: "bonds by coordination number".into(),
            message: format!(
                "{z} cannot be reached: pairs up to one diameter apart give {:.3}; ask for a number between 0 and that",
                coordination(arrangement, &all)
            ),
        }),
    }
}

/// Joins clusters of bonded particles by pairs of smallest gap, as few as it takes (Kruskal 1956), up to a gap of one mean diameter.
/// A cluster held by one bond carries no load, so stiffness is not changed; but it moves with the body.
pub fn connect(arrangement: &Arrangement, mut pairs: Vec<Pair>) -> Vec<Pair> {
    let n = arrangement.particles.len();
    let mut clusters = Clusters::of(n, pairs.iter().map(|pair| pair.ends));
    if clusters.largest().len() == n {
        return pairs;
    }
    let diameter = 2.0 * arrangement.particles.radius.iter().sum::<f64>() / n.max(1) as f64;
    let mut candidates = gaps(arrangement, diameter);
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, pair) in candidates {
        if clusters.join(pair.ends[0], pair.ends[1]) {
            pairs.push(pair);
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Pairs that share a facet of the Voronoi (power) diagram, ascending: the (regular) Delaunay triangulation without
/// facets smaller than `least_share` of the face of a square or cube of the mean cell's size. Four or more
/// particles on one circle or sphere, as in lattices, have no unique triangulation; a small positive share (1e-6) leaves them out.
pub fn delaunay(arrangement: &Arrangement, least_share: f64) -> Vec<Pair> {
    let dim = arrangement.space.dim() as f64;
    let mean = arrangement.block.measure(arrangement.space) / arrangement.cells.len().max(1) as f64;
    let least = least_share * mean.powf((dim - 1.0) / dim);
    let mut pairs: Vec<(Pair, f64)> = Vec::new();
    for (i, cell) in arrangement.cells.iter().enumerate() {
        for facet in cell.facets.iter().filter(|f| Pair::is_first(i, f.neighbour, f.shift)) {
            pairs.push((Pair { ends: [i, facet.neighbour], shift: facet.shift }, facet.measure));
        }
    }
    pairs.sort_by_key(|&(pair, _)| pair);
    let all: Vec<Pair> = pairs.iter().map(|p| p.0).collect();
    let shares = skin::bond_shares(&arrangement.faces, arrangement.particles.len(), &all);
    let completed = pairs.iter().zip(shares).map(|(&(pair, inside), share)| (pair, inside / share));
    completed.filter(|&(_, facet)| facet > least).map(|(pair, _)| pair).collect()
}

/// Bonds the pairs of a closed box.
///
/// # Errors
/// A periodic arrangement; a material constant or radius ratio that is not positive; a pair without a common facet where the
/// section asks for one; coincident particles.
pub fn bond_network(arrangement: &Arrangement, pairs: &[Pair], recipe: &BondRecipe) -> Result<Network> {
    if arrangement.boundary != Boundary::Closed {
        return Err(Error::Geometry {
            what: "bonded body".into(),
            message: "its arrangement is periodic; fill a closed box, or build a periodic network".into(),
        });
    }
    Ok(Network {
        space: arrangement.space,
        particles: arrangement.particles.clone(),
        bonds: bonds(arrangement, pairs, recipe)?,
        faces: arrangement.faces.clone(),
    })
}

/// Bonds the pairs of a periodic box.
///
/// # Errors
/// As for [`bond_network`]; an arrangement that is not periodic.
pub fn periodic_network(
    arrangement: &Arrangement,
    pairs: &[Pair],
    recipe: &BondRecipe,
) -> Result<PeriodicNetwork> {
    if arrangement.boundary != Boundary::Periodic {
        return Err(Error::Geometry {
            what: "periodic body".into(),
            message: "its arrangement ends at the faces of the box; use a periodic packing".into(),
        });
    }
    let network = Network {
        space: arrangement.space,
        particles: arrangement.particles.clone(),
        bonds: bonds(arrangement, pairs, recipe)?,
        faces: arrangement.faces.clone(),
    };
    let shift = pairs.iter().map(|pair| pair.shift).collect();
    let thickness_m = arrangement.thickness_m;
    Ok(PeriodicNetwork { network, cell: arrangement.block.sides(), shift, thickness_m })
}

fn bonds(arrangement: &Arrangement, pairs: &[Pair], recipe: &BondRecipe) -> Result<Bonds> {
    recipe.check()?;
    let shares = skin::bond_shares(&arrangement.faces, arrangement.particles.len(), pairs);
    let weights = match recipe.skin {
        Skin::Full => vec![1.0; pairs.len()],
        Skin::Weighted => shares.clone(),
        Skin::SecondMoment => skin::second_moment_shares(arrangement, pairs)?,
    };
    let mut bonds = Bonds::default();
    for (b, (&pair, share)) in pairs.iter().zip(shares).enumerate() {
        let length = pair_vector(arrangement, pair).norm();
        let fail = |message: &str| Error::Bond {
            body: "packing".into(),
            bond: b,
            i: pair.ends[0],
            j: pair.ends[1],
            message: message.into(),
        };
        if length == 0.0 {
            return Err(fail("its ends coincide; remove one of the particles"));
        }
        let radius = recipe.section.radius(arrangement, pair, share).ok_or_else(|| {
            fail("its particles share no Voronoi facet; bond by Delaunay, or use a uniform section")
        })?;
        bonds.ends.push(pair.ends);
        bonds.radius.push(radius);
        bonds.stiffness.push(recipe.material.cylinder(radius, length));
        bonds.weight.push(weights[b]);
    }
    Ok(bonds)
}

impl BondRecipe {
    fn check(&self) -> Result<()> {
        let BondMaterial { young_pa, poisson } = self.material;
        let ratio = self.section.ratio();
        let refuse = |name, value, mend| Err(Error::Material { what: "bond".into(), name, value, mend });
        if !(young_pa.is_finite() && young_pa > 0.0) {
            return refuse("young_Pa", young_pa, "give a positive modulus");
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return refuse("poisson", poisson, "give a number above -1 and up to 0.5");
        }
        if !(ratio.is_finite() && ratio > 0.0) {
            return refuse(
                "radius_ratio",
                ratio,
                "give a positive ratio; beyond 1 a bond is thicker than its particles",
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::block::Block;
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::space::Space;

    fn square() -> Arrangement {
        let block = Block::at_origin(Space::Plane, Vec3::new(5.0, 5.0, 0.0)).unwrap();
        lattice(LatticeKind::Square, block, 5, Default::default()).unwrap().arrangement
    }

    fn recipe(section: Section) -> BondRecipe {
        BondRecipe { material: BondMaterial { young_pa: 2.0, poisson: 0.3 }, section, skin: Skin::Weighted }
    }

    #[test]
    fn gap_decides_who_is_bonded() {
        let a = square();
        // 2·5·6 sides of 25 cells; the diagonals have a gap of √2 − 1.
        assert_eq!(by_gap(&a, 0.1).len(), 60);
        assert_eq!(by_gap(&a, 0.42).len(), 60 + 50);
    }

    #[test]
    fn flat_faces_do_not_lower_the_coordination_number() {
        let a = square();
        let pairs = by_gap(&a, 0.1);
        assert!((coordination(&a, &pairs) - 4.0).abs() < 1e-12);
        let (same, gap) = by_coordination(&a, 4.0).unwrap();
        assert_eq!(same, pairs);
        assert!(gap.abs() < 1e-12);
        assert!(by_coordination(&a, 40.0).is_err());
        assert!(by_coordination(&a, f64::NAN).is_err());
    }

    #[test]
    fn leftover_particles_are_joined_by_one_bond_each() {
        let a = square();
        let corner = |p: &Pair| p.ends[0] == 0;
        let mut pairs = by_gap(&a, 0.1);
        pairs.retain(|p| !corner(p));
        assert_eq!(pairs.len(), 58);
        let joined = connect(&a, pairs.clone());
        assert_eq!(joined.len(), 59);
        assert_eq!(joined.iter().filter(|p| corner(p)).count(), 1);
        let all = by_gap(&a, 0.1);
        assert_eq!(connect(&a, all.clone()), all);
    }

    #[test]
    fn voronoi_section_is_the_facet_completed_beyond_the_faces() {
        let a = square();
        let network = bond_network(&a, &by_gap(&a, 0.1), &recipe(Section::Voronoi { ratio: 1.0 })).unwrap();
        for (r, w) in network.bonds.radius.iter().zip(&network.bonds.weight) {
            assert!(
                (std::f64::consts::PI * r * r - 1.0).abs() < 1e-12,
                "unit facet × unit thickness, weight {w}"
            );
        }
    }

    #[test]
    fn a_pair_without_a_facet_cannot_have_a_voronoi_section() {
        let a = square();
        let far = [Pair::inside(0, 35)];
        let refusal = bond_network(&a, &far, &recipe(Section::Voronoi { ratio: 1.0 })).unwrap_err();
        assert!(refusal.to_string().contains("bond 0 between particles 0 and 35"), "{refusal}");
        assert!(bond_network(&a, &far, &recipe(Section::Uniform { ratio: 1.0 })).is_ok());
        assert!(bond_network(&a, &far, &recipe(Section::Uniform { ratio: -1.0 })).is_err());
    }
}
