//! Where stability ends over two parameters: a picture of small squares, each one run.

use serde::{Deserialize, Serialize};

/// What became of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cell {
    /// It stayed bounded, and its checks held.
    #[default]
    Bounded,
    /// It was refused before it began, by an error that says why, and would have gone wrong.
    Refused,
    /// It was refused, and would have stayed bounded: the caution of a safe bound.
    Cautious,
    /// It was stopped on the way, by an error that says why.
    Stopped,
    /// It went wrong and nothing said so: a fault of the solver.
    Silent,
}

/// A map of runs.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StabilityMap {
    /// Unique within the case.
    pub id: String,
    /// Caption.
    pub title: String,
    /// Abscissa with unit.
    pub x_label: String,
    /// Ordinate with unit.
    pub y_label: String,
    /// Values along the abscissa, ascending, drawn on a logarithmic axis.
    pub x: Vec<f64>,
    /// Values along the ordinate, ascending, drawn on a logarithmic axis.
    pub y: Vec<f64>,
    /// `cells[row][column]` belongs to `y[row]` and `x[column]`.
    pub cells: Vec<Vec<Cell>>,
}

impl StabilityMap {
    /// How many cells came out like this.
    pub fn count(&self, cell: Cell) -> usize {
        self.cells.iter().flatten().filter(|c| **c == cell).count()
    }
}
