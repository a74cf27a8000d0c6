//! What a sketch needs beside the shapes: names, extents and coupled faces, all of the undeformed model.

use super::evaluate::Solved;
use super::picture::flat;
use crate::file::SceneFile;
use crate::result::{BodyOutline, TiedFace};
use crate::scene::connection::TieMethod;
use seam_solver::model::Part;
use seam_solver::space::Vec3;

/// Name, method and extent of each body.
pub(super) fn bodies(solved: &Solved) -> Vec<BodyOutline> {
    let outline = |part: &Part| {
        let [mut low, mut high] = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
        for x in part.positions() {
            (low, high) = (low.inf(x), high.sup(x));
        }
        let method = if matches!(part, Part::Continuum(_)) { "FE" } else { "DE" };
        BodyOutline {
            name: part.name().to_owned(),
            method: method.to_owned(),
            extent: [flat(low), flat(high)],
        }
    };
    solved.built.model.parts.iter().filter(|part| !part.positions().is_empty()).map(outline).collect()
}

/// The coupled faces of the scene, each by the points of its first side.
pub(super) fn ties(file: &SceneFile, solved: &Solved) -> Vec<TiedFace> {
    let parts = &solved.built.model.parts;
    let line = |face: &str| {
        let (body, boundary) = face.split_once('.')?;
        let part = parts.iter().find(|part| part.name() == body)?;
        let points = part.face(boundary)?;
        let mut line: Vec<[f64; 2]> = points.into_iter().map(|i| flat(part.positions()[i])).collect();
        // In order along the direction in which the face is longest.
        let length = |axis: usize| {
            let ends =
                line.iter().map(|p| p[axis]).fold([f64::MAX, f64::MIN], |[lo, hi], v| [v.min(lo), v.max(hi)]);
            ends[1] - ends[0]
        };
        let axis = usize::from(length(1) > length(0));
        line.sort_by(|a, b| a[axis].total_cmp(&b[axis]));
        line.dedup();
        Some(line)
    };
    let ties = file.scene.ties.iter().filter(|(_, tie)| tie.enabled);
    ties.filter_map(|(name, tie)| {
        let method = match tie.method {
            TieMethod::Pointwise => "pointwise",
            TieMethod::Mortar => "mortar",
        };
        let rotations = if tie.rotations { " with rotations" } else { "" };
        let line = tie.faces.iter().find_map(|face| line(face))?;
        Some(TiedFace { name: name.clone(), method: format!("{method}{rotations}"), line })
    })
    .collect()
}
