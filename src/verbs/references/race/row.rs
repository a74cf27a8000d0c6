//! Medians over the rounds of a race.

use super::finish::Finish;

/// Who ran on what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lane {
    /// `network` or `mesh`.
    pub what: &'static str,
    /// Particles or nodes.
    pub size: usize,
    /// Threads or ranks.
    pub threads: usize,
    /// Who ran.
    pub code: &'static str,
    /// Bond updates, or unknowns, of one run.
    pub amount: u64,
}

/// One code, or one limit of the machine, on one number of threads.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Who, on what.
    pub lane: Lane,
    /// Median, in s.
    pub seconds: f64,
    /// Bond updates, or unknowns, per second: median, smallest, largest.
    pub rate: [f64; 3],
    /// Seconds over Seam's, median of the rounds' pairs.
    pub times_seam: f64,
    /// Median, in MB; zero for a limit.
    pub memory_mb: f64,
    /// Largest difference of a displacement at the end from where all should end, relative to the largest; zero for a limit.
    pub difference: f64,
}

impl Row {
    /// Medians over the rounds of a code; `seam` are the seconds of Seam's rounds, `target` is where all should end.
    pub fn of_code(lane: Lane, finishes: &[Finish], seam: &[f64], target: &Finish) -> Self {
        let of = |f: fn(&Finish) -> f64| finishes.iter().map(f).collect::<Vec<_>>();
        Row {
            memory_mb: median(&of(|f| f.memory_mb)),
            difference: finishes[0].difference(target),
            ..Row::of_limit(lane, &of(|f| f.seconds), seam)
        }
    }

    /// The same for a limit: the seconds that the run would take if nothing else counted.
    pub fn of_limit(lane: Lane, times: &[f64], seam: &[f64]) -> Self {
        let seconds = median(times);
        let pairs: Vec<f64> = times.iter().zip(seam).map(|(t, own)| t / own).collect();
        let fastest = times.iter().copied().fold(f64::INFINITY, f64::min);
        let slowest = times.iter().copied().fold(0.0, f64::max);
        Row {
            lane,
            seconds,
            rate: [seconds, slowest, fastest].map(|t| lane.amount as f64 / t),
            times_seam: median(&pairs),
            memory_mb: 0.0,
            difference: 0.0,
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
        let lane = Lane { what: "network", size: 2, threads: 1, code: "yade", amount: 80 };
        let (own, target) = ([1.0, 2.0, 4.0], finish(9.0, 1.0));
        let theirs = [finish(3.0, 1.1), finish(4.0, 1.1), finish(20.0, 1.1)];
        let row = Row::of_code(lane, &theirs, &own, &target);
        assert_eq!((row.seconds, row.times_seam, row.memory_mb), (4.0, 3.0, 10.0));
        assert_eq!(row.rate, [20.0, 4.0, 80.0 / 3.0]);
        assert!((row.difference - 0.05).abs() < 1e-15);
        let limit = Row::of_limit(lane, &[0.5, 0.5, 1.0], &own);
        assert_eq!((limit.times_seam, limit.rate[0], limit.memory_mb), (0.25, 160.0, 0.0));
        assert_eq!(median(&[3.0, 1.0]), 2.0);
        assert!(finish(1.0, f64::NAN).difference(&target).is_nan());
    }
}
