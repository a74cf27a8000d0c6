//! Checks of a scene that need no solver: names that lead nowhere, numbers out of range.

use super::body::{Body, Method};
use super::de::{Arrangement, Calibrate, De};
use super::number::Number;
use super::{
    Scene, check_connection, check_dynamics, check_failure, check_notched_beam, check_peer, check_probe,
    check_size, check_study, check_switch,
};
use crate::error::Fault;
use crate::expression::{RESERVED, Values};
use crate::names::hint;
use crate::procedures;
use seam_solver::space::Space;

/// Result of a check.
pub type Checked = Result<(), Fault>;

/// Checks everything.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    head(scene)?;
    file_names(scene)?;
    parameters(scene)?;
    positive(&scene.thickness_m, values, "thickness_m")?;
    materials(scene, values)?;
    for (name, body) in &scene.bodies {
        check_body(scene, name, body, values)?;
    }
    check_connection::check(scene, values)?;
    if let Some(dynamics) = &scene.dynamics {
        check_dynamics::check(scene, dynamics, values)?;
    }
    check_failure::check(scene, values)?;
    check_switch::check(scene, values)?;
    for (name, probe) in &scene.probes {
        check_probe::check(scene, name, probe, values)?;
    }
    check_peer::check(scene)?;
    check_study::check(scene, values)?;
    check_size::check(scene, values)
}

fn head(scene: &Scene) -> Checked {
    let good = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if scene.id.is_empty() || !scene.id.chars().all(good) || scene.id.len() > 60 {
        let mend = "use lower-case letters, digits and hyphens: it is also the name of a folder";
        return Err(Fault::new("id", format!("'{}' is not an id", scene.id), mend));
    }
    if scene.tiers.is_empty() {
        return Err(Fault::new("tiers", "the case would never run", "name quick, full or both"));
    }
    if !procedures::names().any(|name| name == scene.procedure) {
        let message = format!("there is no procedure '{}'", scene.procedure);
        return Err(Fault::new("procedure", message, hint(&scene.procedure, procedures::names())));
    }
    if let Some((name, _)) = scene.expected_failures.iter().find(|(_, why)| why.trim().is_empty()) {
        let key = format!("expected_failures.{name}");
        return Err(Fault::new(key, "the reason is blank", "say why it fails, and what would mend it"));
    }
    if scene.procedure == "statics" && scene.bodies.is_empty() {
        let mend = "add a [bodies.NAME] table, or name a procedure that needs none";
        return Err(Fault::new("bodies", "there is no body", mend));
    }
    Ok(())
}

/// Names that become names of files must not lead out of the folder of the case.
fn file_names(scene: &Scene) -> Checked {
    let bodies = scene.bodies.keys().map(|name| ("bodies", name));
    let probes = scene.probes.keys().map(|name| ("probes", name));
    let switches = scene.switches.keys().map(|name| ("switches", name));
    for (table, name) in bodies.chain(probes).chain(switches) {
        let bad = |c: char| matches!(c, '/' | '\\' | ':') || c.is_control();
        if name.is_empty() || name.starts_with('.') || name.contains(bad) || name.len() > 100 {
            let message = format!("'{name}' is not a name: files are named after it");
            return Err(Fault::new(format!("{table}.{name}"), message, "use letters, digits, hyphens and _"));
        }
    }
    Ok(())
}

fn parameters(scene: &Scene) -> Checked {
    for name in scene.parameters.keys() {
        let key = format!("parameters.{name}");
        let good = name.chars().all(|c| c.is_alphanumeric() || c == '_')
            && name.chars().next().is_some_and(|c| !c.is_ascii_digit());
        if !good {
            return Err(Fault::new(key, "an expression could not name it", "use letters, digits and _"));
        }
        if RESERVED.contains(&name.as_str()) {
            let message = format!("'{name}' already has a meaning in expressions");
            return Err(Fault::new(key, message, "choose another name"));
        }
    }
    Ok(())
}

fn materials(scene: &Scene, values: &Values) -> Checked {
    for (name, material) in &scene.materials {
        positive(&material.young_pa, values, &format!("materials.{name}.young_Pa"))?;
        positive(&material.density_kg_m3, values, &format!("materials.{name}.density_kg_m3"))?;
        let key = format!("materials.{name}.poisson");
        let poisson = material.poisson.value(values, &key)?;
        if !(poisson > -1.0 && poisson < 0.5) {
            let message = format!("Poisson's ratio {poisson} is outside (-1, 0.5)");
            return Err(Fault::new(key, message, "most solids have 0 to 0.49"));
        }
    }
    Ok(())
}

/// A number that must be positive.
pub fn positive(number: &Number, values: &Values, key: &str) -> Result<f64, Fault> {
    let value = number.value(values, key)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(Fault::new(
            key,
            format!("expected a positive number, found {value}"),
            "give it a value above zero",
        ))
    }
}

/// A name that must be declared.
pub fn known<'a>(
    name: &str,
    what: &str,
    names: impl Iterator<Item = &'a String> + Clone,
    key: &str,
) -> Checked {
    if names.clone().any(|n| n == name) {
        return Ok(());
    }
    let mend = hint(name, names.map(String::as_str).collect::<Vec<_>>());
    Err(Fault::new(key, format!("there is no {what} '{name}'"), mend))
}

/// A point or vector: two or three components, three in the solid.
pub fn vector(numbers: &[Number], space: Space, key: &str) -> Checked {
    if numbers.len() < space.dim() || numbers.len() > 3 {
        let message = format!("expected {} components, found {}", space.dim(), numbers.len());
        return Err(Fault::new(key, message, "give one number per direction: [x, y] or [x, y, z]"));
    }
    Ok(())
}

