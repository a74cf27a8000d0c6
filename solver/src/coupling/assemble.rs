//! From the ties of a model to its constraint rows.

use super::side::{Side, Turning};
use super::trace::{Frame, Trace};
use super::{Method, Multipliers, Row, Tie, mortar, pointwise};
use crate::error::{Error, Result};
use crate::fem::locate::Locator;
use crate::model::{Model, Numbering, Part};

/// Rows of all ties, in order.
///
/// # Errors
/// A tie whose faces do not exist, are not flat or do not touch.
pub fn rows(model: &Model, numbering: &Numbering) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for tie in &model.ties {
        rows.extend(tie_rows(model, numbering, tie)?);
    }
    Ok(rows)
}

fn tie_rows(model: &Model, numbering: &Numbering, tie: &Tie) -> Result<Vec<Row>> {
    let first = side(model, numbering, tie, &tie.first)?;
    let second = side(model, numbering, tie, &tie.second)?;
    let positions = [&first.trace.positions[..], &second.trace.positions[..]].concat();
    let frame = Frame::fit(model.space, &positions, &tie.name)?;
    match tie.method {
        Method::Pointwise => {
            let swap = match tie.multipliers {
                Multipliers::First => false,
                Multipliers::Second => true,
                // Particles follow elements; between likes the finer face follows.
                Multipliers::Auto => {
                    let rank = |s: &Side| (s.is_discrete(), s.trace.points.len());
                    rank(&second) > rank(&first)
                }
            };
            let (tied, onto) = if swap { (&second, &first) } else { (&first, &second) };
            pointwise::rows(&tie.name, &frame, tied, onto, tie.rotations)
        }
        Method::Mortar => {
            let carrier = match tie.multipliers {
                Multipliers::First => 0,
                Multipliers::Second => 1,
                Multipliers::Auto => usize::from(second.trace.points.len() < first.trace.points.len()),
            };
            mortar::rows(&tie.name, &frame, [&first, &second], carrier, tie.rotations)
        }
    }
}

fn side<'a>(model: &'a Model, numbering: &Numbering, tie: &Tie, end: &(usize, String)) -> Result<Side<'a>> {
    let (index, face) = end;
    let part = &model.parts[*index];
    let missing = || Error::EmptyInterface {
        tie: tie.name.clone(),
        message: format!("body '{}' has no face '{face}'; it has {}", part.name(), faces(part)),
    };
    let (trace, turning) = match part {
        Part::Continuum(body) => {
            let trace = Trace::of_mesh(&body.mesh, face).ok_or_else(missing)?;
            let size = trace.positions.iter().map(|x| (x - trace.positions[0]).norm()).fold(0.0, f64::max);
            (trace, Turning::Elements { locator: Locator::new(&body.mesh), within: 1e-6 * size })
        }
        Part::Discrete { network, .. } => {
            let points = network.faces.get(face).ok_or_else(missing)?.clone();
            let positions = points.iter().map(|&p| network.particles.position[p]).collect();
            (Trace::of_particles(model.space, points, positions, &tie.name)?, Turning::Particles)
        }
    };
    Ok(Side {
        trace,
        offset: numbering.offset(*index),
        per_point: part.dofs_per_point(),
        turning,
        name: part.name(),
    })
}

fn faces(part: &Part) -> String {
    let names: Vec<&str> = match part {
        Part::Continuum(c) => c.mesh.boundaries.keys().map(String::as_str).collect(),
        Part::Discrete { network, .. } => network.faces.keys().map(String::as_str).collect(),
    };
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
