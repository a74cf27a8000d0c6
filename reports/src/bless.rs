//! What accepting a run would change in the records, for people to look at before it is done.

use crate::counted::changes;
use crate::format::{percent, share, signed_percent, value};
use crate::record::{Recorded, RecordedClaim};
use crate::results::{CaseJudgement, Results};
use std::collections::BTreeMap;

/// A value may move by this share of itself without a line of its own: rounding differs between machines.
const ROUNDING: f64 = 1e-9;
/// Values below this are rounding themselves: residuals of exact tests.
const NOTHING: f64 = 1e-12;

/// One line of the difference.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// `loosened`, `verdict`, `value`, `work`, `new` …
    pub kind: &'static str,
    /// Tier, case, and number, claim or counter.
    pub place: String,
    /// As recorded.
    pub was: String,
    /// As it would be.
    pub now: String,
}

/// The differences that a reader has to judge, loosened tolerances first; changes by rounding are only counted.
pub fn differences(old: &Recorded, results: &Results) -> (Vec<Difference>, usize) {
    let new = old.updated(results);
    let (mut all, mut rounding) = (Vec::new(), 0);
    for case in &results.cases {
        tolerances(old, &new, case, &mut all);
        claims(old, case, &mut all);
        rounding += values(old, &new, case, &mut all);
        margins(old, case, &mut all);
        work(old, &new, case, &mut all);
    }
    all.sort_by_key(|d| (d.kind != "loosened", d.kind != "verdict"));
    (all, rounding)
}

fn place(case: &CaseJudgement, item: &str) -> String {
    format!("{} {} / {item}", case.tier, case.id)
}

fn tolerances(old: &Recorded, new: &Recorded, case: &CaseJudgement, all: &mut Vec<Difference>) {
    let row = |kind, id: &str, was, now| Difference { kind, place: place(case, id), was, now };
    all.extend(case.loosened.iter().map(|l| row("loosened", &l.quantity, l.say(l.was), l.say_now())));
    let (Some(was), Some(now)) = (old.tolerances(&case.tier, &case.id), new.tolerances(&case.tier, &case.id))
    else {
        return;
    };
    for (id, now) in now {
        if let Some(was) = was.get(id).filter(|was| now < *was && (*was - now) > ROUNDING * *was) {
            all.push(row("tightened", id, value(*was), value(*now)));
        }
    }
}

fn claims(old: &Recorded, case: &CaseJudgement, all: &mut Vec<Difference>) {
    let say = |c: &RecordedClaim| format!("{} ({})", c.verdict, share(c.share));
    for claim in case.claims.iter().filter(|c| c.unmeasured.is_none()) {
        let was = old.claim(&case.tier, &claim.id);
        let other = was.is_some_and(|was| was.hash != claim.hash);
        let now = RecordedClaim { verdict: claim.verdict, share: claim.share, hash: claim.hash.clone() };
        if was != Some(&now) {
            all.push(Difference {
                kind: "verdict",
                place: place(case, &claim.id),
                was: was.map_or_else(|| "unrecorded".to_owned(), say),
                now: if other { format!("{}, of another family", say(&now)) } else { say(&now) },
            });
        }
    }
}

/// Returns how many values have moved by rounding alone.
fn values(old: &Recorded, new: &Recorded, case: &CaseJudgement, all: &mut Vec<Difference>) -> usize {
    let empty = BTreeMap::new();
    let of = |recorded: &Recorded| recorded.values.get(&case.tier).and_then(|c| c.get(&case.id)).cloned();
    let (was, now) = (of(old).unwrap_or_default(), of(new).unwrap_or(empty));
    let mut rounding = 0;
    let mut row = |kind, id: &str, was: String, now: String| {
        all.push(Difference { kind, place: place(case, id), was, now })
    };
    for (id, &now) in &now {
        match was.get(id) {
            None => row("new", id, "unrecorded".to_owned(), value(now)),
            Some(&was) if was == now => {}
            Some(&was) if (now - was).abs() <= (ROUNDING * was.abs()).max(NOTHING) => rounding += 1,
            Some(&was) => {
                let by = if was == 0.0 {
                    String::new()
                } else {
                    format!(" ({})", signed_percent(now / was - 1.0))
                };
                row("value", id, value(was), value(now) + &by);
            }
        }
    }
    for (id, &was) in was.iter().filter(|(id, _)| !now.contains_key(*id)) {
        row("gone", id, value(was), "not measured any more".to_owned());
    }
    rounding
}

fn margins(old: &Recorded, case: &CaseJudgement, all: &mut Vec<Difference>) {
    for m in &case.margins {
        let was = old.margin(&case.tier, &case.id, &m.id);
        if let Some(now) = m.value.filter(|now| was != Some(*now)) {
            let was = was.map_or_else(|| "unrecorded".to_owned(), value);
            all.push(Difference { kind: "margin", place: place(case, &m.id), was, now: value(now) });
        }
    }
}

fn work(old: &Recorded, new: &Recorded, case: &CaseJudgement, all: &mut Vec<Difference>) {
    let mut row = |was: String, now: String| {
        all.push(Difference { kind: "work", place: place(case, "work"), was, now });
    };
    let Some(now) = new.work(&case.tier, &case.id, &case.scene_hash) else { return };
    let recorded = old.work.get(&case.tier).and_then(|w| w.get(&case.id));
    match recorded {
        None => row("unrecorded".to_owned(), format!("{} units", now.total)),
        Some(was) if was.scene != now.scene => {
            row(format!("{} units", was.total), format!("{} units, of another scene", now.total));
        }
        Some(was) => {
            for counter in changes(&was.counters, &now.counters).into_iter().flatten() {
                let by = percent(counter.now as f64 / counter.was.max(1) as f64 - 1.0);
                row(format!("{} {}", counter.was, counter.words()), format!("{} ({by})", counter.now));
            }
            if was.counters.is_empty() {
                row(format!("{} units", was.total), format!("{} units, each counter by itself", now.total));
            }
        }
    }
}
