//! From an effect on and off to a verdict: may it be left out, and does the guard know?

use crate::format::{percent, significant};
use crate::verdict::Verdict;
use schemars::JsonSchema;
use seam_cases::result::{Ablation, AblationChange, Expected, Indicator};
use serde::{Deserialize, Serialize};

/// An effect on and off, judged.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AblationJudgement {
    /// Unique within the case.
    pub id: String,
    /// What is looked at, in words.
    pub label: String,
    /// Name of the effect.
    pub effect: String,
    /// What it is expected to show; `null` where it is only shown.
    pub expected: Option<Expected>,
    /// Change of a quantity that counts as none, as a fraction.
    pub tolerance: f64,
    /// Largest change of all quantities, as a fraction; `null` where nothing could be compared.
    pub largest_change: Option<f64>,
    /// Each quantity with the effect and without.
    pub changes: Vec<AblationChange>,
    /// Work done for the effect alone: with it, and without, where it must be zero.
    pub counters: [u64; 2],
    /// Counted work without the effect over that with it.
    pub work_ratio: Option<f64>,
    /// Wall time without the effect over that with it. Not deterministic.
    pub seconds_ratio: Option<f64>,
    /// Whether the run without the effect says that the scene calls for it.
    pub caught: bool,
    /// What it says so by.
    pub indicator: Option<Indicator>,
    /// The verdict; `null` where nothing is expected.
    pub verdict: Option<Verdict>,
    /// What was found, in a sentence.
    pub why: String,
}

/// Judges one ablation.
pub fn judge(a: &Ablation) -> AblationJudgement {
    let over = |with: f64, without: f64| (with > 0.0).then_some(without / with);
    let changes = a.changes.iter().filter_map(|c| c.change);
    let judged = AblationJudgement {
        id: a.id.clone(),
        label: a.label.clone(),
        effect: a.effect.clone(),
        expected: a.expected,
        tolerance: a.tolerance,
        largest_change: changes.reduce(|m, c| if c.is_nan() { c } else { m.max(c) }),
        changes: a.changes.clone(),
        counters: [a.with.counter, a.without.counter],
        work_ratio: over(a.with.work.total() as f64, a.without.work.total() as f64),
        seconds_ratio: over(a.with.seconds, a.without.seconds),
        caught: a.without.called_for,
        indicator: a.without.indicator.clone(),
        verdict: None,
        why: String::new(),
    };
    if let Some(reason) = &a.failed {
        let verdict = a.expected.map(|_| Verdict::Undetermined);
        return AblationJudgement { verdict, why: format!("cannot be switched: {reason}"), ..judged };
    }
    let (verdict, why) = verdict(&judged, a.with.called_for);
    AblationJudgement { verdict, why, ..judged }
}

/// `in_vain`: whether the run with the effect is not trusted either.
fn verdict(a: &AblationJudgement, in_vain: bool) -> (Option<Verdict>, String) {
    let Some(change) = a.largest_change.filter(|c| c.is_finite()) else {
        return (a.expected.map(|_| Verdict::Undetermined), "no quantity could be compared".to_owned());
    };
    let matters = change > a.tolerance;
    let mut faults = Vec::new();
    if in_vain {
        faults.push("the run with it is not trusted either".to_owned());
    }
    if a.counters[1] != 0 {
        faults.push(format!("it still did {} units of work when it was off", a.counters[1]));
    }
    // Where nothing fires, being on is no work either.
    if a.expected == Some(Expected::IsCalledFor) && a.counters[0] == 0 {
        faults.push("it did no work when it was on".to_owned());
    }
    match a.expected {
        Some(Expected::MayBeLeftOut) => {
            if matters {
                faults
                    .push(format!("leaving it out changes a quantity by more than {}", percent(a.tolerance)));
            }
            if a.caught {
                faults.push("the guard calls for it".to_owned());
            }
            if a.work_ratio.is_some_and(|ratio| ratio > 1.0) {
                faults.push("leaving it out costs more".to_owned());
            }
        }
        Some(Expected::IsCalledFor) => {
            if !matters {
                faults.push("leaving it out changes nothing, so there is nothing to catch".to_owned());
            }
            if !a.caught {
                faults.push("the guard is silent".to_owned());
            }
        }
        None => {}
    }
    let verdict = a.expected.map(|_| if faults.is_empty() { Verdict::Pass } else { Verdict::Fail });
    let found = match (matters, a.caught) {
        (true, true) => "is called for, and a result without it is not trusted",
        (true, false) => "changes the answer, and no indicator tells",
        (false, true) => "hardly changes the answer, though its indicator is past the limit",
        (false, false) => "may be left out",
    };
    let why = format!("{found}: {} change", percent(change));
    let cost = a.work_ratio.map_or(String::new(), |r| format!(", {} of the work without it", share_of(r)));
    let faults = if faults.is_empty() { String::new() } else { format!("; {}", faults.join("; ")) };
    (verdict, format!("{why}{cost}{faults}"))
}

