//! Toughness of a lattice: strength calibrated on an edge crack in tension, the peak of a cracked bend predicted.

use super::Setting;
use super::compared::{exact, plot, series, within};
use super::cracked_specimens::{Broken, Specimen};
use crate::error::Result;
use crate::result::{CaseResult, Observation, Role};
use crate::scene::Tier;
use rayon::prelude::*;
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::error::Result as Solved;
use seam_solver::fracture_mechanics::{fit_power_law, srawley};

/// Rows over the depth of the bends, and their names.
const ROWS_QUICK: [(usize, &str); 3] = [(12, "12"), (24, "24"), (48, "48")];
const ROWS_FULL: [(usize, &str); 4] = [(16, "16"), (32, "32"), (64, "64"), (128, "128")];
/// Crack depths that are predicted beside the first, over W.
const DEPTHS: [(f64, &str); 2] = [(0.3, "0.3"), (0.4, "0.4")];

/// Calibration, then prediction.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let specimen = Specimen {
        moduli: Moduli { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? },
        toughness: setting.number("toughness_Pa_sqrt_m")?,
        depth: setting.number("depth_m")?,
        thickness: setting.number("thickness_m")?,
        strip: setting.number("strip_length")?,
        events: setting.count("events", 1)?,
    };
    let alpha = setting.number("crack_depth")?;
    let refuse = |e| setting.solver(e);

    // Calibration on the strip alone: the intensity at which unit strength fails.
    let rows = setting.count_of_tier("strip_rows", 4)?;
    let strip = specimen.tension(rows, setting.number("strip_depth")?, 1.0).map_err(refuse)?;
    let factor = specimen.toughness / strip.intensity(strip.grown).map_err(refuse)?;
    result.quantities.push(shown(
        "factor",
        "Calibrated: c in σ_t = c K_Ic/√R",
        "1",
        factor,
        "calibration data, a strip in tension; nothing is judged by it",
    ));

    // Prediction.
    let levels: &[(usize, &str)] = match setting.tier {
        Tier::Quick => &ROWS_QUICK,
        Tier::Full => &ROWS_FULL,
    };
    let finest = levels[levels.len() - 1].0;
    let mut runs: Vec<(usize, f64)> = levels.iter().map(|l| (l.0, alpha)).collect();
    runs.extend(DEPTHS.iter().map(|d| (finest, d.0)));
    let bends = runs
        .par_iter()
        .map(|&(rows, alpha)| specimen.bend(rows, alpha, factor))
        .collect::<Solved<Vec<_>>>()
        .map_err(refuse)?;
    let mut closure = 0.0f64;
    for broken in std::iter::once(&strip).chain(&bends) {
        result.work += broken.work;
        closure = closure.max(broken.closure);
    }
    let ratios = |grown: bool| {
        let of = |b: &Broken| Ok(b.intensity(if grown { b.grown } else { 0.0 })? / specimen.toughness);
        bends.iter().map(of).collect::<Solved<Vec<f64>>>().map_err(refuse)
    };
    let (at_slit, at_peak) = (ratios(false)?, ratios(true)?);
    peaks(setting, levels, &bends, &at_slit, &at_peak, result)?;
    scaling(setting, &specimen, &bends[..levels.len()], &at_peak, result)?;
    result.quantities.push(super::rounding(
        "ledger",
        "Energy that no entry of the ledger accounts for, over the largest entry",
        closure,
        1e-6,
        "Work of the load = strain + broken bonds + what the bodies let go; solves are refined to 1e-11.",
        "conservation of energy",
    ));
    Ok(())
}

