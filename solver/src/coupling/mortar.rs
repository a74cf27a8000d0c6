//! Averaged (mortar) ties: `∫ ψ_k (u¹ − u²) dΓ = 0` for every multiplier k (Bernardi, Maday and
//! Patera 1994).
//!
//! Both traces are piecewise (bi)linear, ψ are the shape functions of the trace that carries the
//! multipliers, and the integral runs over the common refinement of both, so that a constant
//! traction is passed on exactly whatever the meshes.

use super::Row;
use super::rotation;
use super::side::{Side, Terms, accumulate, component_name};
use super::trace::{FacePoint, Frame, area};
use crate::error::{Error, Result};
use crate::space::Space;
use std::collections::BTreeMap;

/// A quadrature point of the common refinement: weight and the facet of either side.
struct QuadraturePoint {
    s: FacePoint,
    weight: f64,
    facets: [usize; 2],
}

/// Rows for the ties `sides[0] − sides[1]`, with multipliers on the trace of `sides[carrier]`.
///
/// # Errors
/// The faces do not overlap.
pub fn rows(
    tie: &str,
    frame: &Frame,
    sides: [&Side; 2],
    carrier: usize,
    rotations: bool,
) -> Result<Vec<Row>> {
    let space = sides[0].trace.space;
    let channels = space.dim() + if rotations { space.rotations() } else { 0 };
    // Per multiplier: ∫ψ and the terms of each channel.
    let mut sums: BTreeMap<usize, (f64, Vec<Terms>)> = BTreeMap::new();
    let length = [0, 1].map(|k| rotation::spacing(sides[k]));
    for q in common_refinement(frame, sides) {
        let weights = [0, 1].map(|k| sides[k].trace.weights_in(frame, q.facets[k], &q.s));
        let [Some(w1), Some(w2)] = &weights else { continue };
        let psi = if carrier == 0 { w1 } else { w2 };
        for c in 0..channels {
            let difference = if c < space.dim() {
                let mut terms = sides[0].displacement(w1, c);
                accumulate(&mut terms, sides[1].displacement(w2, c), -1.0);
                terms
            } else {
                let axis = space.rotation_axes()[c - space.dim()];
                match rotation::difference(frame, &q.s, [(sides[0], w1), (sides[1], w2)], axis) {
                    Some(mut terms) => {
                        terms.iter_mut().for_each(|t| t.1 *= length[carrier]);
                        terms
                    }
                    None => continue,
                }
            };
            for &(k, value) in psi {
                let sum = sums.entry(k).or_insert_with(|| (0.0, vec![Terms::new(); channels]));
                if c == 0 {
                    sum.0 += q.weight * value;
                }
                accumulate(&mut sum.1[c], difference.clone(), q.weight * value);
            }
        }
    }
    let side = sides[carrier];
    let whole: f64 = sums.values().map(|s| s.0).sum();
    let mut rows = Vec::new();
    for (k, (measure, channels)) in sums {
        // A multiplier whose support is only touched by the other face ties nothing.
        if measure <= 1e-10 * whole {
            continue;
        }
        for (c, mut terms) in channels.into_iter().enumerate() {
            terms.iter_mut().for_each(|t| t.1 /= measure);
            let point = side.trace.points[k];
            let name = component_name(space, c);
            let label =
                format!("tie '{tie}': average about {} {point} of '{}', {name}", side.noun(), side.name);
            let row = Row::new(terms, label, side.position(k));
            if !row.terms.is_empty() {
                rows.push(row);
            }
        }
    }
    if rows.is_empty() {
        let message = format!(
            "the faces of '{}' and '{}' do not overlap; check the faces named",
            sides[0].name, sides[1].name
        );
        return Err(Error::EmptyInterface { tie: tie.to_owned(), message });
    }
    Ok(rows)
}

/// Quadrature points of every overlap of a facet of one side with a facet of the other.
fn common_refinement(frame: &Frame, sides: [&Side; 2]) -> Vec<QuadraturePoint> {
    let polygons = sides.map(|side| {
        let flatten = |f: &Vec<usize>| f.iter().map(|&p| frame.flatten(&side.position(p))).collect();
        side.trace.facets.iter().map(flatten).collect::<Vec<Vec<FacePoint>>>()
    });
    let bounds = |polygon: &[FacePoint]| {
        polygon.iter().fold((f64::MAX, f64::MIN), |(lo, hi), p| (lo.min(p.x), hi.max(p.x)))
    };
    // Sweep along the first tangent: facets of the second side sorted by where they begin.
    let mut second: Vec<usize> = (0..polygons[1].len()).collect();
    second.sort_by(|&a, &b| bounds(&polygons[1][a]).0.total_cmp(&bounds(&polygons[1][b]).0));
    let widest = polygons[1].iter().map(|p| bounds(p).1 - bounds(p).0).fold(0.0, f64::max);
    let mut points = Vec::new();
    for (i, first) in polygons[0].iter().enumerate() {
        let (lo, hi) = bounds(first);
        let from = second.partition_point(|&j| bounds(&polygons[1][j]).0 < lo - widest);
        for &j in second[from..].iter().take_while(|&&j| bounds(&polygons[1][j]).0 < hi) {
            let other = &polygons[1][j];
            match sides[0].trace.space {
                Space::Plane => quadrature_on_segment(first, other, [i, j], &mut points),
                Space::Solid => quadrature_on_polygon(first, other, [i, j], &mut points),
            }
        }
    }
    points
}

