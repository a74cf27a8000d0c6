//! Displacement between particles: moving least squares (Lancaster and Salkauskas 1981).
//!
//! At `x` a quadratic polynomial `p(d)·c`, `d = (x_i − x)/R`, is fitted to the particles within
//! `R` with the weights `w = (1 − |d|²)²`; its constant term is the value. Any quadratic field is
//! reproduced exactly.

use nalgebra::{DMatrix, DVector, SMatrix};
use seam_solver::space::{Space, Vec3};

/// Radius of the neighbourhood in spacings: wide enough for a quadratic at a face, narrow enough
/// to follow a curved line.
const RADIUS: f64 = 2.2;

/// Wider neighbourhoods are tried until the polynomial is determined.
const WIDER: f64 = 1.3;

/// Singular values below this share of the largest do not determine a coefficient.
const DETERMINED: f64 = 1e-8;

/// Mean distance between neighbours, in m, of `count` particles that fill `bounds`.
pub fn spacing(space: Space, bounds: (Vec3, Vec3), count: usize) -> f64 {
    let sides = bounds.1 - bounds.0;
    let content: f64 = sides.iter().take(space.dim()).product();
    (content / count.max(1) as f64).powf(1.0 / space.dim() as f64)
}

/// Terms of a quadratic: `1, d_i, d_i d_j`.
fn terms(space: Space, d: Vec3) -> Vec<f64> {
    match space {
        Space::Plane => vec![1.0, d.x, d.y, d.x * d.x, d.x * d.y, d.y * d.y],
        Space::Solid => {
            let [x, y, z] = [d.x, d.y, d.z];
            vec![1.0, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x]
        }
    }
}

/// Value at `x` of the field with `values` at `positions`; `None` if the particles do not determine it.
pub fn value(space: Space, positions: &[Vec3], values: &[Vec3], spacing: f64, x: Vec3) -> Option<Vec3> {
    let reach = (0..6).map(|k| RADIUS * spacing * WIDER.powi(k));
    reach.filter_map(|radius| fit(space, positions, values, &within(positions, radius, x), radius, x)).next()
}

/// The particles whose values count at `x`, ascending; empty if they do not determine a value.
pub fn neighbourhood(space: Space, positions: &[Vec3], spacing: f64, x: Vec3) -> Vec<usize> {
    let still = vec![Vec3::zeros(); positions.len()];
    let near = (0..6).map(|k| RADIUS * spacing * WIDER.powi(k));
    let near = near.map(|radius| (radius, within(positions, radius, x)));
    let mut enough = near.filter(|(radius, near)| fit(space, positions, &still, near, *radius, x).is_some());
    enough.next().map(|(_, near)| near).unwrap_or_default()
}

fn within(positions: &[Vec3], radius: f64, x: Vec3) -> Vec<usize> {
    (0..positions.len()).filter(|&i| (positions[i] - x).norm() < radius).collect()
}

fn fit(
    space: Space,
    positions: &[Vec3],
    values: &[Vec3],
    near: &[usize],
    radius: f64,
    x: Vec3,
) -> Option<Vec3> {
    let columns = terms(space, Vec3::zeros()).len();
    if near.len() < columns {
        return None;
    }
    // Rows scaled by √w: least squares by singular values instead of squared normal equations.
    let mut a = DMatrix::zeros(near.len(), columns);
    let mut b = SMatrix::<f64, 1, 3>::zeros().resize_vertically(near.len(), 0.0);
    for (row, &i) in near.iter().enumerate() {
        let d = (positions[i] - x) / radius;
        let root = 1.0 - d.norm_squared();
        a.row_mut(row).copy_from(&(DVector::from_vec(terms(space, d)).transpose() * root));
        b.row_mut(row).copy_from(&(values[i].transpose() * root));
    }
    let svd = a.svd(true, true);
    let largest = svd.singular_values.amax();
    if svd.singular_values.amin() < DETERMINED * largest {
        return None;
    }
    let c = svd.solve(&b, 0.0).ok()?;
    Some(Vec3::new(c[(0, 0)], c[(0, 1)], c[(0, 2)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lattice shifted row by row, so that nothing lines up with the station.
    fn particles(space: Space) -> Vec<Vec3> {
        let layers = if space == Space::Plane { 1 } else { 6 };
        let site = |i: usize, j: usize, k: usize| {
            Vec3::new(
                i as f64 + 0.5 * (j % 2) as f64,
                0.9 * j as f64,
                if layers == 1 { 0.0 } else { k as f64 },
            )
        };
        (0..layers).flat_map(|k| (0..6).flat_map(move |j| (0..8).map(move |i| site(i, j, k)))).collect()
    }

    #[test]
    fn quadratics_are_exact_inside_and_at_the_face() {
        for space in [Space::Plane, Space::Solid] {
            let z = if space == Space::Plane { 0.0 } else { 1.0 };
            let field = |x: Vec3| {
                Vec3::new(1.0 + x.x - 2.0 * x.y * x.x, x.y * x.y + z * x.z, z * (x.z * x.x - 3.0 * x.z * x.z))
            };
            let positions = particles(space);
            let values: Vec<Vec3> = positions.iter().map(|&p| field(p)).collect();
            for x in [Vec3::new(3.3, 2.2, 2.1 * z), Vec3::new(0.0, 0.0, 0.0), Vec3::new(7.0, 4.5, 5.0 * z)] {
                let found = value(space, &positions, &values, 1.0, x).unwrap();
                assert!(
                    (found - field(x)).norm() < 1e-10 * field(x).norm().max(1.0),
                    "{space:?} {x} {found}"
                );
            }
        }
    }

    #[test]
    fn particles_on_a_line_determine_nothing() {
        let positions: Vec<Vec3> = (0..20).map(|i| Vec3::new(i as f64, 0.0, 0.0)).collect();
        let values = positions.clone();
        assert_eq!(value(Space::Plane, &positions, &values, 1.0, Vec3::new(5.0, 0.0, 0.0)), None);
    }
}
