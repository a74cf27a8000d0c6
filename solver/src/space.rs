//! The space a model lives in: the plane (one rotation) or the solid (three).

use serde::{Deserialize, Serialize};

/// A point, displacement, force … of three components; in the plane the third one is zero.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Plane or solid: how many displacements and rotations a point carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Space {
    /// Two displacements `u_x, u_y`; particles also turn by `θ_z`.
    Plane,
    /// Three displacements; particles also turn by `θ_x, θ_y, θ_z`.
    Solid,
}

impl Space {
    /// Number of displacement components: 2 or 3.
    pub const fn dim(self) -> usize {
        match self {
            Space::Plane => 2,
            Space::Solid => 3,
        }
    }

    /// Number of rotation components of a particle: 1 or 3.
    pub const fn rotations(self) -> usize {
        match self {
            Space::Plane => 1,
            Space::Solid => 3,
        }
    }

    /// Degrees of freedom of a particle, displacements before rotations: 3 or 6.
    pub const fn dofs_per_particle(self) -> usize {
        self.dim() + self.rotations()
    }

    /// The rotation components as axes: `[2]` (z) in the plane, `[0, 1, 2]` in the solid.
    pub const fn rotation_axes(self) -> &'static [usize] {
        match self {
            Space::Plane => &[2],
            Space::Solid => &[0, 1, 2],
        }
    }
}
