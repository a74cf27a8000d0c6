//! Figures as inline SVG.
//!
//! Nothing is drawn in a colour: every line and area has an [`Ink`], which becomes a CSS class, so that the page
//! decides how it looks in light, in dark and on paper. Legends are text beside the figure and cannot overlap it.

pub mod bias;
pub mod budget;
mod chart;
pub mod convergence;
pub mod cost;
pub mod curves;
pub mod family;
mod ink;
pub mod map;
pub mod picture;
pub mod race;
mod shapes;
pub mod sketch;
mod ticks;

pub use ink::Ink;
use serde::Serialize;

/// A figure with its legend.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// Caption.
    pub title: String,
    /// The SVG element, with title and description.
    pub svg: String,
    /// What is drawn how.
    pub legend: Vec<LegendEntry>,
    /// A sentence to take home, or empty.
    pub note: String,
    /// The numbers it is drawn from, as CSV.
    #[serde(skip)]
    pub csv: String,
}

/// One line of a legend.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LegendEntry {
    /// CSS class of the ink.
    pub ink: &'static str,
    /// `line`, `dot` or `area`.
    pub mark: &'static str,
    /// What it stands for.
    pub text: String,
}

impl LegendEntry {
    fn line(ink: Ink, text: impl Into<String>) -> Self {
        LegendEntry { ink: ink.class(), mark: "line", text: text.into() }
    }

    fn dot(ink: Ink, text: impl Into<String>) -> Self {
        LegendEntry { ink: ink.class(), mark: "dot", text: text.into() }
    }

    fn area(ink: Ink, text: impl Into<String>) -> Self {
        LegendEntry { ink: ink.class(), mark: "area", text: text.into() }
    }
}

/// Text as SVG or HTML shows it.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
}

/// A line of CSV; fields with a comma, a quote or a line break are quoted.
fn csv_line(fields: &[&str]) -> String {
    let quoted = |field: &&str| {
        if field.contains([',', '"', '\n']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            (*field).to_owned()
        }
    };
    fields.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// Opening tag of an accessible figure of some size, followed by its title and description.
fn open_svg(width: f64, height: f64, title: &str, description: &str) -> String {
    format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\
         <title>{}</title><desc>{}</desc>\n",
        escape(title),
        escape(description)
    )
}
