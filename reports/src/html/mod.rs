//! The report: one self-contained page, claims first.

mod claim;
mod prose;
mod stability;
mod view;

use crate::plots::Figure;
use crate::results::{Results, ResultsError, write_whole};
use minijinja::value::Serde;
use minijinja::{Environment, context};
use seam_cases::result::CaseResult;
use std::path::Path;

const PAGE: &str = include_str!("../../templates/report.html");
const CLAIM: &str = include_str!("../../templates/claim.html");
const CASE: &str = include_str!("../../templates/case.html");
const STABILITY: &str = include_str!("../../templates/stability.html");
const MACROS: &str = include_str!("../../templates/macros.html");
const STYLE: &str = include_str!("../../templates/style.css");
const SCRIPT: &str = include_str!("../../templates/script.js");

/// Writes `report.html` into a folder, whole or not at all, and every figure of it as a file of its own into
/// `figures/`.
///
/// # Errors
/// A file cannot be written.
pub fn write_report(results: &Results, cases: &[CaseResult], folder: &Path) -> Result<(), ResultsError> {
    for (name, figure) in view::page(results, cases).figures() {
        write_whole(&folder.join("figures").join(format!("{name}.svg")), &standalone(figure))?;
    }
    write_whole(&folder.join("report.html"), &page(results, cases)?)
}

/// A figure that brings the style of the page with it, in light and in dark.
fn standalone(figure: &Figure) -> String {
    let style =
        format!("<style>{STYLE} svg {{ font-family: sans-serif; background: var(--paper); }}</style>");
    figure.svg.replacen("<title>", &format!("{style}<title>"), 1)
}

/// The page. Judged and measured cases are joined by their id; a judged case whose measurements are not
/// given is shown without figures. Everything that depends on the machine or the clock stands between the
/// comments `machine: begin` and `machine: end`.
///
/// # Errors
/// None in practice: the templates are part of the program and tested.
pub fn page(results: &Results, cases: &[CaseResult]) -> Result<String, ResultsError> {
    let fail = |e: minijinja::Error| ResultsError::View { view: "report.html", message: format!("{e:#}") };
    let mut templates = Environment::new();
    for (name, text) in [
        ("report.html", PAGE),
        ("claim.html", CLAIM),
        ("case.html", CASE),
        ("stability.html", STABILITY),
        ("macros.html", MACROS),
    ] {
        templates.add_template(name, text).map_err(fail)?;
    }
    let page = templates.get_template("report.html").map_err(fail)?;
    let values = context! { style => STYLE, script => SCRIPT, page => Serde(view::page(results, cases)) };
    // A percent sign stays on the line of its number.
    page.render(values).map(|html| html.replace(" %", "\u{a0}%")).map_err(fail)
}
