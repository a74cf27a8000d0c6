//! Seeded random packings of discs and spheres that fill a box.
//!
//! Protocol: radii drawn uniformly from `R̄(1 ± spread)`, then scaled together so that the solid fraction is met
//! exactly; particles thrown at random into the box, those of a closed box first onto its corners, edges and
//! faces (`strata`); then their overlaps pushed apart by minimising `½Σδ²` (`relax`) at fixed radii, as in O'Hern et al.
//! (2003). Near random close packing (0.64 for spheres, 0.84 for discs) what overlap is left is small; it is reported.
//!
//! In a closed box the particles of the faces have their centres *on* them, so that faces are flat and can be tied and
//! loaded. Solid fraction is then `Σ 2^−k_i V_i / V` with `k_i` the number of faces through particle `i`: what lies
//! inside the box counts. Inner particles stay one radius away from the faces, as if they met their own mirror image.

mod relax;
mod strata;

use super::arrangement::{Arrangement, Matter};
use super::block::Block;
use super::bonding;
use super::grid::Boundary;
use super::skin;
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Name and version of the algorithm: the same name, seed and settings give the same bits.
pub const ALGORITHM: &str = "seam-packing/1 (ChaCha8, strata, FIRE)";

/// Surfaces closer than this share of the mean radius count as touching in [`PackingReport`]: the overlaps are relaxed
/// to about this much.
const TOUCHING: f64 = 1e-3;

/// What to pack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PackingRecipe {
    /// Discs or spheres.
    pub space: Space,
    /// The box to fill.
    pub block: Block,
    /// Flat faces, or one period of an infinite packing.
    pub boundary: Boundary,
    /// Mean radius asked for, in metres; the reached one differs a little, since the number of particles is whole.
    pub mean_radius_m: f64,
    /// Solid fraction, 0 to 1: about 0.64 for spheres, 0.84 for discs.
    pub solid_fraction: f64,
    /// Largest deviation of a radius from the mean, as a fraction: 0.2 for ±20 %.
    pub radius_spread: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// What a packing is like.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PackingReport {
    /// [`ALGORITHM`].
    pub algorithm: String,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Number of particles.
    pub particles: usize,
    /// Share of the box inside particles, those on faces counted with the share inside.
    pub solid_fraction: f64,
    /// Mean radius, in metres.
    pub mean_radius_m: f64,
    /// Largest deviation of a radius from the mean, as a fraction.
    pub radius_spread: f64,
    /// Mean number of touching neighbours (gap up to 0.1 % of the mean radius), see [`bonding::coordination`].
    pub coordination: f64,
    /// Largest overlap `(R_i + R_j − |x_j − x_i|) / (R_i + R_j)`.
    pub largest_overlap: f64,
    /// Pairs looked at while overlaps were pushed apart: what the packing cost.
    pub checks: u64,
}

/// A random packing and its description.
#[derive(Debug, Clone, PartialEq)]
pub struct Packing {
    /// The particles.
    pub arrangement: Arrangement,
    /// What they are like.
    pub report: PackingReport,
}

impl PackingRecipe {
    /// A periodic square or cube of `count` particles of a mean radius (m).
    ///
    /// # Errors
    /// No particles, or a solid fraction or spread outside its range.
    pub fn periodic(
        space: Space,
        count: usize,
        mean_radius_m: f64,
        solid_fraction: f64,
        radius_spread: f64,
        seed: u64,
    ) -> Result<Self> {
        let volume = count as f64 * mean_content(space.dim(), radius_spread) / solid_fraction;
        let side = mean_radius_m * volume.powf(1.0 / space.dim() as f64);
        let block = Block::at_origin(space, Vec3::repeat(side))?;
        let boundary = Boundary::Periodic;
        let recipe = Self { space, block, boundary, mean_radius_m, solid_fraction, radius_spread, seed };
        recipe.check()?;
        Ok(recipe)
    }

