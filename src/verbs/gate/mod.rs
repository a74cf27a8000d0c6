//! `seam gate`: this commit against another one, on the same cases and the same machine.
//!
//! Results and counted work are compared once; wall time only as a ratio of runs that took turns, since seconds of
//! another hour or machine say nothing.

mod build;
mod turns;

use super::check::{print, style};
use crate::args::Against;
use crate::{results, running, select};
use anyhow::{Context, Result};
use build::Other;
use seam_cases::result::CaseResult;
use seam_reports::baseline;
use seam_reports::exit::Exit;
use seam_reports::record::Recorded;
use seam_reports::terminal;
use std::collections::BTreeMap;
use std::path::Path;
use turns::{Pace, Turns};

/// Runs both in turns, then compares what they gave.
pub fn gate(words: &Against) -> Result<Exit> {
    let mut files = running::scenes(&words.cases, &[], words.tier)?;
    select::keep(&mut files, &words.filter)?;
    let other = match (&words.binary, &words.against) {
        (Some(binary), _) => Other::at(binary)?,
        (None, commit) => Other::build(commit.as_deref().unwrap_or("HEAD"))?,
    };
    let folder = tempfile::tempdir()?;
    let outs = [folder.path().join("now"), folder.path().join("then")];
    let own = std::env::current_exe().context("where this program is")?;
    let turns = Turns { programs: [&own, other.program()], outs: &outs, tier: words.tier };
    let (mut exit, mut shared) = (Exit::Pass, Vec::new());
    print(&format!("Wall time over that of {}: median of {} runs in turns\n", other.name(), words.rounds))?;
    for file in &files {
        let id = &file.scene.id;
        let Some(ratios) = turns.take(id, words.rounds as usize)? else {
            print(&format!("  {id:<30} does not run there\n"))?;
            continue;
        };
        let pace = Pace::of(&ratios, words.slower);
        print(&format!("  {id:<30} {pace}\n"))?;
        exit = exit.or(pace.exit());
        shared.push(id.clone());
    }
    let [now, then] = outs.each_ref().map(|out| judged(out, &shared));
    let changes = baseline::compare(&then?, &now?);
    print(&format!("\n{}", terminal::changes(&changes, style())))?;
    Ok(exit.or(baseline::exit(&changes)))
}

/// Both sides are judged by this program: what differs is what they computed.
fn judged(out: &Path, ids: &[String]) -> Result<seam_reports::results::Results> {
    let all = if ids.is_empty() { Vec::new() } else { results::load(out)? };
    let cases: Vec<CaseResult> = all.into_iter().filter(|case| ids.contains(&case.id)).collect();
    Ok(results::judged(&cases, BTreeMap::new(), &Recorded::default()))
}
