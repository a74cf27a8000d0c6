//! The report: one self-contained page, the answer first.
//!
//! `sections` lists what the page consists of; `view` puts results into words and figures; the templates do
//! the rest. A section of its own is a template in `templates/sections/`, a line in `sections` and, where the
//! results need words, a field of the page and a file in `view/`.

mod files;
mod prose;
mod sections;
mod view;

use crate::results::{Results, ResultsError};
use minijinja::value::Serde;
use minijinja::{Environment, context};
use seam_cases::result::CaseResult;

pub use files::write_report;

/// Templates that sections share, and the frame around them.
const SHARED: [(&str, &str); 4] = [
    ("report.html", include_str!("../../templates/report.html")),
    ("macros.html", include_str!("../../templates/macros.html")),
    ("claim.html", include_str!("../../templates/claim.html")),
    ("case.html", include_str!("../../templates/case.html")),
];
const STYLE: &str = include_str!("../../templates/style.css");
const FIGURES: &str = include_str!("../../templates/figures.css");
const SCRIPT: &str = include_str!("../../templates/script.js");

/// The page. Judged and measured cases are joined by their id; a judged case whose measurements are not
/// given is shown without figures. Everything that depends on the machine or the clock stands between the
/// comments `machine: begin` and `machine: end`.
///
/// # Errors
/// None in practice: the templates are part of the program and tested.
pub fn page(results: &Results, cases: &[CaseResult]) -> Result<String, ResultsError> {
    render(&view::page(results, cases))
}

fn render(page: &view::Page) -> Result<String, ResultsError> {
    let mut templates = Environment::new();
    SHARED.iter().try_for_each(|(name, text)| templates.add_template(name, text)).map_err(failed)?;
    sections::add(&mut templates).map_err(failed)?;
    let sections = sections::render(&templates, page)?;
    let frame = templates.get_template("report.html").map_err(failed)?;
    let style = format!("{FIGURES}{STYLE}");
    let values = context! { style, script => SCRIPT, outcome => page.outcome, sections => Serde(sections) };
    // A percent sign stays on the line of its number.
    frame.render(values).map(|html| html.replace(" %", "\u{a0}%")).map_err(failed)
}

fn failed(error: minijinja::Error) -> ResultsError {
    ResultsError::View { view: "report.html", message: format!("{error:#}") }
}
