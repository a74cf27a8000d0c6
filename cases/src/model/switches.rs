//! `[switches.NAME]` as rules of a run, with particles packed beforehand.

use super::place::part_of;
use super::{Context, Refusal, conditions, particles};
use crate::error::Fault;
use crate::file::SceneFile;
use crate::observe::guard::LeftOut;
use crate::scene::number::Number;
use crate::scene::switch::{Axis, Criterion, Switch};
use seam_solver::dem::block::Block;
use seam_solver::dem::network::Network;
use seam_solver::error::Result;
use seam_solver::model::{Model, Part};
use seam_solver::simulation::{SwitchRule, When};
use seam_solver::transfer::criterion::{self, Indicator, Memory};
use seam_solver::transfer::region::Region;
use std::cell::RefCell;

/// What a switch needs to pack particles while the run goes on.
pub struct Filling<'a> {
    context: &'a Context<'a>,
    name: &'a str,
    switch: &'a Switch,
    /// Height of the whole body, in m: `rows` count across it.
    height: f64,
    when: When,
    /// Packings so far: packing is not part of a switch's time.
    packed: RefCell<Vec<(Block, Network)>>,
    notes: RefCell<Vec<String>>,
}

impl<'a> Filling<'a> {
    /// Finds the place of a switch, and packs its particles where the place is known beforehand.
    pub fn new(
        context: &'a Context,
        model: &Model,
        name: &'a str,
        switch: &'a Switch,
    ) -> std::result::Result<Self, Refusal> {
        let part = &model.parts[part_of(context, &switch.body)];
        let (low, high) = part
            .positions()
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x.y), high.max(x.y)));
        let filling = Self {
            context,
            name,
            switch,
            height: high - low,
            when: when(context, part, name, switch)?,
            packed: RefCell::default(),
            notes: RefCell::default(),
        };
        if let When::Time { block, .. } | When::LoadLevel { block, .. } = &filling.when {
            filling.pack(*block)?;
        }
        Ok(filling)
    }

    /// The rule; `fill` is [`Filling::fill`] of this switch.
    pub fn rule<'b>(
        &self,
        fill: &'b dyn Fn(Block, seam_solver::dem::arrangement::Matter) -> Result<Network>,
    ) -> SwitchRule<'b> {
        let ties = self.switch.ties;
        SwitchRule {
            name: self.name.to_owned(),
            body: self.switch.body.clone(),
            when: self.when.clone(),
            fill,
            method: conditions::method(ties.method),
            multipliers: conditions::multipliers(ties.multipliers),
            rotations: ties.rotations,
            mode: self.switch.fields.into(),
            // Elements know small rotations only, so there are none to decompose.
            finite: false,
        }
    }

    /// Particles for a box, from the store if they have been packed before.
    ///
    /// # Errors
    /// What packing or calibration refuses.
    pub fn fill(&self, block: Block) -> Result<Network> {
        self.pack(block).map_err(|refusal| refusal.of_switch(self.name))
    }

    fn pack(&self, block: Block) -> std::result::Result<Network, Refusal> {
        if let Some((_, network)) = self.packed.borrow().iter().find(|(known, _)| *known == block) {
            return Ok(network.clone());
        }
        let (context, de) = (self.context, &self.switch.de);
        let key = format!("switches.{}", self.name);
        let rows = de.rows.count(context.values, 1, &format!("{key}.de.rows"))? as f64;
        // A lower region gets as many rows as keep the spacing.
        let own_rows = (rows * block.sides().y / self.height).round().max(1.0) as usize;
        let body = &context.scene.bodies[&self.switch.body];
        let mut notes = self.notes.borrow_mut();
        let filled = particles::fill(context, &key, (body, de), (block, own_rows), &mut notes)?;
        let mut network = particles::without_notch(context, &key, body, filled, &block)?.network;
        context.file.spoil_network(&mut network);
        self.packed.borrow_mut().push((block, network.clone()));
        Ok(network)
    }

    /// What was packed and calibrated.
    pub fn into_notes(self) -> Vec<String> {
        self.notes.into_inner()
    }
}

