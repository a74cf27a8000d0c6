//! What accepting a run would change in the records.

use super::style::{Paint, wrap};
use super::{Style, WIDTH};
use crate::bless::Difference;
use crate::format;

/// One entry per difference; those by rounding are only counted.
pub fn differences(differences: &[Difference], rounding: usize, style: Style) -> String {
    let mut out = String::new();
    for d in differences {
        let paint = match d.kind {
            "loosened" | "gone" => Paint::Bad,
            "verdict" => Paint::Mixed,
            _ => Paint::Dim,
        };
        out.push_str(&format!("{} {}\n", style.paint(paint, &format!("{:<10}", d.kind)), d.place));
        out.push_str(&wrap(&format!("{} → {}", d.was, d.now), WIDTH, 11));
    }
    if rounding > 0 {
        out.push_str(&format!("rounding   {}, no more than that\n", format::count(rounding, "value")));
    }
    if out.is_empty() { "nothing differs from the records\n".to_owned() } else { out }
}
