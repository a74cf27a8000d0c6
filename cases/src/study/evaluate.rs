//! One run of one scene: an equilibrium, or a run in time.

use super::reference::Reference;
use crate::checkpoint::Checkpoints;
use crate::error::Result;
use crate::file::SceneFile;
use crate::model::{self, Built, time};
use crate::observe::crack::{self, Cracked};
use crate::observe::curve::Curve;
use crate::observe::field::Field;
use crate::observe::guard::Guard;
use crate::observe::history::{Histories, Recorder};
use crate::observe::probes::{Moment, Observer, Reading};
use crate::observe::supports::Supports;
use crate::observe::switches::{Switches, extent, region_x};
use crate::scene::cracking::Cracking;
use crate::scene::dynamics::Dynamics;
use crate::scene::probe::{Probe, Read, Where};
use crate::scene::quantity::{Norm, Quantity, Zone};
use seam_solver::contact::ContactEnergy;
use seam_solver::cracking::adaptive::Adaptive;
use seam_solver::dynamics::breaking::Loss;
use seam_solver::model::Numbering;
use seam_solver::simulation::{Energies, Outcome};
use seam_solver::solve::statics::{self, Solution};
use seam_solver::stage::{Stage, timed};
use seam_solver::work::Work;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::Instant;

/// A solved scene.
pub struct Solved {
    /// The model; after a run, as it is at the end.
    pub built: Built,
    /// Its equilibrium, or its state at the end of a run.
    pub solution: Solution,
    /// What the probes read.
    pub readings: Readings,
    /// How it moved; `None` in statics.
    pub course: Option<Course>,
    /// How it cracked; `None` where the scene has no `[cracking]`.
    pub cracked: Option<Cracked>,
    /// What was watched for effects that were left out.
    pub guard: Guard,
    /// Wall time, in s.
    pub seconds: f64,
}

/// How a scene moved.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// Time (s) and energies of each output.
    pub energies: Vec<(f64, Energies)>,
    /// The switches.
    pub switches: Switches,
    /// Bonds that lost stiffness, each time counted.
    pub losses: usize,
    /// Energies of the contacts at the end.
    pub contact: ContactEnergy,
}

impl Course {
    /// Time of the first switch, in s.
    pub fn first_switch(&self) -> Option<f64> {
        self.switches.reports.first().map(|(_, report)| report.time)
    }
}

/// What the probes of a scene read.
#[derive(Debug, Clone, Default)]
pub struct Readings {
    by_probe: BTreeMap<String, Reading>,
    first_switch: Option<f64>,
}

impl Readings {
    /// Time of the first switch, in s.
    pub fn first_switch(&self) -> Option<f64> {
        self.first_switch
    }

    /// The same with "after the switch" counted from another run's first switch, so that both are read over one zone.
    pub fn counted_from(self, first_switch: Option<f64>) -> Self {
        Self { first_switch, ..self }
    }

    /// What a quantity takes from its probe: a scalar, or one value of a history.
    pub fn value(&self, quantity: &Quantity) -> Option<f64> {
        match self.by_probe.get(&quantity.probe)? {
            Reading::Scalar(value) => Some(*value),
            Reading::Curve(curve) => curve.take(quantity.take.unwrap_or_default()),
        }
    }

    /// Value of a scalar probe.
    pub fn scalar(&self, probe: &str) -> Option<f64> {
        match self.by_probe.get(probe) {
            Some(Reading::Scalar(value)) => Some(*value),
            _ => None,
        }
    }

    /// Curve of a probe along a line or over time.
    pub fn curve(&self, probe: &str) -> Option<&Curve> {
        match self.by_probe.get(probe) {
            Some(Reading::Curve(curve)) => Some(curve),
            _ => None,
        }
    }

