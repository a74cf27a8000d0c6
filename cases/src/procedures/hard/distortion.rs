//! Distorted, stretched and inverted elements: the patch test holds as long as an element is one, and no other is let in.

use super::super::compared::within;
use super::super::{Setting, rounding};
use super::bodies::{SPACES, alone, distorted};
use crate::error::Result;
use crate::margin::Search;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use nalgebra::DMatrix;
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::Error;
use seam_solver::fem::assembly::for_each_stiffness;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::grid;
use seam_solver::model::{Model, Numbering, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

const DISTORTED: &str = "distorted and inverted elements";
const HOURGLASS: &str = "hourglass count";
const FORMULATIONS: [(Formulation, &str); 3] = [
    (Formulation::Plain, "plain"),
    (Formulation::Incompatible, "incompatible modes"),
    (Formulation::BBar, "B-bar"),
];
/// What a patch test may leave, relative to the largest displacement.
const PATCH: f64 = 1e-10;
/// A mode stores no energy below this share of the stiffest one: thousand roundings of it.
const ZERO: f64 = 1e-12;

/// All elements with all formulations.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let elasticity = Elasticity {
        young_pa: setting.number("young_Pa")?,
        poisson: setting.number("poisson")?,
        density: setting.number("density_kg_m3")?,
    };
    let (side, rows) = (setting.number("side_m")?, setting.count("rows", 2)?);
    let width = setting.number("width")?;
    for (space, id) in SPACES {
        for (formulation, name) in FORMULATIONS {
            let kind = (hypothesis(space), formulation);
            let code = format!("{}-{id}", name.split(' ').next().unwrap_or(name).to_lowercase());
            let refuse = |e| setting.solver(e);
            let work = &mut result.work;
            let mut passes = |share: f64| -> Result<bool> {
                let body = distorted(space, side, rows, elasticity, kind, share).map_err(refuse)?;
                match patch_error(body, work) {
                    Ok(error) => Ok(error <= PATCH),
                    Err(Error::InvertedElement { .. }) => Ok(false),
                    Err(e) => Err(refuse(e)),
                }
            };
            let found = Search { from: 0.05, to: 4.0, tolerance: width }.largest(&mut passes)?;
            let what = format!("{name}, {id}");
            result.margins.push(found.margin(
                [DISTORTED, "the patch test is met to 1e-10; an inverted element is refused"],
                [
                    &format!("distortion-{code}"),
                    &what,
                    "distance that nodes move at random over the shortest edge",
                ],
                0.25,
            ));
            let count = |aspect: f64| zero_modes(space, elasticity, kind, aspect);
            let exact = if space == Space::Plane { 3.0 } else { 6.0 };
            let modes = count(1.0).map_err(refuse)?;
            let why = [
                "Rigid motions, and nothing else: one more is an hourglass, one fewer resists a rigid motion.",
                "three in the plane, six in space",
            ];
            let label = format!("Motions of one distorted element without energy, {what}");
            result.quantities.push(within(
                [&format!("modes-{code}"), &label, "1"],
                modes as f64,
                [exact, exact],
                why,
            ));
            let search = Search { from: 1.0, to: setting.number("aspect_to")?, tolerance: width };
            let found = search.largest(|aspect| count(aspect).map(|n| n as f64 == exact).map_err(refuse))?;
            result.margins.push(found.margin(
                [HOURGLASS, "exactly three (plane) or six (solid) motions store no energy"],
                [&format!("modes-{code}"), &what, "length of an element over its height"],
                100.0,
            ));
        }
    }
    inverted(setting, elasticity, result)
}

/// Plane strain, where all three formulations exist.
fn hypothesis(space: Space) -> Hypothesis {
    match space {
        Space::Plane => Hypothesis::PlaneStrain { thickness_m: 1.0 },
        Space::Solid => Hypothesis::Solid,
    }
}

/// Largest error at a node, over the largest displacement: a linear field held on the whole surface.
fn patch_error(body: Continuum, work: &mut Work) -> seam_solver::error::Result<f64> {
    let dim = body.mesh.space.dim();
    let field = |x: &Vec3| {
        Vec3::new(
            1e-3 * x.x + 4e-4 * x.y - 2e-4 * x.z,
            3e-4 * x.x - 5e-4 * x.y + 1e-4 * x.z,
            2e-4 * x.y + 6e-4 * x.z,
        )
    };
    let mut surface: Vec<usize> =
        body.mesh.boundaries.keys().filter_map(|n| body.mesh.boundary_nodes(n)).flatten().collect();
    surface.sort_unstable();
    surface.dedup();
    let mut model = alone(Part::Continuum(body));
    for point in surface {
        let value = field(&model.parts[0].positions()[point]);
        model.supports.extend((0..dim).map(|component| PointValue {
            part: 0,
            point,
            component,
            value: value[component],
        }));
    }
    let solution = statics::solve(&model)?;
    *work += solution.work;
    let (mut error, mut size) = (0.0f64, 0.0f64);
    for (point, x) in model.parts[0].positions().iter().enumerate() {
        let (found, exact) = (solution.displacement(&model, 0, point), field(x));
        for c in 0..dim {
            error = nan_max(error, (found[c] - exact[c]).abs());
            size = size.max(exact[c].abs());
        }
    }
    Ok(error / size)
}

