//! Tolerances that have become wider than they were: a bot is not to be quieted by moving the bound.

use crate::format::{percent, with_unit};
use crate::results::QuantityResult;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A width may grow by this share before it counts as loosened: an interval around a reference that is
/// computed anew moves with it, and no such reference moves by a hundredth unseen.
const SLACK: f64 = 0.01;

/// A tolerance that is wider than it was, or gone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Loosened {
    /// Id of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Whether both widths are shares of the reference rather than in the unit.
    pub relative: bool,
    /// [`width`] as it was.
    pub was: f64,
    /// As it is; `null` if the quantity is judged no more.
    pub now: Option<f64>,
}

/// Half of the accepted interval: as a share of the reference where there is one, else in the unit of the
/// quantity. `None` where nothing is judged, or not on both sides.
pub fn width(q: &QuantityResult) -> Option<f64> {
    let [Some(low), Some(high)] = q.accepted? else { return None };
    let half = 0.5 * (high - low);
    Some(scale(q).map_or(half, |scale| half / scale))
}

fn scale(q: &QuantityResult) -> Option<f64> {
    q.reference.map(f64::abs).filter(|scale| *scale > 0.0)
}

/// Compares the accepted intervals of a case with those recorded for it, by quantity.
pub fn loosened(recorded: Option<&BTreeMap<String, f64>>, quantities: &[QuantityResult]) -> Vec<Loosened> {
    let compare = |(id, &was): (&String, &f64)| {
        let quantity = quantities.iter().find(|q| q.id == *id);
        let now = quantity.and_then(width);
        let unit = quantity.map_or_else(|| "1".to_owned(), |q| q.unit.clone());
        let relative = quantity.and_then(scale).is_some();
        let wider = now.is_none_or(|now| now > was * (1.0 + SLACK));
        wider.then(|| Loosened { quantity: id.clone(), unit, relative, was, now })
    };
    recorded.into_iter().flatten().filter_map(compare).collect()
}

impl Loosened {
    /// A width in words: `± 0.5 %` of a reference, `± 0.004 m`.
    pub fn say(&self, width: f64) -> String {
        if self.relative {
            format!("± {}", percent(width))
        } else {
            format!("± {}", with_unit(width, &self.unit))
        }
    }

    /// What is accepted now.
    pub fn say_now(&self) -> String {
        self.now.map_or_else(|| "no longer judged".to_owned(), |now| self.say(now))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(id: &str, reference: Option<f64>, accepted: [f64; 2]) -> QuantityResult {
        QuantityResult {
            id: id.to_owned(),
            unit: "m".to_owned(),
            reference,
            accepted: Some(accepted.map(Some)),
            ..QuantityResult::default()
        }
    }

    fn found(was: f64, now: QuantityResult) -> Vec<String> {
        let recorded = [("tip".to_owned(), was)].into();
        loosened(Some(&recorded), &[now])
            .iter()
            .map(|l| format!("{} to {}", l.say(l.was), l.say_now()))
            .collect()
    }

    #[test]
    fn wider_is_loosened_and_narrower_or_moved_is_not() {
        let about = |half: f64| judged("tip", Some(-2.0), [-2.0 - half, -2.0 + half]);
        assert_eq!(found(0.01, about(0.1)), ["± 1 % to ± 5 %"]);
        assert_eq!(found(0.01, about(0.02)), [""; 0]);
        assert_eq!(found(0.01, about(0.001)), [""; 0]);
        assert_eq!(found(0.5, judged("tip", None, [3.0, 4.0])), [""; 0]);
        assert_eq!(found(0.5, judged("tip", None, [3.0, 4.2])), ["± 0.5 m to ± 0.6 m"]);
    }

    #[test]
    fn a_tolerance_that_is_gone_is_the_loosest() {
        let shown = QuantityResult { accepted: None, ..judged("tip", None, [0.0, 1.0]) };
        assert_eq!(found(0.5, shown), ["± 0.5 m to no longer judged"]);
        assert_eq!(found(0.5, judged("other", None, [0.0, 1.0])), ["± 0.5 to no longer judged"]);
        let open = QuantityResult { accepted: Some([None, Some(1.0)]), ..judged("tip", None, [0.0, 1.0]) };
        assert_eq!(found(0.5, open).len(), 1, "one-sided");
    }
}
