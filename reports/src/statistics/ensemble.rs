//! Mean and scatter of an ensemble, and intervals for its mean and for the next single member.

use super::student::quantile;

/// Size, mean and standard deviation of an ensemble.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ensemble {
    /// Number of members N.
    pub count: usize,
    /// Arithmetic mean.
    pub mean: f64,
    /// Sample standard deviation s (with N − 1); zero for a single member.
    pub deviation: f64,
}

impl Ensemble {
    /// Statistics of some values; `None` if there are none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let n = values.len();
        if n == 0 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / n as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let deviation = if n > 1 { (squares / (n - 1) as f64).sqrt() } else { 0.0 };
        Some(Ensemble { count: n, mean, deviation })
    }

    /// Half width `t·s/√N` of the one-sided interval of probability `p` for the mean; infinite
    /// for a single member, of which no scatter is known.
    pub fn mean_half_width(&self, p: f64) -> f64 {
        self.scaled(p, 1.0 / self.count as f64)
    }

    /// Half width `t·s·√(1 + 1/N)` of the one-sided interval of probability `p` for the next
    /// single member; infinite for a single member.
    pub fn next_half_width(&self, p: f64) -> f64 {
        self.scaled(p, 1.0 + 1.0 / self.count as f64)
    }

    /// `t·s·√variance`, infinite where s is unknown.
    fn scaled(&self, p: f64, variance: f64) -> f64 {
        match u32::try_from(self.count) {
            Ok(n) if n > 1 => quantile(p, n - 1) * self.deviation * variance.sqrt(),
            _ => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_of_five_values() {
        let e = Ensemble::of(&[2.0, 4.0, 4.0, 4.0, 6.0]).unwrap();
        assert_eq!((e.count, e.mean), (5, 4.0));
        assert!((e.deviation - 2f64.sqrt()).abs() < 1e-14);
        // t(0.95, 4) = 2.132 (Abramowitz & Stegun, table 26.10, three decimals).
        assert!((e.mean_half_width(0.95) - 2.132 * (2.0f64 / 5.0).sqrt()).abs() < 1e-3);
        assert!((e.next_half_width(0.95) - 2.132 * (2.0f64 * 1.2).sqrt()).abs() < 1e-3);
    }

    #[test]
    fn one_value_says_nothing_about_scatter() {
        let e = Ensemble::of(&[1.0]).unwrap();
        assert_eq!(e.next_half_width(0.95), f64::INFINITY);
        assert_eq!(Ensemble::of(&[]), None);
    }
}
