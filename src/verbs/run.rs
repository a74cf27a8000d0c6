//! `seam run`: one folder of results per case.

use crate::args::Run;
use crate::running;
use anyhow::{Result, bail};
use seam_cases::checkpoint::Checkpoints;
use seam_reports::exit::Exit;

/// Runs cases without judging them.
pub fn run(words: &Run) -> Result<Exit> {
    let files = running::scenes(&words.cases, &words.overrides, words.running.tier)?;
    if words.restart.is_some() && files.len() != 1 {
        bail!("--restart goes on with one case; name it: seam run ID --restart FILE");
    }
    let checkpoints = |id: &str| Checkpoints {
        keep: words.checkpoint_every.map(|every| (every, words.out.join(format!("{id}.checkpoint")))),
        from: words.restart.clone(),
    };
    let failed = running::run(&files, &words.out, &words.running, &checkpoints)?;
    running::none_failed(failed)?;
    if !words.running.quiet {
        let out = words.out.display();
        eprintln!("results are in {out}; judge them with: seam check --from {out}");
    }
    Ok(Exit::Pass)
}
