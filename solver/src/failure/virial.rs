//! Particles that lose bonds by their mean stress.
//!
//! `σ = (1/2Ω) Σ ½(ℓ⊗f + f⊗ℓ)` over the bonds of a particle, ℓ from its centre to the neighbour's, f the force the bond exerts on it, Ω the
//! particle's share of the body. Thresholds on the hydrostatic or on the largest principal stress
//! (André, Jebahi, Iordanoff, Charles & Néauport 2013, for silica glass).

use super::forces::BondForce;
use super::strength::{Strength, Weibull, factors, positive};
use super::{Place, Section};
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::space::Space;
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// Which measure of the stress counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// The largest principal stress; of the two in the plane.
    LargestPrincipal,
    /// The mean of the three normal stresses; of the two in the plane.
    Hydrostatic,
}

/// What a failing particle lets go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Release {
    /// All its bonds, as in the source.
    AllBonds,
    /// The bond in highest tension; of equal ones the first.
    MostTensile,
}

/// The law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct VirialStress {
    /// What is compared with the strength.
    pub measure: Measure,
    /// The threshold.
    pub strength: Strength,
    /// Density of the body (kg/m³): a particle's volume is its mass over it.
    pub density_kg_m3: f64,
    /// What breaks.
    pub release: Release,
}

/// Thresholds (Pa) and volumes (m³) of all particles.
#[derive(Debug, Clone)]
pub(super) struct Thresholds {
    law: VirialStress,
    strength: Vec<f64>,
    volume: Vec<f64>,
}

impl Thresholds {
    pub fn new(law: VirialStress, place: &Place, weibull: Option<Weibull>) -> Result<Self> {
        let particles = &place.network.particles;
        positive("density_kg_m3", law.density_kg_m3)?;
        law.strength.at("strength_Pa", 1.0)?;
        let scatter = factors(weibull, particles.len());
        let mut strength = Vec::with_capacity(particles.len());
        for (radius, factor) in particles.radius.iter().zip(scatter) {
            strength.push(factor * law.strength.at("strength_Pa", *radius)?);
        }
        let volume: Vec<f64> = particles.mass.iter().map(|m| m / law.density_kg_m3).collect();
        if let Some(p) = volume.iter().position(|v| !(v.is_finite() && *v > 0.0)) {
            return Err(Error::Geometry {
                what: format!("body '{}'", place.body),
                message: format!(
                    "particle {p} has mass {} kg, so no volume for its stress; give it mass",
                    particles.mass[p]
                ),
            });
        }
        Ok(Thresholds { law, strength, volume })
    }

    pub fn demands(&self, network: &Network, forces: &[BondForce]) -> Vec<f64> {
        let stresses = stresses(network, forces, &self.volume);
        let measured = stresses.iter().map(|s| measure(self.law.measure, network.space, s).max(0.0));
        measured.zip(&self.strength).map(|(s, strength)| s / strength).collect()
    }

    pub fn released(&self, around: Vec<usize>, forces: &[BondForce], sections: &[Section]) -> Vec<usize> {
        let tension = |b: &usize| {
            let Section { area, weight, .. } = sections[*b];
            if weight > 0.0 { forces[*b].axial() / (area * weight) } else { f64::NEG_INFINITY }
        };
        match self.law.release {
            Release::AllBonds => around,
            Release::MostTensile => {
                // Of equals `max_by` takes the last: reversed, the first.
                let most = around.iter().rev().max_by(|a, b| tension(a).total_cmp(&tension(b)));
                most.copied().into_iter().collect()
            }
        }
    }
}

/// Stress of every particle, in Pa, from the forces in all bonds and the particles' volumes (m³).
pub fn stresses(network: &Network, forces: &[BondForce], volume: &[f64]) -> Vec<Matrix3<f64>> {
    let mut stress = vec![Matrix3::zeros(); volume.len()];
    for (&[i, j], bond) in network.bonds.ends.iter().zip(forces) {
        // Seen from the other particle both ℓ and f change sign: the two shares are equal.
        let lf = bond.length * bond.axis * bond.force.transpose();
        let share = 0.25 * (lf + lf.transpose());
        stress[i] += share;
        stress[j] += share;
    }
    stress.iter_mut().zip(volume).for_each(|(s, v)| *s /= *v);
    stress
}

fn measure(measure: Measure, space: Space, s: &Matrix3<f64>) -> f64 {
    match (measure, space) {
        (Measure::Hydrostatic, _) => s.trace() / space.dim() as f64,
        (Measure::LargestPrincipal, Space::Plane) => {
            let (centre, half) = (0.5 * (s.m11 + s.m22), 0.5 * (s.m11 - s.m22));
            centre + half.hypot(s.m12)
        }
        (Measure::LargestPrincipal, Space::Solid) => s.symmetric_eigenvalues().max(),
    }
}
