//! From bond to body: which `E_μ` and `r̃` give a network the wanted `E` and `ν`.
//!
//! A macro modulus never equals a bond modulus. `ν` depends on `r̃` alone (dimensional analysis), so calibration is one
//! search in `r̃` for `ν`, then one scaling of `E_μ` for `E`. Regular lattices have closed forms ([`lattice`]); others are measured by
//! [`homogenisation`] or [`tension`] and searched ([`search`]). Bending is left to judge the outcome.

pub mod affine;
mod equilibrium;
pub mod homogenisation;
pub mod isotropy;
pub mod lattice;
pub mod search;
pub mod specimen;
pub mod stretched;
pub mod tension;

use isotropy::Moduli;
use serde::{Deserialize, Serialize};

/// Largest `r̃` in use, `2/√3`: there `k_s = k_n` for touching particles, and Poisson's ratio is 0. Thicker bonds would make it negative.
pub const LARGEST_RATIO: f64 = 1.154_700_538_379_251_7;

/// Outcome of a calibration, to be kept under its key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibrated {
    /// How it was measured.
    pub method: String,
    /// Everything it depends on, as text: the same key means the same outcome.
    pub key: String,
    /// Radius ratio `r̃`.
    pub radius_ratio: f64,
    /// Young's modulus of the bonds `E_μ`, in Pa.
    pub bond_young_pa: f64,
    /// Poisson's ratio of the bonds `ν_μ`.
    pub bond_poisson: f64,
    /// Macro moduli with these bonds (mean over the specimens), in the network's own space.
    pub reached: Moduli,
    /// Standard deviation over the specimens, relative for `E`, absolute for `ν`; zero for one specimen.
    pub scatter: [f64; 2],
    /// Distance of the measured stiffness from isotropy, as a fraction; zero where it was not measured.
    pub anisotropy: f64,
    /// How many specimens were measured, counting every step of the search.
    pub evaluations: usize,
}
