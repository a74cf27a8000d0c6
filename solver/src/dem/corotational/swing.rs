//! `ρ = α / sin α` and its slope, from the cosine of the angle α between two directions.

/// Below these values of `1 − cos α` (α ≈ 0.045 and 0.35) so many terms of the series reach rounding: short for the usual
/// small strain, and no arc cosine until it is cheap by comparison.
pub(super) const NEAR: f64 = 1e-3;
const NEAR_TERMS: usize = 6;
const FAR: f64 = 0.06;
const FAR_TERMS: usize = 13;

/// Coefficients of `α / sin α = Σ 2^k (k!)²/(2k+1)! y^k`, `y = 1 − cos α`: each is `k/(2k+1)` times the one before.
const COEFFICIENT: [f64; FAR_TERMS] = {
    let mut a = [1.0; FAR_TERMS];
    let mut k = 1;
    while k < FAR_TERMS {
        a[k] = a[k - 1] * k as f64 / (2 * k + 1) as f64;
        k += 1;
    }
    a
};

/// `ρ` and `dρ/dc` at `c = cos α`, `|α| < π`.
pub(super) fn swing(c: f64) -> (f64, f64) {
    let y = 1.0 - c;
    if y < NEAR {
        near(y)
    } else if y < FAR {
        series::<FAR_TERMS>(y)
    } else {
        let sine2 = y * (1.0 + c);
        let rho = c.acos() / sine2.sqrt();
        (rho, (rho * c - 1.0) / sine2)
    }
}

/// The same for `y = 1 − cos α` below [`NEAR`], without a branch.
#[inline(always)]
pub(super) fn near(y: f64) -> (f64, f64) {
    series::<NEAR_TERMS>(y)
}

/// Even and odd powers apart: two short chains instead of a long one, since a bond waits for this.
#[inline(always)]
fn series<const TERMS: usize>(y: f64) -> (f64, f64) {
    let y2 = y * y;
    // By the parity of k: Σ a_k y^k and Σ k a_k y^(k−1), over y where k is odd and even respectively.
    let (mut rho, mut slope) = ([0.0; 2], [0.0; 2]);
    for k in (0..TERMS).rev() {
        let (a, p) = (COEFFICIENT[k], k % 2);
        // The first of each chain is its coefficient: the compiler may not drop a product with zero.
        rho[p] = if k + 2 < TERMS { rho[p] * y2 + a } else { a };
        if k > 0 {
            slope[p] = if k + 2 < TERMS { slope[p] * y2 + k as f64 * a } else { k as f64 * a };
        }
    }
    (rho[0] + rho[1] * y, -(slope[1] + slope[0] * y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_meet() {
        for alpha in [1e-9, 1e-3, 0.044, 0.046, 0.1, 0.34, 0.36, 1.0, 3.0] {
            let (rho, slope) = swing(f64::cos(alpha));
            assert!((rho / (alpha / alpha.sin()) - 1.0).abs() < 1e-14, "{alpha}");
            // dρ/dc = (α cos α − sin α)/sin³ α; cancels for small α, where it tends to −1/3.
            let exact = if alpha < 0.01 {
                -1.0 / 3.0
            } else {
                (alpha * alpha.cos() - alpha.sin()) / alpha.sin().powi(3)
            };
            let tolerance = if alpha < 0.01 { 1e-6 } else { 1e-11 };
            assert!((slope / exact - 1.0).abs() < tolerance, "{alpha}: {slope} {exact}");
        }
    }
}
