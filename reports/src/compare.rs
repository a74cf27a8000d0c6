//! Comparison of a value or a curve with its reference: two-sided, never extrapolated.

use thiserror::Error;

/// Two-sided tolerance: `|a − ref| ≤ max(ρ·|ref|, ε)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// `ρ`, as a fraction of the reference.
    pub relative: f64,
    /// `ε`, in the unit of the quantity.
    pub absolute: f64,
}

impl Tolerance {
    /// Half width `max(ρ·|ref|, ε)` of the accepted interval, in the unit of the quantity.
    pub fn half_width(&self, reference: f64) -> f64 {
        (self.relative * reference.abs()).max(self.absolute)
    }

    /// The accepted interval of the value, `[ref − h, ref + h]`.
    pub fn interval(&self, reference: f64) -> [f64; 2] {
        let h = self.half_width(reference);
        [reference - h, reference + h]
    }
}

/// Whether a value lies in a closed interval; never true of NaN.
pub fn within(value: f64, [lo, hi]: [f64; 2]) -> bool {
    lo <= value && value <= hi
}

/// Share of the way from the best value to the end of the accepted interval that is left: 1 at
/// the best value, 0 at the end, negative outside.
///
/// The best value is the reference; without one in the interval, zero if the interval starts there (the value
/// is then an error itself), else its middle. `None` if that end is not finite or has no distance.
pub fn headroom(value: f64, [lo, hi]: [f64; 2], reference: Option<f64>) -> Option<f64> {
    let without = if lo == 0.0 { 0.0 } else { 0.5 * (lo + hi) };
    let best = reference.filter(|r| within(*r, [lo, hi])).unwrap_or(without);
    let room = if value > best { hi - best } else { best - lo };
    let used = (value - best).abs();
    (room.is_finite() && (room > 0.0 || used > 0.0)).then(|| 1.0 - used / room).filter(|h| h.is_finite())
}

/// Signed error `(a − ref)/ref`, positive where the value is the larger one in magnitude; absolute where the
/// reference is zero.
pub fn signed_error(value: f64, reference: f64) -> f64 {
    if reference == 0.0 { value } else { (value - reference) / reference }
}

/// Coverage of the reference's stations below which a comparison of curves has failed.
pub const LEAST_COVERAGE: f64 = 0.95;

/// Why two curves cannot be compared.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CurveError {
    /// Arrays that do not belong together.
    #[error("{which}: {x} abscissae but {y} ordinates; write one ordinate per station")]
    Lengths {
        /// Which curve.
        which: &'static str,
        /// Number of abscissae.
        x: usize,
        /// Number of ordinates.
        y: usize,
    },
    /// Fewer than two points.
    #[error("{which}: {points} point(s); a curve needs two or more")]
    TooShort {
        /// Which curve.
        which: &'static str,
        /// Number of points.
        points: usize,
    },
    /// NaN, infinity, or stations that do not ascend.
    #[error(
        "{which}: point {index} is not finite, or its x does not ascend; sort the stations and remove it"
    )]
    BadPoint {
        /// Which curve.
        which: &'static str,
        /// Index of the point.
        index: usize,
    },
    /// No overlap.
    #[error("the curves share fewer than two stations of the reference; nothing was compared")]
    NoOverlap,
}

/// Outcome of comparing a model curve `s` with a reference curve `r`.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveComparison {
    /// Share of the reference's stations that lie inside the model's range.
    pub coverage: f64,
    /// `e₂ = √Σw(s−r)² / max(√Σw r², S√Σw)`; `None` where `max|r|` does not exceed the floor `S`.
    pub e2: Option<f64>,
    /// `e∞ = max|s−r| / max(max|r|, S)`; `None` where `max|r|` does not exceed the floor `S`.
    pub e_max: Option<f64>,
    /// `max|s−r|`, in the unit of the ordinate.
    pub absolute: f64,
    /// Stations and residuals `s − r`.
    pub residual: Vec<[f64; 2]>,
}

