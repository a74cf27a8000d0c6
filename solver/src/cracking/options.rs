//! Where a path stops, and what it refuses to start from.

use super::system::Updating;
use crate::error::{Error, Result};
use crate::failure::Failure;
use crate::model::{Model, Part};

/// Where to stop, and how to get there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// No event beyond this load factor.
    pub factor_limit: f64,
    /// At most so many events.
    pub events: usize,
    /// No further event once this share of the first stiffness, or less, is left.
    pub least_stiffness: f64,
    /// Sites whose demands agree within this relative tolerance fail in the order of their numbers: symmetric pairs break in a defined
    /// order. Far above the rounding of a solve, far below what scatter or geometry make of it.
    pub tie_tolerance: f64,
    /// When to update and when to factorise.
    pub updating: Updating,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            factor_limit: f64::INFINITY,
            events: usize::MAX,
            least_stiffness: 0.0,
            tie_tolerance: 1e-8,
            updating: Updating::default(),
        }
    }
}

/// Refuses laws that do not fit the model or have bonds that are no longer whole, and options out of range.
pub(super) fn check(model: &Model, laws: &[(usize, Failure)], options: &Options) -> Result<()> {
    check_fit(model, laws)?;
    let refuse = |message: String| Err(Error::Load { what: "cracking".to_owned(), message });
    if let Some((part, _)) = laws.iter().find(|(_, law)| law.integrity().iter().any(|g| *g != 1.0)) {
        let body = model.parts[*part].name();
        return refuse(format!("the failure law of body '{body}' has broken bonds; start with a new one"));
    }
    if !(0.0..0.1).contains(&options.tie_tolerance) {
        return refuse(format!("tie_tolerance = {}; give a small share like 1e-8", options.tie_tolerance));
    }
    if options.factor_limit.is_nan() || options.factor_limit <= 0.0 {
        return refuse(format!("factor_limit = {}; give a positive load factor", options.factor_limit));
    }
    if !(0.0..1.0).contains(&options.least_stiffness) {
        return refuse(format!(
            "least_stiffness = {}; give a share from zero to below one",
            options.least_stiffness
        ));
    }
    Ok(())
}

/// Refuses laws that do not fit the model.
pub(super) fn check_fit(model: &Model, laws: &[(usize, Failure)]) -> Result<()> {
    let refuse = |message: String| Err(Error::Load { what: "cracking".to_owned(), message });
    for (k, (part, failure)) in laws.iter().enumerate() {
        match model.parts.get(*part) {
            Some(Part::Discrete { network, .. }) if network.bonds.len() == failure.integrity().len() => {}
            Some(Part::Discrete { name, network }) => {
                return refuse(format!(
                    "the failure law of body '{name}' is made for {} bonds, the body has {}; make it for this network",
                    failure.integrity().len(),
                    network.bonds.len()
                ));
            }
            Some(Part::Continuum(body)) => {
                let name = &body.name;
                return refuse(format!("body '{name}' has elements; give failure laws to particles only"));
            }
            None => return refuse(format!("there is no part {part} for a failure law")),
        }
        if laws[..k].iter().any(|(other, _)| other == part) {
            return refuse(format!("body '{}' has two failure laws; give one", model.parts[*part].name()));
        }
    }
    Ok(())
}
