//! One side of a tie: its trace, and its unknowns.

use super::trace::{FacePoint, Frame, Trace};
use crate::fem::locate::Locator;
use crate::space::{Space, Vec3};

/// `(unknown, coefficient)` pairs: a linear form in the unknowns.
pub type Terms = Vec<(usize, f64)>;

/// What turns on this side.
pub enum Turning<'a> {
    /// Particles carry rotations of their own.
    Particles,
    /// Elements turn by half the curl of their displacement.
    Elements {
        /// Finds the element at a point of the face.
        locator: Locator<'a>,
        /// How far, in m, a point of the face may lie outside the elements: rounding.
        within: f64,
    },
}

/// One side of a tie.
pub struct Side<'a> {
    /// Trace on the face.
    pub trace: Trace,
    /// First unknown of the part.
    pub offset: usize,
    /// Unknowns per point.
    pub per_point: usize,
    /// How it turns.
    pub turning: Turning<'a>,
    /// Name of the part, for labels.
    pub name: &'a str,
}

impl Side<'_> {
    /// Whether the points are particles.
    pub fn is_discrete(&self) -> bool {
        matches!(self.turning, Turning::Particles)
    }

    /// `particle` or `node`, for labels.
    pub fn noun(&self) -> &'static str {
        if self.is_discrete() { "particle" } else { "node" }
    }

    /// Unknown of component `c` of the point with this index in the trace.
    pub fn unknown(&self, point: usize, c: usize) -> usize {
        self.offset + self.trace.points[point] * self.per_point + c
    }

    /// Component `c` of the displacement interpolated with `weights`.
    pub fn displacement(&self, weights: &[(usize, f64)], c: usize) -> Terms {
        weights.iter().map(|&(point, n)| (self.unknown(point, c), n)).collect()
    }

    /// Rotation about `axis` at a point of the face: `Σ N_i θ_i` for particles,
    /// `½ (∂_a u_b − ∂_b u_a)` with `(axis, a, b)` cyclic for elements; `None` outside the body.
    pub fn rotation(
        &self,
        frame: &Frame,
        s: &FacePoint,
        weights: &[(usize, f64)],
        axis: usize,
    ) -> Option<Terms> {
        match &self.turning {
            Turning::Particles => {
                let component = match self.trace.space {
                    Space::Plane => 2,
                    Space::Solid => 3 + axis,
                };
                Some(self.displacement(weights, component))
            }
            Turning::Elements { locator, within } => {
                let at = locator.find_nearest(frame.lift(s), *within)?;
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                let unknown = |node: usize, c: usize| self.offset + node * self.per_point + c;
                Some(
                    at.gradients
                        .iter()
                        .flat_map(|(node, g)| {
                            [(unknown(*node, b), 0.5 * g[a]), (unknown(*node, a), -0.5 * g[b])]
                        })
                        .collect(),
                )
            }
        }
    }

    /// Position of a point of the trace.
    pub fn position(&self, point: usize) -> Vec3 {
        self.trace.positions[point]
    }
}

/// Appends `factor · terms` to `row`.
pub fn accumulate(row: &mut Terms, terms: Terms, factor: f64) {
    row.extend(terms.into_iter().map(|(unknown, n)| (unknown, factor * n)));
}

/// `u_x` … for labels: displacement components, then rotations.
pub fn component_name(space: Space, c: usize) -> &'static str {
    match (space, c) {
        (_, 0) => "u_x",
        (_, 1) => "u_y",
        (Space::Plane, _) => "θ_z",
        (Space::Solid, 2) => "u_z",
        (Space::Solid, 3) => "θ_x",
        (Space::Solid, 4) => "θ_y",
        (Space::Solid, _) => "θ_z",
    }
}
