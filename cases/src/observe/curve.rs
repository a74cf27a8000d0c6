//! A value along a line or over time, and its distance from a reference.

use crate::scene::quantity::{Norm, Take};
use serde::{Deserialize, Serialize};

/// Stations with a reference below this share of the largest one say nothing about a relative error.
const SMALL: f64 = 0.05;
/// A station counts as inside within this share of the range: sums of time steps round.
const ROUNDING: f64 = 1e-9;

/// What a curve runs along.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// A line through the bodies, in m.
    #[default]
    Position,
    /// Time, in s.
    Time,
    /// Displacement of the load, in m.
    Displacement,
    /// None: places in the x–y plane, in m.
    Places,
}

impl Axis {
    /// Name and unit.
    pub fn label(self) -> &'static str {
        match self {
            Self::Position => "x (m)",
            Self::Time => "Time t (s)",
            Self::Displacement => "displacement (m)",
            Self::Places => "x (m)",
        }
    }
}

/// A value at stations.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// What it runs along.
    pub axis: Axis,
    /// Stations: positions along x in m, or times in s.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

impl Curve {
    /// A history without values yet.
    pub fn history() -> Self {
        Self { axis: Axis::Time, ..Self::default() }
    }

    /// One value of a history; `None` for a curve along a line, or an empty one.
    pub fn take(&self, take: Take) -> Option<f64> {
        if self.axis != Axis::Time {
            return None;
        }
        let values = self.y.iter().copied();
        match take {
            Take::End => self.y.last().copied(),
            Take::Largest => values.reduce(nan_max),
            Take::Smallest => values.map(|y| -y).reduce(nan_max).map(|y| -y),
            Take::LargestMagnitude => {
                values.reduce(|a, b| if a.is_nan() || a.abs() >= b.abs() { a } else { b })
            }
        }
    }

    /// Linear in between; `None` outside.
    pub fn at(&self, x: f64) -> Option<f64> {
        let (first, last) = (*self.x.first()?, *self.x.last()?);
        let margin = ROUNDING * (last - first);
        if !(first - margin <= x && x <= last + margin) {
            return None;
        }
        match self.x.partition_point(|s| *s <= x) {
            0 => self.y.first().copied(),
            after if after == self.x.len() => self.y.last().copied(),
            after => {
                let (x0, x1) = (self.x[after - 1], self.x[after]);
                Some(self.y[after - 1] + (self.y[after] - self.y[after - 1]) * (x - x0) / (x1 - x0))
            }
        }
    }

    /// Last station of `other` that lies inside of this curve.
    pub fn last_shared(&self, other: &Curve) -> Option<f64> {
        other.x.iter().rev().copied().find(|x| self.at(*x).is_some())
    }

    /// `(station, own value, reference value)`: lines have the same stations; histories are read at the reference's
    /// times, as far as they overlap.
    fn beside(&self, reference: &Curve) -> Vec<[f64; 3]> {
        let theirs = reference.x.iter().zip(&reference.y);
        match self.axis {
            Axis::Time | Axis::Displacement => {
                theirs.filter_map(|(&x, &r)| Some([x, self.at(x)?, r])).collect()
            }
            Axis::Places => Vec::new(),
            Axis::Position if self.x.len() == reference.x.len() => {
                self.y.iter().zip(theirs).map(|(&s, (&x, &r))| [x, s, r]).collect()
            }
            Axis::Position => Vec::new(),
        }
    }

    /// Distance from `reference` over those of its stations for which `inside(x)`; a fraction. `None` if the zone
    /// holds no station, or none with a reference to relate to.
    pub fn distance(&self, reference: &Curve, norm: Norm, inside: impl Fn(f64) -> bool) -> Option<f64> {
        if norm == Norm::Hausdorff {
            return self.hausdorff(reference);
        }
        let largest = reference.y.iter().fold(0.0f64, |m, r| m.max(r.abs()));
        if largest == 0.0 {
            return None;
        }
        let beside = self.beside(reference).into_iter();
        let zone: Vec<(f64, f64)> = beside.filter(|[x, ..]| inside(*x)).map(|[_, s, r]| (s, r)).collect();
        let pointwise = zone.iter().filter(|(_, r)| r.abs() >= SMALL * largest);
        match norm {
            Norm::Pointwise => pointwise.map(|(s, r)| (s - r).abs() / r.abs()).reduce(nan_max),
            Norm::Largest => zone.iter().map(|(s, r)| (s - r).abs() / largest).reduce(nan_max),
            Norm::Mean => {
                let whole: f64 = zone.iter().map(|(_, r)| r.abs()).sum();
                let miss: f64 = zone.iter().map(|(s, r)| (s - r) * r.signum()).sum();
                (whole > 0.0).then_some(miss / whole)
            }
            Norm::Hausdorff => None,
        }
    }

