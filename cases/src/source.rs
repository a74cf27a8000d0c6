//! The text of a scene: where every key stands, and errors that point at it.

use crate::error::{Diagnostic, Error, Fault, Result};
use crate::names::nearest;
use crate::scene::Scene;
use std::ops::Range;
use toml_edit::{Document, Item, TableLike, Value};

/// A scene file as text.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// File as the user named it.
    pub file: String,
    /// Its text, overrides applied.
    pub text: String,
    /// The overrides, as `key=value`.
    pub overrides: Vec<String>,
}

/// A key with the places of its name and its value.
struct Entry {
    path: String,
    name: Option<Range<usize>>,
    value: Option<Range<usize>>,
}

impl Source {
    /// Reads the scene.
    ///
    /// # Errors
    /// Not TOML, an unknown or missing key, a value of the wrong kind: with line, column and key.
    pub fn parse(&self) -> Result<Scene> {
        toml::from_str(&self.text).map_err(|e| {
            let at = e.span().unwrap_or(0..0);
            let message = e.message().replace('\n', " ");
            let (message, mend) = reword(&message);
            self.diagnostic(at.clone(), Fault::new(self.key_at(&at), message, mend))
        })
    }

    /// The error for a fault, with its place in the text. A key that is absent points at its table.
    pub fn error(&self, fault: Fault) -> Error {
        let entries = self.entries();
        let mut path = fault.key.as_str();
        loop {
            if let Some(entry) = entries.iter().find(|e| e.path == path) {
                // A table's own place is its header; the name stands in there.
                let at = entry.value.clone().or_else(|| entry.name.clone()).unwrap_or(0..0);
                return self.diagnostic(at, fault);
            }
            match path.rfind(['.', '[']) {
                Some(end) => path = &path[..end],
                None => return self.diagnostic(0..0, fault),
            }
        }
    }

    fn diagnostic(&self, at: Range<usize>, fault: Fault) -> Error {
        let start = floor_boundary(&self.text, at.start);
        let before = &self.text[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = self.text[line_start..].lines().next().unwrap_or("");
        let end = floor_boundary(&self.text, at.end).min(line_start + line.len()).max(start);
        Error::Scene(Box::new(Diagnostic {
            file: self.file.clone(),
            line: before.matches('\n').count() + 1,
            column: self.text[line_start..start].chars().count() + 1,
            width: self.text[start..end].chars().count(),
            source: line.to_owned(),
            fault,
            overrides: self.overrides.clone(),
        }))
    }

    /// Path of the innermost key at a place; empty outside of all keys.
    fn key_at(&self, at: &Range<usize>) -> String {
        let inside = |r: &Option<Range<usize>>| {
            r.as_ref().is_some_and(|r| r.start <= at.start && at.start < r.end && at.end <= r.end)
        };
        self.entries()
            .into_iter()
            .filter(|e| inside(&e.name) || inside(&e.value))
            .max_by_key(|e| e.path.len())
            .map_or(String::new(), |e| e.path)
    }

    /// All keys of the text; none if it is not TOML.
    fn entries(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        if let Ok(document) = Document::parse(self.text.clone()) {
            walk_table(document.as_table(), "", &mut entries);
        }
        entries
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

fn walk_table(table: &dyn TableLike, prefix: &str, entries: &mut Vec<Entry>) {
    for (name, item) in table.iter() {
        let path = if prefix.is_empty() { name.to_owned() } else { format!("{prefix}.{name}") };
        let name_at = table.key(name).and_then(|k| k.span());
        entries.push(Entry { path: path.clone(), name: name_at, value: item.span() });
        walk_item(item, &path, entries);
    }
}

fn walk_item(item: &Item, path: &str, entries: &mut Vec<Entry>) {
    if let Some(table) = item.as_table_like() {
        walk_table(table, path, entries);
    } else if let Some(tables) = item.as_array_of_tables() {
        for (i, table) in tables.iter().enumerate() {
            let path = format!("{path}[{i}]");
            entries.push(Entry { path: path.clone(), name: None, value: table.span() });
            walk_table(table, &path, entries);
        }
    } else if let Some(value) = item.as_value() {
        walk_value(value, path, entries);
    }
}

fn walk_value(value: &Value, path: &str, entries: &mut Vec<Entry>) {
    for (i, element) in value.as_array().into_iter().flatten().enumerate() {
        let path = format!("{path}[{i}]");
        entries.push(Entry { path: path.clone(), name: None, value: element.span() });
        if let Some(table) = element.as_inline_table() {
            walk_table(table, &path, entries);
        }
        walk_value(element, &path, entries);
    }
}

/// Turns serde's sentence into what is wrong and what to do.
fn reword(message: &str) -> (String, String) {
    let words: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let choice = |known: &[&str]| match words.first().and_then(|w| nearest(w, known.iter().copied())) {
        Some(near) => format!("did you mean '{near}'?"),
        None => format!("use one of: {}", known.join(", ")),
    };
    let quoted = |what: &str| format!("{what} '{}'", words.first().unwrap_or(&""));
    if message.starts_with("unknown field") {
        (quoted("unknown key"), choice(&words[1..]))
    } else if message.starts_with("unknown variant") {
        (quoted("unknown value"), choice(&words[1..]))
    } else if message.starts_with("missing field") {
        (quoted("missing key"), "add it to this table".to_owned())
    } else if message.starts_with("duplicate key") {
        (message.to_owned(), "ids are unique: rename or remove one of the two".to_owned())
    } else {
        (message.to_owned(), String::new())
    }
}
