//! Ties between bodies that share a face: non-overlapping coupling by Lagrange multipliers.
//!
//! Each tie becomes rows `B u = 0`. [`pointwise`] ties every point of one face to the
//! interpolated motion of the other; [`mortar`] ties weighted averages, integrated segment by
//! segment; [`rotation`] adds the particles' rotations to either. [`rank`] finds the rows that
//! say nothing new.

pub mod assemble;
pub mod mortar;
pub mod pointwise;
pub mod rank;
pub mod rotation;
pub mod side;
pub mod trace;

use serde::{Deserialize, Serialize};

/// One constraint `Σ coefficient · u[unknown] = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// `(unknown, coefficient)`, ascending by unknown, each once.
    pub terms: Vec<(usize, f64)>,
    /// What the row ties, in words: `tie 'left': particle 12, u_y`.
    pub label: String,
    /// Where it acts, for ordering the elimination.
    pub position: crate::space::Vec3,
}

impl Row {
    /// A row from terms in any order; those of one unknown add up, and what is rounding beside the largest
    /// coefficient vanishes: once supports are taken out it could be all that is left of a row.
    pub fn new(mut terms: Vec<(usize, f64)>, label: String, position: crate::space::Vec3) -> Self {
        terms.sort_by_key(|t| t.0);
        let mut merged: Vec<(usize, f64)> = Vec::with_capacity(terms.len());
        for (unknown, value) in terms {
            match merged.last_mut() {
                Some(last) if last.0 == unknown => last.1 += value,
                _ => merged.push((unknown, value)),
            }
        }
        let largest = merged.iter().fold(0.0f64, |m, t| m.max(t.1.abs()));
        merged.retain(|t| t.1.abs() > 1e-12 * largest);
        Row { terms: merged, label, position }
    }
}

/// How the two faces are tied.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Every point of the finer face follows the interpolated motion of the other one.
    #[default]
    Pointwise,
    /// Weighted averages of the motion agree, integrated over the common refinement of both faces.
    Mortar,
}

/// Which face carries the multipliers.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Multipliers {
    /// Mortar: the face with fewer points. Pointwise: particles before nodes, then the finer face.
    #[default]
    Auto,
    /// The first body of the tie.
    First,
    /// The second body of the tie.
    Second,
}

/// A tie between a face of one part and a face of another.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// Name, for messages.
    pub name: String,
    /// First side: index of the part and name of its face.
    pub first: (usize, String),
    /// Second side.
    pub second: (usize, String),
    /// Pointwise or mortar.
    pub method: Method,
    /// Which face carries the multipliers.
    pub multipliers: Multipliers,
    /// Whether the particles' rotations follow the rotation of the other side.
    pub rotations: bool,
}
