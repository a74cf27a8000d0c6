//! Ties that say the same twice, and ties that nearly do.
//!
//! Redundant rows are named and change nothing. With `H = CM⁻¹Cᵀ` scaled to a unit diagonal, a row that repeats another up to a share δ
//! gives cond(H) ≈ 4/δ²: the tied velocities meet their bound, or the run is refused.

use super::super::compared::within;
use super::super::{Setting, rounding};
use super::bodies::{SPACES, Sandwich};
use crate::error::Result;
use crate::margin::Search;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use nalgebra::DMatrix;
use seam_solver::coupling::Row;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::interface::Interface;
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::dynamics::system::System;
use seam_solver::error::Result as Solved;
use seam_solver::model::{Model, Numbering};
use seam_solver::solve::statics;
use seam_solver::work::Work;

const ROW: &str = "redundant or nearly dependent constraints";
const MISMATCH: f64 = 1e-10;

/// Redundant rows in statics, explicit and implicit runs; nearly dependent ones up to what is refused.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count("steps", 10)?;
    for (space, id) in SPACES {
        let refuse = |e| setting.solver(e);
        let single = Sandwich::of(setting, space)?.cantilever(1.0).map_err(refuse)?;
        let mut double = single.clone();
        for tie in &single.ties {
            let mut again = tie.clone();
            again.name = format!("{} again", tie.name);
            double.ties.push(again);
        }
        let answers = |model: &Model, work: &mut Work| -> Solved<[Answer; 3]> {
            Ok([standing(model, work)?, explicit(model, steps, work)?, implicit(model, steps, work)?])
        };
        let once = answers(&single, &mut result.work).map_err(refuse)?;
        let twice = answers(&double, &mut result.work).map_err(refuse)?;
        for (one, two) in once.iter().zip(&twice) {
            let size = one.u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
            let change = one.u.iter().zip(&two.u).map(|(a, b)| (a - b).abs() / size).fold(0.0, nan_max);
            let why = "The rows that are left are the same up to their order: rounding of the solves.";
            let label = format!("Change of the answer when every tie is made twice, {}, {id}", one.name);
            result.quantities.push(rounding(
                &format!("redundant-{}-{id}", one.code),
                &label,
                change,
                1e-9,
                why,
                "the same model with each tie once",
            ));
            let named = two
                .notes
                .iter()
                .filter(|n| n.starts_with("dropped tie") && n.contains("follows from"))
                .count();
            let expected = two.rows as f64;
            let why = [
                "Each row that is said twice is dropped once, with a note that names it and what it follows from.",
                "the notes of the solver",
            ];
            let label =
                format!("Rows that are dropped by name when every tie is made twice, {}, {id}", one.name);
            result.quantities.push(within(
                [&format!("named-{}-{id}", one.code), &label, "1"],
                named as f64,
                [expected, expected],
                why,
            ));
        }
        nearly(setting, &single, id, result)?;
    }
    Ok(())
}

struct Answer {
    code: &'static str,
    name: &'static str,
    u: Vec<f64>,
    notes: Vec<String>,
    /// Rows that were kept.
    rows: usize,
}

fn standing(model: &Model, work: &mut Work) -> Solved<Answer> {
    let solution = statics::solve(model)?;
    *work += solution.work;
    let rows = solution.multipliers.len();
    Ok(Answer { code: "statics", name: "statics", u: solution.u, notes: solution.notes, rows })
}

fn explicit(model: &Model, steps: usize, work: &mut Work) -> Solved<Answer> {
    let rest = State::at_rest(Numbering::new(model).len());
    let step_s = 0.9 * critical::bound(model)?.step_s;
    let mut run = Explicit::new(model, Options { step_s, ..Options::default() }, &rest)?;
    run.advance(steps as u64)?;
    *work += run.work();
    let (notes, rows) = (run.system().notes.clone(), run.system().rows.len());
    Ok(Answer { code: "explicit", name: "explicit", u: run.u().to_vec(), notes, rows })
}

fn implicit(model: &Model, steps: usize, work: &mut Work) -> Solved<Answer> {
    let system = Semidiscrete::new(model, work)?;
    let step = 5.0 * critical::bound(model)?.step_s;
    let still = vec![0.0; system.mass.len()];
    let (mut motion, _) = start(&system, (still.clone(), still), 0.0, 1.0, 0.0, work)?;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
    for _ in 0..steps / 5 {
        newmark.step(&mut motion, [1.0; 2], work)?;
    }
    Ok(Answer {
        code: "implicit",
        name: "implicit",
        u: motion.u,
        notes: system.notes.clone(),
        rows: system.rows.len(),
    })
}

