//! The CSV of a reference: a header and finite numbers.

use crate::problem::{Problem, Result};
use std::collections::BTreeMap;

/// Numbers by column; the header must hold each of `names` once and nothing else.
pub fn parse(file: &str, bytes: &[u8], names: &[&str]) -> Result<BTreeMap<String, Vec<f64>>> {
    let problem = |line, column: &str, message: String| Problem::Table {
        file: file.to_owned(),
        line,
        column: column.to_owned(),
        message,
    };
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader.headers().map_err(|e| problem(1, "", e.to_string()))?.clone();
    if let Some(missing) = names.iter().find(|name| !header.iter().any(|h| h == **name)) {
        return Err(problem(1, missing, "is missing; the provenance describes it".to_owned()));
    }
    let mut numbers: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for name in &header {
        if !names.contains(&name) {
            return Err(problem(
                1,
                name,
                "has no unit; describe it in [columns] of the provenance".to_owned(),
            ));
        }
        if numbers.insert(name.to_owned(), Vec::new()).is_some() {
            return Err(problem(1, name, "comes twice; remove one".to_owned()));
        }
    }
    for record in reader.into_records() {
        let record =
            record.map_err(|e| problem(e.position().map_or(1, csv::Position::line), "", e.to_string()))?;
        let line = record.position().map_or(1, csv::Position::line);
        for (name, field) in header.iter().zip(&record) {
            let value = field.parse().ok().filter(|v: &f64| v.is_finite());
            let value = value.ok_or_else(|| {
                problem(line, name, format!("'{field}' is not a finite number; make the table again"))
            })?;
            numbers.entry(name.to_owned()).or_default().push(value);
        }
    }
    if numbers.values().all(Vec::is_empty) {
        return Err(problem(1, "", "no rows; make the table again with its generator".to_owned()));
    }
    Ok(numbers)
}
