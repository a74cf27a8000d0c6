//! The checked numbers of a reference.

use crate::problem::{Problem, Result};
use crate::provenance::Provenance;
use std::collections::BTreeMap;

/// Columns of finite numbers of one length, and where they come from.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    pub(crate) file: String,
    /// Where the numbers come from.
    pub provenance: Provenance,
    pub(crate) numbers: BTreeMap<String, Vec<f64>>,
}

impl Dataset {
    /// The numbers of a column, which must be in `unit`: nobody reads millimetres as metres.
    ///
    /// # Errors
    /// No such column; another unit.
    pub fn column(&self, name: &str, unit: &str) -> Result<&[f64]> {
        let (Some(column), Some(numbers)) = (self.provenance.columns.get(name), self.numbers.get(name))
        else {
            return Err(Problem::NoColumn {
                file: self.file.clone(),
                column: name.to_owned(),
                known: self.provenance.columns.keys().cloned().collect::<Vec<_>>().join(", "),
            });
        };
        if column.unit.as_str() != unit {
            return Err(Problem::OtherUnit {
                file: self.file.clone(),
                column: name.to_owned(),
                recorded: column.unit.as_str().to_owned(),
                asked: unit.to_owned(),
            });
        }
        Ok(numbers)
    }

    /// Number of rows; at least one.
    pub fn rows(&self) -> usize {
        self.numbers.values().next().map_or(0, Vec::len)
    }
}
