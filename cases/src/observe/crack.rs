//! What a path of cracking tells: forces, energies, places, and pictures at several loads.

use super::curve::{Axis, Curve};
use super::probes::Reading;
use crate::scene::probe::{Probe, Read};
use seam_solver::cracking::adaptive::{Adaptive, Grown};
use seam_solver::cracking::{Event, Exchange, Outcome, envelope};
use seam_solver::model::{Model, Numbering};
use seam_solver::space::Vec3;
use seam_solver::work::Work;

/// Share of the first stiffness at which a picture is taken between the peak and the end.
const HALF_WAY: f64 = 0.25;

/// A model in a state, for a picture.
#[derive(Debug, Clone)]
pub struct Shot {
    /// Where on the path.
    pub title: String,
    /// The model, broken bonds without weight.
    pub model: Model,
    /// Displacements and rotations, in m and rad.
    pub u: Vec<f64>,
}

/// Watches a path.
#[derive(Debug, Default)]
pub struct Recorder {
    /// Resultant of the loads in N, or what stands for it; force and displacement relate to it.
    pub resultant: f64,
    came: Option<Shot>,
    peak: Option<(f64, Shot)>,
    half_way: Option<Shot>,
}

/// A path that has ended.
#[derive(Debug, Clone)]
pub struct Cracked {
    /// The path.
    pub outcome: Outcome,
    /// How the region of particles grew.
    pub grown: Vec<Grown>,
    /// As in [`Recorder`].
    pub resultant: f64,
    /// Pictures before the end.
    pub shots: Vec<Shot>,
    /// Work of calibrating the bonds.
    pub calibration: Work,
}

impl Recorder {
    /// For a model whose loads add up to a force, or whose supports move: then the largest of them stands for the displacement.
    pub fn new(model: &Model) -> Self {
        let mut sum = Vec3::zeros();
        for load in model.loads.iter().filter(|l| l.component < model.space.dim()) {
            sum[load.component] += load.value;
        }
        let moved = model.supports.iter().map(|s| s.value.abs()).fold(0.0, f64::max);
        let resultant = if moved > 0.0 { 1.0 / moved } else { sum.norm() };
        // Loads that cancel have no resultant: force is then the load factor.
        Recorder { resultant: if resultant > 0.0 { resultant } else { 1.0 }, ..Recorder::default() }
    }

    /// Looks at a path before its first event and after every one.
    pub fn watch(&mut self, path: &Adaptive) {
        let cracking = path.cracking();
        let Some(last) = cracking.events().last() else { return };
        let force = last.force * self.resultant;
        if self.came.is_none() && !path.grown().is_empty() {
            self.came = Some(shot(path, format!("Just after the first failure, at {force:.4e} N")));
        }
        if self.peak.as_ref().is_none_or(|(highest, _)| force > *highest) {
            self.peak = Some((force, shot(path, format!("Just after the peak of {force:.4e} N"))));
        }
        let share = cracking.stiffness() / cracking.first_stiffness();
        if self.half_way.is_none() && share < HALF_WAY {
            let title = format!("With {:.0} % of the stiffness left, at {force:.4e} N", 100.0 * share);
            self.half_way = Some(shot(path, title));
        }
    }

    /// The end of a path.
    pub fn end(self, outcome: Outcome, grown: Vec<Grown>, calibration: Work) -> Cracked {
        let peak = self.peak.map(|(_, shot)| shot);
        // Where the first failure is the peak, one picture is enough.
        let came = self.came.filter(|came| peak.as_ref().is_none_or(|peak| peak.u != came.u));
        let shots = [came, peak, self.half_way];
        let shots = shots.into_iter().flatten().collect();
        Cracked { outcome, grown, resultant: self.resultant, shots, calibration }
    }
}

fn shot(path: &Adaptive, title: String) -> Shot {
    Shot { title, model: path.cracking().model().clone(), u: state(path) }
}

/// Load factor just after the last event, at its displacement; one before the first event.
pub fn factor(path: &Adaptive) -> f64 {
    let cracking = path.cracking();
    cracking.events().last().map_or(1.0, |e| e.displacement / cracking.displacement())
}

/// Displacements and rotations at [`factor`].
pub fn state(path: &Adaptive) -> Vec<f64> {
    let factor = factor(path);
    path.cracking().displacements().iter().map(|u| factor * u).collect()
}

impl Shot {
    /// Where its unknowns are.
    pub fn numbering(&self) -> Numbering {
        Numbering::new(&self.model)
    }
}

