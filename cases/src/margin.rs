//! How far a hard case is from breaking: the largest factor that still passes.
//!
//! The factor climbs by doubling until it fails for the first time; bisection of its logarithm then closes in on the place.
//! So a window that passes again beyond the first failure is not taken for a margin.

use crate::error::Result;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The largest value of one axis at which a hard case still passes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Margin {
    /// Unique within the case.
    pub id: String,
    /// The hard case, as a row of the table of hard cases.
    pub row: String,
    /// Which body and scheme.
    pub label: String,
    /// What is raised.
    pub axis: String,
    /// Unit of the axis, `1` for a pure number.
    pub unit: String,
    /// The largest value that passed; zero if not even the first one did.
    pub value: f64,
    /// The value that has to pass.
    pub needed: f64,
    /// Relative width in which the search ended: `value · (1 + tolerance)` fails.
    pub tolerance: f64,
    /// Whether the end of the search still passed: the margin is at least this large.
    pub open: bool,
    /// When the case passes.
    pub criterion: String,
    /// How the value was found.
    pub how: String,
}

/// Width of a search that rounding ends: another order of elimination or another processor repeats no more than the factor of two.
pub const ROUNDING: f64 = 1.0;

/// Where to look for a margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Search {
    /// The first value, expected to pass; positive.
    pub from: f64,
    /// The last one.
    pub to: f64,
    /// Relative width at which to stop; zero asks for whole numbers, to the last one.
    pub tolerance: f64,
}

/// What a search found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// As [`Margin::value`].
    pub value: f64,
    /// As [`Margin::open`].
    pub open: bool,
    /// Runs that were made.
    pub runs: usize,
    search: Search,
}

impl Search {
    /// The largest value that passes.
    ///
    /// # Errors
    /// What `passes` returns.
    pub fn largest(self, mut passes: impl FnMut(f64) -> Result<bool>) -> Result<Found> {
        let found = |value, open, runs| Found { value, open, runs, search: self };
        let mut runs = 1;
        if !passes(self.from)? {
            return Ok(found(0.0, false, runs));
        }
        let (mut low, mut high) = (self.from, self.from);
        while high < self.to {
            high = self.place((2.0 * low).min(self.to));
            runs += 1;
            if !passes(high)? {
                return self.bisect(low, high, &mut runs, passes).map(|value| found(value, false, runs));
            }
            low = high;
        }
        Ok(found(low, true, runs))
    }

    /// Between a value that passes and one that fails.
    fn bisect(
        self,
        mut low: f64,
        mut high: f64,
        runs: &mut usize,
        mut passes: impl FnMut(f64) -> Result<bool>,
    ) -> Result<f64> {
        loop {
            let middle = self.place((low * high).sqrt());
            let done =
                if self.tolerance == 0.0 { high - low <= 1.0 } else { high / low <= 1.0 + self.tolerance };
            // A width below the spacing of numbers has no middle.
            if done || !(low < middle && middle < high) {
                return Ok(low);
            }
            *runs += 1;
            if passes(middle)? { low = middle } else { high = middle }
        }
    }

    fn place(self, value: f64) -> f64 {
        if self.tolerance == 0.0 { value.round() } else { value }
    }
}

impl Found {
    /// The margin it is: `[row, criterion]`, `[id, label, axis]`, the value needed.
    pub fn margin(self, [row, criterion]: [&str; 2], [id, label, axis]: [&str; 3], needed: f64) -> Margin {
        let Found { value, open, runs, search: Search { from, to, tolerance } } = self;
        let width = if tolerance == 0.0 {
            "to the whole number".to_owned()
        } else {
            format!("to {} %", 100.0 * tolerance)
        };
        let how = format!("doubled from {from} up to {to}, then bisected {width}: {runs} runs");
        Margin {
            id: id.to_owned(),
            row: row.to_owned(),
            label: label.to_owned(),
            axis: axis.to_owned(),
            unit: "1".to_owned(),
            value,
            needed,
            tolerance,
            open,
            criterion: criterion.to_owned(),
            how,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn search(from: f64, to: f64, tolerance: f64, limit: f64) -> Found {
        Search { from, to, tolerance }.largest(|x| Ok(x <= limit)).expect("nothing fails")
    }

    proptest! {
        #[test]
        fn the_limit_is_bracketed(limit in 1.0..1e6f64, tolerance in 1e-6..0.1f64) {
            let found = search(1.0, 1e7, tolerance, limit);
            prop_assert!(found.value <= limit && limit < found.value * (1.0 + tolerance) * (1.0 + 1e-12));
            prop_assert!(!found.open);
        }

        #[test]
        fn whole_numbers_are_met_exactly(limit in 1usize..2000) {
            prop_assert_eq!(search(1.0, 4000.0, 0.0, limit as f64).value, limit as f64);
        }
    }

    #[test]
    fn the_ends_are_told_apart() {
        let found = search(1.0, 100.0, 0.01, 1e9);
        assert_eq!((found.value, found.open), (100.0, true));
        let found = search(1.0, 100.0, 0.01, 0.5);
        assert_eq!((found.value, found.open, found.runs), (0.0, false, 1));
    }

    /// What passes again beyond the first failure is no margin.
    #[test]
    fn a_window_beyond_the_first_failure_is_not_reached() {
        let passes = |x: f64| Ok(x <= 3.0 || (100.0..1000.0).contains(&x));
        let found = Search { from: 1.0, to: 1e4, tolerance: 1e-3 }.largest(passes).expect("nothing fails");
        assert!((found.value / 3.0 - 1.0).abs() < 1e-3, "{found:?}");
    }
}
