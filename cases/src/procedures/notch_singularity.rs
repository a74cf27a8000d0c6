//! An elastic notched bend: the exponent of the stress at the tip against Williams, the intensity of a crack against Srawley.

use super::Setting;
use super::bend::{Bend, Bent, Rollers};
use super::compared::{exact, plot, series, within};
use crate::error::Result;
use crate::result::{CaseResult, Observation, Plot, Role};
use rayon::prelude::*;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::refined::Refinement;
use seam_solver::fracture_mechanics::{PowerLaw, brown_srawley, fit_power_law, srawley, williams_exponent};

/// Notch angles, in degrees.
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 90.0, 120.0];
/// Crack depths over the depth of the beam, and their names.
const DEPTHS: [(f64, &str); 5] = [(0.2, "0.2"), (0.3, "0.3"), (0.4, "0.4"), (0.5, "0.5"), (0.6, "0.6")];

/// Below this a/W the formula of 1976 leaves out what the load at a point does to the fibre below it, and the fit of 1966 is the reference.
const SHORT: f64 = 0.25;
const FIT_1976: &str = "The formula is within 0.5 %; the cells add some tenths.";
const FIT_1966: &str = "The fit to collocation at S/W = 4 is within 0.5 %; the cells add some tenths. The formula of 1976 tends to pure bending for short cracks and leaves out that a load at a point takes stress off the fibre below it: it lies 0.8 % above the fit here.";
const SOURCE_1976: &str = "Srawley (1976), Int. J. Fracture 12, S/W = 4";
const SOURCE_1966: &str = "Brown and Srawley (1966), ASTM STP 410, S/W = 4";

/// All angles, then all depths.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let bend = Bend {
        elasticity: Elasticity {
            young_pa: setting.number("young_Pa")?,
            poisson: setting.number("poisson")?,
            density: 0.0,
        },
        depth: setting.number("depth_m")?,
        overhang: setting.number("overhang")?,
        reach: setting.number("reach")?,
    };
    exponents(setting, &bend, result)?;
    intensities(setting, &bend, result)
}

/// Refinement with cells of `finest` and `coarsest` depths, named by `kind`.
fn refinement(setting: &Setting, bend: &Bend, kind: &str) -> Result<Refinement> {
    Ok(Refinement {
        finest: setting.number(&format!("{kind}_finest"))? * bend.depth,
        growth: setting.number(&format!("{kind}_growth_{}", setting.tier.name()))?,
        coarsest: setting.number(&format!("{kind}_coarsest"))? * bend.depth,
    })
}

/// Stress ahead of the tip, and the power law through it.
struct Fitted {
    points: Vec<[f64; 2]>,
    law: PowerLaw,
    bent: Bent,
}

fn exponents(setting: &Setting, bend: &Bend, result: &mut CaseResult) -> Result<()> {
    let by = refinement(setting, bend, "stress")?;
    let window = [setting.number("fit_from")? * bend.depth, setting.number("fit_to")? * bend.depth];
    let alpha = setting.number("notch_depth")?;
    let tolerance = setting.number("exponent_tolerance")?;
    let fit = |degrees: &f64| -> seam_solver::error::Result<Fitted> {
        let bent = bend.solve(alpha, degrees.to_radians(), by, Rollers::Points)?;
        let points = bent.ahead(window)?;
        Ok(Fitted { law: fit_power_law(&points)?, points, bent })
    };
    let fits: Vec<Fitted> = ANGLES
        .par_iter()
        .map(fit)
        .collect::<seam_solver::error::Result<_>>()
        .map_err(|e| setting.solver(e))?;
    let mut lines = Vec::new();
    for (degrees, fitted) in ANGLES.iter().zip(&fits) {
        result.work += fitted.bent.work;
        let theory = williams_exponent(degrees.to_radians()).map_err(|e| setting.solver(e))? - 1.0;
        let PowerLaw { exponent, factor, .. } = fitted.law;
        result.quantities.push(within(
            [&format!("exponent-{degrees}"), &format!("Exponent of the stress ahead, ω = {degrees}°"), "1"],
            exponent,
            [theory - tolerance, theory + tolerance],
            [
                "The next terms of the series and the finest cells bend the line at its ends by some 1e-3.",
                "Williams (1952): λ − 1 with sin 2λγ + λ sin 2γ = 0, γ = π − ω/2",
            ],
        ));
        if let Some(observation) = result.quantities.last_mut() {
            observation.reference = Some(theory);
        }
        let in_depths = |r: f64| r / bend.depth;
        lines.push(series(
            &format!("ω = {degrees}°"),
            Role::Data,
            fitted.points.iter().map(|&[r, s]| (in_depths(r), s)),
        ));
        // The slope of theory through the middle of the fitted line.
        let middle = (window[0] * window[1]).sqrt();
        let at = |r: f64| factor * middle.powf(exponent) * (r / middle).powf(theory);
        lines.push(series(&format!("r^{theory:.4}"), Role::Reference, window.map(|r| (in_depths(r), at(r)))));
    }
    result.curves.push(plot(
        [
            "stress",
            "Opening stress ahead of the notch",
            "distance from the tip / W (1)",
            "σ_xx for P = 1 N, B = 1 m (Pa)",
        ],
        [true, true],
        lines,
    ));
    let cells: Vec<String> = fits.iter().map(|f| f.bent.cells().to_string()).collect();
    result.notes.push(format!(
        "exponents: {} cells, the finest {:.0e} W, growing by {}; {} points fitted from {:.0e} W to {:.0e} W",
        cells.join(", "),
        by.finest / bend.depth,
        by.growth,
        fits.iter().map(|f| f.points.len()).min().unwrap_or(0),
        window[0] / bend.depth,
        window[1] / bend.depth,
    ));
    Ok(())
}

