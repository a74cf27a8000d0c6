//! Nearly incompressible bending: Cook's membrane in plane strain as ν → ½, and the same one element deep in space.
//!
//! B-bar elements are compared with their own converged answer, extrapolated from three meshes with the order that they show;
//! plain ones lock.

use super::super::Setting;
use super::super::compared::within;
use super::bodies::SPACES;
use crate::error::Result;
use crate::margin::Search;
use crate::result::{CaseResult, Observation, ReferenceKind};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::loads::facet_loads;
use seam_solver::fem::structured::{BOX_SIDES, even, mapped};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

const ROW: &str = "nearly incompressible: Cook's membrane, plane strain, E = 250, F = 100";
/// What the stated mesh may be away from the converged answer.
const CLOSE: f64 = 0.02;
/// Corners of the membrane, counter-clockwise from the lower left, in m.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]];

/// Plane and solid; B-bar judged, plain shown to lock.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let (poisson, cells) = (setting.number("poisson")?, setting.count("cells", 4)?);
    let finest = setting.count_of_tier("finest", 16)?;
    for (space, id) in SPACES {
        // In space three meshes as fine would not be quick.
        let (cells, finest) =
            if space == Space::Plane { (cells, finest) } else { (3 * cells / 4, finest / 2) };
        let (work, counter) = (&mut Work::default(), &mut result.work);
        let mut tip = |poisson: f64, n: usize, formulation: Formulation| {
            deflection(setting, space, poisson, n, formulation, work).map_err(|e| setting.solver(e))
        };
        let converged = |poisson: f64, tip: &mut dyn FnMut(f64, usize, Formulation) -> Result<f64>| {
            let values = [4, 2, 1].map(|k| tip(poisson, finest / k, Formulation::BBar));
            let [coarse, middle, fine] = values;
            Ok::<f64, crate::error::Error>(extrapolated([coarse?, middle?, fine?]))
        };
        let exact = converged(poisson, &mut tip)?;
        let stated = tip(poisson, cells, Formulation::BBar)?;
        let plain = tip(poisson, cells, Formulation::Plain)?;
        result.quantities.push(Observation {
            reference: Some(exact),
            kind: ReferenceKind::OwnFem,
            ..within(
                [
                    &format!("b-bar-{id}"),
                    &format!("Deflection of the tip, B-bar, {cells} per side, ν = {poisson}, {id}"),
                    "m",
                ],
                stated,
                [(1.0 - CLOSE) * exact, (1.0 + CLOSE) * exact],
                [
                    "Two per cent is what the hard case asks of the stated mesh.",
                    "its own converged answer, extrapolated from three meshes",
                ],
            )
        });
        let locked = plain / exact - 1.0;
        let why = [
            "A check of the check: plain elements must be seen to lock, by at least a tenth.",
            "the converged answer of the B-bar elements",
        ];
        let label =
            format!("Plain elements against the converged answer, {cells} per side, ν = {poisson}, {id}");
        result.quantities.push(within([&format!("locking-{id}"), &label, "1"], locked, [-1.0, -0.1], why));
        let found =
            Search { from: 10.0, to: setting.number("bulk_to")?, tolerance: setting.number("width")? }
                .largest(|bulk| {
                    // K/G = 2(1 + ν) / 3(1 − 2ν)
                    let poisson = (3.0 * bulk - 2.0) / (6.0 * bulk + 2.0);
                    let (Ok(exact), Ok(stated)) =
                        (converged(poisson, &mut tip), tip(poisson, cells, Formulation::BBar))
                    else {
                        return Ok(false);
                    };
                    Ok((stated / exact - 1.0).abs() <= CLOSE)
                })?;
        let needed = 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson));
        result.margins.push(found.margin(
            [ROW, "B-bar elements are within 2 % of their own converged answer"],
            [&format!("bulk-{id}"), &format!("B-bar, {cells} per side, {id}"), "bulk over shear modulus"],
            // The number itself, less the rounding of its formula.
            needed * (1.0 - 1e-9),
        ));
        *counter += *work;
    }
    Ok(())
}

/// Richardson's limit with the order that three meshes of ratio two show; the finest where they show none.
fn extrapolated([coarse, middle, fine]: [f64; 3]) -> f64 {
    let ratio = (middle - coarse) / (fine - middle);
    if ratio > 1.0 { fine + (fine - middle) / (ratio - 1.0) } else { fine }
}

/// Deflection of the middle of the loaded side, in m.
fn deflection(
    setting: &Setting,
    space: Space,
    poisson: f64,
    n: usize,
    formulation: Formulation,
    work: &mut Work,
) -> seam_solver::error::Result<f64> {
    let young_pa = setting.number("young_Pa").unwrap_or(f64::NAN);
    let force = setting.number("force_N").unwrap_or(f64::NAN);
    let lines = even(0.0, 1.0, n)?;
    let mut axes = vec![lines.clone(), lines];
    if space == Space::Solid {
        axes.push(even(0.0, 1.0, 1)?);
    }
    let [a, b, c, d] = CORNERS.map(|[x, y]| Vec3::new(x, y, 0.0));
    let mesh = mapped(&axes, BOX_SIDES, |p| {
        let (s, t) = (p.x, p.y);
        a * ((1.0 - s) * (1.0 - t))
            + b * (s * (1.0 - t))
            + c * (s * t)
            + d * ((1.0 - s) * t)
            + Vec3::z() * p.z
    })?;
    let hypothesis = match space {
        Space::Plane => Hypothesis::PlaneStrain { thickness_m: 1.0 },
        Space::Solid => Hypothesis::Solid,
    };
    let elasticity = Elasticity { young_pa, poisson, density: 1.0 };
    let body = Continuum { name: "membrane".to_owned(), mesh, elasticity, hypothesis, formulation };
    let side = CORNERS[2][1] - CORNERS[1][1];
    let loads = facet_loads(&body, &body.mesh.boundaries["right"], |_, _| Vec3::y() * (force / side))?;
    let wall = body.mesh.boundary_nodes("left").unwrap_or_default();
    let dim = space.dim();
    let value =
        |dof: usize, value: f64| PointValue { part: 0, point: dof / dim, component: dof % dim, value };
    let mut supports: Vec<PointValue> =
        wall.iter().flat_map(|&p| (0..2).map(move |k| value(p * dim + k, 0.0))).collect();
    if space == Space::Solid {
        supports.extend((0..body.mesh.nodes.len()).map(|p| value(p * dim + 2, 0.0)));
    }
    let middle = Vec3::new(48.0, 52.0, 0.0);
    let tip = (0..body.mesh.nodes.len()).min_by(|&i, &j| {
        (body.mesh.nodes[i] - middle).norm().total_cmp(&(body.mesh.nodes[j] - middle).norm())
    });
    let loads = loads.into_iter().map(|(dof, force)| value(dof, force)).collect();
    let model = Model { space, parts: vec![Part::Continuum(body)], ties: vec![], supports, loads };
    let solution = statics::solve(&model)?;
    *work += solution.work;
    Ok(solution.displacement(&model, 0, tip.unwrap_or(0)).y)
}
