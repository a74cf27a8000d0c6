//! Pushes overlapping particles apart.
//!
//! Minimises `½ Σ δ²` over the overlaps `δ = R_i + R_j − |x_j − x_i|` (and, in a closed box, over
//! the overlap of an inner particle with its mirror image in a face, `δ = 2R − 2d`) with the fast inertial relaxation
//! engine (Bitzek et al. 2006, FIRE): velocities are steered towards the force, and stopped whenever they go uphill.

use super::PackingRecipe;
use super::strata::Thrown;
use crate::dem::grid::{Boundary, Grid};
use crate::space::Vec3;

/// Relaxed when no overlap exceeds this share of the mean radius …
const LARGEST_OVERLAP: f64 = 5e-4;
/// … or when the largest force is this share of the largest overlap: jammed.
const BALANCED: f64 = 1e-3;
/// Jammed packings balance within some hundred steps; beyond this, more would not change them visibly.
const MOST_STEPS: usize = 6000;
/// Neighbours are listed up to this gap, in mean radii, and listed anew when that could have closed.
const LIST_MARGIN: f64 = 0.5;

/// A listed pair: `offset` leads from the second particle to its image that is near the first.
struct Neighbour {
    i: usize,
    j: usize,
    offset: Vec3,
}

struct Relaxation<'a> {
    recipe: &'a PackingRecipe,
    thrown: &'a mut Thrown,
    unit: f64,
    list: Vec<Neighbour>,
    listed_at: Vec<Vec3>,
    force: Vec<Vec3>,
    /// Largest overlap and largest force component, in metres.
    overlap: f64,
    largest_force: f64,
    /// Pairs looked at so far.
    checks: u64,
}

/// Moves the particles, each along its free axes only, until they hardly overlap or are jammed; gives the number of pairs
/// looked at.
pub fn push_apart(recipe: &PackingRecipe, thrown: &mut Thrown) -> u64 {
    let n = thrown.position.len();
    let unit = thrown.radius.iter().sum::<f64>() / n as f64;
    let force = vec![Vec3::zeros(); n];
    let mut relaxation = Relaxation {
        recipe,
        thrown,
        unit,
        list: Vec::new(),
        listed_at: Vec::new(),
        force,
        overlap: 0.0,
        largest_force: 0.0,
        checks: 0,
    };
    relaxation.list_neighbours();
    relaxation.run();
    relaxation.wrap();
    relaxation.checks
}

