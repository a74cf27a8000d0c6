//! `seam run`: one folder of results per case.

use crate::args::Run;
use crate::running;
use anyhow::Result;
use seam_reports::exit::Exit;

/// Runs cases without judging them.
pub fn run(words: &Run) -> Result<Exit> {
    let files = running::scenes(&words.cases, &words.overrides, words.running.tier)?;
    let failed = running::run(&files, &words.out, &words.running)?;
    running::none_failed(failed)?;
    if !words.running.quiet {
        let out = words.out.display();
        eprintln!("results are in {out}; judge them with: seam check --from {out}");
    }
    Ok(Exit::Pass)
}
