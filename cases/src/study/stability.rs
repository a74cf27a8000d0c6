//! How far a scene is from instability: how many digits survive rounding, how long a step may be, whether energy drifts.
//!
//! A hard case is run as it is: its procedure measures its margins.

mod rounding;
pub(crate) mod trend;

use super::evaluate::{self, Readings, Solved, Tally};
use super::kept::Kept;
use super::{Onlooker, head};
use crate::error::Result;
use crate::file::SceneFile;
use crate::margin::{Margin, Search};
use crate::observe::curve::nan_max;
use crate::observe::probes::Reading;
use crate::overrides::Override;
use crate::procedures;
use crate::result::CaseResult;
use crate::scene::Tier;
use crate::scene::dynamics::Stepping;

/// A reading of a run with a longer step may be this far from that of the scene itself, over its largest magnitude.
const ALIKE: f64 = 0.05;
/// The longest step that is asked for, over the scene's.
const LONGEST: f64 = 64.0;

/// A study of one scene.
pub struct StabilityStudy<'a> {
    file: &'a SceneFile,
    tier: Tier,
}

impl<'a> StabilityStudy<'a> {
    /// A study of a scene.
    pub fn new(file: &'a SceneFile, tier: Tier) -> Self {
        Self { file, tier }
    }

    /// Runs the study; one that is finished is kept.
    ///
    /// # Errors
    /// A scene that cannot run; a result that cannot be kept.
    pub fn run(&self, onlooker: &dyn Onlooker, kept: &Kept) -> Result<CaseResult> {
        let id = &self.file.scene.id;
        onlooker.begin(id);
        let mut failure = None;
        let key = format!("{}-{}", self.tier.name(), &self.file.hash()[..32]);
        let make = || self.measure().map_err(|error| failure = Some(error)).ok();
        let (found, was_kept) = kept.part(&key, make)?;
        match (found, failure) {
            (Some(result), _) => {
                onlooker
                    .done(id, &if was_kept { "kept".to_owned() } else { format!("{:.1} s", result.seconds) });
                Ok(result)
            }
            (None, Some(error)) => {
                onlooker.done(id, "failed");
                Err(error)
            }
            // A failure that was kept: run it for its reason.
            (None, None) => self.measure(),
        }
    }

    fn measure(&self) -> Result<CaseResult> {
        let mut result = match self.file.scene.procedure.as_str() {
            "statics" => self.scene()?,
            _ => procedures::run(self.file, self.tier)?.result,
        };
        result.command = result.command.replacen("seam run", "seam study stability", 1);
        Ok(result)
    }

    fn scene(&self) -> Result<CaseResult> {
        let start = std::time::Instant::now();
        let tally = Tally::default();
        let mut result = CaseResult { study_alone: true, ..head(self.file, self.tier) };
        let base = evaluate::solve(self.file, &tally)?;
        rounding::measure(self.file, &base, &tally, &mut result)?;
        trend::measure(&base, &mut result);
        result.margins.extend(self.step(&base, &tally)?);
        result.work = tally.total();
        result.seconds = start.elapsed().as_secs_f64();
        Ok(result)
    }

    /// The longest step over the scene's that is neither refused nor changes a reading.
    fn step(&self, base: &Solved, tally: &Tally) -> Result<Option<Margin>> {
        let Some(dynamics) = &self.file.scene.dynamics else { return Ok(None) };
        let two = dynamics.stepping == Stepping::TwoRates;
        let keys = [
            ("fine_share", dynamics.fine_share.as_ref().filter(|_| two)),
            ("fine_s", dynamics.fine_s.as_ref().filter(|_| two)),
            ("step_share", dynamics.step_share.as_ref()),
            ("step_s", dynamics.step_s.as_ref()),
        ];
        let Some((key, number)) = keys.into_iter().find_map(|(key, number)| Some((key, number?))) else {
            return Ok(None);
        };
        let path = format!("dynamics.{key}");
        let own = number.value(&self.file.values, &path).map_err(|fault| self.file.error(fault))?;
        let found = Search { from: 1.0, to: LONGEST, tolerance: 0.05 }.largest(|factor| {
            let longer = Override { key: path.clone(), value: serde_json::json!(factor * own) };
            let readings = self.file.with(&[longer]).and_then(|file| evaluate::solve(&file, tally));
            Ok(readings.is_ok_and(|solved| distance(&base.readings, &solved.readings) <= ALIKE))
        })?;
        let criterion = "the run is neither refused nor stopped, and every reading stays within 5 % of its largest magnitude";
        let label = format!("{}, {}", self.file.scene.id, dynamics.stepping.name());
        let axis = format!("{key} over that of the scene");
        Ok(Some(found.margin(["time step of a scene", criterion], ["time-step", &label, &axis], 1.0)))
    }
}

/// Largest distance of a reading from that of another run, over its largest magnitude; infinite where one cannot be compared.
fn distance(base: &Readings, other: &Readings) -> f64 {
    let all = base
        .iter()
        .map(|(name, reading)| other.reading(name).map_or(f64::INFINITY, |other| apart(reading, other)));
    all.fold(0.0, nan_max)
}

/// Distance of a reading from another, over its largest magnitude.
fn apart(base: &Reading, other: &Reading) -> f64 {
    let relative = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
    match (base, other) {
        (Reading::Scalar(a), Reading::Scalar(b)) => relative((a - b).abs(), a.abs()),
        // Stations may move with the step: compared where both have one.
        (Reading::Curve(a), Reading::Curve(b)) if a.x.len() == b.x.len() => {
            let size = a.y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
            let change = a.y.iter().zip(&b.y).map(|(a, b)| (a - b).abs()).fold(0.0, nan_max);
            relative(change, size)
        }
        _ => f64::INFINITY,
    }
}