impl Cracked {
    /// What a probe reads; `limit` is its displacement, in m. `None` where there is nothing to read.
    pub fn read(&self, probe: &Probe, limit: Option<f64>) -> Option<Reading> {
        let outcome = &self.outcome;
        let scalar = |value: f64| Some(Reading::Scalar(value));
        match probe.read {
            Read::PeakForce => outcome.peak().and_then(|[_, force]| scalar(force * self.resultant)),
            Read::PeakDisplacement => outcome.peak().and_then(|[q, _]| scalar(q / self.resultant)),
            Read::FirstStiffness => scalar(outcome.first_stiffness * self.resultant.powi(2)),
            Read::EnvelopeWork => scalar(self.work_up_to(limit? * self.resultant)),
            Read::FractureEnergy => scalar(outcome.energies().fracture),
            Read::RadiatedEnergy => scalar(outcome.energies().radiated),
            Read::PathClosure => scalar(outcome.energies().closure()),
            Read::FailureClosure => scalar(self.worst_failure()),
            Read::Failures => scalar(outcome.events.len() as f64),
            Read::TornOff => scalar(outcome.torn_off.len() as f64),
            Read::Growths => scalar(self.grown.len() as f64),
            Read::GrowthJump => {
                let jumps = self.grown.iter().map(|g| g.exchange.jump());
                scalar(jumps.reduce(|a, b| if a.abs() >= b.abs() { a } else { b }).unwrap_or(0.0))
            }
            Read::CountedWork => scalar((outcome.work.total() + self.calibration.total()) as f64),
            Read::ForceDisplacement => Some(Reading::Curve(self.envelope())),
            Read::CrackPath => Some(Reading::Curve(self.places())),
            _ => None,
        }
    }

    /// How it ended, and how the region grew, in words.
    pub fn notes(&self) -> Vec<String> {
        let end =
            format!("the path ended after {} failures: {:?}", self.outcome.events.len(), self.outcome.stop);
        let of = |(k, g): (usize, &Grown)| {
            let Exchange { after_events, force, .. } = g.exchange;
            format!(
                "growth {} after {after_events} failures, at {:.4e} N: {} particles from ({:.4}, {:.4}) to ({:.4}, {:.4}) m; force, \
                 stiffness and energy at held displacement {:+.2} %",
                k + 1,
                force[0] * self.resultant,
                g.particles,
                g.block.min.x,
                g.block.min.y,
                g.block.max.x,
                g.block.max.y,
                100.0 * g.exchange.jump()
            )
        };
        self.grown.iter().enumerate().map(of).chain([end]).collect()
    }

    /// Load at which the first particles came, over that of the first failure after it; `None` where particles came otherwise. Above one
    /// the criterion was met too late: bonds would have failed before, and the path had to step back.
    pub fn lateness(&self) -> Option<f64> {
        let first = self.grown.first().filter(|grown| grown.exchange.after_events == 0)?;
        let failure = self.outcome.events.first()?;
        (failure.force > 0.0).then(|| first.exchange.force[0] / failure.force)
    }

    /// Force (N) against displacement (m) under displacement control.
    pub fn envelope(&self) -> Curve {
        let corners = envelope(&self.outcome.events);
        self.in_units(&corners)
    }

    /// Force (N) against displacement (m) along the path, snap-back and all.
    pub fn path(&self) -> Curve {
        let ends = self
            .outcome
            .events
            .iter()
            .flat_map(|e| [[e.displacement, e.force], [e.displacement, e.force_after]]);
        self.in_units(&[[0.0, 0.0]].into_iter().chain(ends).collect::<Vec<_>>())
    }

    fn in_units(&self, corners: &[[f64; 2]]) -> Curve {
        Curve {
            axis: Axis::Displacement,
            x: corners.iter().map(|c| c[0] / self.resultant).collect(),
            y: corners.iter().map(|c| c[1] * self.resultant).collect(),
        }
    }

    /// Middles of the bonds that broke, lowest first.
    fn places(&self) -> Curve {
        let broken = self.outcome.events.iter().flat_map(|e| e.places.iter().zip(&e.integrity));
        let mut places: Vec<Vec3> = broken.filter(|(_, g)| **g == 0.0).map(|(x, _)| *x).collect();
        places.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)));
        Curve {
            axis: Axis::Places,
            x: places.iter().map(|x| x.x).collect(),
            y: places.iter().map(|x| x.y).collect(),
        }
    }

    /// `∫F dq` along the envelope, beyond its end along the last ray.
    fn work_up_to(&self, limit: f64) -> f64 {
        let mut corners = envelope(&self.outcome.events);
        if let Some(&[q, force]) = corners.last().filter(|c| c[0] > 0.0) {
            corners.push([f64::max(limit, q), force / q * f64::max(limit, q)]);
        }
        let mut work = 0.0;
        for pair in corners.windows(2) {
            let ([q0, f0], [q1, f1]) = (pair[0], pair[1]);
            let end = q1.min(limit);
            if end > q0 {
                let force = f0 + (f1 - f0) * (end - q0) / (q1 - q0);
                work += 0.5 * (f0 + force) * (end - q0);
            }
        }
        work
    }

    /// What a failure leaves unaccounted for, over the strain energy before it: the largest.
    fn worst_failure(&self) -> f64 {
        let of = |e: &Event| {
            let gap = (e.energy_released - e.fracture_energy - e.radiated_energy).abs();
            let before = 0.5 * e.force * e.displacement;
            if before > 0.0 { gap / before } else { gap }
        };
        self.outcome.events.iter().map(of).fold(0.0, f64::max)
    }
}