/// Compares the model with the reference at the reference's stations inside the overlap, with
/// trapezoid weights `w`. `floor` is `S`, in the unit of the ordinate.
///
/// # Errors
/// Arrays of different length, fewer than two points, points that are not finite or do not ascend,
/// or curves that do not overlap.
pub fn compare_curves(
    model: (&[f64], &[f64]),
    reference: (&[f64], &[f64]),
    floor: f64,
) -> Result<CurveComparison, CurveError> {
    check_curve("model", model)?;
    check_curve("reference", reference)?;
    let (rx, ry) = reference;
    let inside: Vec<usize> = (0..rx.len()).filter(|&i| interpolate(model, rx[i]).is_some()).collect();
    if inside.len() < 2 {
        return Err(CurveError::NoOverlap);
    }
    let x: Vec<f64> = inside.iter().map(|&i| rx[i]).collect();
    let r: Vec<f64> = inside.iter().map(|&i| ry[i]).collect();
    let d: Vec<f64> = x.iter().zip(&r).filter_map(|(&x, r)| interpolate(model, x).map(|s| s - r)).collect();
    let w = trapezoid_weights(&x);
    let (sum_d2, sum_r2, sum_w) = (weighted_squares(&w, &d), weighted_squares(&w, &r), w.iter().sum::<f64>());
    let (max_d, max_r) = (largest(&d), largest(&r));
    let measurable = max_r > floor;
    Ok(CurveComparison {
        coverage: inside.len() as f64 / rx.len() as f64,
        e2: measurable.then(|| sum_d2.sqrt() / sum_r2.sqrt().max(floor * sum_w.sqrt())),
        e_max: measurable.then(|| max_d / max_r.max(floor)),
        absolute: max_d,
        residual: x.iter().zip(&d).map(|(&x, &d)| [x, d]).collect(),
    })
}

fn check_curve(which: &'static str, (x, y): (&[f64], &[f64])) -> Result<(), CurveError> {
    if x.len() != y.len() {
        return Err(CurveError::Lengths { which, x: x.len(), y: y.len() });
    }
    if x.len() < 2 {
        return Err(CurveError::TooShort { which, points: x.len() });
    }
    let bad = (0..x.len()).find(|&i| {
        !x[i].is_finite()
            || !y[i].is_finite()
            || (i > 0 && x[i].partial_cmp(&x[i - 1]) != Some(std::cmp::Ordering::Greater))
    });
    bad.map_or(Ok(()), |index| Err(CurveError::BadPoint { which, index }))
}

/// Linear interpolation; `None` outside the curve. Stations that differ from an end by rounding
/// only (a few ulps of the curve's span) count as that end.
fn interpolate((x, y): (&[f64], &[f64]), at: f64) -> Option<f64> {
    let (first, last) = (x[0], x[x.len() - 1]);
    let rounding = 8.0 * f64::EPSILON * (last - first).max(last.abs()).max(first.abs());
    if at < first - rounding || at > last + rounding {
        return None;
    }
    let at = at.clamp(first, last);
    let right = x.partition_point(|&xi| xi < at).clamp(1, x.len() - 1);
    let t = (at - x[right - 1]) / (x[right] - x[right - 1]);
    Some(y[right - 1] + t * (y[right] - y[right - 1]))
}

fn trapezoid_weights(x: &[f64]) -> Vec<f64> {
    let n = x.len();
    (0..n).map(|i| 0.5 * (x[(i + 1).min(n - 1)] - x[i.saturating_sub(1)])).collect()
}

