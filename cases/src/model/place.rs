//! Places: `"body.boundary"`, or the name of a set.

use super::{Context, Refusal};
use crate::error::{Error, Fault};
use crate::names::hint;
use seam_solver::model::Part;

/// Nodes or particles of one part.
pub struct Place {
    /// Index of the part.
    pub part: usize,
    /// Ascending, each once.
    pub points: Vec<usize>,
    /// The boundary, if it is one.
    pub boundary: Option<String>,
}

/// Index of a body among the parts.
pub fn part_of(context: &Context, body: &str) -> usize {
    context.scene.bodies.keys().position(|name| name == body).unwrap_or(0)
}

/// Finds a place; `key` is where the scene names it.
pub fn find(context: &Context, parts: &[Part], on: &str, key: &str) -> Result<Place, Refusal> {
    let place = match on.split_once('.') {
        Some((body, boundary)) => on_boundary(parts, part_of(context, body), boundary, key)?,
        None => in_set(context, parts, on, key)?,
    };
    if place.points.is_empty() {
        let noun = parts[place.part].noun();
        return Err(Fault::new(
            key,
            format!("there is no {noun} in '{on}'"),
            "enlarge the set, or correct its body",
        )
        .into());
    }
    Ok(place)
}

fn on_boundary(parts: &[Part], part: usize, boundary: &str, key: &str) -> Result<Place, Fault> {
    let names: Vec<String> = match &parts[part] {
        Part::Continuum(body) => body.mesh.boundaries.keys().cloned().collect(),
        Part::Discrete { network, .. } => network.faces.keys().cloned().collect(),
    };
    match parts[part].face(boundary) {
        Some(points) => Ok(Place { part, points, boundary: Some(boundary.to_owned()) }),
        None => {
            let message = format!("body '{}' has no boundary '{boundary}'", parts[part].name());
            Err(Fault::new(key, message, hint(boundary, names.iter().map(String::as_str))))
        }
    }
}

fn in_set(context: &Context, parts: &[Part], name: &str, key: &str) -> Result<Place, Refusal> {
    let set = &context.scene.sets[name];
    let part = part_of(context, &set.body);
    if let Some(boundary) = &set.boundary {
        return Ok(on_boundary(parts, part, boundary, key)?);
    }
    let positions = parts[part].positions();
    let points = if let Some(cuboid) = &set.cuboid {
        let key = format!("sets.{name}.box");
        let low = context.vector(&cuboid.min, &format!("{key}.min"))?;
        let high = context.vector(&cuboid.max, &format!("{key}.max"))?;
        // Faces belong to the box; the rounding of a coordinate must not decide.
        let margin = 1e-9 * (high - low).amax();
        let inside = |i: usize| {
            (0..context.space.dim())
                .all(|c| low[c] - margin <= positions[i][c] && positions[i][c] <= high[c] + margin)
        };
        (0..positions.len()).filter(|&i| inside(i)).collect()
    } else {
        let mut ids = match (&set.ids, &set.csv) {
            (Some(ids), _) => ids.clone(),
            (None, Some(csv)) => read_ids(context, csv, &format!("sets.{name}.csv"))?,
            (None, None) => Vec::new(),
        };
        ids.sort_unstable();
        if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(Fault::new(
                format!("sets.{name}"),
                format!("id {} is listed twice", pair[0]),
                "list each once",
            )
            .into());
        }
        ids
    };
    if let Some(last) = points.last().filter(|&&last| last >= positions.len()) {
        let noun = parts[part].noun();
        let message =
            format!("there is no {noun} {last}; body '{}' has {}, counted from 0", set.body, positions.len());
        return Err(Fault::new(format!("sets.{name}"), message, "correct the list of ids").into());
    }
    Ok(Place { part, points, boundary: None })
}

fn read_ids(context: &Context, file: &str, key: &str) -> Result<Vec<usize>, Refusal> {
    let path = context.file.folder.file(file)?;
    let text =
        std::fs::read(&path).map_err(|source| Error::File { path: path.display().to_string(), source })?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_slice());
    let fail = |message: String| {
        Fault::new(key, format!("{file}: {message}"), "give a column `id` of whole numbers")
    };
    let headers = reader.headers().map_err(|e| fail(e.to_string()))?;
    let column =
        headers.iter().position(|h| h == "id").ok_or_else(|| fail("there is no column `id`".to_owned()))?;
    let mut ids = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| fail(e.to_string()))?;
        let line = record.position().map_or(0, |p| p.line());
        let word = record.get(column).unwrap_or("");
        ids.push(word.parse().map_err(|_| fail(format!("line {line}: '{word}' is not an id")))?);
    }
    Ok(ids)
}
