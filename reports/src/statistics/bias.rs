//! Bias and scatter of a model against references, over many quantities at once.

/// Bias and scatter of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bias {
    /// Number of pairs.
    pub count: usize,
    /// Bias factor δ: the model's value is on average δ times the true one.
    pub delta: f64,
    /// Relative standard deviation σ̃_M of the model.
    pub sigma: f64,
}

/// A model's value, its reference, and the standard uncertainty of the reference, in one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// The model's value M.
    pub model: f64,
    /// The reference E.
    pub reference: f64,
    /// Standard uncertainty of the reference.
    pub uncertainty: f64,
}

/// Bias in the form of McGrattan & Toman (2011), used by the FDS Validation Guide: with
/// `σ̃_M² + σ̃_E² = var ln(M/E)`, `δ = exp(mean ln(M/E) + (σ̃_M² − σ̃_E²)/2)`.
///
/// Pairs of different sign, or zero, have no ratio and are left out; `None` if fewer than two are left.
pub fn bias(pairs: &[Pair]) -> Option<Bias> {
    let usable: Vec<&Pair> = pairs
        .iter()
        .filter(|p| {
            let ratio = p.model / p.reference;
            ratio.is_finite() && ratio > 0.0
        })
        .collect();
    if usable.len() < 2 {
        return None;
    }
    let n = usable.len() as f64;
    let logs: Vec<f64> = usable.iter().map(|p| (p.model / p.reference).ln()).collect();
    let mean = logs.iter().sum::<f64>() / n;
    let variance = logs.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let of_reference = usable.iter().map(|p| (p.uncertainty / p.reference).powi(2)).sum::<f64>() / n;
    // The model cannot scatter less than not at all, even if the references are very uncertain.
    let of_model = (variance - of_reference).max(0.0);
    Some(Bias {
        count: usable.len(),
        delta: (mean + 0.5 * (of_model - of_reference)).exp(),
        sigma: of_model.sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(model: f64, reference: f64) -> Pair {
        Pair { model, reference, uncertainty: 0.0 }
    }

    #[test]
    fn a_constant_factor_is_all_bias() {
        let b = bias(&[pair(1.05, 1.0), pair(-2.1, -2.0), pair(105e6, 1e8)]).unwrap();
        assert!((b.delta - 1.05).abs() < 1e-12 && b.sigma < 1e-12);
    }

    #[test]
    fn symmetric_scatter_is_all_sigma() {
        // ln(M/E) = ±0.1: variance 0.02, mean zero.
        let b = bias(&[pair(0.1f64.exp(), 1.0), pair((-0.1f64).exp(), 1.0)]).unwrap();
        assert!((b.sigma - 0.02f64.sqrt()).abs() < 1e-12);
        assert!((b.delta - 0.01f64.exp()).abs() < 1e-12);
    }

    #[test]
    fn uncertain_references_take_their_share_of_the_scatter() {
        let of = |u| {
            bias(&[(0.1f64).exp(), (-0.1f64).exp()].map(|m| Pair {
                model: m,
                reference: 1.0,
                uncertainty: u,
            }))
        };
        assert!((of(0.1).unwrap().sigma - 0.1).abs() < 1e-12);
        assert!((of(0.1).unwrap().delta - 1.0).abs() < 1e-12, "equal shares shift nothing");
        assert_eq!(of(0.5).unwrap().sigma, 0.0);
    }

    #[test]
    fn pairs_without_a_ratio_are_left_out() {
        assert_eq!(bias(&[pair(1.0, 0.0), pair(1.0, -1.0), pair(1.0, 1.0)]), None);
    }
}
