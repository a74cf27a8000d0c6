//! Checks of `[bodies.NAME.notched_beam]` and of the refinement of its grid.

use super::body::{Body, NotchedBeam};
use super::check::{Checked, positive};
use crate::error::Fault;
use crate::expression::Values;
use seam_solver::fem::notched_beam;

/// The shape in numbers.
pub fn shape(beam: &NotchedBeam, values: &Values, key: &str) -> Result<notched_beam::NotchedBeam, Fault> {
    let key = |name: &str| format!("{key}.notched_beam.{name}");
    Ok(notched_beam::NotchedBeam {
        length: beam.length_m.value(values, &key("length_m"))?,
        depth: beam.depth_m.value(values, &key("depth_m"))?,
        notch_depth: beam.notch_depth_m.value(values, &key("notch_depth_m"))?,
        angle: beam.notch_angle_deg.value(values, &key("notch_angle_deg"))?.to_radians(),
        reach: beam.reach_m.value(values, &key("reach_m"))?,
    })
}

/// Checks shape and refinement; `key` is the body's.
pub fn check(body: &Body, beam: &NotchedBeam, values: &Values, key: &str) -> Checked {
    let shape = shape(beam, values, key)?;
    let within = |name: &str| format!("{key}.notched_beam.{name}");
    positive(&beam.length_m, values, &within("length_m"))?;
    positive(&beam.depth_m, values, &within("depth_m"))?;
    if !(shape.notch_depth > 0.0 && shape.notch_depth < shape.depth) {
        let message = format!(
            "a notch {} m deep does not end inside a beam of depth {} m",
            shape.notch_depth, shape.depth
        );
        return Err(Fault::new(within("notch_depth_m"), message, "give a depth between zero and the beam's"));
    }
    if !(0.0..std::f64::consts::PI).contains(&shape.angle) {
        let message = format!("the flanks cannot open by {} degrees", shape.angle.to_degrees());
        return Err(Fault::new(
            within("notch_angle_deg"),
            message,
            "give an angle from 0 (a crack) to below 180",
        ));
    }
    let (mouth, half) = (shape.half_opening(0.0), 0.5 * shape.length);
    if !(shape.reach > mouth && shape.reach <= half) {
        let message = format!(
            "the grid cannot be opened within {} m of mid-span: half the mouth is {mouth} m, half the beam {half} m",
            shape.reach
        );
        return Err(Fault::new(within("reach_m"), message, "give a length between the two"));
    }
    let Some(fe) = &body.fe else { return Ok(()) };
    if !fe.divisions.is_empty() || !fe.grading.is_empty() {
        let mend = "remove them and give fe.refinement";
        return Err(Fault::new(format!("{key}.fe"), "a notched beam has no divisions and no grading", mend));
    }
    let Some(refinement) = &fe.refinement else {
        let mend = "add refinement = { finest_m = …, coarsest_m = … }";
        return Err(Fault::new(format!("{key}.fe"), "a notched beam needs `refinement`", mend));
    };
    let within = |name: &str| format!("{key}.fe.refinement.{name}");
    let finest = positive(&refinement.finest_m, values, &within("finest_m"))?;
    if refinement.coarsest_m.value(values, &within("coarsest_m"))? < finest {
        let message = format!("the coarsest cells are finer than the finest, {finest} m");
        return Err(Fault::new(within("coarsest_m"), message, "give at least that length"));
    }
    if refinement.growth.value(values, &within("growth"))? < 1.0 {
        return Err(Fault::new(within("growth"), "cells cannot shrink away from the tip", "give 1 or more"));
    }
    refinement.layers.count(values, 1, &within("layers"))?;
    let lines = [
        (&refinement.through_x_m, "through_x_m", [-half, half]),
        (&refinement.through_y_m, "through_y_m", [0.0, shape.depth]),
    ];
    for (numbers, name, [low, high]) in lines {
        for (i, number) in numbers.iter().enumerate() {
            let key = within(&format!("{name}[{i}]"));
            let x = number.value(values, &key)?;
            if !(low..=high).contains(&x) {
                let message = format!("the grid line at {x} m is not in the beam");
                return Err(Fault::new(key, message, format!("give a coordinate from {low} to {high}")));
            }
        }
    }
    Ok(())
}
