//! Structured meshes: graded boxes, quadrilateral blocks, elliptic sectors, and their distortion.

use super::mesh::{Facet, Mesh};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Names of the low and high side of each axis of a box or quadrilateral block.
pub const BOX_SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];
/// Names of the sides of an elliptic sector: radial axis, then angular axis.
pub const SECTOR_SIDES: [[&str; 2]; 3] = [["inner", "outer"], ["start", "end"], ["back", "front"]];

/// Grid lines from `low` to `high`: `divisions` intervals, each `ratio` times the one before it.
///
/// # Errors
/// No division, `high ≤ low`, or a ratio that is not positive and finite.
pub fn graded(low: f64, high: f64, divisions: usize, ratio: f64) -> Result<Vec<f64>> {
    if divisions == 0 {
        return Err(bad_grid("an axis has no divisions; give at least one".into()));
    }
    if !(ratio.is_finite() && ratio > 0.0) {
        return Err(bad_grid(format!("grading ratio {ratio}; give a positive ratio, 1 for even spacing")));
    }
    // Sum of the first k intervals, the first one of length one.
    let sum = |k: usize| (0..k).map(|i| ratio.powi(i as i32)).sum::<f64>();
    let total = sum(divisions);
    let mut lines: Vec<f64> = (0..=divisions).map(|k| low + (high - low) * (sum(k) / total)).collect();
    lines[divisions] = high;
    check_lines(&lines)?;
    Ok(lines)
}

/// Evenly spaced grid lines.
///
/// # Errors
/// As [`graded`].
pub fn even(low: f64, high: f64, divisions: usize) -> Result<Vec<f64>> {
    graded(low, high, divisions, 1.0)
}

/// A box with grid lines `axes` (two in the plane, three in the solid), in metres; its sides are
/// named by [`BOX_SIDES`].
///
/// # Errors
/// Fewer than two lines on an axis, or lines that do not ascend.
pub fn grid(axes: &[Vec<f64>]) -> Result<Mesh> {
    mapped(axes, BOX_SIDES, |x| x)
}

/// A quadrilateral with corners in counter-clockwise order from its lower left one, mapped bilinearly
/// from grid lines `s` and `t` on `[0, 1]`; sides named by [`BOX_SIDES`].
///
/// # Errors
/// As [`grid`].
pub fn quadrilateral(corners: [Vec3; 4], s: &[f64], t: &[f64]) -> Result<Mesh> {
    let [a, b, c, d] = corners;
    mapped(&[s.to_vec(), t.to_vec()], BOX_SIDES, |p| {
        let (s, t) = (p.x, p.y);
        a * ((1.0 - s) * (1.0 - t)) + b * (s * (1.0 - t)) + c * (s * t) + d * ((1.0 - s) * t)
    })
}

/// The part of the ring between two concentric ellipses with half axes `inner` and `outer` (m) for
/// eccentric angles `t` (rad), with lines `s` on `[0, 1]` from the inner ellipse to the outer one:
/// `x = a(s) cos t`, `y = b(s) sin t`. Sides named by [`SECTOR_SIDES`]. With `t` in `[0, π/2]` and
/// half axes 2 × 1 and 3.25 × 2.75 it is the membrane of NAFEMS LE1.
///
/// # Errors
/// As [`grid`], half axes that do not grow from inner to outer, or more than a full turn.
pub fn elliptic_sector(inner: [f64; 2], outer: [f64; 2], s: &[f64], t: &[f64]) -> Result<Mesh> {
    if !(0..2).all(|i| inner[i] > 0.0 && outer[i] > inner[i] && outer[i].is_finite()) {
        return Err(bad_grid(format!(
            "half axes {inner:?} inside {outer:?}; the inner ones must be positive and the smaller ones"
        )));
    }
    if t.last().zip(t.first()).is_some_and(|(end, start)| end - start > TAU) {
        return Err(bad_grid("a sector turns by more than 2π; shorten its angles".into()));
    }
    mapped(&[s.to_vec(), t.to_vec()], SECTOR_SIDES, |p| {
        let half = |i: usize| inner[i] + (outer[i] - inner[i]) * p.x;
        Vec3::new(half(0) * p.y.cos(), half(1) * p.y.sin(), 0.0)
    })
}

