//! Work–precision: error against counted work and seconds for several settings.

mod elsewhere;
mod levels;
mod measure;
mod plan;
mod settings;
mod target;

pub use plan::{CostStudy, Surroundings};

use super::{Study, at_level, level_name};
use crate::error::Result;
use crate::overrides::Override;
use crate::result::{CostDiagram, CostPoint, CostSetting};
use crate::scene::Tier;
use crate::scene::study::CostDeclaration;
use measure::{Repeats, measure};
use target::Target;

/// Packings per random setting: odd, so that one of them is in the middle.
fn seeds(tier: Tier) -> u64 {
    match tier {
        Tier::Quick => 3,
        Tier::Full => 7,
    }
}

/// The cost diagrams that the scene declares for this tier: its own settings at its own levels.
pub(super) fn all(study: &Study) -> Result<Vec<CostDiagram>> {
    let now = study.file.scene.costs.iter().filter(|(_, declared)| declared.tiers.contains(&study.tier));
    now.map(|(name, declared)| one(study, name, declared)).collect()
}

fn one(study: &Study, name: &str, declared: &CostDeclaration) -> Result<CostDiagram> {
    let target = Target::declared(study, declared)?;
    let empty = |legend: &String| CostSetting { name: legend.clone(), points: Vec::new() };
    let mut settings: Vec<CostSetting> = declared.settings.keys().map(empty).collect();
    // The settings of a level in turn: what else the machine does falls on all of them alike, and their times have a ratio.
    for value in &declared.levels.values {
        for (names, setting) in declared.settings.values().zip(&mut settings) {
            let mut changes = study.variants(&[&declared.variants[..], names].concat());
            changes.push(at_level(&declared.levels, value));
            setting.points.push(point(study, &target, &changes, level_name(&declared.levels, value)));
        }
    }
    let mut diagram = CostDiagram {
        id: name.to_owned(),
        title: declared.title.clone(),
        cheaper: declared.cheaper.clone(),
        settings,
        ..target.head(study)
    };
    diagram.name_paper_like();
    Ok(diagram)
}

/// A setting that cannot run is a gap in its line, with the reason.
fn point(study: &Study, target: &Target, changes: &[Override], level: String) -> CostPoint {
    let file = study.file.with(changes);
    let found = file.and_then(|file| {
        let packings = settings::packings(&file.scene, seeds(study.tier));
        measure(study, target, &file, &packings, Repeats::IfShort)
    });
    let point =
        found.unwrap_or_else(|error| CostPoint { failed: Some(error.to_string()), ..CostPoint::default() });
    CostPoint { level, ..point }
}

#[cfg(test)]
mod tests {
    use super::super::evaluate::Tally;
    use super::super::reference::Library;
    use super::*;
    use crate::catalogue;
    use std::collections::BTreeMap;

    /// A packing of its own, packings to calibrate on, and the run: each is in the whole, and nothing else is.
    #[test]
    fn a_point_pays_for_its_packing_and_its_calibration() {
        let rows = Override::parse("parameters.rows=4").unwrap();
        let file = catalogue::case("clamped-beam-rotation", &[rows]).unwrap();
        let (tally, library, peers) = (Tally::default(), Library::default(), BTreeMap::new());
        let study = Study { file: &file, tier: Tier::Quick, tally: &tally, library: &library, peers: &peers };
        let target = Target::declared(&study, &file.scene.costs["rotation"]).unwrap();
        let of = |variant: &str| {
            let p = point(&study, &target, &study.variants(&[variant.to_owned()]), String::new());
            assert_eq!(p.failed, None);
            (p.work.packing_checks, p.work.total() - p.run_work - p.calibration_work)
        };
        let (all_packings, own) = of("paper-like");
        assert!(0 < own && own < all_packings, "{own} of {all_packings}");
        assert_eq!(of("lattice"), (0, 0));
    }

    /// An error that is small by chance is no reason to recommend a setting that the gate would refuse.
    #[test]
    fn a_setting_that_is_not_trusted_is_a_gap() {
        let rows = Override::parse("parameters.rows=4").unwrap();
        let file = catalogue::case("ramp-transfer", &[rows]).unwrap();
        let (tally, library, peers) = (Tally::default(), Library::default(), BTreeMap::new());
        let study = Study { file: &file, tier: Tier::Quick, tally: &tally, library: &library, peers: &peers };
        let target = Target::declared(&study, &file.scene.costs["rates"]).unwrap();
        let of = |variants: &[String]| point(&study, &target, &study.variants(variants), String::new());
        let mapped = of(&["two-rates".to_owned()]);
        assert!(mapped.failed.is_some_and(|why| why.contains("not trusted")) && mapped.error.is_none());
        assert!(of(&[]).error.is_some());
    }
}
