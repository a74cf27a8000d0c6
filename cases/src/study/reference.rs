//! The reference model of a scene: the same probes on a refined model, extrapolated.

use super::evaluate::{self, Readings, Tally};
use super::richardson::{Estimate, extrapolate, observed_order};
use super::{at_level, digest, resolution, variants};
use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::observe::curve::{Axis, Curve};
use crate::observe::probes::Reading;
use crate::scene::quantity::Quantity;
use crate::scene::study::ReferenceModel;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

/// Reference values of one scene.
#[derive(Debug, Clone, Default)]
pub struct Reference {
    /// Scalar probes.
    pub scalars: BTreeMap<String, Estimate>,
    /// Probes along lines and over time, with the standard uncertainty as a share of the largest value.
    pub curves: BTreeMap<String, (Curve, f64)>,
    /// What it is, with its levels.
    pub about: String,
}

impl Reference {
    /// What a quantity takes from its probe: a scalar, or one value of a history.
    pub fn estimate(&self, quantity: &Quantity) -> Option<Estimate> {
        if let Some(estimate) = self.scalars.get(&quantity.probe) {
            return Some(*estimate);
        }
        let (curve, u) = self.curves.get(&quantity.probe)?;
        let value = curve.take(quantity.take.unwrap_or_default())?;
        let largest = curve.y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
        Some(Estimate { value, order: None, u: u * largest })
    }
}

impl Reference {
    /// Takes in a number that is known as it is.
    pub fn scalar(&mut self, probe: &str, value: f64) {
        self.scalars.insert(probe.to_owned(), Estimate { value, order: None, u: 0.0 });
    }
}

type Slot = Arc<OnceLock<std::result::Result<Arc<Reference>, String>>>;

/// References that have been computed: members of a family that differ in the discrete part only share
/// theirs.
#[derive(Default)]
pub struct Library {
    known: Mutex<BTreeMap<String, Slot>>,
}

impl Library {
    /// The reference of a scene.
    ///
    /// # Errors
    /// The scene has none; its model cannot be built or solved; levels that are not numbers.
    pub fn of(&self, file: &SceneFile, tally: &Tally) -> Result<Arc<Reference>> {
        let fail = |message: String| Error::Study { case: file.scene.id.clone(), message };
        let Some(declared) = &file.scene.reference else {
            return Err(fail("there is no [reference] model to compare with; add one".to_owned()));
        };
        self.model(file, declared, tally)
    }

    /// The reference that a model makes out of a scene.
    ///
    /// # Errors
    /// As [`Library::of`].
    pub fn model(
        &self,
        file: &SceneFile,
        declared: &ReferenceModel,
        tally: &Tally,
    ) -> Result<Arc<Reference>> {
        let fail = |message: String| Error::Study { case: file.scene.id.clone(), message };
        let base = file.with(&variants(file, &declared.variants))?;
        // The level's key is set in every run: its value in the scene must not tell scenes apart.
        let finest = declared.levels.values.last().map(|value| at_level(&declared.levels, value));
        // Two models may end at one finest level and not begin at one coarsest.
        let key = format!("{} {:?}", digest::digest(&base.with(finest.as_slice())?), declared.levels);
        let found = self.once(key, || compute(&base, declared, tally));
        found.map_err(|message| fail(format!("its reference model failed: {message}")))
    }

    /// Another run of the scene itself, compared as it is.
    ///
    /// # Errors
    /// The run fails.
    pub fn own_run(&self, file: &SceneFile, source: &str, tally: &Tally) -> Result<Arc<Reference>> {
        let found = self.once(format!("run {}", file.hash()), || {
            Ok(as_it_is(source, &evaluate::solve(file, tally)?.readings))
        });
        found.map_err(|message| Error::Study {
            case: file.scene.id.clone(),
            message: format!("the run it is compared with failed: {message}"),
        })
    }

    fn once(
        &self,
        key: String,
        compute: impl FnOnce() -> Result<Reference>,
    ) -> std::result::Result<Arc<Reference>, String> {
        let slot = match self.known.lock() {
            Ok(mut known) => Arc::clone(known.entry(key).or_default()),
            Err(_) => Slot::default(),
        };
        slot.get_or_init(|| compute().map(Arc::new).map_err(|e| e.to_string())).clone()
    }
}

