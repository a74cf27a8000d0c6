//! What a verdict means for someone who wants to rely on the claim, in one paragraph.

use super::decides::{AxisEffect, READING, with_value, words};
use super::particles::Needed;
use crate::format::{self, percent, share};
use crate::results::ClaimResult;
use crate::verdict::ClaimVerdict;

/// The answer to "does it hold?", for a heading.
pub fn headline(c: &ClaimResult) -> String {
    let met = format!("{} of {}", share(c.share), format::count(c.settings, "setting"));
    match c.verdict {
        ClaimVerdict::Supported => format!("{} holds in every setting tried", percent(c.bound)),
        ClaimVerdict::Contradicted => format!("{} holds in no setting tried", percent(c.bound)),
        ClaimVerdict::Conditional => format!("{} holds in {met}", percent(c.bound)),
        ClaimVerdict::Undetermined => format!("whether {} holds is not decided", percent(c.bound)),
    }
}

/// One paragraph for a reader who has to decide whether to rely on the claim.
pub fn paragraph(c: &ClaimResult) -> String {
    if let Some(what) = &c.unmeasured {
        return format!("Nothing can be said: {what}.");
    }
    let mut sentences = vec![reliance(c)];
    let axis = c.decides.iter().find(|a| a.axis != READING);
    if c.verdict == ClaimVerdict::Conditional {
        sentences.extend(axis.and_then(condition));
    }
    if !c.own {
        sentences.extend(c.needed.map(|n| paper_like(c, n)));
    }
    if !c.complete {
        sentences.push(match &c.recorded_full {
            Some(full) => format!(
                "This run tries a stated subset of the family; over the whole of it, as recorded, {} of the settings meet {} ({}).",
                share(full.share),
                percent(c.bound),
                full.verdict
            ),
            None => "This run tries a stated subset of the family.".to_owned(),
        });
    }
    sentences.join(" ")
}

fn reliance(c: &ClaimResult) -> String {
    let bound = percent(c.bound);
    match (c.own, c.verdict) {
        (false, ClaimVerdict::Supported) => {
            format!(
                "A user may count on {bound}: no setting and no reading of the metric was found that misses it."
            )
        }
        (true, ClaimVerdict::Supported) => {
            format!(
                "Seam promises {bound} for these settings and keeps it under every reading of the metric."
            )
        }
        (_, ClaimVerdict::Contradicted) => {
            format!(
                "A user must not count on {bound}: no setting and no reading of the metric was found that meets it."
            )
        }
        (false, ClaimVerdict::Conditional) => format!(
            "{bound} is no property of the method. A model of this kind may meet it or miss it, depending on how it is set up."
        ),
        (true, ClaimVerdict::Conditional) => {
            format!("Seam promises {bound} for these settings and does not keep it in all of them.")
        }
        (_, ClaimVerdict::Undetermined) => {
            format!("The evidence does not tell whether {bound} holds: bound and uncertainty overlap.")
        }
    }
}

/// The axis that decides: what to do, and what to avoid.
fn condition(axis: &AxisEffect) -> Option<String> {
    let (best, worst) = (axis.values.first()?, axis.values.last()?);
    if axis.moves <= 0.0 {
        return None;
    }
    let name = words(&axis.axis);
    Some(format!(
        "What decides most is {name}: with {} it holds in {} of the settings, with {} in {} of those that agree in everything else.",
        with_value(&name, &best.value),
        share(best.share),
        with_value(&name, &worst.value),
        share(worst.share)
    ))
}

fn paper_like(c: &ClaimResult, needed: Needed) -> String {
    let bound = percent(c.bound);
    match needed {
        Needed::About(_) => format!(
            "Set up as the paper most likely was, the model meets {bound} from {} on.",
            needed.words()
        ),
        Needed::AtMost(n) => format!(
            "Set up as the paper most likely was, the model meets {bound} already with {n:.0} particles, the coarsest tried here."
        ),
        Needed::MoreThan(n) => {
            format!(
                "Set up as the paper most likely was, the model misses {bound} up to {n:.0} particles, the finest tried here."
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::decides::AxisValue;

    fn claim(verdict: ClaimVerdict, own: bool) -> ClaimResult {
        let value = |value: &str, share| AxisValue { value: value.into(), share, error: None, settings: 4 };
        let skin = AxisEffect {
            axis: "skin".into(),
            moves: 0.5,
            ratio: 3.0,
            values: vec![value("weighted", 1.0), value("full", 0.5)],
        };
        ClaimResult {
            verdict,
            own,
            bound: 0.07,
            share: 0.75,
            settings: 8,
            complete: true,
            decides: vec![skin],
            needed: Some(Needed::About(158.0)),
            ..ClaimResult::default()
        }
    }

    #[test]
    fn each_verdict_has_its_own_advice() {
        use ClaimVerdict::{Conditional, Contradicted, Supported, Undetermined};
        let all = [Supported, Contradicted, Conditional, Undetermined];
        let texts: Vec<String> =
            all.iter().flat_map(|v| [false, true].map(|own| paragraph(&claim(*v, own)))).collect();
        let mut different = texts.clone();
        different.sort();
        different.dedup();
        // Own and paper's claims that are contradicted or undetermined differ in the paper-like sentence only.
        assert_eq!(different.len(), texts.len(), "{texts:#?}");
        assert!(texts.iter().all(|t| t.contains("7 %")), "{texts:#?}");
    }

    #[test]
    fn a_conditional_claim_says_on_what_it_depends() {
        let text = paragraph(&claim(ClaimVerdict::Conditional, false));
        assert!(text.contains("with weighted skin it holds in 100 %"), "{text}");
        assert!(text.contains("with full skin in 50 %"), "{text}");
        assert!(text.contains("from about 158 particles on"), "{text}");
    }
}
