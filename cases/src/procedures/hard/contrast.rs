//! Stiffness or mass a million times larger or smaller on one side of the interface.
//!
//! The bound on the step must stay safe and tight, the tied velocities must agree, and an implicit run must keep its ties.

use super::super::Setting;
use super::bodies::{SPACES, Sandwich, scale};
use super::unrefused::Unrefused;
use crate::error::Result;
use crate::margin::Search;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use seam_solver::coupling::Method as Tying;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::solve::statics;
use seam_solver::work::Work;
use std::collections::BTreeMap;

const ROW: &str = "stiffness or mass contrast across the interface";
/// What the row of hard cases asks.
const NEEDED: f64 = 1e6;
/// Contrast at which implicit runs have to keep their energy: the row asks 1e6 of explicit runs; what implicit ones bear is measured.
const IMPLICIT: f64 = 1e4;
/// `‖Cv‖` over the velocities that it is the difference of.
const MISMATCH: f64 = 1e-10;
/// Change of the energy of an implicit run, relative.
const DRIFT: f64 = 1e-8;
/// Energy that no entry accounts for, over the largest one: rounding of some hundred steps, each beside forces of the stiff side.
const UNCLOSED: f64 = 1e-9;

/// Stiffer, softer, heavier and lighter particles between elements; both ties; explicit and implicit.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count("steps", 10)?;
    let search =
        Search { from: 1e4, to: setting.number("contrast_to")?, tolerance: setting.number("width")? };
    // What has to pass comes first: a search that begins where nobody doubts makes many runs.
    let from_needed = Search { from: NEEDED, ..search };
    let ties = [(Tying::Pointwise, "pointwise"), (Tying::Mortar, "mortar")];
    for (space, where_) in SPACES {
        for (tying, tie) in ties {
            let base = Sandwich::of(setting, space)?;
            let elements =
                if tying == Tying::Mortar { [base.rows - 1, base.rows + 1] } else { base.elements };
            let sandwich = Sandwich { tying, elements, ..base };
            for (kind, what) in [(0, "stiffer"), (1, "softer"), (2, "heavier"), (3, "lighter")] {
                let model = |factor: f64| -> seam_solver::error::Result<Model> {
                    let mut model = sandwich.cantilever(1.0)?;
                    let [k, m] =
                        [[factor, 1.0], [1.0 / factor, 1.0], [1.0, factor], [1.0, 1.0 / factor]][kind];
                    scale(&mut model, k, m);
                    Ok(model)
                };
                let work = &mut result.work;
                let found = from_needed.largest(|factor| {
                    let model = model(factor).map_err(|e| setting.solver(e))?;
                    // What the solver refuses does not pass, but it says so.
                    Ok(explicit(&model, steps, work).unwrap_or(false))
                })?;
                result.margins.push(found.margin(
                    [ROW, "the bound on the step is safe and within a factor of two, ‖Cv‖ is below 1e-10 and the ledger closes to 1e-9"],
                    [&format!("explicit-{what}-{tie}-{where_}"), &format!("{tie} ties, {where_}, explicit"), &format!("particles {what} than the elements")],
                    NEEDED,
                ));
                // Both margins ask of the same runs.
                let mut known: BTreeMap<u64, Kept> = BTreeMap::new();
                let mut kept = |factor: f64| -> Result<Kept> {
                    if let Some(kept) = known.get(&factor.to_bits()) {
                        return Ok(*kept);
                    }
                    let model = model(factor).map_err(|e| setting.solver(e))?;
                    let kept = implicit(&model, steps / 10, work).unwrap_or(Kept::NOTHING);
                    known.insert(factor.to_bits(), kept);
                    Ok(kept)
                };
                let label = format!("{tie} ties, {where_}, trapezoidal rule");
                let axis = format!("particles {what} than the elements");
                let ties = search.largest(|factor| Ok(kept(factor)?.ties <= MISMATCH))?;
                result.margins.push(ties.margin(
                    [ROW, "implicit steps keep ‖Bv‖ below 1e-10"],
                    [&format!("implicit-{what}-{tie}-{where_}"), &label, &axis],
                    NEEDED,
                ));
                let energy = search.largest(|factor| Ok(kept(factor)?.energy <= DRIFT))?;
                result.margins.push(energy.margin(
                    [ROW, "implicit steps keep their energy to 1e-8"],
                    [&format!("implicit-energy-{what}-{tie}-{where_}"), &label, &axis],
                    IMPLICIT,
                ));
            }
        }
    }
    Ok(())
}

/// Largest `|Σ c v|` over the largest `Σ |c v|`.
fn mismatch<'a>(rows: impl Iterator<Item = &'a [(usize, f64)]>, v: &[f64]) -> f64 {
    let (mut gap, mut size) = (0.0f64, 0.0f64);
    for row in rows {
        gap = gap.max(row.iter().map(|&(i, c)| c * v[i]).sum::<f64>().abs());
        size = size.max(row.iter().map(|&(i, c)| (c * v[i]).abs()).sum());
    }
    if size > 0.0 { gap / size } else { gap }
}

fn explicit(model: &Model, steps: usize, work: &mut Work) -> seam_solver::error::Result<bool> {
    let bound = critical::bound(model)?.step_s;
    let exact = Unrefused::new(model)?.critical_step(500);
    let rest = State::at_rest(Numbering::new(model).len());
    let mut run = Explicit::new(model, Options { step_s: bound, ..Options::default() }, &rest)?;
    run.advance(steps as u64)?;
    let seen = run.observe()?;
    *work += run.work();
    let apart = mismatch(run.system().rows.iter().map(|r| &r.terms[..]), &seen.state.v);
    Ok(bound <= exact && exact <= 2.0 * bound && apart <= MISMATCH && seen.ledger.closure() <= UNCLOSED)
}

/// What an implicit run keeps.
#[derive(Debug, Clone, Copy)]
struct Kept {
    /// `‖Bv‖` at the end, relative.
    ties: f64,
    /// Largest change of the energy, relative.
    energy: f64,
}

impl Kept {
    /// Of a run that was refused.
    const NOTHING: Self = Kept { ties: f64::INFINITY, energy: f64::INFINITY };
}

fn implicit(model: &Model, steps: usize, work: &mut Work) -> seam_solver::error::Result<Kept> {
    let system = Semidiscrete::new(model, work)?;
    let standing = statics::solve(model)?;
    let u: Vec<f64> = system.free.iter().map(|&i| standing.u[i]).collect();
    let v = vec![0.0; u.len()];
    let (mut motion, _) = start(&system, (u, v), 0.0, 0.0, 0.0, work)?;
    // Ten times what the elements bear: an implicit run is not for following light or stiff particles. In steps as short as theirs
    // the tied faces would hardly begin to move, and their velocities be rounding.
    let elements = model.parts.iter().filter(|part| matches!(part, Part::Continuum(_)));
    let step = 10.0 * critical::bound_of(elements)?.step_s;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
    let first = system.kinetic(&motion.v) + system.strain(&motion.u);
    let mut energy = 0.0;
    for _ in 0..steps {
        newmark.step(&mut motion, [0.0; 2], work)?;
        let now = system.kinetic(&motion.v) + system.strain(&motion.u);
        energy = nan_max(energy, (now / first - 1.0).abs());
    }
    Ok(Kept { ties: mismatch(system.rows.iter().map(|r| &r[..]), &motion.v), energy })
}
