//! What tests of whole cases share.

use seam_cases::catalogue;
use seam_cases::overrides::Override;
use seam_cases::procedures::run;
use seam_cases::result::CaseResult;
use seam_cases::scene::Tier;

/// A case of the catalogue in the quick tier, with some keys set.
pub fn changed(id: &str, changes: &[&str]) -> CaseResult {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    run(&catalogue::case(id, &changes).unwrap(), Tier::Quick).unwrap().result
}

/// Ids of the quantities outside of their interval, those that are known to fail left out.
pub fn outside(result: &CaseResult) -> Vec<&str> {
    let good = |value: f64, [low, high]: [f64; 2]| low <= value && value <= high;
    let judged = result.quantities.iter().filter(|q| !result.expected_failures.contains_key(&q.id));
    judged.filter(|q| q.accepted.is_some_and(|i| !good(q.value, i))).map(|q| q.id.as_str()).collect()
}