    fn check(&self) -> Result<()> {
        let refuse = |message: String| Err(Error::Geometry { what: "packing".into(), message });
        let Self { mean_radius_m: radius, solid_fraction: fraction, radius_spread: spread, .. } = *self;
        // The densest packings of equal discs and spheres.
        let densest = match self.space {
            Space::Plane => PI / 12f64.sqrt(),
            Space::Solid => PI / 18f64.sqrt(),
        };
        if !(fraction > 0.0 && fraction < densest) {
            return refuse(format!(
                "solid fraction {fraction} is not between 0 and {densest:.4}; random packings reach about {}",
                if self.space == Space::Plane { 0.84 } else { 0.64 }
            ));
        }
        if !(0.0..=0.5).contains(&spread) {
            return refuse(format!("radius spread {spread} is not between 0 and 0.5"));
        }
        let shortest =
            self.block.sides().iter().take(self.space.dim()).copied().fold(f64::INFINITY, f64::min);
        if !(radius > 0.0 && 4.0 * radius <= shortest) {
            return refuse(format!(
                "mean radius {radius} m does not fit a box whose shortest side is {shortest} m; at least two particles must fit across it"
            ));
        }
        Ok(())
    }
}

/// Length, area or volume of a ball of dimension 1, 2 or 3.
fn content(dim: usize, radius: f64) -> f64 {
    match dim {
        1 => 2.0 * radius,
        2 => PI * radius * radius,
        _ => 4.0 / 3.0 * PI * radius.powi(3),
    }
}

/// Mean [`content`] of balls with radii uniform in `1 ± spread`.
fn mean_content(dim: usize, spread: f64) -> f64 {
    // ⟨R²⟩ = 1 + s²/3, ⟨R³⟩ = 1 + s².
    content(dim, 1.0) * (1.0 + [0.0, spread * spread / 3.0, spread * spread][dim - 1])
}

/// Packs particles into a box.
///
/// # Errors
/// A solid fraction, spread or radius that no packing can have; see the message.
pub fn pack(recipe: &PackingRecipe, matter: Matter) -> Result<Packing> {
    recipe.check()?;
    let mut rng = ChaCha8Rng::seed_from_u64(recipe.seed);
    let mut thrown = strata::throw(recipe, &mut rng)?;
    let checks = relax::push_apart(recipe, &mut thrown);
    let strata::Thrown { position, radius, .. } = thrown;
    let arrangement =
        Arrangement::new(recipe.space, recipe.block, recipe.boundary, matter, position, radius)?;
    let report = describe(&arrangement, recipe.seed, checks);
    Ok(Packing { arrangement, report })
}

/// Share of the box inside particles, those on faces counted with the share inside.
pub fn solid_fraction(arrangement: &Arrangement) -> f64 {
    let radius = &arrangement.particles.radius;
    let shares = skin::particle_shares(&arrangement.faces, radius.len());
    let dim = arrangement.space.dim();
    let solid: f64 = radius.iter().zip(shares).map(|(&r, share)| share * content(dim, r)).sum();
    solid / arrangement.block.measure(arrangement.space)
}