/// Three Gauss points (exact to degree 5: linear ψ, linear N and a quadratic curl) on the overlap of two segments.
fn quadrature_on_segment(
    first: &[FacePoint],
    second: &[FacePoint],
    facets: [usize; 2],
    points: &mut Vec<QuadraturePoint>,
) {
    let ends = |s: &[FacePoint]| (s[0].x.min(s[1].x), s[0].x.max(s[1].x));
    let (lo, hi) = (ends(first).0.max(ends(second).0), ends(first).1.min(ends(second).1));
    if hi <= lo {
        return;
    }
    for (xi, w) in [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)] {
        let s = FacePoint::new(0.5 * (lo + hi) + 0.5 * (hi - lo) * xi, 0.0);
        points.push(QuadraturePoint { s, weight: 0.5 * (hi - lo) * w, facets });
    }
}

/// Six points per triangle (degree 4, Dunavant 1985) on the overlap of two convex polygons.
fn quadrature_on_polygon(
    first: &[FacePoint],
    second: &[FacePoint],
    facets: [usize; 2],
    points: &mut Vec<QuadraturePoint>,
) {
    const RULE: [(f64, f64); 2] =
        [(0.445_948_490_915_965, 0.223_381_589_678_011), (0.091_576_213_509_771, 0.109_951_743_655_322)];
    let overlap = clip(first, second);
    for k in 2..overlap.len() {
        let triangle = [overlap[0], overlap[k - 1], overlap[k]];
        let size = area(&triangle);
        for (a, w) in RULE {
            for corner in 0..3 {
                let weights = [0, 1, 2].map(|i| if i == corner { 1.0 - 2.0 * a } else { a });
                let s = triangle.iter().zip(weights).map(|(p, n)| p * n).sum();
                points.push(QuadraturePoint { s, weight: size * w, facets });
            }
        }
    }
}

/// Overlap of two convex polygons, counter-clockwise (Sutherland and Hodgman 1974); empty if they do not overlap.
fn clip(subject: &[FacePoint], by: &[FacePoint]) -> Vec<FacePoint> {
    let counter_clockwise = |p: &[FacePoint]| {
        let mut p = p.to_vec();
        if area(&p) < 0.0 {
            p.reverse();
        }
        p
    };
    let by = counter_clockwise(by);
    let mut polygon = counter_clockwise(subject);
    let smallest = 1e-12 * area(&polygon).min(area(&by));
    for e in 0..by.len() {
        let (a, b) = (by[e], by[(e + 1) % by.len()]);
        let side = |p: &FacePoint| (b - a).perp(&(p - a));
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for k in 0..polygon.len() {
            let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            let (dp, dq) = (side(&p), side(&q));
            if dp >= 0.0 {
                kept.push(p);
            }
            if dp * dq < 0.0 {
                kept.push(p + (q - p) * (dp / (dp - dq)));
            }
        }
        polygon = kept;
    }
    if polygon.len() < 3 || area(&polygon) < smallest { Vec::new() } else { polygon }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_of_shifted_squares_has_the_right_area() {
        let square = |x: f64, y: f64| {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[a, b]| FacePoint::new(a + x, b + y))
                .to_vec()
        };
        let overlap = clip(&square(0.0, 0.0), &square(0.25, -0.5));
        assert!((area(&overlap) - 0.375).abs() < 1e-15);
        assert!(clip(&square(0.0, 0.0), &square(1.0, 0.0)).is_empty());
    }

    /// The rule is exact for x⁴ on the unit triangle: 1/30.
    #[test]
    fn triangle_rule_has_degree_four() {
        let triangle = [FacePoint::new(0.0, 0.0), FacePoint::new(1.0, 0.0), FacePoint::new(0.0, 1.0)];
        let mut points = Vec::new();
        quadrature_on_polygon(&triangle, &triangle, [0, 0], &mut points);
        let integral: f64 = points.iter().map(|q| q.weight * q.s.x.powi(4)).sum();
        // Dunavant's table carries 15 digits.
        assert!((integral - 1.0 / 30.0).abs() < 1e-14, "{integral}");
    }
}
