//! Rotation of a cross-section: `−∂u_x/∂y` of a plane fitted to all its points.

use super::field::{Field, PartField};
use nalgebra::{DMatrix, DVector};
use seam_solver::space::{Space, Vec3};

/// Samples across the height and, in the solid, the width of a section of finite elements.
const SAMPLES: [usize; 2] = [21, 5];
/// Half width of the window of particles, in spacings: three columns of a lattice.
const WINDOW: f64 = 1.2;

/// Rotation in rad of the section at `x` (m) along the beam; `None` where there is no body.
///
/// Fitted is `u_x = c₀ + c₁ d_x + c₂ d_y + c₃ d_x d_y (+ c₄ d_z)`, whose `c₂` does not depend on where the
/// points of the window lie along a beam of constant curvature.
pub fn rotation(field: &Field, x: f64) -> Option<f64> {
    let mut found = Vec::new();
    for part in field.parts.iter().filter(|p| p.spans(0, x)) {
        found.extend(fit(field.space, &points(field.space, part, x), x));
    }
    // Two bodies meet at an interface: the section belongs to both.
    let count = found.len();
    (count > 0).then(|| found.iter().sum::<f64>() / count as f64)
}

/// Position and `u_x` of the points of the window.
fn points(space: Space, part: &PartField, x: f64) -> Vec<(Vec3, f64)> {
    if let Some(spacing) = part.spacing() {
        let positions = part.part.positions();
        let near = |i: &usize| (positions[*i].x - x).abs() <= WINDOW * spacing;
        return (0..positions.len()).filter(near).map(|i| (positions[i], part.displacement[i].x)).collect();
    }
    let (low, high) = part.bounds;
    let at =
        |axis: usize, k: usize, n: usize| low[axis] + (high[axis] - low[axis]) * (k as f64 + 0.5) / n as f64;
    let across = if space == Space::Plane { 1 } else { SAMPLES[1] };
    let mut points = Vec::new();
    for j in 0..SAMPLES[0] {
        for k in 0..across {
            let point =
                Vec3::new(x, at(1, j, SAMPLES[0]), if across == 1 { low.z } else { at(2, k, across) });
            points.extend(part.interpolate(point).map(|u| (point, u.x)));
        }
    }
    points
}

fn fit(space: Space, points: &[(Vec3, f64)], x: f64) -> Option<f64> {
    let middle: Vec3 = points.iter().map(|(p, _)| p).sum::<Vec3>() / points.len().max(1) as f64;
    let height = points.iter().map(|(p, _)| (p.y - middle.y).abs()).fold(0.0, f64::max);
    let width = points.iter().map(|(p, _)| (p.x - x).abs()).fold(0.0, f64::max);
    if height == 0.0 {
        return None;
    }
    let row = |p: &Vec3| {
        let (dx, dy, dz) = ((p.x - x) / height, (p.y - middle.y) / height, (p.z - middle.z) / height);
        let mut row = vec![1.0, dy];
        // All samples of elements lie in the section itself.
        if width > 1e-9 * height {
            row.extend([dx, dx * dy]);
        }
        if space == Space::Solid {
            row.push(dz);
        }
        row
    };
    let rows: Vec<Vec<f64>> = points.iter().map(|(p, _)| row(p)).collect();
    let columns = rows.first()?.len();
    if rows.len() < columns {
        return None;
    }
    let a = DMatrix::from_fn(rows.len(), columns, |i, j| rows[i][j]);
    let b = DVector::from_iterator(points.len(), points.iter().map(|(_, u)| *u));
    let c = a.svd(true, true).solve(&b, 1e-12).ok()?;
    Some(-c[1] / height)
}
