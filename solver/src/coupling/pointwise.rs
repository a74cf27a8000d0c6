//! Pointwise ties: `u(x_d) − Σ_i N_i(x_d) u_i = 0` for every point d of one face.
//!
//! Full row rank by construction, and exact where the faces nest and the tied points are the
//! finer side; otherwise the interface is stiffened or softened.

use super::Row;
use super::rotation;
use super::side::{Side, accumulate, component_name};
use super::trace::Frame;
use crate::error::{Error, Result};

/// One row per component for every point of `tied` that lies on the face of `onto`.
///
/// # Errors
/// No point of `tied` lies on the other face.
pub fn rows(tie: &str, frame: &Frame, tied: &Side, onto: &Side, rotations: bool) -> Result<Vec<Row>> {
    let space = tied.trace.space;
    let mut rows = Vec::new();
    for point in 0..tied.trace.points.len() {
        let s = frame.flatten(&tied.position(point));
        let Some(weights) = onto.trace.weights(frame, &s) else { continue };
        let label = |c: usize| {
            let name = component_name(space, c);
            format!("tie '{tie}': {} {} of '{}', {name}", tied.noun(), tied.trace.points[point], tied.name)
        };
        for c in 0..space.dim() {
            let mut terms = vec![(tied.unknown(point, c), 1.0)];
            accumulate(&mut terms, onto.displacement(&weights, c), -1.0);
            rows.push(Row::new(terms, label(c), tied.position(point)));
        }
        if rotations {
            rows.extend(rotation::at_point(frame, tied, onto, point, &weights, label));
        }
    }
    if rows.is_empty() {
        let message = format!(
            "no {} of '{}' lies on the face of '{}'; check the faces named",
            tied.noun(),
            tied.name,
            onto.name
        );
        return Err(Error::EmptyInterface { tie: tie.to_owned(), message });
    }
    Ok(rows)
}
