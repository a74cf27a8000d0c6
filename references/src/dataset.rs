//! The checked numbers of a reference.

use crate::hash::Sha256;
use crate::problem::{Problem, Result};
use crate::provenance::Provenance;
use std::collections::BTreeMap;

/// Columns of finite numbers or names, of one length, and where they come from.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    pub(crate) file: String,
    /// Where the numbers come from.
    pub provenance: Provenance,
    pub(crate) numbers: BTreeMap<String, Vec<f64>>,
    pub(crate) names: BTreeMap<String, Vec<String>>,
}

impl Dataset {
    /// The numbers of a column, which must be in `unit`: nobody reads millimetres as metres.
    ///
    /// # Errors
    /// No such column; another unit.
    pub fn column(&self, name: &str, unit: &str) -> Result<&[f64]> {
        let (Some(column), Some(numbers)) = (self.provenance.columns.get(name), self.numbers.get(name))
        else {
            return Err(self.no_column(name));
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

    /// The entries of a column of names.
    ///
    /// # Errors
    /// No such column.
    pub fn words(&self, name: &str) -> Result<&[String]> {
        self.names.get(name).map(Vec::as_slice).ok_or_else(|| self.no_column(name))
    }

    fn no_column(&self, name: &str) -> Problem {
        Problem::NoColumn {
            file: self.file.clone(),
            column: name.to_owned(),
            known: self.provenance.columns.keys().cloned().collect::<Vec<_>>().join(", "),
        }
    }

    /// Number of rows; at least one.
    pub fn rows(&self) -> usize {
        let lengths = self.numbers.values().map(Vec::len).chain(self.names.values().map(Vec::len));
        lengths.max().unwrap_or(0)
    }

    /// Whether it was made from exactly these inputs, given by name.
    ///
    /// # Errors
    /// [`Problem::OutOfDate`] for the first input that is new, gone or different.
    pub fn made_from(&self, inputs: &BTreeMap<String, Sha256>) -> Result<()> {
        let recorded = &self.provenance.inputs;
        let changed =
            inputs.keys().chain(recorded.keys()).find(|name| inputs.get(*name) != recorded.get(*name));
        changed.map_or(Ok(()), |input| {
            Err(Problem::OutOfDate {
                file: self.file.replace(".csv", ".toml"),
                input: input.clone(),
                command: self.provenance.command.clone(),
            })
        })
    }

    /// Largest difference of any number from the one in the same place of `other`, relative to the largest of its column in
    /// `other`; `None` if the tables do not have the same columns and rows.
    pub fn difference(&self, other: &Dataset) -> Option<f64> {
        let alike = self.rows() == other.rows()
            && self.numbers.keys().eq(other.numbers.keys())
            && self.names == other.names;
        alike.then(|| {
            let of_column = |(a, b): (&Vec<f64>, &Vec<f64>)| {
                let largest = b.iter().fold(0.0f64, |m, b| m.max(b.abs()));
                let change = a.iter().zip(b).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
                if largest > 0.0 { change / largest } else { change }
            };
            self.numbers.values().zip(other.numbers.values()).map(of_column).fold(0.0, f64::max)
        })
    }
}
