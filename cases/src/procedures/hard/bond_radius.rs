//! Bonds from slender to stout: the modes of a pair are known, and the step stays safe.
//!
//! Two equal particles (m, J) on one bond: axial `2EA/(Lm)`, shear–rotation `(12EI/L³)(2/m + L²/2J)`, bending `2EI/(LJ)`,
//! torsion `2GJ_p/(LJ)`; rigid motions are zero.

use super::super::Setting;
use super::bodies::{SPACES, bonded, close_packed};
use super::unrefused::Unrefused;
use crate::error::Result;
use crate::margin::Search;
use crate::observe::curve::nan_max;
use crate::procedures::rounding;
use crate::result::CaseResult;
use nalgebra::DMatrix;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::{BondMaterial, stiffness_matrix};
use seam_solver::dynamics::critical;
use seam_solver::space::{Space, Vec3};
use std::f64::consts::PI;

const ROW: &str = "bond radius over particle radius";
/// Relative error of a mode.
const MODES: f64 = 1e-8;

/// Modes and steps over the ratio, both ways from the middle.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let material =
        BondMaterial { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? };
    let (density, thickness_m) = (setting.number("density_kg_m3")?, setting.number("thickness_m")?);
    let (side, rows, steps) =
        (setting.number("side_m")?, setting.count("rows", 1)?, setting.count("steps", 100)?);
    let search = Search { from: 1.0, to: setting.number("factor_to")?, tolerance: setting.number("width")? };
    let ends = [setting.number("slender")?, setting.number("stout")?];
    for (space, id) in SPACES {
        for ratio in ends.into_iter().chain([0.1, 0.617, 0.71]) {
            let why = "Eigenvalues of a small matrix: the softest mode keeps 1e-16 of the stiffest, 1e-4 r̃² apart at r̃ = 0.01.";
            let label = format!("Largest error of a mode of a pair, r̃ = {ratio}, {id}");
            let quantity = format!("modes-{id}-{ratio}");
            let error = modes(space, material, ratio);
            result.quantities.push(rounding(
                &quantity,
                &label,
                error,
                MODES,
                why,
                "closed forms of a beam between two equal spheres",
            ));
        }
        let mut passes = |ratio: f64| -> Result<bool> {
            let refuse = |e| setting.solver(e);
            let matter = Matter { density, thickness_m };
            let network = close_packed(space, side, rows, material, ratio, matter).map_err(refuse)?;
            let model = bonded(network);
            let bound = critical::bound(&model).map_err(refuse)?.step_s;
            let mut run = Unrefused::new(&model).map_err(refuse)?;
            let exact = run.critical_step(500);
            let safe = bound <= exact && exact <= 2.0 * bound && run.bounded(bound, steps).map_err(refuse)?;
            result.work += run.work;
            Ok(safe && modes(space, material, ratio) <= MODES)
        };
        let criterion = "the modes of a pair are met to 1e-8, and a lattice at its bound on the step stays bounded and within a factor of two";
        let slender = search.largest(|factor| passes(1.0 / factor))?;
        let stout = search.largest(&mut passes)?;
        let what = format!("pair and lattice, {id}");
        result.margins.push(slender.margin(
            [ROW, criterion],
            [&format!("slender-{id}"), &what, "particle radius over bond radius"],
            1.0 / ends[0],
        ));
        result.margins.push(stout.margin(
            [ROW, criterion],
            [&format!("stout-{id}"), &what, "bond radius over particle radius"],
            ends[1],
        ));
    }
    Ok(())
}

/// Largest relative error of the squared frequencies of a pair, L = 2R = 1.
fn modes(space: Space, material: BondMaterial, ratio: f64) -> f64 {
    let (l, big, m) = (1.0, 0.5, 1.0);
    let r = ratio * big;
    let j = 0.4 * m * big * big;
    let (e, g) = (material.young_pa, material.young_pa / (2.0 * (1.0 + material.poisson)));
    let (area, second) = (PI * r * r, 0.25 * PI * r.powi(4));
    let axial = 2.0 * e * area / (l * m);
    let shear = 12.0 * e * second / (l * l * l) * (2.0 / m + l * l / (2.0 * j));
    let bending = 2.0 * e * second / (l * j);
    let torsion = 2.0 * g * 2.0 * second / (l * j);
    let (kept, mut exact) = match space {
        Space::Plane => (vec![0, 1, 5, 6, 7, 11], vec![axial, shear, bending]),
        Space::Solid => ((0..12).collect::<Vec<_>>(), vec![axial, shear, shear, bending, bending, torsion]),
    };
    let full = stiffness_matrix(Vec3::x() * l, material.cylinder(r, l));
    let root = |i: usize| if kept[i] % 6 < 3 { m.sqrt() } else { j.sqrt() };
    let n = kept.len();
    let scaled = DMatrix::from_fn(n, n, |a, b| full[(kept[a], kept[b])] / root(a) / root(b));
    let mut found: Vec<f64> = scaled.symmetric_eigenvalues().iter().copied().collect();
    found.sort_by(f64::total_cmp);
    exact.sort_by(f64::total_cmp);
    let flexible = &found[n - exact.len()..];
    flexible.iter().zip(&exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, nan_max)
}
