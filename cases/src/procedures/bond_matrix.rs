//! The bond against the Euler–Bernoulli beam element of the textbook, in many orientations.
//!
//! Textbook: Przemieniecki (1968), eq. 5.116 without shear deformation. In its own axes (x along the
//! beam) on `u₁, θ₁, u₂, θ₂`; in any orientation `K = Λᵀ K_local Λ` with `Λ = diag(R, R, R, R)`.

use super::{Setting, rounding};
use crate::error::Result;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use nalgebra::{Matrix3, SMatrix};
use seam_solver::dem::bond::{BondMaterial, stiffness_matrix};
use seam_solver::space::Vec3;
use std::f64::consts::PI;

type Matrix12 = SMatrix<f64, 12, 12>;

/// Largest difference of any entry, relative to the largest entry of its kind (force–displacement,
/// force–rotation, moment–rotation), over all orientations.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let orientations = setting.count("orientations", 1)?;
    let (young_pa, poisson) = (setting.number("young_Pa")?, setting.number("poisson")?);
    let (length, radius) = (setting.number("length_m")?, setting.number("radius_m")?);
    let bond = BondMaterial { young_pa, poisson }.cylinder(radius, length);
    let local = textbook(young_pa, poisson, length, radius);
    let (mut worst, mut asymmetry) = (0.0, 0.0);
    for k in 0..orientations {
        let n = direction(k, orientations);
        let mut own = stiffness_matrix(n * length, bond);
        // Symmetric: rows are columns.
        setting.file.spoil_bond(&mut own.data.0);
        worst = nan_max(worst, difference(&own, &rotated(&local, n)));
        asymmetry = nan_max(asymmetry, difference(&own, &own.transpose()));
    }
    result.work.bond_updates = orientations as u64;
    let source = "Przemieniecki (1968), Theory of Matrix Structural Analysis, eq. 5.116";
    let why = "Both are exact; the rotations round a dozen products of size one.";
    result.quantities = vec![
        rounding("matrix", "Largest difference of an entry", worst, 1e-13, why, source),
        rounding("symmetry", "Largest asymmetry of an entry", asymmetry, 1e-13, why, source),
    ];
    Ok(())
}

/// Directions spread evenly over the sphere (Fibonacci spiral), the poles among them.
fn direction(k: usize, count: usize) -> Vec3 {
    let z: f64 = if count == 1 { 0.0 } else { 1.0 - 2.0 * k as f64 / (count - 1) as f64 };
    let angle = PI * (3.0 - 5f64.sqrt()) * k as f64;
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * angle.cos(), r * angle.sin(), z)
}

fn textbook(e: f64, nu: f64, l: f64, r: f64) -> Matrix12 {
    let (a, i, j) = (PI * r * r, PI * r.powi(4) / 4.0, PI * r.powi(4) / 2.0);
    let g = e / (2.0 * (1.0 + nu));
    let mut k = Matrix12::zeros();
    let mut set = |row: usize, column: usize, value: f64| {
        k[(row, column)] = value;
        k[(column, row)] = value;
    };
    let (axial, torsion) = (e * a / l, g * j / l);
    let (shear, couple) = (12.0 * e * i / l.powi(3), 6.0 * e * i / l.powi(2));
    let (near, far) = (4.0 * e * i / l, 2.0 * e * i / l);
    for (first, second, value) in [(0, 6, axial), (3, 9, torsion), (1, 7, shear), (2, 8, shear)] {
        set(first, first, value);
        set(second, second, value);
        set(first, second, -value);
    }
    // Deflection v with rotation θ_z, and w with −θ_y.
    for (deflection, rotation, sign) in [(1, 5, 1.0), (2, 4, -1.0)] {
        set(deflection, rotation, sign * couple);
        set(deflection, rotation + 6, sign * couple);
        set(deflection + 6, rotation, -sign * couple);
        set(deflection + 6, rotation + 6, -sign * couple);
        set(rotation, rotation, near);
        set(rotation + 6, rotation + 6, near);
        set(rotation, rotation + 6, far);
    }
    k
}

/// `Λᵀ K Λ`; the rows of `R` are the axes of the beam.
fn rotated(local: &Matrix12, n: Vec3) -> Matrix12 {
    let aside = if n.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    let y = n.cross(&aside).normalize();
    let r = Matrix3::from_rows(&[n.transpose(), y.transpose(), n.cross(&y).transpose()]);
    let mut lambda = Matrix12::zeros();
    for block in 0..4 {
        lambda.fixed_view_mut::<3, 3>(3 * block, 3 * block).copy_from(&r);
    }
    lambda.transpose() * local * lambda
}

fn difference(a: &Matrix12, b: &Matrix12) -> f64 {
    let mut worst = 0.0;
    for kind in 0..3 {
        let of_kind =
            |row: usize, column: usize| usize::from(row % 6 >= 3) + usize::from(column % 6 >= 3) == kind;
        let (mut miss, mut size) = (0.0, 0.0f64);
        for row in 0..12 {
            for column in (0..12).filter(|&column| of_kind(row, column)) {
                miss = nan_max(miss, (a[(row, column)] - b[(row, column)]).abs());
                size = size.max(b[(row, column)].abs());
            }
        }
        worst = nan_max(worst, miss / size);
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The textbook element knows what a cantilever does: `w = FL³/3EI`, `θ = FL²/2EI`, torsion `TL/GJ`.
    #[test]
    fn the_textbook_element_is_a_cantilever() {
        let (e, nu, l, r) = (2.0, 0.25, 1.5, 0.1);
        let i = PI * f64::powi(r, 4) / 4.0;
        let k = textbook(e, nu, l, r).fixed_view::<6, 6>(6, 6).into_owned();
        let solve = |dof: usize| k.try_inverse().unwrap().column(dof).into_owned();
        let u = solve(1);
        assert!((u[1] * 3.0 * e * i / l.powi(3) - 1.0).abs() < 1e-12);
        assert!((u[5] * 2.0 * e * i / l.powi(2) - 1.0).abs() < 1e-12);
        let g = e / (2.0 * (1.0 + nu));
        assert!((solve(3)[3] * g * 2.0 * i / l - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_flipped_moment_shows() {
        let bond = BondMaterial { young_pa: 1.0, poisson: 0.3 }.cylinder(0.3, 1.0);
        let mut k = stiffness_matrix(Vec3::x(), bond);
        k[(5, 1)] = -k[(5, 1)];
        assert!(difference(&k, &textbook(1.0, 0.3, 1.0, 0.3)) > 0.1);
    }
}
