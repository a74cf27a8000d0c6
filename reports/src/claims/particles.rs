//! How many particles the paper-like setting needs to just meet its bound.

use super::settings::{ErrorBounds, Setting, settings};
use schemars::JsonSchema;
use seam_cases::result::Family;
use serde::{Deserialize, Serialize};

/// Number of particles at which the paper-like setting just meets the bound.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Needed {
    /// The upper bound of the error crosses the bound between two measured resolutions.
    About(f64),
    /// Already the coarsest measured resolution meets the bound.
    AtMost(f64),
    /// Not even the finest measured resolution meets the bound.
    MoreThan(f64),
}

impl Needed {
    /// The number that "at the same cost" is measured against. It never favours the claim: the smallest
    /// number the measurements allow.
    pub fn particles(self) -> f64 {
        match self {
            Needed::About(n) | Needed::AtMost(n) | Needed::MoreThan(n) => n,
        }
    }

    /// In words, e.g. `about 3400`.
    pub fn words(self) -> String {
        match self {
            Needed::About(n) => format!("about {n:.0} particles"),
            Needed::AtMost(n) => format!("at most {n:.0} particles"),
            Needed::MoreThan(n) => format!("more than {n:.0} particles"),
        }
    }
}

/// Resolution at which the paper-like setting just meets the bound of its claim, under the main reading.
///
/// Takes the settings that agree with `paper_like`, ordered by number of particles N, and interpolates the
/// 95 % upper bound of the error in `(ln N, ln e)` where it first comes down to the bound. `None` without
/// paper-like settings that were measured.
pub fn needed(family: &Family) -> Option<Needed> {
    let groups = settings(family);
    let like = |s: &&Setting<'_>| !family.paper_like.is_empty() && is_paper_like(family, s);
    let mut levels: Vec<(f64, ErrorBounds)> = groups
        .iter()
        .filter(like)
        .filter_map(|s| Some((s.particles(), s.error(&family.main_reading)?)))
        .filter(|(n, e)| *n > 0.0 && e.upper.is_finite())
        .collect();
    levels.sort_by(|a, b| a.0.total_cmp(&b.0));
    let first = levels.iter().position(|(_, e)| e.upper <= family.bound);
    match first {
        None => levels.last().map(|(n, _)| Needed::MoreThan(*n)),
        Some(0) => Some(Needed::AtMost(levels[0].0)),
        Some(i) => Some(Needed::About(crossing(levels[i - 1], levels[i], family.bound))),
    }
}

/// Whether a setting has the paper-like value on every axis that the paper-like setting names.
pub fn is_paper_like(family: &Family, setting: &Setting<'_>) -> bool {
    family.paper_like.iter().all(|(axis, value)| setting.values.get(axis) == Some(value))
}

fn crossing((n0, e0): (f64, ErrorBounds), (n1, e1): (f64, ErrorBounds), bound: f64) -> f64 {
    if e1.upper <= 0.0 {
        return n1;
    }
    let t = (e0.upper / bound).ln() / (e0.upper / e1.upper).ln();
    n0 * (n1 / n0).powf(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_cases::result::Member;

    /// Error 1/√N at the given resolutions, beside a setting that is not paper-like.
    fn family(resolutions: &[usize], bound: f64) -> Family {
        let member = |skin: &str, n: usize, e: f64| Member {
            settings: [("skin".to_owned(), skin.to_owned()), ("rows".to_owned(), n.to_string())].into(),
            errors: [("r".to_owned(), e)].into(),
            particles: n,
            ..Member::default()
        };
        let mut members = vec![member("weighted", 50, 1e-4)];
        members.extend(resolutions.iter().map(|&n| member("full", n, 1.0 / (n as f64).sqrt())));
        Family {
            bound,
            members,
            main_reading: "r".into(),
            paper_like: [("skin".into(), "full".into())].into(),
            ..Family::default()
        }
    }

    #[test]
    fn a_power_law_is_interpolated_exactly() {
        let Some(Needed::About(n)) = needed(&family(&[10, 1000, 100], 0.07)) else { panic!() };
        assert!((n - 1.0 / 0.07f64.powi(2)).abs() < 1e-9, "{n}");
    }

    #[test]
    fn outside_the_measured_range_only_a_side_is_known() {
        assert_eq!(needed(&family(&[100, 1000], 0.2)), Some(Needed::AtMost(100.0)));
        assert_eq!(needed(&family(&[100, 1000], 0.01)), Some(Needed::MoreThan(1000.0)));
        assert_eq!(needed(&family(&[], 0.01)), None);
    }
}
