//! The words of what guards the gate itself: bless, gate, selftest.

use super::{Filter, ReferencesFolder, Tier};
use clap::Args;
use std::path::PathBuf;

/// Option of everything that compares with records.
#[derive(Debug, Args)]
pub struct Records {
    /// Compare with the verdicts, values and work of this file instead of the built-in ones
    #[arg(long, value_name = "FILE")]
    pub recorded: Option<PathBuf>,
}

/// `seam bless`
#[derive(Debug, Args)]
pub struct Bless {
    /// Ids of results; every result that is there if none is given
    #[arg(value_name = "ID")]
    pub cases: Vec<String>,
    /// Folder with the results of a run
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub from: PathBuf,
    /// File with the records
    #[arg(long, value_name = "FILE", default_value = "reports/recorded.toml")]
    pub recorded: PathBuf,
    /// Write the records; without it the difference is shown and nothing is written
    #[arg(long)]
    pub accept: bool,
    /// What is judged beside
    #[command(flatten)]
    pub references: ReferencesFolder,
}

/// `seam gate`
#[derive(Debug, Args)]
pub struct Against {
    /// Ids; every case of the tier if none is given
    #[arg(value_name = "ID")]
    pub cases: Vec<String>,
    /// Commit, tag or branch to compare with: it is built in a folder of its own
    #[arg(long, value_name = "REF", required_unless_present = "binary")]
    pub against: Option<String>,
    /// Compare with this `seam` instead of building one
    #[arg(long, value_name = "FILE", conflicts_with = "against")]
    pub binary: Option<PathBuf>,
    /// Which cases
    #[command(flatten)]
    pub filter: Filter,
    /// How much is run
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
    /// Runs of each, in turns; five at least, since fewer have no interval
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(5..))]
    pub rounds: u32,
    /// Largest ratio of wall times that passes
    #[arg(long, value_name = "RATIO", default_value_t = 1.2)]
    pub slower: f64,
}

/// `seam selftest`
#[derive(Debug, Args)]
pub struct Selftest {
    /// Names of defects; all if none is given
    #[arg(value_name = "DEFECT")]
    pub defects: Vec<String>,
    /// List the defects and seed none
    #[arg(long)]
    pub list: bool,
}
