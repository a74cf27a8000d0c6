//! The bodies drawn from the model, undeformed and deformed.

use super::evaluate::Solved;
use super::sketch;
use crate::file::SceneFile;
use crate::observe::crack::Shot;
use crate::result::Picture;
use seam_solver::fem::mesh::Mesh;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::{Space, Vec3};

/// The largest displacement is drawn as this share of the largest extent.
const SHOWN: f64 = 0.08;

/// The pictures of a solved scene: where it cracked at several loads, and as it is at the end.
pub fn all(file: &SceneFile, solved: &Solved) -> Vec<Picture> {
    let shots = solved.cracked.as_ref().map_or(&[][..], |cracked| &cracked.shots);
    let of = |(k, shot): (usize, &Shot)| {
        deformed(&format!("crack-{}", k + 1), &shot.title, (&shot.model, &shot.numbering(), &shot.u))
    };
    let mut pictures: Vec<Picture> = shots.iter().enumerate().map(of).collect();
    let state = (&solved.built.model, &solved.solution.numbering, &solved.solution.u[..]);
    let mut last = deformed("deformed", &file.scene.title, state);
    last.bodies = sketch::bodies(solved);
    last.ties = sketch::ties(file, solved);
    pictures.push(last);
    pictures
}

/// The plane, or the front face of a solid.
fn deformed(id: &str, title: &str, (model, numbering, u): (&Model, &Numbering, &[f64])) -> Picture {
    let dim = model.space.dim();
    let displacement = |part: usize, point: usize| {
        Vec3::from_fn(|c, _| if c < dim { u[numbering.unknown(part, point, c)] } else { 0.0 })
    };
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let mut largest = 0.0f64;
    for (index, part) in model.parts.iter().enumerate() {
        for (point, x) in part.positions().iter().enumerate() {
            (low, high) = (low.inf(x), high.sup(x));
            largest = largest.max(displacement(index, point).norm());
        }
    }
    let scale = if largest > 0.0 { round_down(SHOWN * (high - low).amax() / largest) } else { 1.0 };
    let mut picture = Picture { id: id.to_owned(), title: title.to_owned(), scale, ..Picture::default() };
    for (index, part) in model.parts.iter().enumerate() {
        let moved = |point: usize| part.positions()[point] + displacement(index, point) * scale;
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
                for (&[i, j], weight) in network.bonds.ends.iter().zip(&network.bonds.weight) {
                    let bonds = if *weight > 0.0 { &mut picture.bonds } else { &mut picture.broken };
                    bonds.extend(place(i).zip(place(j)).map(|(i, j)| [i, j]));
                }
            }
        }
    }
    add_conditions(model, &mut picture);
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

fn add_conditions(model: &Model, picture: &mut Picture) {
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
