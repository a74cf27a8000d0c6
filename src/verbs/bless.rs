//! `seam bless`: what accepting a run would change in the records, and accepting it.

use super::check::{print, style};
use crate::args::{Bless, Filter};
use crate::results::Unmeasured;
use crate::{references, results, select};
use anyhow::{Context, Result};
use seam_reports::bless::differences;
use seam_reports::record::Recorded;
use seam_reports::results::write_whole;
use seam_reports::{exit::Exit, terminal};

/// Shows the difference; writes it if that is asked for. References are never touched.
pub fn bless(words: &Bless) -> Result<Exit> {
    let file = words.recorded.display();
    let old = Recorded::load(&words.recorded).with_context(|| {
        format!("--recorded {file}: run this in Seam's own folder, or name a file whose first line is: schema = \"seam.recorded/1\"")
    })?;
    let references = references::verified(&words.references)?;
    let mut cases = select::results(results::load(&words.from)?, &words.cases, &Filter::default(), None)?;
    // What a study by itself leaves out would be taken for gone.
    cases.retain(|case| !case.study_alone);
    if cases.is_empty() {
        let message = "a study by itself is not recorded; run its case too: seam run ID";
        return Err(Unmeasured(message.to_owned()).into());
    }
    let judged = results::judged(&cases, references, &old);
    if let Some(case) = judged.cases.iter().find(|case| case.unmeasured()) {
        let mend = "see `seam check`, and mend that first";
        return Err(
            Unmeasured(format!("{}: not measured, so there is nothing to accept; {mend}", case.id)).into()
        );
    }
    let (all, rounding) = differences(&old, &judged);
    print(&terminal::differences(&all, rounding, style()))?;
    if all.is_empty() && rounding == 0 {
        return Ok(Exit::Pass);
    }
    if words.accept {
        write_whole(&words.recorded, &old.updated(&judged).to_toml()?)?;
        eprintln!("wrote {file}; build again, since Seam's own records are part of the command");
    } else {
        eprintln!("nothing is written; accept this with: seam bless {}--accept", again(words));
    }
    Ok(Exit::Pass)
}

/// The words that were given, but for `--accept`.
fn again(words: &Bless) -> String {
    let mut said: String = words.cases.iter().map(|id| format!("{id} ")).collect();
    for (option, value, usual) in
        [("--from", &words.from, "out"), ("--recorded", &words.recorded, "reports/recorded.toml")]
    {
        if value.as_os_str() != usual {
            said += &format!("{option} {} ", value.display());
        }
    }
    said
}
