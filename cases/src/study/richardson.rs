//! Extrapolation from three levels, and its uncertainty (Roache 1994; Celik et al. 2008).

/// Below this an observed order says that the levels are not in the asymptotic range.
const LOWEST_ORDER: f64 = 0.5;
/// An observed order may exceed the formal one by this before it is distrusted.
const MARGIN: f64 = 0.1;

/// A value at vanishing cell size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The extrapolated value; the finest one where levels do not converge in one direction.
    pub value: f64,
    /// Observed order, where there is one.
    pub order: Option<f64>,
    /// Standard uncertainty of the extrapolated value: half the grid convergence index.
    pub u: f64,
}

/// From values on three levels, coarse to fine, with cell ratios `[h₁/h₂, h₂/h₃]`.
///
/// The grid convergence index takes Fs = 1.25 when the observed order is near the formal one, else 3;
/// oscillating or diverging levels give three times their range.
pub fn extrapolate(f: [f64; 3], ratios: [f64; 2], formal_order: f64) -> Estimate {
    let (e32, e21) = (f[0] - f[1], f[1] - f[2]);
    let scale = f.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    // Levels that agree to rounding have converged, whatever their order.
    if e32.abs() <= 1e-12 * scale && e21.abs() <= 1e-12 * scale {
        return Estimate { value: f[2], order: None, u: 0.0 };
    }
    let range =
        f.iter().fold(f64::NEG_INFINITY, |m, &v| m.max(v)) - f.iter().fold(f64::INFINITY, |m, &v| m.min(v));
    match observed_order(e32 / e21, ratios) {
        Some(order) => {
            let near = (LOWEST_ORDER..=formal_order + MARGIN).contains(&order);
            let p = order.clamp(LOWEST_ORDER, formal_order + MARGIN);
            let step = e21 / (ratios[1].powf(p) - 1.0);
            let safety = if near { 1.25 } else { 3.0 };
            Estimate { value: f[2] - step, order: Some(order), u: 0.5 * safety * step.abs() }
        }
        None => Estimate { value: f[2], order: None, u: 0.5 * 3.0 * range },
    }
}

/// Solves `e₃₂/e₂₁ = r₂₁^p (r₃₂^p − 1)/(r₂₁^p − 1)` by bisection; `None` for oscillation or divergence.
pub fn observed_order(quotient: f64, [r32, r21]: [f64; 2]) -> Option<f64> {
    let miss = |p: f64| r21.powf(p) * (r32.powf(p) - 1.0) / (r21.powf(p) - 1.0) - quotient;
    let (mut low, mut high) = (1e-3, 20.0);
    if !(miss(low) < 0.0 && miss(high) > 0.0) {
        return None;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if miss(middle) < 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values: p = 1.78617, extrapolated 0.9713003, index 0.10308 %.
    #[test]
    fn published_example() {
        let f = [0.96178, 0.96854, 0.97050];
        let found = extrapolate(f, [2.0, 2.0], 2.0);
        assert!((found.order.unwrap() - 1.78617).abs() < 1e-5);
        assert!((found.value - 0.9713003).abs() < 1e-7);
        assert!((2.0 * found.u / 0.97050 - 0.0010308).abs() < 1e-7);
    }

    /// Celik et al. (2008), table 1, first column: ratios 1.333 and 1.5, p = 1.53, extrapolated 6.1685, index 2.2 %.
    #[test]
    fn published_example_with_unequal_ratios() {
        let found = extrapolate([5.863, 5.972, 6.063], [1.333, 1.5], 2.0);
        // 1.537 printed as 1.53: two decimals, not rounded up.
        assert!((1.53..1.54).contains(&found.order.unwrap()), "{found:?}");
        // The printed value rests on the printed order: 5e-4 of it.
        assert!((found.value - 6.1685).abs() < 5e-4, "{found:?}");
        assert!((2.0 * found.u / 6.063 - 0.022).abs() < 5e-4, "two digits are printed: {found:?}");
    }

    #[test]
    fn unequal_ratios_give_back_the_order() {
        let at = |h: f64| 3.0 + 0.2 * h.powf(1.5);
        let found = extrapolate([at(1.0), at(0.5), at(0.2)], [2.0, 2.5], 2.0);
        assert!((found.order.unwrap() - 1.5).abs() < 1e-9);
        assert!((found.value - 3.0).abs() < 1e-9);
    }

    #[test]
    fn oscillation_and_divergence_give_three_times_the_range() {
        for f in [[1.0, 1.2, 1.1], [1.0, 1.1, 1.3]] {
            let found = extrapolate(f, [2.0, 2.0], 2.0);
            assert_eq!(found.order, None);
            let range = f.iter().fold(0.0f64, |m, v| m.max(*v)) - 1.0;
            assert!((found.u - 1.5 * range).abs() < 1e-12);
        }
        assert_eq!(extrapolate([2.0; 3], [2.0, 2.0], 2.0).u, 0.0);
    }
}
