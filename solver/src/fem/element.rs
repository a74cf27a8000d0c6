//! What every element has to say: its corners and facets. The rest follows.

use nalgebra::SVector;

pub(super) mod sealed {
    /// Keeps the elements to those of this module.
    pub trait Sealed {}
}

/// A multilinear element of dimension `D` with `N = 2^D` nodes on the cube `[−1, 1]^D`.
pub trait Element<const D: usize, const N: usize>: sealed::Sealed {
    /// Natural coordinates `ξ_a` of the nodes.
    const CORNERS: [[f64; D]; N];

    /// Local nodes of each edge or face, ordered so that the normal points outwards.
    const FACETS: &'static [&'static [usize]];

    /// Shape functions `N_a(ξ) = Π_i ½(1 + ξ_a,i ξ_i)` (Hughes 2000, §3.2).
    fn values(xi: &SVector<f64, D>) -> [f64; N] {
        Self::CORNERS.map(|corner| (0..D).map(|i| 0.5 * (1.0 + corner[i] * xi[i])).product())
    }

    /// Derivatives `∂N_a/∂ξ_j = ½ ξ_a,j Π_{i≠j} ½(1 + ξ_a,i ξ_i)`.
    fn gradients(xi: &SVector<f64, D>) -> [SVector<f64, D>; N] {
        Self::CORNERS.map(|corner| {
            SVector::from_fn(|j, _| {
                let others = (0..D).filter(|&i| i != j);
                0.5 * corner[j] * others.map(|i| 0.5 * (1.0 + corner[i] * xi[i])).product::<f64>()
            })
        })
    }
}

/// The property test every element has to pass.
#[cfg(test)]
pub(super) fn check_shape_functions<E: Element<D, N>, const D: usize, const N: usize>(xi: [f64; D]) {
    let xi = SVector::from(xi);
    let values = E::values(&xi);
    let gradients = E::gradients(&xi);
    // Sums of N terms of order one: a few ulp.
    let tiny = 1e-14;
    assert!((values.iter().sum::<f64>() - 1.0).abs() < tiny, "partition of unity at {xi}");
    assert!(gradients.iter().sum::<SVector<f64, D>>().norm() < tiny, "gradients sum to zero at {xi}");
    let position: SVector<f64, D> =
        values.iter().zip(E::CORNERS).map(|(&n, corner)| SVector::from(corner) * n).sum();
    assert!((position - xi).norm() < tiny, "linear completeness at {xi}");
    for (a, &corner) in E::CORNERS.iter().enumerate() {
        for (b, n) in E::values(&SVector::from(corner)).into_iter().enumerate() {
            assert_eq!(n, f64::from(a == b), "N_{b} at node {a}");
        }
    }
    // Multilinear: the central difference along an axis is exact.
    for j in 0..D {
        let step = SVector::<f64, D>::from_fn(|i, _| if i == j { 0.5 } else { 0.0 });
        let (ahead, behind) = (E::values(&(xi + step)), E::values(&(xi - step)));
        for a in 0..N {
            assert!((ahead[a] - behind[a] - gradients[a][j]).abs() < tiny, "∂N_{a}/∂ξ_{j} at {xi}");
        }
    }
}
