//! Which effects were simulated, and whether those that were not may be left out.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One effect of a scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EffectUse {
    /// Name as in the scene file, e.g. `rotation-coupling`.
    pub name: String,
    /// Whether it was simulated.
    pub on: bool,
    /// Why it was switched on or left out.
    pub why: String,
    /// Work done for it alone; exactly zero when off.
    pub counter: u64,
}
