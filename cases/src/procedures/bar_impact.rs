//! A bar that flies into a rigid wall: the wall feels `σ = ρ c v₀` for `2L/c`, then the bar would fly back.
//!
//! At `cΔt/h = 1` central differences solve the wave equation exactly; at half of it the front is smeared over a few
//! cells. The bar is held at the wall, so that after contact the reaction pulls: its change of sign ends the contact.

use super::compared::{exact, plot, series};
use super::elastic_bar::{Bar, Body};
use super::{Setting, rounding};
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::{CaseResult, Role};
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::model::Numbering;
use seam_solver::work::Work;

const SOURCE: &str = "d'Alembert: σ = ρcv₀ until the wave is back, 2L/c (Graff 1975, §2.1)";
/// Largest time, in L/c.
const END: f64 = 3.0;

/// Chain and elements at the exact step and at half of it.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let bar = Bar::new(setting)?;
    let v0 = setting.number("v0_m_s")?;
    let stress = bar.density * bar.speed() * v0;
    let contact = 2.0 * bar.length / bar.speed();
    let ideal = [(0.0, 1.0), (2.0, 1.0), (2.0, -1.0), (END, -1.0)];
    let mut lines = vec![series("exact", Role::Reference, ideal)];
    for body in bar.bodies().map_err(|e| setting.solver(e))? {
        for (share, id, words) in [(1.0, "exact-step", "cΔt/h = 1"), (0.5, "half-step", "cΔt/h = 0.5")] {
            let step = share * bar.exact_step(&body).map_err(|e| setting.solver(e))?;
            let history = impact(&bar, &body, v0, step, &mut result.work).map_err(|e| setting.solver(e))?;
            let id = |what: &str| format!("{what}-{}-{id}", body.id);
            let label = |what: &str| format!("{what}, {}, {words}", body.name);
            let (tolerance, why) = if share == 1.0 {
                (
                    1e-8,
                    "Central differences are exact at this step; the shortest wave feels the square root of its rounding.",
                )
            } else {
                (
                    0.02,
                    "The front is smeared over some n^⅓ of the 100 cells on its way to and fro, which the zero and the mean feel.",
                )
            };
            // A step holds each of the two jumps.
            let between = |t: f64| 0.5 * step < t && t < contact - 0.5 * step;
            let plateau: Vec<f64> = history.iter().filter(|(t, _)| between(*t)).map(|(_, s)| *s).collect();
            if share == 1.0 {
                let off = plateau.iter().map(|s| (s / stress - 1.0).abs()).fold(0.0, nan_max);
                let label = label("Largest deviation of the wall stress from ρcv₀");
                result.quantities.push(rounding(&id("plateau"), &label, off, tolerance, why, SOURCE));
            }
            let mean = plateau.iter().sum::<f64>() / plateau.len() as f64;
            result.quantities.push(exact(
                [&id("stress"), &label("Mean wall stress"), "Pa"],
                mean,
                stress,
                tolerance,
                [why, SOURCE],
            ));
            result.quantities.push(exact(
                [&id("contact"), &label("Contact time"), "s"],
                sign_change(&history),
                contact,
                tolerance,
                [why, SOURCE],
            ));
            let unit = |(t, s): &(f64, f64)| (t * bar.speed() / bar.length, s / stress);
            lines.push(series(&format!("{}, {words}", body.name), Role::Model, history.iter().map(unit)));
        }
    }
    let words = ["wall-stress", "Stress on the wall", "ct / L (1)", "σ / ρcv₀ (1)"];
    result.curves.push(plot(words, [false; 2], lines));
    Ok(())
}

/// Compressive stress on the wall (Pa) over time (s).
fn impact(
    bar: &Bar,
    body: &Body,
    v0: f64,
    step_s: f64,
    work: &mut Work,
) -> seam_solver::error::Result<Vec<(f64, f64)>> {
    let mut initial = State::at_rest(Numbering::new(&body.model).len());
    body.free.iter().for_each(|&i| initial.v[i] = -v0);
    let mut run = Explicit::new(&body.model, Options { step_s, ..Options::default() }, &initial)?;
    let mut history = Vec::new();
    while run.time() < END * bar.length / bar.speed() {
        let seen = run.observe()?;
        let push: f64 = body.left.iter().map(|&i| seen.reactions[i]).sum();
        history.push((run.time(), push / bar.section));
        run.advance(1)?;
    }
    *work += run.work();
    Ok(history)
}

/// First time at which a positive signal becomes negative, by a straight line; NaN if it never does.
fn sign_change(history: &[(f64, f64)]) -> f64 {
    let pushed = history.iter().position(|(_, s)| *s > 0.0).unwrap_or(history.len());
    let turns = history[pushed..].windows(2).find(|w| w[1].1 < 0.0);
    turns.map_or(f64::NAN, |w| w[0].0 + (w[1].0 - w[0].0) * w[0].1 / (w[0].1 - w[1].1))
}
