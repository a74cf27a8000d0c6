//! Forces between two touching particles: a damped normal spring, linear or Hertzian, and a tangential spring that slides.
//!
//! With overlap δ, reduced mass m and `F = kδ + cδ̇`, never in tension, a free collision ends where F = 0, and
//! `e = exp(−tanφ (π − 2φ))`, `c = 2 sinφ √(km)` (Schwager & Pöschel 2007, for damping below critical). Hertz: `F = kδ^{3/2} + cδ^{1/4}δ̇` with
//! `k = 4/3 E√R`, E and R reduced. In `z = 4/5 δ^{5/4}` this is the linear oscillator of stiffness `5k/4`
//! (Antypov & Elliott 2011), so that e is the same function of φ with `c = 2 sinφ √(5km/4)`, at any speed.

use crate::error::{Error, Result};
use crate::space::Vec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Normal law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Normal {
    /// `F = kδ + cδ̇`.
    Linear {
        /// Stiffness k.
        #[serde(rename = "stiffness_N_m")]
        stiffness_n_m: f64,
    },
    /// `F = 4/3 E√R δ^{3/2} + cδ^{1/4}δ̇`, `1/E = 2(1 − ν²)/E_p`.
    Hertz {
        /// Young's modulus of the particles `E_p`.
        #[serde(rename = "young_Pa")]
        young_pa: f64,
        /// Their Poisson's ratio.
        poisson: f64,
    },
}

/// Law of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ContactLaw {
    /// Normal law.
    pub normal: Normal,
    /// Coefficient of restitution e of a free central collision: above `e⁻²` = 0.135 (critical damping), up to 1.
    pub restitution: f64,
    /// Coefficient of friction μ: `|F_t| ≤ μ F_n`.
    pub friction: f64,
    /// Tangential over normal stiffness.
    pub stiffness_ratio: f64,
}

/// Two particles that touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// δ, in m.
    pub overlap: f64,
    /// δ̇, in m/s.
    pub rate: f64,
    /// Reduced mass, in kg.
    pub mass: f64,
    /// Reduced radius, in m.
    pub radius: f64,
}

pub(super) struct NormalForce {
    pub force: f64,
    pub stored: f64,
    pub damping_power: f64,
}

/// Tangential spring: its stretch s (m) and stiffness `k_t` (N/m).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spring {
    pub stretch: Vec3,
    pub stiffness: f64,
}

pub(super) struct TangentialForce {
    /// On the first particle.
    pub force: Vec3,
    pub spring: Spring,
    pub stored: f64,
    /// Energy spent by sliding in this step.
    pub slid: f64,
    /// How far it slid, in m.
    pub way: f64,
}

impl ContactLaw {
    /// # Errors
    /// Constants out of range.
    pub fn check(&self) -> Result<()> {
        let refuse = |name: &'static str, value: f64, mend: &'static str| {
            Err(Error::Material { what: "contact law".to_owned(), name, value, mend })
        };
        let positive = |v: f64| v.is_finite() && v > 0.0;
        match self.normal {
            Normal::Linear { stiffness_n_m: k } if !positive(k) => {
                return refuse("stiffness_N_m", k, "give a positive stiffness");
            }
            Normal::Hertz { young_pa, .. } if !positive(young_pa) => {
                return refuse("young_Pa", young_pa, "give a positive modulus");
            }
            Normal::Hertz { poisson, .. } if !(-1.0..=0.5).contains(&poisson) => {
                return refuse("poisson", poisson, "give a number from -1 to 0.5");
            }
            Normal::Linear { .. } | Normal::Hertz { .. } => {}
        }
        if !(self.restitution > (-2.0f64).exp() && self.restitution <= 1.0) {
            return refuse(
                "restitution",
                self.restitution,
                "give a number above 0.1353 (critical damping), up to 1",
            );
        }
        if !(self.friction.is_finite() && self.friction >= 0.0) {
            return refuse("friction", self.friction, "give zero or a positive number");
        }
        if !(self.stiffness_ratio.is_finite() && self.stiffness_ratio >= 0.0) {
            return refuse(
                "stiffness_ratio",
                self.stiffness_ratio,
                "give zero or a positive number, about 2/7",
            );
        }
        Ok(())
    }

    /// `sinφ`, the damping over the critical one, that gives the restitution: by bisection, since e falls with φ.
    pub fn damping_ratio(&self) -> f64 {
        if self.restitution == 1.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0f64, 0.5 * PI);
        for _ in 0..60 {
            let phi = 0.5 * (low + high);
            let e = (-phi.tan() * (PI - 2.0 * phi)).exp();
            if e > self.restitution { low = phi } else { high = phi }
        }
        low.sin()
    }

    /// Tangent stiffness `dF/dδ` and, for Hertz, the constant k.
    fn stiffness(&self, pair: &Pair) -> (f64, f64) {
        match self.normal {
            Normal::Linear { stiffness_n_m } => (stiffness_n_m, stiffness_n_m),
            Normal::Hertz { young_pa, poisson } => {
                let k = 4.0 / 3.0 * young_pa / (2.0 * (1.0 - poisson * poisson)) * pair.radius.sqrt();
                (1.5 * k * pair.overlap.sqrt(), k)
            }
        }
    }

    /// `damping` is [`ContactLaw::damping_ratio`].
    pub(super) fn normal(&self, pair: &Pair, damping: f64) -> NormalForce {
        let (_, k) = self.stiffness(pair);
        let delta = pair.overlap;
        let (elastic, c, stored) = match self.normal {
            Normal::Linear { .. } => {
                (k * delta, 2.0 * damping * (k * pair.mass).sqrt(), 0.5 * k * delta * delta)
            }
            Normal::Hertz { .. } => {
                let c = 2.0 * damping * (1.25 * k * pair.mass).sqrt() * delta.powf(0.25);
                (k * delta.powf(1.5), c, 0.4 * k * delta.powf(2.5))
            }
        };
        let force = (elastic + c * pair.rate).max(0.0);
        NormalForce { force, stored, damping_power: (force - elastic) * pair.rate }
    }

    /// `F_t = k_t s`, cut at `μF_n`; the spring s then slides along.
    ///
    /// A Hertzian `k_t` changes with the overlap. Where it grows, the force is kept; where it falls, the stretch (Thornton, Cummins &
    /// Cleary 2013): either way some of the stored energy is lost in slip, none is made.
    pub(super) fn tangential(
        &self,
        pair: &Pair,
        normal: f64,
        before: Spring,
        slide: Vec3,
    ) -> TangentialForce {
        let k = self.stiffness_ratio * self.stiffness(pair).0;
        let kept =
            if k > before.stiffness { before.stretch * (before.stiffness / k) } else { before.stretch };
        let micro = 0.5 * before.stiffness * before.stretch.norm_squared() - 0.5 * k * kept.norm_squared();
        let stretch = kept + slide;
        let (trial, most) = (k * stretch.norm(), self.friction * normal);
        let held = if trial <= most { stretch } else { stretch * (most / trial) };
        let way = (stretch - held).norm();
        TangentialForce {
            force: k * held,
            spring: Spring { stretch: held, stiffness: k },
            stored: 0.5 * k * held.norm_squared(),
            slid: most * way + micro,
            way,
        }
    }
}
