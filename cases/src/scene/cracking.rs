//! `[cracking]`: loads and moving supports grow in proportion until bonds fail one by one.

use super::number::Number;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Quasi-static cracking by events; the path may snap back. It stops at the first limit that it meets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cracking {
    /// Most failures.
    #[serde(default = "many")]
    pub events: Number,
    /// Largest factor on the loads or on the displacements of the supports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub factor_limit: Option<Number>,
    /// Share of the first stiffness at which the path ends.
    #[serde(default = "hundredth")]
    pub least_stiffness: Number,
}

fn many() -> Number {
    Number::Literal(10_000.0)
}

fn hundredth() -> Number {
    Number::Literal(0.01)
}
