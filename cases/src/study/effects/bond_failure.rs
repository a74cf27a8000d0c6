//! Whether bonds fail.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};

const NAME: &str = "bond-failure";

/// Bond failure, on or off; its counter is the number of failures. Where the list of effects leaves it out, the stress in its bonds over
/// their strength tells: at one a bond would have failed.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    if let Some(value) = solved.guard.seen.largest_demand {
        let about = "the largest stress in a bond, over the strength that was left out,".to_owned();
        return watched(NAME, Indicator { about, value, limit: 1.0 });
    }
    if file.scene.failure.is_empty() {
        return off(NAME, "the scene gives no strength");
    }
    if let Some(course) = &solved.course {
        let why = format!("the scene gives a strength: bonds lost stiffness {} times", course.losses);
        return on(NAME, why, course.losses as u64);
    }
    let events = solved.cracked.as_ref().map_or(&[][..], |cracked| &cracked.outcome.events);
    let broken = events.iter().flat_map(|e| &e.integrity).filter(|g| **g == 0.0).count();
    let why = format!("the scene gives a strength: {} failures broke {broken} bonds", events.len());
    on(NAME, why, events.len() as u64)
}
