//! Pairs that are near enough to touch soon: a cell grid, renewed only when something has moved far enough.

use crate::dem::block::Block;
use crate::dem::grid::{Boundary, Grid};
use crate::space::{Space, Vec3};
use crate::work::Work;
use std::collections::BTreeSet;

/// Pairs are listed up to this share of the smallest radius apart, so that the list lasts until one has moved half of it.
const MARGIN: f64 = 0.5;

/// A list of near pairs and the positions it was made for.
#[derive(Debug, Clone, Default)]
pub(super) struct Search {
    pairs: Vec<(usize, usize)>,
    made_for: Vec<Vec3>,
    margin: f64,
}

impl Search {
    /// Makes the next call list anew.
    pub fn forget(&mut self) {
        self.made_for.clear();
    }

    /// Near pairs `(lower, higher)`, ascending.
    pub fn pairs(&self) -> &[(usize, usize)] {
        &self.pairs
    }

    /// Lists the pairs of active particles that are not bonded, unless the last list still holds.
    pub fn renew(
        &mut self,
        space: Space,
        position: &[Vec3],
        radius: &[f64],
        active: &BTreeSet<usize>,
        bonded: &BTreeSet<(usize, usize)>,
        work: &mut Work,
    ) {
        let far = |(x, y): (&Vec3, &Vec3)| (x - y).norm_squared() > 0.25 * self.margin * self.margin;
        if !self.made_for.is_empty() && !position.iter().zip(&self.made_for).any(far) {
            return;
        }
        let (smallest, largest) = radius.iter().fold((f64::MAX, 0.0f64), |(s, l), r| (s.min(*r), l.max(*r)));
        self.margin = MARGIN * smallest;
        self.made_for = position.to_vec();
        self.pairs.clear();
        let pad = Vec3::from_fn(|c, _| if c < space.dim() { largest } else { 0.0 });
        let low = position.iter().fold(Vec3::repeat(f64::MAX), |m, x| m.inf(x)) - pad;
        let high = position.iter().fold(Vec3::repeat(f64::MIN), |m, x| m.sup(x)) + pad;
        // Positions that are not finite touch nothing; the integrator reports them.
        if !(high - low).iter().all(|s| s.is_finite()) {
            return;
        }
        let block = Block { min: low, max: high };
        let grid = Grid::new(space, block, Boundary::Closed, position, 2.0 * largest + self.margin);
        for &i in active {
            grid.for_each_within(position[i], radius[i] + largest + self.margin, |near| {
                let j = near.point;
                work.contact_checks += 1;
                // A pair of two active particles is listed by the lower one.
                let listed = j == i || (j < i && active.contains(&j));
                let pair = (i.min(j), i.max(j));
                let reach = radius[i] + radius[j] + self.margin;
                if !listed && near.offset.norm_squared() <= reach * reach && !bonded.contains(&pair) {
                    self.pairs.push(pair);
                }
            });
        }
        self.pairs.sort_unstable();
    }
}