fn describe(arrangement: &Arrangement, seed: u64, checks: u64) -> PackingReport {
    let radius = &arrangement.particles.radius;
    let mean = radius.iter().sum::<f64>() / radius.len() as f64;
    let touching = bonding::by_gap(arrangement, TOUCHING * mean);
    let overlap = |pair: &bonding::Pair| {
        let sum = radius[pair.ends[0]] + radius[pair.ends[1]];
        1.0 - bonding::pair_vector(arrangement, *pair).norm() / sum
    };
    PackingReport {
        algorithm: ALGORITHM.into(),
        seed,
        particles: radius.len(),
        solid_fraction: solid_fraction(arrangement),
        mean_radius_m: mean,
        radius_spread: radius.iter().map(|r| (r / mean - 1.0).abs()).fold(0.0, f64::max),
        coordination: bonding::coordination(arrangement, &touching),
        largest_overlap: touching.iter().map(overlap).fold(0.0, f64::max),
        checks,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn periodic(space: Space, seed: u64) -> PackingRecipe {
        let fraction = if space == Space::Plane { 0.84 } else { 0.64 };
        PackingRecipe::periodic(space, 400, 1e-3, fraction, 0.2, seed).unwrap()
    }

    fn packed(recipe: &PackingRecipe) -> Packing {
        pack(recipe, Matter::default()).unwrap()
    }

    #[test]
    fn packings_are_what_was_asked_for() {
        for space in [Space::Plane, Space::Solid] {
            for boundary in [Boundary::Periodic, Boundary::Closed] {
                let recipe = PackingRecipe { boundary, ..periodic(space, 3) };
                let Packing { arrangement, report } = packed(&recipe);
                assert!((report.solid_fraction / recipe.solid_fraction - 1.0).abs() < 1e-12, "{report:?}");
                // The number of particles is whole, so the mean radius gives way a little; so does the spread around it.
                assert!((report.mean_radius_m / 1e-3 - 1.0).abs() < 0.02, "{report:?}");
                assert!((0.18..0.22).contains(&report.radius_spread), "{report:?}");
                // Isostatic packings touch 2·dim neighbours; rattlers take a few per cent off, flat faces crowd.
                let isostatic = 2.0 * space.dim() as f64;
                assert!((report.coordination / isostatic - 1.0).abs() < 0.12, "{report:?}");
                // Periodic ones relax fully; faces jam earlier. Both far below what changes a bond's length.
                let most = if boundary == Boundary::Periodic { 0.01 } else { 0.06 };
                assert!(report.largest_overlap < most, "{report:?}");
                // Each step looks at every pair that touches, and at some that nearly do.
                let touching = 0.5 * report.coordination * report.particles as f64;
                assert!(report.checks as f64 > touching, "{report:?}");
                let mass: f64 = arrangement.particles.mass.iter().sum();
                assert!((mass / recipe.block.measure(space) - 1.0).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn closed_packings_have_flat_faces() {
        let recipe = PackingRecipe { boundary: Boundary::Closed, ..periodic(Space::Solid, 5) };
        let Packing { arrangement, .. } = packed(&recipe);
        let particles = &arrangement.particles;
        let mut on_face = vec![false; particles.len()];
        for &(name, axis, upper) in Block::faces(Space::Solid) {
            let members = &arrangement.faces[name];
            let end = if upper { recipe.block.max[axis] } else { recipe.block.min[axis] };
            members.iter().for_each(|&p| on_face[p] = true);
            assert!(members.iter().all(|&p| particles.position[p][axis] == end));
            // Area of a face per particle of it, if discs fill some 0.8 of it.
            let expected = 0.8 * recipe.block.sides().x.powi(2) / (PI * 1e-6);
            assert!(
                (members.len() as f64 / expected - 1.0).abs() < 0.3,
                "{name}: {} {expected}",
                members.len()
            );
        }
        let inside = |p: &usize| !on_face[*p];
        for p in (0..particles.len()).filter(inside) {
            let x = particles.position[p];
            let depth = (x - recipe.block.min).min().min((recipe.block.max - x).min());
            assert!(depth > 0.85 * particles.radius[p], "particle {p} is {depth} m deep");
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bits() {
        let recipe = periodic(Space::Plane, 11);
        assert_eq!(packed(&recipe), packed(&recipe));
        assert_ne!(packed(&recipe), packed(&PackingRecipe { seed: 12, ..recipe }));
    }

    #[test]
    fn what_cannot_be_packed_is_refused() {
        let good = periodic(Space::Solid, 1);
        for bad in [
            PackingRecipe { solid_fraction: 0.75, ..good },
            PackingRecipe { solid_fraction: f64::NAN, ..good },
            PackingRecipe { radius_spread: 0.8, ..good },
            PackingRecipe { mean_radius_m: 1.0, ..good },
            PackingRecipe { mean_radius_m: -1e-3, ..good },
        ] {
            assert!(pack(&bad, Matter::default()).is_err(), "{bad:?}");
        }
    }
}
