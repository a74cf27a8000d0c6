//! `seam run`: one folder of results per case.

use super::check::print;
use crate::args::{Records, Run};
use crate::{results, running};
use anyhow::{Result, bail};
use seam_cases::checkpoint::Checkpoints;
use seam_cases::file::SceneFile;
use seam_reports::exit::Exit;

/// Runs cases without judging them.
pub fn run(words: &Run) -> Result<Exit> {
    let recorded = results::recorded(&Records { recorded: None })?;
    let how = (&words.choice, &words.running, words.out.as_path());
    let files = running::selected(&words.cases, &words.overrides, how, &recorded)?;
    if words.restart.is_some() && files.len() != 1 {
        bail!("--restart goes on with one case; name it: seam run ID --restart FILE");
    }
    if words.choice.dry_run {
        print(&plan(&files))?;
        return Ok(Exit::Pass);
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

/// What would run, and what each case says it needs.
pub fn plan(files: &[SceneFile]) -> String {
    if files.is_empty() {
        return "nothing to run\n".to_owned();
    }
    let width = files.iter().map(|f| f.scene.id.len()).max().unwrap_or(0).max(4);
    let mut out = format!("{:<width$}  threads  mem_mb  minutes (full tier)\n", "case");
    for file in files {
        let needs = file.scene.needs;
        out += &format!(
            "{:<width$}  {:>7}  {:>6}  {:>7}\n",
            file.scene.id, needs.threads, needs.mem_mb, needs.minutes
        );
    }
    out + &format!("{} to run\n", seam_reports::format::count(files.len(), "case"))
}
