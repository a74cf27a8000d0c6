//! Bonds that break by the stress in their section.
//!
//! Normal: `⟨σ⟩/σ_t`; shear: `τ/τ_s`; mixed: the ellipse `√((⟨σ⟩/σ_t)² + (τ/τ_s)²)`. `⟨σ⟩` is σ in tension, zero
//! in compression. σ and τ are the beam stresses of parallel bonds (Potyondy & Cundall 2004).

use super::forces::SectionStress;
use super::strength::{Strength, Weibull, factors};
use crate::dem::network::Network;
use crate::error::Result;
use serde::{Deserialize, Serialize};

/// Which stress counts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "mode")]
pub enum BondStress {
    /// Tension with bending.
    Normal {
        /// Tensile strength.
        tensile: Strength,
    },
    /// Shear with torsion.
    Shear {
        /// Shear strength.
        shear: Strength,
    },
    /// Both, elliptical.
    Mixed {
        /// Tensile strength.
        tensile: Strength,
        /// Shear strength.
        shear: Strength,
    },
}

/// Strengths of all bonds, in Pa; infinite for the stress that does not count.
#[derive(Debug, Clone)]
pub(super) struct Strengths {
    tensile: Vec<f64>,
    shear: Vec<f64>,
}

impl Strengths {
    pub fn new(law: BondStress, network: &Network, weibull: Option<Weibull>) -> Result<Self> {
        let (tensile, shear) = match law {
            BondStress::Normal { tensile } => (Some(tensile), None),
            BondStress::Shear { shear } => (None, Some(shear)),
            BondStress::Mixed { tensile, shear } => (Some(tensile), Some(shear)),
        };
        let scatter = factors(weibull, network.bonds.len());
        Ok(Strengths {
            tensile: of_bonds(tensile, "tensile strength_Pa", network, &scatter)?,
            shear: of_bonds(shear, "shear strength_Pa", network, &scatter)?,
        })
    }

    pub fn demand(&self, bond: usize, stress: SectionStress) -> f64 {
        (stress.normal.max(0.0) / self.tensile[bond]).hypot(stress.shear / self.shear[bond])
    }
}

/// Strength of every bond, scattered.
pub(super) fn of_bonds(
    strength: Option<Strength>,
    name: &'static str,
    network: &Network,
    scatter: &[f64],
) -> Result<Vec<f64>> {
    let radius = &network.particles.radius;
    let of = |(&[i, j], factor): (&[usize; 2], &f64)| match strength {
        Some(strength) => Ok(factor * strength.at(name, 0.5 * (radius[i] + radius[j]))?),
        None => Ok(f64::INFINITY),
    };
    // A constant is refused even where no bond asks for it.
    if let Some(strength) = strength {
        strength.at(name, 1.0)?;
    }
    network.bonds.ends.iter().zip(scatter).map(of).collect()
}