/// The first row again, less exact by a share: solved to its bound, or refused.
fn nearly(setting: &Setting, model: &Model, id: &str, result: &mut CaseResult) -> Result<()> {
    let refuse = |e| setting.solver(e);
    let base = System::new(model).map_err(refuse)?;
    let (mut silent, mut refused) = (0, 0);
    let mut condition = 0.0;
    let mut passes = |cond: f64| -> Result<bool> {
        let system = with_row(&base, 2.0 / cond.sqrt());
        let mut work = Work::default();
        let mut v: Vec<f64> = (0..system.mass.len()).map(|i| (i as f64 * 12.9898).sin()).collect();
        let before = v.clone();
        let mut impulse = vec![0.0; v.len()];
        let solved = Interface::new(&system, &mut work)
            .and_then(|i| i.project(&system, &mut v, &mut impulse, &mut work));
        result.work += work;
        if solved.is_err() {
            refused += 1;
            return Ok(false);
        }
        let size = system
            .rows
            .iter()
            .map(|r| r.terms.iter().map(|&(i, c)| (c * before[i]).abs()).sum::<f64>())
            .fold(0.0, f64::max);
        let gap = system
            .rows
            .iter()
            .map(|r| r.terms.iter().map(|&(i, c)| c * v[i]).sum::<f64>().abs())
            .fold(0.0, nan_max);
        let met = gap <= MISMATCH * size;
        silent += usize::from(!met);
        if met {
            condition = cond;
        }
        Ok(met)
    };
    let search =
        Search { from: 1e2, to: setting.number("condition_to")?, tolerance: setting.number("width")? };
    let found = search.largest(&mut passes)?;
    // Beyond the margin too, where a refusal is the right answer.
    for cond in [1e8, 1e10, 1e12, 1e14, 1e16, 1e18, 1e20] {
        passes(cond)?;
    }
    result.margins.push(found.margin(
        [ROW, "the tied velocities agree to 1e-10; beyond, the run is refused"],
        [&format!("condition-{id}"), &format!("interface problem, {id}"), "condition number of H"],
        1e12,
    ));
    let measured = condition_number(&with_row(&base, 2.0 / 1e6f64.sqrt()));
    let why = [
        "The margin's axis is the condition number only if 4/δ² is: checked where it can be measured.",
        "eigenvalues of H, unit diagonal",
    ];
    let label = format!("Measured condition number of H over the one that is asked for, 1e6, {id}");
    result.quantities.push(within(
        [&format!("condition-{id}"), &label, "1"],
        measured / 1e6,
        [0.2, 5.0],
        why,
    ));
    let why = "Either the bound is met or the run is refused.";
    let label =
        format!("Interface problems up to a condition of 1e20 that are neither met nor refused, {id}");
    result.quantities.push(rounding(
        &format!("silent-{id}"),
        &label,
        silent as f64,
        0.0,
        why,
        "the solver's own residual",
    ));
    result.notes.push(format!("{id}: {refused} interface problems were refused, the best that was met has a condition of {condition:.1e}"));
    Ok(())
}

/// The system with a copy of its first row in which one coefficient differs by a share of the row.
fn with_row(base: &System, share: f64) -> System {
    let mut system = base.clone();
    let mut row: Row = base.rows[0].clone();
    // The copy leans on the second row, with which it shares no unknown of its own.
    let lean: Vec<(usize, f64)> = base.rows[1].terms.iter().map(|&(i, c)| (i, share * c)).collect();
    row = Row::new([row.terms, lean].concat(), "nearly the first".to_owned(), row.position);
    // Without the second row itself the copy is independent of the first by that share alone.
    system.rows.remove(1);
    system.rows.push(row);
    system
}

/// Of `H = CM⁻¹Cᵀ` scaled to a unit diagonal.
fn condition_number(system: &System) -> f64 {
    let n = system.rows.len();
    let dot = |a: &Row, b: &Row| -> f64 {
        let b: std::collections::BTreeMap<usize, f64> = b.terms.iter().copied().collect();
        a.terms
            .iter()
            .filter(|(i, _)| !system.is_prescribed(*i))
            .filter_map(|(i, c)| Some(c * b.get(i)? / system.mass[*i]))
            .sum()
    };
    let h = DMatrix::from_fn(n, n, |r, c| dot(&system.rows[r], &system.rows[c]));
    let scaled = DMatrix::from_fn(n, n, |r, c| h[(r, c)] / (h[(r, r)] * h[(c, c)]).sqrt());
    let values = scaled.symmetric_eigenvalues();
    values.max() / values.min()
}
