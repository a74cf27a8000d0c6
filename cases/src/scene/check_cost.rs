//! Checks of `[costs.NAME]`: what is measured, over which settings, and what is promised of it.

use super::Scene;
use super::check::{Checked, known};
use super::check_study::{levels, variants};
use super::study::CostDeclaration;
use crate::error::Fault;
use crate::result::{Cheaper, PAPER_LIKE};

/// Checks the cost diagrams of a scene.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene) -> Checked {
    for (name, cost) in &scene.costs {
        let key = format!("costs.{name}");
        known(&cost.quantity, "quantity", scene.quantities.keys(), &format!("{key}.quantity"))?;
        variants(scene, &cost.variants, &format!("{key}.variants"))?;
        levels(&cost.levels, 1, &format!("{key}.levels"))?;
        if let Some(reference) = &cost.reference {
            variants(scene, &reference.variants, &format!("{key}.reference.variants"))?;
            levels(&reference.levels, 1, &format!("{key}.reference.levels"))?;
        }
        for (setting, names) in &cost.settings {
            variants(scene, names, &format!("{key}.settings.{setting}"))?;
        }
        cost.cheaper.as_ref().map_or(Ok(()), |promise| check_cheaper(cost, promise, &key))?;
    }
    Ok(())
}

/// A promise against the paper-like setting needs that setting, an accuracy and both ends of its interval.
fn check_cheaper(cost: &CostDeclaration, promise: &Cheaper, key: &str) -> Checked {
    let key = format!("{key}.cheaper");
    if !cost.settings.contains_key(PAPER_LIKE) {
        let message = format!("no setting is called '{PAPER_LIKE}'");
        return Err(Fault::new(key, message, "add it to `settings`, or take the promise out"));
    }
    if !(promise.error > 0.0 && promise.error < 1.0) {
        let message = format!("{} is no accuracy", promise.error);
        return Err(Fault::new(format!("{key}.error"), message, "give a fraction between 0 and 1"));
    }
    let [low, high] = promise.times;
    if !(0.0 < low && low < high && high.is_finite()) {
        let mend = "give two positive numbers, the smaller one first";
        return Err(Fault::new(format!("{key}.times"), "the interval is empty", mend));
    }
    if promise.why.trim().is_empty() {
        let message = "a tolerance needs its reason";
        return Err(Fault::new(format!("{key}.why"), message, "say why it is this wide"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::catalogue;
    use crate::overrides::Override;

    #[test]
    fn a_promise_that_says_nothing_is_refused() {
        let refused = |diagram: &str, promise: &str| {
            let change = Override::parse(&format!("costs.{diagram}.cheaper={promise}")).unwrap();
            let id = if diagram == "rotation" { "clamped-beam-rotation" } else { "ramp-transfer" };
            catalogue::case(id, &[change]).err().map(|e| format!("{e:?}")).unwrap_or_default()
        };
        let good = r#"{ error = 0.07, times = [2, 100], why = "chosen" }"#;
        assert_eq!(refused("rotation", good), "");
        assert!(refused("rates", good).contains("no setting is called 'paper-like'"));
        for (bad, message) in [
            (r#"{ error = 0, times = [2, 100], why = "chosen" }"#, "0 is no accuracy"),
            (r#"{ error = 0.07, times = [100, 2], why = "chosen" }"#, "the interval is empty"),
            (r#"{ error = 0.07, times = [2, inf], why = "chosen" }"#, "expected f64"),
            (r#"{ error = 0.07, times = [2, 100], why = " " }"#, "a tolerance needs its reason"),
        ] {
            let said = refused("rotation", bad);
            assert!(said.contains(message), "'{message}' is not in: {said}");
        }
    }
}
