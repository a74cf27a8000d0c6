//! The search: `r̃` for `ν`, then `E_μ` for `E`.

use super::homogenisation::homogenise;
use super::isotropy::{Moduli, anisotropy};
use super::specimen::Specimen;
use super::tension::tension;
use super::{Calibrated, LARGEST_RATIO};
use crate::dem::bond::BondMaterial;
use crate::dem::bonding::{BondRecipe, bond_network, periodic_network};
use crate::dem::grid::Boundary;
use crate::dem::section::Section;
use crate::dem::skin::Skin;
use crate::error::{Error, Result};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Smallest `r̃` tried: bonds that hardly bend.
const SMALLEST_RATIO: f64 = 0.05;
/// `ν` is met to this: far below the scatter of packings and the error of any model.
const POISSON_TOLERANCE: f64 = 1e-8;
/// The search halves its interval at the worst: 40 halvings reach the tolerance from any start.
const MOST_STEPS: usize = 60;

/// Which moduli of a specimen count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reading {
    /// The isotropic projection: for random packings.
    Isotropic,
    /// What a bar along x shows: for lattices, and beams along x.
    AlongX,
}

/// What is to be found. Periodic specimens are homogenised, closed ones stretched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CalibrationRequest {
    /// Wanted moduli in the network's own space (see [`Moduli::of`]).
    pub target: Moduli,
    /// Poisson's ratio of the bonds, `ν_μ`.
    pub bond_poisson: f64,
    /// Kind of section; its ratio is what is searched.
    pub section: Section,
    /// Weight of bonds in the faces of closed specimens.
    pub skin: Skin,
    /// Which moduli count; tension always reads along x.
    pub reading: Reading,
}

impl CalibrationRequest {
    /// Everything the outcome depends on, as text.
    pub fn key(&self, specimens: &[Specimen]) -> String {
        let names: Vec<&str> = specimens.iter().map(|s| s.name.as_str()).collect();
        let kind = self.section.with_ratio(1.0);
        format!(
            "calibration/1 {:?} nu_b={:?} {kind:?} {:?} {:?} on {}",
            self.target,
            self.bond_poisson,
            self.skin,
            self.reading,
            names.join(" and ")
        )
    }
}

/// Moduli of one specimen at `E_μ = 1`, and its anisotropy.
fn measure(
    request: &CalibrationRequest,
    specimen: &Specimen,
    ratio: f64,
    work: &mut Work,
) -> Result<(Moduli, f64)> {
    let Specimen { arrangement, pairs, .. } = specimen;
    let material = BondMaterial { young_pa: 1.0, poisson: request.bond_poisson };
    let recipe = BondRecipe { material, section: request.section.with_ratio(ratio), skin: request.skin };
    if arrangement.boundary == Boundary::Closed {
        let network = bond_network(arrangement, pairs, &recipe)?;
        return Ok((tension(&network, arrangement.block, arrangement.thickness_m, work)?, 0.0));
    }
    let homogenised = homogenise(&periodic_network(arrangement, pairs, &recipe)?, work)?;
    let moduli = match request.reading {
        Reading::Isotropic => homogenised.moduli,
        Reading::AlongX => Moduli::along_x(arrangement.space, &homogenised.stiffness),
    };
    Ok((moduli, anisotropy(arrangement.space, &homogenised.stiffness)))
}

/// Mean over the specimens at one `r̃`.
struct Trial {
    ratio: f64,
    mean: Moduli,
    scatter: Moduli,
    anisotropy: f64,
}

/// Finds `r̃` and `E_μ` for the mean over some specimens (several seeds of one packing).
///
/// # Errors
/// No specimens; moduli out of reach, with the reachable range; a measurement that fails.
pub fn calibrate(
    request: &CalibrationRequest,
    specimens: &[Specimen],
    work: &mut Work,
) -> Result<Calibrated> {
    request.target.check()?;
    if specimens.is_empty() {
        return Err(Error::Geometry {
            what: "calibration".into(),
            message: "give at least one specimen".into(),
        });
    }
    let mut evaluations = 0;
    let mut at = |ratio: f64| -> Result<Trial> {
        let measured: Vec<(Moduli, f64)> =
            specimens.iter().map(|s| measure(request, s, ratio, work)).collect::<Result<_>>()?;
        evaluations += specimens.len();
        let (mean, scatter) = Moduli::statistics(measured.iter().map(|m| m.0));
        let anisotropy = measured.iter().map(|m| m.1).sum::<f64>() / measured.len() as f64;
        Ok(Trial { ratio, mean, scatter, anisotropy })
    };
    let found = search(request.target.poisson, &mut at)?;
    let several = |deviation: f64| if specimens.len() > 1 { deviation } else { 0.0 };
    Ok(Calibrated {
        method: if specimens[0].arrangement.boundary == Boundary::Closed {
            "tension"
        } else {
            "homogenisation"
        }
        .into(),
        key: request.key(specimens),
        radius_ratio: found.ratio,
        bond_young_pa: request.target.young_pa / found.mean.young_pa,
        bond_poisson: request.bond_poisson,
        reached: Moduli { young_pa: request.target.young_pa, poisson: found.mean.poisson },
        scatter: [several(found.scatter.young_pa / found.mean.young_pa), several(found.scatter.poisson)],
        anisotropy: found.anisotropy,
        evaluations,
    })
}

