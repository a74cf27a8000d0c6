//! Bonds that soften: stress falls with the opening w of a crack in the bond until the fracture energy is spent.
//!
//! A saw-tooth law for sequentially linear analysis (Rots & Invernizzi 2004): a bond that reaches the strength of its tooth s loses
//! stiffness, `g_s k → g_{s+1} k`, and is linear up to the next tooth. All its stiffnesses shrink alike.
//!
//! Softening curve: from `f_t` through a kink to zero, area `G_f`. At opening w and stress σ(w) the secant has the share
//! `g = 1/(1 + k w/(σA))` of the stiffness, and unloading leaves dissipated, per area, `D = ∫σ dw − ½σw`.
//! Teeth stand at `g_s = q^s`, up to where all but one share in their number of `G_f` is spent, and fail at the elongation
//!
//! `e_s = √(2A (D_{s+1} − D_s) / (k (g_s − g_{s+1})))`, stress `g_s k e_s/A`,
//!
//! so that each dissipates exactly its share and all together exactly `A G_f`. Since `dD = −½(k/A)e² dg` on the curve, `e_s` lies between
//! the curve's elongations at both ends of the tooth: teeth overshoot the curve, `f_t` included, by less than the factor `1/q`,
//! and fall short of it as much.

use super::Section;
use super::bond_stress::of_bonds;
use super::forces::SectionStress;
use super::strength::{Strength, Weibull, factors, positive};
use crate::dem::network::Network;
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Shape of the softening curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "shape")]
pub enum Shape {
    /// A straight line to `w_c = 2 G_f/f_t`.
    Linear,
    /// Two lines; Petersson (1981): kink at `f_t/3` and `0.8 G_f/f_t`, so `w_c = 3.6 G_f/f_t`.
    Bilinear {
        /// Stress at the kink over `f_t`, between 0 and 1.
        kink_stress: f64,
        /// Opening at the kink over `G_f/f_t`.
        kink_opening: f64,
    },
}

impl Shape {
    /// Petersson's concrete.
    pub const PETERSSON: Shape = Shape::Bilinear { kink_stress: 1.0 / 3.0, kink_opening: 0.8 };

    /// Kink and end of the curve as (opening, stress), in units of `G_f/f_t` and `f_t`.
    fn corners(self) -> Result<[(f64, f64); 2]> {
        match self {
            Shape::Linear => Ok([(1.0, 0.5), (2.0, 0.0)]),
            Shape::Bilinear { kink_stress: s, kink_opening: o } => {
                positive("kink_stress", s)?;
                positive("kink_opening", o)?;
                // Area one: ½(1+s)o + ½s(w_c − o) = 1.
                let end = o + (2.0 - (1.0 + s) * o) / s;
                if s >= 1.0 || end <= o {
                    return Err(Error::Material {
                        what: "failure law".to_owned(),
                        name: if s >= 1.0 { "kink_stress" } else { "kink_opening" },
                        value: if s >= 1.0 { s } else { o },
                        mend: "the kink must lie below f_t and leave energy for the tail: (1 + stress) · opening < 2",
                    });
                }
                Ok([(o, s), (end, 0.0)])
            }
        }
    }
}

/// The law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Softening {
    /// Tensile strength `f_t`.
    pub tensile: Strength,
    /// Fracture energy `G_f`, in J/m².
    #[serde(rename = "fracture_energy_J_m2")]
    pub fracture_energy_j_m2: f64,
    /// Shape of the curve.
    #[serde(flatten)]
    pub shape: Shape,
    /// Number of teeth.
    pub teeth: usize,
}

/// Constants of all bonds.
#[derive(Debug, Clone)]
pub(super) struct Curves {
    /// Tensile strength, in Pa.
    strength: Vec<f64>,
    /// `κ = k G_f/(A f_t²)`: stiffness of the bond against that of its crack.
    stiffness: Vec<f64>,
    /// Kink and end of the curve as (opening, stress), in units of `G_f/f_t` and `f_t`.
    corners: [(f64, f64); 2],
    teeth: usize,
}

impl Curves {
    pub fn new(
        law: Softening,
        network: &Network,
        sections: &[Section],
        weibull: Option<Weibull>,
    ) -> Result<Self> {
        let energy = positive("fracture_energy_J_m2", law.fracture_energy_j_m2)?;
        if law.teeth == 0 {
            return Err(Error::Material {
                what: "failure law".to_owned(),
                name: "teeth",
                value: 0.0,
                mend: "give at least one, about 10 for a smooth curve",
            });
        }
        let scatter = factors(weibull, network.bonds.len());
        let strength = of_bonds(Some(law.tensile), "tensile strength_Pa", network, &scatter)?;
        let stiffness = |b: usize| {
            let ft = strength[b];
            network.bonds.stiffness[b].kn * energy / (sections[b].area * ft * ft)
        };
        let stiffness = (0..strength.len()).map(stiffness).collect();
        Ok(Curves { stiffness, strength, corners: law.shape.corners()?, teeth: law.teeth })
    }

    /// Share of the stiffness left after `stage` steps.
    pub fn integrity(&self, bond: usize, stage: usize) -> f64 {
        match stage {
            0 => 1.0,
            s if s >= self.teeth => 0.0,
            s => {
                let spent = 1.0 - 1.0 / self.teeth as f64;
                let (w, stress) = self.at_energy(spent);
                let last = 1.0 / (1.0 + self.stiffness[bond] * w / stress);
                last.powf(s as f64 / (self.teeth - 1) as f64)
            }
        }
    }

    /// Stress (Pa) at which the tooth after `stage` steps fails: `f_t g_s √(2κ (D_{s+1} − D_s)/(g_s − g_{s+1}))`, D in units of `G_f`.
    fn peak(&self, bond: usize, stage: usize) -> f64 {
        let [now, next] = [stage, stage + 1].map(|s| self.integrity(bond, s));
        let energy = self.energy(bond, next) - self.energy(bond, now);
        self.strength[bond] * now * (2.0 * self.stiffness[bond] * energy / (now - next)).sqrt()
    }

    pub fn demand(&self, bond: usize, stage: usize, stress: SectionStress) -> f64 {
        if stage >= self.teeth { 0.0 } else { stress.normal.max(0.0) / self.peak(bond, stage) }
    }

    /// Opening and stress where the share `d` of `G_f` is spent. On a line `σ = a − bw`, `D' = ½(σ − wσ') = ½a`:
    /// D is linear in w there, and is `½w` up to the kink.
    fn at_energy(&self, d: f64) -> (f64, f64) {
        let [(kink, stress), (end, _)] = self.corners;
        let at_kink = 0.5 * kink;
        if d <= at_kink {
            (2.0 * d, 1.0 - (1.0 - stress) * 2.0 * d / kink)
        } else {
            let w = kink + (end - kink) * (d - at_kink) / (1.0 - at_kink);
            (w, stress * (end - w) / (end - kink))
        }
    }

    /// Share of `G_f` that is spent where the share `g` of the stiffness is left: there `w = cσ` with `c = (1/g − 1)/κ`.
    fn energy(&self, bond: usize, g: f64) -> f64 {
        if g == 0.0 {
            return 1.0;
        }
        let [(kink, stress), (end, _)] = self.corners;
        let c = (1.0 / g - 1.0) / self.stiffness[bond];
        let before = c / (1.0 + c * (1.0 - stress) / kink);
        if before <= kink {
            return 0.5 * before;
        }
        let slope = stress / (end - kink);
        let w = c * slope * end / (1.0 + c * slope);
        0.5 * kink + (1.0 - 0.5 * kink) * (w - kink) / (end - kink)
    }
}
