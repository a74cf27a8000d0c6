//! Rates of several codes over the size of the network or mesh.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::format::{count, significant};
use crate::race::{Lane, Race, scaled, unit};

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
    let others: Vec<&Lane> = lanes().filter(|lane| !lane.is_seam()).collect();
    Some(chart.figure(legend, note(&others)))
}

/// `YADE takes 9 to 12 times as long as Seam, 3 to 4 times as long as with finite rotations.`
fn note(others: &[&Lane]) -> String {
    let mut titles: Vec<&str> = others.iter().map(|lane| lane.title()).collect();
    titles.sort_unstable();
    titles.dedup();
    let range = |title: &str, ratio: fn(&Lane) -> Option<f64>| {
        let all = others.iter().filter(|lane| lane.title() == title);
        let all = all.filter_map(|lane| ratio(lane));
        let [lo, hi] = all.fold([f64::INFINITY, 0.0], |[lo, hi]: [f64; 2], r| [lo.min(r), hi.max(r)]);
        let words = |r: f64| significant(r, 2);
        let same = words(lo) == words(hi);
        lo.is_finite().then(|| if same { words(lo) } else { format!("{} to {}", words(lo), words(hi)) })
    };
    let sentence = |title: &&str| {
        let seam = range(title, |lane| Some(lane.times_seam))?;
        let finite = range(title, |lane| lane.times_finite);
        let finite =
            finite.map_or(String::new(), |f| format!(", {f} times as long as with finite rotations"));
        Some(format!("{title} takes {seam} times as long as Seam{finite}."))
    };
    titles.iter().filter_map(sentence).collect::<Vec<_>>().join(" ")
}