    /// Largest distance of a place of either from the nearest one of the other, in m; `None` if one has none.
    fn hausdorff(&self, other: &Curve) -> Option<f64> {
        let places = |c: &Curve| c.x.iter().copied().zip(c.y.iter().copied()).collect::<Vec<_>>();
        let (own, theirs) = (places(self), places(other));
        let farthest = |from: &[(f64, f64)], to: &[(f64, f64)]| {
            let nearest = |a: &(f64, f64)| to.iter().map(|b| (a.0 - b.0).hypot(a.1 - b.1)).reduce(f64::min);
            from.iter().map(nearest).try_fold(0.0, |m, d| Some(nan_max(m, d?)))
        };
        if own.is_empty() || theirs.is_empty() {
            return None;
        }
        Some(nan_max(farthest(&own, &theirs)?, farthest(&theirs, &own)?))
    }
}

/// The larger one; NaN if either is, so that it cannot hide.
pub fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(y: [f64; 4]) -> Curve {
        Curve { x: vec![0.0, 1.0, 2.0, 3.0], y: y.to_vec(), ..Curve::default() }
    }

    #[test]
    fn norms_follow_their_definitions() {
        let reference = curve([0.0, -1.0, -2.0, -4.0]);
        let model = curve([0.1, -1.1, -2.0, -3.8]);
        let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-14;
        assert!(close(model.distance(&reference, Norm::Pointwise, |_| true), 0.1));
        assert!(close(model.distance(&reference, Norm::Largest, |_| true), 0.05));
        assert!(close(model.distance(&reference, Norm::Largest, |x| x < 2.5), 0.025));
        // 0.1 too large at the first two stations, 0.2 too small at the last.
        assert!(close(model.distance(&reference, Norm::Mean, |_| true), 0.0));
        assert!(close(model.distance(&reference, Norm::Mean, |x| x > 1.5), -0.2 / 6.0));
        assert_eq!(model.distance(&reference, Norm::Largest, |x| x > 9.0), None);
        assert_eq!(model.distance(&curve([0.0; 4]), Norm::Largest, |_| true), None);
        assert!(curve([f64::NAN; 4]).distance(&reference, Norm::Largest, |_| true).unwrap().is_nan());
    }

    #[test]
    fn the_distance_of_places_is_hausdorffs() {
        let places = |x: &[f64], y: &[f64]| Curve { axis: Axis::Places, x: x.to_vec(), y: y.to_vec() };
        let straight = places(&[0.0, 0.0, 0.0], &[0.0, 1.0, 2.0]);
        // One place strays to the side, and the end is missing: the larger of both, from either side.
        let strayed = places(&[0.0, 0.3], &[0.0, 1.0]);
        let far = 1f64.hypot(0.3);
        assert_eq!(strayed.distance(&straight, Norm::Hausdorff, |_| true), Some(far));
        assert_eq!(straight.distance(&strayed, Norm::Hausdorff, |_| true), Some(far));
        assert_eq!(straight.distance(&places(&[], &[]), Norm::Hausdorff, |_| true), None);
    }

    fn history(x: &[f64], y: &[f64]) -> Curve {
        Curve { axis: Axis::Time, x: x.to_vec(), y: y.to_vec() }
    }

    #[test]
    fn histories_are_compared_at_the_times_of_the_reference_inside_the_overlap() {
        let reference = history(&[0.0, 1.0, 2.0, 3.0], &[0.0, -1.0, -2.0, -8.0]);
        // Other steps, and an end before the reference's last station.
        let model = history(&[0.0, 1.5, 2.5], &[0.0, -1.5, -2.5]);
        assert_eq!(model.distance(&reference, Norm::Largest, |_| true), Some(0.0));
        assert_eq!(model.last_shared(&reference), Some(2.0));
        assert_eq!(model.at(2.6), None);
        assert_eq!(model.at(-0.1), None);
        assert_eq!(model.at(2.5 + 1e-12), Some(-2.5));
    }

    #[test]
    fn a_history_gives_one_of_its_values() {
        let swing = history(&[0.0, 1.0, 2.0, 3.0], &[0.0, 2.0, -3.0, 1.0]);
        let of = |take| swing.take(take).unwrap();
        assert_eq!([of(Take::End), of(Take::Largest), of(Take::Smallest)], [1.0, 2.0, -3.0]);
        assert_eq!(of(Take::LargestMagnitude), -3.0);
        assert!(history(&[0.0, 1.0], &[f64::NAN, 1.0]).take(Take::LargestMagnitude).unwrap().is_nan());
        assert_eq!(curve([1.0; 4]).take(Take::End), None);
    }
}
