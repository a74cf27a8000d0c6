//! Work–precision: error against counted work and seconds for several settings.

use super::evaluate::{self, Solved, Tally, distance};
use super::{Study, at_level, level_name};
use crate::error::Result;
use crate::file::SceneFile;
use crate::model::calibration;
use crate::result::{CostDiagram, CostPoint, CostSetting};
use crate::scene::quantity::Quantity;
use crate::scene::study::CostDeclaration;

/// Runs shorter than this are repeated.
const SHORT_S: f64 = 0.2;
/// How often, after one run to warm up.
const REPEATS: usize = 5;

/// All cost diagrams of the scene.
pub fn all(study: &Study) -> Result<Vec<CostDiagram>> {
    let now = study.file.scene.costs.iter().filter(|(_, declared)| declared.tiers.contains(&study.tier));
    now.map(|(name, declared)| one(study, name, declared)).collect()
}

fn one(study: &Study, name: &str, declared: &CostDeclaration) -> Result<CostDiagram> {
    let quantity = &study.file.scene.quantities[&declared.quantity];
    let mut settings = Vec::new();
    for (legend, names) in &declared.settings {
        let mut points = Vec::new();
        for value in &declared.levels.values {
            let mut changes = study.variants(names);
            changes.push(at_level(&declared.levels, value));
            let level = level_name(&declared.levels, value);
            let failed = CostPoint { level: level.clone(), ..CostPoint::default() };
            // A setting that cannot run is a gap in its line.
            let point = study.file.with(&changes).and_then(|file| measure(study, quantity, &file, level));
            points.push(point.unwrap_or(failed));
        }
        settings.push(CostSetting { name: legend.clone(), points });
    }
    Ok(CostDiagram {
        id: name.to_owned(),
        title: declared.title.clone(),
        error_label: quantity.label.clone(),
        settings,
    })
}

fn measure(study: &Study, quantity: &Quantity, file: &SceneFile, level: String) -> Result<CostPoint> {
    let reference = study.library.of(file, study.tally)?;
    let solved = timed(file, study.tally)?;
    let error = match quantity.norm {
        None => {
            let exact = reference.estimate(quantity).map(|estimate| estimate.value);
            let value = solved.readings.value(quantity);
            value.zip(exact).map(|(value, exact)| ((value - exact) / exact).abs())
        }
        Some(norm) => {
            let what = (quantity.probe.as_str(), norm, quantity.zone);
            distance(file, &solved.readings, &reference, what).map(f64::abs)
        }
    };
    let mut seconds = vec![solved.seconds];
    if solved.seconds < SHORT_S {
        seconds.clear();
        for _ in 0..REPEATS {
            seconds.push(timed(file, &Tally::default())?.seconds);
        }
    }
    seconds.sort_by(f64::total_cmp);
    Ok(CostPoint {
        level,
        error,
        particles: solved.built.particles(),
        work: solved.solution.work,
        seconds: seconds[seconds.len() / 2],
    })
}

/// A run that pays for its own packing and calibration.
fn timed(file: &SceneFile, tally: &Tally) -> Result<Solved> {
    calibration::forget();
    evaluate::solve(file, tally)
}
