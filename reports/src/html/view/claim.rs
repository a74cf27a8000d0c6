//! What the template of a claim shows.

use crate::activity::Activity;
use crate::claims::meaning;
use crate::format::{percent, share};
use crate::plots::{self, Figure};
use crate::results::{CaseJudgement, ClaimResult};
use seam_cases::result::{CaseResult, Family, ReferenceKind};
use serde::Serialize;

/// A claim in words and figures.
#[derive(Serialize)]
pub(crate) struct Claim {
    id: String,
    case: String,
    activity: &'static str,
    judged: ClaimResult,
    bound: String,
    share: String,
    meaning: String,
    recorded: String,
    readings: Vec<ReadingRow>,
    axes: Vec<AxisRow>,
    paper_like: String,
    scatter: Option<Figure>,
}

impl Claim {
    /// The figure of the claim, named after it.
    pub(super) fn figure(&self) -> Option<(String, &Figure)> {
        Some((self.id.clone(), self.scatter.as_ref()?))
    }
}

#[derive(Serialize)]
struct ReadingRow {
    meaning: String,
    main: bool,
    share: f64,
    share_text: String,
    counts: [usize; 3],
    errors: String,
}

#[derive(Serialize)]
struct AxisRow {
    name: String,
    values: Vec<(String, f64, String, String, usize)>,
}

/// Puts a judged claim, and the family it was measured on, into words and a figure.
pub(super) fn claim(case: &CaseJudgement, judged: &ClaimResult, measured: Option<&CaseResult>) -> Claim {
    let families = measured.map_or(&[][..], |m| &m.families);
    let family = families.iter().find(|f| f.claim == judged.id);
    let held = |f: &&Family| f.no_more_particles_than.as_deref() == Some(judged.id.as_str());
    let own = families.iter().find(held);
    let scatter = family.and_then(|f| plots::family::scatter(f, judged, own));
    let paper_like =
        family.map_or(Vec::new(), |f| f.paper_like.iter().map(|(k, v)| format!("{k} = {v}")).collect());
    Claim {
        id: judged.id.clone(),
        case: case.id.clone(),
        // Errors of a family are distances to the scene's reference model, finite elements.
        activity: Activity::against(ReferenceKind::OwnFem).name(),
        bound: percent(judged.bound),
        share: share(judged.share),
        meaning: meaning::paragraph(judged),
        recorded: recorded(judged),
        readings: judged
            .readings
            .iter()
            .map(|r| ReadingRow {
                meaning: r.meaning.clone(),
                main: r.main,
                share: r.share,
                share_text: share(r.share),
                counts: [r.meets, r.fails, r.unclear],
                errors: r
                    .errors
                    .map_or("–".to_owned(), |[lo, hi]| format!("{} … {}", percent(lo), percent(hi))),
            })
            .collect(),
        axes: judged
            .decides
            .iter()
            .map(|a| AxisRow {
                name: crate::claims::decides::words(&a.axis),
                values: a
                    .values
                    .iter()
                    .map(|v| {
                        (
                            v.value.clone(),
                            v.share,
                            share(v.share),
                            v.error.map_or("–".to_owned(), percent),
                            v.settings,
                        )
                    })
                    .collect(),
            })
            .collect(),
        paper_like: paper_like.join(", "),
        // The members of an own claim that is held to a paper's are drawn in that one's figure.
        scatter: scatter.filter(|_| family.is_some_and(|f| f.no_more_particles_than.is_none())),
        judged: judged.clone(),
    }
}

fn recorded(c: &ClaimResult) -> String {
    use crate::record::RecordState as State;
    if c.own {
        return "must be supported".to_owned();
    }
    let now = match (c.record, &c.recorded) {
        (State::Same, _) => "the recorded verdict stands".to_owned(),
        (State::Changed, Some(r)) => format!("recorded was: {}, {}", r.verdict, share(r.share)),
        (State::OtherFamily, Some(r)) => format!("the record ({}) answers another family", r.verdict),
        _ => "no verdict is recorded yet".to_owned(),
    };
    match &c.recorded_full {
        Some(full) => format!("{now}; whole family, as recorded: {}, {}", full.verdict, share(full.share)),
        None => now,
    }
}
