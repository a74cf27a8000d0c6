//! Medians of a race, as text, CSV and TOML.

use crate::args::Race;
use anyhow::{Context, Result};
use std::fmt::Write;
use std::path::Path;

/// What a lane left behind.
#[derive(Debug, Clone)]
pub struct Finish {
    seconds: f64,
    memory_mb: f64,
    displacement: Vec<[f64; 3]>,
}

impl Finish {
    /// Reads `time.toml` and `final.csv`.
    pub fn read(folder: &Path) -> Result<Self> {
        let load = |name: &str| {
            let path = folder.join(name);
            std::fs::read_to_string(&path).with_context(|| path.display().to_string())
        };
        let time = load("time.toml")?;
        let number = |key: &str| {
            let value = time.lines().find_map(|line| line.strip_prefix(key)?.trim().strip_prefix('='));
            value
                .and_then(|v| v.trim().parse::<f64>().ok())
                .with_context(|| format!("time.toml has no {key}"))
        };
        let vector = |line: &str| -> Option<[f64; 3]> {
            let numbers: Vec<f64> = line.split(',').map(|x| x.parse().ok()).collect::<Option<_>>()?;
            numbers.try_into().ok()
        };
        let rows = load("final.csv")?;
        let displacement = rows.lines().skip(1).map(vector).collect::<Option<_>>();
        Ok(Self {
            seconds: number("seconds")?,
            memory_mb: number("memory_mb")?,
            displacement: displacement.context("final.csv is no table of displacements")?,
        })
    }
}

/// One code on one number of threads.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    what: &'static str,
    size: usize,
    threads: usize,
    code: &'static str,
    seconds: f64,
    /// Slowest over fastest round.
    spread: f64,
    /// Million bond updates, or thousand unknowns, per second.
    rate: f64,
    /// Seconds over Seam's, of each round's pair.
    ratio: f64,
    memory_mb: f64,
    /// Largest difference of a displacement from Seam's, relative to the largest.
    difference: f64,
}

impl Row {
    /// Medians over the rounds; `amount` is what one run does, `own` are Seam's rounds.
    pub fn new(
        what: &'static str,
        size: usize,
        amount: u64,
        threads: usize,
        code: &'static str,
        finishes: &[Finish],
        own: &[Finish],
    ) -> Self {
        let of = |f: fn(&Finish) -> f64| finishes.iter().map(f).collect::<Vec<_>>();
        let times = of(|f| f.seconds);
        let seconds = median(&times);
        let pairs: Vec<f64> = finishes.iter().zip(own).map(|(f, own)| f.seconds / own.seconds).collect();
        let fastest = times.iter().copied().fold(f64::INFINITY, f64::min);
        let scale = if what == "mesh" { 1e3 } else { 1e6 };
        Row {
            what,
            size,
            threads,
            code,
            seconds,
            spread: times.iter().copied().fold(0.0, f64::max) / fastest,
            rate: amount as f64 / seconds / scale,
            ratio: median(&pairs),
            memory_mb: median(&of(|f| f.memory_mb)),
            difference: difference(&finishes[0], &own[0]),
        }
    }
}

/// The middle one, or the mean of the two in the middle.
fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}

/// NaN if they do not have as many points.
fn difference(a: &Finish, b: &Finish) -> f64 {
    if a.displacement.len() != b.displacement.len() {
        return f64::NAN;
    }
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = b.displacement.iter().map(|v| size(*v)).fold(0.0, f64::max);
    let pairs = a.displacement.iter().zip(&b.displacement);
    pairs.map(|(a, b)| size([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / largest).fold(0.0, f64::max)
}

/// The table for a person.
pub fn text(rows: &[Row]) -> String {
    let mut text = String::new();
    for (what, unit) in [("network", "Mbond/s"), ("mesh", "kdof/s")] {
        let rows: Vec<&Row> = rows.iter().filter(|row| row.what == what).collect();
        if rows.is_empty() {
            continue;
        }
        let size = if what == "mesh" { "nodes" } else { "particles" };
        let _ = writeln!(
            text,
            "{size:>9} threads code      seconds  spread  {unit:>8}  x Seam     MB  difference"
        );
        for r in rows {
            let _ = writeln!(
                text,
                "{:>9} {:>7} {:<8} {:>8.3} {:>7.2}  {:>8.2} {:>7.2} {:>6.0}  {:>10.1e}",
                r.size, r.threads, r.code, r.seconds, r.spread, r.rate, r.ratio, r.memory_mb, r.difference
            );
        }
    }
    text
}

/// `race.csv` with the medians, `race.toml` with how they came about.
pub fn write(rows: &[Row], words: &Race, out: &Path) -> Result<()> {
    let mut csv =
        String::from("what,size,threads,code,seconds,spread,rate,times_seam,memory_mb,difference\n");
    for r in rows {
        let _ = writeln!(
            csv,
            "{},{},{},{},{:?},{:?},{:?},{:?},{:?},{:?}",
            r.what,
            r.size,
            r.threads,
            r.code,
            r.seconds,
            r.spread,
            r.rate,
            r.ratio,
            r.memory_mb,
            r.difference
        );
    }
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let toml = format!(
        "about = \"medians of {} rounds, the codes in turn; the network vibrates freely for {} steps, the mesh is solved at rest\"\n\
         version = \"{}\"\nmachine = \"{} {}, {cores} cores\"\n\n[columns]\n\
         size = \"particles of the network, nodes of the mesh\"\nspread = \"slowest over fastest round\"\n\
         rate = \"million bond updates per second; thousand unknowns per second\"\n\
         times_seam = \"median of the rounds' seconds over Seam's\"\n\
         difference = \"largest difference of a displacement from Seam's, relative to the largest\"\n",
        words.rounds,
        words.steps,
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        std::env::consts::OS,
    );
    std::fs::create_dir_all(out).with_context(|| out.display().to_string())?;
    for (name, text) in [("race.csv", csv), ("race.toml", toml)] {
        let path = out.join(name);
        std::fs::write(&path, text).with_context(|| path.display().to_string())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finish(seconds: f64, u: f64) -> Finish {
        Finish { seconds, memory_mb: 10.0, displacement: vec![[2.0, 0.0, 0.0], [u, 0.0, 0.0]] }
    }

    #[test]
    fn a_row_holds_medians_and_the_ratio_of_pairs() {
        let own = [finish(1.0, 1.0), finish(2.0, 1.0), finish(4.0, 1.0)];
        let theirs = [finish(3.0, 1.1), finish(4.0, 1.1), finish(20.0, 1.1)];
        let row = Row::new("network", 2, 8_000_000, 1, "yade", &theirs, &own);
        assert_eq!((row.seconds, row.rate, row.ratio), (4.0, 2.0, 3.0));
        assert!((row.difference - 0.05).abs() < 1e-15);
        assert!(text(&[row]).contains("yade"));
        assert_eq!(median(&[3.0, 1.0]), 2.0);
    }
}