fn when(context: &Context, part: &Part, name: &str, switch: &Switch) -> std::result::Result<When, Refusal> {
    let key = format!("switches.{name}");
    if let Some(criterion) = &switch.criterion {
        return Ok(by_criterion(context, criterion, &format!("{key}.criterion"))?);
    }
    let (Part::Continuum(body), Some(cuboid)) = (part, &switch.cuboid) else {
        return Err(Fault::new(key, "the switch does not say where", "give a `box`").into());
    };
    let min = context.vector(&cuboid.min, &format!("{key}.box.min"))?;
    let max = context.vector(&cuboid.max, &format!("{key}.box.max"))?;
    // The box that the elements really fill: the particles are packed into it.
    let block = Region::in_box(body, Block::new(context.space, min, max)?)?.block;
    Ok(match (&switch.at_s, &switch.at_load) {
        (Some(time), _) => When::Time { time_s: time.value(context.values, &format!("{key}.at_s"))?, block },
        (None, Some(level)) => {
            When::LoadLevel { factor: level.value(context.values, &format!("{key}.at_load"))?, block }
        }
        (None, None) => {
            let mend = "give one of: at_s, at_load, criterion";
            return Err(Fault::new(key, "the switch does not say when", mend).into());
        }
    })
}

/// What the switches that the list of effects leaves out would have looked at.
///
/// # Errors
/// A number without a value.
pub fn left_out(file: &SceneFile) -> crate::error::Result<Vec<LeftOut>> {
    let context = Context::new(file).map_err(|fault| file.error(fault))?;
    let of = |(name, switch): (&String, &Switch)| {
        let key = format!("switches.{name}");
        let value = |number: &Number, at: &str| number.value(context.values, &format!("{key}.{at}"));
        Ok(match (&switch.criterion, &switch.at_load, &switch.at_s) {
            (Some(criterion), ..) => match by_criterion(&context, criterion, &format!("{key}.criterion"))? {
                When::Criterion { criterion, .. } => Some(LeftOut::Criterion(switch.body.clone(), criterion)),
                _ => None,
            },
            (None, Some(level), _) => Some(LeftOut::AtLoad(value(level, "at_load")?)),
            (None, None, Some(time)) => Some(LeftOut::AtTime(value(time, "at_s")?)),
            (None, None, None) => None,
        })
    };
    let found: std::result::Result<Vec<Option<LeftOut>>, Fault> =
        file.scene.left_out.switches.iter().map(of).collect();
    Ok(found.map_err(|fault| file.error(fault))?.into_iter().flatten().collect())
}

fn by_criterion(context: &Context, criterion: &Criterion, key: &str) -> std::result::Result<When, Fault> {
    let solver = solver_criterion(context, criterion, key)?;
    let value = |number: &crate::scene::number::Number, name: &str| {
        number.value(context.values, &format!("{key}.{name}"))
    };
    Ok(When::Criterion {
        criterion: solver,
        every_s: match &criterion.every_s {
            Some(every) => value(every, "every_s")?,
            None => {
                return Err(Fault::new(key, "it is not said how often it is asked", "give every_s, in s"));
            }
        },
        most: criterion.most.count(context.values, 1, &format!("{key}.most"))?,
        through: through(criterion),
    })
}

/// The criterion as the solver knows it; `key` is its table.
pub fn solver_criterion(
    context: &Context,
    criterion: &Criterion,
    key: &str,
) -> std::result::Result<criterion::Criterion, Fault> {
    let value = |number: &crate::scene::number::Number, name: &str| {
        number.value(context.values, &format!("{key}.{name}"))
    };
    let indicator = match &criterion.stress {
        Some(stress) => {
            let strength = stress.strength_pa.as_ref().map(|s| value(s, "stress.strength_Pa"));
            Indicator::Stress {
                strength_pa: strength.transpose()?,
                length_m: value(&stress.length_m, "stress.length_m")?,
            }
        }
        None => Indicator::Error,
    };
    let memory = match &criterion.release {
        Some(release) => Memory::Release(value(release, "release")?),
        None => Memory::Irreversible,
    };
    let (trigger, buffer_m) =
        (value(&criterion.trigger, "trigger")?, value(&criterion.buffer_m, "buffer_m")?);
    Ok(criterion::Criterion { indicator, trigger, buffer_m, memory })
}

/// Axes along which the region reaches through the body.
pub fn through(criterion: &Criterion) -> [bool; 3] {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| criterion.through.contains(&axis))
}
