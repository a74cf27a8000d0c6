//! A race as tables and figures.

use crate::format::{grouped, significant};
use crate::plots::{self, Figure};
use crate::race::{Lane, Race, scaled, unit};
use serde::Serialize;

/// A race in words.
#[derive(Serialize)]
pub(crate) struct RaceView {
    recorded: bool,
    about: String,
    version: String,
    date: String,
    machine: String,
    command: String,
    tables: Vec<Table>,
    pub(super) figures: Vec<Figure>,
}

#[derive(Serialize)]
struct Table {
    caption: &'static str,
    size: &'static str,
    unit: &'static str,
    finite: bool,
    rows: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    size: String,
    threads: String,
    code: String,
    rate: String,
    range: String,
    ratio: String,
    finite: String,
    memory: String,
    difference: String,
}

/// Puts a race into words.
pub(super) fn view(race: &Race) -> RaceView {
    let table = |what: &'static str| {
        let rows: Vec<Row> = race.of_kind(what).map(row).collect();
        let mesh = what == "mesh";
        (!rows.is_empty()).then_some(Table {
            caption: if mesh { "The same mesh at rest" } else { "The same network in motion" },
            size: if mesh { "nodes" } else { "particles" },
            unit: unit(what),
            finite: race.of_kind(what).any(|lane| lane.times_finite.is_some()),
            rows,
        })
    };
    let mut threads: Vec<f64> = race.lanes.iter().map(|lane| lane.threads).collect();
    threads.sort_by(f64::total_cmp);
    threads.dedup();
    let all = ["network", "mesh"].into_iter().flat_map(|what| threads.iter().map(move |&n| (what, n)));
    let figures = all.filter_map(|(what, n)| plots::race::rates(race, what, n)).collect();
    RaceView {
        recorded: race.recorded,
        about: race.about.clone(),
        version: race.version.clone(),
        date: race.date.clone(),
        machine: race.machine.clone(),
        command: race.command.clone(),
        tables: ["network", "mesh"].into_iter().filter_map(table).collect(),
        figures,
    }
}

fn row(lane: &Lane) -> Row {
    let [rate, low, high] = lane.rate.map(|r| significant(scaled(&lane.what, r), 3));
    Row {
        size: grouped(lane.size as u64),
        threads: significant(lane.threads, 3),
        code: lane.title().to_owned(),
        rate,
        range: format!("{low} … {high}"),
        ratio: significant(lane.times_seam, 3),
        finite: lane.times_finite.map_or("–".to_owned(), |r| significant(r, 3)),
        memory: lane.memory_mib.map_or("–".to_owned(), |m| format!("{m:.0}")),
        difference: lane.difference.map_or("–".to_owned(), |d| significant(d, 2)),
    }
}
