//! A cell grid that finds the points near a place in constant time, periodic or not.

use super::block::Block;
use crate::space::{Space, Vec3};

/// Whether a box ends at its faces or repeats beyond them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// The body ends at the faces.
    Closed,
    /// The box is one period of an infinite body.
    Periodic,
}

/// A point near a place, possibly in a neighbouring period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Index of the point.
    pub point: usize,
    /// Period it lies in, in units of the sides of the box; zero in a closed one.
    pub shift: [i8; 3],
    /// Its position seen from the place, in metres.
    pub offset: Vec3,
}

/// Points of a box sorted into bins.
#[derive(Debug, Clone)]
pub struct Grid {
    block: Block,
    boundary: Boundary,
    bins: [usize; 3],
    start: Vec<usize>,
    order: Vec<usize>,
    points: Vec<Vec3>,
}

impl Grid {
    /// Sorts points into bins of about the given size (m). Points outside the box go to its
    /// outermost bins; in a periodic one they must lie inside.
    pub fn new(space: Space, block: Block, boundary: Boundary, points: &[Vec3], bin: f64) -> Self {
        let sides = block.sides();
        // At most about four bins per point: a bin far below the spacing would only cost memory.
        let finest = (block.measure(space) / (4 * points.len() + 8) as f64).powf(1.0 / space.dim() as f64);
        let mut bins = [1usize; 3];
        for axis in 0..space.dim() {
            bins[axis] = (sides[axis] / bin.max(finest)).floor().max(1.0) as usize;
        }
        let mut grid = Self {
            block,
            boundary,
            bins,
            start: Vec::new(),
            order: vec![0; points.len()],
            points: points.to_vec(),
        };
        grid.sort();
        grid
    }

    /// Counting sort of the points by bin; within a bin they stay in ascending order.
    fn sort(&mut self) {
        let bin: Vec<usize> = self.points.iter().map(|&x| self.flat(self.bin_of(x))).collect();
        self.start = vec![0; self.bins.iter().product::<usize>() + 1];
        for &b in &bin {
            self.start[b + 1] += 1;
        }
        for b in 1..self.start.len() {
            self.start[b] += self.start[b - 1];
        }
        let mut next = self.start.clone();
        for (point, &b) in bin.iter().enumerate() {
            self.order[next[b]] = point;
            next[b] += 1;
        }
    }

    fn bin_along(&self, axis: usize, x: f64) -> i64 {
        ((x - self.block.min[axis]) / self.block.sides()[axis] * self.bins[axis] as f64).floor() as i64
    }

    fn bin_of(&self, x: Vec3) -> [usize; 3] {
        let along = |axis| match self.bins[axis] {
            1 => 0,
            n => self.bin_along(axis, x[axis]).clamp(0, n as i64 - 1) as usize,
        };
        [along(0), along(1), along(2)]
    }

    fn flat(&self, b: [usize; 3]) -> usize {
        (b[2] * self.bins[1] + b[1]) * self.bins[0] + b[0]
    }

    /// Bins along an axis that a ball touches, as (bin, period).
    fn reach(&self, axis: usize, x: f64, radius: f64) -> Vec<(usize, i8)> {
        let n = self.bins[axis] as i64;
        if self.block.sides()[axis] == 0.0 {
            return vec![(0, 0)];
        }
        let (low, high) = (self.bin_along(axis, x - radius), self.bin_along(axis, x + radius));
        match self.boundary {
            Boundary::Closed => {
                (low.clamp(0, n - 1)..=high.clamp(0, n - 1)).map(|b| (b as usize, 0)).collect()
            }
            Boundary::Periodic => {
                (low..=high).map(|b| (b.rem_euclid(n) as usize, b.div_euclid(n) as i8)).collect()
            }
        }
    }

    /// Calls `found` for every point no farther than `radius` from `x`, the place itself
    /// included, in a fixed order.
    pub fn for_each_within(&self, x: Vec3, radius: f64, mut found: impl FnMut(Near)) {
        let sides = self.block.sides();
        let [xs, ys, zs] = [0, 1, 2].map(|axis| self.reach(axis, x[axis], radius));
        for &(bz, sz) in &zs {
            for &(by, sy) in &ys {
                for &(bx, sx) in &xs {
                    let period = Vec3::new(sx as f64 * sides.x, sy as f64 * sides.y, sz as f64 * sides.z);
                    let bin = self.flat([bx, by, bz]);
                    for &point in &self.order[self.start[bin]..self.start[bin + 1]] {
                        let offset = self.points[point] + period - x;
                        if offset.norm_squared() <= radius * radius {
                            found(Near { point, shift: [sx, sy, sz], offset });
                        }
                    }
                }
            }
        }
    }
}
