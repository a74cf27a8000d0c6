//! Refinement studies.

use super::evaluate;
use super::richardson::{Estimate, extrapolate};
use super::{Study, at_level};
use crate::error::Result;
use crate::result;
use crate::scene::study::Convergence;
use std::collections::BTreeMap;

/// A refinement study of one quantity.
pub struct Refined {
    /// For the report.
    pub result: result::Convergence,
    /// From the three finest levels.
    pub estimate: Estimate,
}

/// All refinement studies, by quantity.
pub fn all(study: &Study) -> Result<BTreeMap<String, Refined>> {
    let mut refined = BTreeMap::new();
    for (name, declared) in &study.file.scene.convergence {
        refined.insert(declared.quantity.clone(), one(study, name, declared)?);
    }
    Ok(refined)
}

fn one(study: &Study, name: &str, declared: &Convergence) -> Result<Refined> {
    let quantity = &study.file.scene.quantities[&declared.quantity];
    let (mut h, mut values) = (Vec::new(), Vec::new());
    for value in &declared.levels.values {
        let file = study.file.with(&[at_level(&declared.levels, value)])?;
        let key = format!("convergence.{name}.cell_m");
        h.push(declared.cell_m.value(&file.values, &key).map_err(|fault| file.error(fault))?);
        let solved = evaluate::solve(&file, study.tally)?;
        let found = solved.readings.value(quantity);
        values.push(found.ok_or_else(|| study.error(format!("convergence '{name}' needs a scalar probe")))?);
    }
    let n = values.len();
    let ratios = [h[n - 3] / h[n - 2], h[n - 2] / h[n - 1]];
    // Below 1.3 differences drown in what the levels do not share (Celik et al. 2008).
    if ratios.iter().any(|r| *r < 1.3) {
        return Err(
            study.error(format!("convergence '{name}': levels must refine the cells by 1.3 or more each"))
        );
    }
    let estimate = extrapolate([values[n - 3], values[n - 2], values[n - 1]], ratios, declared.formal_order);
    let exact = quantity.reference.as_ref().and_then(|r| r.value.as_ref());
    let error = match (exact, quantity.reference.is_some()) {
        (Some(number), _) => {
            let key = format!("quantities.{}.reference.value", declared.quantity);
            let exact = number.value(&study.file.values, &key).map_err(|fault| study.file.error(fault))?;
            values.iter().map(|v| (v - exact).abs()).collect()
        }
        // The value is itself an error.
        (None, false) => values.clone(),
        (None, true) => values.iter().map(|v| (v - estimate.value).abs()).collect(),
    };
    let result = result::Convergence {
        id: declared.quantity.clone(),
        label: quantity.label.clone(),
        h,
        error,
        formal_order: declared.formal_order,
        tolerance: declared.tolerance,
    };
    Ok(Refined { result, estimate })
}
