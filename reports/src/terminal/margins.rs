//! The margins of the hard cases: how far each is from breaking.

use super::{Paint, Style, WIDTH, cut, heading, short};
use crate::format::significant;
use crate::margins::MarginResult;
use crate::results::Results;

/// The table, or nothing where no margin was measured.
pub(super) fn table(results: &Results, style: Style) -> String {
    if results.cases.iter().all(|c| c.margins.is_empty()) {
        return String::new();
    }
    let mut out = heading("Stability margins", style);
    let columns = format!(
        "  {:<40} {:>10} {:>8} {:>9} {}\n",
        "largest … that still passes", "margin", "needed", "recorded", "verdict"
    );
    out.push_str(&style.paint(Paint::Dim, &columns));
    for case in results.cases.iter().filter(|c| !c.margins.is_empty()) {
        out.push_str(&format!("{}\n", style.paint(Paint::Bold, &case.id)));
        case.margins.iter().for_each(|m| out.push_str(&row(m, style)));
    }
    out
}

fn row(m: &MarginResult, style: Style) -> String {
    let number = |v: f64| significant(v, 3);
    // What still passes at the end of the search is at least that.
    let value = match m.value {
        Some(v) if m.open => format!("≥ {}", number(v)),
        Some(v) => number(v),
        None => "none".to_owned(),
    };
    let recorded = m.recorded.map_or_else(|| "–".to_owned(), number);
    let verdict = style.paint(Paint::verdict(m.verdict), short(m.verdict));
    let name = cut(&format!("{}: {}", m.label, m.axis), WIDTH - 40);
    format!("  {name:<40} {value:>10} {:>8} {recorded:>9} {verdict}\n", number(m.needed))
}
