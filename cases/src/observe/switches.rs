//! What the switches of a run did.

use crate::result::{Stages, SwitchRecord};
use crate::scene::probe::Read;
use seam_solver::model::{Model, Part};
use seam_solver::space::Vec3;
use seam_solver::transfer::report::{Balance, InterfaceForce, SwitchReport};

/// Switches of a run, with what their numbers are relative to.
#[derive(Debug, Clone, Default)]
pub struct Switches {
    /// Name of the body that came and report of each switch, in order.
    pub reports: Vec<(String, SwitchReport)>,
    /// Largest extent of the bodies, in m: lever of angular momentum.
    pub extent: f64,
    /// Share of the wall time.
    pub share_of_time: f64,
}

impl Switches {
    /// One number over the switches of a rule, or of all: the one farthest from zero. `None` where nothing was switched.
    pub fn read(&self, read: Read, rule: Option<&str>) -> Option<f64> {
        if read == Read::SwitchShareOfTime {
            return Some(self.share_of_time);
        }
        let own = self.reports.iter().filter(|(name, _)| rule.is_none_or(|rule| belongs(name, rule)));
        let values = own.map(|(_, report)| self.value(read, report));
        values.reduce(|a, b| if a.is_nan() || a.abs() >= b.abs() { a } else { b })
    }

    /// All switches, for the result.
    pub fn records(&self) -> Vec<SwitchRecord> {
        self.reports.iter().map(|(name, report)| self.record(name, report)).collect()
    }

    fn record(&self, name: &str, report: &SwitchReport) -> SwitchRecord {
        let stages = |of: fn(&Balance) -> f64| Stages {
            before: of(&report.before),
            mapped: of(&report.mapped),
            after: of(&report.after),
        };
        let largest = report.interface.iter().map(|f| f.before.norm()).fold(0.0, f64::max);
        let jump = |force: &InterfaceForce| {
            let jump = (force.after - force.before).norm();
            (force.face.clone(), if largest > 0.0 { jump / largest } else { 0.0 })
        };
        SwitchRecord {
            name: name.to_owned(),
            time_s: report.time,
            elements: report.elements,
            particles: report.particles,
            unbalanced: stages(|balance| balance.unbalanced),
            strain_energy: stages(|balance| balance.strain),
            kinetic_energy: stages(|balance| balance.kinetic),
            strain_energy_jump: report.strain_energy_jump(),
            momentum_jump: report.momentum_jump(),
            angular_momentum_jump: report.angular_momentum_jump(self.extent),
            reaction_jump: report.interface.iter().map(jump).collect(),
        }
    }

    fn value(&self, read: Read, report: &SwitchReport) -> f64 {
        match read {
            Read::SwitchEnergyJump => report.strain_energy_jump(),
            Read::SwitchMomentumJump => report.momentum_jump(),
            Read::SwitchAngularMomentumJump => report.angular_momentum_jump(self.extent),
            Read::SwitchReactionJump => report.reaction_jump(),
            Read::SwitchUnbalancedBefore => report.before.unbalanced,
            Read::SwitchUnbalancedAfter => report.after.unbalanced,
            Read::SwitchTime => report.time,
            _ => f64::NAN,
        }
    }
}

/// A rule that switches again adds a number to its name: `middle`, `middle-2`.
fn belongs(name: &str, rule: &str) -> bool {
    let number = name.strip_prefix(rule).and_then(|rest| rest.strip_prefix('-'));
    name == rule || number.is_some_and(|n| n.parse::<usize>().is_ok())
}

/// Largest side of the box around all bodies, in m.
pub fn extent(model: &Model) -> f64 {
    let positions = || model.parts.iter().flat_map(|part| part.positions());
    let low = positions().fold(Vec3::repeat(f64::INFINITY), |m, x| m.inf(x));
    let high = positions().fold(Vec3::repeat(f64::NEG_INFINITY), |m, x| m.sup(x));
    (high - low).amax()
}

/// Smallest and largest x of all particles, in m; `None` if there are none.
pub fn region_x(model: &Model) -> Option<[f64; 2]> {
    let discrete = model.parts.iter().filter(|part| matches!(part, Part::Discrete { .. }));
    let x = discrete.flat_map(|part| part.positions()).map(|x| x.x);
    x.fold(None, |range: Option<[f64; 2]>, x| {
        let [low, high] = range.unwrap_or([x, x]);
        Some([low.min(x), high.max(x)])
    })
}
