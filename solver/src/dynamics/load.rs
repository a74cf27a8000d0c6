//! Load factors: one number over time by which the loads, or the prescribed motions, are multiplied.

use crate::error::{Error, Result};

/// A dimensionless factor over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum LoadFactor {
    /// One from the first instant on: a sudden load.
    #[default]
    Sudden,
    /// From zero at `start_s` linearly to one after `rise_s`, then constant.
    Ramp {
        /// Begin of the rise, in s.
        start_s: f64,
        /// Length of the rise, in s.
        rise_s: f64,
    },
    /// Linear between `(time in s, factor)`, times ascending; constant before the first and after the last.
    Table(Vec<(f64, f64)>),
}

impl LoadFactor {
    /// The factor at time `t` (s).
    pub fn at(&self, t: f64) -> f64 {
        match self {
            LoadFactor::Sudden => 1.0,
            LoadFactor::Ramp { start_s, rise_s } => ((t - start_s) / rise_s).clamp(0.0, 1.0),
            LoadFactor::Table(points) => match points.partition_point(|p| p.0 <= t) {
                0 => points[0].1,
                after if after == points.len() => points[after - 1].1,
                after => {
                    let ((t0, f0), (t1, f1)) = (points[after - 1], points[after]);
                    f0 + (f1 - f0) * (t - t0) / (t1 - t0)
                }
            },
        }
    }

    /// When the factor first reaches `level` coming from zero, up to `end_s` (s); at zero time if it is there already.
    pub fn first_reaches(&self, level: f64, end_s: f64) -> Option<f64> {
        let knots: Vec<f64> = match self {
            LoadFactor::Sudden => Vec::new(),
            LoadFactor::Ramp { start_s, rise_s } => vec![*start_s, start_s + rise_s],
            LoadFactor::Table(points) => points.iter().map(|p| p.0).collect(),
        };
        let inner = knots.into_iter().filter(|t| (0.0..end_s).contains(t));
        let mut before = (0.0, self.at(0.0));
        let reached = |f: f64| f * level.signum() >= level.abs();
        if reached(before.1) {
            return Some(0.0);
        }
        for t in inner.chain([end_s]) {
            let f = self.at(t);
            if reached(f) {
                // Linear between two knots.
                let (t0, f0) = before;
                return Some((t0 + (level - f0) / (f - f0) * (t - t0)).min(t));
            }
            before = (t, f);
        }
        None
    }

    /// Checks that the factor is defined at all times and acts before `end_s`; `what` names it.
    ///
    /// # Errors
    /// A rise that is not positive, a table that is empty or does not ascend, numbers that are not finite, and a
    /// history that begins at or after the end of the run.
    pub fn check(&self, what: &str, end_s: f64) -> Result<()> {
        let fail = |message: String| Err(Error::Load { what: what.to_owned(), message });
        let begin = match self {
            LoadFactor::Sudden => return Ok(()),
            LoadFactor::Ramp { start_s, rise_s } => {
                if !(start_s.is_finite() && rise_s.is_finite() && *rise_s > 0.0) {
                    return fail(format!("a ramp from {start_s} s over {rise_s} s; give a positive rise"));
                }
                *start_s
            }
            LoadFactor::Table(points) => {
                if points.iter().any(|p| !(p.0.is_finite() && p.1.is_finite())) {
                    return fail("the table has numbers that are not finite".to_owned());
                }
                if let Some(at) = points.windows(2).position(|w| w[1].0 <= w[0].0) {
                    return fail(format!("row {} of the table is not later than the one before", at + 1));
                }
                match points.first() {
                    Some(first) => first.0,
                    None => return fail("the table is empty; give at least one row".to_owned()),
                }
            }
        };
        if begin >= end_s {
            return fail(format!("it begins at {begin} s, the run ends at {end_s} s; begin it earlier"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_and_its_table_agree() {
        let ramp = LoadFactor::Ramp { start_s: 1.0, rise_s: 4.0 };
        let table = LoadFactor::Table(vec![(1.0, 0.0), (5.0, 1.0)]);
        for t in [0.0, 1.0, 2.0, 3.5, 5.0, 9.0] {
            assert_eq!(ramp.at(t), table.at(t));
        }
        assert_eq!(ramp.at(2.0), 0.25);
    }

    #[test]
    fn a_level_is_reached_from_zero() {
        let ramp = LoadFactor::Ramp { start_s: 1.0, rise_s: 4.0 };
        assert_eq!(ramp.first_reaches(0.25, 9.0), Some(2.0));
        assert_eq!(ramp.first_reaches(1.0, 9.0), Some(5.0));
        assert_eq!(ramp.first_reaches(0.5, 2.5), None);
        assert_eq!(LoadFactor::Sudden.first_reaches(0.5, 1.0), Some(0.0));
        let table = LoadFactor::Table(vec![(0.0, 0.5), (1.0, 0.75), (3.0, -1.0)]);
        assert_eq!(table.first_reaches(0.25, 9.0), Some(0.0));
        assert_eq!(table.first_reaches(0.625, 9.0), Some(0.5));
        assert_eq!(table.first_reaches(-0.125, 9.0), Some(2.0));
        assert_eq!(table.first_reaches(2.0, 9.0), None);
    }

    #[test]
    fn bad_histories_are_refused() {
        let message = |factor: LoadFactor| factor.check("load 'tip'", 2.0).unwrap_err().to_string();
        assert!(message(LoadFactor::Ramp { start_s: 2.0, rise_s: 1.0 }).contains("run ends at 2 s"));
        assert!(message(LoadFactor::Ramp { start_s: 0.0, rise_s: 0.0 }).contains("positive rise"));
        assert!(message(LoadFactor::Table(Vec::new())).contains("empty"));
        assert!(message(LoadFactor::Table(vec![(0.0, 1.0), (0.0, 2.0)])).contains("row 1"));
        assert!(message(LoadFactor::Table(vec![(0.0, f64::NAN)])).contains("not finite"));
    }
}
