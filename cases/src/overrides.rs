//! `--set key.path=value`, variants and levels: a scene with some keys set to other values.
//!
//! The edit happens on the document, before it is read as a scene, so that an edited scene passes
//! every check a written one does.

use crate::error::{Error, Result};
use crate::names::hint;
use serde_json::Value as Json;
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, TableLike, Value};

/// One key and the value it is set to.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    /// Key path, e.g. `bodies.middle.de.rows` or `bodies.left.box.max[0]`.
    pub key: String,
    /// The value.
    pub value: Json,
}

impl Override {
    /// From the command line: `key.path=value`, where the value is TOML, or plain text.
    ///
    /// # Errors
    /// No `=`.
    pub fn parse(text: &str) -> Result<Self> {
        let Some((key, value)) = text.split_once('=') else {
            return Err(Error::Override {
                key: text.to_owned(),
                value: String::new(),
                message: "expected key.path=value, e.g. parameters.rows=16".to_owned(),
            });
        };
        let (key, value) = (key.trim().to_owned(), value.trim());
        let parsed = toml::from_str::<std::collections::BTreeMap<String, Json>>(&format!("v = {value}"));
        let value = match parsed {
            Ok(mut table) => table.remove("v").unwrap_or(Json::Null),
            Err(_) => Json::String(value.to_owned()),
        };
        Ok(Self { key, value })
    }

    /// `key=value`, as [`Override::parse`] reads it.
    pub fn text(&self) -> String {
        format!("{}={}", self.key, to_toml(&self.value).to_string().trim())
    }

    fn error(&self, message: String) -> Error {
        Error::Override { key: self.key.clone(), value: label(&self.value), message }
    }
}

/// A value as one word, for labels and messages.
pub fn label(value: &Json) -> String {
    match value {
        Json::String(s) => s.clone(),
        other => other.to_string(),
    }
}

/// The text with the overrides applied in order.
///
/// # Errors
/// A path that does not lead to a table or a value of the scene, with the nearest name.
pub fn apply(text: &str, overrides: &[Override]) -> Result<String> {
    let mut document: DocumentMut = match text.parse() {
        Ok(document) => document,
        // Reading the text itself gives the better message.
        Err(_) => return Ok(text.to_owned()),
    };
    for change in overrides {
        set(document.as_item_mut(), change)?;
    }
    Ok(document.to_string())
}

fn set(root: &mut Item, change: &Override) -> Result<()> {
    let path: Vec<&str> =
        change.key.split(['.', '[']).map(|s| s.trim_end_matches(']')).filter(|s| !s.is_empty()).collect();
    let Some((last, parents)) = path.split_last() else {
        return Err(change.error("the key path is empty".to_owned()));
    };
    let mut place = Place::of_item(root);
    for name in parents {
        place = place.child(name).map_err(|message| change.error(message))?;
    }
    // The members of `parameters` are named by the scene, so a new name there is a slip.
    let may_be_new = parents != ["parameters"];
    place.assign(last, to_toml(&change.value), may_be_new).map_err(|message| change.error(message))
}

/// Where a path has led so far.
enum Place<'a> {
    Table(&'a mut dyn TableLike),
    Tables(&'a mut ArrayOfTables),
    Array(&'a mut Array),
    Plain,
}

impl<'a> Place<'a> {
    fn of_item(item: &'a mut Item) -> Self {
        match item {
            Item::Table(table) => Self::Table(table),
            Item::ArrayOfTables(tables) => Self::Tables(tables),
            Item::Value(value) => Self::of_value(value),
            Item::None => Self::Plain,
        }
    }

    fn of_value(value: &'a mut Value) -> Self {
        match value {
            Value::InlineTable(table) => Self::Table(table),
            Value::Array(array) => Self::Array(array),
            _ => Self::Plain,
        }
    }

    /// The member `name`: a key, an index, or the `name` of a table in an array.
    fn child(self, name: &str) -> std::result::Result<Place<'a>, String> {
        match self {
            Self::Table(table) => {
                let message = unknown(name, table);
                table.get_mut(name).map(Self::of_item).ok_or(message)
            }
            Self::Tables(tables) => {
                let named = tables.iter().position(|t| t.get("name").and_then(Item::as_str) == Some(name));
                let index = named.or_else(|| name.parse().ok());
                let table = index.and_then(|i| tables.get_mut(i));
                table.map(|t| Self::Table(t)).ok_or_else(|| format!("there is no element '{name}'"))
            }
            Self::Array(array) => element(array, name).map(Self::of_value),
            Self::Plain => Err(format!("'{name}' would lie inside a plain value")),
        }
    }

    fn assign(self, name: &str, value: Value, may_be_new: bool) -> std::result::Result<(), String> {
        match self {
            Self::Table(table) => {
                if !may_be_new && !table.contains_key(name) {
                    return Err(unknown(name, table));
                }
                match table.get_mut(name).and_then(Item::as_table_like_mut) {
                    // The long form of a parameter keeps its unit.
                    Some(long) if !may_be_new => long.insert("value", Item::Value(value)),
                    _ => table.insert(name, Item::Value(value)),
                };
                Ok(())
            }
            Self::Array(array) => element(array, name).map(|place| *place = value),
            Self::Tables(_) | Self::Plain => Err(format!("'{name}' would lie inside a plain value")),
        }
    }
}

fn unknown(name: &str, table: &dyn TableLike) -> String {
    let known: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    format!("unknown key '{name}'; {}", hint(name, known.iter().map(String::as_str)))
}

fn element<'a>(array: &'a mut Array, name: &str) -> std::result::Result<&'a mut Value, String> {
    let count = array.len();
    let value = name.parse().ok().and_then(|i: usize| array.get_mut(i));
    value.ok_or_else(|| format!("there is no element [{name}]; there are {count}, counted from 0"))
}

fn to_toml(value: &Json) -> Value {
    match value {
        Json::Bool(b) => (*b).into(),
        Json::Number(n) => match n.as_i64() {
            Some(i) => i.into(),
            None => n.as_f64().unwrap_or(f64::NAN).into(),
        },
        Json::String(s) => s.as_str().into(),
        Json::Array(elements) => elements.iter().map(to_toml).collect::<Array>().into(),
        Json::Object(members) => {
            members.iter().map(|(k, v)| (k.as_str(), to_toml(v))).collect::<InlineTable>().into()
        }
        // TOML has no null; reading the scene refuses the empty text with its place.
        Json::Null => "".into(),
    }
}
