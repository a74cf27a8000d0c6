//! A race as a table of 80 columns.

use crate::race::{Lane, Race, scaled, unit};
use std::fmt::Write;

/// Medians with the range of the rounds; ratios are wall times over Seam's, with bonds for small and for finite rotations:
/// for what the machine allows, the share of it that Seam's speed is.
pub fn race(race: &Race) -> String {
    let mut text = String::new();
    for what in ["network", "mesh"] {
        let mut lanes = race.of_kind(what).peekable();
        if lanes.peek().is_none() {
            continue;
        }
        let size = if what == "mesh" { "nodes" } else { "particles" };
        let _ = writeln!(text, "{what}: {}; time over Seam's", unit(what));
        let _ = writeln!(
            text,
            "{size:>9} thr {:<12} {:>7} {:>15} {:>6} {:>6} {:>5} {:>8}",
            "code", "median", "range", "/seam", "/finite", "MiB", "end"
        );
        lanes.clone().for_each(|lane| line(&mut text, lane));
        if lanes.any(Lane::is_limit) {
            text += "bandwidth, arithmetic: what the machine allows; /seam: what share of it Seam is\n";
        }
    }
    text
}

fn line(text: &mut String, lane: &Lane) {
    let [rate, low, high] = lane.rate.map(|r| scaled(&lane.what, r));
    let or_dash = |number: Option<String>| number.unwrap_or("–".to_owned());
    let finite = or_dash(lane.times_finite.map(|r| format!("{r:.2}")));
    let memory = or_dash(lane.memory_mib.map(|m| format!("{m:.0}")));
    let difference = or_dash(lane.difference.map(|d| format!("{d:.1e}")));
    let _ = writeln!(
        text,
        "{:>9} {:>3} {:<12} {rate:>7.2} {:>15} {:>6.2} {finite:>7} {memory:>5} {difference:>8}",
        lane.size,
        lane.threads,
        lane.code,
        format!("{low:.2}–{high:.2}"),
        lane.times_seam
    );
}
