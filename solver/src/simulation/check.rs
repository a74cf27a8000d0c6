//! What a plan must satisfy before anything runs.

use super::plan::{Plan, Step, Stepping, SwitchRule, When};
use super::switching::body_of;
use crate::dynamics::damping::Damping;
use crate::dynamics::forces::Rotations;
use crate::dynamics::newmark::Scheme;
use crate::error::{Error, Result};
use crate::model::{Model, Part};
use crate::transfer::region::Region;

/// Checks a plan against the model it starts from.
///
/// # Errors
/// The first thing that does not fit.
pub(super) fn plan(model: &Model, plan: &Plan) -> Result<()> {
    crate::check::model(model)?;
    positive("run", "end_s", plan.end_s, "give a positive time in seconds")?;
    if plan.outputs == 0 {
        return Err(number("run", "outputs", 0.0, "give at least one interval"));
    }
    plan.loads.check("loads", plan.end_s)?;
    stepping(plan)?;
    damping(plan)?;
    rotations(model, plan)?;
    breaking(plan)?;
    plan.switches.iter().enumerate().try_for_each(|(k, _)| rule(model, plan, k))
}

fn number(what: &str, name: &'static str, value: f64, mend: &'static str) -> Error {
    Error::Material { what: what.to_owned(), name, value, mend }
}

fn positive(what: &str, name: &'static str, value: f64, mend: &'static str) -> Result<()> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(number(what, name, value, mend)) }
}

fn stepping(plan: &Plan) -> Result<()> {
    let seconds = |value| positive("time stepping", "step_s", value, "give a positive step in seconds");
    let length = |step: Step| match step {
        Step::Seconds(value) => seconds(value),
        Step::ShareOfCritical(share) if share > 0.0 && share <= 1.0 => Ok(()),
        Step::ShareOfCritical(share) => Err(number(
            "time stepping",
            "share of the critical step",
            share,
            "give a number above zero, at most one",
        )),
    };
    match plan.stepping {
        Stepping::QuasiStatic { step_s } => {
            if plan.initial_velocity.is_some() {
                let message = "an initial velocity has no meaning in a quasi-static run; leave it out, or step with inertia";
                return Err(Error::Load { what: "initial velocity".to_owned(), message: message.to_owned() });
            }
            seconds(step_s)
        }
        Stepping::Implicit { scheme: parameters, step_s } => {
            scheme(parameters)?;
            seconds(step_s)
        }
        Stepping::Explicit { step } => length(step),
        Stepping::TwoRates { scheme: parameters, step_s, fine, .. } => {
            if parameters != Scheme::TRAPEZOIDAL {
                return Err(number(
                    "two rates",
                    "beta",
                    parameters.beta,
                    "two rates know the trapezoidal rule for the elements: beta = 1/4, gamma = 1/2, alpha = 0; take it, or implicit \
                     steps for all",
                ));
            }
            seconds(step_s)?;
            length(fine)
        }
    }
}

/// Newmark's method is stable at any step for `2β ≥ γ ≥ ½`.
fn scheme(Scheme { beta, gamma, alpha }: Scheme) -> Result<()> {
    let bad = |name, value, mend| Err(number("implicit scheme", name, value, mend));
    if !(gamma.is_finite() && gamma >= 0.5) {
        return bad("gamma", gamma, "give 1/2 or more: less adds energy");
    }
    if !(beta.is_finite() && 2.0 * beta >= gamma) {
        return bad(
            "beta",
            beta,
            "give at least half of gamma, so that it is stable at any step; step explicitly for zero",
        );
    }
    if !(-1.0 / 3.0..=0.0).contains(&alpha) {
        return bad("alpha", alpha, "give a number from -1/3 (most damping) to 0 (none)");
    }
    Ok(())
}

