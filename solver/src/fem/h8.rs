//! The trilinear hexahedron.

use super::element::{Element, sealed::Sealed};

/// Eight nodes: 0–3 counter-clockwise at `ζ = −1` seen from `+ζ`, 4–7 above them.
///
/// ```text
///   7 ─── 6
///  4 ─── 5│
///  │3    │2      ζ  η
///  0 ─── 1       │╱__ ξ
/// ```
#[derive(Debug, Clone, Copy)]
pub struct H8;

impl Sealed for H8 {}

impl Element<3, 8> for H8 {
    const CORNERS: [[f64; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];
    const FACETS: &'static [&'static [usize]] =
        &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::element::check_shape_functions;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn shape_functions_hold(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64) {
            check_shape_functions::<H8, 3, 8>([x, y, z]);
        }
    }

    #[test]
    fn facet_normals_point_outwards() {
        for facet in H8::FACETS {
            let corner = |k: usize| Vector3::from(H8::CORNERS[facet[k]]);
            let normal = (corner(1) - corner(0)).cross(&(corner(3) - corner(0)));
            let centre = (corner(0) + corner(1) + corner(2) + corner(3)) / 4.0;
            assert!(normal.dot(&centre) > 0.0, "face {facet:?}");
        }
    }
}
