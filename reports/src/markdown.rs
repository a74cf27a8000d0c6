//! A short summary in Markdown, for a pull request or a job summary.

use crate::exit::Exit;
use crate::failure::{Failure, LOOSENED, failures};
use crate::format::{percent, share};
use crate::results::{QuantityResult, Results, ResultsError, write_whole};
use crate::verdict::Verdict;
use std::path::Path;

/// Writes the summary, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write(results: &Results, path: &Path) -> Result<(), ResultsError> {
    write_whole(path, &summary(results))
}

/// Verdict; loosened tolerances; claims with their reasons; one line per case; expected and other failures.
pub fn summary(results: &Results) -> String {
    let mut out = format!("# Seam: {}\n", headline(results));
    let (loosened, failed): (Vec<Failure>, Vec<Failure>) =
        failures(results).into_iter().partition(|f| f.class == LOOSENED);
    if !loosened.is_empty() {
        out.push_str("\n| loosened tolerance | was | is |\n|---|---|---|\n");
    }
    for f in loosened {
        out.push_str(&format!(
            "| {} | {} | **{}** |\n",
            escape(&f.place),
            escape(&f.bound),
            escape(&f.measured)
        ));
    }
    out.push_str(&claims(results));
    out.push_str(&cases(results));
    out.push_str(&expected(results));
    for f in failed {
        out.push_str(&format!(
            "\n**{}** {}\n\n- measured: {}\n- bound: {}\n- meaning: {}\n- rerun: `{}`\n",
            f.class,
            escape(&f.place),
            escape(&f.measured),
            escape(&f.bound),
            escape(&f.meaning),
            f.rerun
        ));
    }
    out
}

fn headline(results: &Results) -> &'static str {
    match results.exit(true) {
        Exit::Pass => "everything promised holds",
        Exit::Failed | Exit::Usage => "failed",
        Exit::Cost => "costs more than recorded",
        Exit::Unmeasured => "could not measure",
        Exit::Undetermined => "an own claim is undetermined",
    }
}

fn claims(results: &Results) -> String {
    let mut out = String::new();
    for c in results.cases.iter().flat_map(|c| &c.claims) {
        if out.is_empty() {
            out.push_str(
                "\n| claim | whose | bound | verdict | share | reason |\n|---|---|---|---|---|---|\n",
            );
        }
        let whose = if c.own { "own" } else { "paper" };
        out.push_str(&format!(
            "| {} | {whose} | {} | **{}** | {} | {} |\n",
            escape(&c.id),
            percent(c.bound),
            c.verdict,
            share(c.share),
            escape(&c.reason)
        ));
    }
    out
}

fn cases(results: &Results) -> String {
    let mut out = String::new();
    if !results.cases.is_empty() {
        out.push_str("\n| case | passed | failed | undetermined | shown |\n|---|---|---|---|---|\n");
    }
    for case in &results.cases {
        let with = |v| case.quantities.iter().filter(|q| q.verdict == v).count();
        out.push_str(&format!(
            "| {} | {} | {} | {} | {} |\n",
            escape(&case.id),
            with(Some(Verdict::Pass)),
            with(Some(Verdict::Fail)),
            with(Some(Verdict::Undetermined)),
            with(None)
        ));
    }
    out
}

/// Quantities that fail and were said to, with the reasons.
fn expected(results: &Results) -> String {
    let mut out = String::new();
    for case in &results.cases {
        let known = |q: &&QuantityResult| q.verdict == Some(Verdict::Fail) && !q.failed();
        for q in case.quantities.iter().filter(known) {
            let why = q.expected_failure.as_deref().unwrap_or_default();
            out.push_str(&format!(
                "\n**EXPECTED FAILURE** {} / {}: {}\n",
                escape(&case.id),
                escape(&q.id),
                escape(why)
            ));
        }
    }
    out
}

/// Text that neither ends a table cell nor starts markup.
pub(crate) fn escape(text: &str) -> String {
    text.replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;").replace('*', "\\*").replace('\n', " ")
}
