//! Equal steps from a time to the end of the run.

/// Times within this share of a step are one time.
const ROUNDING: f64 = 1e-9;

/// Steps of one length that end at the end of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clock {
    start: f64,
    end: f64,
    /// Number of steps.
    pub count: usize,
    /// Length of each, in s.
    pub step: f64,
}

impl Clock {
    /// The least number of steps no longer than `longest` (s), to rounding.
    pub fn within(start: f64, end: f64, longest: f64) -> Self {
        Clock::of(start, end, ((end - start) / longest - ROUNDING).ceil())
    }

    /// As [`Clock::within`], where a step a rounding longer would be refused.
    pub fn strictly_within(start: f64, end: f64, longest: f64) -> Self {
        Clock::of(start, end, ((end - start) / longest).ceil())
    }

    fn of(start: f64, end: f64, count: f64) -> Self {
        let count = count.max(1.0);
        Clock { start, end, count: count as usize, step: (end - start) / count }
    }

    /// Time after `k` steps, in s.
    pub fn time(&self, k: usize) -> f64 {
        if k == self.count { self.end } else { self.start + k as f64 * self.step }
    }

    /// How close two times count as one, in s.
    pub fn slack(&self) -> f64 {
        ROUNDING * self.step
    }

    /// The first step boundary at or after a time (s).
    pub fn reaching(&self, time: f64) -> usize {
        self.clamp(((time - self.start) / self.step - ROUNDING).ceil())
    }

    /// The step boundary nearest to a time (s), the earlier of two.
    pub fn nearest(&self, time: f64) -> usize {
        self.clamp(((time - self.start) / self.step - 0.5 - ROUNDING).ceil())
    }

    fn clamp(&self, k: f64) -> usize {
        // Infinity is after the end, and a time before the start is at it.
        if k >= self.count as f64 { self.count } else { k.max(0.0) as usize }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_at_the_end() {
        let clock = Clock::within(0.0, 1.0, 0.3);
        assert_eq!((clock.count, clock.step, clock.time(4)), (4, 0.25, 1.0));
        // 0.1 divides 0.3 to rounding, and 0.7 − 0.4 too.
        assert_eq!(Clock::within(0.0, 0.3, 0.1).count, 3);
        assert_eq!(Clock::within(0.4, 0.7, 0.1).count, 3);
        assert_eq!(Clock::within(0.0, 1.0, 7.0).count, 1);
        assert_eq!(Clock::strictly_within(0.0, 1.0, 0.25).count, 4);
    }

    #[test]
    fn times_find_their_boundary() {
        let clock = Clock::within(1.0, 2.0, 0.25);
        assert_eq!([1.0, 1.2, 1.25 + 1e-12, 1.3, 9.0].map(|t| clock.reaching(t)), [0, 1, 1, 2, 4]);
        assert_eq!([0.0, 1.1, 1.125, 1.13, 2.0].map(|t| clock.nearest(t)), [0, 0, 0, 1, 4]);
        assert_eq!(clock.reaching(f64::INFINITY), 4);
    }
}
