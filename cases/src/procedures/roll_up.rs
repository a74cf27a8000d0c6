//! A cantilever of bonds under the tip moment `2πEI/L`: it closes to a circle.
//!
//! The tip turns by 2π exactly, since each bond turns by `ML₀/EI`; the particles lie on a polygon instead of the circle, O(n⁻²) away.

use super::Setting;
use super::compared::{exact, plot, series, within};
use super::slender::Slender;
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::{CaseResult, Convergence, Role};
use std::f64::consts::TAU;

const SOURCE: &str = "pure bending of the elastica: curvature M/EI = 2π/L";
const LEVELS: [usize; 3] = [10, 20, 40];

/// Rotation of the tip and places of all particles at three levels.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let slender = Slender::new(setting)?;
    let mut error = Vec::new();
    let mut lines = Vec::new();
    let circle = |s: f64| ((TAU * s).sin() / TAU, (1.0 - (TAU * s).cos()) / TAU);
    for n in LEVELS {
        let u = slender.solve(setting, n, 2, TAU, &mut result.work)?;
        result.quantities.push(exact(
            [&format!("rotation-{n}"), &format!("Rotation of the tip, {n} bonds"), "rad"],
            u[3 * n + 2],
            TAU,
            1e-8,
            ["Exact for any number of bonds; Newton stops at changes of 1e-9.", SOURCE],
        ));
        let place = |p: usize| (p as f64 / n as f64 + u[3 * p], u[3 * p + 1]);
        let off = |p: usize| {
            let ((x, y), (a, b)) = (place(p), circle(p as f64 / n as f64));
            (x - a).hypot(y - b)
        };
        error.push((0..=n).map(off).fold(0.0, nan_max));
        lines.push(series(&format!("{n} bonds"), Role::Model, (0..=n).map(place)));
    }
    result.quantities.push(within(
        ["place", &format!("Largest distance of a particle from the circle, {} bonds", LEVELS[2]), "m"],
        error[2],
        [0.0, 1e-3],
        ["A polygon of n sides of the circle's length is about 0.8/n² away: 5e-4 for 40.", SOURCE],
    ));
    result.convergence.push(Convergence {
        id: "place".to_owned(),
        label: "largest distance of a particle from the circle".to_owned(),
        h: LEVELS.iter().map(|n| 1.0 / *n as f64).collect(),
        error,
        formal_order: 2.0,
        tolerance: Some(setting.number("tolerance")?),
    });
    lines.push(series("circle", Role::Reference, (0..=100).map(|k| circle(k as f64 / 100.0))));
    result.curves.push(plot(["shape", "The beam closes", "x / L (1)", "y / L (1)"], [false; 2], lines));
    Ok(())
}
