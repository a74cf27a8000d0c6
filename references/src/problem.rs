//! What can be wrong with a reference, where, and what to do.

use crate::hash::Sha256;
use thiserror::Error;

/// Result of finding or opening a reference.
pub type Result<T> = std::result::Result<T, Problem>;

/// A reference that is missing, altered or cannot be believed: nothing can be measured against it.
#[derive(Debug, Error)]
pub enum Problem {
    /// There is no such reference.
    #[error("there is no reference '{id}'; known are: {known}")]
    Unknown {
        /// `<case>/<source>` as asked for.
        id: String,
        /// All that there are.
        known: String,
    },
    /// A folder without references.
    #[error("{folder}: no references; put them there as <case>/<source>.csv with <source>.toml beside it")]
    Empty {
        /// The folder.
        folder: String,
    },
    /// A file or folder that cannot be read.
    #[error("{file}: {source}")]
    Unreadable {
        /// The file or folder.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// A CSV without its provenance, or the other way round.
    #[error("{file}: {missing} is missing; run the generator again, which writes both")]
    Unpaired {
        /// The file that is there.
        file: String,
        /// The file that is not.
        missing: String,
    },
    /// A provenance file that is incomplete or wrong.
    #[error("{file}:{line}:{column}: {message}")]
    Provenance {
        /// The file.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong and what to do.
        message: String,
    },
    /// A CSV that is not the one that was recorded.
    #[error(
        "{file}: altered: its SHA-256 is {found}, its provenance records {recorded}; restore the file, or make it again with: {command}"
    )]
    Altered {
        /// The file.
        file: String,
        /// Hash in its provenance.
        recorded: Sha256,
        /// Hash of the file.
        found: Sha256,
        /// The command that writes it.
        command: String,
    },
    /// A reference made from an input that has changed since.
    #[error(
        "{file}: out of date: its input '{input}' is not what Seam exports now; undo that change, or make it again with: {command}"
    )]
    OutOfDate {
        /// The provenance file.
        file: String,
        /// Name of the input.
        input: String,
        /// The command that writes it.
        command: String,
    },
    /// A CSV that does not read as its provenance says.
    #[error("{file}:{line}: {}{message}", if column.is_empty() { String::new() } else { format!("column '{column}' ") })]
    Table {
        /// The file.
        file: String,
        /// Line, from 1.
        line: u64,
        /// Name of the column, empty where no single one is at fault.
        column: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A column that was asked for and is not there.
    #[error("{file}: there is no column '{column}'; the columns are: {known}")]
    NoColumn {
        /// The file.
        file: String,
        /// Name as asked for.
        column: String,
        /// All that there are.
        known: String,
    },
    /// A column that was asked for in another unit than it is in.
    #[error(
        "{file}: column '{column}' is in '{recorded}', not in '{asked}'; convert it, or ask for its own unit"
    )]
    OtherUnit {
        /// The file.
        file: String,
        /// Name of the column.
        column: String,
        /// Unit in the provenance.
        recorded: String,
        /// Unit as asked for.
        asked: String,
    },
}
