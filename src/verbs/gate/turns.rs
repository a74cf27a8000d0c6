//! Runs that take turns, and what their ratios say.

use crate::args::Tier;
use anyhow::{Context, Result};
use clap::ValueEnum;
use seam_reports::exit::Exit;
use seam_reports::format::significant;
use seam_reports::statistics::bootstrap::{median, median_interval};
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// This program and the other one, each with a folder for its results.
pub struct Turns<'a> {
    pub programs: [&'a Path; 2],
    pub outs: &'a [PathBuf; 2],
    pub tier: Tier,
}

impl Turns<'_> {
    /// Ratios of wall times, ours over the other's, of so many rounds after one that warms up; `None` if the other
    /// does not run the case. Who goes first changes from round to round.
    ///
    /// # Errors
    /// We do not run it, or a program cannot be started.
    pub fn take(&self, id: &str, rounds: usize) -> Result<Option<Vec<f64>>> {
        if self.run(1, id)?.is_none() {
            return Ok(None);
        }
        self.own(id)?;
        let mut ratios = Vec::with_capacity(rounds);
        for round in 0..rounds {
            let (ours, theirs);
            if round % 2 == 0 {
                (ours, theirs) = (self.own(id)?, self.run(1, id)?);
            } else {
                theirs = self.run(1, id)?;
                ours = self.own(id)?;
            }
            ratios.extend(theirs.map(|theirs| ours / theirs));
        }
        Ok(Some(ratios))
    }

    fn own(&self, id: &str) -> Result<f64> {
        self.run(0, id)?.with_context(|| format!("{id} does not run; see: seam run {id}"))
    }

    /// Wall time in s; `None` if the run fails.
    fn run(&self, who: usize, id: &str) -> Result<Option<f64>> {
        let tier = self.tier.to_possible_value();
        let tier = tier.as_ref().map_or("quick", |tier| tier.get_name());
        let mut command = Command::new(self.programs[who]);
        command.args(["run", id, "--quiet", "--tier", tier, "--out"]).arg(&self.outs[who]);
        let start = Instant::now();
        let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
        let status = status.with_context(|| self.programs[who].display().to_string())?;
        Ok(status.success().then(|| start.elapsed().as_secs_f64()))
    }
}

/// How fast we are beside the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    median: f64,
    /// 95 % interval of the median, where there are enough rounds.
    interval: Option<[f64; 2]>,
    limit: f64,
}

impl Pace {
    /// From the ratios of some rounds, and the largest that passes.
    pub fn of(ratios: &[f64], limit: f64) -> Self {
        let median = median(&mut ratios.to_vec()).unwrap_or(f64::NAN);
        Pace { median, interval: median_interval(ratios, 0.95), limit }
    }

    /// Slower only where the whole interval says so: a noisy machine is no regression.
    pub fn exit(&self) -> Exit {
        match self.interval {
            Some([low, _]) if low > self.limit => Exit::Cost,
            Some(_) => Exit::Pass,
            None => Exit::Unmeasured,
        }
    }
}

impl fmt::Display for Pace {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some([low, high]) = self.interval else {
            return write!(f, "too few runs to say; take five or more");
        };
        let [median, low, high, limit] = [self.median, low, high, self.limit].map(|v| significant(v, 3));
        write!(f, "{median} ({low} … {high})")?;
        match self.interval {
            Some(_) if self.exit() == Exit::Cost => write!(f, "  SLOWER than {limit}"),
            Some([_, high]) if high > self.limit => write!(f, "  undetermined at {limit}; take more rounds"),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slower_is_what_the_whole_interval_says() {
        let say = |ratios: &[f64]| Pace::of(ratios, 1.2).to_string();
        assert_eq!(say(&[1.0, 1.01, 0.99, 1.02, 0.98]), "1 (0.98 … 1.02)");
        assert!(say(&[1.5, 1.6, 1.4, 1.5, 1.7]).ends_with("SLOWER than 1.2"));
        assert!(say(&[1.0, 1.9, 1.1, 1.0, 1.1]).contains("undetermined"));
        assert!(say(&[1.5]).contains("too few"));
    }

    #[test]
    fn doubt_is_no_regression_and_silence_no_pass() {
        assert_eq!(Pace::of(&[1.5, 1.6, 1.4, 1.5, 1.7], 1.2).exit(), Exit::Cost);
        assert_eq!(Pace::of(&[1.0, 1.9, 1.1, 1.0, 1.1], 1.2).exit(), Exit::Pass);
        assert_eq!(Pace::of(&[], 1.2).exit(), Exit::Unmeasured);
    }
}
