//! Failures as blocks: what was measured, what was allowed, what that means, how to run it again.

use super::style::{Paint, wrap};
use super::{Style, WIDTH};
use crate::counted::Counter;
use crate::failure::{Failure, LOOSENED, failures};
use crate::results::Results;

/// A block per loosened tolerance, or nothing: they come first.
pub(super) fn loosened(results: &Results, style: Style) -> String {
    let blocks: String =
        failures(results).iter().filter(|f| f.class == LOOSENED).map(|f| block(f, style)).collect();
    if blocks.is_empty() { blocks } else { format!("{}\n", blocks.trim_start_matches('\n')) }
}

/// A block per other failure, or nothing.
pub(super) fn blocks(results: &Results, style: Style) -> String {
    failures(results).iter().filter(|f| f.class != LOOSENED).map(|f| block(f, style)).collect()
}

/// What is better than recorded, which the record does not know yet.
pub(super) fn less_work(results: &Results) -> String {
    let mut out = String::new();
    for case in &results.cases {
        let [_, less] = case.work_changes();
        let say = |c: &Counter| format!("{} {} instead of {}", c.now, c.words(), c.was);
        if !less.is_empty() {
            let all = less.iter().map(say).collect::<Vec<_>>().join(", ");
            let text = format!("less work than recorded: {}: {all}; record it with seam bless", case.id);
            out.push_str(&wrap(&text, WIDTH, 2));
        }
    }
    if out.is_empty() { out } else { format!("\n{out}") }
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
