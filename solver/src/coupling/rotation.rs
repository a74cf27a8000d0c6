//! Ties of rotations: `θ_d − ½ (curl u)(x_d) = 0` for particles on elements, `θ_d − Σ N_i θ_i = 0`
//! for particles on particles.
//!
//! Rows are divided by a length (the local spacing of the particles), so that a rotation and a
//! displacement weigh alike in the constraint matrix.

use super::Row;
use super::side::{Side, Terms, accumulate};
use super::trace::{FacePoint, Frame};

/// `rotation of first − rotation of second` about `axis` at a point of the face; `None` where
/// neither side has rotations of its own, or a side does not reach the point.
pub fn difference(
    frame: &Frame,
    s: &FacePoint,
    sides: [(&Side, &[(usize, f64)]); 2],
    axis: usize,
) -> Option<Terms> {
    let [(first, w1), (second, w2)] = sides;
    if !first.is_discrete() && !second.is_discrete() {
        return None;
    }
    let mut terms = first.rotation(frame, s, w1, axis)?;
    accumulate(&mut terms, second.rotation(frame, s, w2, axis)?, -1.0);
    Some(terms)
}

/// Rows for one point of `tied`, which lies on `onto` with the given weights.
pub fn at_point(
    frame: &Frame,
    tied: &Side,
    onto: &Side,
    point: usize,
    weights: &[(usize, f64)],
    label: impl Fn(usize) -> String,
) -> Vec<Row> {
    let space = tied.trace.space;
    let s = frame.flatten(&tied.position(point));
    let length = spacing(tied);
    let own = [(point, 1.0)];
    space
        .rotation_axes()
        .iter()
        .enumerate()
        .filter_map(|(k, &axis)| {
            let mut terms = difference(frame, &s, [(tied, &own), (onto, weights)], axis)?;
            terms.iter_mut().for_each(|t| t.1 *= length);
            Some(Row::new(terms, label(space.dim() + k), tied.position(point)))
        })
        .collect()
}

/// Mean length of the first edges of the facets, in m: the scale that turns a rotation into a displacement.
pub fn spacing(side: &Side) -> f64 {
    let facets = &side.trace.facets;
    let edges = facets.iter().map(|f| (side.position(f[1]) - side.position(f[0])).norm());
    edges.sum::<f64>() / facets.len().max(1) as f64
}
