//! A cantilever of bonds under a large tip force, against the elastica.
//!
//! Finite rotations; `EI = 1`, `L = 1`, and `EA` so large that it does not stretch. Mattiasson (1981) evaluated the elliptic
//! integrals of the inextensible beam to nine digits.

use super::Setting;
use super::compared::{exact, plot, series};
use super::slender::Slender;
use crate::error::Result;
use crate::result::{CaseResult, Convergence, Role};

const SOURCE: &str = "Mattiasson (1981), Int. J. Numer. Methods Eng. 17, table 1";
/// `PL²/EI`, deflection `w/L`, shortening `u/L`.
const TABLE: [(f64, f64, f64); 2] =
    [(1.0, 0.301_720_774, 0.056_433_236), (5.0, 0.713_791_524, 0.387_628_366)];
const LEVELS: [usize; 3] = [10, 20, 40];
const FINEST: usize = LEVELS[LEVELS.len() - 1];

/// Tip displacements of three levels for both forces.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let (slender, tolerance) = (Slender::new(setting)?, setting.number("tolerance")?);
    let mut lines = Vec::new();
    for (force, deflection, shortening) in TABLE {
        let table = [("deflection", "w/L", deflection), ("shortening", "u/L", shortening)];
        let mut tips = Vec::new();
        for n in LEVELS {
            let u = slender.solve(setting, n, 1, force, &mut result.work)?;
            tips.push([u[3 * n + 1], -u[3 * n]]);
            if n == FINEST {
                let places = (0..=n).map(|p| (p as f64 / n as f64 + u[3 * p], u[3 * p + 1]));
                lines.push(series(&format!("PL²/EI = {force}"), Role::Model, places));
                lines.push(series("tip, exact", Role::Data, [(1.0 - shortening, deflection)]));
            }
        }
        for (k, (id, symbol, value)) in table.into_iter().enumerate() {
            let id = format!("{id}-{force}");
            result.quantities.push(exact(
                [&id, &format!("{symbol} at PL²/EI = {force}, {FINEST} bonds"), "1"],
                tips[LEVELS.len() - 1][k],
                value,
                2e-3,
                ["Each bond is bent as a straight beam: O(n⁻²), which the order beside it judges; below 0.2 % on 40 bonds.", SOURCE],
            ));
            result.convergence.push(Convergence {
                id,
                label: format!("{symbol} of the elastica at PL²/EI = {force}"),
                h: LEVELS.iter().map(|n| 1.0 / *n as f64).collect(),
                error: tips.iter().map(|tip| (tip[k] / value - 1.0).abs()).collect(),
                formal_order: 2.0,
                tolerance: Some(tolerance),
            });
        }
    }
    result.curves.push(plot(["shape", "Bent cantilevers", "x / L (1)", "y / L (1)"], [false; 2], lines));
    Ok(())
}
