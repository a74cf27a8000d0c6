//! Linear and angular momentum, and the rigid velocity that restores them.

use crate::dem::network::Particles;
use crate::model::{Model, Numbering};
use crate::space::{Space, Vec3, components};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Momentum of a body or model about the origin.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Momentum {
    /// `Σ m v`, in N s.
    #[serde(with = "components")]
    pub linear: Vec3,
    /// `Σ (x × m v + J ω)`, in N m s.
    #[serde(with = "components")]
    pub angular: Vec3,
}

impl std::ops::Sub for Momentum {
    type Output = Momentum;
    fn sub(self, other: Momentum) -> Momentum {
        Momentum { linear: self.linear - other.linear, angular: self.angular - other.angular }
    }
}

impl std::ops::AddAssign for Momentum {
    fn add_assign(&mut self, other: Momentum) {
        self.linear += other.linear;
        self.angular += other.angular;
    }
}

impl Momentum {
    /// Of a whole model, from lumped masses and velocities of all unknowns, at the reference positions.
    pub fn of(model: &Model, mass: &[f64], v: &[f64]) -> Momentum {
        let numbering = Numbering::new(model);
        let (dim, axes) = (model.space.dim(), model.space.rotation_axes());
        let mut sum = Momentum::default();
        for (p, part) in model.parts.iter().enumerate() {
            for (point, x) in part.positions().iter().enumerate() {
                let at = |c: usize| {
                    let i = numbering.unknown(p, point, c);
                    mass[i] * v[i]
                };
                let linear = Vec3::from_fn(|i, _| if i < dim { at(i) } else { 0.0 });
                let mut angular = x.cross(&linear);
                for k in 0..part.dofs_per_point() - dim {
                    angular[axes[k]] += at(dim + k);
                }
                sum += Momentum { linear, angular };
            }
        }
        sum
    }
}

/// The rigid velocity `v = c + ω × (x − x̄)`, `spin = ω`, that gives particles a missing momentum: three parameters in
/// the plane, six in the solid. Returns `(c, ω, x̄)`; `x̄` is their centre of mass.
pub fn rigid_velocity(space: Space, particles: &Particles, missing: Momentum) -> (Vec3, Vec3, Vec3) {
    let total: f64 = particles.mass.iter().sum();
    let weighted = particles.position.iter().zip(&particles.mass).map(|(x, m)| x * *m);
    let centre = weighted.sum::<Vec3>() / total;
    let about_centre = missing.angular - centre.cross(&missing.linear);
    // I = Σ m (r² 1 − r⊗r) + J 1
    let mut inertia = Matrix3::zeros();
    for ((x, m), j) in particles.position.iter().zip(&particles.mass).zip(&particles.inertia) {
        let r = x - centre;
        inertia +=
            (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *m + Matrix3::identity() * *j;
    }
    let omega = match space {
        Space::Plane => Vec3::new(0.0, 0.0, about_centre.z / inertia[(2, 2)]),
        // Positive definite, since every particle has inertia.
        Space::Solid => inertia.try_inverse().map_or(Vec3::zeros(), |i| i * about_centre),
    };
    (missing.linear / total, omega, centre)
}
