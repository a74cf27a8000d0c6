//! Plain elements against CalculiX's fully integrated ones, node by node on the same bent mesh.

use super::{Setting, rounding};
use crate::error::Result;
use crate::result::{Agreement, CaseResult, ReferenceKind};
use seam_references::Dataset;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::Vec3;

const PLANE_STRAIN: Hypothesis = Hypothesis::PlaneStrain { thickness_m: 1.0 };

/// Cantilever meshes of the references: quantity, reference, what is compared, stress state, divisions.
const MESHES: [(&str, &str, &str, Hypothesis, &[usize]); 2] = [
    ("q4", "calculix-cpe4", "Q4 plain, plane strain, against CPE4", PLANE_STRAIN, &[20, 5]),
    ("h8", "calculix-c3d8", "H8 plain against C3D8", Hypothesis::Solid, &[10, 4, 3]),
];

/// Largest difference of any displacement component, relative to the largest one, per element.
///
/// Beside it the same with incompatible modes: the meshes are coarse enough to tell formulations apart, so that
/// agreement is no accident.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let material = Elasticity {
        young_pa: setting.number("young_Pa")?,
        poisson: setting.number("poisson")?,
        density: 0.0,
    };
    for (id, case, label, hypothesis, divisions) in MESHES {
        let data = setting.dataset(case, "calculix")?;
        let reference = vectors(setting, &data, "u", "m", divisions.len())?;
        let mut difference = |formulation| -> Result<f64> {
            let u = solve(setting, &data, material, hypothesis, divisions, formulation, result)?;
            Ok(largest(u.iter().zip(&reference).map(|(a, b)| a - b)) / largest(reference.iter().copied()))
        };
        let (plain, other) = (difference(Formulation::Plain)?, difference(Formulation::Incompatible)?);
        let source = format!("{} {}", data.provenance.code, data.provenance.version);
        let why =
            "CalculiX prints seven digits, up to 5e-7 of a displacement; the rest is rounding of the solves.";
        let mut same = rounding(id, label, plain, setting.number("tolerance")?, why, &source);
        same.kind = ReferenceKind::Calculix;
        let mut apart = same.clone();
        same.agreement = Some(Agreement {
            code: "CalculiX".to_owned(),
            version: data.provenance.version.clone(),
            date: data.provenance.date.to_string(),
            model: label.replace(", against ", ", ").replace(" against ", ", "),
            compared: "displacement".to_owned(),
            same_model: true,
        });
        apart.id = format!("{id}-incompatible");
        apart.label = format!("{label}, but with incompatible modes: must differ");
        apart.value = other;
        apart.accepted = Some([0.01, 1.0]);
        apart.why = "A check of the check: another formulation must show on this mesh.".to_owned();
        result.quantities.extend([same, apart]);
    }
    Ok(())
}

/// Displacements of the cantilever of a reference: its bent mesh, its forces, held at the left.
fn solve(
    setting: &Setting,
    data: &Dataset,
    elasticity: Elasticity,
    hypothesis: Hypothesis,
    divisions: &[usize],
    formulation: Formulation,
    result: &mut CaseResult,
) -> Result<Vec<Vec3>> {
    let dim = divisions.len();
    let refuse = |e| setting.solver(e);
    let axes = divisions
        .iter()
        .map(|&n| even(0.0, 1.0, n))
        .collect::<std::result::Result<Vec<_>, _>>()
        .map_err(refuse)?;
    let mut mesh = grid(&axes).map_err(refuse)?;
    mesh.nodes = vectors(setting, data, "", "m", dim)?;
    let held = mesh.boundary_nodes("left").unwrap_or_default();
    let value = |point: usize, component: usize, value: f64| PointValue { part: 0, point, component, value };
    let forces = vectors(setting, data, "f", "N", dim)?;
    let body = Continuum { name: "cantilever".to_owned(), mesh, elasticity, hypothesis, formulation };
    let mut model = Model {
        space: hypothesis.space(),
        parts: vec![Part::Continuum(body)],
        ties: Vec::new(),
        supports: held.iter().flat_map(|&k| (0..dim).map(move |i| value(k, i, 0.0))).collect(),
        loads: forces
            .iter()
            .enumerate()
            .flat_map(|(k, f)| (0..dim).map(move |i| value(k, i, f[i])))
            .collect(),
    };
    setting.file.spoil_model(&mut model);
    let solution = statics::solve(&model).map_err(refuse)?;
    result.work += solution.work;
    Ok((0..forces.len()).map(|k| solution.displacement(&model, 0, k)).collect())
}

/// The columns `<prefix>x`, `<prefix>y`, `<prefix>z` as vectors; the third is zero in the plane.
fn vectors(setting: &Setting, data: &Dataset, prefix: &str, unit: &str, dim: usize) -> Result<Vec<Vec3>> {
    let column = |axis: &&str| data.column(&format!("{prefix}{axis}"), unit);
    let columns = ["x", "y", "z"][..dim].iter().map(column).collect::<std::result::Result<Vec<_>, _>>();
    let columns = columns.map_err(|problem| setting.reference(problem))?;
    Ok((0..data.rows()).map(|k| Vec3::from_fn(|i, _| columns.get(i).map_or(0.0, |c| c[k]))).collect())
}

fn largest(vectors: impl Iterator<Item = Vec3>) -> f64 {
    vectors.map(|v| v.amax()).fold(0.0, f64::max)
}
