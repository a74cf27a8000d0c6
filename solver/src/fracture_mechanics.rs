//! Linear elastic fracture mechanics in closed form, to compare cracks and notches with.

use crate::error::{Error, Result};
use crate::fem::elasticity::{Elasticity, Hypothesis};
use std::f64::consts::PI;

/// A crack of relative depth a/W, or an angle, outside the range of a formula.
fn within(name: &'static str, value: f64, range: std::ops::Range<f64>, mend: &'static str) -> Result<f64> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(Error::Material { what: "fracture mechanics".to_owned(), name, value, mend })
}

/// Edge-cracked beam in three-point bending, span S = 4W: `f` in `K_I = P S/(B W^{3/2}) f(a/W)`.
///
/// `f = 3√α [1.99 − α(1−α)(2.15 − 3.93α + 2.7α²)] / (2(1+2α)(1−α)^{3/2})`, α = a/W; within 0.5 % for any α
/// (Srawley 1976, *Int. J. Fracture* 12, 475–476).
///
/// # Errors
/// α not between 0 and 1.
pub fn srawley(alpha: f64) -> Result<f64> {
    let a = within("a/W", alpha, 0.0..1.0, "give a crack depth from zero to below the depth of the beam")?;
    let poly = 1.99 - a * (1.0 - a) * (2.15 - 3.93 * a + 2.7 * a * a);
    Ok(3.0 * a.sqrt() * poly / (2.0 * (1.0 + 2.0 * a) * (1.0 - a).powf(1.5)))
}

/// The same beam, from the fit to boundary collocation at S = 4W alone: `f = 3/2 √α (1.93 − 3.07α + 14.53α² − 25.11α³ + 25.80α⁴)` for α up
/// to 0.6 (Brown & Srawley 1966, *Plane Strain Crack Toughness Testing of High Strength Metallic Materials*, ASTM STP 410).
///
/// Short cracks tell the two apart: there [`srawley`] tends to pure bending, 1.99, and this fit keeps that a load at a point takes 4.4 % of the
/// stress off the fibre below it, `1.12√π (1 − 0.266 · 2W/3S) = 1.90` (Timoshenko & Goodier 1970, §40).
///
/// # Errors
/// α not between 0 and 0.6.
pub fn brown_srawley(alpha: f64) -> Result<f64> {
    // 0.6 itself belongs to it.
    let a =
        within("a/W", alpha, 0.0..0.6 + 1e-12, "give a crack depth from zero to 0.6 of that of the beam")?;
    Ok(1.5 * a.sqrt() * (1.93 + a * (-3.07 + a * (14.53 + a * (-25.11 + a * 25.80)))))
}

/// Stress intensity `K_I` (Pa√m) of that beam under the load P (N), depth W and thickness B (m), span 4W.
///
/// # Errors
/// As [`srawley`].
pub fn bend_intensity(load: f64, depth: f64, thickness: f64, alpha: f64) -> Result<f64> {
    Ok(load * 4.0 * depth / (thickness * depth.powf(1.5)) * srawley(alpha)?)
}

/// Edge crack in a strip under remote tension: `F` in `K_I = σ√(πa) F(a/W)`, ends free to turn.
///
/// `F = √((2/πα) tan(πα/2)) [0.752 + 2.02α + 0.37(1 − sin(πα/2))³] / cos(πα/2)`; within 0.5 % for any α (Tada, Paris & Irwin, *The
/// Stress Analysis of Cracks Handbook*, single edge notch test specimen).
///
/// # Errors
/// α not between 0 and 1.
pub fn edge_crack_tension(alpha: f64) -> Result<f64> {
    let a = within("a/W", alpha, 0.0..1.0, "give a crack depth from zero to below the width of the strip")?;
    let half = 0.5 * PI * a;
    let tangent = if a > 0.0 { half.tan() / half } else { 1.0 };
    let poly = 0.752 + 2.02 * a + 0.37 * (1.0 - half.sin()).powi(3);
    Ok(tangent.sqrt() * poly / half.cos())
}