/// Root of `ν(r̃) − ν*` by the Illinois method (Dowell & Jarratt 1971): regula falsi that halves the weight of
/// an end that stays. `ν` falls with `r̃`.
fn search(target: f64, at: &mut impl FnMut(f64) -> Result<Trial>) -> Result<Trial> {
    let (thin, thick) = (at(SMALLEST_RATIO)?, at(LARGEST_RATIO)?);
    let (mut a, mut b) =
        ((thin.ratio, thin.mean.poisson - target), (thick.ratio, thick.mean.poisson - target));
    for trial in [&thin, &thick] {
        if !trial.mean.poisson.is_finite() {
            return Err(Error::Solve {
                message: "calibration: the specimen has no stiffness; bond it better".into(),
            });
        }
    }
    if a.1.abs() <= POISSON_TOLERANCE {
        return Ok(thin);
    }
    if b.1.abs() <= POISSON_TOLERANCE {
        return Ok(thick);
    }
    if a.1 * b.1 > 0.0 {
        return Err(Error::Geometry {
            what: "calibration".into(),
            message: format!(
                "Poisson's ratio {target} is out of reach: with these particles and bonds it lies between {:.4} (r̃ = {LARGEST_RATIO:.3}) and {:.4} (r̃ = {SMALLEST_RATIO}); change the bonding or the material",
                thick.mean.poisson, thin.mean.poisson
            ),
        });
    }
    for _ in 0..MOST_STEPS {
        let trial = at((a.0 * b.1 - b.0 * a.1) / (b.1 - a.1))?;
        let miss = trial.mean.poisson - target;
        if miss.abs() <= POISSON_TOLERANCE {
            return Ok(trial);
        }
        if miss * b.1 < 0.0 {
            a = b;
        } else {
            a.1 *= 0.5;
        }
        b = (trial.ratio, miss);
    }
    Err(Error::Solve {
        message: format!("calibration: no r̃ found for Poisson's ratio {target} in {MOST_STEPS} steps"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::bonding::Bonding;
    use crate::dem::calibration::lattice;
    use crate::dem::lattice::LatticeKind;
    use crate::dem::packing::PackingRecipe;
    use crate::space::Space;

    fn request(young_pa: f64, poisson: f64) -> CalibrationRequest {
        CalibrationRequest {
            target: Moduli { young_pa, poisson },
            bond_poisson: 0.3,
            section: Section::Uniform { ratio: 1.0 },
            skin: Skin::Weighted,
            reading: Reading::AlongX,
        }
    }

    #[test]
    fn the_search_finds_the_exact_lattice() {
        for kind in [LatticeKind::Triangular, LatticeKind::FaceCentredCubic] {
            let matter = Matter { density: 1.0, thickness_m: 0.2 };
            let cell = Specimen::lattice_cell(kind, 0.01, [0.0; 3], matter).unwrap();
            let found = calibrate(&request(30e9, 0.2), &[cell], &mut Work::default()).unwrap();
            let exact =
                lattice::calibrate(kind, 0.01, 0.2, Moduli { young_pa: 30e9, poisson: 0.2 }, 0.3).unwrap();
            // ν is met to 1e-8; r̃ and E_μ follow with slopes of order one.
            assert!((found.radius_ratio / exact.radius_ratio - 1.0).abs() < 1e-6);
            assert!((found.bond_young_pa / exact.bond_young_pa - 1.0).abs() < 1e-6);
            assert!(found.evaluations < 20, "{}", found.evaluations);
        }
    }

    #[test]
    fn random_discs_show_what_they_were_calibrated_to() {
        let packing = |seed| {
            let recipe = PackingRecipe::periodic(Space::Plane, 150, 0.01, 0.84, 0.2, seed).unwrap();
            let bonding = Bonding::Delaunay { least_share: 0.05 };
            Specimen::random(&recipe, bonding, Matter { density: 1.0, thickness_m: 0.05 }).unwrap()
        };
        let request = CalibrationRequest { reading: Reading::Isotropic, ..request(72.5e9, 0.17) };
        let specimens = [packing(1), packing(2)];
        let found = calibrate(&request, &specimens, &mut Work::default()).unwrap();
        let unit = measure(&request, &specimens[0], found.radius_ratio, &mut Work::default()).unwrap().0;
        let other = measure(&request, &specimens[1], found.radius_ratio, &mut Work::default()).unwrap().0;
        let mean = 0.5 * (unit.young_pa + other.young_pa) * found.bond_young_pa;
        assert!((mean / 72.5e9 - 1.0).abs() < 1e-9);
        assert!((0.5 * (unit.poisson + other.poisson) - 0.17).abs() < 1e-7);
        assert!(found.scatter[0] > 0.0);
        assert_ne!(request.key(&specimens), request.key(&specimens[..1]));
    }

    #[test]
    fn out_of_reach_names_the_range() {
        let cell = Specimen::lattice_cell(LatticeKind::Triangular, 1.0, [0.0; 3], Matter::default()).unwrap();
        let refusal = calibrate(&request(1e9, 0.4), &[cell], &mut Work::default()).unwrap_err().to_string();
        assert!(refusal.contains("0.332"), "{refusal}");
        assert!(calibrate(&request(1e9, 0.2), &[], &mut Work::default()).is_err());
    }
}
