//! Constraint rows that say nothing new, or contradict each other.
//!
//! Sparse elimination with Markowitz-like pivots: in each row the pivot is the unknown that the
//! fewest rows touch among the large coefficients. A pointwise row pivots on its own particle
//! and costs nothing; a row that vanishes is dependent on those it was eliminated with.

use super::Row;
use crate::error::{Error, Result};
use std::collections::{BTreeMap, BTreeSet};

/// Rows are taken in rounds: first those of which at least a tenth is new, relative to their largest
/// coefficient, then weaker ones. Taking them as they come could keep a set that is nearly dependent.
const ROUNDS: [f64; 5] = [1e-1, 1e-2, 1e-4, 1e-7, VANISHED];
/// What is left of a row below this is rounding.
const VANISHED: f64 = 1e-10;

/// The rows that are independent, and why the others were dropped.
#[derive(Debug)]
pub struct Independent {
    /// Indices of the rows kept, ascending.
    pub kept: Vec<usize>,
    /// One sentence per dropped row.
    pub notes: Vec<String>,
}

/// A reduced row: its place in the elimination, coefficients, right-hand side, and the rows that went into it.
struct Reduced {
    place: usize,
    pivot: usize,
    terms: BTreeMap<usize, f64>,
    rhs: f64,
    from: BTreeSet<usize>,
}

/// Finds independent rows of `Σ coefficient · u = rhs`.
///
/// `scale` is the size of the right-hand sides below which a contradiction is rounding.
///
/// # Errors
/// A dependent row with a right-hand side that the others do not allow.
pub fn independent(rows: &[Row], rhs: &[f64], scale: f64) -> Result<Independent> {
    let mut touches: BTreeMap<usize, usize> = BTreeMap::new();
    for row in rows {
        row.terms.iter().for_each(|t| *touches.entry(t.0).or_default() += 1);
    }
    let mut by_pivot: BTreeMap<usize, Reduced> = BTreeMap::new();
    let mut kept = Vec::new();
    let mut waiting: Vec<usize> = (0..rows.len()).collect();
    let mut left = Vec::new();
    for share in ROUNDS {
        left.clear();
        for &index in &waiting {
            let terms = &rows[index].terms;
            let largest = terms.iter().fold(0.0f64, |m, t| m.max(t.1.abs()));
            let (terms, from) = (terms.iter().copied().collect(), BTreeSet::from([index]));
            let mut reduced = Reduced { place: kept.len(), pivot: 0, terms, rhs: rhs[index], from };
            reduce(&mut reduced, &by_pivot, VANISHED * largest);
            match choose_pivot(&reduced.terms, share * largest, &touches) {
                Some(pivot) => {
                    reduced.pivot = pivot;
                    kept.push(index);
                    by_pivot.insert(pivot, reduced);
                }
                None => left.push((index, reduced)),
            }
        }
        waiting = left.iter().map(|(index, _)| *index).collect();
    }
    kept.sort_unstable();
    let mut notes = Vec::new();
    for (index, reduced) in left {
        let others = reduced.from.iter().filter(|i| **i != index).take(4).map(|&i| rows[i].label.as_str());
        let others = others.collect::<Vec<_>>().join("; ");
        let others = if others.is_empty() { "the supports alone".to_owned() } else { others };
        if reduced.rhs.abs() > VANISHED * scale {
            return Err(Error::Contradiction { row: rows[index].label.clone(), gap: reduced.rhs, others });
        }
        notes.push(format!("dropped {}: it follows from {others}", rows[index].label));
    }
    Ok(Independent { kept, notes })
}

/// Subtracts earlier rows until no pivot of theirs is left.
fn reduce(row: &mut Reduced, by_pivot: &BTreeMap<usize, Reduced>, zero: f64) {
    // A reduced row is free of the pivots before it but may hold later ones: the earliest goes first, so
    // that none comes back.
    let earliest = |terms: &BTreeMap<usize, f64>| {
        let pivots = terms.iter().filter_map(|(column, value)| Some((by_pivot.get(column)?, *value)));
        pivots.min_by_key(|(other, _)| other.place)
    };
    while let Some((other, value)) = earliest(&row.terms) {
        let factor = value / other.terms[&other.pivot];
        for (&column, &coefficient) in &other.terms {
            let entry = row.terms.entry(column).or_default();
            *entry -= factor * coefficient;
            if column == other.pivot || entry.abs() <= zero {
                row.terms.remove(&column);
            }
        }
        row.rhs -= factor * other.rhs;
        row.from.extend(&other.from);
    }
    row.terms.retain(|_, v| v.abs() > zero);
}

/// The unknown that the fewest rows touch, among those with a large coefficient; `None` if all are below `least`.
fn choose_pivot(terms: &BTreeMap<usize, f64>, least: f64, touches: &BTreeMap<usize, usize>) -> Option<usize> {
    let largest = terms.values().fold(0.0f64, |m, v| m.max(v.abs()));
    if largest <= least {
        return None;
    }
    let large = terms.iter().filter(|(_, v)| v.abs() >= 0.1 * largest);
    large
        .min_by_key(|(column, _)| (touches.get(column).copied().unwrap_or(0), **column))
        .map(|(column, _)| *column)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Vec3;

    fn row(label: &str, terms: &[(usize, f64)]) -> Row {
        Row::new(terms.to_vec(), label.to_owned(), Vec3::zeros())
    }

    #[test]
    fn a_sum_of_two_rows_is_dropped_and_named() {
        let rows = [
            row("a", &[(0, 1.0), (2, -0.5), (3, -0.5)]),
            row("b", &[(1, 1.0), (3, -1.0)]),
            row("c", &[(0, 1.0), (1, 1.0), (2, -0.5), (3, -1.5)]),
        ];
        let found = independent(&rows, &[0.0; 3], 1.0).expect("consistent");
        assert_eq!(found.kept, [0, 1]);
        assert_eq!(found.notes, ["dropped c: it follows from a; b"]);
    }

    #[test]
    fn a_contradiction_is_refused() {
        let rows = [row("a", &[(0, 1.0)]), row("b", &[(0, 2.0)])];
        let error = independent(&rows, &[1.0, 3.0], 1.0).expect_err("2·1 ≠ 3");
        assert!(error.to_string().contains("contradicts"), "{error}");
    }

    #[test]
    fn an_empty_row_is_dropped() {
        let found = independent(&[row("a", &[])], &[0.0], 1.0).expect("consistent");
        assert!(found.kept.is_empty());
        assert_eq!(found.notes, ["dropped a: it follows from the supports alone"]);
    }
}
