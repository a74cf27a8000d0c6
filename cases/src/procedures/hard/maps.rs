//! Where stability ends over two parameters: step and contrast, subcycling ratio and contrast, bond radius and step.

use super::super::Setting;
use super::super::rounding;
use super::bodies::{SPACES, Sandwich, bonded, close_packed, scale};
use super::two_rates::{Setup, fate};
use super::unrefused::Unrefused;
use crate::error::Result;
use crate::map::{Cell, StabilityMap};
use crate::result::CaseResult;
use rayon::prelude::*;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::multirate::Method;
use seam_solver::dynamics::multirate::side::Stepping;
use seam_solver::error::Result as Solved;
use seam_solver::model::{Model, Numbering};
use seam_solver::work::Work;

/// One run of a map: what became of it, and what it took.
type Run<'a> = dyn Fn(f64, f64) -> Solved<(Cell, Work)> + Sync + 'a;

/// Three maps in the plane, and in space too in the full tier.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let side = setting.count_of_tier("side_of_map", 3)?;
    let steps = setting.count("steps", 100)?;
    let spaces = if setting.tier == crate::scene::Tier::Full { &SPACES[..] } else { &SPACES[..1] };
    for &(space, id) in spaces {
        let sandwich = Sandwich::of(setting, space)?;
        let contrasted = |contrast: f64| -> Solved<Model> {
            let mut model = sandwich.cantilever(1.0)?;
            scale(&mut model, contrast, 1.0);
            Ok(model)
        };
        let contrasts = logarithmic(1e-6, 1e6, side);
        let stepped = |step: f64, contrast: f64| admitted(contrasted(contrast)?, step, steps);
        let words = [
            "step-contrast",
            "Step and contrast: elements and particles, explicit",
            "step over its bound (1)",
            "stiffness, DE over FE (1)",
        ];
        map(setting, (words, id), [&logarithmic(0.25, 4.0, side), &contrasts], &stepped, result)?;
        let rated = |ratio: f64, contrast: f64| -> Solved<(Cell, Work)> {
            let model = contrasted(contrast)?;
            let fine = critical::bound_of(std::iter::once(&model.parts[1]))?.step_s;
            let setup = Setup {
                method: Method::GravouilCombescure,
                coarse: Stepping::Explicit,
                ratio: ratio as usize,
                fine_step: 0.9 * fine,
                steps,
            };
            let mut work = Work::default();
            Ok((fate(&model, setup, &mut work)?, work))
        };
        let ratios: Vec<f64> = [1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0, 70.0, 100.0]
            .into_iter()
            .step_by(if side < 12 { 2 } else { 1 })
            .collect();
        let words = [
            "ratio-contrast",
            "Subcycling ratio and contrast: both sides explicit, Gravouil–Combescure",
            "fine steps per coarse step (1)",
            "stiffness, DE over FE (1)",
        ];
        map(setting, (words, id), [&ratios, &contrasts], &rated, result)?;
        let material = BondMaterial { young_pa: sandwich.young_pa, poisson: setting.number("poisson")? };
        let matter = Matter { density: sandwich.density, thickness_m: sandwich.thickness_m };
        let bonded = |ratio: f64, step: f64| {
            let network = close_packed(space, sandwich.side, 2, material, ratio, matter)?;
            admitted(bonded(network), step, steps)
        };
        let words = [
            "radius-step",
            "Bond radius and step: a free lattice, explicit",
            "bond radius over particle radius (1)",
            "step over its bound (1)",
        ];
        map(
            setting,
            (words, id),
            [&logarithmic(0.01, 1.0, side), &logarithmic(0.25, 4.0, side)],
            &bonded,
            result,
        )?;
    }
    Ok(())
}

fn map(
    setting: &Setting,
    (words, space): ([&str; 4], &str),
    [x, y]: [&[f64]; 2],
    run: &Run,
    result: &mut CaseResult,
) -> Result<()> {
    let [id, title, x_label, y_label] = words;
    let row = |y: &f64| x.iter().map(|x| run(*x, *y)).collect::<Solved<Vec<_>>>();
    let rows = y.par_iter().map(row).collect::<Solved<Vec<_>>>().map_err(|e| setting.solver(e))?;
    rows.iter().flatten().for_each(|(_, work)| result.work += *work);
    let map = StabilityMap {
        id: format!("{id}-{space}"),
        title: format!("{title}, {space}"),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        x: x.to_vec(),
        y: y.to_vec(),
        cells: rows.into_iter().map(|row| row.into_iter().map(|(cell, _)| cell).collect()).collect(),
    };
    let silent = map.count(Cell::Silent) as f64;
    let label = format!("Runs that went wrong without a word: {}", map.title);
    let why = "A run is bounded, refused or stopped; nothing else may come out.";
    result.quantities.push(rounding(
        &format!("silent-{id}-{space}"),
        &label,
        silent,
        0.0,
        why,
        "every run of the map",
    ));
    result.maps.push(map);
    Ok(())
}

/// Whether the solver admits a step, and what such a run would do.
fn admitted(model: Model, share: f64, steps: usize) -> Solved<(Cell, Work)> {
    let step_s = share * critical::bound(&model)?.step_s;
    let rest = State::at_rest(Numbering::new(&model).len());
    let admitted = Explicit::new(&model, Options { step_s, ..Options::default() }, &rest).is_ok();
    let free = Model { supports: Vec::new(), loads: Vec::new(), ..model };
    let mut run = Unrefused::new(&free)?;
    let bounded = run.bounded(step_s, steps)?;
    let cell = match (admitted, bounded) {
        (true, true) => Cell::Bounded,
        (true, false) => Cell::Silent,
        (false, true) => Cell::Cautious,
        (false, false) => Cell::Refused,
    };
    Ok((cell, run.work))
}

/// Values from `low` to `high`, evenly spaced in the logarithm.
fn logarithmic(low: f64, high: f64, count: usize) -> Vec<f64> {
    let at = |k: usize| (low.ln() + (high / low).ln() * k as f64 / (count - 1) as f64).exp();
    (0..count).map(at).collect()
}