/// Peaks of the bends over those of linear elastic fracture mechanics, with the crack as deep as its slit and as it is at the peak.
fn peaks(
    setting: &Setting,
    levels: &[(usize, &str)],
    bends: &[Broken],
    at_slit: &[f64],
    at_peak: &[f64],
    result: &mut CaseResult,
) -> Result<()> {
    let source = "P = K_Ic B W^1.5/(S f(a/W)), Srawley (1976)";
    let tolerance = setting.number("peak_tolerance")?;
    let why = "The crack grows by about half a row before the peak, which the slit's depth leaves out: first order in R.";
    let finest = levels.len() - 1;
    for (k, (_, name)) in levels.iter().enumerate() {
        let mut observation = exact(
            [
                &format!("peak-{name}"),
                &format!("Peak of the bend over LEFM with the slit's depth, {name} rows"),
                "1",
            ],
            at_slit[k],
            1.0,
            tolerance,
            [why, source],
        );
        if k < finest {
            observation.accepted = None;
        }
        result.quantities.push(observation);
    }
    let error = |k: usize| (at_slit[k] - 1.0).abs();
    result.quantities.push(within(
        ["falling", "Error of the finest lattice over that of the coarsest", "1"],
        error(finest) / error(0),
        [0.0, 0.5],
        ["First order in R: four times as fine, a quarter of the error, and less than half of it in any case.", source],
    ));
    let grown = setting.number("grown_tolerance")?;
    let names = levels
        .iter()
        .map(|l| format!("a/W = 0.5, {} rows", l.1))
        .chain(DEPTHS.iter().map(|d| format!("a/W = {}, {} rows", d.1, levels[finest].1)));
    let ids = levels
        .iter()
        .map(|l| format!("grown-{}", l.1))
        .chain(DEPTHS.iter().map(|d| format!("grown-depth-{}", d.1)));
    for ((id, name), &value) in ids.zip(names).zip(at_peak) {
        result.quantities.push(exact(
            [&id, &format!("Peak of the bend over LEFM with the crack's depth at the peak, {name}"), "1"],
            value,
            1.0,
            grown,
            ["The stress at the tip is no pure singularity: terms of order √(R/a) and R/a, and the smallest crack is six rows deep.", source],
        ));
    }
    let line = |name: &str, values: &[f64]| {
        let points = bends[..levels.len()].iter().zip(values);
        series(
            name,
            Role::Data,
            points.map(|(b, v)| (b.radius / b.slit, (v - 1.0).abs())).collect::<Vec<_>>(),
        )
    };
    result.curves.push(plot(
        [
            "refinement",
            "Error of the predicted peak",
            "particle radius / depth of the slit (1)",
            "|peak / LEFM − 1| (1)",
        ],
        [true, true],
        vec![line("crack as deep as its slit", at_slit), line("crack as deep as at the peak", at_peak)],
    ));
    let fine = &bends[finest];
    let title = format!("Force and displacement of the bend, {} rows", fine.rows);
    result.curves.push(plot(
        ["force", title.as_str(), "displacement of the load (µm)", "P (N)"],
        [false, false],
        vec![series("events", Role::Model, fine.path.iter().map(|c| (1e6 * c[0], c[1])))],
    ));
    Ok(())
}

/// One body with two particle sizes, and bodies in proportion with one.
fn scaling(
    setting: &Setting,
    specimen: &Specimen,
    bends: &[Broken],
    at_peak: &[f64],
    result: &mut CaseResult,
) -> Result<()> {
    let finest = bends.len() - 1;
    result.quantities.push(exact(
        [
            "particle-size",
            "Peak with half the particles' size over that with the whole, same body and crack",
            "1",
        ],
        at_peak[finest] / at_peak[finest - 1],
        1.0,
        setting.number("size_tolerance")?,
        [
            "Strength goes with K_Ic/√R: what is left is the error of the coarser lattice.",
            "strength scaled with 1/√R",
        ],
    ));
    // The same networks at other scales: R is one, W grows with the rows. σ_N = P/(B W) at a/W = ½ and S/W = 4.
    let shape = 4.0 * srawley(0.5).map_err(|e| setting.solver(e))?;
    let nominal = |(b, ratio): (&Broken, &f64)| {
        let w = specimen.depth * b.rows as f64 / bends[finest].rows as f64;
        [w, ratio * specimen.toughness / (shape * w.sqrt())]
    };
    let points: Vec<[f64; 2]> = bends.iter().zip(at_peak).map(nominal).collect();
    let law = fit_power_law(&points).map_err(|e| setting.solver(e))?;
    let tolerance = setting.number("slope_tolerance")?;
    result.quantities.push(Observation {
        reference: Some(-0.5),
        ..within(
            [
                "size-effect",
                "Exponent of the nominal strength over the depth of bends in proportion, one particle size",
                "1",
            ],
            law.exponent,
            [-0.5 - tolerance, -0.5 + tolerance],
            [
                "LEFM has −½; the smallest body has twelve rows or sixteen, and the error of its peak.",
                "dimensional analysis: a crack in proportion to the body, no other length",
            ],
        )
    });
    let theory = |w: f64| specimen.toughness / (shape * w.sqrt());
    let title = format!("Nominal strength of bends in proportion, R = {:.2e} m", bends[finest].radius);
    result.curves.push(plot(
        ["size", title.as_str(), "W (m)", "P/(B W) at a/W = 0.5 (Pa)"],
        [true, true],
        vec![
            series("lattice", Role::Data, points.iter().map(|p| (p[0], p[1]))),
            series("LEFM, W^(−1/2)", Role::Reference, points.iter().map(|p| (p[0], theory(p[0])))),
        ],
    ));
    Ok(())
}

/// A number that is shown and not judged.
fn shown(id: &str, label: &str, unit: &str, value: f64, source: &str) -> Observation {
    Observation {
        id: id.to_owned(),
        label: label.to_owned(),
        unit: unit.to_owned(),
        value,
        source: source.to_owned(),
        ..Observation::default()
    }
}
