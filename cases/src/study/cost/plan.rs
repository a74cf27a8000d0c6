//! A cost study: every setting at every level, whatever the tier of the scene's own diagrams says.

use super::super::evaluate::Tally;
use super::super::kept::Kept;
use super::super::reference::Library;
use super::super::{Onlooker, Study, digest, head, peer, variants};
use super::levels::Resolution;
use super::measure::{Repeats, measure};
use super::seeds;
use super::settings::{Setting, all_elements, generated, packings};
use super::target::Target;
use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::overrides::Override;
use crate::result::{CaseResult, CostDiagram, CostPoint, CostSetting, PAPER_LIKE};
use crate::scene::study::CostDeclaration;
use crate::scene::{Hypothesis, Tier};
use std::collections::BTreeSet;
use std::time::Instant;

/// Runs shorter than this are timed again, in s.
const REPEATED_S: f64 = 2.0;
/// Time grows at most as this power of the rows, in the plane and in the solid: a banded solve of rows² or rows³ unknowns.
const POWERS: [f64; 2] = [4.0, 7.0];

/// What a study needs from outside.
pub struct Surroundings<'a> {
    /// Who looks on.
    pub onlooker: &'a dyn Onlooker,
    /// Where finished points are kept.
    pub kept: &'a Kept,
    /// No run is begun that is expected to take longer, in s.
    pub longest_s: f64,
    /// Largest memory of a process that runs this scene alone, in MB; `None` where it cannot be told.
    pub memory_mb: &'a dyn Fn(&SceneFile) -> Option<f64>,
}

/// What accuracy costs in one scene: the settings it declares and those one change away from it.
pub struct CostStudy<'a> {
    file: &'a SceneFile,
    tier: Tier,
    diagrams: Vec<Diagram<'a>>,
}

struct Diagram<'a> {
    id: String,
    title: String,
    declared: Option<&'a CostDeclaration>,
    resolution: Resolution,
    settings: Vec<Setting>,
}

impl<'a> CostStudy<'a> {
    /// Chooses settings and levels.
    ///
    /// # Errors
    /// A case without a scene.
    pub fn plan(file: &'a SceneFile, tier: Tier) -> Result<Self> {
        let scene = &file.scene;
        if scene.bodies.is_empty() {
            let message = format!(
                "the procedure '{}' has no bodies whose settings could vary; study a scene with [bodies]",
                scene.procedure
            );
            return Err(Error::Study { case: scene.id.clone(), message });
        }
        let mut diagrams: Vec<Diagram> = Vec::new();
        for (name, declared) in &scene.costs {
            let start = variants(file, &declared.variants);
            let all = |changes: Vec<Override>| [&start[..], &changes].concat();
            let settings = declared
                .settings
                .iter()
                .map(|(legend, names)| Setting { name: legend.clone(), changes: all(variants(file, names)) });
            // What lies one change away is measured once, in the first diagram.
            let near = if diagrams.is_empty() { generated(&file.with(&start)?) } else { Vec::new() };
            let near = near.into_iter().map(|s| Setting { changes: all(s.changes), ..s });
            diagrams.push(Diagram {
                id: name.clone(),
                title: declared.title.clone(),
                declared: Some(declared),
                resolution: Resolution::of_diagram(scene, declared),
                settings: distinct(file, settings.chain(near)),
            });
        }
        if diagrams.is_empty() {
            let like = scene.variants.contains_key(PAPER_LIKE).then(|| Setting {
                name: PAPER_LIKE.to_owned(),
                changes: variants(file, &[PAPER_LIKE.to_owned()]),
            });
            diagrams.push(Diagram {
                id: "study".to_owned(),
                title: format!("What accuracy costs: {}", scene.title),
                declared: None,
                resolution: Resolution::of(scene),
                settings: distinct(file, like.into_iter().chain(generated(file))),
            });
        }
        Ok(Self { file, tier, diagrams })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.diagrams.iter().map(|d| d.settings.len() * d.resolution.len()).sum()
    }

    /// Whether there is nothing to measure.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Measures all points, one after the other, coarse to fine.
    ///
    /// # Errors
    /// A reference model that fails; points that cannot be kept. A setting that cannot run is a gap.
    pub fn run(&self, around: &Surroundings) -> Result<CaseResult> {
        let (tally, library) = (Tally::default(), Library::default());
        let (peers, _) = peer::all(self.file)?;
        let study =
            Study { file: self.file, tier: self.tier, tally: &tally, library: &library, peers: &peers };
        let start = Instant::now();
        let mut result = CaseResult { study_alone: true, ..head(self.file, self.tier) };
        result.command = result.command.replacen("seam run", "seam study cost", 1);
        for diagram in &self.diagrams {
            result.costs.push(diagram.run(&study, around)?);
        }
        result.seconds = start.elapsed().as_secs_f64();
        Ok(result)
    }
}