/// A grid of lines `axes` whose nodes are moved by `map`, which must keep the orientation.
///
/// # Errors
/// As [`grid`].
pub fn mapped(axes: &[Vec<f64>], sides: [[&str; 2]; 3], map: impl Fn(Vec3) -> Vec3) -> Result<Mesh> {
    let space = match axes.len() {
        2 => Space::Plane,
        3 => Space::Solid,
        n => return Err(bad_grid(format!("{n} axes; give two for the plane or three for the solid"))),
    };
    axes.iter().try_for_each(|lines| check_lines(lines))?;
    let flat = vec![0.0];
    let [xs, ys, zs] = [&axes[0], &axes[1], axes.get(2).unwrap_or(&flat)];
    let nodes = zs
        .iter()
        .flat_map(|&z| ys.iter().flat_map(move |&y| xs.iter().map(move |&x| Vec3::new(x, y, z))))
        .map(map)
        .collect();
    let node = |i: usize, j: usize, k: usize| (k * ys.len() + j) * xs.len() + i;
    let layer = |i, j, k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
    let intervals = [xs.len() - 1, ys.len() - 1, zs.len().saturating_sub(1).max(1)];
    let mut cells = Vec::new();
    for (i, j, k) in indices(intervals) {
        cells.extend(layer(i, j, k));
        if space == Space::Solid {
            cells.extend(layer(i, j, k + 1));
        }
    }
    let mut mesh = Mesh { space, nodes, cells, boundaries: BTreeMap::new() };
    for (cell, at) in indices(intervals).enumerate() {
        name_sides(&mut mesh, cell, [at.0, at.1, at.2], intervals, sides);
    }
    Ok(mesh)
}

/// Moves every interior node by at most `share` of the shortest edge that meets it, in a direction
/// drawn with ChaCha8 from `seed`. A quarter keeps cells of a box convex.
pub fn jiggle(mesh: &mut Mesh, share: f64, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut reach = vec![f64::INFINITY; mesh.nodes.len()];
    for cell in 0..mesh.cell_count() {
        for facet in mesh.cell_facets(cell) {
            let nodes = mesh.facet_nodes(&facet);
            for (k, &a) in nodes.iter().enumerate() {
                let b = nodes[(k + 1) % nodes.len()];
                let edge = (mesh.nodes[a] - mesh.nodes[b]).norm();
                reach[a] = reach[a].min(edge);
                reach[b] = reach[b].min(edge);
            }
        }
    }
    for facet in mesh.free_facets() {
        for &node in mesh.facet_nodes(&facet) {
            reach[node] = 0.0;
        }
    }
    let dim = mesh.space.dim();
    for (x, reach) in mesh.nodes.iter_mut().zip(reach) {
        let move_by = Vec3::from_fn(|i, _| if i < dim { rng.random_range(-1.0..1.0) } else { 0.0 });
        if reach.is_finite() {
            *x += move_by * (share * reach / (dim as f64).sqrt());
        }
    }
}

/// All `(i, j, k)` below `counts`, the first index fastest.
fn indices([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..nz).flat_map(move |k| (0..ny).flat_map(move |j| (0..nx).map(move |i| (i, j, k))))
}

/// Adds the facets of a cell that lie on a side of the grid to the boundary of that name.
fn name_sides(mesh: &mut Mesh, cell: usize, at: [usize; 3], counts: [usize; 3], sides: [[&str; 2]; 3]) {
    // Low and high side of each axis in the facet order of Q4 and H8.
    let local = match mesh.space {
        Space::Plane => vec![[3, 1], [0, 2]],
        Space::Solid => vec![[5, 3], [2, 4], [0, 1]],
    };
    let facets: Vec<Facet> = mesh.cell_facets(cell).collect();
    for (axis, [low, high]) in local.into_iter().enumerate() {
        if at[axis] == 0 {
            mesh.boundaries.entry(sides[axis][0].to_owned()).or_default().push(facets[low]);
        }
        if at[axis] + 1 == counts[axis] {
            mesh.boundaries.entry(sides[axis][1].to_owned()).or_default().push(facets[high]);
        }
    }
}

fn check_lines(lines: &[f64]) -> Result<()> {
    let ascending = lines.windows(2).all(|w| w[1] > w[0]) && lines.iter().all(|x| x.is_finite());
    if lines.len() < 2 || !ascending {
        return Err(bad_grid(format!(
            "grid lines {lines:?}; give at least two finite coordinates in ascending order"
        )));
    }
    Ok(())
}