fn share_of(ratio: f64) -> String {
    format!("{} times", significant(ratio, 3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_cases::result::AblationRun;
    use seam_solver::work::Work;

    fn ablation(expected: Expected, change: f64, caught: bool) -> Ablation {
        let run = |counter, work, called_for| AblationRun {
            counter,
            called_for,
            work: Work { bond_updates: work, ..Work::default() },
            ..AblationRun::default()
        };
        Ablation {
            tolerance: 0.01,
            expected: Some(expected),
            with: run(5, 100, false),
            without: run(0, 50, caught),
            changes: vec![AblationChange { change: Some(change), ..AblationChange::default() }],
            ..Ablation::default()
        }
    }

    #[test]
    fn an_effect_may_be_left_out_only_where_nothing_changes_and_the_guard_is_silent() {
        use Expected::{IsCalledFor, MayBeLeftOut};
        let verdict = |a: &Ablation| judge(a).verdict.unwrap();
        assert_eq!(verdict(&ablation(MayBeLeftOut, 0.001, false)), Verdict::Pass);
        assert_eq!(verdict(&ablation(MayBeLeftOut, 0.1, false)), Verdict::Fail);
        assert_eq!(verdict(&ablation(MayBeLeftOut, 0.001, true)), Verdict::Fail);
        assert_eq!(verdict(&ablation(IsCalledFor, 0.1, true)), Verdict::Pass);
        assert_eq!(verdict(&ablation(IsCalledFor, 0.1, false)), Verdict::Fail, "the guard must speak");
        assert_eq!(verdict(&ablation(IsCalledFor, 0.001, true)), Verdict::Fail, "a false alarm");
    }

    #[test]
    fn an_effect_costs_nothing_when_it_is_off_and_does_its_work_when_it_is_on() {
        let mut busy = ablation(Expected::MayBeLeftOut, 0.0, false);
        busy.without.counter = 1;
        assert_eq!(judge(&busy).verdict, Some(Verdict::Fail));
        let mut dear = ablation(Expected::MayBeLeftOut, 0.0, false);
        dear.without.work.bond_updates = 101;
        assert_eq!(judge(&dear).verdict, Some(Verdict::Fail));
        let mut in_vain = ablation(Expected::IsCalledFor, 0.1, true);
        in_vain.with.called_for = true;
        assert_eq!(judge(&in_vain).verdict, Some(Verdict::Fail));
        let mut idle = ablation(Expected::IsCalledFor, 0.1, true);
        idle.with.counter = 0;
        assert_eq!(judge(&idle).verdict, Some(Verdict::Fail));
    }

    #[test]
    fn what_could_not_be_run_is_not_measured() {
        let failed = Ablation {
            failed: Some("no damping".to_owned()),
            ..ablation(Expected::MayBeLeftOut, 0.0, false)
        };
        assert_eq!(judge(&failed).verdict, Some(Verdict::Undetermined));
        assert_eq!(judge(&Ablation { expected: None, ..failed }).verdict, None);
        let nan = ablation(Expected::MayBeLeftOut, f64::NAN, false);
        assert_eq!(judge(&nan).verdict, Some(Verdict::Undetermined));
    }
}
