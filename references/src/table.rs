//! The CSV of a reference: a header, and finite numbers or names.

use crate::problem::{Problem, Result};
use crate::provenance::Column;
use std::collections::BTreeMap;

/// Content of the columns, each in one of the two.
#[derive(Debug, Default)]
pub struct Table {
    pub numbers: BTreeMap<String, Vec<f64>>,
    pub names: BTreeMap<String, Vec<String>>,
}

/// What is in the columns; the header must hold each of them once and nothing else.
pub fn parse(file: &str, bytes: &[u8], columns: &BTreeMap<String, Column>) -> Result<Table> {
    let problem = |line, column: &str, message: String| Problem::Table {
        file: file.to_owned(),
        line,
        column: column.to_owned(),
        message,
    };
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader.headers().map_err(|e| problem(1, "", e.to_string()))?.clone();
    if let Some(missing) = columns.keys().find(|name| !header.iter().any(|h| h == **name)) {
        return Err(problem(1, missing, "is missing; the provenance describes it".to_owned()));
    }
    let mut table = Table::default();
    let is_name = |name: &str| columns.get(name).is_some_and(|column| column.unit.is_name());
    for (k, name) in header.iter().enumerate() {
        if !columns.contains_key(name) {
            return Err(problem(
                1,
                name,
                "has no unit; describe it in [columns] of the provenance".to_owned(),
            ));
        }
        if header.iter().take(k).any(|before| before == name) {
            return Err(problem(1, name, "comes twice; remove one".to_owned()));
        }
    }
    for record in reader.into_records() {
        let record =
            record.map_err(|e| problem(e.position().map_or(1, csv::Position::line), "", e.to_string()))?;
        let line = record.position().map_or(1, csv::Position::line);
        for (name, field) in header.iter().zip(&record) {
            if is_name(name) {
                table.names.entry(name.to_owned()).or_default().push(field.to_owned());
                continue;
            }
            let value = field.parse().ok().filter(|v: &f64| v.is_finite());
            let value = value.ok_or_else(|| {
                problem(line, name, format!("'{field}' is not a finite number; make the table again"))
            })?;
            table.numbers.entry(name.to_owned()).or_default().push(value);
        }
    }
    if table.numbers.is_empty() && table.names.is_empty() {
        return Err(problem(1, "", "no rows; make the table again with its generator".to_owned()));
    }
    Ok(table)
}
