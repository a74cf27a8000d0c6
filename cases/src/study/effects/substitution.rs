//! Whether elements become particles, and whether they would have.

use super::super::evaluate::Solved;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};

const NAME: &str = "substitution";

/// Particles that come at a larger load than the one at which the first bond then fails come too late.
const LATE: &str = "the load at which the criterion fired, over that of the first failure after it,";

/// Substitution, on or off.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    let scene = &file.scene;
    if !scene.left_out.switches.is_empty() {
        let about = "how near the scene comes to its own switch, over what fires it,".to_owned();
        return match solved.guard.seen.nearest_switch {
            Some(value) => watched(NAME, Indicator { about, value, limit: 1.0 }),
            None => off(NAME, "the list of effects leaves it out, and its switch has nothing to look at"),
        };
    }
    if let Some(cracked) = solved.cracked.as_ref().filter(|cracked| !cracked.grown.is_empty()) {
        let steps = cracked.grown.len();
        let (elements, particles) = cracked.grown.last().map_or((0, 0), |g| (g.elements, g.particles));
        let became =
            format!("{elements} elements became {particles} particles in {steps} steps ahead of the crack");
        return match cracked.lateness() {
            Some(late) if late > 1.0 => EffectUse {
                called_for: true,
                indicator: Some(Indicator { about: LATE.to_owned(), value: late, limit: 1.0 }),
                ..on(
                    NAME,
                    format!(
                        "{became}, but {LATE} is {late:.2}: bonds should have failed before, the result is not trusted; lower the trigger"
                    ),
                    steps as u64,
                )
            },
            _ => on(NAME, format!("the scene asks for it: {became}"), steps as u64),
        };
    }
    let reports = solved.course.as_ref().map_or(&[][..], |course| &course.switches.reports);
    match (scene.switches.is_empty(), reports) {
        (true, _) => off(NAME, "bodies keep their method"),
        (false, []) => off(NAME, "no element met the criterion"),
        (false, [(_, first), ..]) => {
            let elements: usize = reports.iter().map(|(_, r)| r.elements).sum();
            let particles: usize = reports.iter().map(|(_, r)| r.particles).sum();
            let at = first.time;
            let why = format!(
                "the scene asks for it: {elements} elements became {particles} particles, first at {at:.3e} s"
            );
            on(NAME, why, reports.len() as u64)
        }
    }
}
