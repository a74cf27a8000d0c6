//! Observed order of a refinement study, and the grid convergence index.

/// Order fitted to errors of known size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrderFit {
    /// Exponent p of `e = c hᵖ`.
    pub order: f64,
    /// Factor c.
    pub constant: f64,
}

/// Least ratio of neighbouring cell sizes that makes two levels count as different.
pub const LEAST_RATIO: f64 = 1.3;

/// Least-squares line through `(ln h, ln e)`.
///
/// `None` unless there are three or more levels, each [`LEAST_RATIO`] finer than the one before,
/// with positive, finite errors.
pub fn fitted_order(h: &[f64], error: &[f64]) -> Option<OrderFit> {
    let refines = h.windows(2).all(|w| w[0] / w[1] >= LEAST_RATIO * (1.0 - 1e-9));
    let positive = h.iter().chain(error).all(|v| v.is_finite() && *v > 0.0);
    if h.len() < 3 || h.len() != error.len() || !refines || !positive {
        return None;
    }
    let n = h.len() as f64;
    let x: Vec<f64> = h.iter().map(|h| h.ln()).collect();
    let y: Vec<f64> = error.iter().map(|e| e.ln()).collect();
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxy: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let sxx: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
    let order = sxy / sxx;
    Some(OrderFit { order, constant: (my - order * mx).exp() })
}

/// What three levels of one quantity say about its discretisation error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GridConvergence {
    /// Differences of one sign that shrink.
    Monotone {
        /// Observed order p.
        order: f64,
        /// Richardson extrapolation, in the unit of the quantity.
        extrapolated: f64,
        /// Relative index of the fine and middle level.
        fine: f64,
        /// Relative index of the middle and coarse level.
        coarse: f64,
    },
    /// Differences of alternating sign: three times the range, in the unit of the quantity.
    Oscillatory {
        /// The estimate of the uncertainty.
        uncertainty: f64,
    },
    /// Differences that do not shrink: no estimate.
    Divergent,
}

/// Grid convergence index (Roache 1994) of values `f` from fine to coarse with constant refinement
/// `ratio`: `p = ln((f₃−f₂)/(f₂−f₁))/ln r`, `GCI = F_s |(f₂−f₁)/f₁| / (rᵖ − 1)`.
///
/// `F_s` is 1.25 where the observed order is near the formal one, `0.5 ≤ p ≤ p_formal + 0.1`, else 3.
pub fn grid_convergence([f1, f2, f3]: [f64; 3], ratio: f64, formal_order: f64) -> GridConvergence {
    let (d21, d32) = (f2 - f1, f3 - f2);
    let change = d32 / d21;
    if !change.is_finite() || (0.0..=1.0).contains(&change) {
        return GridConvergence::Divergent;
    }
    if change < 0.0 {
        let range = f1.max(f2).max(f3) - f1.min(f2).min(f3);
        return GridConvergence::Oscillatory { uncertainty: 3.0 * range };
    }
    let order = change.ln() / ratio.ln();
    let safety = if (0.5..=formal_order + 0.1).contains(&order) { 1.25 } else { 3.0 };
    let shrink = ratio.powf(order) - 1.0;
    GridConvergence::Monotone {
        order,
        extrapolated: f1 - d21 / shrink,
        fine: safety * (d21 / f1).abs() / shrink,
        coarse: safety * (d32 / f2).abs() / shrink,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_law_gives_its_exponent() {
        let h = [0.4, 0.2, 0.1, 0.05];
        let e = h.map(|h: f64| 3.0 * h.powf(1.7));
        let fit = fitted_order(&h, &e).unwrap();
        // Exact power law: only rounding is left.
        assert!((fit.order - 1.7).abs() < 1e-12 && (fit.constant - 3.0).abs() < 1e-11);
    }

    #[test]
    fn too_few_or_too_close_levels_give_no_order() {
        assert_eq!(fitted_order(&[0.2, 0.1], &[0.04, 0.01]), None);
        assert_eq!(fitted_order(&[0.2, 0.18, 0.1], &[0.04, 0.03, 0.01]), None);
        assert_eq!(fitted_order(&[0.4, 0.2, 0.1], &[0.04, 0.0, 0.01]), None);
        assert_eq!(fitted_order(&[0.4, 0.2, 0.1], &[0.04, f64::NAN, 0.01]), None);
    }

    #[test]
    fn published_grid_convergence_index() {
        // NPARC Alliance tutorial: p = 1.786170, f_ext = 0.971300, GCI 0.103083 % and 0.356249 %.
        let g = grid_convergence([0.97050, 0.96854, 0.96178], 2.0, 2.0);
        let GridConvergence::Monotone { order, extrapolated, fine, coarse } = g else { panic!("{g:?}") };
        assert!((order - 1.786_170).abs() < 1e-6, "{order}");
        assert!((extrapolated - 0.971_300_3).abs() < 1e-6, "{extrapolated}");
        assert!((fine - 0.001_030_83).abs() < 1e-7, "{fine}");
        assert!((coarse - 0.003_562_44).abs() < 1e-7, "{coarse}");
    }

    #[test]
    fn an_order_far_from_the_formal_one_is_distrusted() {
        let factor = |formal| match grid_convergence([0.97050, 0.96854, 0.96178], 2.0, formal) {
            GridConvergence::Monotone { fine, .. } => fine,
            other => panic!("{other:?}"),
        };
        assert!((factor(1.0) / factor(2.0) - 3.0 / 1.25).abs() < 1e-12);
    }

    #[test]
    fn oscillation_and_divergence_are_told_apart() {
        let swing = grid_convergence([1.0, 1.1, 0.8], 2.0, 2.0);
        let GridConvergence::Oscillatory { uncertainty } = swing else { panic!("{swing:?}") };
        assert!((uncertainty - 0.9).abs() < 1e-12);
        assert_eq!(grid_convergence([1.0, 1.2, 1.3], 2.0, 2.0), GridConvergence::Divergent);
        assert_eq!(grid_convergence([1.0, 1.0, 1.0], 2.0, 2.0), GridConvergence::Divergent);
    }
}
