//! One run at two rates, and what became of it: bounded, refused, stopped, or wrong without a word.

use crate::map::Cell;
use seam_solver::dynamics::multirate::side::Stepping;
use seam_solver::dynamics::multirate::{Method, Multirate, Rates};
use seam_solver::dynamics::newmark::start;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::Result;
use seam_solver::model::Model;
use seam_solver::solve::statics;
use seam_solver::work::Work;

/// Largest displacement of a bounded run over that of the static solution: a sudden load gives 2, modes that add up a little more.
const LARGEST: f64 = 10.0;

/// How a model is stepped.
#[derive(Debug, Clone, Copy)]
pub struct Setup {
    /// How the sides meet.
    pub method: Method,
    /// Scheme of the coarse side, parts 0 and 2.
    pub coarse: Stepping,
    /// Fine steps per coarse step.
    pub ratio: usize,
    /// δt of part 1, which is stepped explicitly, in s.
    pub fine_step: f64,
    /// Fine steps in all, rounded up to whole coarse steps.
    pub steps: usize,
}

/// Steps a loaded sandwich from rest under its sudden load.
///
/// # Errors
/// A model that is refused for itself.
pub fn fate(model: &Model, setup: Setup, work: &mut Work) -> Result<Cell> {
    let size =
        |u: &[f64]| u.iter().fold(0.0f64, |m, u| if u.is_nan() { f64::INFINITY } else { m.max(u.abs()) });
    let standing = statics::solve(model)?;
    *work += standing.work;
    let translations = size(&standing.u);
    let system = Semidiscrete::new(model, work)?;
    let still = vec![0.0; system.mass.len()];
    let (rest, lambda) = start(&system, (still.clone(), still), 0.0, 1.0, 0.0, work)?;
    let rates = Rates {
        method: setup.method,
        coarse_step: setup.fine_step * setup.ratio as f64,
        ratio: setup.ratio,
        coarse: setup.coarse,
        fine: Stepping::Explicit,
        fine_parts: vec![1],
    };
    let Ok(mut run) = Multirate::new(model, &system, &rates, (&rest, lambda), work) else {
        return Ok(Cell::Refused);
    };
    for _ in 0..setup.steps.div_ceil(setup.ratio) {
        if run.step(|_| 1.0, work).is_err() {
            return Ok(Cell::Stopped);
        }
        if size(&run.motion().u) > LARGEST * translations {
            return Ok(Cell::Silent);
        }
    }
    Ok(Cell::Bounded)
}
