//! What decides a claim: the axis along which the outcome moves most.

use super::settings::{Outcome, Setting};
use crate::format;
use crate::statistics::ensemble::Ensemble;
use schemars::JsonSchema;
use seam_cases::result::Family;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How the outcome of a family moves along one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AxisEffect {
    /// Name of the axis; `reading` for the readings of the metric.
    pub axis: String,
    /// Largest minus smallest share among the values.
    pub moves: f64,
    /// Largest over smallest geometric-mean error among the values.
    pub ratio: f64,
    /// The values, from the one that meets the bound most often.
    pub values: Vec<AxisValue>,
}

/// The settings with one value of an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AxisValue {
    /// The value, as text.
    pub value: String,
    /// Share of these settings that meet the bound.
    pub share: f64,
    /// Geometric mean of their errors, as a fraction; `null` if none could be run.
    pub error: Option<f64>,
    /// How many settings there are.
    pub settings: usize,
}

/// Mean error of one setting under one reading, where it could be run, and whether it meets the bound.
struct Evidence {
    values: BTreeMap<String, String>,
    error: Option<f64>,
    meets: bool,
}

/// Effect of every axis, and of the choice of a reading, the strongest first.
///
/// Axes are compared among settings that agree in everything else, so that a family which is no
/// full grid does not blame one axis for another: of those groups, the ones that hold the most values.
pub fn ranked(family: &Family, settings: &[Setting<'_>], most_particles: Option<f64>) -> Vec<AxisEffect> {
    let main = evidence(family, settings, &family.main_reading, most_particles);
    let mut effects: Vec<AxisEffect> = family.axes.keys().filter_map(|axis| effect(axis, &main)).collect();
    let all: Vec<Evidence> = family
        .readings
        .keys()
        .flat_map(|reading| evidence(family, settings, reading, most_particles))
        .collect();
    effects.extend(effect(READING, &all));
    effects.sort_by(|a, b| b.moves.total_cmp(&a.moves).then(b.ratio.total_cmp(&a.ratio)));
    effects
}

/// Name of the axis made of the readings.
pub const READING: &str = "reading";

fn evidence(
    family: &Family,
    settings: &[Setting<'_>],
    reading: &str,
    most_particles: Option<f64>,
) -> Vec<Evidence> {
    let one = |s: &Setting<'_>| {
        let mut values = s.values.clone();
        values.insert(READING.to_owned(), reading.to_owned());
        let meets = s.outcome(reading, family.bound, most_particles) == Outcome::Meets;
        Evidence { values, error: s.error(reading).map(|e| e.mean), meets }
    };
    settings.iter().map(one).collect()
}

fn effect(axis: &str, evidence: &[Evidence]) -> Option<AxisEffect> {
    let mut groups: BTreeMap<BTreeMap<&str, &str>, Vec<&Evidence>> = BTreeMap::new();
    for e in evidence.iter().filter(|e| e.values.contains_key(axis)) {
        let others = e.values.iter().filter(|(k, _)| *k != axis).map(|(k, v)| (k.as_str(), v.as_str()));
        groups.entry(others.collect()).or_default().push(e);
    }
    let most = groups.values().map(Vec::len).max().filter(|&n| n > 1)?;
    let full = groups.values().filter(|g| g.len() == most);
    let values = values_of(axis, full.flatten().copied());
    let shares = || values.iter().map(|v| v.share);
    let errors = || values.iter().filter_map(|v| v.error);
    let moves = shares().fold(0.0, f64::max) - shares().fold(1.0, f64::min);
    let (worst, best) = (errors().fold(0.0, f64::max), errors().fold(f64::INFINITY, f64::min));
    let ratio = if worst > 0.0 { worst / best } else { 1.0 };
    Some(AxisEffect { axis: axis.to_owned(), moves, ratio, values })
}

/// Smallest error that enters a geometric mean: an exact answer must not pull it to zero.
const LEAST_ERROR: f64 = 1e-15;

fn values_of<'a>(axis: &str, evidence: impl Iterator<Item = &'a Evidence>) -> Vec<AxisValue> {
    let mut by_value: BTreeMap<&str, Vec<&Evidence>> = BTreeMap::new();
    for e in evidence {
        by_value.entry(&e.values[axis]).or_default().push(e);
    }
    let summary = |(value, list): (&str, Vec<&Evidence>)| {
        let logs: Vec<f64> = list.iter().filter_map(|e| e.error).map(|e| e.max(LEAST_ERROR).ln()).collect();
        AxisValue {
            value: value.to_owned(),
            share: list.iter().filter(|e| e.meets).count() as f64 / list.len() as f64,
            error: Ensemble::of(&logs).map(|e| e.mean.exp()),
            settings: list.len(),
        }
    };
    let mut values: Vec<AxisValue> = by_value.into_iter().map(summary).collect();
    values.sort_by(|a, b| b.share.total_cmp(&a.share).then(by_error(a, b)));
    values
}

/// Order by error, values that could not be run last.
fn by_error(a: &AxisValue, b: &AxisValue) -> std::cmp::Ordering {
    let of = |v: &AxisValue| v.error.unwrap_or(f64::INFINITY);
    of(a).total_cmp(&of(b))
}

