//! `seam selftest`: seeded defects, and how each turned the gate red.

use super::check::print;
use crate::args::Selftest;
use crate::selftest::{self, Shown};
use anyhow::Result;
use seam_reports::exit::Exit;

/// Seeds defects; fails if one of them is not found by the check that is there to find it.
pub fn selftest(words: &Selftest) -> Result<Exit> {
    let defects = selftest::named(&words.defects)?;
    let width = defects.iter().map(|d| d.name.len()).max().unwrap_or(0);
    if words.list {
        let line = |d: &&selftest::Seeded| format!("{:<width$}  {}\n", d.name, d.about);
        print(&defects.iter().map(line).collect::<String>())?;
        return Ok(Exit::Pass);
    }
    let all = selftest::run(&defects)?;
    print(&all.iter().map(|shown| line(shown, width)).collect::<String>())?;
    let missed = all.iter().filter(|shown| !shown.as_expected).count();
    let (verdict, exit) = match missed {
        0 => ("each turned the gate red, by the check that is there for it".to_owned(), Exit::Pass),
        n => (format!("{n} not as expected: the check that is there for it does not work"), Exit::Failed),
    };
    print(&format!("\n{} defects seeded; {verdict}\n", all.len()))?;
    Ok(exit)
}

/// Name, exit code, check; beside it the other checks that saw it.
fn line(shown: &Shown, width: usize) -> String {
    let exit = shown.exit as u8;
    let state = if shown.as_expected { "red   " } else { "MISSED" };
    let by = shown.by.first().map_or("nothing", String::as_str);
    let more = match shown.by.len() {
        0 | 1 => String::new(),
        n => format!(" +{}", n - 1),
    };
    let room = 80usize.saturating_sub(width + 13 + more.len()).max(24);
    // Of a long message, what is expected in it.
    let by = match by.find(shown.seeded.by).filter(|at| *at > 0 && by.chars().count() > room) {
        Some(at) => format!("… {}", &by[at..]),
        None => by.to_owned(),
    };
    let by: String = match by.chars().count() > room {
        true => by.chars().take(room - 1).chain(['…']).collect(),
        false => by,
    };
    format!("{:<width$}  {state} {exit}  {by}{more}\n", shown.seeded.name)
}
