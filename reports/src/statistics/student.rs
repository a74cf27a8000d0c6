//! Student's t distribution with a whole number of degrees of freedom.

use std::f64::consts::{FRAC_2_PI, PI};

/// Probability `P(T ≤ t)` for `ν = dof ≥ 1` degrees of freedom.
///
/// With `θ = atan(t/√ν)` the two-sided probability `A(t|ν) = P(|T| ≤ t)` is a finite sum
/// (Abramowitz & Stegun 1964, eqs. 26.7.3 and 26.7.4):
///
/// ν even: `A = sin θ (1 + ½cos²θ + (1·3)/(2·4) cos⁴θ + … up to cos^(ν−2) θ)`
///
/// ν odd: `A = (2/π)(θ + sin θ (cos θ + ⅔cos³θ + … up to cos^(ν−2) θ))`
pub fn cumulative(t: f64, dof: u32) -> f64 {
    let theta = (t / f64::from(dof).sqrt()).atan();
    let (sin, cos) = theta.sin_cos();
    let even = dof.is_multiple_of(2);
    let mut term = if even { 1.0 } else { cos };
    let mut sum = if dof == 1 { 0.0 } else { term };
    let mut k = if even { 2 } else { 3 };
    while k < dof {
        term *= cos * cos * f64::from(k - 1) / f64::from(k);
        sum += term;
        k += 2;
    }
    let a = if even { sin * sum } else { FRAC_2_PI * (theta + sin * sum) };
    0.5 * (1.0 + a)
}

/// Quantile `t` with `P(T ≤ t) = p`, for `½ ≤ p < 1` and `dof ≥ 1`, by bisection in the angle
/// `θ = atan(t/√ν)`, to rounding.
pub fn quantile(p: f64, dof: u32) -> f64 {
    let scale = f64::from(dof).sqrt();
    let (mut lo, mut hi) = (0.0, 0.5 * PI);
    // 60 halvings of an angle below 1.6 reach the last bit.
    for _ in 0..60 {
        let mid = 0.5 * (lo + hi);
        if cumulative(scale * f64::tan(mid), dof) < p {
            lo = mid;
        } else {
            hi = mid;
        }
    }
    scale * f64::tan(0.5 * (lo + hi))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_quantiles() {
        // Abramowitz & Stegun 1964, table 26.10 (three decimals).
        let table = [
            (0.95, 1, 6.314),
            (0.975, 1, 12.706),
            (0.95, 2, 2.920),
            (0.95, 3, 2.353),
            (0.975, 4, 2.776),
            (0.95, 9, 1.833),
            (0.975, 9, 2.262),
            (0.995, 10, 3.169),
            (0.95, 29, 1.699),
            (0.975, 120, 1.980),
        ];
        for (p, dof, t) in table {
            assert!((quantile(p, dof) - t).abs() < 6e-4, "p = {p}, ν = {dof}: {}", quantile(p, dof));
        }
    }

    #[test]
    fn quantile_inverts_the_distribution_and_tends_to_the_normal_one() {
        for dof in [1, 2, 3, 7, 40] {
            for p in [0.5, 0.6, 0.9, 0.999] {
                assert!((cumulative(quantile(p, dof), dof) - p).abs() < 1e-12);
            }
        }
        // The difference falls like (z³ + z)/4ν = 1.5e-5 at ν = 100 000.
        assert!((quantile(0.95, 100_000) - super::super::NORMAL_95).abs() < 2e-5);
    }
}
