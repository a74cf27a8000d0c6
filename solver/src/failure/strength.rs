//! How strong a site is: a stress, or a toughness that its size turns into one; and how that scatters.
//!
//! In a network the singular stress at a crack tip is cut off at about the particle radius R: the first bond carries
//! `σ ∝ K/√R`. A strength that does not depend on R would let toughness fall with `√R`; so
//! `σ_t = c K_Ic/√R` (the form that Potyondy & Cundall 2004 derive for bonded particles), with c found once on a known crack.

use crate::error::{Error, Result};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// A strength.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "from")]
pub enum Strength {
    /// The same stress for all sizes.
    Stress {
        /// Strength, in Pa.
        #[serde(rename = "strength_Pa")]
        strength_pa: f64,
    },
    /// `c K_Ic/√R` with the radius R of the particle, or the mean of the two of a bond.
    Toughness {
        /// Toughness `K_Ic`, in Pa√m.
        #[serde(rename = "toughness_Pa_sqrt_m")]
        toughness_pa_sqrt_m: f64,
        /// Factor c, from calibration.
        factor: f64,
    },
}

impl Strength {
    /// Strength (Pa) of a site of radius `radius` (m).
    ///
    /// # Errors
    /// A constant or radius that is not positive and finite; `name` says whose.
    pub fn at(&self, name: &'static str, radius: f64) -> Result<f64> {
        match *self {
            Strength::Stress { strength_pa } => positive(name, strength_pa),
            Strength::Toughness { toughness_pa_sqrt_m, factor } => {
                positive("toughness_Pa_sqrt_m", toughness_pa_sqrt_m)?;
                positive("factor", factor)?;
                positive("particle radius", radius)?;
                positive(name, factor * toughness_pa_sqrt_m / radius.sqrt())
            }
        }
    }
}

/// Scatter after Weibull (1951): strengths are multiplied by `(−ln U)^{1/m}`, U uniform. The given strength is the scale of the distribution:
/// 63.2 % of the sites are weaker.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Weibull {
    /// Modulus m: the larger, the less scatter.
    pub modulus: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Weibull {
    /// # Errors
    /// A modulus that is not positive and finite.
    pub fn check(&self) -> Result<()> {
        positive("Weibull modulus", self.modulus).map(|_| ())
    }

    /// Factors of `n` sites, in their order.
    pub fn factors(&self, n: usize) -> Vec<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        (0..n).map(|_| self.factor(&mut rng)).collect()
    }

    fn factor(&self, rng: &mut impl Rng) -> f64 {
        // 1 − U lies in (0, 1]: neither its logarithm nor, below one, the strength is infinite. Zero would be a
        // site without strength.
        let u: f64 = 1.0 - rng.random::<f64>();
        (-u.ln()).max(f64::EPSILON).powf(1.0 / self.modulus)
    }
}

/// Strength factors of `n` sites; all one without scatter.
pub(super) fn factors(weibull: Option<Weibull>, n: usize) -> Vec<f64> {
    weibull.map_or_else(|| vec![1.0; n], |w| w.factors(n))
}

/// A constant that must be positive and finite.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::Material {
        what: "failure law".to_owned(),
        name,
        value,
        mend: "give a positive, finite number",
    })
}
