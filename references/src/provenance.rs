//! Where the numbers of a reference come from: the TOML file beside the CSV.

use crate::hash::Sha256;
use crate::problem::{Problem, Result};
use crate::unit::Unit;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::value::Datetime;

/// What a reference is worth: who computed or measured it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A closed form, evaluated.
    Exact,
    /// Our own converged finite elements.
    OwnFem,
    /// CalculiX.
    Calculix,
    /// YADE.
    Yade,
    /// LAMMPS.
    Lammps,
    /// A measurement.
    Experiment,
    /// Taken from a publication, which the source cites.
    Published,
    /// Running times of several codes, Seam among them: no reference for any answer.
    Timing,
    /// Restated from notes: computed by prototypes that are neither published nor kept.
    Prototype,
}

impl Kind {
    /// Whether a code ran on input files, whose hashes must then be recorded.
    fn has_inputs(self) -> bool {
        matches!(self, Kind::OwnFem | Kind::Calculix | Kind::Yade | Kind::Lammps)
    }
}

/// One column of the CSV.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Its unit.
    pub unit: Unit,
    /// What it holds.
    #[serde(deserialize_with = "words")]
    pub about: String,
}

/// How far a second run of the same kind differs.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Repeat {
    /// Largest difference, relative to the largest number of its column; zero for equal bytes.
    #[serde(deserialize_with = "share")]
    pub difference: f64,
    /// What was repeated, and what changed between the runs.
    #[serde(deserialize_with = "words")]
    pub about: String,
}

/// Where numbers come from. Every field must be filled: what is not known is written down as such.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// `<case>/<source>`, as its files are named.
    pub id: Spanned<String>,
    /// Who computed or measured it.
    pub kind: Spanned<Kind>,
    /// What was computed or measured, and how.
    #[serde(deserialize_with = "words")]
    pub about: String,
    /// Author, year, title, figure or table; or who ran the code.
    #[serde(deserialize_with = "words")]
    pub source: String,
    /// Program that computed it.
    #[serde(deserialize_with = "words")]
    pub code: String,
    /// Version of the program.
    #[serde(deserialize_with = "words")]
    pub version: String,
    /// The command that writes both files again.
    #[serde(deserialize_with = "words")]
    pub command: String,
    /// When the files were written.
    pub date: Datetime,
    /// Class of machine, e.g. `x86-64, 2 cores, Debian 12`.
    #[serde(deserialize_with = "words")]
    pub machine: String,
    /// SHA-256 of the CSV.
    pub csv_sha256: Sha256,
    /// How well the numbers repeat.
    pub repeat: Repeat,
    /// SHA-256 of each input file of the code, by name.
    pub inputs: BTreeMap<String, Sha256>,
    /// Every column of the CSV, by name.
    pub columns: BTreeMap<String, Column>,
}

impl Provenance {
    /// Reads the provenance of the reference called `id`.
    pub(crate) fn parse(file: &str, text: &str, id: &str) -> Result<Self> {
        let problem = |span: Option<Range<usize>>, message: String| {
            let (line, column) = place(text, span.map_or(0, |s| s.start));
            Problem::Provenance { file: file.to_owned(), line, column, message }
        };
        let provenance: Self = toml::from_str(text).map_err(|e| problem(e.span(), e.message().to_owned()))?;
        if provenance.id.get_ref() != id {
            let message = format!(
                "id '{}' in the files of '{id}'; one of them has the wrong name",
                provenance.id.get_ref()
            );
            return Err(problem(Some(provenance.id.span()), message));
        }
        if provenance.kind.get_ref().has_inputs() && provenance.inputs.is_empty() {
            let message =
                "a code computed this, but no input is recorded; add its input files to [inputs]".to_owned();
            return Err(problem(Some(provenance.kind.span()), message));
        }
        Ok(provenance)
    }
}

/// Text that says something.
fn words<'de, D: Deserializer<'de>>(deserializer: D) -> std::result::Result<String, D::Error> {
    let text = String::deserialize(deserializer)?;
    if text.trim().is_empty() {
        return Err(D::Error::custom("blank; write what is known, or that it is not known"));
    }
    Ok(text)
}

/// A finite number from zero up.
fn share<'de, D: Deserializer<'de>>(deserializer: D) -> std::result::Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if !(value.is_finite() && value >= 0.0) {
        return Err(D::Error::custom(format!("{value} is no difference; give a finite number from zero up")));
    }
    Ok(value)
}

/// Line and column, from 1, of a byte.
fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..byte.min(text.len())];
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}
