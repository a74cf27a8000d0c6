//! Checks of sets, ties, supports and loads: places that do not exist, ways that are not given.

use super::Scene;
use super::check::{Checked, known, vector};
use crate::error::Fault;
use crate::expression::Values;
use crate::names::hint;

/// Checks what joins, holds and moves the bodies.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    for (name, set) in &scene.sets {
        let key = format!("sets.{name}");
        known(&set.body, "body", scene.bodies.keys(), &format!("{key}.body"))?;
        let ways = [set.cuboid.is_some(), set.boundary.is_some(), set.ids.is_some(), set.csv.is_some()];
        if ways.iter().filter(|given| **given).count() != 1 {
            let mend = "give one of: box, boundary, ids, csv";
            return Err(Fault::new(key, "a set is chosen in exactly one way", mend));
        }
        if let Some(boundary) = &set.boundary {
            place(scene, &format!("{}.{boundary}", set.body), &format!("{key}.boundary"))?;
        }
    }
    for (name, tie) in &scene.ties {
        for (i, face) in tie.faces.iter().enumerate() {
            let key = format!("ties.{name}.faces[{i}]");
            if !face.contains('.') {
                let mend = "write it as \"body.boundary\", e.g. \"left.right\"";
                return Err(Fault::new(key, format!("'{face}' is not a face"), mend));
            }
            place(scene, face, &key)?;
        }
        if body_of(&tie.faces[0]) == body_of(&tie.faces[1]) {
            let key = format!("ties.{name}.faces");
            return Err(Fault::new(key, "both faces belong to one body", "tie two different bodies"));
        }
    }
    for (name, support) in &scene.supports {
        place(scene, &support.on, &format!("supports.{name}.on"))?;
        if support.components().iter().all(|(_, number)| number.is_none()) {
            let mend = "give at least one of ux, uy, uz, rx, ry, rz";
            return Err(Fault::new(format!("supports.{name}"), "the support holds nothing", mend));
        }
    }
    loads(scene, values)
}

fn loads(scene: &Scene, values: &Values) -> Checked {
    let space = scene.hypothesis.space();
    for (name, load) in &scene.loads {
        let key = format!("loads.{name}");
        place(scene, &load.on, &format!("{key}.on"))?;
        match (&load.total_n, &load.traction_pa) {
            (Some(total), None) => {
                vector(total, space, &format!("{key}.total_N"))?;
                for (i, number) in total.iter().enumerate() {
                    number.value(values, &format!("{key}.total_N[{i}]"))?;
                }
            }
            (None, Some(traction)) => vector(traction, space, &format!("{key}.traction_Pa"))?,
            _ => {
                let mend = "give one of total_N, traction_Pa";
                return Err(Fault::new(key, "a load is given in exactly one way", mend));
            }
        }
    }
    Ok(())
}

fn body_of(face: &str) -> &str {
    face.split('.').next().unwrap_or(face)
}

/// A place must be a set, or a boundary of a body.
fn place(scene: &Scene, on: &str, key: &str) -> Checked {
    let Some((body, boundary)) = on.split_once('.') else {
        return known(on, "set", scene.sets.keys(), key);
    };
    known(body, "body", scene.bodies.keys(), key)?;
    match scene.bodies[body].boundaries() {
        Some(names) if !names.contains(&boundary) => {
            let message = format!("body '{body}' has no boundary '{boundary}'");
            Err(Fault::new(key, message, hint(boundary, names.iter().copied())))
        }
        _ => Ok(()),
    }
}
