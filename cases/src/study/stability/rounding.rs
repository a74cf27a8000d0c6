//! Rounding: the same scene with its bonds in another order, and with its inputs moved by one unit in the last place.
//!
//! What changes is the rounding of the computation, so that the digits that agree are the digits that can be believed.

use super::super::evaluate::{self, Solved, Tally};
use super::apart;
use crate::error::Result;
use crate::file::SceneFile;
use crate::model::Built;
use crate::result::{CaseResult, Observation, ReferenceKind};
use seam_solver::dem::network::Network;
use seam_solver::model::Part;

/// More digits a double does not have.
const MOST_DIGITS: f64 = 16.0;

type Change = fn(&mut Built);

const CHANGES: [(&str, &str, Change); 2] = [
    ("order", "bonds in another order", reorder),
    ("ulp", "inputs moved by one unit in the last place", nudge),
];

/// Digits of every reading that survive each change.
pub(super) fn measure(file: &SceneFile, base: &Solved, tally: &Tally, result: &mut CaseResult) -> Result<()> {
    let mut fewest: Option<(f64, String)> = None;
    for (id, name, change) in CHANGES {
        let solved = evaluate::solve_changed(file, tally, change)?;
        for (probe, reading) in base.readings.iter() {
            let Some(other) = solved.readings.reading(probe) else { continue };
            let digits = (-apart(reading, other).log10()).clamp(0.0, MOST_DIGITS);
            if fewest.as_ref().is_none_or(|(least, _)| digits < *least) {
                fewest = Some((digits, format!("{probe}, {name}")));
            }
            result.quantities.push(Observation {
                id: format!("digits-{id}-{probe}"),
                label: format!("Digits of the reading '{probe}' that survive: {name}"),
                unit: "1".to_owned(),
                value: digits,
                kind: ReferenceKind::OwnRun,
                source: "the scene as it is".to_owned(),
                ..Observation::default()
            });
        }
    }
    if let Some((digits, what)) = fewest {
        result.notes.push(format!("the fewest digits that survive rounding are {digits:.1}: {what}"));
    }
    Ok(())
}

/// Every second bond first, then the others from the end.
fn reorder(built: &mut Built) {
    for part in &mut built.model.parts {
        let Part::Discrete { network, .. } = part else { continue };
        let n = network.bonds.len();
        let order: Vec<usize> = (0..n).step_by(2).chain((0..n).skip(1).step_by(2).rev()).collect();
        permute(network, &order);
    }
}

fn permute(network: &mut Network, order: &[usize]) {
    let bonds = &mut network.bonds;
    bonds.ends = order.iter().map(|&b| bonds.ends[b]).collect();
    bonds.radius = order.iter().map(|&b| bonds.radius[b]).collect();
    bonds.stiffness = order.iter().map(|&b| bonds.stiffness[b]).collect();
    bonds.weight = order.iter().map(|&b| bonds.weight[b]).collect();
}

/// Every second number up, the others down. Places stay: a face would no longer be flat.
fn nudge(built: &mut Built) {
    let mut up = false;
    let mut moved = |x: &mut f64| {
        up = !up;
        // Nothing is next to nothing.
        if *x != 0.0 {
            *x = if up { x.next_up() } else { x.next_down() };
        }
    };
    for part in &mut built.model.parts {
        match part {
            Part::Continuum(body) => {
                moved(&mut body.elasticity.young_pa);
                moved(&mut body.elasticity.poisson);
                moved(&mut body.elasticity.density);
            }
            Part::Discrete { network, .. } => {
                for k in &mut network.bonds.stiffness {
                    [&mut k.kn, &mut k.ks, &mut k.kb, &mut k.kt].into_iter().for_each(&mut moved);
                }
                network.particles.mass.iter_mut().chain(&mut network.particles.inertia).for_each(&mut moved);
            }
        }
    }
    built.model.supports.iter_mut().chain(&mut built.model.loads).for_each(|v| moved(&mut v.value));
}