fn bad_grid(message: String) -> Error {
    Error::Geometry { what: "structured mesh".to_owned(), message }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::quadrature::tensor_gauss;
    use std::f64::consts::PI;

    /// Area or volume, and the smallest Jacobian seen.
    fn measure(mesh: &Mesh) -> (f64, f64) {
        let rule = tensor_gauss(mesh.space.dim(), 2);
        let (mut sum, mut smallest) = (0.0, f64::INFINITY);
        for cell in 0..mesh.cell_count() {
            for &(xi, w) in &rule {
                let j = mesh.sample(cell, xi).determinant;
                sum += j * w;
                smallest = f64::min(smallest, j);
            }
        }
        (sum, smallest)
    }

    fn boundary_measure(mesh: &Mesh, name: &str) -> f64 {
        let rule = tensor_gauss(mesh.space.dim() - 1, 2);
        mesh.boundaries[name]
            .iter()
            .flat_map(|f| rule.iter().map(|(eta, w)| mesh.facet_point(f, [eta[0], eta[1]]).measure * w))
            .sum()
    }

    fn brick() -> Mesh {
        let axes =
            [graded(0.0, 2.0, 4, 1.3).unwrap(), even(0.0, 1.0, 3).unwrap(), even(-1.0, 2.0, 3).unwrap()];
        grid(&axes).unwrap()
    }

    #[test]
    fn grading_multiplies_intervals() {
        let x = graded(1.0, 3.0, 4, 2.0).unwrap();
        assert_eq!(x.first(), Some(&1.0));
        assert_eq!(x.last(), Some(&3.0));
        for w in x.windows(3) {
            assert!(((w[2] - w[1]) / (w[1] - w[0]) - 2.0).abs() < 1e-14);
        }
    }

    #[test]
    fn box_has_its_volume_and_sides() {
        let mesh = brick();
        assert_eq!((mesh.cell_count(), mesh.nodes.len()), (36, 80));
        assert!((measure(&mesh).0 - 6.0).abs() < 1e-13);
        let areas =
            [("left", 3.0), ("right", 3.0), ("bottom", 6.0), ("top", 6.0), ("back", 2.0), ("front", 2.0)];
        for (name, area) in areas {
            assert!((boundary_measure(&mesh, name) - area).abs() < 1e-13, "{name}");
        }
        let outward = mesh.facet_point(&mesh.boundaries["back"][0], [0.0, 0.0]).normal;
        assert_eq!(outward, -Vec3::z());
    }

    #[test]
    fn plane_sides_point_outwards() {
        let mesh = grid(&[even(0.0, 4.0, 4).unwrap(), even(0.0, 1.0, 2).unwrap()]).unwrap();
        let normals =
            [("left", -Vec3::x()), ("right", Vec3::x()), ("bottom", -Vec3::y()), ("top", Vec3::y())];
        for (name, normal) in normals {
            for facet in &mesh.boundaries[name] {
                assert!((mesh.facet_point(facet, [0.3, 0.0]).normal - normal).norm() < 1e-15, "{name}");
            }
        }
        assert_eq!(mesh.boundary_nodes("left").unwrap(), [0, 5, 10]);
    }

    #[test]
    fn cook_block_has_its_area() {
        let corner = |x, y| Vec3::new(x, y, 0.0);
        let corners = [corner(0.0, 0.0), corner(48.0, 44.0), corner(48.0, 60.0), corner(0.0, 44.0)];
        let lines = even(0.0, 1.0, 5).unwrap();
        let mesh = quadrilateral(corners, &lines, &lines).unwrap();
        // Trapezium of parallel sides 44 and 16 at distance 48.
        assert!((measure(&mesh).0 / 1440.0 - 1.0).abs() < 1e-14);
        assert!((boundary_measure(&mesh, "right") - 16.0).abs() < 1e-13);
    }

    #[test]
    fn sector_tends_to_the_area_between_ellipses() {
        let area = |n| {
            let (s, t) = (even(0.0, 1.0, 2).unwrap(), even(0.0, 0.5 * PI, n).unwrap());
            measure(&elliptic_sector([2.0, 1.0], [3.25, 2.75], &s, &t).unwrap()).0
        };
        let exact = 0.25 * PI * (3.25 * 2.75 - 2.0);
        let (coarse, fine) = (exact - area(8), exact - area(16));
        // Chords instead of arcs: error h², so a factor of four within a per cent.
        assert!((coarse / fine - 4.0).abs() < 0.04, "{coarse} {fine}");
    }

    #[test]
    fn jiggling_moves_interior_nodes_only_and_repeats() {
        let sound = brick();
        let mut moved = sound.clone();
        jiggle(&mut moved, 0.25, 7);
        let boundary: std::collections::BTreeSet<usize> =
            sound.boundaries.keys().flat_map(|name| sound.boundary_nodes(name).unwrap()).collect();
        for n in 0..sound.nodes.len() {
            assert_eq!(sound.nodes[n] == moved.nodes[n], boundary.contains(&n), "node {n}");
        }
        let (volume, smallest) = measure(&moved);
        assert!((volume - 6.0).abs() < 1e-12 && smallest > 0.0);
        let mut again = sound;
        jiggle(&mut again, 0.25, 7);
        assert_eq!(again, moved);
    }

    #[test]
    fn bad_grids_are_refused() {
        assert!(graded(0.0, 1.0, 0, 1.0).is_err());
        assert!(graded(1.0, 0.0, 2, 1.0).is_err());
        assert!(graded(0.0, 1.0, 2, f64::NAN).is_err());
        assert!(grid(&[vec![0.0, 1.0], vec![0.0, f64::NAN]]).is_err());
        assert!(grid(&[vec![0.0, 1.0]]).is_err());
        assert!(elliptic_sector([2.0, 1.0], [1.0, 2.0], &[0.0, 1.0], &[0.0, 1.0]).is_err());
    }
}
