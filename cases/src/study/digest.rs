//! What a solution depends on, as one hash: scenes with the same digest have the same solution.

use crate::expression::Expression;
use crate::file::SceneFile;
use crate::scene::body::Method;
use serde_json::Value;

/// Hash of the parts of a scene that make its model and its probes, numbers evaluated, the
/// section of the method that is off left out.
pub fn digest(file: &SceneFile) -> String {
    let mut scene = file.scene.clone();
    for body in scene.bodies.values_mut() {
        match body.method {
            Method::Fe => body.de = None,
            Method::De => body.fe = None,
        }
    }
    let parts = (
        (&scene.hypothesis, &scene.thickness_m, &scene.materials, &scene.bodies, &scene.sets),
        (&scene.ties, &scene.supports, &scene.loads, &scene.probes, &scene.reference),
        (&scene.dynamics, &scene.switches, &scene.failure, &scene.cracking, &scene.contact),
    );
    let mut value = serde_json::to_value(parts).unwrap_or(Value::Null);
    evaluate(&mut value, file);
    // Fields of x, y, z keep their text and depend on the parameters they name.
    let folder = format!("{:?}", file.folder);
    let values = used_by_fields(&value, file);
    blake3::hash(format!("{value}{values}{folder}").as_bytes()).to_hex().to_string()
}

/// Replaces every expression that has a value by it.
fn evaluate(value: &mut Value, file: &SceneFile) {
    match value {
        Value::String(text) => {
            if let Some(number) = Expression::parse(text).ok().and_then(|e| e.value(&file.values).ok()) {
                *value = Value::from(number);
            }
        }
        Value::Array(elements) => elements.iter_mut().for_each(|v| evaluate(v, file)),
        Value::Object(members) => members.values_mut().for_each(|v| evaluate(v, file)),
        _ => {}
    }
}

fn used_by_fields(value: &Value, file: &SceneFile) -> String {
    match value {
        Value::String(text) => Expression::parse(text).map_or(String::new(), |e| {
            e.names().iter().filter_map(|n| Some(format!("{n}={:?};", file.values.get(*n)?))).collect()
        }),
        Value::Array(elements) => elements.iter().map(|v| used_by_fields(v, file)).collect(),
        Value::Object(members) => members.values().map(|v| used_by_fields(v, file)).collect(),
        _ => String::new(),
    }
}