/// Motions of one distorted element that store no energy.
fn zero_modes(
    space: Space,
    elasticity: Elasticity,
    kind: (Hypothesis, Formulation),
    aspect: f64,
) -> seam_solver::error::Result<usize> {
    let (hypothesis, formulation) = kind;
    let mut mesh = grid(&vec![vec![0.0, 1.0]; space.dim()])?;
    // Corners moved by up to a fifth of an edge, then all stretched.
    for (n, x) in mesh.nodes.iter_mut().enumerate() {
        let shift = |i: usize| if i < space.dim() { 0.2 * ((3 * n + 5 * i) as f64).sin() } else { 0.0 };
        *x += Vec3::from_fn(|i, _| shift(i));
        x.x *= aspect;
    }
    let body = Continuum { name: "element".to_owned(), mesh, elasticity, hypothesis, formulation };
    let n = body.dof_count();
    let mut k = DMatrix::<f64>::zeros(n, n);
    for_each_stiffness(&body, |dofs, ke| {
        for (r, &i) in dofs.iter().enumerate() {
            for (c, &j) in dofs.iter().enumerate() {
                k[(i, j)] += ke[r * dofs.len() + c];
            }
        }
    })?;
    // Scaled to a unit diagonal, so that a long element's soft and stiff directions weigh alike.
    let root: Vec<f64> = (0..n).map(|i| k[(i, i)].sqrt()).collect();
    let scaled = DMatrix::from_fn(n, n, |r, c| k[(r, c)] / (root[r] * root[c]));
    let modes = scaled.symmetric_eigenvalues();
    let stiffest = modes.iter().fold(0.0f64, |m, w| m.max(w.abs()));
    Ok(modes.iter().filter(|w| w.abs() <= ZERO * stiffest).count())
}

/// Two nodes swapped, and a corner pushed through the opposite edge: refused by name in statics, explicit and implicit runs.
fn inverted(setting: &Setting, elasticity: Elasticity, result: &mut CaseResult) -> Result<()> {
    let mut refused = 0;
    let mut asked = 0;
    for (space, _) in SPACES {
        for (formulation, _) in FORMULATIONS {
            for damage in [swap as fn(&mut Continuum, usize), fold] {
                let kind = (hypothesis(space), formulation);
                let mut body =
                    distorted(space, 1.0, 3, elasticity, kind, 0.0).map_err(|e| setting.solver(e))?;
                let bad = body.mesh.cell_count() / 2;
                damage(&mut body, bad);
                let model = alone(Part::Continuum(body));
                for answer in [standing(&model), stepping(&model), matrices(&model)] {
                    asked += 1;
                    refused += usize::from(
                        matches!(answer, Err(Error::InvertedElement { element, .. }) if touches(&model, element, bad)),
                    );
                }
            }
        }
    }
    let label = "Inverted elements that are refused by number, of statics, explicit and implicit runs";
    let why = [
        "All of them, by the typed error that names the element or one that shares its corner.",
        "the solver's own error",
    ];
    result.quantities.push(within(
        ["inverted", label, "1"],
        refused as f64,
        [asked as f64, asked as f64],
        why,
    ));
    let silent = rounding(
        "inverted-silent",
        "Inverted elements that are let in",
        (asked - refused) as f64,
        0.0,
        "None may.",
        why[1],
    );
    result.quantities.push(silent);
    Ok(())
}

/// The same element, or one that a moved corner turned over first.
fn touches(model: &Model, element: usize, bad: usize) -> bool {
    let Part::Continuum(body) = &model.parts[0] else { return false };
    let corners = body.mesh.cell(bad);
    body.mesh.cell(element).iter().any(|n| corners.contains(n))
}

fn swap(body: &mut Continuum, cell: usize) {
    let first = cell * body.mesh.nodes_per_cell();
    body.mesh.cells.swap(first, first + 1);
}

fn fold(body: &mut Continuum, cell: usize) {
    let nodes = body.mesh.cell(cell).to_vec();
    let centre = nodes.iter().map(|&n| body.mesh.nodes[n]).sum::<Vec3>() / nodes.len() as f64;
    let corner = body.mesh.nodes[nodes[0]];
    body.mesh.nodes[nodes[0]] = centre + (centre - corner) * 1.5;
}

fn standing(model: &Model) -> seam_solver::error::Result<()> {
    statics::solve(model).map(|_| ())
}

fn stepping(model: &Model) -> seam_solver::error::Result<()> {
    let rest = State::at_rest(Numbering::new(model).len());
    Explicit::new(model, Options { step_s: 1e-12, ..Options::default() }, &rest).map(|_| ())
}

fn matrices(model: &Model) -> seam_solver::error::Result<()> {
    Semidiscrete::new(model, &mut Work::default()).map(|_| ())
}
