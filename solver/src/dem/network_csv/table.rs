//! One CSV table with named columns, whose errors know their place.

use crate::error::{Error, Result};
use csv::StringRecord;

/// A table: which column has which name, and its rows with their line numbers.
pub struct Table<'a> {
    file: &'a str,
    header: StringRecord,
    rows: Vec<(usize, StringRecord)>,
}

/// One row of a table.
#[derive(Clone, Copy)]
pub struct Row<'a> {
    table: &'a Table<'a>,
    line: usize,
    record: &'a StringRecord,
}

impl<'a> Table<'a> {
    /// Parses a table that must have the `required` columns and may have the `optional` ones.
    pub fn parse(file: &'a str, bytes: &[u8], required: &[&str], optional: &[&str]) -> Result<Self> {
        let fail = |line, message| Err(Error::File { file: file.to_owned(), line, message });
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
        let header = match reader.headers() {
            Ok(header) => header.clone(),
            Err(error) => return fail(Some(1), describe(&error)),
        };
        let known = required.iter().chain(optional);
        let names = known.clone().copied().collect::<Vec<_>>().join(",");
        for (k, name) in header.iter().enumerate() {
            if !known.clone().any(|n| *n == name) {
                return fail(Some(1), format!("unknown column '{name}'; the columns are {names}"));
            }
            if header.iter().take(k).any(|n| n == name) {
                return fail(Some(1), format!("column '{name}' comes twice; remove one"));
            }
        }
        if let Some(missing) = required.iter().find(|r| !header.iter().any(|n| n == **r)) {
            return fail(Some(1), format!("column '{missing}' is missing; the columns are {names}"));
        }
        let mut rows = Vec::new();
        for record in reader.into_records() {
            match record {
                Ok(record) => rows.push((record.position().map_or(0, |p| p.line() as usize), record)),
                Err(error) => return fail(error.position().map(|p| p.line() as usize), describe(&error)),
            }
        }
        Ok(Self { file, header, rows })
    }

    /// Rows in the order of the file.
    pub fn rows(&'a self) -> impl Iterator<Item = Row<'a>> {
        self.rows.iter().map(|(line, record)| Row { table: self, line: *line, record })
    }
}

/// A parser's complaint in words, without its own idea of the place.
fn describe(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} fields where the header has {expected_len}; add or remove a comma")
        }
        csv::ErrorKind::Utf8 { .. } => "not UTF-8 text; save the file as UTF-8".to_owned(),
        _ => error.to_string(),
    }
}

impl Row<'_> {
    /// An error in a column of this row.
    pub fn error(&self, column: &str, message: &str) -> Error {
        Error::File {
            file: self.table.file.to_owned(),
            line: Some(self.line),
            message: format!("column '{column}': {message}"),
        }
    }

    /// Line of the file, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    fn field(&self, column: &str) -> &str {
        let at = self.table.header.iter().position(|name| name == column);
        at.and_then(|k| self.record.get(k)).unwrap_or("")
    }

    /// A whole number.
    pub fn id(&self, column: &str) -> Result<i64> {
        let field = self.field(column);
        field.parse().map_err(|_| self.error(column, &format!("'{field}' is not a whole number")))
    }

    /// A finite number.
    pub fn number(&self, column: &str) -> Result<f64> {
        let field = self.field(column);
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(column, &format!("'{field}' is not a finite number"))),
        }
    }

    /// A finite number that is also `good`, or else `what` it must be.
    pub fn number_that(&self, column: &str, good: impl Fn(f64) -> bool, what: &str) -> Result<f64> {
        let value = self.number(column)?;
        if good(value) { Ok(value) } else { Err(self.error(column, &format!("{value} must be {what}"))) }
    }

    /// Whether an optional column is there and filled.
    pub fn has(&self, column: &str) -> bool {
        !self.field(column).is_empty()
    }
}