impl Relaxation<'_> {
    /// FIRE with the parameters of its authors; unit mass and unit spring, so time has no unit.
    fn run(&mut self) {
        const ALPHA: f64 = 0.1;
        const PATIENCE: usize = 5;
        const DT_MAX: f64 = 0.5;
        let mut velocity = vec![Vec3::zeros(); self.force.len()];
        let (mut dt, mut alpha, mut downhill) = (0.1_f64, ALPHA, 0);
        self.update_force();
        for _ in 0..MOST_STEPS {
            if self.is_relaxed() {
                return;
            }
            let power: f64 = velocity.iter().zip(&self.force).map(|(v, f)| v.dot(f)).sum();
            if power > 0.0 {
                let speed = norm(&velocity);
                let steer = alpha * speed / norm(&self.force);
                velocity.iter_mut().zip(&self.force).for_each(|(v, f)| *v = *v * (1.0 - alpha) + f * steer);
                downhill += 1;
                if downhill > PATIENCE {
                    dt = (dt * 1.1).min(DT_MAX);
                    alpha *= 0.99;
                }
            } else {
                velocity.fill(Vec3::zeros());
                (dt, alpha, downhill) = (0.5 * dt, ALPHA, 0);
            }
            for i in 0..velocity.len() {
                velocity[i] += dt * self.force[i];
                // A step of more than a tenth of a radius would jump over neighbours.
                let step = (dt * velocity[i]).cap_magnitude(0.1 * self.unit);
                self.thrown.position[i] += step;
            }
            self.keep_inside();
            self.list_if_needed();
            self.update_force();
        }
    }

    fn is_relaxed(&self) -> bool {
        self.overlap < LARGEST_OVERLAP * self.unit || self.largest_force < BALANCED * self.overlap
    }

    /// Particles of a closed box never leave it.
    fn keep_inside(&mut self) {
        if self.recipe.boundary == Boundary::Closed {
            let block = &self.recipe.block;
            self.thrown.position.iter_mut().for_each(|x| *x = x.sup(&block.min).inf(&block.max));
        }
    }

    fn wrap(&mut self) {
        if self.recipe.boundary == Boundary::Closed {
            return;
        }
        let block = &self.recipe.block;
        for x in &mut self.thrown.position {
            for axis in 0..self.recipe.space.dim() {
                let side = block.sides()[axis];
                // The remainder of a tiny negative number rounds up to the side itself.
                let inside = (x[axis] - block.min[axis]).rem_euclid(side);
                x[axis] = block.min[axis] + if inside < side { inside } else { 0.0 };
            }
        }
    }

    fn list_if_needed(&mut self) {
        let most = 0.5 * LIST_MARGIN * self.unit;
        let moved = |(x, old): (&Vec3, &Vec3)| (x - old).norm_squared() > most * most;
        if self.thrown.position.iter().zip(&self.listed_at).any(moved) {
            self.list_neighbours();
        }
    }

    fn list_neighbours(&mut self) {
        self.wrap();
        let PackingRecipe { space, block, boundary, .. } = *self.recipe;
        let Thrown { position, radius, .. } = &*self.thrown;
        let largest = radius.iter().copied().fold(0.0, f64::max);
        let margin = LIST_MARGIN * self.unit;
        let grid = Grid::new(space, block, boundary, position, 2.0 * largest + margin);
        self.list.clear();
        for i in 0..position.len() {
            grid.for_each_within(position[i], radius[i] + largest + margin, |near| {
                let j = near.point;
                let reach = radius[i] + radius[j] + margin;
                let listed_once = i < j || (i == j && near.shift > [0; 3]);
                if listed_once && near.offset.norm_squared() < reach * reach {
                    self.list.push(Neighbour { i, j, offset: near.offset - (position[j] - position[i]) });
                }
            });
        }
        self.listed_at.clone_from(position);
    }

    /// Forces `δ n` along the free axes.
    fn update_force(&mut self) {
        let Thrown { position, radius, .. } = &*self.thrown;
        self.force.fill(Vec3::zeros());
        self.overlap = 0.0;
        for &Neighbour { i, j, offset } in &self.list {
            let d = position[j] - position[i] + offset;
            let sum = radius[i] + radius[j];
            let square = d.norm_squared();
            if square < sum * sum && square > 0.0 {
                let distance = square.sqrt();
                let overlap = sum - distance;
                let f = d * (overlap / distance);
                self.force[i] -= f;
                self.force[j] += f;
                self.overlap = self.overlap.max(overlap);
            }
        }
        self.checks += self.list.len() as u64;
        self.add_mirrors();
        self.largest_force = 0.0;
        for (f, free) in self.force.iter_mut().zip(&self.thrown.free) {
            for axis in 0..3 {
                if !free[axis] {
                    f[axis] = 0.0;
                }
            }
            self.largest_force = self.largest_force.max(f.amax());
        }
    }

    fn add_mirrors(&mut self) {
        if self.recipe.boundary == Boundary::Periodic {
            return;
        }
        let block = &self.recipe.block;
        let Thrown { position, radius, free } = &*self.thrown;
        for i in 0..position.len() {
            for axis in (0..3).filter(|&axis| free[i][axis]) {
                let low = position[i][axis] - block.min[axis];
                let high = block.max[axis] - position[i][axis];
                for (distance, inwards) in [(low, 1.0), (high, -1.0)] {
                    let overlap = 2.0 * (radius[i] - distance);
                    if overlap > 0.0 {
                        self.force[i][axis] += inwards * overlap;
                        self.overlap = self.overlap.max(overlap);
                    }
                }
            }
        }
    }
}

fn norm(v: &[Vec3]) -> f64 {
    v.iter().map(Vec3::norm_squared).sum::<f64>().sqrt()
}