fn check_body(scene: &Scene, name: &str, body: &Body, values: &Values) -> Checked {
    let key = format!("bodies.{name}");
    known(&body.material, "material", scene.materials.keys(), &format!("{key}.material"))?;
    let shapes = body.shapes();
    if shapes.len() != 1 {
        let message = format!("a body has one shape, found {}: {}", shapes.len(), shapes.join(", "));
        return Err(Fault::new(
            key,
            message,
            "give one of: box, quadrilateral, sector, notched_beam, gmsh, network",
        ));
    }
    let space = scene.hypothesis.space();
    if space == Space::Solid && ["quadrilateral", "sector"].contains(&shapes[0]) {
        let mend = "use a box or a Gmsh file, or a plane hypothesis";
        return Err(Fault::new(format!("{key}.{}", shapes[0]), "this shape is plane only", mend));
    }
    if let Some(cuboid) = &body.cuboid {
        check_box(cuboid, space, values, &format!("{key}.box"))?;
    }
    if let Some(beam) = &body.notched_beam {
        check_notched_beam::check(body, beam, values, &key)?;
    }
    match body.method {
        Method::Fe => check_fe(body, shapes[0], space, values, &key),
        Method::De => check_de(body, shapes[0], space, values, &key),
    }
}

/// A box with sides of positive length.
pub fn check_box(cuboid: &super::body::Cuboid, space: Space, values: &Values, key: &str) -> Checked {
    vector(&cuboid.min, space, &format!("{key}.min"))?;
    vector(&cuboid.max, space, &format!("{key}.max"))?;
    for i in 0..space.dim() {
        let (low_key, high_key) = (format!("{key}.min[{i}]"), format!("{key}.max[{i}]"));
        let low = cuboid.min[i].value(values, &low_key)?;
        let high = cuboid.max[i].value(values, &high_key)?;
        if high <= low {
            let message = format!("the box is flat or inside out: max {high} is not above min {low}");
            return Err(Fault::new(high_key, message, "make max larger than min in every direction"));
        }
    }
    Ok(())
}

fn check_fe(body: &Body, shape: &str, space: Space, values: &Values, key: &str) -> Checked {
    let Some(fe) = &body.fe else {
        let mend = "add an `fe` table with its divisions, or set method = \"de\"";
        return Err(Fault::new(format!("{key}.method"), "the section `fe` is missing", mend));
    };
    if shape == "network" {
        return Err(Fault::new(
            format!("{key}.network"),
            "a network is computed with particles",
            "set method = \"de\"",
        ));
    }
    if fe.refinement.is_some() && shape != "notched_beam" {
        let message = "only a notched beam has a refinement";
        return Err(Fault::new(format!("{key}.fe.refinement"), message, "use divisions and grading"));
    }
    if ["gmsh", "notched_beam"].contains(&shape) {
        return Ok(());
    }
    vector(&fe.divisions, space, &format!("{key}.fe.divisions"))?;
    for (i, number) in fe.divisions.iter().enumerate() {
        number.count(values, 1, &format!("{key}.fe.divisions[{i}]"))?;
    }
    for (i, number) in fe.grading.iter().enumerate() {
        positive(number, values, &format!("{key}.fe.grading[{i}]"))?;
    }
    Ok(())
}

fn check_de(body: &Body, shape: &str, space: Space, values: &Values, key: &str) -> Checked {
    if shape == "network" {
        return Ok(());
    }
    let Some(de) = &body.de else {
        let mend = "add a `de` table with its arrangement, or set method = \"fe\"";
        return Err(Fault::new(format!("{key}.method"), "the section `de` is missing", mend));
    };
    if !["box", "notched_beam"].contains(&shape) {
        let message = "particles fill boxes and notched beams only";
        return Err(Fault::new(format!("{key}.{shape}"), message, "use one of these, or bring a network"));
    }
    check_filling(de, space, values, key)
}

/// The particles of a body or of a switch, whose table is at `key`.
pub fn check_filling(de: &De, space: Space, values: &Values, key: &str) -> Checked {
    let plane = matches!(de.arrangement, Arrangement::Triangular | Arrangement::Square);
    let solid = matches!(de.arrangement, Arrangement::Sc | Arrangement::Bcc | Arrangement::Fcc);
    if (plane && space == Space::Solid) || (solid && space == Space::Plane) {
        let message = "this lattice does not exist in the space of the scene";
        let mend = "plane: triangular, square, random; solid: sc, bcc, fcc, random";
        return Err(Fault::new(format!("{key}.de.arrangement"), message, mend));
    }
    de.rows.count(values, 1, &format!("{key}.de.rows"))?;
    check_bond(de, values, key)
}

fn check_bond(de: &De, values: &Values, key: &str) -> Checked {
    let bond = &de.bond;
    let key = format!("{key}.de.bond");
    for (number, name) in [(&bond.radius_ratio, "radius_ratio"), (&bond.young_pa, "young_Pa")] {
        if let Some(number) = number {
            positive(number, values, &format!("{key}.{name}"))?;
        }
    }
    let needs = |given: bool, name: &str| {
        let message = format!("`{name}` is needed when calibration does not find it");
        let mend = "give it, or let calibrate = \"both\" find r̃ and E_μ";
        if given { Ok(()) } else { Err(Fault::new(key.clone(), message, mend)) }
    };
    match bond.calibrate {
        Calibrate::Both => Ok(()),
        Calibrate::Young => needs(bond.radius_ratio.is_some(), "radius_ratio"),
        Calibrate::None => {
            needs(bond.radius_ratio.is_some(), "radius_ratio")?;
            needs(bond.young_pa.is_some(), "young_Pa")
        }
    }
}
