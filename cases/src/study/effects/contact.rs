//! Whether particles touch that have lost a bond, and slide.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};

/// Energies below this share of the strain energy do not matter: a load that does so much less work moves by about as much.
const SMALL_SHARE: f64 = 0.01;

/// Contact, on or off; its counter is the number of pairs that were looked at. Without it broken pairs may run into each other: the energy
/// that their bonds would hold if they were still there tells how much that is.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    const NAME: &str = "contact";
    if file.scene.contact.is_some() {
        let why = "the scene asks for it, for particles that have lost a bond";
        return on(NAME, why, solved.solution.work.contact_checks);
    }
    let seen = &solved.guard.seen;
    if file.scene.failure.is_empty() {
        return off(NAME, "bonded particles do not meet in small motion");
    }
    if seen.closed == 0.0 {
        return off(NAME, "no broken pair has closed");
    }
    let about =
        "what broken pairs that closed would hold as bonds, over the largest strain energy,".to_owned();
    watched(NAME, Indicator { about, value: seen.closed / seen.strain, limit: SMALL_SHARE })
}

/// Friction, on or off; it is looked at with every contact. Without it contacts slide freely: what friction would spend on the same way
/// tells.
pub fn friction(file: &SceneFile, solved: &Solved) -> EffectUse {
    const NAME: &str = "friction";
    let Some(contact) = &file.scene.contact else { return off(NAME, "there is no contact") };
    if let (Some(left_out), Some(course)) = (&file.scene.left_out.friction, &solved.course) {
        let about =
            "what friction would spend where contacts slid, over the largest strain energy,".to_owned();
        // A coefficient without a value is a fault of the scene; not a number is past every limit.
        let coefficient = left_out.value(&file.values, "contact.friction").unwrap_or(f64::NAN);
        let value = coefficient * course.contact.sliding / solved.guard.seen.strain;
        return watched(NAME, Indicator { about, value, limit: SMALL_SHARE });
    }
    match contact.friction.value(&file.values, "contact.friction") {
        Ok(mu) if mu > 0.0 => {
            let why = "the contacts have a coefficient of friction";
            on(NAME, why, solved.solution.work.contact_checks)
        }
        _ => off(NAME, "the contacts have no friction"),
    }
}
