//! A bar under a sudden end load: the end moves as a triangle wave between zero and twice the static displacement,
//! period `4L/c`.

use super::compared::{exact, plot, series};
use super::elastic_bar::{Bar, Body};
use super::{Setting, rounding};
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::{CaseResult, Role};
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::model::{Numbering, PointValue};
use seam_solver::work::Work;

const SOURCE: &str = "sum of the reflections of a step of stress (Graff 1975, §2.2)";
/// Length of the run, in L/c: two periods and a little.
const END: f64 = 8.2;

/// Chain and elements at the exact step and at half of it.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let bar = Bar::new(setting)?;
    let force = setting.number("force_N")?;
    let statics = force * bar.length / (bar.young_pa * bar.section);
    let period = 4.0 * bar.length / bar.speed();
    let corners = [(0.0, 0.0), (2.0, 2.0), (4.0, 0.0), (6.0, 2.0), (8.0, 0.0)];
    let mut lines = vec![series("exact", Role::Reference, corners)];
    for mut body in bar.bodies().map_err(|e| setting.solver(e))? {
        pull(&mut body, force);
        for (share, id, words) in [(1.0, "exact-step", "cΔt/h = 1"), (0.5, "half-step", "cΔt/h = 0.5")] {
            let step = share * bar.exact_step(&body).map_err(|e| setting.solver(e))?;
            let end = END * bar.length / bar.speed();
            let history = record(&body, step, end, &mut result.work).map_err(|e| setting.solver(e))?;
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
                    "The corners are rounded over some n^⅓ of the 100 cells, and waves that trail the front ride on the flanks.",
                )
            };
            let triangle = |t: f64| {
                let phase = (4.0 * t / period).rem_euclid(4.0);
                statics * if phase < 2.0 { phase } else { 4.0 - phase }
            };
            let off = history.iter().map(|(t, u)| (u - triangle(*t)).abs()).fold(0.0, nan_max);
            result.quantities.push(rounding(
                &id("triangle"),
                &label("Largest deviation from the triangle wave over its height"),
                off / (2.0 * statics),
                tolerance,
                why,
                SOURCE,
            ));
            let before = |limit: f64| history.iter().filter(move |(t, _)| *t < limit);
            let peak = before(period).map(|(_, u)| *u).fold(f64::NEG_INFINITY, f64::max);
            result.quantities.push(exact(
                [&id("peak"), &label("Peak over the static displacement"), "1"],
                peak / statics,
                2.0,
                tolerance,
                [why, SOURCE],
            ));
            let names = [id("period"), label("Period")];
            let words_of = [names[0].as_str(), names[1].as_str(), "s"];
            let measured = upward(&history, statics);
            result.quantities.push(exact(words_of, measured, period, tolerance, [why, SOURCE]));
            let unit = |(t, u): &(f64, f64)| (t * bar.speed() / bar.length, u / statics);
            lines.push(series(&format!("{}, {words}", body.name), Role::Model, history.iter().map(unit)));
        }
    }
    let words = ["tip", "Displacement of the end", "ct / L (1)", "u / u_static (1)"];
    result.curves.push(plot(words, [false; 2], lines));
    Ok(())
}

/// Shares the force (N) among the points of the right end.
fn pull(body: &mut Body, force: f64) {
    let numbering = Numbering::new(&body.model);
    let value = force / body.right.len() as f64;
    for &unknown in &body.right {
        let (part, point, component) = numbering.locate(unknown);
        body.model.loads.push(PointValue { part, point, component, value });
    }
}

/// Displacement of the right end (m) over time (s).
fn record(
    body: &Body,
    step_s: f64,
    end: f64,
    work: &mut Work,
) -> seam_solver::error::Result<Vec<(f64, f64)>> {
    let initial = State::at_rest(Numbering::new(&body.model).len());
    let mut run = Explicit::new(&body.model, Options { step_s, ..Options::default() }, &initial)?;
    let mut history = Vec::new();
    while run.time() < end {
        let mean = body.right.iter().map(|&i| run.u()[i]).sum::<f64>() / body.right.len() as f64;
        history.push((run.time(), mean));
        run.advance(1)?;
    }
    *work += run.work();
    Ok(history)
}

/// Time between the first two upward passages of `level`; NaN if there are not two.
fn upward(history: &[(f64, f64)], level: f64) -> f64 {
    let passes = history.windows(2).filter(|w| w[0].1 < level && w[1].1 >= level);
    let times: Vec<f64> =
        passes.map(|w| w[0].0 + (w[1].0 - w[0].0) * (level - w[0].1) / (w[1].1 - w[0].1)).collect();
    if times.len() < 2 { f64::NAN } else { times[1] - times[0] }
}
