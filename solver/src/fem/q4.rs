//! The bilinear quadrilateral.

use super::element::{Element, sealed::Sealed};

/// Four nodes, counter-clockwise.
///
/// ```text
/// 3 ─── 2
/// │     │
/// 0 ─── 1
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Q4;

impl Sealed for Q4 {}

impl Element<2, 4> for Q4 {
    const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    const FACETS: &'static [&'static [usize]] = &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::element::check_shape_functions;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn shape_functions_hold(x in -1.0..1.0f64, y in -1.0..1.0f64) {
            check_shape_functions::<Q4, 2, 4>([x, y]);
        }
    }
}
