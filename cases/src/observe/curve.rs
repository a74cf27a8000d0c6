//! A value along a line, and its distance from a reference.

use crate::scene::quantity::Norm;

/// Stations with a reference below this share of the largest one say nothing about a relative error.
const SMALL: f64 = 0.05;

/// A value at stations along a line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Curve {
    /// Positions of the stations along x, in m.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

impl Curve {
    /// Distance from `reference`, given at the same stations, over those for which `inside(x)`;
    /// a fraction. `None` if the zone holds no station, or none with a reference to relate to.
    pub fn distance(&self, reference: &Curve, norm: Norm, inside: impl Fn(f64) -> bool) -> Option<f64> {
        if self.x.len() != reference.x.len() {
            return None;
        }
        let largest = reference.y.iter().fold(0.0f64, |m, r| m.max(r.abs()));
        if largest == 0.0 {
            return None;
        }
        let zone: Vec<(f64, f64)> =
            (0..self.x.len()).filter(|&i| inside(self.x[i])).map(|i| (self.y[i], reference.y[i])).collect();
        let pointwise = zone.iter().filter(|(_, r)| r.abs() >= SMALL * largest);
        match norm {
            Norm::Pointwise => pointwise.map(|(s, r)| (s - r).abs() / r.abs()).reduce(nan_max),
            Norm::Largest => zone.iter().map(|(s, r)| (s - r).abs() / largest).reduce(nan_max),
            Norm::Mean => {
                let whole: f64 = zone.iter().map(|(_, r)| r.abs()).sum();
                let miss: f64 = zone.iter().map(|(s, r)| (s - r) * r.signum()).sum();
                (whole > 0.0).then_some(miss / whole)
            }
        }
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
        Curve { x: vec![0.0, 1.0, 2.0, 3.0], y: y.to_vec() }
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
}
