//! What a lane leaves behind: `time.toml` and `final.csv`.

use anyhow::{Context, Result, bail};
use std::path::Path;

/// One run of one code.
#[derive(Debug, Clone)]
pub struct Finish {
    /// Wall time, in s.
    pub seconds: f64,
    /// Largest memory, in MB.
    pub memory_mb: f64,
    /// Version of the code.
    pub version: String,
    /// Where everything ended, in m.
    pub displacement: Vec<[f64; 3]>,
}

impl Finish {
    /// Reads both files; `points` particles or nodes ran.
    pub fn read(folder: &Path, points: usize) -> Result<Self> {
        let load = |name: &str| {
            let path = folder.join(name);
            std::fs::read_to_string(&path).with_context(|| path.display().to_string())
        };
        let time = load("time.toml")?;
        let text = |key: &str| {
            let value = time.lines().find_map(|line| line.strip_prefix(key)?.trim().strip_prefix('='));
            value.map(|v| v.trim().to_owned()).with_context(|| format!("time.toml has no {key}"))
        };
        let number = |key: &str| {
            let value = text(key)?;
            value.parse::<f64>().with_context(|| format!("time.toml: {key} = {value} is no number"))
        };
        let vector = |line: &str| -> Option<[f64; 3]> {
            let numbers: Vec<f64> = line.split(',').map(|x| x.parse().ok()).collect::<Option<_>>()?;
            numbers.try_into().ok()
        };
        let rows = load("final.csv")?;
        let displacement = rows.lines().skip(1).map(vector).collect::<Option<Vec<_>>>();
        let displacement = displacement.context("final.csv is no table of displacements")?;
        if displacement.len() != points {
            bail!(
                "final.csv has {} rows for {points} points: the code ended while it wrote",
                displacement.len()
            );
        }
        Ok(Self {
            seconds: number("seconds")?,
            memory_mb: number("memory_mb")?,
            version: text("version")?,
            displacement,
        })
    }

    /// Largest distance from the end of another run, relative to its largest displacement; NaN if they do not have as many
    /// points.
    pub fn difference(&self, other: &Finish) -> f64 {
        if self.displacement.len() != other.displacement.len() {
            return f64::NAN;
        }
        let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let largest = other.displacement.iter().map(|v| size(*v)).fold(0.0, f64::max);
        let pairs = self.displacement.iter().zip(&other.displacement);
        let apart = |(a, b): (&[f64; 3], &[f64; 3])| size([a[0] - b[0], a[1] - b[1], a[2] - b[2]]);
        pairs.map(|pair| apart(pair) / largest).fold(0.0, nan_max)
    }
}

/// The larger one; NaN if either is, so that it cannot hide.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
