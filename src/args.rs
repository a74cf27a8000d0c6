//! The words of the command line.

mod gate;
mod select;
mod user;

pub use gate::{Against, Bless, Records, Selftest};
pub use select::{Choice, Filter};
pub use user::{Completions, New, Schema, Text};

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Verification and validation benchmarks for coupled finite-element and discrete-element solvers.
///
/// Without a verb: run the quick catalogue, check it, write the report and print the table.
#[derive(Debug, Parser)]
#[command(name = "seam", version, after_help = EXIT_CODES, args_conflicts_with_subcommands = true)]
pub struct Command {
    /// What to do; `validate` if left out.
    #[command(subcommand)]
    pub verb: Option<Verb>,
    /// Options of `validate`.
    #[command(flatten)]
    pub validate: Validate,
}

const EXIT_CODES: &str = "Exit codes:
  0  everything passed
  1  accuracy, an own claim, a recorded verdict, stability or trust failed
  2  usage or bad input
  3  cost regression
  4  could not measure (no cases, NaN, a missing or altered reference)
  5  an own claim is undetermined (with --strict)";

/// One verb each.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Run the quick tier, check it, write the report, print the table
    Validate(Validate),
    /// List the cases
    List(List),
    /// Show a case: its page, parameters, claims and scene file
    Show(Show),
    /// Run cases of the catalogue or scene files
    Run(Run),
    /// Study cases beyond their run: what accuracy costs, which effects they call for
    #[command(subcommand)]
    Study(Study),
    /// Judge the results of a run: table, results.json, junit.xml, summary.md, exit code
    Check(Check),
    /// Show what accepting a run changes in the recorded verdicts, values and work; accept it
    Bless(Bless),
    /// Compare with another commit: results, counted work, and wall time in turns
    Gate(Against),
    /// Seed defects and see that each turns the gate red
    Selftest(Selftest),
    /// Write the report page from the results of a run
    Report(Report),
    /// Write the network or mesh of a case for another code
    Export(Export),
    /// Write a scene of your own to begin with
    New(New),
    /// Print a JSON schema, for editors and other programs
    Schema(Schema),
    /// Print the completions of a shell
    Completions(Completions),
    /// Outputs of other codes: what there is, whether it is whole, make it again, race the codes
    #[command(subcommand)]
    References(References),
}

/// `seam validate`
#[derive(Debug, Args)]
pub struct Validate {
    /// Folder for results and report
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// How the cases are run
    #[command(flatten)]
    pub running: Running,
    /// Which cases
    #[command(flatten)]
    pub choice: Choice,
    /// What is judged beside
    #[command(flatten)]
    pub references: ReferencesFolder,
    /// What is compared with
    #[command(flatten)]
    pub records: Records,
    /// Treat an undetermined own claim as a failure (exit code 5)
    #[arg(long)]
    pub strict: bool,
}

/// Option of everything that judges results.
#[derive(Debug, Args)]
pub struct ReferencesFolder {
    /// Use the references of this folder (CASE/SOURCE.csv and .toml) instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    pub references: Option<PathBuf>,
}

/// Options of everything that runs cases.
#[derive(Debug, Clone, Copy, Args)]
pub struct Running {
    /// How much is run
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
    /// Threads; all cores if not given
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// Keep results that are there already and go on
    #[arg(long)]
    pub resume: bool,
    /// Print results and failures only
    #[arg(long, short)]
    pub quiet: bool,
}

/// How much is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Tier {
    /// Under a minute for the whole catalogue
    Quick,
    /// Everything, whole families included
    Full,
}

/// `seam list`
#[derive(Debug, Args)]
pub struct List {
    /// Ids; the whole catalogue if none is given
    #[arg(value_name = "ID")]
    pub cases: Vec<String>,
    /// Which cases
    #[command(flatten)]
    pub filter: Filter,
    /// Only cases of this tier
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// As JSON: id, title, tags, tiers, effects, claims, threads, mem_mb, minutes
    #[arg(long)]
    pub json: bool,
}

/// `seam show`
#[derive(Debug, Args)]
pub struct Show {
    /// Id of the case
    pub id: String,
}

/// `seam run`
#[derive(Debug, Args)]
pub struct Run {
    /// Ids of the catalogue or paths of scene files; the whole tier if none is given
    #[arg(value_name = "ID|SCENE.toml")]
    pub cases: Vec<String>,
    /// Set a key of the scene, e.g. --set bodies.middle.de.rows=16
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// Folder for results
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Which cases
    #[command(flatten)]
    pub choice: Choice,
    /// How the cases are run
    #[command(flatten)]
    pub running: Running,
    /// Keep the scene's own run in time after every N outputs, in ID.checkpoint in the folder for results
    #[arg(long, value_name = "N")]
    pub checkpoint_every: Option<NonZeroUsize>,
    /// Go on from a checkpoint of the same scene
    #[arg(long, value_name = "FILE")]
    pub restart: Option<PathBuf>,
}

/// `seam study`
#[derive(Debug, Subcommand)]
pub enum Study {
    /// Error against counted work and seconds: methods, elements, skins, sections, schemes, each at several levels
    Cost(Cost),
    /// Each effect on and off: what it changes, what it costs, and whether the scene calls for it
    Effects(Studied),
    /// Margins of the hard cases; of a scene the digits that survive rounding, its longest step, its drift of energy
    Stability(Stability),
    /// One run of a scene and the memory it takes
    #[command(hide = true)]
    Alone(Alone),
}

/// `seam study cost`
#[derive(Debug, Args)]
pub struct Cost {
    /// What is studied, and how
    #[command(flatten)]
    pub studied: Studied,
    /// Leave out levels that may take longer than this, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 120.0)]
    pub longest: f64,
}