fn damping(plan: &Plan) -> Result<()> {
    plan.damping.check()?;
    let refuse = |name, value, mend| Err(number("damping", name, value, mend));
    match (plan.stepping, plan.damping) {
        (_, Damping::None) | (Stepping::Explicit { .. }, _) => Ok(()),
        (Stepping::Implicit { .. }, Damping::MassProportional { .. }) => Ok(()),
        (Stepping::QuasiStatic { .. }, Damping::MassProportional { rate }) => {
            refuse("rate", rate, "quasi-static steps have nothing to damp; leave it out")
        }
        (Stepping::TwoRates { .. }, Damping::MassProportional { rate }) => refuse(
            "rate",
            rate,
            "two rates know no damping; leave it out, or step implicitly or explicitly throughout",
        ),
        (_, Damping::NonViscous { share }) => refuse(
            "share",
            share,
            "local damping needs explicit steps; take these, or mass-proportional damping with implicit steps",
        ),
    }
}

fn rotations(model: &Model, plan: &Plan) -> Result<()> {
    if plan.rotations == Rotations::Small {
        return Ok(());
    }
    let refuse = |body: &Part, message: &str| {
        Err(Error::Formulation { body: body.name().to_owned(), message: message.to_owned() })
    };
    if let Some(body) = model.parts.iter().find(|p| matches!(p, Part::Continuum(_))) {
        return refuse(
            body,
            "its elements know small strains and rotations only; take small rotations, or replace it by particles",
        );
    }
    match plan.stepping {
        Stepping::Explicit { .. } => Ok(()),
        _ => refuse(
            &model.parts[0],
            "finite rotations of its particles need explicit steps; take these, or small rotations",
        ),
    }
}

/// Bonds break between explicit steps, in networks that stay.
fn breaking(plan: &Plan) -> Result<()> {
    let refuse =
        |message: &str| Err(Error::Load { what: "breaking bonds".to_owned(), message: message.to_owned() });
    if plan.laws.is_empty() {
        return match plan.contact {
            Some(_) => {
                refuse("particles touch only where bonds may break; give failure laws, or leave contact out")
            }
            None => Ok(()),
        };
    }
    if !matches!(plan.stepping, Stepping::Explicit { .. }) {
        return refuse("bonds break between explicit steps only; take these, or crack by events");
    }
    if !plan.switches.is_empty() {
        return refuse("a run that switches does not break bonds; start with particles, or crack by events");
    }
    Ok(())
}

fn rule(model: &Model, plan: &Plan, index: usize) -> Result<()> {
    let rule = &plan.switches[index];
    let SwitchRule { name, when, .. } = rule;
    let refuse = |message: String| Err(Error::Switch { what: format!("rule '{name}'"), message });
    if plan.switches[..index].iter().any(|other| other.name == *name) {
        return refuse("another rule has this name; give every rule a name of its own".to_owned());
    }
    if model.parts.iter().any(|p| p.name() == name) {
        return refuse("a body has this name; give the rule a name of its own".to_owned());
    }
    let body = body_of(model, rule)?;
    let end_s = plan.end_s;
    match when {
        When::Time { time_s, block } => {
            if !(0.0..=end_s).contains(time_s) {
                return refuse(format!(
                    "it switches at {time_s} s, the run goes from 0 to {end_s} s; switch within it"
                ));
            }
            Region::in_box(body, *block).map(|_| ())
        }
        When::LoadLevel { factor, block } => {
            if !factor.is_finite() || plan.loads.first_reaches(*factor, end_s).is_none() {
                return refuse(format!(
                    "the load factor does not reach {factor} before the end at {end_s} s; lower the level or run longer"
                ));
            }
            Region::in_box(body, *block).map(|_| ())
        }
        When::Criterion { criterion, every_s, most, .. } => {
            criterion.check()?;
            if !(*every_s > 0.0 && *every_s <= end_s) {
                return refuse(format!(
                    "it is asked every {every_s} s; give a positive time, at most the {end_s} s of the run"
                ));
            }
            if *most == 0 {
                return refuse("it may switch 0 times; allow at least one".to_owned());
            }
            Ok(())
        }
    }
}
