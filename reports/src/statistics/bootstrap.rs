//! The bootstrap (Efron 1979): what a statistic would be in other samples, by drawing from the one there is.
//!
//! For quantities whose distribution nobody knows, such as ratios of wall times, where an interval of Student's
//! form would be one for a symmetric scatter that is not there.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Resamples that make the ends of an interval steady to about a hundredth of the standard error.
pub const RESAMPLES: usize = 10_000;

/// Seed of the draws: the same sample gives the same interval.
const SEED: u64 = 1979;

/// Median of some values; `None` if there are none. They are sorted on the way.
pub fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    let upper = *values.get(n / 2)?;
    Some(if n.is_multiple_of(2) { 0.5 * (values[n / 2 - 1] + upper) } else { upper })
}

/// The statistic in each of `resamples` samples of the same size, drawn with replacement; ascending.
pub fn resampled(
    values: &[f64],
    statistic: impl Fn(&mut [f64]) -> Option<f64>,
    resamples: usize,
) -> Vec<f64> {
    let n = values.len();
    if n == 0 {
        return Vec::new();
    }
    let mut draws = ChaCha8Rng::seed_from_u64(SEED);
    let mut sample = vec![0.0; n];
    let one = |_| {
        sample.iter_mut().for_each(|place| *place = values[draws.random_range(0..n)]);
        statistic(&mut sample)
    };
    let mut all: Vec<f64> = (0..resamples).filter_map(one).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Two-sided interval of probability `p` for the median by the percentile method (Efron & Tibshirani 1993, §13.3);
/// `None` below five values, of which no resample says anything new.
pub fn median_interval(values: &[f64], p: f64) -> Option<[f64; 2]> {
    if values.len() < 5 || values.iter().any(|v| !v.is_finite()) {
        return None;
    }
    let all = resampled(values, median, RESAMPLES);
    let at = |q: f64| all[((q * (all.len() - 1) as f64).round() as usize).min(all.len() - 1)];
    Some([at(0.5 * (1.0 - p)), at(0.5 * (1.0 + p))])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Survival of seven treated mice, in days: Efron & Tibshirani 1993, table 2.1.
    const MICE: [f64; 7] = [94.0, 197.0, 16.0, 38.0, 99.0, 141.0, 23.0];

    fn standard_error(all: &[f64]) -> f64 {
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        (all.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (all.len() - 1) as f64).sqrt()
    }

    #[test]
    fn published_standard_errors() {
        // Efron & Tibshirani 1993, table 2.2, infinitely many resamples: mean 23.36, median 37.83. The scatter of a
        // standard error over B resamples is about 1/√(2B) = 0.7 % of it; three times that is allowed.
        let mean = |sample: &mut [f64]| Some(sample.iter().sum::<f64>() / sample.len() as f64);
        for (found, published) in [
            (standard_error(&resampled(&MICE, mean, RESAMPLES)), 23.36),
            (standard_error(&resampled(&MICE, median, RESAMPLES)), 37.83),
        ] {
            assert!((found / published - 1.0).abs() < 0.021, "{found} is not {published}");
        }
    }

    #[test]
    fn the_interval_is_made_of_the_values_and_repeats() {
        let interval = median_interval(&MICE, 0.95).unwrap();
        assert_eq!(Some(interval), median_interval(&MICE, 0.95));
        // P(median of a resample = smallest value) = P(Binomial(7, 1/7) ≥ 4) = 0.010 and P(≤ second smallest) = 0.108
        // (Efron 1982, eq. 10.2): the 2.5 % point is the second smallest value, and the 97.5 % point likewise.
        assert_eq!(interval, [23.0, 141.0]);
        assert_eq!(median_interval(&[1.0; 7], 0.95), Some([1.0, 1.0]));
        assert_eq!(median_interval(&MICE[..4], 0.95), None);
    }

    #[test]
    fn a_median_of_few() {
        assert_eq!(median(&mut []), None);
        assert_eq!(median(&mut [3.0, 1.0]), Some(2.0));
        assert_eq!(median(&mut [3.0, 1.0, 9.0]), Some(3.0));
    }
}
