//! A short summary in Markdown, for a pull request or a job summary.

use crate::failure::failures;
use crate::format::{percent, share};
use crate::results::Results;
use crate::verdict::Verdict;

/// Claims with their reasons, one line per case, failures.
pub fn summary(results: &Results) -> String {
    let mut out = String::from("# Seam: verdicts\n");
    let claims: Vec<_> = results.cases.iter().flat_map(|c| &c.claims).collect();
    if !claims.is_empty() {
        out.push_str("\n| claim | whose | bound | verdict | share | reason |\n|---|---|---|---|---|---|\n");
    }
    for c in claims {
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
    for f in failures(results) {
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

/// Text that neither ends a table cell nor starts markup.
pub(crate) fn escape(text: &str) -> String {
    text.replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;").replace('*', "\\*").replace('\n', " ")
}
