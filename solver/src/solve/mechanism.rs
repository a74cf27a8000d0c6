//! Naming what moves without resistance.

use crate::error::{Error, Result};
use crate::model::{Model, Numbering};
use crate::space::{Space, Vec3};
use nalgebra::{DMatrix, DVector};

/// Relative stiffness (unit diagonal) at or below which a motion counts as free. Null vectors come out
/// at a few rounding units; the softest slender beams we solve stay above 1e-11.
pub const FREE: f64 = 1e-13;

/// Refuses a model whose softest motion has no stiffness.
///
/// # Errors
/// [`Error::Disconnected`] where a few particles move alone, [`Error::Mechanism`] otherwise.
pub fn refuse(model: &Model, numbering: &Numbering, free: &[usize], softest: (Vec<f64>, f64)) -> Result<()> {
    let (motion, stiffness) = softest;
    if stiffness > FREE {
        return Ok(());
    }
    let mut full = vec![0.0; numbering.len()];
    free.iter().zip(&motion).for_each(|(&i, &v)| full[i] = v);
    let mut moving = Vec::new();
    for (p, part) in model.parts.iter().enumerate() {
        let dim = model.space.dim();
        let speed = |point: usize| {
            (0..part.dofs_per_point()).map(|c| full[numbering.unknown(p, point, c)].powi(2)).sum::<f64>().sqrt()
        };
        let fastest = (0..part.positions().len()).map(speed).fold(0.0, f64::max);
        let displacement = |point: usize| {
            let mut u = Vec3::zeros();
            (0..dim).for_each(|c| u[c] = full[numbering.unknown(p, point, c)]);
            u
        };
        moving.push((fastest, p, displacement));
    }
    let top = moving.iter().map(|m| m.0).fold(0.0, f64::max);
    let mut bodies = Vec::new();
    for (fastest, p, displacement) in moving.iter().filter(|m| m.0 > 1e-3 * top) {
        let part = &model.parts[*p];
        let points: Vec<usize> = (0..part.positions().len()).filter(|&i| displacement(i).norm() > 1e-3 * fastest).collect();
        if points.len() < part.positions().len() {
            return Err(Error::Disconnected { body: part.name().to_owned(), count: points.len(), first: points.into_iter().take(5).collect() });
        }
        let u: Vec<Vec3> = points.iter().map(|&i| displacement(i)).collect();
        bodies.push(format!("body '{}' is free to {}", part.name(), describe(model.space, part.positions(), &u)));
    }
    Err(Error::Mechanism { what: bodies.join("; "), mend: "add supports or ties that hold this motion".to_owned() })
}

/// A rigid motion in words, from a least-squares fit of `u = t + ω × (x − x̄)`.
fn describe(space: Space, positions: &[Vec3], u: &[Vec3]) -> String {
    let centre = positions.iter().sum::<Vec3>() / positions.len() as f64;
    let size = positions.iter().map(|x| (x - centre).norm()).fold(f64::MIN_POSITIVE, f64::max);
    let mut a = DMatrix::zeros(3 * positions.len(), 6);
    let mut b = DVector::zeros(3 * positions.len());
    for (i, (x, u)) in positions.iter().zip(u).enumerate() {
        let d = (x - centre) / size;
        a.view_mut((3 * i, 0), (3, 3)).copy_from(&nalgebra::Matrix3::identity());
        a.view_mut((3 * i, 3), (3, 3)).copy_from(&-d.cross_matrix());
        b.rows_mut(3 * i, 3).copy_from(u);
    }
    let fit = a.clone().svd(true, true).solve(&b, 1e-12).unwrap_or_else(|_| DVector::zeros(6));
    let whole = b.norm();
    if (a * &fit - &b).norm() > 0.1 * whole {
        return "deform without resistance".to_owned();
    }
    let translations = ["move along x", "move along y", "move along z"];
    let rotations = ["turn about x", "turn about y", "turn about z"];
    let largest = fit.amax();
    let names = match space {
        Space::Plane => vec![(0, translations[0]), (1, translations[1]), (5, rotations[2])],
        Space::Solid => (0..3).map(|k| (k, translations[k])).chain((0..3).map(|k| (3 + k, rotations[k]))).collect(),
    };
    let words: Vec<&str> = names.iter().filter(|(k, _)| fit[*k].abs() > 0.1 * largest).map(|n| n.1).collect();
    words.join(" and ")
}