/// Exponent λ of the symmetric displacement field `u ∝ r^λ` at a notch of opening angle ω (rad) with free faces; stress goes as
/// `r^{λ−1}`. The root in [½, 1) of `sin 2λγ + λ sin 2γ = 0`, γ = π − ω/2 (Williams 1952, *J. Appl. Mech.* 19, 526–528).
///
/// # Errors
/// An angle not in [0, π).
pub fn williams_exponent(angle: f64) -> Result<f64> {
    let omega = within("notch angle", angle, 0.0..PI, "give an angle from 0 (a crack) to below π, in rad")?;
    if omega == 0.0 {
        return Ok(0.5);
    }
    let gamma = PI - 0.5 * omega;
    let f = |l: f64| (2.0 * l * gamma).sin() + l * (2.0 * gamma).sin();
    // f(½) = sin γ (1 + cos γ) > 0 > 2 sin 2γ = f(1).
    let (mut low, mut high) = (0.5, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// Modulus `E'` in `J = K²/E'`, in Pa: E in plane stress, `E/(1−ν²)` in plane strain and inside a solid (Irwin 1957).
pub fn plane_modulus(elasticity: &Elasticity, hypothesis: Hypothesis) -> f64 {
    match hypothesis {
        Hypothesis::PlaneStress { .. } => elasticity.young_pa,
        _ => elasticity.young_pa / (1.0 - elasticity.poisson * elasticity.poisson),
    }
}

/// Displacement at a crack tip, along the crack and across it (m), at the distance r (m) and the angle θ (rad) from the line ahead, for
/// `K_I` (Pa√m): the singular term of Williams (1957), *J. Appl. Mech.* 24, 109–114.
///
/// `u = K/2μ √(r/2π) [cos θ/2 (κ − 1 + 2 sin² θ/2), sin θ/2 (κ + 1 − 2 cos² θ/2)]`, κ = (3−ν)/(1+ν) in plane stress, 3 − 4ν in plane strain.
pub fn mode_one_displacement(
    intensity: f64,
    elasticity: &Elasticity,
    hypothesis: Hypothesis,
    [r, theta]: [f64; 2],
) -> [f64; 2] {
    let nu = elasticity.poisson;
    let kappa = match hypothesis {
        Hypothesis::PlaneStress { .. } => (3.0 - nu) / (1.0 + nu),
        _ => 3.0 - 4.0 * nu,
    };
    let (sin, cos) = (0.5 * theta).sin_cos();
    let factor = 0.5 * intensity / elasticity.shear_pa() * (r / (2.0 * PI)).sqrt();
    [factor * cos * (kappa - 1.0 + 2.0 * sin * sin), factor * sin * (kappa + 1.0 - 2.0 * cos * cos)]
}

/// A power law `y = c xᵖ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Exponent p; of a stress ahead of a notch it is λ − 1.
    pub exponent: f64,
    /// Factor c.
    pub factor: f64,
    /// Root mean square of `ln y − ln(c xᵖ)`.
    pub scatter: f64,
}

/// Least-squares line through `(ln x, ln y)`: all points weigh alike, so space them evenly in ln x.
///
/// # Errors
/// Fewer than two different x; values that are not positive.
pub fn fit_power_law(points: &[[f64; 2]]) -> Result<PowerLaw> {
    let fail = |message: String| Err(Error::Geometry { what: "power-law fit".to_owned(), message });
    if let Some([x, y]) = points.iter().find(|p| p.iter().any(|v| !(v.is_finite() && *v > 0.0))) {
        return fail(format!("the point ({x}, {y}) has no logarithm; give positive, finite values"));
    }
    let n = points.len() as f64;
    let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
    let [mx, my] = [0, 1].map(|c| logs.iter().map(|l| l[c]).sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| logs.iter().map(|l| f(l[0] - mx, l[1] - my)).sum::<f64>();
    let (xx, xy) = (sum(&|x, _| x * x), sum(&|x, y| x * y));
    if points.len() < 2 || xx == 0.0 {
        return fail("it needs at least two points at different distances".to_owned());
    }
    let exponent = xy / xx;
    let scatter = (sum(&|x, y| (y - exponent * x).powi(2)) / n).sqrt();
    Ok(PowerLaw { exponent, factor: (my - exponent * mx).exp(), scatter })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the shared table of benchmarks: four decimals of f, seven of λ.
    #[test]
    fn published_values() {
        for (alpha, f) in [(0.2, 1.1749), (0.4, 1.9818), (0.5, 2.6625)] {
            assert!((srawley(alpha).unwrap() - f).abs() < 5e-5, "{alpha}");
        }
        // Two fits of the same collocation: 0.5 % each where both hold, and further apart where cracks are short.
        for alpha in [0.3, 0.4, 0.5, 0.6] {
            assert!((brown_srawley(alpha).unwrap() / srawley(alpha).unwrap() - 1.0).abs() < 0.006, "{alpha}");
        }
        assert!((brown_srawley(0.2).unwrap() / 1.1656 - 1.0).abs() < 1e-4);
        let exponents = [(30.0, 0.501_453_0), (60.0, 0.512_221_4), (90.0, 0.544_483_7), (120.0, 0.615_731_1)];
        for (degrees, lambda) in exponents {
            let found = williams_exponent(f64::to_radians(degrees)).unwrap();
            assert!((found - lambda).abs() < 5e-8, "{degrees}: {found}");
        }
        assert_eq!(williams_exponent(0.0), Ok(0.5));
        // The limit of a short crack, 1.1215 (Koiter), within the formula's 0.5 %.
        assert!((edge_crack_tension(0.0).unwrap() / 1.1215 - 1.0).abs() < 0.005);
        // Deep cracks: the ligament alone, in bending and tension; the exponent of the limit is −3/2.
        let deep = |a: f64| edge_crack_tension(a).unwrap() * (1.0 - a).powf(1.5);
        assert!((deep(0.999) / deep(0.9999) - 1.0).abs() < 0.005);
        let k = bend_intensity(100.0, 0.25, 0.05, 0.5).unwrap();
        assert!((k / (100.0 * 1.0 / (0.05 * 0.125) * 2.6625) - 1.0).abs() < 2e-5);
    }

    #[test]
    fn a_power_law_is_found_again() {
        let points: Vec<[f64; 2]> = (1..9).map(|k| [k as f64, 3.0 * (k as f64).powf(-0.4555)]).collect();
        let fit = fit_power_law(&points).unwrap();
        assert!((fit.exponent + 0.4555).abs() < 1e-14 && (fit.factor - 3.0).abs() < 1e-13);
        assert!(fit.scatter < 1e-14);
    }

    #[test]
    fn values_without_meaning_are_refused() {
        for bad in [-0.1, 1.0, f64::NAN] {
            assert!(srawley(bad).is_err() && edge_crack_tension(bad).is_err(), "{bad}");
            assert!(brown_srawley(bad).is_err(), "{bad}");
        }
        for bad in [-0.1, PI, f64::NAN] {
            assert!(williams_exponent(bad).is_err(), "{bad}");
        }
        assert!(fit_power_law(&[[1.0, 2.0]]).is_err());
        assert!(fit_power_law(&[[1.0, 2.0], [1.0, 3.0]]).is_err());
        assert!(fit_power_law(&[[1.0, 2.0], [2.0, -3.0]]).unwrap_err().to_string().contains("(2, -3)"));
        assert!(fit_power_law(&[]).is_err());
    }
}
