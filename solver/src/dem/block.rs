//! The axis-aligned box that a discrete-element body fills, and its named faces.

use crate::error::{Error, Result};
use crate::space::{Space, Vec3, components};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Names of the faces with their axis and whether they lie at its upper end: x, y, then z.
/// A plane body has the first four.
pub const FACES: [(&str, usize, bool); 6] = [
    ("left", 0, false),
    ("right", 0, true),
    ("bottom", 1, false),
    ("top", 1, true),
    ("back", 2, false),
    ("front", 2, true),
];

/// A point counts as lying on a face within this share of the longest side: wide enough for
/// coordinates read from decimal text, far below any particle's radius.
const ON_FACE: f64 = 1e-9;

/// An axis-aligned box; a rectangle at z = 0 in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Corner of smallest coordinates, in metres.
    #[serde(with = "components")]
    pub min: Vec3,
    /// Corner of largest coordinates, in metres.
    #[serde(with = "components")]
    pub max: Vec3,
}

impl Block {
    /// A box between two corners (m).
    ///
    /// # Errors
    /// A corner that is not finite, or a side that is not positive (the plane has two sides).
    pub fn new(space: Space, min: Vec3, max: Vec3) -> Result<Self> {
        for axis in 0..space.dim() {
            let side = max[axis] - min[axis];
            if !(side.is_finite() && side > 0.0) {
                return Err(Error::Geometry {
                    what: "box".into(),
                    message: format!(
                        "its side along {} runs from {} to {}; give finite corners, the smaller first",
                        ["x", "y", "z"][axis],
                        min[axis],
                        max[axis]
                    ),
                });
            }
        }
        let flat =
            |corner: Vec3| if space == Space::Plane { Vec3::new(corner.x, corner.y, 0.0) } else { corner };
        Ok(Self { min: flat(min), max: flat(max) })
    }

    /// A box of given sides (m) with one corner in the origin.
    ///
    /// # Errors
    /// A side that is not finite and positive.
    pub fn at_origin(space: Space, sides: Vec3) -> Result<Self> {
        Self::new(space, Vec3::zeros(), sides)
    }

    /// Lengths of the sides, in metres.
    pub fn sides(&self) -> Vec3 {
        self.max - self.min
    }

    /// Area (m²) in the plane, volume (m³) in the solid.
    pub fn measure(&self, space: Space) -> f64 {
        self.sides().iter().take(space.dim()).product()
    }

    /// The smallest box around both.
    pub fn around(&self, other: &Block) -> Block {
        Block { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Names of the faces a space has.
    pub fn faces(space: Space) -> &'static [(&'static str, usize, bool)] {
        &FACES[..2 * space.dim()]
    }

    /// Whether a point lies on the face at the lower or upper end of an axis.
    pub fn on_face(&self, x: Vec3, axis: usize, upper: bool) -> bool {
        let face = if upper { self.max[axis] } else { self.min[axis] };
        (x[axis] - face).abs() <= ON_FACE * self.sides().max()
    }

    /// The points on each face by its name, ascending; a point on an edge is in both faces.
    pub fn points_on_faces(&self, space: Space, points: &[Vec3]) -> BTreeMap<String, Vec<usize>> {
        let on = |axis, upper| (0..points.len()).filter(|&p| self.on_face(points[p], axis, upper)).collect();
        Self::faces(space).iter().map(|&(name, axis, upper)| (name.to_owned(), on(axis, upper))).collect()
    }
}