fn intensities(setting: &Setting, bend: &Bend, result: &mut CaseResult) -> Result<()> {
    let by = refinement(setting, bend, "crack")?;
    // Every cell longer by a half.
    let coarse = Refinement {
        finest: 1.5 * by.finest,
        growth: 1.0 + 1.5 * (by.growth - 1.0),
        coarsest: 1.5 * by.coarsest,
    };
    let tolerance = setting.number("intensity_tolerance")?;
    let of = |&(alpha, by, rollers): &(f64, Refinement, Rollers)| {
        let bent = bend.solve(alpha, 0.0, by, rollers)?;
        Ok((bend.intensity(&bent)?, bent.work))
    };
    let patch = setting.number("patch")? * bend.depth;
    let mut runs: Vec<_> = DEPTHS.iter().map(|d| (d.0, by, Rollers::Points)).collect();
    runs.extend(DEPTHS.iter().map(|d| (d.0, coarse, Rollers::Points)));
    runs.push((0.5, by, Rollers::Patches(patch)));
    let found = runs
        .par_iter()
        .map(of)
        .collect::<seam_solver::error::Result<Vec<_>>>()
        .map_err(|e| setting.solver(e))?;
    result.work += found.iter().fold(Default::default(), |mut sum: seam_solver::work::Work, f| {
        sum += f.1;
        sum
    });
    let (mut at_points, mut curve) = (f64::NAN, Vec::new());
    for (k, (alpha, name)) in DEPTHS.iter().enumerate() {
        let (f, coarse) = (found[k].0, found[k + DEPTHS.len()].0);
        // Cells longer by a half change it by more than the cells themselves.
        let with_uncertainties = |observation: Observation, theory: f64| Observation {
            u_num: (f - coarse).abs(),
            u_ref: 0.005 * theory / 3f64.sqrt(),
            ..observation
        };
        let of_1976 = srawley(*alpha).map_err(|e| setting.solver(e))?;
        let (id, label) = (format!("intensity-{name}"), format!("K_I B W^1.5/(P S), a/W = {name}"));
        if *alpha < SHORT {
            let of_1966 = brown_srawley(*alpha).map_err(|e| setting.solver(e))?;
            let judged = exact([&id, &label, "1"], f, of_1966, tolerance, [FIT_1966, SOURCE_1966]);
            result.quantities.push(with_uncertainties(judged, of_1966));
            let (id, label) = (format!("{id}-1976"), format!("{label}, beside the formula of 1976"));
            let beside = exact([&id, &label, "1"], f, of_1976, tolerance, [FIT_1976, SOURCE_1976]);
            let shown = Observation { accepted: None, why: String::new(), ..beside };
            result.quantities.push(with_uncertainties(shown, of_1976));
        } else {
            let judged = exact([&id, &label, "1"], f, of_1976, tolerance, [FIT_1976, SOURCE_1976]);
            result.quantities.push(with_uncertainties(judged, of_1976));
        }
        curve.push((*alpha, f));
        if *alpha == 0.5 {
            at_points = f;
        }
    }
    result.quantities.push(within(
        ["rollers", &format!("K_I with forces spread over {} W, over that with points", patch / bend.depth), "1"],
        found[2 * DEPTHS.len()].0 / at_points,
        [0.995, 1.005],
        [
            "Saint-Venant: a spread over b changes the field at a distance d by a share of order (b/d)², 0.04 half a depth from the load before its small factor.",
            "Saint-Venant's principle",
        ],
    ));
    let fine = |f: fn(f64) -> seam_solver::error::Result<f64>| {
        (10..=70).map(|k| 0.01 * f64::from(k)).filter_map(move |a| Some((a, f(a).ok()?)))
    };
    result.curves.push(Plot {
        band: Some(tolerance),
        ..plot(
            ["intensity", "Stress intensity of a crack", "a / W (1)", "K_I B W^1.5 / (P S) (1)"],
            [false, false],
            vec![
                series("Srawley (1976)", Role::Reference, fine(srawley)),
                series("Brown and Srawley (1966)", Role::Reference, fine(brown_srawley)),
                series("domain integral", Role::Data, curve),
            ],
        )
    });
    Ok(())
}
