//! Changes against a baseline, worst first.

use super::style::{Paint, wrap};
use super::{Style, WIDTH, heading};
use crate::baseline::{Change, Kind};
use crate::exit::Exit;

/// One entry per change, or one line that there are none.
pub fn changes(changes: &[Change], style: Style) -> String {
    let mut out = heading("Against the baseline", style);
    for change in changes {
        let paint = match change.kind {
            Kind::Better => Paint::Good,
            Kind::Note => Paint::Dim,
            _ => Paint::Bad,
        };
        out.push_str(&format!(
            "  {} {}\n",
            style.paint(paint, &format!("{:<10}", change.kind.word())),
            change.place
        ));
        out.push_str(&wrap(&format!("{} → {}", change.was, change.now), WIDTH, 13));
    }
    if changes.iter().all(|change| change.kind.exit() == Exit::Pass) {
        out.push_str("  nothing is worse than it was\n");
    }
    out + "\n"
}
