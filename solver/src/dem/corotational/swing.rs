//! `ρ = α / sin α` and its slope, from the cosine of the angle α between two directions.

/// Below this `1 − cos α` (α ≈ 0.35) the series is used: [`TERMS`] reach rounding there, and no arc cosine is taken.
const SERIES: f64 = 0.06;
const TERMS: usize = 11;

/// Coefficients of `α / sin α = Σ 2^k (k!)²/(2k+1)! y^k`, `y = 1 − cos α`: each is `k/(2k+1)` times the one before.
const COEFFICIENT: [f64; TERMS] = {
    let mut a = [1.0; TERMS];
    let mut k = 1;
    while k < TERMS {
        a[k] = a[k - 1] * k as f64 / (2 * k + 1) as f64;
        k += 1;
    }
    a
};

/// `ρ` and `dρ/dc` at `c = cos α`, `|α| < π`.
#[inline(always)]
pub(super) fn swing(c: f64) -> (f64, f64) {
    let y = 1.0 - c;
    if y < SERIES {
        let (mut rho, mut slope) = (0.0, 0.0);
        for k in (0..TERMS).rev() {
            slope = slope * y + rho;
            rho = rho * y + COEFFICIENT[k];
        }
        (rho, -slope)
    } else {
        let sine2 = y * (1.0 + c);
        let rho = c.acos() / sine2.sqrt();
        (rho, (rho * c - 1.0) / sine2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_meet() {
        for alpha in [1e-9, 1e-3, 0.1, 0.34, 0.36, 1.0, 3.0] {
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
