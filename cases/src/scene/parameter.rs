//! `[parameters]`: named numbers that expressions use.

use super::number::Number;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// `rows = 8`, or `height_m = { value = 0.1, unit = "m", about = "height of the beam" }`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// The value; may use other parameters.
    pub value: Number,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// What it is, and where it comes from.
    pub about: String,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct LongForm {
    value: Number,
    #[serde(default = "pure_number")]
    unit: String,
    #[serde(default)]
    about: String,
}

fn pure_number() -> String {
    "1".to_owned()
}

impl From<Number> for Parameter {
    fn from(value: Number) -> Self {
        Self { value, unit: pure_number(), about: String::new() }
    }
}

impl<'de> Deserialize<'de> for Parameter {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ParameterVisitor)
    }
}

/// Written out because serde's `untagged` would hide what is wrong inside either form.
struct ParameterVisitor;

impl<'de> Visitor<'de> for ParameterVisitor {
    type Value = Parameter;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, an expression in quotes, or { value, unit, about }")
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Parameter, E> {
        Number::deserialize(de::value::I64Deserializer::new(value)).map(Parameter::from)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Parameter, E> {
        Number::deserialize(de::value::F64Deserializer::new(value)).map(Parameter::from)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Parameter, E> {
        Number::deserialize(de::value::StrDeserializer::new(text)).map(Parameter::from)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Parameter, A::Error> {
        let LongForm { value, unit, about } = LongForm::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Parameter { value, unit, about })
    }
}

impl JsonSchema for Parameter {
    fn schema_name() -> Cow<'static, str> {
        "Parameter".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let number = generator.subschema_for::<Number>();
        json_schema!({
            "description": "A named number that expressions use.",
            "oneOf": [
                number,
                {
                    "type": "object",
                    "required": ["value"],
                    "additionalProperties": false,
                    "properties": {
                        "value": number,
                        "unit": { "type": "string", "description": "SI unit, `1` for a pure number." },
                        "about": { "type": "string", "description": "What it is, and where it comes from." }
                    }
                }
            ]
        })
    }
}
