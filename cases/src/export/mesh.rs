//! A mesh, its supports, loads and material.

use super::{DISPLACEMENTS, FORCES, point_values};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::Hypothesis;
use seam_solver::model::Model;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The fully integrated element of CalculiX that Seam's plain one equals, except in plane stress, which CalculiX
/// expands to three dimensions.
const fn element(hypothesis: Hypothesis) -> (&'static str, f64) {
    match hypothesis {
        Hypothesis::PlaneStress { thickness_m } => ("CPS4", thickness_m),
        Hypothesis::PlaneStrain { thickness_m } => ("CPE4", thickness_m),
        Hypothesis::Solid => ("C3D8", 1.0),
    }
}

/// `nodes.csv`, `elements.csv` (corner nodes in the order of the element), supports, loads and `run.toml`.
pub fn files(body: &Continuum, model: &Model) -> BTreeMap<String, String> {
    let mut nodes = String::from("id,x,y,z\n");
    for (k, x) in body.mesh.nodes.iter().enumerate() {
        let _ = writeln!(nodes, "{k},{:?},{:?},{:?}", x.x, x.y, x.z);
    }
    let corners: Vec<String> = (1..=body.mesh.nodes_per_cell()).map(|k| format!("n{k}")).collect();
    let mut elements = format!("id,{}\n", corners.join(","));
    for cell in 0..body.mesh.cell_count() {
        let ids: Vec<String> = body.mesh.cell(cell).iter().map(usize::to_string).collect();
        let _ = writeln!(elements, "{cell},{}", ids.join(","));
    }
    let (element, thickness_m) = element(body.hypothesis);
    let run = format!(
        "motion = \"equilibrium\"\nelement = \"{element}\"\nthickness_m = {thickness_m:?}\nyoung_Pa = {:?}\npoisson = {:?}\n",
        body.elasticity.young_pa, body.elasticity.poisson
    );
    let file = |name: &str, text: String| (name.to_owned(), text);
    BTreeMap::from([
        file("nodes.csv", nodes),
        file("elements.csv", elements),
        file("supports.csv", point_values(model, &model.supports, DISPLACEMENTS, "node")),
        file("loads.csv", point_values(model, &model.loads, FORCES, "node")),
        file("run.toml", run),
    ])
}
