//! Error budgets: the signed error of a quantity as a sum of differences between runs.

use super::Study;
use super::evaluate::{self, Readings, distance};
use crate::error::Result;
use crate::file::SceneFile;
use crate::overrides::Override;
use crate::result::{Budget, BudgetPart};
use crate::scene::Tier;
use crate::scene::quantity::{Norm, Quantity};
use crate::scene::study::{BudgetDeclaration, Part, Seeds};

/// All budgets of the scene.
pub fn all(study: &Study) -> Result<Vec<Budget>> {
    let now = study.file.scene.budgets.iter().filter(|(_, declared)| declared.tiers.contains(&study.tier));
    now.map(|(name, declared)| one(study, name, declared)).collect()
}

fn one(study: &Study, name: &str, declared: &BudgetDeclaration) -> Result<Budget> {
    let quantity = &study.file.scene.quantities[&declared.quantity];
    let whole = study.file.with(&study.variants(&declared.of))?;
    let readings = evaluate::solve(&whole, study.tally)?.readings;
    let first_switch = readings.first_switch();
    let total = error(study, quantity, &whole, &readings)?;
    let mut parts = Vec::new();
    for part in &declared.parts {
        parts.push(one_part(study, quantity, part, first_switch)?);
    }
    let explained: f64 = parts.iter().map(|part| part.value).sum();
    parts.push(BudgetPart {
        name: "unexplained".to_owned(),
        value: total - explained,
        how: "the total less all parts".to_owned(),
        scatter: None,
    });
    Ok(Budget {
        id: name.to_owned(),
        title: declared.title.clone(),
        quantity: quantity.label.clone(),
        total,
        parts,
    })
}

fn one_part(
    study: &Study,
    quantity: &Quantity,
    part: &Part,
    first_switch: Option<f64>,
) -> Result<BudgetPart> {
    let difference = |seed: Option<Override>| -> Result<f64> {
        let run = |names: &[String]| {
            let mut changes = study.variants(names);
            changes.extend(seed.clone());
            let file = study.file.with(&changes)?;
            let readings = evaluate::solve(&file, study.tally)?.readings.counted_from(first_switch);
            error(study, quantity, &file, &readings)
        };
        // The converged reference has no error.
        let from = if part.from_reference { 0.0 } else { run(&part.from)? };
        Ok(run(&part.to)? - from)
    };
    let differences = match &part.seeds {
        None => vec![difference(None)?],
        Some(seeds) => of_tier(study, seeds)
            .iter()
            .map(|&seed| {
                let key = seeds.key(&study.file.scene);
                difference(Some(Override { key, value: seed.into() }))
            })
            .collect::<Result<Vec<f64>>>()?,
    };
    let n = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let scatter = (differences.len() > 1).then(|| variance.sqrt());
    Ok(BudgetPart { name: part.name.clone(), value: mean, how: part.how.clone(), scatter })
}

fn of_tier<'a>(study: &Study, seeds: &'a Seeds) -> &'a [u64] {
    match study.tier {
        Tier::Quick => &seeds.quick,
        Tier::Full => &seeds.full,
    }
}

/// Signed error of a quantity, as a fraction of its reference. A scene's reference is that of the
/// undivided scene, so that all runs are measured against one value.
fn error(study: &Study, quantity: &Quantity, file: &SceneFile, readings: &Readings) -> Result<f64> {
    let reference = study.library.of(study.file, study.tally)?;
    let found = match quantity.norm {
        None => {
            let exact = reference.estimate(quantity).map(|estimate| estimate.value);
            readings.value(quantity).zip(exact).map(|(value, exact)| (value - exact) / exact)
        }
        Some(_) => distance(file, readings, &reference, (quantity.probe.as_str(), Norm::Mean, quantity.zone)),
    };
    found
        .ok_or_else(|| study.error(format!("the budget of '{}' has nothing to compare with", quantity.label)))
}