/// What decides, in one sentence: `skin decides: with weighted skin 96 % of settings meet 7 %, with
/// full skin 31 %; then rows: 100 % with rows 32, 41 % with rows 4`. A second axis is named where it moves the share
/// at least half as far. Where no axis moves the share, the one that moves the error most.
pub fn sentence(effects: &[AxisEffect], bound: f64) -> Option<String> {
    let first = effects.first()?;
    if first.moves > 0.0 {
        let (best, worst) = (first.values.first()?, first.values.last()?);
        let name = words(&first.axis);
        let mut text = format!(
            "{name} decides: with {} {} of settings meet {}, with {} {}",
            with_value(&name, &best.value),
            format::share(best.share),
            format::percent(bound),
            with_value(&name, &worst.value),
            format::share(worst.share),
        );
        if let Some(second) = effects.get(1).filter(|e| e.moves >= 0.5 * first.moves) {
            let (best, worst) = (second.values.first()?, second.values.last()?);
            let name = words(&second.axis);
            text += &format!(
                "; then {name}: {} with {}, {} with {}",
                format::share(best.share),
                with_value(&name, &best.value),
                format::share(worst.share),
                with_value(&name, &worst.value),
            );
        }
        return Some(text);
    }
    let strongest = effects.iter().max_by(|a, b| a.ratio.total_cmp(&b.ratio)).filter(|e| e.ratio > 1.0)?;
    let measured = || strongest.values.iter().filter(|v| v.error.is_some());
    let best = measured().min_by(|a, b| by_error(a, b))?;
    let worst = measured().max_by(|a, b| by_error(a, b))?;
    let name = words(&strongest.axis);
    Some(format!(
        "{name} moves the error most: {} on average with {}, {} with {}",
        format::percent(best.error?),
        with_value(&name, &best.value),
        format::percent(worst.error?),
        with_value(&name, &worst.value),
    ))
}

/// Name of an axis as words: the last part of a key path, without underscores.
pub fn words(axis: &str) -> String {
    axis.rsplit('.').next().unwrap_or(axis).replace(['_', '-'], " ")
}

/// `weighted skin`, but `rows 8` and `rotations on`.
pub(super) fn with_value(name: &str, value: &str) -> String {
    let switch = matches!(value, "on" | "off" | "true" | "false" | "yes" | "no");
    let word = value.starts_with(char::is_alphabetic) && !switch && name != READING;
    if word { format!("{value} {name}") } else { format!("{name} {value}") }
}

#[cfg(test)]
mod tests {
    use super::super::settings::settings;
    use super::*;
    use seam_cases::result::Member;

    fn member(skin: &str, rows: &str, error: f64) -> Member {
        Member {
            settings: [("skin".to_owned(), skin.to_owned()), ("de.rows".to_owned(), rows.to_owned())].into(),
            errors: [("r".to_owned(), error)].into(),
            ..Member::default()
        }
    }

    fn family(members: Vec<Member>, bound: f64) -> Family {
        let axis = |name: &str| (name.to_owned(), Vec::new());
        Family {
            bound,
            members,
            main_reading: "r".into(),
            readings: [("r".into(), "the only one".into())].into(),
            axes: [axis("skin"), axis("de.rows")].into(),
            ..Family::default()
        }
    }

    fn effects(f: &Family) -> Vec<AxisEffect> {
        ranked(f, &settings(f), None)
    }

    #[test]
    fn the_axis_that_moves_the_share_comes_first() {
        let f = family(
            vec![
                member("full", "4", 0.15),
                member("full", "8", 0.10),
                member("weighted", "4", 0.03),
                member("weighted", "8", 0.007),
            ],
            0.07,
        );
        let ranked = effects(&f);
        assert_eq!(ranked[0].axis, "skin");
        assert_eq!((ranked[0].moves, ranked[1].moves), (1.0, 0.0));
        let text = sentence(&ranked, 0.07).unwrap();
        assert_eq!(text, "skin decides: with weighted skin 100 % of settings meet 7 %, with full skin 0 %");
    }

    #[test]
    fn where_no_share_moves_the_error_is_compared() {
        let f = family(vec![member("full", "4", 0.04), member("full", "8", 0.01)], 0.07);
        let text = sentence(&effects(&f), 0.07).unwrap();
        assert_eq!(text, "rows moves the error most: 1 % on average with rows 8, 4 % with rows 4");
    }

    #[test]
    fn an_unbalanced_family_does_not_blame_one_axis_for_another() {
        // Fine settings were run with full skin only: taken together, rows 32 would look worse than rows 4.
        let f = family(
            vec![
                member("full", "4", 0.15),
                member("weighted", "4", 0.03),
                member("full", "8", 0.10),
                member("weighted", "8", 0.007),
                member("full", "32", 0.08),
            ],
            0.07,
        );
        let ranked = effects(&f);
        assert_eq!(ranked[0].axis, "skin");
        let rows = ranked.iter().find(|e| e.axis == "de.rows").unwrap();
        assert_eq!(rows.moves, 0.0, "the three full-skin settings all miss the bound");
    }
}
