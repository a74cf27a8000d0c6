//! The space a model lives in: the plane (one rotation) or the solid (three).

use serde::{Deserialize, Serialize};

/// A point, displacement, force … of three components; in the plane the third one is zero.
pub type Vec3 = nalgebra::Vector3<f64>;

/// A [`Vec3`] in a file is its three components: `#[serde(with = "components")]`.
pub(crate) mod components {
    use super::Vec3;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(x: &Vec3, serializer: S) -> Result<S::Ok, S::Error> {
        [x.x, x.y, x.z].serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec3, D::Error> {
        <[f64; 3]>::deserialize(deserializer).map(Vec3::from)
    }
}

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
