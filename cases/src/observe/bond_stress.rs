//! Largest tension at the rim of a bond (Potyondy and Cundall 2004, eq. 14).

use seam_solver::dem::network::Network;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::Vec3;
use std::f64::consts::PI;

/// `max σ`, `σ = F_n/A + |M| r/I` with the larger bending moment of the two ends, over all bonds of a model, in Pa;
/// zero where there is no bond. `u` holds all unknowns, in m and rad.
pub fn largest(model: &Model, u: &[f64]) -> f64 {
    let numbering = Numbering::new(model);
    let mut largest = 0.0f64;
    for (index, part) in model.parts.iter().enumerate() {
        let Part::Discrete { network, .. } = part else { continue };
        let motion = |particle: usize| {
            let (dim, axes) = (model.space.dim(), model.space.rotation_axes());
            let first = numbering.unknown(index, particle, 0);
            let shift = Vec3::from_fn(|c, _| if c < dim { u[first + c] } else { 0.0 });
            let mut turn = Vec3::zeros();
            axes.iter().enumerate().for_each(|(k, &axis)| turn[axis] = u[first + dim + k]);
            (shift, turn)
        };
        for bond in 0..network.bonds.len() {
            let [i, j] = network.bonds.ends[bond];
            largest = super::curve::nan_max(largest, rim_stress(network, bond, motion(i), motion(j)));
        }
    }
    largest
}

/// With `w = u₂ − u₁ − (L/2)(θ₁+θ₂) × n` and `φ = θ₂ − θ₁`: `F_n = k_n n·w`, and `M = k_b φ_⊥ ± (L/2) n × k_s w_⊥` at the ends.
/// The weight of a bond scales force and section alike.
fn rim_stress(network: &Network, bond: usize, first: (Vec3, Vec3), second: (Vec3, Vec3)) -> f64 {
    let position = &network.particles.position;
    let [i, j] = network.bonds.ends[bond];
    let d = position[j] - position[i];
    let l = d.norm();
    let n = d / l;
    let (k, r) = (network.bonds.stiffness[bond], network.bonds.radius[bond]);
    let w = second.0 - first.0 - (first.1 + second.1).cross(&n) * (0.5 * l);
    let phi = second.1 - first.1;
    let tension = k.kn * n.dot(&w);
    let bending = k.kb * (phi - n * n.dot(&phi));
    let lever = n.cross(&(w - n * n.dot(&w))) * (0.5 * l * k.ks);
    let moment = (bending + lever).norm().max((bending - lever).norm());
    let area = PI * r * r;
    // I/r = A r/4 of a circle.
    tension / area + moment * 4.0 / (area * r)
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_solver::dem::bond::BondMaterial;
    use seam_solver::dem::network::{Bonds, Particles};
    use seam_solver::space::Space;

    /// A bond 2 m long of radius 0.1 m with E = 1 Pa.
    fn model() -> Model {
        let particles = Particles {
            position: vec![Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0)],
            radius: vec![1.0; 2],
            mass: vec![1.0; 2],
            inertia: vec![1.0; 2],
        };
        let stiffness = vec![BondMaterial { young_pa: 1.0, poisson: 0.0 }.cylinder(0.1, 2.0)];
        let bonds = Bonds { ends: vec![[0, 1]], radius: vec![0.1], stiffness, weight: vec![0.5] };
        let network = Network { space: Space::Plane, particles, bonds, faces: Default::default() };
        let parts = vec![Part::Discrete { name: "pair".to_owned(), network }];
        Model { space: Space::Plane, parts, ties: vec![], supports: vec![], loads: vec![] }
    }

    /// Cantilever formulas: `E u/L` in tension; `3EI w/L²` over `I/r` at the root of a bent beam.
    #[test]
    fn a_pair_bears_what_a_beam_bears() {
        let model = model();
        assert!((largest(&model, &[0.0, 0.0, 0.0, 0.02, 0.0, 0.0]) - 0.01).abs() < 1e-15);
        // The free end of a cantilever turns by 3w/2L.
        let bent = largest(&model, &[0.0, 0.0, 0.0, 0.0, 0.04, 1.5 * 0.04 / 2.0]);
        assert!((bent - 3.0 * 0.04 / 4.0 * 0.1).abs() < 1e-15, "{bent}");
        // Rigid turning strains nothing.
        assert!(largest(&model, &[0.0, 0.0, 0.01, 0.0, 0.02, 0.01]).abs() < 1e-15);
    }
}
