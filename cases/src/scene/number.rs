//! A number in a scene file: a TOML number, or an expression with parameters as a string.

use crate::error::Fault;
use crate::expression::{Expression, Values};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use seam_solver::space::Vec3;
use serde::de::{self, Deserialize, Deserializer, Visitor};
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// `0.1`, or `"slenderness*height_m"`. Where a field is meant, `x`, `y`, `z` (m) may occur.
#[derive(Debug, Clone, PartialEq)]
pub enum Number {
    /// A TOML number, finite.
    Literal(f64),
    /// An expression.
    Formula(Expression),
}

impl Number {
    /// The value with the parameters of the scene.
    ///
    /// # Errors
    /// A fault at `key`: unknown name, division by zero, not finite.
    pub fn value(&self, values: &Values, key: &str) -> Result<f64, Fault> {
        match self {
            Self::Literal(v) => Ok(*v),
            Self::Formula(e) => {
                e.value(values).map_err(|error| Fault::new(key, error.to_string(), mend(&error.message)))
            }
        }
    }

    /// Names it uses.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::Literal(_) => Vec::new(),
            Self::Formula(e) => e.names(),
        }
    }

    /// The value as a whole number of at least `least` (rounded: `0.9/0.1` means 9).
    ///
    /// # Errors
    /// As [`Number::value`]; not near a whole number, or too small.
    pub fn count(&self, values: &Values, least: usize, key: &str) -> Result<usize, Fault> {
        let value = self.value(values, key)?;
        let near = value.round();
        // 1e-6 forgives the rounding of an expression and nothing else.
        if (value - near).abs() > 1e-6 || near < least as f64 || near > 1e9 {
            let message = format!("expected a whole number of at least {least}, found {value}");
            return Err(Fault::new(key, message, "round the expression, or change a parameter"));
        }
        Ok(near as usize)
    }

    /// The value of a field at `x` (m).
    ///
    /// # Errors
    /// As [`Number::value`].
    pub fn at(&self, x: Vec3, values: &Values, key: &str) -> Result<f64, Fault> {
        match self {
            Self::Literal(v) => Ok(*v),
            Self::Formula(_) => {
                let mut here = values.clone();
                for (name, value) in ["x", "y", "z"].into_iter().zip(x.iter()) {
                    here.insert(name.to_owned(), *value);
                }
                self.value(&here, key)
            }
        }
    }
}

impl Number {
    /// The value at the time `t` (s).
    ///
    /// # Errors
    /// As [`Number::value`].
    pub fn at_time(&self, t: f64, values: &Values, key: &str) -> Result<f64, Fault> {
        let mut now = values.clone();
        now.insert("t".to_owned(), t);
        self.value(&now, key)
    }
}

fn mend(message: &str) -> &'static str {
    if message.starts_with("unknown name") {
        "declare it under [parameters], or correct its spelling"
    } else {
        "check the expression and the parameters in it"
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self::Literal(value)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Literal(v) => serializer.serialize_f64(*v),
            Self::Formula(e) => serializer.collect_str(e),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or an expression in quotes such as \"2*height_m\"")
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Number, E> {
        Ok(Number::Literal(value as f64))
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Number, E> {
        if !value.is_finite() {
            return Err(E::custom(format!("expected a finite number, found {value}")));
        }
        Ok(Number::Literal(value))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Number, E> {
        Expression::parse(text).map(Number::Formula).map_err(E::custom)
    }
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or an expression in quotes with parameters: \"slenderness*height_m\". Fields may also use x, y, z.",
            "type": ["number", "string"]
        })
    }
}
