//! Failures as blocks: what was measured, what was allowed, what that means, how to run it again.

use super::style::{Paint, wrap};
use super::{Style, WIDTH};
use crate::failure::{Failure, failures};
use crate::results::Results;

/// A block per failure, or nothing.
pub(super) fn blocks(results: &Results, style: Style) -> String {
    failures(results).iter().map(|f| block(f, style)).collect()
}

fn block(f: &Failure, style: Style) -> String {
    let mut out = format!("\n{} {}\n", style.paint(Paint::Bad, f.class), style.paint(Paint::Bold, &f.place));
    for (label, text) in
        [("measured", &f.measured), ("bound", &f.bound), ("meaning", &f.meaning), ("rerun", &f.rerun)]
    {
        let body = wrap(text, WIDTH, 12);
        out.push_str(&format!("  {label:<10}{}", body.trim_start_matches(' ')));
    }
    out
}
