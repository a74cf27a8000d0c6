//! Which cases: the words that list, run and check share.

use clap::Args;

/// Cases by what they are about. Several of one kind mean any of them; both kinds must hold.
#[derive(Debug, Clone, Default, Args)]
pub struct Filter {
    /// Only cases with this tag; may be given several times
    #[arg(long = "tag", value_name = "TAG")]
    pub tags: Vec<String>,
    /// Only cases that simulate this effect; may be given several times
    #[arg(long = "effect", value_name = "EFFECT")]
    pub effects: Vec<String>,
}

/// Which cases are run.
#[derive(Debug, Clone, Default, Args)]
pub struct Choice {
    /// What they are about
    #[command(flatten)]
    pub filter: Filter,
    /// Run only what has no current result, or one that keeps the gate from being green
    #[arg(long, conflicts_with = "resume")]
    pub failed: bool,
    /// Print what would run and what it needs, and run nothing
    #[arg(long)]
    pub dry_run: bool,
}