/// `seam study alone`
#[derive(Debug, Args)]
pub struct Alone {
    /// Id of the catalogue or path of a scene file
    pub case: String,
    /// Set a key of the scene
    #[arg(long = "set")]
    pub overrides: Vec<String>,
}

/// `seam study stability`
#[derive(Debug, Args)]
pub struct Stability {
    /// Ids of the catalogue or paths of scene files; the hard cases if none is given
    #[arg(value_name = "ID|SCENE.toml")]
    pub cases: Vec<String>,
    /// Set a key of the scene, e.g. --set parameters.rows=16
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// Folder for results; a study lies beside the run of its case
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// How the cases are run
    #[command(flatten)]
    pub running: Running,
}

/// What a study is of.
#[derive(Debug, Args)]
pub struct Studied {
    /// Ids of the catalogue or paths of scene files
    #[arg(value_name = "ID|SCENE.toml", required = true)]
    pub cases: Vec<String>,
    /// Set a key of the scene, e.g. --set parameters.rows=16
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// Folder for results; a study lies beside the run of its case
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// How the settings are run
    #[command(flatten)]
    pub running: Running,
}

/// `seam export`
#[derive(Debug, Args)]
pub struct Export {
    /// Id of the catalogue or path of a scene file
    #[arg(value_name = "ID|SCENE.toml")]
    pub case: String,
    /// The code that is to read it
    #[arg(long = "for", value_enum, value_name = "CODE")]
    pub code: Code,
    /// Set a key of the scene, e.g. --set bodies.left.enabled=false
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// Folder; each network of a case gets one of its own in it
    #[arg(long, value_name = "DIR", default_value = "export")]
    pub out: PathBuf,
}

/// Another code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Code {
    /// Bonded particles
    Yade,
    /// Bonded particles (BPM package)
    Lammps,
    /// Finite elements
    Calculix,
}

/// `seam check`
#[derive(Debug, Args)]
pub struct Check {
    /// Ids; every result that is there if none is given
    #[arg(value_name = "ID")]
    pub cases: Vec<String>,
    /// Folder with the results of a run
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub from: PathBuf,
    /// Which cases
    #[command(flatten)]
    pub filter: Filter,
    /// Only results of this tier
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Compare with the results.json of another run; its red is added to the exit code
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// What is compared with
    #[command(flatten)]
    pub records: Records,
    /// What is judged beside
    #[command(flatten)]
    pub references: ReferencesFolder,
    /// Treat an undetermined own claim as a failure (exit code 5)
    #[arg(long)]
    pub strict: bool,
}

/// `seam report`
#[derive(Debug, Args)]
pub struct Report {
    /// Folder with the results of a run
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub from: PathBuf,
    /// Write the validation document too: the figures as Markdown, without machine and timings
    #[arg(long, value_name = "FILE")]
    pub markdown: Option<PathBuf>,
    /// What is judged beside
    #[command(flatten)]
    pub references: ReferencesFolder,
    /// What is compared with
    #[command(flatten)]
    pub records: Records,
}

/// `seam references`
#[derive(Debug, Subcommand)]
pub enum References {
    /// List the references: kind, code, date, and which code is installed here
    List,
    /// Check hashes, provenance, and that Seam still exports the inputs they were made from
    Verify(ReferencesFolder),
    /// Run the installed codes again and show the difference to what is committed
    Regenerate(Regenerate),
    /// Run the same network and mesh in Seam and in each installed code, and compare time and result
    Race(Race),
    /// Seam's own lane of a race
    #[command(hide = true)]
    Lane(Lane),
}

/// `seam references regenerate`
#[derive(Debug, Args)]
pub struct Regenerate {
    /// CASE or CASE/SOURCE; all if none is given
    #[arg(value_name = "ID")]
    pub ids: Vec<String>,
    /// Only what this code makes
    #[arg(long = "with", value_enum, value_name = "CODE")]
    pub code: Option<Code>,
    /// Replace what is committed by what the codes give now
    #[arg(long)]
    pub accept: bool,
    /// Folder with `generators` and `data`
    #[arg(long, value_name = "DIR", default_value = "references")]
    pub home: PathBuf,
}

/// `seam references race`
#[derive(Debug, Args)]
pub struct Race {
    /// Sizes of the network, in particles
    #[arg(long, value_name = "N", num_args = 1.., default_values_t = [4_000, 20_000])]
    pub particles: Vec<usize>,
    /// Sizes of the mesh, in nodes
    #[arg(long, value_name = "N", num_args = 1.., default_values_t = [5_000])]
    pub nodes: Vec<usize>,
    /// Time steps of the network
    #[arg(long, value_name = "N", default_value = "200")]
    pub steps: NonZeroUsize,
    /// Threads or ranks
    #[arg(long, value_name = "N", num_args = 1.., default_values = ["1", "2"])]
    pub threads: Vec<NonZeroUsize>,
    /// Runs of each code, one after the other in turn; the median counts
    #[arg(long, value_name = "N", default_value = "3")]
    pub rounds: NonZeroUsize,
    /// Folder of a run: the race goes into its folder `race`, and `seam report` shows it
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Record it: reports without a race of their own show this one, as run elsewhere
    #[arg(long)]
    pub accept: bool,
    /// Folder with `generators` and `data`
    #[arg(long, value_name = "DIR", default_value = "references")]
    pub home: PathBuf,
}

/// `seam references lane`
#[derive(Debug, Args)]
pub struct Lane {
    /// Folder of an exported network; a bar of this many nodes if it is a number
    pub what: String,
    /// Folder for the result
    pub out: PathBuf,
    /// Threads
    pub threads: usize,
    /// Bonds for finite rotations, on one thread
    #[arg(long)]
    pub finite: bool,
}