    /// What a probe read.
    pub fn reading(&self, probe: &str) -> Option<&Reading> {
        self.by_probe.get(probe)
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
    solve_with(file, tally, &Checkpoints::default(), |_| ())
}

/// The same with checkpoints of a run in time.
///
/// # Errors
/// As [`solve`]; a checkpoint that cannot be read, written or used.
pub fn solve_keeping(file: &SceneFile, tally: &Tally, checkpoints: &Checkpoints) -> Result<Solved> {
    solve_with(file, tally, checkpoints, |_| ())
}

/// The same with a change of the model between building and solving.
///
/// # Errors
/// As [`solve`].
pub fn solve_changed(file: &SceneFile, tally: &Tally, change: impl FnOnce(&mut Built)) -> Result<Solved> {
    solve_with(file, tally, &Checkpoints::default(), change)
}

fn solve_with(
    file: &SceneFile,
    tally: &Tally,
    checkpoints: &Checkpoints,
    change: impl FnOnce(&mut Built),
) -> Result<Solved> {
    let start = Instant::now();
    let mut built = model::build(file)?;
    change(&mut built);
    let mut solved = match (&file.scene.dynamics, &file.scene.cracking) {
        (Some(dynamics), _) => go(file, dynamics, built, (checkpoints, start))?,
        (None, Some(cracking)) => crack(file, cracking, built)?,
        (None, None) => stand(file, built)?,
    };
    tally.add(solved.solution.work);
    solved.seconds = start.elapsed().as_secs_f64();
    Ok(solved)
}

fn stand(file: &SceneFile, built: Built) -> Result<Solved> {
    let mut solution = statics::solve(&built.model).map_err(|e| file.solver(e))?;
    file.spoil_solution(&built.model, &mut solution);
    let mut supports = Supports::new(&built);
    supports.follow(&built.model, 0);
    let by_probe = read(file, &built, &solution, &supports, |_| true)?;
    let readings = Readings { by_probe, first_switch: None };
    let mut guard = Guard::new(file, &built)?;
    guard.watch(&built.model, &solution.u, solution.energy, [0.0, 1.0]).map_err(|e| file.solver(e))?;
    Ok(Solved { built, solution, readings, course: None, cracked: None, guard, seconds: 0.0 })
}

fn go(
    file: &SceneFile,
    dynamics: &Dynamics,
    mut built: Built,
    (checkpoints, start): (&Checkpoints, Instant),
) -> Result<Solved> {
    let mut recorder = Recorder::new(file, Supports::new(&built));
    let mut guard = Guard::new(file, &built)?;
    let checkpoint = checkpoints.kept(file)?.map(|kept| {
        recorder.histories = kept.histories;
        guard.seen = kept.seen;
        kept.run
    });
    let outcome = time::run(file, dynamics, &mut built, checkpoint.as_deref(), &mut |snapshot| {
        let state = snapshot.state;
        let (strain, now) = (snapshot.energies.strain, [state.time, snapshot.factor]);
        guard.watch(snapshot.model, &state.u, strain, now).map_err(|e| file.solver(e))?;
        guard.watch_ties(snapshot.model, &state.u, snapshot.widest_gap);
        if let Some(breaking) = snapshot.breaking {
            guard.watch_pairs(breaking.networks(), &Numbering::new(snapshot.model), &state.u, 1.0);
        }
        recorder.watch(snapshot)?;
        checkpoints.keep(file, (&recorder.histories, &guard), snapshot)
    })?;
    let Outcome { model, state, energies, switches, losses, contact, notes, work, switch_seconds, .. } =
        outcome;
    let now = [state.time, time::factor(file, dynamics)?.at(state.time)];
    guard.watch(&model, &state.u, energies.strain, now).map_err(|e| file.solver(e))?;
    let share_of_time = switch_seconds / start.elapsed().as_secs_f64();
    let switches = Switches { reports: switches, extent: extent(&model), share_of_time };
    built.model = model;
    let solution = Solution {
        numbering: Numbering::new(&built.model),
        u: state.u,
        reactions: std::mem::take(&mut recorder.histories.reactions),
        multipliers: Vec::new(),
        energy: energies.strain,
        // Each step has its own.
        residual: f64::NAN,
        work,
        notes,
    };
    let mut by_probe = read(file, &built, &solution, recorder.supports(), |probe| !probe.is_history())?;
    for (name, probe) in &file.scene.probes {
        let value = match probe.read.place() {
            Where::Switch => switches.read(probe.read, probe.switch.as_deref()),
            Where::End => region_x(&built.model)
                .map(|[low, high]| if probe.read == Read::RegionMinX { low } else { high }),
            _ => None,
        };
        by_probe.extend(value.map(|value| (name.clone(), Reading::Scalar(value))));
    }
    let peak = load_at_breaking(file, dynamics, &losses, crack::Recorder::new(&built.model).resultant)?;
    for (name, _) in file.scene.probes.iter().filter(|(_, probe)| probe.read == Read::PeakForce) {
        by_probe.extend(peak.map(|peak| (name.clone(), Reading::Scalar(peak))));
    }
    let Histories { curves, energies, .. } = recorder.histories;
    let curves = curves.into_iter().map(|(name, curve)| (name, Reading::Curve(curve)));
    by_probe.extend(curves);
    let course = Course { energies, switches, losses: losses.len(), contact };
    let readings = Readings { by_probe, first_switch: course.first_switch() };
    Ok(Solved { built, solution, readings, course: Some(course), cracked: None, guard, seconds: 0.0 })
}

/// Load (N) when half of the losses have happened; `None` without any.
fn load_at_breaking(
    file: &SceneFile,
    dynamics: &Dynamics,
    losses: &[Loss],
    resultant: f64,
) -> Result<Option<f64>> {
    let Some(middle) = losses.get(losses.len() / 2) else { return Ok(None) };
    Ok(Some(resultant * time::factor(file, dynamics)?.at(middle.time)))
}

/// Loads until bonds fail, one by one; the state is the last equilibrium there was: just after the last failure, or before it where
/// nothing held any more.
fn crack(file: &SceneFile, cracking: &Cracking, mut built: Built) -> Result<Solved> {
    let mut recorder = crack::Recorder::new(&built.model);
    let mut held = Supports::new(&built);
    let mut guard = Guard::new(file, &built)?;
    let mut watch = |path: &Adaptive| {
        recorder.watch(path);
        let (cracking, factor) = (path.cracking(), crack::factor(path));
        let strain =
            cracking.events().last().map_or(0.0, |e| 0.5 * e.force.max(e.force_after) * e.displacement);
        guard.watch_crack(cracking.model(), cracking.numbering(), cracking.displacements(), [factor, strain]);
    };
    let (model, u, reactions, (outcome, grown)) =
        model::cracking::run(file, cracking, &mut built, &mut watch, |path| {
            let factor = crack::factor(&path);
            let reactions = path.cracking().reactions().iter().map(|r| factor * r).collect();
            (path.cracking().model().clone(), crack::state(&path), reactions, path.outcome())
        })?;
    held.follow(&model, grown.len());
    built.model = model;
    let cracked = recorder.end(outcome, grown, built.calibration);
    let solution = Solution {
        numbering: Numbering::new(&built.model),
        u,
        reactions,
        multipliers: Vec::new(),
        energy: cracked.outcome.energies().strain,
        // Each event has its own.
        residual: f64::NAN,
        work: cracked.outcome.work,
        notes: [cracked.outcome.notes.clone(), cracked.notes()].concat(),
    };
    let mut by_probe = read(file, &built, &solution, &held, |_| true)?;
    for (name, probe) in &file.scene.probes {
        let limit = probe.up_to_m.as_ref().map(|n| n.value(&file.values, &format!("probes.{name}.up_to_m")));
        let limit = limit.transpose().map_err(|fault| file.error(fault))?;
        by_probe.extend(cracked.read(probe, limit).map(|reading| (name.clone(), reading)));
    }
    let readings = Readings { by_probe, first_switch: None };
    let factor = cracked.outcome.events.last().map_or(1.0, |e| e.factor);
    guard.watch(&built.model, &solution.u, solution.energy, [0.0, factor]).map_err(|e| file.solver(e))?;
    Ok(Solved { built, solution, readings, course: None, cracked: Some(cracked), guard, seconds: 0.0 })
}

/// Reads those probes off a state that a state alone can answer.
fn read(
    file: &SceneFile,
    built: &Built,
    solution: &Solution,
    supports: &Supports,
    wanted: impl Fn(&Probe) -> bool,
) -> Result<BTreeMap<String, Reading>> {
    timed(Stage::Output, || read_all(file, built, solution, supports, wanted))
}

fn read_all(
    file: &SceneFile,
    built: &Built,
    solution: &Solution,
    supports: &Supports,
    wanted: impl Fn(&Probe) -> bool,
) -> Result<BTreeMap<String, Reading>> {
    let field = Field::new(&built.model, &solution.u);
    let moment =
        Moment { field: Some(&field), strain: solution.energy, reactions: &solution.reactions, supports };
    let mut readings = BTreeMap::new();
    for (name, probe) in &file.scene.probes {
        let of_run = [Where::Run, Where::Switch, Where::End, Where::Crack].contains(&probe.read.place());
        if wanted(probe) && !of_run {
            let observer = Observer { file, moment: &moment, name, probe };
            readings.insert(name.clone(), observer.read()?);
        }
    }
    Ok(readings)
}

/// Distance of a probe's curve from its reference in a zone of space or time; `None` if the zone holds no station.
pub fn distance(
    file: &SceneFile,
    readings: &Readings,
    reference: &Reference,
    (probe, norm, zone): (&str, Norm, Zone),
) -> Option<f64> {
    let (own, (exact, _)) = (readings.curve(probe)?, reference.curves.get(probe)?);
    match zone {
        Zone::Whole => own.distance(exact, norm, |_| true),
        Zone::De => {
            let intervals = de_intervals(file);
            own.distance(exact, norm, |x| intervals.iter().any(|[low, high]| *low <= x && x <= *high))
        }
        Zone::AfterSwitch => {
            let switch = readings.first_switch?;
            own.distance(exact, norm, |t| t > switch)
        }
        Zone::End => {
            let end = own.last_shared(exact)?;
            own.distance(exact, norm, |t| t >= end)
        }
    }
}

/// Extent along x of the bodies that have a `de` section, whichever method is on, and of the boxes of switches, in m.
pub fn de_intervals(file: &SceneFile) -> Vec<[f64; 2]> {
    let bodies = file.scene.bodies.values().filter(|body| body.de.is_some());
    let boxes = bodies.filter_map(|body| body.cuboid.as_ref());
    let boxes = boxes.chain(file.scene.switches.values().filter_map(|switch| switch.cuboid.as_ref()));
    let ends = |shape: &crate::scene::body::Cuboid| {
        Some([
            shape.min.first()?.value(&file.values, "").ok()?,
            shape.max.first()?.value(&file.values, "").ok()?,
        ])
    };
    boxes.filter_map(ends).collect()
}
