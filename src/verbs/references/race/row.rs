//! Medians over the rounds of a race.

use super::finish::Finish;

/// One code on one number of threads.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// `network` or `mesh`.
    pub what: &'static str,
    /// Particles or nodes.
    pub size: usize,
    /// Threads or ranks.
    pub threads: usize,
    /// Who ran.
    pub code: &'static str,
    /// Median, in s.
    pub seconds: f64,
    /// Bond updates, or unknowns, per second: median, smallest, largest.
    pub rate: [f64; 3],
    /// Seconds over Seam's, median of the rounds' pairs.
    pub times_seam: f64,
    /// Median, in MB.
    pub memory_mb: f64,
    /// Largest difference of a displacement at the end from Seam's, relative to the largest.
    pub difference: f64,
}

impl Row {
    /// Medians over the rounds; `amount` is what one run does, `seam` are Seam's rounds.
    pub fn new(
        what: &'static str,
        size: usize,
        amount: u64,
        threads: usize,
        code: &'static str,
        finishes: &[Finish],
        seam: &[Finish],
    ) -> Self {
        let of = |f: fn(&Finish) -> f64| finishes.iter().map(f).collect::<Vec<_>>();
        let times = of(|f| f.seconds);
        let seconds = median(&times);
        let pairs: Vec<f64> = finishes.iter().zip(seam).map(|(f, own)| f.seconds / own.seconds).collect();
        let fastest = times.iter().copied().fold(f64::INFINITY, f64::min);
        let slowest = times.iter().copied().fold(0.0, f64::max);
        Row {
            what,
            size,
            threads,
            code,
            seconds,
            rate: [seconds, slowest, fastest].map(|t| amount as f64 / t),
            times_seam: median(&pairs),
            memory_mb: median(&of(|f| f.memory_mb)),
            difference: finishes[0].difference(&seam[0]),
        }
    }

    /// Range of the rates over their median.
    pub fn spread(&self) -> f64 {
        (self.rate[2] - self.rate[1]) / self.rate[0]
    }
}

/// The middle one, or the mean of the two in the middle.
fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finish(seconds: f64, u: f64) -> Finish {
        let displacement = vec![[2.0, 0.0, 0.0], [u, 0.0, 0.0]];
        Finish { seconds, memory_mb: 10.0, version: "1".to_owned(), displacement }
    }

    #[test]
    fn a_row_holds_medians_and_the_ratio_of_pairs() {
        let own = [finish(1.0, 1.0), finish(2.0, 1.0), finish(4.0, 1.0)];
        let theirs = [finish(3.0, 1.1), finish(4.0, 1.1), finish(20.0, 1.1)];
        let row = Row::new("network", 2, 80, 1, "yade", &theirs, &own);
        assert_eq!((row.seconds, row.times_seam), (4.0, 3.0));
        assert_eq!(row.rate, [20.0, 4.0, 80.0 / 3.0]);
        assert!((row.difference - 0.05).abs() < 1e-15);
        assert_eq!(median(&[3.0, 1.0]), 2.0);
        assert!(finish(1.0, f64::NAN).difference(&own[0]).is_nan());
    }
}
