//! `[peers.NAME]`: what another code made of the scene, or of a variant of it.

use crate::result::ReferenceKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A run of another code, kept in `references/data/<case>/<NAME>-<code>`. The probes of the scene read it like a run of Seam.
///
/// YADE and LAMMPS are given the one network of the variants, and answer with displacements and rotations of its
/// particles. CalculiX answers with the deflection `uy` along a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Peer {
    /// What was computed, in words.
    pub about: String,
    /// The code: `yade`, `lammps` or `calculix`.
    pub code: ReferenceKind,
    /// YADE and LAMMPS: variants of the scene that are one body of particles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
}
