//! Rates of several codes over the size of the network or mesh.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::format::{count, significant};
use crate::race::{Lane, Race, scaled, unit};
use std::collections::BTreeSet;

/// On some number of threads: a line for each code, with the range of the rounds; `None` where nothing was run.
pub fn rates(race: &Race, what: &str, threads: f64) -> Option<Figure> {
    let rate = |r: f64| scaled(what, r);
    let lanes = || race.of_kind(what).filter(|lane| lane.threads == threads);
    let size = if what == "mesh" { "nodes" } else { "particles" };
    let x = Axis::over(size, true, lanes().map(|lane| lane.size))?;
    let y = Axis::over(unit(what), true, lanes().flat_map(|lane| lane.rate.map(rate)))?;
    let mut titles: Vec<&str> = Vec::new();
    for lane in lanes() {
        if !titles.contains(&lane.title()) {
            titles.push(lane.title());
        }
    }
    let (mut layers, mut legend) = (Vec::new(), Vec::new());
    for (i, &title) in titles.iter().enumerate() {
        let ink = Ink::series(i);
        legend.push(LegendEntry::line(ink, title));
        let own: Vec<&Lane> = lanes().filter(|lane| lane.title() == title).collect();
        for lane in &own {
            let ends = [lane.rate[1], lane.rate[2]].map(|r| [lane.size, rate(r)]);
            layers.push(Layer::Line { ink, points: ends.to_vec() });
        }
        let points: Vec<[f64; 2]> = own.iter().map(|lane| [lane.size, rate(lane.rate[0])]).collect();
        layers.push(Layer::Line { ink, points: points.clone() });
        layers.push(Layer::Dots { ink, points, radius: 8 });
    }
    let done = if what == "mesh" { "Unknowns solved, same mesh" } else { "Bonds updated, same network" };
    let title = format!("{done}, {}", count(threads as usize, "thread"));
    let description = format!("{} over {size}", unit(what));
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    let [limits, others] = [true, false]
        .map(|limit| lanes().filter(|lane| lane.is_limit() == limit && !lane.is_seam()).collect::<Vec<_>>());
    let notes = [slower(&others), shares(&limits)].concat();
    Some(chart.figure(legend, notes.join(" ")))
}

/// `YADE takes 9 to 12 times as long as Seam, 3 to 4 times as long as with finite rotations.`
fn slower(others: &[&Lane]) -> Vec<String> {
    let sentence = |title: &str, own: &[&&Lane]| {
        let seam = range(own.iter().map(|lane| lane.times_seam), |r| significant(r, 2))?;
        let finite = range(own.iter().filter_map(|lane| lane.times_finite), |r| significant(r, 2));
        let finite =
            finite.map_or(String::new(), |f| format!(", {f} times as long as with finite rotations"));
        Some(format!("{title} takes {seam} times as long as Seam{finite}."))
    };
    by_title(others, sentence)
}

/// `Limit of memory: Seam's speed is 40 to 45 % of it.`
fn shares(limits: &[&Lane]) -> Vec<String> {
    by_title(limits, |title, own| {
        let share = range(own.iter().map(|lane| 100.0 * lane.times_seam), |r| significant(r, 2))?;
        Some(format!("{title}: Seam's speed is {share} % of it."))
    })
}

/// One sentence for the lanes of each title.
fn by_title(lanes: &[&Lane], sentence: impl Fn(&str, &[&&Lane]) -> Option<String>) -> Vec<String> {
    let titles: BTreeSet<&str> = lanes.iter().map(|lane| lane.title()).collect();
    let own = |title: &str| lanes.iter().filter(|lane| lane.title() == title).collect::<Vec<_>>();
    titles.into_iter().filter_map(|title| sentence(title, &own(title))).collect()
}

/// `9 to 12`, or the one number there is; `None` without numbers.
fn range(numbers: impl Iterator<Item = f64>, words: impl Fn(f64) -> String) -> Option<String> {
    let [lo, hi] = numbers.fold([f64::INFINITY, 0.0], |[lo, hi]: [f64; 2], r| [lo.min(r), hi.max(r)]);
    let (low, high) = (words(lo), words(hi));
    lo.is_finite().then(|| if low == high { low } else { format!("{low} to {high}") })
}
