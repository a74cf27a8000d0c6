//! Two runs side by side: what became better, what became worse. Wall time is left out: only runs that take
//! turns on one machine can be compared in seconds.

use crate::counted::{changes, counters};
use crate::exit::Exit;
use crate::format::{percent, share, with_unit};
use crate::loosened::{loosened, width};
use crate::margins::{MarginResult, moved};
use crate::results::{CaseJudgement, ClaimResult, QuantityResult, Results};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// What a change is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A tolerance is wider, or a number is judged no more.
    Loosened,
    /// What could be measured cannot any more.
    Lost,
    /// Another verdict on a number, for the worse.
    Failed,
    /// Another verdict on a claim, whichever way.
    Claim,
    /// Nearer to the end of the accepted interval: the margin shrinks.
    Closer,
    /// More counted work.
    Cost,
    /// For the better.
    Better,
    /// Worth knowing.
    Note,
}

impl Kind {
    /// One word for tables.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Loosened => "LOOSENED",
            Kind::Lost => "LOST",
            Kind::Failed => "FAILED",
            Kind::Claim => "CLAIM",
            Kind::Closer => "CLOSER",
            Kind::Cost => "COSTS MORE",
            Kind::Better => "better",
            Kind::Note => "note",
        }
    }

    /// What the gate makes of it.
    pub fn exit(self) -> Exit {
        match self {
            Kind::Lost => Exit::Unmeasured,
            Kind::Loosened | Kind::Failed | Kind::Claim | Kind::Closer => Exit::Failed,
            Kind::Cost => Exit::Cost,
            Kind::Better | Kind::Note => Exit::Pass,
        }
    }
}

/// One change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// What it is.
    pub kind: Kind,
    /// Case, and number, claim or counter within it.
    pub place: String,
    /// In the baseline.
    pub was: String,
    /// In this run.
    pub now: String,
}

/// Use of the accepted interval (0 at the best value, 1 at the end) may grow by this: values repeat to
/// rounding, so a tenth of the tolerance is no accident.
const CLOSER: f64 = 0.1;

/// All changes from a baseline to a run, loosened tolerances first. Cases are compared at their own tier; those
/// that are in one of the runs only are noted.
pub fn compare(baseline: &Results, run: &Results) -> Vec<Change> {
    let mut all = Vec::new();
    for now in &run.cases {
        let was = baseline.cases.iter().find(|was| was.id == now.id && was.tier == now.tier);
        match was {
            Some(was) => case(was, now, &mut all),
            None => all.push(note(&now.id, "not in the baseline", "new")),
        }
    }
    let gone = |was: &&CaseJudgement| !run.cases.iter().any(|now| now.id == was.id && now.tier == was.tier);
    all.extend(baseline.cases.iter().filter(gone).map(|was| note(&was.id, "measured", "not in this run")));
    all.sort_by_key(|change| change.kind);
    all
}

/// The most severe exit code of some changes.
pub fn exit(changes: &[Change]) -> Exit {
    changes.iter().fold(Exit::Pass, |exit, change| exit.or(change.kind.exit()))
}

fn note(place: &str, was: &str, now: &str) -> Change {
    Change { kind: Kind::Note, place: place.to_owned(), was: was.to_owned(), now: now.to_owned() }
}

fn case(was: &CaseJudgement, now: &CaseJudgement, all: &mut Vec<Change>) {
    let place = |item: &str| format!("{} / {item}", now.id);
    let widths: BTreeMap<String, f64> =
        was.quantities.iter().filter_map(|q| Some((q.id.clone(), width(q)?))).collect();
    for l in loosened(Some(&widths), &now.quantities) {
        let (was, now) = (l.say(l.was), l.say_now());
        all.push(Change { kind: Kind::Loosened, place: place(&l.quantity), was, now });
    }
    for q in &now.quantities {
        let Some(was) = was.quantities.iter().find(|was| was.id == q.id) else { continue };
        all.extend(quantity(was, q).map(|(kind, was, now)| Change { kind, place: place(&q.id), was, now }));
    }
    for m in &now.margins {
        let Some(was) = was.margins.iter().find(|was| was.id == m.id) else { continue };
        all.extend(margin(was, m).map(|(kind, was, now)| Change { kind, place: place(&m.id), was, now }));
    }
    let lost = was.margins.iter().filter(|was| !now.margins.iter().any(|m| m.id == was.id));
    all.extend(lost.map(|was| Change {
        kind: Kind::Lost,
        place: place(&was.id),
        was: say_margin(was),
        now: "gone".to_owned(),
    }));
    for was in &was.claims {
        let claim = now.claims.iter().find(|now| now.id == was.id);
        all.extend(of_claim(was, claim).map(|(kind, now)| Change {
            kind,
            place: place(&was.id),
            was: say_claim(was),
            now,
        }));
    }
    if was.scene_hash != now.scene_hash {
        all.push(note(&now.id, "another scene", "counted work is not compared"));
        return;
    }
    let [more, less] = changes(&counters(&was.work), &counters(&now.work));
    for (kind, counters) in [(Kind::Cost, more), (Kind::Better, less)] {
        all.extend(counters.into_iter().map(|c| Change {
            kind,
            place: place(&c.words()),
            was: c.was.to_string(),
            now: c.now.to_string(),
        }));
    }
}

fn quantity(was: &QuantityResult, now: &QuantityResult) -> Option<(Kind, String, String)> {
    let say = |q: &QuantityResult| {
        let value = q.value.map_or_else(|| "not measured".to_owned(), |v| with_unit(v, &q.unit));
        q.headroom.map_or(value.clone(), |h| format!("{value}, headroom {}", percent(h)))
    };
    let kind = match (was.value.is_some(), now.value.is_some()) {
        (true, false) => Kind::Lost,
        _ if was.verdict < now.verdict && was.verdict.is_some() => Kind::Failed,
        _ if was.verdict > now.verdict && now.verdict.is_some() => Kind::Better,
        _ => match was.headroom? - now.headroom? {
            shrunk if shrunk > CLOSER => Kind::Closer,
            shrunk if shrunk < -CLOSER => Kind::Better,
            _ => return None,
        },
    };
    Some((kind, say(was), say(now)))
}

/// A margin changes where it differs by more than the width of its search.
fn margin(was: &MarginResult, now: &MarginResult) -> Option<(Kind, String, String)> {
    let (Some(before), Some(after)) = (was.value, now.value) else {
        return was.value.map(|_| (Kind::Lost, say_margin(was), say_margin(now)));
    };
    let kind = match moved(after, before, was.tolerance.max(now.tolerance)) {
        Ordering::Less => Kind::Closer,
        Ordering::Greater => Kind::Better,
        Ordering::Equal => return None,
    };
    Some((kind, say_margin(was), say_margin(now)))
}

fn say_margin(m: &MarginResult) -> String {
    let value = m.value.map_or_else(|| "not measured".to_owned(), |v| with_unit(v, &m.unit));
    format!("margin {value}, needed {}", with_unit(m.needed, &m.unit))
}

fn of_claim(was: &ClaimResult, now: Option<&ClaimResult>) -> Option<(Kind, String)> {
    let Some(now) = now else { return Some((Kind::Lost, "gone".to_owned())) };
    if now.hash != was.hash {
        return Some((Kind::Claim, format!("{}, of another family", say_claim(now))));
    }
    (now.verdict != was.verdict).then(|| (Kind::Claim, say_claim(now)))
}

fn say_claim(claim: &ClaimResult) -> String {
    format!("{}, {}", claim.verdict, share(claim.share))
}
