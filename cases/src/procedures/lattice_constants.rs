//! Elastic constants of regular lattices: periodic homogenisation against the closed forms.

use super::{Setting, rounding};
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, periodic_network};
use seam_solver::dem::calibration::homogenisation::homogenise;
use seam_solver::dem::calibration::lattice::stiffness;
use seam_solver::dem::calibration::specimen::Specimen;
use seam_solver::dem::lattice::LatticeKind;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;

const LATTICES: [(LatticeKind, &str, &str); 5] = [
    (LatticeKind::Triangular, "triangular", "triangular lattice"),
    (LatticeKind::Square, "square", "square lattice"),
    (LatticeKind::SimpleCubic, "sc", "simple cubic lattice"),
    (LatticeKind::BodyCentredCubic, "bcc", "body-centred cubic lattice"),
    (LatticeKind::FaceCentredCubic, "fcc", "face-centred cubic lattice"),
];

/// Largest difference of an entry of the stiffness, relative to its largest entry, over radius ratios from thin to
/// thick bonds, per lattice.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let spacing = setting.number("spacing_m")?;
    let thickness_m = setting.number("thickness_m")?;
    let material =
        BondMaterial { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? };
    let (thin, thick) = (setting.number("thinnest")?, setting.number("thickest")?);
    let steps = setting.count("ratios", 2)?;
    for (kind, id, name) in LATTICES {
        let mut worst = 0.0;
        for k in 0..steps {
            let ratio = thin + (thick - thin) * k as f64 / (steps - 1) as f64;
            let matter = Matter { density: 1.0, thickness_m };
            let cell =
                Specimen::lattice_cell(kind, spacing, [0.0; 3], matter).map_err(|e| setting.solver(e))?;
            let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin: Skin::Full };
            let found = periodic_network(&cell.arrangement, &cell.pairs, &recipe)
                .and_then(|mut network| {
                    setting.file.spoil_network(&mut network.network);
                    homogenise(&network, &mut result.work)
                })
                .map_err(|e| setting.solver(e))?;
            let bond = material.cylinder(0.5 * ratio * spacing, spacing);
            let exact = stiffness(kind, spacing, thickness_m, bond);
            worst = nan_max(worst, (found.stiffness - exact).amax() / exact.amax());
        }
        result.quantities.push(rounding(
            id,
            &format!("Elastic constants, {name}"),
            worst,
            1e-12,
            "The closed form is exact; a cell of one to four particles is solved to rounding.",
            "Born and Huang (1954), Dynamical Theory of Crystal Lattices, applied to beam bonds",
        ));
    }
    Ok(())
}
