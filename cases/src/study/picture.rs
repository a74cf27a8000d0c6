//! The bodies drawn from the model, undeformed and deformed.

use super::evaluate::Solved;
use super::sketch;
use crate::file::SceneFile;
use crate::result::Picture;
use seam_solver::fem::mesh::Mesh;
use seam_solver::model::Part;
use seam_solver::space::{Space, Vec3};

/// The largest displacement is drawn as this share of the largest extent.
const SHOWN: f64 = 0.08;

/// The picture of a solved scene: the plane, or the front face of a solid.
pub fn deformed(file: &SceneFile, solved: &Solved) -> Picture {
    let (model, solution) = (&solved.built.model, &solved.solution);
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let mut largest = 0.0f64;
    for (index, part) in model.parts.iter().enumerate() {
        for (point, x) in part.positions().iter().enumerate() {
            (low, high) = (low.inf(x), high.sup(x));
            largest = largest.max(solution.displacement(model, index, point).norm());
        }
    }
    let scale = if largest > 0.0 { round_down(SHOWN * (high - low).amax() / largest) } else { 1.0 };
    let mut picture =
        Picture { id: "deformed".to_owned(), title: file.scene.title.clone(), scale, ..Picture::default() };
    for (index, part) in model.parts.iter().enumerate() {
        let moved =
            |point: usize| part.positions()[point] + solution.displacement(model, index, point) * scale;
        match part {
            Part::Continuum(body) => {
                for polygon in polygons(&body.mesh) {
                    picture.elements.push(polygon.iter().map(|&i| flat(part.positions()[i])).collect());
                    picture.deformed_elements.push(polygon.iter().map(|&i| flat(moved(i))).collect());
                }
            }
            Part::Discrete { network, .. } => {
                let front = |i: usize| model.space == Space::Plane || part.positions()[i].z > high.z - 1e-9;
                let shown: Vec<usize> = (0..part.positions().len()).filter(|&i| front(i)).collect();
                let first = picture.particles.len();
                picture.particles.extend(shown.iter().map(|&i| flat(part.positions()[i])));
                picture.deformed_particles.extend(shown.iter().map(|&i| flat(moved(i))));
                picture.radii.extend(shown.iter().map(|&i| network.particles.radius[i]));
                let place = |i: usize| shown.binary_search(&i).ok().map(|k| first + k);
                let ends = network.bonds.ends.iter();
                picture.bonds.extend(ends.filter_map(|&[i, j]| Some([place(i)?, place(j)?])));
            }
        }
    }
    add_conditions(solved, &mut picture);
    picture.bodies = sketch::bodies(solved);
    picture.ties = sketch::ties(file, solved);
    picture
}

/// One, two or five times a power of ten, at most `x`.
fn round_down(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    [5.0, 2.0].into_iter().map(|d| d * power).find(|v| *v <= x).unwrap_or(power)
}

pub(super) fn flat(x: Vec3) -> [f64; 2] {
    [x.x, x.y]
}

fn polygons(mesh: &Mesh) -> Vec<Vec<usize>> {
    match mesh.space {
        Space::Plane => (0..mesh.cell_count()).map(|cell| mesh.cell(cell).to_vec()).collect(),
        Space::Solid => {
            let front = mesh.boundaries.get("front").map_or(&[][..], Vec::as_slice);
            front.iter().map(|facet| mesh.facet_nodes(facet).to_vec()).collect()
        }
    }
}

fn add_conditions(solved: &Solved, picture: &mut Picture) {
    let model = &solved.built.model;
    let mut held: Vec<(usize, usize)> = model.supports.iter().map(|s| (s.part, s.point)).collect();
    held.sort_unstable();
    held.dedup();
    picture.supports =
        held.into_iter().map(|(part, point)| flat(model.parts[part].positions()[point])).collect();
    // One arrow per loaded body: the resultant, where it acts.
    for (index, part) in model.parts.iter().enumerate() {
        let loads = model.loads.iter().filter(|l| l.part == index && l.component < model.space.dim());
        let (mut total, mut middle, mut weight) = (Vec3::zeros(), Vec3::zeros(), 0.0);
        for load in loads {
            total[load.component] += load.value;
            middle += part.positions()[load.point] * load.value.abs();
            weight += load.value.abs();
        }
        let length = total.xy().norm();
        if length > 1e-12 * weight && weight > 0.0 {
            picture.loads.push([flat(middle / weight), flat(total / length)]);
        }
    }
}