impl Diagram<'_> {
    fn run(&self, study: &Study, around: &Surroundings) -> Result<CostDiagram> {
        let target = match self.declared {
            Some(declared) => Target::declared(study, declared)?,
            None => Target::found(study, || self.finest(study))?,
        };
        let mut diagram = CostDiagram {
            id: self.id.clone(),
            title: self.title.clone(),
            cheaper: self.declared.and_then(|declared| declared.cheaper.clone()),
            ..target.head(study)
        };
        for setting in &self.settings {
            let mut points: Vec<CostPoint> = Vec::new();
            for level in 0..self.resolution.len() {
                let measured = points.iter().enumerate().filter(|(_, p)| p.error.is_some());
                let measured: Vec<_> = measured.map(|(k, p)| [self.resolution.size(k), p.seconds]).collect();
                let expected = expected(&measured, self.resolution.size(level), study.file.scene.hypothesis);
                points.push(self.point(study, (&target, setting), level, expected, around)?);
            }
            diagram.settings.push(CostSetting { name: setting.name.clone(), points });
        }
        diagram.name_paper_like();
        Ok(diagram)
    }

    /// The scene beyond its finest level, all finite elements where it can be.
    fn finest(&self, study: &Study) -> Result<(SceneFile, String)> {
        let changes = all_elements(&study.file.scene).map_or(Vec::new(), |setting| setting.changes);
        let base = study.file.with(&changes)?;
        let (name, more) = self.resolution.beyond(&base);
        let what = if changes.is_empty() { "the scene itself" } else { "the scene, all finite elements" };
        Ok((base.with(&more)?, format!("{what}, finer than all levels: {name}")))
    }

    /// One point; `expected` is what it may take, in s.
    fn point(
        &self,
        study: &Study,
        (target, setting): (&Target, &Setting),
        level: usize,
        expected: f64,
        around: &Surroundings,
    ) -> Result<CostPoint> {
        let gap = |level: String, why: String| CostPoint { level, failed: Some(why), ..CostPoint::default() };
        let base = match study.file.with(&setting.changes) {
            Ok(base) => base,
            Err(error) => {
                around.onlooker.done(&setting.name, "cannot be set");
                return Ok(gap(String::new(), error.to_string()));
            }
        };
        let (name, changes) = self.resolution.level(&base, level);
        let what = format!("{}, {name}", setting.name);
        around.onlooker.begin(&what);
        if expected > around.longest_s {
            around.onlooker.done(&what, "left out, it may take too long");
            let why = format!(
                "left out: by the levels before it may take {expected:.0} s, longer than {} s (--longest)",
                around.longest_s
            );
            return Ok(gap(name, why));
        }
        let file = match base.with(&changes) {
            Ok(file) => file,
            Err(error) => {
                around.onlooker.done(&what, "cannot be set");
                return Ok(gap(name, error.to_string()));
            }
        };
        let packings = packings(&file.scene, seeds(study.tier));
        let key = key(study, &file, &self.id, packings.len());
        let (point, kept) = around.kept.part(&key, || {
            let found = measure(study, target, &file, &packings, Repeats::Below(REPEATED_S));
            found.map_or_else(
                |error| gap(name.clone(), error.to_string()),
                |point| CostPoint { memory_mb: (around.memory_mb)(&file), ..point },
            )
        })?;
        let how = match (kept, point.error) {
            (true, _) => "kept".to_owned(),
            (false, Some(error)) => format!("error {:.2} %, {:.2} s", 100.0 * error, point.seconds),
            (false, None) => format!("failed: {}", point.failed.as_deref().unwrap_or_default()),
        };
        around.onlooker.done(&what, &how);
        Ok(CostPoint { level: name, ..point })
    }
}

/// What a level may take, in s: a power of its size through the last two that were measured, and where there is one, the highest.
/// Nothing is known before.
fn expected(measured: &[[f64; 2]], size: f64, hypothesis: Hypothesis) -> f64 {
    let highest = POWERS[usize::from(hypothesis == Hypothesis::Solid)];
    let Some(&[last, seconds]) = measured.last() else { return 0.0 };
    let power = match measured {
        [.., [before, then], _] => ((seconds / then).ln() / (last / before).ln()).clamp(0.0, highest),
        _ => highest,
    };
    seconds * (size / last).powf(power)
}

/// Settings that differ in what is computed; of two that do not, the first.
fn distinct(file: &SceneFile, settings: impl Iterator<Item = Setting>) -> Vec<Setting> {
    let mut seen = BTreeSet::new();
    // One that does not read is kept: it becomes a gap with its reason.
    let mut new =
        |setting: &Setting| file.with(&setting.changes).map_or(true, |f| seen.insert(digest::digest(&f)));
    settings.filter(|setting| new(setting)).collect()
}

/// All that a point depends on: the scene as it is run, what is read off, how many packings, and the program.
fn key(study: &Study, file: &SceneFile, diagram: &str, packings: usize) -> String {
    let parts = [&study.file.hash(), &file.hash(), diagram, &packings.to_string(), env!("CARGO_PKG_VERSION")];
    let mut hasher = blake3::Hasher::new();
    parts.iter().for_each(|part| {
        hasher.update(part.as_bytes());
        hasher.update(b"\n");
    });
    hasher.finalize().to_hex()[..32].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_expected_to_grow_as_the_last_two_did() {
        let of = |measured: &[[f64; 2]], size: f64| expected(measured, size, Hypothesis::PlaneStress);
        assert_eq!(of(&[], 8.0), 0.0);
        assert_eq!(of(&[[4.0, 1.0]], 8.0), 16.0);
        assert!((of(&[[4.0, 1.0], [8.0, 4.0]], 12.0) - 9.0).abs() < 1e-12);
        // What seems to fall is taken to stay; what seems to explode is not believed.
        assert_eq!(of(&[[4.0, 2.0], [8.0, 1.0]], 12.0), 1.0);
        assert_eq!(of(&[[4.0, 1e-6], [8.0, 1.0]], 16.0), 16.0);
    }
}
