//! The reason of a verdict, in sentences.

use super::decides;
use super::particles::Needed;
use super::settings::{Outcome, Setting};
use super::{Judgement, ReadingResult};
use crate::format;
use crate::statistics::NORMAL_95;
use crate::verdict::ClaimVerdict;
use seam_cases::result::Family;

/// Why the judgement is what it is.
pub fn of(family: &Family, settings: &[Setting<'_>], limit: Option<Needed>, j: &Judgement) -> String {
    if let Some(what) = &j.unmeasured {
        return format!("Could not be measured: {what}.");
    }
    let mut sentences = vec![outcome(family, j)];
    if j.verdict == ClaimVerdict::Undetermined {
        sentences.push(what_would_decide(family, settings, j.most_particles));
    }
    if let (Some(limit), Some(claim)) = (limit, &family.no_more_particles_than) {
        sentences.push(same_cost(settings, limit, claim));
    }
    sentences.extend(decides::sentence(&j.decides, family.bound).map(|s| format!("{}.", capital(&s))));
    if let Some(needed) = j.needed.filter(|_| !family.own) {
        let bound = format::percent(family.bound);
        sentences.push(format!("The paper-like setting needs {} for {bound}.", needed.words()));
    }
    let failed = settings.iter().filter(|s| s.failed()).count();
    if failed > 0 {
        sentences.push(format!("{} could not be run.", capital(&format::count(failed, "setting"))));
    }
    sentences.join(" ")
}

fn outcome(family: &Family, j: &Judgement) -> String {
    let bound = format::percent(family.bound);
    let settings = format::count(j.settings, "setting");
    let readings = match j.readings.len() {
        1 => String::new(),
        n => format!(" under all {n} readings"),
    };
    match j.verdict {
        ClaimVerdict::Supported => {
            let who = if j.settings == 1 {
                "The only setting meets".to_owned()
            } else {
                format!("All {settings} meet")
            };
            format!("{who} {bound}{readings}; the largest error is {}.", worst(j))
        }
        ClaimVerdict::Contradicted => {
            format!("None of {settings} meets {bound}{readings}; the smallest error is {}.", best(j))
        }
        ClaimVerdict::Conditional => {
            format!("{} of {settings} meet {bound}{}.", format::share(j.share), other_readings(&j.readings))
        }
        ClaimVerdict::Undetermined => {
            let sum = |of: fn(&ReadingResult) -> usize| j.readings.iter().map(of).sum::<usize>();
            format!(
                "Of {} (settings times readings) {} meet {bound}, {} do not, and {} are not decided.",
                format::count(j.settings * j.readings.len(), "outcome"),
                sum(|r| r.meets),
                sum(|r| r.fails),
                sum(|r| r.unclear),
            )
        }
    }
}

fn other_readings(readings: &[ReadingResult]) -> String {
    let others = || readings.iter().filter(|r| !r.main).map(|r| r.share);
    let (lo, hi) = (others().fold(1.0, f64::min), others().fold(0.0, f64::max));
    match readings.len() {
        0 | 1 => String::new(),
        _ if format::share(lo) == format::share(hi) => {
            format!(" under the main reading, {} under the others", format::share(lo))
        }
        _ => format!(
            " under the main reading, {} to {} under the others",
            format::share(lo),
            format::share(hi)
        ),
    }
}

fn worst(j: &Judgement) -> String {
    format::percent(j.readings.iter().filter_map(|r| r.errors).map(|[_, hi]| hi).fold(0.0, f64::max))
}

fn best(j: &Judgement) -> String {
    format::percent(
        j.readings.iter().filter_map(|r| r.errors).map(|[lo, _]| lo).fold(f64::INFINITY, f64::min),
    )
}

/// How many more seeds would decide, or by how much the uncertainty would have to fall.
fn what_would_decide(family: &Family, settings: &[Setting<'_>], most_particles: Option<f64>) -> String {
    let mut seeds: Option<usize> = None;
    let mut uncertainty: Option<f64> = None;
    for (setting, reading) in settings.iter().flat_map(|s| family.readings.keys().map(move |r| (s, r))) {
        if setting.outcome(reading, family.bound, most_particles) != Outcome::Unclear {
            continue;
        }
        if let Some(n) = setting.seeds_to_decide(reading, family.bound) {
            seeds = seeds.max(Some(n));
        } else if let Some(e) = setting.error(reading).filter(|_| setting.uncertainty() > 0.0) {
            let u = (e.mean - family.bound).abs() / NORMAL_95;
            uncertainty = Some(uncertainty.map_or(u, |v| v.min(u)));
        }
    }
    match (seeds, uncertainty) {
        (Some(n), _) => format!("{n} seeds per packing would decide more of them."),
        (None, Some(u)) => {
            format!(
                "More levels that bring the standard uncertainty below {} would decide.",
                format::percent(u)
            )
        }
        (None, None) => "Scatter, not the number of seeds, leaves them open.".to_owned(),
    }
}

fn same_cost(settings: &[Setting<'_>], limit: Needed, claim: &str) -> String {
    let most = settings.iter().map(Setting::particles).fold(0.0, f64::max);
    let ratio = limit.particles() / most;
    let times = match limit {
        Needed::About(_) => format!("{} times", format::significant(ratio, 2)),
        Needed::AtMost(_) => format!("at most {} times", format::significant(ratio, 2)),
        Needed::MoreThan(_) => format!("more than {} times", format::significant(ratio, 2)),
    };
    format!(
        "At {most:.0} particles; the paper-like setting needs {} for the bound of '{claim}', {times} as many.",
        limit.words()
    )
}

/// First letter in upper case.
fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}
