//! What can go wrong between a scene file and its result.

use std::fmt;
use thiserror::Error;

/// Result of anything that reads or runs a scene.
pub type Result<T> = std::result::Result<T, Error>;

/// A failure that the user can mend.
#[derive(Debug, Error)]
pub enum Error {
    /// Something in a scene file is wrong.
    #[error("{0}")]
    Scene(Box<Diagnostic>),
    /// The solver refused or failed on a scene.
    #[error("case '{case}': {source}")]
    Solver {
        /// Id of the case.
        case: String,
        /// What the solver says.
        source: seam_solver::error::Error,
    },
    /// A file could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// A checkpoint from which this case cannot go on.
    #[error("{path}: {message}")]
    Checkpoint {
        /// The file.
        path: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// There is no such case.
    #[error("there is no case '{id}'; {hint}")]
    UnknownCase {
        /// What was asked for.
        id: String,
        /// Nearest name, or all names.
        hint: String,
    },
    /// An override that does not fit the scene.
    #[error("--set {key}={value}: {message}")]
    Override {
        /// Key path as given.
        key: String,
        /// Value as given.
        value: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// A reference that is missing, incomplete or altered.
    #[error("case '{case}': reference {source}")]
    Reference {
        /// Id of the case.
        case: String,
        /// What is wrong with it.
        source: Box<seam_references::Problem>,
    },
    /// A study that gave nothing to judge.
    #[error("case '{case}': {message}")]
    Study {
        /// Id of the case.
        case: String,
        /// What is wrong and what to do.
        message: String,
    },
}

/// What is wrong at which key: a [`Diagnostic`] before its place in the file is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Key path, e.g. `bodies.left.fe.divisions[1]`.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub mend: String,
}

impl Fault {
    /// A fault at `key`.
    pub fn new(key: impl Into<String>, message: impl Into<String>, mend: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into(), mend: mend.into() }
    }
}

/// What is wrong in a scene file, where, and what to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// File as the user named it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// How many characters the wrong thing takes up.
    pub width: usize,
    /// The line itself.
    pub source: String,
    /// What is wrong, at which key, and what to do.
    pub fault: Fault,
    /// Overrides that were applied before the file was read; line and column count with them.
    pub overrides: Vec<String>,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, width, source, fault, overrides } = self;
        let margin = line.to_string().len();
        writeln!(f, "{file}:{line}:{column}: {}", fault.message)?;
        if !fault.key.is_empty() {
            writeln!(f, "{:margin$} = key: {}", "", fault.key)?;
        }
        writeln!(f, "{line} | {source}")?;
        write!(
            f,
            "{:margin$} | {:skip$}{:^<width$}",
            "",
            "",
            "",
            skip = column - 1,
            width = (*width).max(1)
        )?;
        if !fault.mend.is_empty() {
            write!(f, "\n{:margin$} = mend: {}", "", fault.mend)?;
        }
        if !overrides.is_empty() {
            write!(f, "\n{:margin$} = note: after the override {}", "", overrides.join(", "))?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}