fn compute(base: &SceneFile, declared: &ReferenceModel, tally: &Tally) -> Result<Reference> {
    let mut readings = Vec::new();
    let mut sizes = Vec::new();
    for value in &declared.levels.values {
        let file = base.with(&[at_level(&declared.levels, value)])?;
        readings.push(evaluate::solve(&file, tally)?.readings);
        sizes.push(resolution(value));
    }
    if let [only] = readings.as_slice() {
        return Ok(as_it_is(&declared.about, only));
    }
    let sizes: Option<Vec<f64>> = sizes.into_iter().collect();
    let (Some(sizes), [.., _, _, _]) = (sizes, readings.as_slice()) else {
        let message =
            "reference.levels needs one value, or three numbers of cells from coarse to fine".to_owned();
        return Err(Error::Study { case: base.scene.id.clone(), message });
    };
    let last = sizes.len() - 3;
    let ratios = [sizes[last + 1] / sizes[last], sizes[last + 2] / sizes[last + 1]];
    let mut reference = Reference {
        about: format!("{}; {} = {:?}", declared.about, declared.levels.key, sizes),
        ..Reference::default()
    };
    let [coarse, middle, fine] = [&readings[last], &readings[last + 1], &readings[last + 2]];
    for (probe, reading) in fine.iter() {
        match reading {
            Reading::Scalar(f3) => {
                if let (Some(f1), Some(f2)) = (coarse.scalar(probe), middle.scalar(probe)) {
                    let estimate = extrapolate([f1, f2, *f3], ratios, declared.formal_order);
                    reference.scalars.insert(probe.clone(), estimate);
                }
            }
            Reading::Curve(_) => {
                if let Some(curve) =
                    extrapolate_curve(probe, [coarse, middle, fine], ratios, declared.formal_order)
                {
                    reference.curves.insert(probe.clone(), curve);
                }
            }
        }
    }
    Ok(reference)
}

/// One level: the same mesh, compared as it is.
fn as_it_is(about: &str, readings: &Readings) -> Reference {
    let mut reference = Reference { about: about.to_owned(), ..Reference::default() };
    for (probe, reading) in readings.iter() {
        match reading {
            Reading::Scalar(value) => {
                reference.scalar(probe, *value);
            }
            Reading::Curve(curve) => {
                reference.curves.insert(probe.clone(), (curve.clone(), 0.0));
            }
        }
    }
    reference
}

/// Extrapolates each station with one order, observed in the largest differences.
fn extrapolate_curve(
    probe: &str,
    levels: [&Readings; 3],
    ratios: [f64; 2],
    formal_order: f64,
) -> Option<(Curve, f64)> {
    let [c1, c2, c3] = [levels[0].curve(probe)?, levels[1].curve(probe)?, levels[2].curve(probe)?];
    let [c1, c2, c3] = &at_shared_times([c1, c2, c3]);
    let difference =
        |a: &Curve, b: &Curve| a.y.iter().zip(&b.y).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    let (e32, e21) = (difference(c1, c2), difference(c2, c3));
    let largest = c3.y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    if largest == 0.0 || e21 <= 1e-12 * largest {
        return Some((c3.clone(), 0.0));
    }
    let order = observed_order(e32 / e21, ratios);
    let near = order.is_some_and(|p| (0.5..=formal_order + 0.1).contains(&p));
    // An order outside the asymptotic range is not used to extrapolate, only to judge.
    let p = if near { order.unwrap_or(formal_order) } else { formal_order };
    let shrink = 1.0 / (ratios[1].powf(p) - 1.0);
    let y = c2.y.iter().zip(&c3.y).map(|(f2, f3)| f3 - (f2 - f3) * shrink).collect();
    let safety = if near { 1.25 } else { 3.0 };
    Some((Curve { axis: c3.axis, x: c3.x.clone(), y }, 0.5 * safety * e21 * shrink / largest))
}

/// Histories at the times of the finest level that lie inside of all; lines as they are.
fn at_shared_times(levels: [&Curve; 3]) -> [Curve; 3] {
    let finest = levels[2];
    if finest.axis == Axis::Position {
        return levels.map(Clone::clone);
    }
    let inside = |x: &f64| levels.iter().all(|level| level.at(*x).is_some());
    let x: Vec<f64> = finest.x.iter().copied().filter(inside).collect();
    levels.map(|level| {
        let y = x.iter().filter_map(|x| level.at(*x)).collect();
        Curve { axis: Axis::Time, x: x.clone(), y }
    })
}
