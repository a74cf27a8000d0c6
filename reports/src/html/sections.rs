//! The sections of the page, in their order. To add one: a template of its own, and one line here.

use super::view::Page;
use crate::results::ResultsError;
use minijinja::value::Serde;
use minijinja::{Environment, context};
use serde::Serialize;

/// A line of the list below.
struct Entry {
    id: &'static str,
    title: &'static str,
    name: &'static str,
    template: &'static str,
}

/// Id (also the name of the template in `templates/sections/`) and heading of each section.
macro_rules! sections {
    ($($id:literal: $title:literal),* $(,)?) => {
        const SECTIONS: &[Entry] = &[$(Entry {
            id: $id,
            title: $title,
            name: concat!($id, ".html"),
            template: include_str!(concat!("../../templates/sections/", $id, ".html")),
        }),*];
    };
}

sections! {
    "answer": "In short",
    "failures": "Failures",
    "claims": "Claims",
    "numbers": "Numbers",
    "bias": "Bias and scatter",
    "budget": "Error budget",
    "cost": "What accuracy costs",
    "agreement": "Agreement with other codes",
    "race": "What a user would pick instead",
    "stability": "Stability margins",
    "effects": "Effects on and off",
    "cases": "Cases",
    "provenance": "Provenance",
    "machine": "Machine and timings",
}

/// A section that has something to say.
#[derive(Debug, Serialize)]
pub(super) struct Section {
    id: &'static str,
    title: &'static str,
    html: String,
}

/// Adds the templates of the sections.
pub(super) fn add(templates: &mut Environment<'_>) -> Result<(), minijinja::Error> {
    SECTIONS.iter().try_for_each(|entry| templates.add_template(entry.name, entry.template))
}

/// Renders the sections; one whose template comes out blank is left out, from the contents too.
pub(super) fn render(templates: &Environment<'_>, page: &Page) -> Result<Vec<Section>, ResultsError> {
    let values = context! { page => Serde(page) };
    let mut shown = Vec::new();
    for Entry { id, title, name, .. } in SECTIONS {
        let template = templates.get_template(name).map_err(super::failed)?;
        let html = template.render(&values).map_err(super::failed)?;
        if !html.trim().is_empty() {
            shown.push(Section { id, title, html });
        }
    }
    Ok(shown)
}
