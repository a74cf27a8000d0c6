//! The page on disk, and every figure of it as files of its own.

use super::{FIGURES, render, view};
use crate::plots::Figure;
use crate::results::{Results, ResultsError, write_whole};
use seam_cases::result::CaseResult;
use std::collections::BTreeSet;
use std::path::Path;

/// Writes `report.html` into a folder, whole or not at all, and every figure of it into `figures/`, as it is
/// drawn (SVG) and as the numbers it is drawn from (CSV).
///
/// # Errors
/// A file cannot be written.
pub fn write_report(results: &Results, cases: &[CaseResult], folder: &Path) -> Result<(), ResultsError> {
    let page = view::page(results, cases);
    let mut names = BTreeSet::new();
    for (name, figure) in page.figures() {
        let place = folder.join("figures").join(unused(&name, &mut names));
        write_whole(&place.with_added_extension("svg"), &standalone(figure))?;
        write_whole(&place.with_added_extension("csv"), &figure.csv)?;
    }
    write_whole(&folder.join("report.html"), &render(&page)?)
}

/// The name, numbered where a figure before has it already.
fn unused(name: &str, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{name}-{n}"));
    let free = std::iter::once(name.to_owned()).chain(numbered).find(|n| !taken.contains(n));
    let free = free.unwrap_or_default();
    taken.insert(free.clone());
    free
}

/// A figure that brings its style with it, in light and in dark.
fn standalone(figure: &Figure) -> String {
    let style =
        format!("<style>{FIGURES} svg {{ font-family: sans-serif; background: var(--paper); }}</style>");
    figure.svg.replacen("<title>", &format!("{style}<title>"), 1)
}
