//! Slender cantilevers: few long elements, and beams of particles.
//!
//! Timoshenko: `w = PL³/3EI + PL/κGA`, κ = 5/6. A lattice of n rows is stiffer, and by how much is known: lines of weighted bonds at
//! trapezoidal stations give `EI (1 + 2/n²)`, the bonds' own bending `EI/n²`.

use super::super::Setting;
use super::super::compared::within;
use super::super::straight::hold;
use super::bodies::{SPACES, alone, cubic, hypothesis};
use crate::error::Result;
use crate::margin::Search;
use crate::result::CaseResult;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::skin::Skin;
use seam_solver::error::Result as Solved;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

const ROW: &str = "slender beam, L/h = 100";
/// What a deflection may be away from the beam's.
const CLOSE: f64 = 0.02;
/// Rows of the beam of particles.
const ROWS: usize = 2;

/// Elements and particles, plane and solid.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let (young_pa, columns) = (setting.number("young_Pa")?, setting.count("columns", 2)?);
    let (slender, width) = (setting.number("slenderness")?, setting.number("width")?);
    for (space, id) in SPACES {
        let work = &mut result.work;
        let mut error = |formulation: Formulation, ratio: f64| -> Solved<f64> {
            let model = elements(space, young_pa, formulation, ratio, columns)?;
            Ok(deflection(&model, work)? / timoshenko(young_pa, ratio, 1.0) - 1.0)
        };
        let close = error(Formulation::Incompatible, slender).map_err(|e| setting.solver(e))?;
        let locked = error(Formulation::Plain, slender).map_err(|e| setting.solver(e))?;
        let source = "Timoshenko beam, PL³/3EI + PL/κGA";
        let why = ["Two per cent is what the hard case asks; ν = 0, so that the clamp adds nothing.", source];
        let label = format!(
            "Deflection of {columns} elements along L/h = {slender}, incompatible modes, {id}: error"
        );
        result.quantities.push(within(
            [&format!("incompatible-{id}"), &label, "1"],
            close,
            [-CLOSE, CLOSE],
            why,
        ));
        let why = [
            "A check of the check: plain elements must be seen to lock in shear, by at least a tenth.",
            source,
        ];
        let label = format!("The same with plain elements, {id}: error");
        result.quantities.push(within([&format!("locking-{id}"), &label, "1"], locked, [-1.0, -0.1], why));
        // Where a solve is refused the case does not pass; it does not pass in silence either.
        let mut silent = 0;
        let search = Search { from: 10.0, to: setting.number("slenderness_to")?, tolerance: width };
        let found = search.largest(|ratio| {
            let error = error(Formulation::Incompatible, ratio);
            silent += usize::from(error.as_ref().is_ok_and(|e| wrong(*e)));
            Ok(error.is_ok_and(|e| !wrong(e)))
        })?;
        let criterion =
            "the deflection is within 2 % of the beam's; a solve that cannot be trusted is refused";
        let what = format!("{columns} elements with incompatible modes, {id}");
        result.margins.push(found.margin(
            [ROW, criterion],
            [&format!("elements-{id}"), &what, "length over height"],
            slender,
        ));
        let most = setting.number("particles_to")?;
        let found = Search { from: 20.0, to: most, tolerance: width }.largest(|ratio| {
            let exact = timoshenko(young_pa, ratio, 1.0 + 3.0 / (ROWS * ROWS) as f64);
            let deflection = particles(space, young_pa, ratio).and_then(|model| deflection(&model, work));
            silent += usize::from(deflection.as_ref().is_ok_and(|w| wrong(w / exact - 1.0)));
            Ok(deflection.is_ok_and(|w| !wrong(w / exact - 1.0)))
        })?;
        let what = format!("lattice of {ROWS} rows, {id}");
        result.margins.push(found.margin(
            [ROW, criterion],
            [&format!("particles-{id}"), &what, "length over height"],
            slender,
        ));
        let label =
            format!("Answers of the searches that are wrong by more than 2 % without a refusal, {id}");
        let why = ["None may.", "every run of the searches"];
        result.quantities.push(within(
            [&format!("silent-{id}"), &label, "1"],
            silent as f64,
            [0.0, 0.0],
            why,
        ));
    }
    Ok(())
}

/// Whether a deflection with this relative error is not the beam's.
fn wrong(error: f64) -> bool {
    error.is_nan() || error.abs() > CLOSE
}

/// Deflection (m) under 1 N of a beam of height and width one, ν = 0, whose EI is `stiffer` times that of its section.
fn timoshenko(young_pa: f64, length: f64, stiffer: f64) -> f64 {
    length.powi(3) / (3.0 * young_pa / 12.0 * stiffer) + length / (5.0 / 6.0 * 0.5 * young_pa)
}

/// One element across, `columns` along.
fn elements(
    space: Space,
    young_pa: f64,
    formulation: Formulation,
    length: f64,
    columns: usize,
) -> Solved<Model> {
    let line = |i: usize| if i == 0 { even(0.0, length, columns) } else { even(0.0, 1.0, 1) };
    let mesh = grid(&(0..space.dim()).map(line).collect::<Solved<Vec<_>>>()?)?;
    let elasticity = Elasticity { young_pa, poisson: 0.0, density: 1.0 };
    let hypothesis = hypothesis(space, 1.0);
    Ok(loaded(
        Part::Continuum(Continuum { name: "beam".to_owned(), mesh, elasticity, hypothesis, formulation }),
        length,
    ))
}

fn particles(space: Space, young_pa: f64, length: f64) -> Solved<Model> {
    let depth = if space == Space::Solid { 1.0 } else { 0.0 };
    let block = Block::new(space, Vec3::zeros(), Vec3::new(length, 1.0, depth))?;
    let network =
        cubic((space, block), ROWS, young_pa, Matter { density: 1.0, thickness_m: 1.0 }, Skin::Weighted)?;
    Ok(loaded(Part::Discrete { name: "beam".to_owned(), network }, length))
}

/// Held at x = 0, with 1 N across spread over the far end by tributary area.
fn loaded(part: Part, length: f64) -> Model {
    let dim = part.space().dim();
    let mut model = alone(part);
    hold(&mut model, 0, |x| x.x < 1e-9 * length);
    let inside = |x: f64| if x > 1e-9 && x < 1.0 - 1e-9 { 1.0 } else { 0.5 };
    let end: Vec<(usize, f64)> = model.parts[0]
        .positions()
        .iter()
        .enumerate()
        .filter(|(_, x)| x.x > length * (1.0 - 1e-9))
        .map(|(p, x)| (p, (1..dim).map(|i| inside(x[i])).product::<f64>()))
        .collect();
    let all: f64 = end.iter().map(|(_, share)| share).sum();
    model.loads = end
        .into_iter()
        .map(|(point, share)| PointValue { part: 0, point, component: 1, value: share / all })
        .collect();
    model
}

/// Work of the load, which is the mean deflection of the loaded end under 1 N.
fn deflection(model: &Model, work: &mut Work) -> Solved<f64> {
    let solution = statics::solve(model)?;
    *work += solution.work;
    Ok(model.loads.iter().map(|l| l.value * solution.displacement(model, 0, l.point).y).sum())
}
