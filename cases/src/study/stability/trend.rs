//! Whether the energy of a run drifts: a line through the imbalance of its ledger, with its uncertainty.

use super::super::evaluate::Solved;
use crate::result::{CaseResult, Observation, Plot, Role, Series};

/// Half width of the accepted interval in standard errors of the slope: chance alone leaves it once in some hundred runs.
const ERRORS: f64 = 3.0;
/// A drift below this share of the energy over the run is none: what the hard case of a million steps asks.
const NONE: f64 = 1e-9;

/// Slope of a least-squares line and its standard error; `None` for fewer than three points.
pub fn slope(points: &[(f64, f64)]) -> Option<[f64; 2]> {
    let n = points.len() as f64;
    if points.len() < 3 {
        return None;
    }
    let mean = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let sxx: f64 = points.iter().map(|p| (p.0 - mean.0).powi(2)).sum();
    let sxy: f64 = points.iter().map(|p| (p.0 - mean.0) * (p.1 - mean.1)).sum();
    let slope = sxy / sxx;
    let rest: f64 = points.iter().map(|p| (p.1 - mean.1 - slope * (p.0 - mean.0)).powi(2)).sum();
    Some([slope, (rest / (n - 2.0) / sxx).sqrt()])
}

/// The drift of a relative energy over a run, from points `(t / end, energy)`; `None` for fewer than three.
pub fn observed(id: &str, label: &str, points: &[(f64, f64)]) -> Option<Observation> {
    let [drift, error] = slope(points)?;
    let half = (ERRORS * error).max(NONE);
    Some(Observation {
        id: id.to_owned(),
        label: label.to_owned(),
        unit: "1".to_owned(),
        value: drift,
        u_num: error,
        source: "slope of a least-squares line".to_owned(),
        accepted: Some([-half, half]),
        why:
            "Three standard errors of the slope, and no less than the 1e-9 that is asked of a million steps."
                .to_owned(),
        ..Observation::default()
    })
}

/// The drift of the ledger over a run as a quantity, and its course as a curve.
pub(super) fn measure(base: &Solved, result: &mut CaseResult) {
    let Some(course) = &base.course else { return };
    let largest = course
        .energies
        .iter()
        .flat_map(|(_, e)| [e.kinetic, e.strain, e.external])
        .fold(0.0f64, |m, e| m.max(e.abs()));
    let Some((end, _)) = course.energies.last().filter(|_| largest > 0.0) else { return };
    let points: Vec<(f64, f64)> =
        course.energies.iter().map(|(t, e)| (t / end, e.imbalance() / largest)).collect();
    let label =
        "Drift of the energy that the ledger does not account for, over the run and its largest energy";
    result.quantities.extend(observed("energy-trend", label, &points));
    let (x, y) = points.into_iter().unzip();
    result.curves.push(Plot {
        id: "energy-imbalance".to_owned(),
        title: "Energy that the ledger does not account for".to_owned(),
        x_label: "t / end (1)".to_owned(),
        y_label: "imbalance / largest energy (1)".to_owned(),
        series: vec![Series { name: "ledger".to_owned(), role: Role::Model, x, y }],
        ..Plot::default()
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_slope_and_noise_its_error() {
        let line: Vec<(f64, f64)> = (0..10).map(|k| (f64::from(k), 3.0 - 0.5 * f64::from(k))).collect();
        let [slope_of_line, error] = slope(&line).expect("ten points");
        assert!((slope_of_line + 0.5).abs() < 1e-14 && error < 1e-14);
        let noise: Vec<(f64, f64)> =
            (0..100).map(|k| (f64::from(k), (f64::from(k) * 12.9898).sin())).collect();
        let [drift, error] = slope(&noise).expect("a hundred points");
        assert!(drift.abs() < ERRORS * error, "{drift} {error}");
        // The same noise on a drift that is there.
        let drifting: Vec<(f64, f64)> = noise.iter().map(|(t, y)| (*t, y + 0.05 * t)).collect();
        let [drift, error] = slope(&drifting).expect("a hundred points");
        assert!(drift > ERRORS * error, "{drift} {error}");
        assert!(slope(&line[..2]).is_none());
    }
}
