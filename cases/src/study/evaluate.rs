//! One run of one scene.

use crate::error::Result;
use crate::file::SceneFile;
use crate::model::{self, Built};
use crate::observe::curve::Curve;
use crate::observe::probes::{self, Reading};
use crate::scene::quantity::Zone;
use seam_solver::solve::statics::{self, Solution};
use seam_solver::work::Work;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::Instant;

/// A solved scene.
pub struct Solved {
    /// The model.
    pub built: Built,
    /// Its equilibrium.
    pub solution: Solution,
    /// What the probes read.
    pub readings: Readings,
    /// Wall time, in s.
    pub seconds: f64,
}

/// What the probes of a scene read.
#[derive(Debug, Clone, Default)]
pub struct Readings {
    by_probe: BTreeMap<String, Reading>,
}

impl Readings {
    /// Value of a scalar probe.
    pub fn scalar(&self, probe: &str) -> Option<f64> {
        match self.by_probe.get(probe) {
            Some(Reading::Scalar(value)) => Some(*value),
            _ => None,
        }
    }

    /// Curve of a line probe.
    pub fn curve(&self, probe: &str) -> Option<&Curve> {
        match self.by_probe.get(probe) {
            Some(Reading::Curve(curve)) => Some(curve),
            _ => None,
        }
    }

    /// All of them, by probe.
    pub fn iter(&self) -> impl Iterator<Item = (&String, &Reading)> {
        self.by_probe.iter()
    }
}

/// Adds up the work of all runs of a case, in any order.
#[derive(Default)]
pub struct Tally {
    work: Mutex<Work>,
}

impl Tally {
    fn add(&self, work: Work) {
        if let Ok(mut sum) = self.work.lock() {
            *sum += work;
        }
    }

    /// The sum.
    pub fn total(&self) -> Work {
        self.work.lock().map_or_else(|_| Work::default(), |work| *work)
    }
}

/// Builds, solves and reads a scene.
///
/// # Errors
/// A fault of the scene, or what the solver refuses.
pub fn solve(file: &SceneFile, tally: &Tally) -> Result<Solved> {
    let start = Instant::now();
    let built = model::build(file)?;
    let solution = statics::solve(&built.model).map_err(|e| file.solver(e))?;
    tally.add(solution.work);
    let by_probe = probes::read(file, &built.model, &solution)?;
    Ok(Solved { built, solution, readings: Readings { by_probe }, seconds: start.elapsed().as_secs_f64() })
}

/// Whether a station belongs to a zone: the boxes of bodies that have a `de` section, or everything.
pub fn inside(file: &SceneFile, zone: Zone) -> impl Fn(f64) -> bool + use<> {
    let intervals = de_intervals(file);
    move |x| zone == Zone::Whole || intervals.iter().any(|[low, high]| *low <= x && x <= *high)
}

/// Extent along x of the bodies that have a `de` section, whichever method is on, in m.
pub fn de_intervals(file: &SceneFile) -> Vec<[f64; 2]> {
    let bodies = file.scene.bodies.values().filter(|body| body.de.is_some());
    let boxes = bodies.filter_map(|body| body.cuboid.as_ref());
    let ends = |shape: &crate::scene::body::Cuboid| {
        Some([
            shape.min.first()?.value(&file.values, "").ok()?,
            shape.max.first()?.value(&file.values, "").ok()?,
        ])
    };
    boxes.filter_map(ends).collect()
}
