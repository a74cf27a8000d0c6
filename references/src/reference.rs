//! A reference as it lies in its files, not yet believed.

use crate::dataset::Dataset;
use crate::hash::Sha256;
use crate::problem::{Problem, Result};
use crate::provenance::Provenance;
use crate::table::{self, Table};
use std::borrow::Cow;

/// Two files that have been found but not checked. [`Reference::open`] gives the numbers.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Case it belongs to, the name of its folder.
    pub case: String,
    /// Where the numbers come from, the name of its files.
    pub source: String,
    /// The CSV file, for messages.
    pub csv_file: String,
    /// The provenance file, for messages.
    pub provenance_file: String,
    /// Bytes of the CSV.
    pub csv: Cow<'static, [u8]>,
    /// Text of the provenance file.
    pub provenance: Cow<'static, str>,
}

impl Reference {
    pub(crate) fn new(
        folder: &str,
        case: &str,
        source: &str,
        csv: Cow<'static, [u8]>,
        provenance: Cow<'static, str>,
    ) -> Self {
        Self {
            case: case.to_owned(),
            source: source.to_owned(),
            csv_file: format!("{folder}/{case}/{source}.csv"),
            provenance_file: format!("{folder}/{case}/{source}.toml"),
            csv,
            provenance,
        }
    }

    /// `<case>/<source>`, as in its provenance.
    pub fn id(&self) -> String {
        format!("{}/{}", self.case, self.source)
    }

    /// Its numbers and where they come from, once everything about them holds.
    ///
    /// # Errors
    /// Provenance that is incomplete or of another reference; a CSV whose hash is not the recorded
    /// one; columns that are not the described ones; a number that is not finite.
    pub fn open(&self) -> Result<Dataset> {
        let provenance = Provenance::parse(&self.provenance_file, &self.provenance, &self.id())?;
        let found = Sha256::of(&self.csv);
        if found != provenance.csv_sha256 {
            return Err(Problem::Altered {
                file: self.csv_file.clone(),
                recorded: provenance.csv_sha256,
                found,
                command: provenance.command,
            });
        }
        let Table { numbers, names } = table::parse(&self.csv_file, &self.csv, &provenance.columns)?;
        Ok(Dataset { file: self.csv_file.clone(), provenance, numbers, names })
    }
}
