//! Several codes on the same network and mesh: how fast, how much memory, how near to each other.

use schemars::JsonSchema;
use seam_references::{Dataset, Problem};
use serde::{Deserialize, Serialize};

/// Seam's lane with bonds for small rotations, and of elements.
pub const SEAM: &str = "seam";
/// Seam's lane with bonds for finite rotations.
pub const SEAM_FINITE: &str = "seam-finite";

/// What the machine's memory allows Seam's lane for small rotations.
pub const BANDWIDTH: &str = "bandwidth";
/// What its arithmetic allows that lane.
pub const ARITHMETIC: &str = "arithmetic";

/// A race.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Race {
    /// Whether it is the recorded one, run elsewhere, and not part of this run.
    pub recorded: bool,
    /// What was run.
    pub about: String,
    /// Versions of the codes.
    pub version: String,
    /// When.
    pub date: String,
    /// Class of machine.
    pub machine: String,
    /// The command that runs it again.
    pub command: String,
    /// Each code on each size and number of threads.
    pub lanes: Vec<Lane>,
}

/// One code, or one limit of the machine, on one size and number of threads.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Lane {
    /// `network` or `mesh`.
    pub what: String,
    /// Particles or nodes.
    pub size: f64,
    /// Threads or ranks.
    pub threads: f64,
    /// Who ran.
    pub code: String,
    /// Wall time, in s.
    pub seconds: f64,
    /// Bond updates, or unknowns, per second: median, slowest, fastest round.
    pub rate: [f64; 3],
    /// Wall time over Seam's.
    pub times_seam: f64,
    /// Wall time over that of Seam with finite rotations, on as many threads; `null` where that was not run.
    pub times_finite: Option<f64>,
    /// Largest memory, in MiB; `null` for a limit.
    pub memory_mib: Option<f64>,
    /// Largest difference of a displacement at the end from Seam's, with finite rotations for a network, relative to the
    /// largest; `null` for Seam's own and for a limit.
    pub difference: Option<f64>,
}

impl Lane {
    /// Whether it is Seam itself.
    pub fn is_seam(&self) -> bool {
        [SEAM, SEAM_FINITE].contains(&self.code.as_str())
    }

    /// Whether it is what the machine allows.
    pub fn is_limit(&self) -> bool {
        [BANDWIDTH, ARITHMETIC].contains(&self.code.as_str())
    }

    /// Name for people.
    pub fn title(&self) -> &str {
        match self.code.as_str() {
            SEAM if self.what == "network" => "Seam, small rotations",
            SEAM => "Seam",
            SEAM_FINITE => "Seam, finite rotations",
            BANDWIDTH => "Limit of memory",
            ARITHMETIC => "Limit of arithmetic",
            "yade" => "YADE",
            "lammps" => "LAMMPS",
            "calculix" => "CalculiX",
            other => other,
        }
    }
}

impl Race {
    /// What `race.csv` and `race.toml` hold.
    ///
    /// # Errors
    /// Columns that are missing or in other units.
    pub fn of(data: &Dataset, recorded: bool) -> Result<Race, Problem> {
        let (what, code) = (data.words("what")?, data.words("code")?);
        let [size, threads] = [data.column("size", "1")?, data.column("threads", "1")?];
        let seconds = data.column("seconds", "s")?;
        let rates =
            [data.column("rate", "Hz")?, data.column("rate_min", "Hz")?, data.column("rate_max", "Hz")?];
        let ratio = data.column("times_seam", "1")?;
        let (memory, difference) = (data.column("memory_mb", "1")?, data.column("difference", "1")?);
        let like = |a: usize, b: usize| what[a] == what[b] && size[a] == size[b] && threads[a] == threads[b];
        let finite = |row: usize| (0..data.rows()).find(|&k| code[k] == SEAM_FINITE && like(k, row));
        let is = |row: usize, codes: &[&str]| codes.contains(&code[row].as_str());
        let limit = |row: usize| is(row, &[BANDWIDTH, ARITHMETIC]);
        let target = |row: usize| is(row, &[if what[row] == "mesh" { SEAM } else { SEAM_FINITE }]);
        let lane = |k: usize| Lane {
            what: what[k].clone(),
            size: size[k],
            threads: threads[k],
            code: code[k].clone(),
            seconds: seconds[k],
            rate: rates.map(|rate| rate[k]),
            times_seam: ratio[k],
            times_finite: finite(k).filter(|_| !limit(k)).map(|f| seconds[k] / seconds[f]),
            memory_mib: (!limit(k)).then_some(memory[k]),
            difference: (!limit(k) && !target(k)).then_some(difference[k]),
        };
        let p = &data.provenance;
        Ok(Race {
            recorded,
            about: p.about.clone(),
            version: p.version.clone(),
            date: p.date.to_string(),
            machine: p.machine.clone(),
            command: p.command.clone(),
            lanes: (0..data.rows()).map(lane).collect(),
        })
    }

    /// Lanes of the networks, or of the meshes.
    pub fn of_kind<'a>(&'a self, what: &'a str) -> impl Iterator<Item = &'a Lane> + Clone {
        self.lanes.iter().filter(move |lane| lane.what == what)
    }
}

/// A rate in millions per second, or in thousands for unknowns.
pub fn scaled(what: &str, rate: f64) -> f64 {
    rate / if what == "mesh" { 1e3 } else { 1e6 }
}

/// Unit of such a rate.
pub fn unit(what: &str) -> &'static str {
    if what == "mesh" { "thousand unknowns/s" } else { "million bond updates/s" }
}
