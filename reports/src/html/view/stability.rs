//! How far the hard cases are from breaking, in words and pictures.

use crate::format::{percent, significant, with_unit};
use crate::margins::MarginResult;
use crate::plots::{self, Figure};
use crate::results::Results;
use crate::verdict::Verdict;
use seam_cases::result::CaseResult;
use serde::Serialize;

/// The section.
#[derive(Serialize)]
pub(super) struct Stability {
    sentence: String,
    groups: Vec<Group>,
    maps: Vec<Figure>,
}

/// The margins of one hard case and criterion.
#[derive(Serialize)]
struct Group {
    row: String,
    case: String,
    criterion: String,
    margins: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    label: String,
    axis: String,
    value: String,
    needed: String,
    recorded: String,
    how: String,
    verdict: String,
}

/// The section, or nothing where no hard case was run.
pub(super) fn section(results: &Results, cases: &[CaseResult]) -> Option<Stability> {
    let mut groups: Vec<Group> = Vec::new();
    for case in &results.cases {
        for m in &case.margins {
            let same = |g: &&mut Group| g.case == case.id && g.row == m.row && g.criterion == m.criterion;
            match groups.iter_mut().find(same) {
                Some(group) => group.margins.push(row(m)),
                None => groups.push(Group {
                    row: m.row.clone(),
                    case: case.id.clone(),
                    criterion: m.criterion.clone(),
                    margins: vec![row(m)],
                }),
            }
        }
    }
    let drawn = |c: &CaseResult| results.cases.iter().any(|judged| judged.id == c.id);
    let maps: Vec<Figure> =
        cases.iter().filter(|c| drawn(c)).flat_map(|c| &c.maps).filter_map(plots::map::squares).collect();
    let any = !(groups.is_empty() && maps.is_empty());
    any.then(|| Stability { sentence: sentence(results), groups, maps })
}

impl Stability {
    /// How many margins hold, and which is the closest; nothing where only maps were drawn.
    pub(super) fn sentence(&self) -> Option<&str> {
        Some(self.sentence.as_str()).filter(|s| !s.is_empty())
    }

    pub(super) fn maps(&self) -> &[Figure] {
        &self.maps
    }
}

/// How many pass, and which is the closest to what is needed.
fn sentence(results: &Results) -> String {
    let all: Vec<&MarginResult> = results.cases.iter().flat_map(|c| &c.margins).collect();
    let passing = all.iter().filter(|m| m.verdict == Verdict::Pass).count();
    let spare = |m: &&&MarginResult| m.value.map_or(0.0, |v| v / m.needed);
    let Some(closest) = all.iter().min_by(|a, b| spare(a).total_cmp(&spare(b))) else { return String::new() };
    format!(
        "{passing} of {} margins hold. The one with the least to spare has {} times what is needed: {}, {}.",
        all.len(),
        significant(spare(&closest), 3),
        closest.axis,
        closest.label
    )
}

fn row(m: &MarginResult) -> Row {
    let number = |v: f64| with_unit(v, &m.unit);
    let value = match m.value {
        Some(v) if m.open => format!("≥ {}", number(v)),
        Some(v) => number(v),
        None => "not measured".to_owned(),
    };
    let recorded = m.recorded.map_or("–".to_owned(), |r| {
        if m.tolerance > 0.0 { format!("{} ± {}", number(r), percent(m.tolerance)) } else { number(r) }
    });
    Row {
        label: m.label.clone(),
        axis: m.axis.clone(),
        value,
        needed: number(m.needed),
        recorded,
        how: m.how.clone(),
        verdict: m.verdict.to_string(),
    }
}
