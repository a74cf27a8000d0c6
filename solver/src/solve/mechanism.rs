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
    let speeds: Vec<Vec<f64>> = (0..model.parts.len()).map(|p| speeds(model, numbering, &full, p)).collect();
    let fastest = |part: &[f64]| part.iter().fold(0.0f64, |m, v| m.max(*v));
    let top = speeds.iter().map(|s| fastest(s)).fold(0.0, f64::max);
    let mut bodies = Vec::new();
    for (p, part) in model.parts.iter().enumerate() {
        let moving: Vec<usize> = (0..speeds[p].len()).filter(|&i| speeds[p][i] > 1e-3 * top).collect();
        if moving.is_empty() {
            continue;
        }
        if moving.len() < speeds[p].len() {
            let (body, count) = (part.name().to_owned(), moving.len());
            return Err(Error::Disconnected { body, count, first: moving.into_iter().take(5).collect() });
        }
        let u: Vec<Vec3> = moving.iter().map(|&i| displacement(model, numbering, &full, p, i)).collect();
        bodies.push(format!(
            "body '{}' is free to {}",
            part.name(),
            describe(model.space, part.positions(), &u)
        ));
    }
    Err(Error::Mechanism {
        what: bodies.join("; "),
        mend: "add supports or ties that hold this motion".to_owned(),
    })
}

/// Length of the motion of each point of a part, over all its degrees of freedom.
fn speeds(model: &Model, numbering: &Numbering, motion: &[f64], part: usize) -> Vec<f64> {
    let body = &model.parts[part];
    let of = |point: usize| {
        let components = (0..body.dofs_per_point()).map(|c| motion[numbering.unknown(part, point, c)]);
        components.map(|v| v * v).sum::<f64>().sqrt()
    };
    (0..body.positions().len()).map(of).collect()
}

fn displacement(model: &Model, numbering: &Numbering, motion: &[f64], part: usize, point: usize) -> Vec3 {
    let mut u = Vec3::zeros();
    (0..model.space.dim()).for_each(|c| u[c] = motion[numbering.unknown(part, point, c)]);
    u
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
        Space::Solid => {
            (0..3).map(|k| (k, translations[k])).chain((0..3).map(|k| (3 + k, rotations[k]))).collect()
        }
    };
    let words: Vec<&str> = names.iter().filter(|(k, _)| fit[*k].abs() > 0.1 * largest).map(|n| n.1).collect();
    words.join(" and ")
}
