//! Grid lines refined towards a point, through given coordinates.

use crate::error::{Error, Result};

/// More lines on one axis than this are a slip of a digit, not a mesh.
const MOST_LINES: usize = 100_000;

/// How fine a grid is at a distance d from a point, along an axis: cells of `finest growthᵏ`, k = 0, 1, …, up to `coarsest`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Length of the cells at the point, in m.
    pub finest: f64,
    /// Ratio of a cell to the one before it; 1 is even spacing.
    pub growth: f64,
    /// Length of the cells far away, in m.
    pub coarsest: f64,
}

impl Refinement {
    /// Distance at which the cells have become as long as the coarsest.
    fn grown(&self) -> f64 {
        if self.growth > 1.0 { (self.coarsest - self.finest) / (self.growth - 1.0) } else { f64::INFINITY }
    }

    /// Number of cells within d, not rounded: `d = finest (growthⁿ − 1)/(growth − 1)`, and evenly beyond.
    fn cells_within(&self, d: f64) -> f64 {
        if self.growth == 1.0 {
            return d / self.finest;
        }
        let near = d.min(self.grown());
        ((self.growth - 1.0) * near / self.finest).ln_1p() / self.growth.ln() + (d - near) / self.coarsest
    }

    /// The inverse of [`Refinement::cells_within`].
    fn distance(&self, n: f64) -> f64 {
        if self.growth == 1.0 {
            return n * self.finest;
        }
        let near = n.min(self.cells_within(self.grown()));
        self.finest * (near * self.growth.ln()).exp_m1() / (self.growth - 1.0) + (n - near) * self.coarsest
    }
}

/// Grid lines from `low` to `high` that pass through `focus` and `through` to the bit, finest at `focus`. Between two such coordinates
/// cells shrink a little to fit, so that none is longer than the refinement says at its far end.
///
/// # Errors
/// Lengths or a growth that are no refinement; coordinates outside or not finite; more than 100 000 lines.
pub fn refined([low, high]: [f64; 2], focus: f64, through: &[f64], by: Refinement) -> Result<Vec<f64>> {
    if !(low <= focus && focus <= high && low < high && (high - low).is_finite()) {
        return Err(bad(format!(
            "the point {focus} m of the finest cells is not between {low} m and {high} m"
        )));
    }
    if !(by.finest > 0.0
        && by.finest <= by.coarsest
        && by.coarsest.is_finite()
        && by.growth.is_finite()
        && by.growth >= 1.0)
    {
        return Err(bad(format!(
            "cells from {} m to {} m with ratio {}; give a positive finest length, a coarsest one not below it, and a ratio of at least 1",
            by.finest, by.coarsest, by.growth
        )));
    }
    if let Some(x) = through.iter().find(|x| !(low..=high).contains(*x)) {
        return Err(bad(format!("the grid line asked for at {x} m is not between {low} m and {high} m")));
    }
    let cells = by.cells_within(focus - low) + by.cells_within(high - focus);
    if cells > MOST_LINES as f64 {
        return Err(bad(format!("{cells:.0} cells on one axis; enlarge the finest ones or let them grow")));
    }
    // Coordinates that rounding alone tells apart are one: the earlier in this list stays.
    let same = 1e-9 * (high - low);
    let mut stops: Vec<f64> = Vec::new();
    for &x in [low, high, focus].iter().chain(through) {
        if stops.iter().all(|s| (s - x).abs() > same) || x == focus && !stops.contains(&x) {
            stops.push(x);
        }
    }
    stops.sort_by(f64::total_cmp);
    let mut lines = vec![low];
    for pair in stops.windows(2) {
        let side = if pair[0] >= focus { 1.0 } else { -1.0 };
        let mut ends = [pair[0], pair[1]].map(|x| by.cells_within((x - focus).abs()));
        ends.sort_by(f64::total_cmp);
        let [near, far] = ends;
        // A hair of rounding does not make another cell.
        let count = ((far - near) - 1e-9).ceil().max(1.0) as usize;
        let line = |k: usize| focus + side * by.distance(near + (far - near) * (k as f64 / count as f64));
        // Counted from the point on either side, so that a mirrored grid is mirrored to the bit.
        lines.extend((1..count).map(|k| line(if side > 0.0 { k } else { count - k })));
        lines.push(pair[1]);
    }
    Ok(lines)
}

fn bad(message: String) -> Error {
    Error::Geometry { what: "refined grid".to_owned(), message }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lines_ascend_pass_through_and_are_fine_enough(
            focus in 0.0..1.0f64,
            through in prop::collection::vec(0.0..1.0f64, 0..4),
            finest in 1e-5..0.1f64,
            growth in 1.0..3.0f64,
            coarsest in 0.1..0.5f64,
        ) {
            let growth = if growth < 1.1 { 1.0 } else { growth };
            let by = Refinement { finest, growth, coarsest };
            let lines = refined([0.0, 1.0], focus, &through, by).unwrap();
            prop_assert!(lines.windows(2).all(|w| w[1] > w[0]), "{lines:?}");
            prop_assert!([0.0, 1.0, focus].iter().all(|x| lines.contains(x)));
            prop_assert!(through.iter().all(|x| lines.iter().any(|l| (l - x).abs() <= 1e-9)));
            for w in lines.windows(2) {
                // A cell that ends at d is at most `finest + (growth − 1) d` long, and never above the coarsest.
                let d = (w[0] - focus).abs().max((w[1] - focus).abs());
                let longest = (finest + (growth - 1.0) * d).min(if growth > 1.0 { coarsest } else { finest });
                prop_assert!(w[1] - w[0] <= longest * (1.0 + 1e-6), "{w:?} {longest}");
            }
        }
    }

    #[test]
    fn cells_grow_by_the_ratio_up_to_the_coarsest() {
        let by = Refinement { finest: 1.0, growth: 2.0, coarsest: 8.0 };
        assert_eq!(refined([0.0, 31.0], 0.0, &[], by).unwrap().len(), 7);
        let lines = refined([-15.0, 15.0], 0.0, &[], by).unwrap();
        for (x, exact) in lines.iter().zip([-15.0, -7.0, -3.0, -1.0, 0.0, 1.0, 3.0, 7.0, 15.0]) {
            assert!((x - exact).abs() < 1e-12, "{lines:?}");
        }
    }

    #[test]
    fn what_is_no_refinement_is_refused() {
        let by = |finest, growth, coarsest| Refinement { finest, growth, coarsest };
        for bad in [
            by(0.0, 1.2, 1.0),
            by(0.2, 0.9, 1.0),
            by(0.2, 1.2, 0.1),
            by(f64::NAN, 1.2, 1.0),
            by(0.1, f64::NAN, 1.0),
        ] {
            assert!(refined([0.0, 1.0], 0.5, &[], bad).is_err(), "{bad:?}");
        }
        let good = by(0.1, 1.2, 1.0);
        assert!(refined([0.0, 1.0], 1.5, &[], good).is_err());
        assert!(refined([1.0, 0.0], 0.5, &[], good).is_err());
        assert!(refined([0.0, 1.0], 0.5, &[2.0], good).unwrap_err().to_string().contains("at 2 m"));
        assert!(
            refined([0.0, 1.0], 0.5, &[], by(1e-9, 1.0, 1.0))
                .unwrap_err()
                .to_string()
                .contains("1000000000 cells")
        );
    }
}
