//! Throws particles onto the corners, edges and faces of a box, then inside it.
//!
//! A *stratum* is the box itself or one of its corners, edges or faces: some axes are free, the
//! others fixed at one end of the box. Each is filled to its own solid fraction, counting what the
//! particles of its own corners and edges already fill.

use super::{PackingRecipe, content, mean_content};
use crate::dem::grid::Boundary;
use crate::error::{Error, Result};
use crate::space::Vec3;
use rand::{Rng, RngExt};

/// Solid fraction of the edges (rods on a line) and faces (discs in a plane). A wall of discs at their own jamming fraction 0.84
/// squeezes the particles behind it; with these the faces are still closed rows of neighbours, and the largest
/// overlap stays of the order of 2 % for 400 spheres, 1 % for 2000.
const BOUNDING_FRACTION: [f64; 2] = [0.85, 0.68];

/// Particles in random places.
pub struct Thrown {
    pub position: Vec<Vec3>,
    pub radius: Vec<f64>,
    /// Axes along which each particle may move.
    pub free: Vec<[bool; 3]>,
}

/// `None`: the axis is free; `Some(upper)`: fixed at the lower or upper end.
type Stratum = [Option<bool>; 3];

/// Particles for the whole box, scaled to its solid fraction.
pub fn throw(recipe: &PackingRecipe, rng: &mut impl Rng) -> Result<Thrown> {
    let mut thrown = Thrown { position: Vec::new(), radius: Vec::new(), free: Vec::new() };
    let mut owner: Vec<Stratum> = Vec::new();
    for stratum in strata(recipe) {
        let count = count(recipe, &stratum, &owner, &thrown.radius)?;
        for _ in 0..count {
            thrown.position.push(Vec3::from_fn(|axis, _| {
                let (low, high) = (recipe.block.min[axis], recipe.block.max[axis]);
                match stratum[axis] {
                    Some(upper) => {
                        if upper {
                            high
                        } else {
                            low
                        }
                    }
                    None => low + (high - low) * rng.random::<f64>(),
                }
            }));
            let deviation = recipe.radius_spread * (2.0 * rng.random::<f64>() - 1.0);
            thrown.radius.push(recipe.mean_radius_m * (1.0 + deviation));
            thrown.free.push(stratum.map(|end| end.is_none()));
            owner.push(stratum);
        }
    }
    scale(recipe, &mut thrown);
    Ok(thrown)
}

/// Number of free axes.
fn dimension(stratum: &Stratum) -> usize {
    stratum.iter().filter(|end| end.is_none()).count()
}

/// All strata of the box, corners first; only the box itself if it repeats. In the plane z is fixed.
fn strata(recipe: &PackingRecipe) -> Vec<Stratum> {
    let ends = |axis: usize| match (axis < recipe.space.dim(), recipe.boundary) {
        (false, _) => vec![Some(false)],
        (true, Boundary::Periodic) => vec![None],
        (true, Boundary::Closed) => vec![Some(false), Some(true), None],
    };
    let mut all = Vec::new();
    for z in ends(2) {
        for y in ends(1) {
            for x in ends(0) {
                all.push([x, y, z]);
            }
        }
    }
    all.sort_by_key(dimension);
    all
}

/// How many particles fill a stratum, given those thrown before.
fn count(recipe: &PackingRecipe, stratum: &Stratum, owner: &[Stratum], radius: &[f64]) -> Result<usize> {
    let dim = dimension(stratum);
    if dim == 0 {
        return Ok(1);
    }
    let fraction = if dim == recipe.space.dim() { recipe.solid_fraction } else { BOUNDING_FRACTION[dim - 1] };
    let sides = recipe.block.sides();
    let measure: f64 = (0..3).filter(|&axis| stratum[axis].is_none()).map(|axis| sides[axis]).product();
    let filled: f64 = owner
        .iter()
        .zip(radius)
        .filter(|(other, _)| bounds(other, stratum))
        .map(|(other, &r)| 0.5f64.powi((dim - dimension(other)) as i32) * content(dim, r))
        .sum();
    let each = mean_content(dim, recipe.radius_spread) * recipe.mean_radius_m.powi(dim as i32);
    let count = ((fraction * measure - filled) / each).round();
    if dim == recipe.space.dim() && count < 1.0 {
        return Err(Error::Geometry {
            what: "packing".into(),
            message: format!(
                "the faces alone hold more than solid fraction {fraction}; use smaller particles or a higher fraction"
            ),
        });
    }
    Ok(count.max(0.0) as usize)
}

/// Whether `part` lies in the closure of `whole`.
fn bounds(part: &Stratum, whole: &Stratum) -> bool {
    (0..3).all(|axis| whole[axis].is_none() || whole[axis] == part[axis])
}

/// Scales all radii so that what lies inside the box fills its solid fraction.
fn scale(recipe: &PackingRecipe, thrown: &mut Thrown) {
    let dim = recipe.space.dim();
    let share = |free: &[bool; 3]| 0.5f64.powi((0..dim).filter(|&axis| !free[axis]).count() as i32);
    let solid: f64 = thrown.radius.iter().zip(&thrown.free).map(|(&r, f)| share(f) * content(dim, r)).sum();
    let wanted = recipe.solid_fraction * recipe.block.measure(recipe.space);
    let factor = (wanted / solid).powf(1.0 / dim as f64);
    thrown.radius.iter_mut().for_each(|r| *r *= factor);
}
