//! Manufactured solutions: fitted orders of Q4 and H8 in the L2 and H1 norms.
//!
//! `−∇·σ(u) = b` with `u` smooth and given, displacements prescribed on the whole boundary. Theory:
//! order 2 in L2, order 1 in H1 (Ciarlet 1978, theorem 3.2.5 with k = 1).

use super::Setting;
use crate::error::Result;
use crate::result::{CaseResult, Convergence};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::loads::body_loads;
use seam_solver::fem::manufactured::Manufactured;
use seam_solver::fem::norms::error_norms;
use seam_solver::fem::structured::{even, grid, jiggle};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};

/// Both elements at three levels each, on distorted meshes.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let elasticity = Elasticity {
        young_pa: setting.number("young_Pa")?,
        poisson: setting.number("poisson")?,
        density: 1.0,
    };
    let formulations = [(Formulation::Plain, "plain"), (Formulation::Incompatible, "incompatible")];
    let elements = [
        ("q4", "Q4", Hypothesis::PlaneStress { thickness_m: 1.0 }, setting.count("coarse_plane", 2)?),
        ("h8", "H8", Hypothesis::Solid, setting.count("coarse_solid", 2)?),
    ];
    for (id, name, hypothesis, coarse) in elements {
        for (formulation, kind) in formulations {
            let field = Manufactured {
                elasticity,
                hypothesis,
                amplitude: Vec3::new(1e-3, -7e-4, 4e-4),
                wave_number: setting.number("wave_number_rad_m")?,
            };
            let (mut h, mut l2, mut h1) = (Vec::new(), Vec::new(), Vec::new());
            for cells in [coarse, 2 * coarse, 4 * coarse] {
                let errors = solve(setting, &field, formulation, cells, result)?;
                h.push(1.0 / cells as f64);
                l2.push(errors[0]);
                h1.push(errors[1]);
            }
            for (norm, label, error, formal_order) in [("l2", "L2", l2, 2.0), ("h1", "H1", h1, 1.0)] {
                result.convergence.push(Convergence {
                    id: format!("{id}-{kind}-{norm}"),
                    label: format!("{name}, {kind}: relative {label} error of the displacement"),
                    h: h.clone(),
                    error,
                    formal_order,
                    tolerance: Some(setting.number("tolerance")?),
                });
            }
        }
    }
    Ok(())
}

/// Relative L2 and H1 errors on a unit square or cube.
fn solve(
    setting: &Setting,
    field: &Manufactured,
    formulation: Formulation,
    cells: usize,
    result: &mut CaseResult,
) -> Result<[f64; 2]> {
    let computed = || -> seam_solver::error::Result<([f64; 2], _)> {
        let space = field.hypothesis.space();
        let lines = even(0.0, 1.0, cells)?;
        let mut mesh = grid(&vec![lines; space.dim()])?;
        // A share of the edge: cells keep their shape class under refinement.
        jiggle(&mut mesh, setting.number("distortion").unwrap_or(0.0), 11);
        let body = Continuum {
            name: "block".to_owned(),
            mesh,
            elasticity: field.elasticity,
            hypothesis: field.hypothesis,
            formulation,
        };
        let loads = point_values(space, &body_loads(&body, |x| field.body_force(x))?);
        let supports = boundary(&body, |x| field.displacement(x));
        let model = Model { space, parts: vec![Part::Continuum(body)], ties: vec![], supports, loads };
        let solution = statics::solve(&model)?;
        let Part::Continuum(body) = &model.parts[0] else { return Ok(([f64::NAN; 2], solution.work)) };
        let exact = |x: Vec3| (field.displacement(x), field.gradient(x));
        let (error, size) = error_norms(body, &solution.u, exact)?;
        Ok(([error.l2 / size.l2, error.h1 / size.h1], solution.work))
    };
    let (errors, work) = computed().map_err(|e| setting.solver(e))?;
    result.work += work;
    Ok(errors)
}

fn point_values(space: Space, loads: &[(usize, f64)]) -> Vec<PointValue> {
    let dim = space.dim();
    let of =
        |&(dof, value): &(usize, f64)| PointValue { part: 0, point: dof / dim, component: dof % dim, value };
    loads.iter().map(of).collect()
}

fn boundary(body: &Continuum, displacement: impl Fn(Vec3) -> Vec3) -> Vec<PointValue> {
    let mut nodes: Vec<usize> =
        body.mesh.boundaries.keys().filter_map(|name| body.mesh.boundary_nodes(name)).flatten().collect();
    nodes.sort_unstable();
    nodes.dedup();
    let mut supports = Vec::new();
    for point in nodes {
        let u = displacement(body.mesh.nodes[point]);
        for component in 0..body.mesh.space.dim() {
            supports.push(PointValue { part: 0, point, component, value: u[component] });
        }
    }
    supports
}