fn weighted_squares(w: &[f64], v: &[f64]) -> f64 {
    w.iter().zip(v).map(|(w, v)| w * v * v).sum()
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, v| v.abs().max(m))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerance_is_two_sided() {
        let rule = Tolerance { relative: 0.02, absolute: 0.0 };
        for (value, ok) in [(-98.0, true), (-102.0, true), (-97.9, false), (-102.1, false)] {
            assert_eq!(within(value, rule.interval(-100.0)), ok, "{value}");
        }
        let floor = Tolerance { relative: 0.02, absolute: 1e-3 };
        assert_eq!(floor.interval(0.0), [-1e-3, 1e-3]);
        assert!(!within(f64::NAN, [-1.0, 1.0]));
    }

    #[test]
    fn headroom_is_one_at_the_best_value_and_negative_outside() {
        assert_eq!(headroom(1.0, [0.0, 4.0], Some(1.0)), Some(1.0));
        assert_eq!(headroom(2.5, [0.0, 4.0], Some(1.0)), Some(0.5));
        assert_eq!(headroom(0.5, [0.0, 4.0], Some(1.0)), Some(0.5));
        assert_eq!(headroom(-1.0, [0.0, 4.0], Some(1.0)), Some(-1.0));
        assert_eq!(headroom(4.0, [2.0, 4.0], None), Some(0.0));
        assert_eq!(headroom(1.0, [0.0, 4.0], None), Some(0.75), "an error is best at zero");
        assert_eq!(headroom(1.0, [0.0, f64::INFINITY], None), None);
    }

    #[test]
    fn norms_of_a_constant_offset() {
        let x = [0.0, 1.0, 2.0, 4.0];
        let (r, s) = ([2.0; 4], [2.1; 4]);
        let c = compare_curves((&x, &s), (&x, &r), 0.0).unwrap();
        // Constant 5 % offset: both norms are 5 % whatever the spacing; 1e-12 is rounding.
        assert!((c.e2.unwrap() - 0.05).abs() < 1e-12 && (c.e_max.unwrap() - 0.05).abs() < 1e-12);
        assert_eq!(c.coverage, 1.0);
    }

    #[test]
    fn trapezoid_weights_count_uneven_stations_by_their_width() {
        // r = 1, s − r = (1, 0, 0) at x = 0, 1, 4: Σw d² = ½, Σw r² = 4, so e₂ = √(1/8).
        let x = [0.0, 1.0, 4.0];
        let c = compare_curves((&x, &[2.0, 1.0, 1.0]), (&x, &[1.0; 3]), 0.0).unwrap();
        assert!((c.e2.unwrap() - 0.125f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_short_model_is_not_extrapolated() {
        let reference: (Vec<f64>, Vec<f64>) = (0..=10).map(|i| (f64::from(i), 1.0)).unzip();
        let c = compare_curves((&[0.0, 5.0], &[1.0, 1.0]), (&reference.0, &reference.1), 0.0).unwrap();
        assert!((c.coverage - 6.0 / 11.0).abs() < 1e-12 && c.coverage < LEAST_COVERAGE);
        let apart = compare_curves((&[20.0, 30.0], &[1.0, 1.0]), (&reference.0, &reference.1), 0.0);
        assert_eq!(apart, Err(CurveError::NoOverlap));
    }

    #[test]
    fn below_the_floor_only_the_absolute_error_is_given() {
        let x = [0.0, 1.0];
        let c = compare_curves((&x, &[1e-9, 0.0]), (&x, &[0.0, 0.0]), 1e-6).unwrap();
        assert_eq!((c.e2, c.e_max, c.absolute), (None, None, 1e-9));
    }

    #[test]
    fn bad_points_are_named() {
        let x = [0.0, 1.0];
        let bad = compare_curves((&x, &[0.0, f64::NAN]), (&x, &x), 0.0);
        assert_eq!(bad, Err(CurveError::BadPoint { which: "model", index: 1 }));
        let folded = compare_curves((&x, &x), (&[1.0, 1.0], &x), 0.0);
        assert_eq!(folded, Err(CurveError::BadPoint { which: "reference", index: 1 }));
    }
}
