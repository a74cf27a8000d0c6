//! Bonds that give a body the constants of its material, remembered for the whole run.

use super::particles::Protocol;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bonding::{BondRecipe, periodic_network};
use seam_solver::dem::calibration::homogenisation::homogenise;
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::calibration::search::{CalibrationRequest, Reading, calibrate};
use seam_solver::dem::calibration::specimen::Specimen;
use seam_solver::dem::calibration::stretched;
use seam_solver::dem::lattice::LatticeKind;
use seam_solver::dem::packing::PackingRecipe;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::error::{Error, Result};
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::stage::{Stage, timed};
use seam_solver::work::Work;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

/// Particles of a periodic packing that is measured: seeds scatter about 1 % at 600.
const SPECIMEN: usize = 600;
/// Seeds of the packings that are measured: not the ones that are judged.
const SEEDS: [u64; 3] = [9001, 9002, 9003];

/// What the bonds have to give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Material of the body.
    pub elasticity: Elasticity,
    /// Stress state.
    pub hypothesis: Hypothesis,
    /// Thickness, in m.
    pub thickness_m: f64,
}

/// The cell of a lattice as it fills its box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Kind of lattice.
    pub kind: LatticeKind,
    /// Neighbour distance of the regular cell of the same volume, in m.
    pub spacing: f64,
    /// How much it is lengthened along each axis to fill the box.
    pub stretch: [f64; 3],
}

/// Bonds, and the work it took to find them.
pub type Found = (BondRecipe, Work);

/// Bonds of a lattice, stretched as in the body: r̃ in closed form, E_μ measured along x on one period. Where r̃ is given or
/// the section is not round, what is missing is searched on the same period.
///
/// # Errors
/// Constants the lattice cannot have.
pub fn lattice(unit: Unit, target: &Target, given: &BondRecipe, both: bool) -> Result<Found> {
    let key = format!("{unit:?} {target:?} {given:?} {both}");
    remembered(key, || {
        let matter = Matter { density: 1.0, thickness_m: target.thickness_m };
        if let (true, Section::Uniform { .. }) = (both, given.section) {
            let wanted = Moduli::of(&target.elasticity, target.hypothesis);
            let Unit { kind, spacing, stretch } = unit;
            let mut work = Work::default();
            let found = stretched::calibrate(
                kind,
                spacing,
                stretch,
                matter,
                wanted,
                given.material.poisson,
                &mut work,
            )?;
            let mut bond = *given;
            bond.section = given.section.with_ratio(found.radius_ratio);
            bond.material.young_pa = found.bond_young_pa;
            return Ok((bond, work));
        }
        let specimens = [Specimen::lattice_cell(unit.kind, unit.spacing, unit.stretch, matter)?];
        find(&specimens, Reading::AlongX, target, given, both)
    })
}

/// Bonds of a random packing, measured on periodic packings of the same protocol and other seeds.
///
/// # Errors
/// Constants the packing cannot have.
pub fn packing(protocol: &Protocol, target: &Target, given: &BondRecipe, both: bool) -> Result<Found> {
    let protocol = Protocol { seed: 0, ..*protocol };
    remembered(format!("{protocol:?} {target:?} {given:?} {both}"), || {
        let matter = Matter { density: 1.0, thickness_m: target.thickness_m };
        let specimens: Vec<Specimen> = SEEDS
            .iter()
            .map(|&seed| {
                let Protocol { space, mean_radius_m, solid_fraction, radius_spread, bonding, .. } = protocol;
                let recipe = PackingRecipe::periodic(
                    space,
                    SPECIMEN,
                    mean_radius_m,
                    solid_fraction,
                    radius_spread,
                    seed,
                )?;
                Specimen::random(&recipe, bonding, matter)
            })
            .collect::<Result<_>>()?;
        let (found, mut work) = find(&specimens, Reading::Isotropic, target, given, both)?;
        work.packing_checks += specimens.iter().map(|s| s.packing_checks).sum::<u64>();
        Ok((found, work))
    })
}

fn find(
    specimens: &[Specimen],
    reading: Reading,
    target: &Target,
    given: &BondRecipe,
    both: bool,
) -> Result<Found> {
    let wanted = Moduli::of(&target.elasticity, target.hypothesis);
    let mut work = Work::default();
    let mut found = *given;
    if both {
        let request = CalibrationRequest {
            target: wanted,
            bond_poisson: given.material.poisson,
            section: given.section,
            // A period has no faces.
            skin: Skin::Full,
            reading,
        };
        let calibrated = calibrate(&request, specimens, &mut work)?;
        found.section = given.section.with_ratio(calibrated.radius_ratio);
        found.material.young_pa = calibrated.bond_young_pa;
        return Ok((found, work));
    }
    found.material.young_pa = 1.0;
    found.skin = Skin::Full;
    let mut per_unit = 0.0;
    for specimen in specimens {
        let network = periodic_network(&specimen.arrangement, &specimen.pairs, &found)?;
        let homogenised = homogenise(&network, &mut work)?;
        per_unit += match reading {
            Reading::Isotropic => homogenised.moduli.young_pa,
            Reading::AlongX => Moduli::along_x(specimen.arrangement.space, &homogenised.stiffness).young_pa,
        };
    }
    found.skin = given.skin;
    found.material.young_pa = wanted.young_pa * specimens.len() as f64 / per_unit;
    Ok((found, work))
}

static FOUND: LazyLock<Mutex<BTreeMap<String, Slot>>> = LazyLock::new(Mutex::default);

/// Forgets all calibrations, so that a timed run pays for its own.
pub fn forget() {
    if let Ok(mut found) = FOUND.lock() {
        found.clear();
    }
}

type Slot = Arc<OnceLock<std::result::Result<Found, Error>>>;

/// Each calibration runs once: the members of a family share it, whichever thread comes first.
fn remembered(key: String, find: impl FnOnce() -> Result<Found>) -> Result<Found> {
    let find = || timed(Stage::Calibration, find);
    let slot = match FOUND.lock() {
        Ok(mut found) => Arc::clone(found.entry(key).or_default()),
        // A panic elsewhere says nothing about the map, but it is not worth relying on.
        Err(_) => return find(),
    };
    slot.get_or_init(find).clone()
}
