//! From `[cracking]` to a path of events of the solver.

use super::blueprint::Blueprint;
use super::particles::{self, Filled};
use super::switches::{solver_criterion, through};
use super::{Built, Context, Refusal, conditions, failure};
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::scene::cracking::Cracking;
use crate::scene::switch::Switch;
use seam_solver::cracking::Options;
use seam_solver::cracking::adaptive::{self, Adaptive, Growth};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::error::Error;
use std::collections::BTreeSet;

/// Runs a scene until nothing more fails or a limit is met; `watch` sees it before the first event and after every one.
/// The notes of `built` grow by what was packed.
///
/// # Errors
/// A fault of the scene that only shows here, what the solver refuses.
pub fn run<T>(
    file: &SceneFile,
    cracking: &Cracking,
    built: &mut Built,
    watch: &mut dyn FnMut(&Adaptive),
    end: impl FnOnce(Adaptive) -> T,
) -> Result<T> {
    follow(file, cracking, built, watch, end).map_err(|refusal| refusal.of(file))
}

fn follow<T>(
    file: &SceneFile,
    cracking: &Cracking,
    built: &mut Built,
    watch: &mut dyn FnMut(&Adaptive),
    end: impl FnOnce(Adaptive) -> T,
) -> std::result::Result<T, Refusal> {
    let context = Context::new(file)?;
    let options = Options {
        events: cracking.events.count(context.values, 1, "cracking.events")?,
        factor_limit: match &cracking.factor_limit {
            Some(limit) => limit.value(context.values, "cracking.factor_limit")?,
            None => f64::INFINITY,
        },
        least_stiffness: cracking.least_stiffness.value(context.values, "cracking.least_stiffness")?,
        ..Options::default()
    };
    let switch = context.scene.switches.iter().next();
    let prepared = switch.map(|(name, s)| prepare(&context, name, s, &mut built.notes)).transpose()?;
    let fill = |block: Block, _: Matter| match &prepared {
        Some((blueprint, name, switch)) => fill(&context, name, switch, blueprint, &block),
        None => Err(Error::Switch { what: "region".to_owned(), message: "no switch fills it".to_owned() }),
    };
    let growth = switch.map(|(name, switch)| growth(&context, name, switch, &fill)).transpose()?;
    let mut path = Adaptive::new(&built.model, built.laws.clone(), growth, options)?;
    watch(&path);
    while path.advance()?.is_some() {
        watch(&path);
    }
    built.calibration += context.calibration.get();
    Ok(end(path))
}

type Prepared<'a> = (Blueprint, &'a str, &'a Switch);

fn prepare<'a>(
    context: &Context,
    name: &'a str,
    switch: &'a Switch,
    notes: &mut Vec<String>,
) -> std::result::Result<Prepared<'a>, Refusal> {
    let (key, body) = (format!("switches.{name}"), &context.scene.bodies[&switch.body]);
    let Some(whole) = particles::block(context, &switch.body, body)? else {
        let message = format!("body '{}' is no box, so its lattice is not known", switch.body);
        let mend = "switch a body with the shape `box` or `notched_beam`";
        return Err(Fault::new(format!("{key}.body"), message, mend).into());
    };
    Ok((Blueprint::new(context, &key, (body, &switch.de), whole, notes)?, name, switch))
}

fn growth<'a>(
    context: &Context,
    name: &str,
    switch: &Switch,
    fill: &'a dyn Fn(Block, Matter) -> seam_solver::error::Result<adaptive::Filled>,
) -> std::result::Result<Growth<'a>, Refusal> {
    let key = format!("switches.{name}.criterion");
    let Some(criterion) = &switch.criterion else {
        return Err(Fault::new(key, "the criterion is missing", "add it").into());
    };
    let holds = match &criterion.holds {
        None => None,
        Some(given) => {
            let min = context.vector(&given.min, &format!("{key}.holds.min"))?;
            let max = context.vector(&given.max, &format!("{key}.holds.max"))?;
            Some(Block::new(context.space, min, max)?)
        }
    };
    Ok(Growth {
        name: name.to_owned(),
        body: switch.body.clone(),
        criterion: solver_criterion(context, criterion, &key)?,
        stride_m: match &criterion.stride_m {
            Some(stride) => stride.value(context.values, &format!("{key}.stride_m"))?,
            None => 0.0,
        },
        holds,
        through: through(criterion),
        most: criterion.most.count(context.values, 1, &format!("{key}.most"))?,
        fill,
        method: conditions::method(switch.ties.method),
        multipliers: conditions::multipliers(switch.ties.multipliers),
        rotations: switch.ties.rotations,
    })
}

/// Particles of a box with the law of the body.
fn fill(
    context: &Context,
    name: &str,
    switch: &Switch,
    blueprint: &Blueprint,
    block: &Block,
) -> seam_solver::error::Result<adaptive::Filled> {
    let made = || -> std::result::Result<(Filled, _), Refusal> {
        let body = &context.scene.bodies[&switch.body];
        let filled = blueprint.fill(context, block)?;
        let key = format!("bodies.{}", switch.body);
        let filled = particles::without_notch(context, &key, body, filled, block)?;
        let law = failure::of_body(&context.scene.failure, &switch.body);
        let law = law.map(|given| failure::law(context, given, &filled, &BTreeSet::new())).transpose()?;
        Ok((filled, law))
    };
    made()
        .map(|(filled, failure)| adaptive::Filled { network: filled.network, failure })
        .map_err(|refusal| refusal.of_switch(name))
}
