//! Where stability ends over two parameters, each run a square.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry, csv_line};
use crate::format::count;
use seam_cases::map::{Cell, StabilityMap};

/// What each outcome is drawn as, and what it means.
const CELLS: [(Cell, Ink, &str); 5] = [
    (Cell::Bounded, Ink::Bounded, "bounded, every check holds"),
    (Cell::Cautious, Ink::Cautious, "refused, though it would stay bounded"),
    (Cell::Refused, Ink::Refused, "refused before it began, with a reason"),
    (Cell::Stopped, Ink::Stopped, "stopped on the way, with a reason"),
    (Cell::Silent, Ink::Silent, "went wrong without a word"),
];

/// The map; `None` if there is nothing to draw.
pub fn squares(map: &StabilityMap) -> Option<Figure> {
    let (columns, rows) = (edges(&map.x)?, edges(&map.y)?);
    let x = Axis { range: [columns[0], *columns.last()?], ..Axis::over(&map.x_label, true, map.x.clone())? };
    let y = Axis { range: [rows[0], *rows.last()?], ..Axis::over(&map.y_label, true, map.y.clone())? };
    let mut layers = Vec::new();
    for (row, cells) in map.cells.iter().enumerate().take(map.y.len()) {
        for (column, cell) in cells.iter().enumerate().take(map.x.len()) {
            let (left, right, low, high) = (columns[column], columns[column + 1], rows[row], rows[row + 1]);
            let points = vec![[left, low], [right, low], [right, high], [left, high]];
            let ink = CELLS.iter().find(|(c, _, _)| c == cell).map_or(Ink::Silent, |(_, ink, _)| *ink);
            layers.push(Layer::Area { ink, points });
        }
    }
    let shown = CELLS.iter().filter(|(cell, _, _)| map.count(*cell) > 0);
    let entry = |(cell, ink, meaning): &(Cell, Ink, &str)| {
        LegendEntry::area(*ink, format!("{meaning}: {}", count(map.count(*cell), "run")))
    };
    let legend = shown.map(entry).collect();
    let silent = map.count(Cell::Silent);
    let note = match silent {
        0 => "No run went wrong without being refused or stopped.".to_owned(),
        n => format!("{} went wrong without being refused or stopped.", count(n, "run")),
    };
    let description = format!("{} by {} runs. {note}", map.x.len(), map.y.len());
    let chart = Chart { title: map.title.clone(), description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure_of(legend, note, csv(map)))
}

/// One line per run.
fn csv(map: &StabilityMap) -> String {
    let mut text = csv_line(&[&map.x_label, &map.y_label, "outcome"]);
    for (y, cells) in map.y.iter().zip(&map.cells) {
        for (x, cell) in map.x.iter().zip(cells) {
            text += &csv_line(&[&format!("{x:?}"), &format!("{y:?}"), &format!("{cell:?}").to_lowercase()]);
        }
    }
    text
}

/// Borders of the squares around positive ascending values: half-way in the logarithm, the outer ones as far out.
fn edges(values: &[f64]) -> Option<Vec<f64>> {
    let [first, .., last] = values else { return None };
    if !(values.is_sorted() && *first > 0.0 && last.is_finite()) {
        return None;
    }
    let between: Vec<f64> = values.windows(2).map(|v| (v[0] * v[1]).sqrt()).collect();
    let (low, high) = (first * first / between.first()?, last * last / between.last()?);
    Some([vec![low], between, vec![high]].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> StabilityMap {
        StabilityMap {
            id: "m".into(),
            title: "Steps".into(),
            x_label: "x (1)".into(),
            y_label: "y (1)".into(),
            x: vec![1.0, 10.0, 100.0],
            y: vec![1.0, 4.0],
            cells: vec![
                vec![Cell::Bounded, Cell::Bounded, Cell::Refused],
                vec![Cell::Bounded, Cell::Stopped, Cell::Silent],
            ],
        }
    }

    #[test]
    fn every_run_is_a_square_of_its_kind() {
        let figure = squares(&map()).expect("drawn");
        for (class, n) in [("ink-bounded", 3), ("ink-refused", 1), ("ink-stopped", 1), ("ink-silent", 1)] {
            assert_eq!(figure.svg.matches(class).count(), n, "{class}");
        }
        assert!(figure.note.starts_with("1 run went wrong"), "{}", figure.note);
        assert_eq!(figure.legend.len(), 4);
    }

    #[test]
    fn what_cannot_be_placed_is_not_drawn() {
        assert!(squares(&StabilityMap { x: vec![1.0], ..map() }).is_none());
        assert!(squares(&StabilityMap { x: vec![0.0, 1.0, 2.0], ..map() }).is_none());
        assert!(squares(&StabilityMap { y: vec![2.0, 1.0], ..map() }).is_none());
    }
}
