//! Sparse symmetric matrices and their LDLᵀ factors.
//!
//! The factorisation is faer's supernodal LDLᵀ. It does not pivot, so it is meant for positive
//! definite and quasi-definite matrices (Vanderbei 1995), whose factors exist in every order.
//! Nothing here judges accuracy: [`super::kkt`] refines on the true residual and checks it.

use crate::error::{Error, Result};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

/// Entries of a symmetric matrix in the order they come; entries of the same place add up.
#[derive(Debug, Clone, Default)]
pub struct Triplets {
    rows: Vec<u32>,
    cols: Vec<u32>,
    values: Vec<f64>,
}

impl Triplets {
    /// Room for `capacity` entries.
    pub fn with_capacity(capacity: usize) -> Self {
        Triplets {
            rows: Vec::with_capacity(capacity),
            cols: Vec::with_capacity(capacity),
            values: Vec::with_capacity(capacity),
        }
    }

    /// Number of entries.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Adds all entries of `other`.
    pub fn append(&mut self, other: &Triplets) {
        self.rows.extend_from_slice(&other.rows);
        self.cols.extend_from_slice(&other.cols);
        self.values.extend_from_slice(&other.values);
    }

    /// Adds `value` at `(row, col)`. Only the lower triangle is kept: an entry above the
    /// diagonal is dropped, so that both halves of a symmetric block may be pushed.
    #[inline]
    pub fn push(&mut self, row: usize, col: usize, value: f64) {
        if row >= col {
            self.rows.push(row as u32);
            self.cols.push(col as u32);
            self.values.push(value);
        }
    }

    /// Adds a square block, row by row, on the given unknowns of a part whose first unknown is `offset`.
    pub fn push_block(&mut self, offset: usize, dofs: &[usize], block: &[f64]) {
        let n = dofs.len();
        for (r, &row) in dofs.iter().enumerate() {
            for (c, &col) in dofs.iter().enumerate() {
                self.push(offset + row, offset + col, block[r * n + c]);
            }
        }
    }
}

/// A symmetric matrix: its lower triangle by columns.
#[derive(Debug, Clone, Default)]
pub struct SymmetricMatrix {
    n: usize,
    column_start: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl SymmetricMatrix {
    /// Sums the triplets into an `n × n` matrix.
    pub fn from_triplets(n: usize, triplets: &Triplets) -> Self {
        // By rows, then by columns: both passes keep ties in the order of insertion, so that sums are the same bits every time.
        let (by_row, _) = counted(&triplets.rows, n, 0..triplets.rows.len() as u32);
        let (order, start) = counted(&triplets.cols, n, by_row.into_iter());
        let mut matrix = SymmetricMatrix::with_room(n, triplets.len());
        for c in 0..n {
            let first = matrix.rows.len();
            for &t in &order[start[c]..start[c + 1]] {
                let (row, value) = (triplets.rows[t as usize], triplets.values[t as usize]);
                match matrix.rows.last() {
                    Some(&last) if matrix.rows.len() > first && last == row => {
                        *matrix.values.last_mut().expect("rows and values have one length") += value;
                    }
                    _ => matrix.push(row as usize, value),
                }
            }
            matrix.close_column();
        }
        matrix
    }

    /// `S A S` with the diagonal `S`.
    pub fn scaled(&self, scale: &[f64]) -> Self {
        let mut values = Vec::with_capacity(self.stored());
        values.extend(self.entries().map(|(r, c, v)| v * scale[r] * scale[c]));
        let (column_start, rows) = (self.column_start.clone(), self.rows.clone());
        SymmetricMatrix { n: self.n, column_start, rows, values }
    }

    /// The sum with a matrix that has as many unknowns or more.
    pub fn plus(&self, other: &SymmetricMatrix) -> Self {
        let room = self.stored() + other.stored();
        let mut sum = SymmetricMatrix::with_room(other.n, room);
        for c in 0..other.n {
            let mut own = (c < self.n).then(|| self.column(c)).into_iter().flatten().peekable();
            for (row, value) in other.column(c) {
                while let Some((r, v)) = own.next_if(|(r, _)| *r < row) {
                    sum.push(r, v);
                }
                let here = own.next_if(|(r, _)| *r == row).map_or(0.0, |(_, v)| v);
                sum.push(row, here + value);
            }
            own.for_each(|(r, v)| sum.push(r, v));
            sum.close_column();
        }
        sum
    }

    fn with_room(n: usize, entries: usize) -> Self {
        let mut column_start = Vec::with_capacity(n + 1);
        column_start.push(0);
        let (rows, values) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
        SymmetricMatrix { n, column_start, rows, values }
    }

    /// Appends an entry to the last column, below those it has.
    fn push(&mut self, row: usize, value: f64) {
        self.rows.push(row as u32);
        self.values.push(value);
    }

    fn close_column(&mut self) {
        self.column_start.push(self.rows.len() as u32);
    }

    /// The rows and columns that have a place among `n` others, in the same order; `usize::MAX` for those that have none.
    pub fn principal(&self, place: &[usize], n: usize) -> Self {
        let mut kept = SymmetricMatrix::with_room(n, self.stored());
        for c in (0..self.n).filter(|&c| place[c] != usize::MAX) {
            for (r, v) in self.column(c).filter(|(r, _)| place[*r] != usize::MAX) {
                kept.push(place[r], v);
            }
            kept.close_column();
        }
        kept
    }

    /// Number of rows and columns.
    pub fn len(&self) -> usize {
        self.n
    }

    /// Number of stored entries.
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    /// Entries of the lower triangle as `(row, column, value)`, by columns.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.n).flat_map(move |c| self.column(c).map(move |(r, v)| (r, c, v)))
    }

    fn structure(&self) -> SymbolicSparseColMatRef<'_, u32> {
        SymbolicSparseColMatRef::new_checked(self.n, self.n, &self.column_start, None, &self.rows)
    }

    fn column(&self, c: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.column_start[c] as usize..self.column_start[c + 1] as usize;
        self.rows[range.clone()].iter().zip(&self.values[range]).map(|(&r, &v)| (r as usize, v))
    }

    /// The diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.n).map(|c| self.column(c).find(|(r, _)| *r == c).map_or(0.0, |(_, v)| v)).collect()
    }

    /// `y += A x`.
    pub fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
        for c in 0..self.n {
            let mut sum = 0.0;
            for (r, v) in self.column(c) {
                y[r] += v * x[c];
                if r != c {
                    sum += v * x[r];
                }
            }
            y[c] += sum;
        }
    }

    /// `|A| |x|`: what the terms of `A x` add up to before they cancel.
    pub fn multiply_magnitudes(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        for (r, c, v) in self.entries() {
            y[r] += (v * x[c]).abs();
            if r != c {
                y[c] += (v * x[r]).abs();
            }
        }
        y
    }
}

/// Sorts indices by their keys below `n`, ties as they come. Gives them with the place where each key begins.
fn counted(keys: &[u32], n: usize, indices: impl Iterator<Item = u32>) -> (Vec<u32>, Vec<usize>) {
    let mut start = vec![0usize; n + 1];
    keys.iter().for_each(|&key| start[key as usize + 1] += 1);
    for key in 0..n {
        start[key + 1] += start[key];
    }
    let mut next = start.clone();
    let mut sorted = vec![0u32; keys.len()];
    for t in indices {
        let place = &mut next[keys[t as usize] as usize];
        sorted[*place] = t;
        *place += 1;
    }
    (sorted, start)
}

/// Elimination order by approximate minimum degree (Amestoy, Davis and Duff 1996): `order[k]` is eliminated as the `k`-th.
///
/// # Errors
/// A matrix that is too large.
pub fn minimum_degree(matrix: &SymmetricMatrix) -> Result<Vec<u32>> {
    let n = matrix.n;
    let (mut order, mut inverse) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<u32>(n, matrix.stored()));
    let failed =
        |e| Error::Solve { message: format!("ordering {n} unknowns failed: {e:?}; use a coarser model") };
    amd::order(
        &mut order,
        &mut inverse,
        matrix.structure(),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(failed)?;
    Ok(order)
}

/// An LDLᵀ factor.
pub struct Factor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl Factor {
    /// Factorises a positive definite or quasi-definite matrix; `order[k]` is the unknown that is eliminated as the `k`-th.
    ///
    /// # Errors
    /// A matrix that is too large, or whose factor has entries that are not finite.
    pub fn new(matrix: &SymmetricMatrix, order: &[u32]) -> Result<Self> {
        let n = matrix.n;
        let failed = |message: String| Error::Solve { message };
        let inverse = invert(order);
        let order = SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, n));
        let parameters = CholeskySymbolicParams::default();
        let symbolic = factorize_symbolic_cholesky(matrix.structure(), Side::Lower, order, parameters)
            .map_err(|e| {
                failed(format!("symbolic factorisation of {n} unknowns failed: {e:?}; use a coarser model"))
            })?;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| {
            failed(format!("not enough memory to factorise {n} unknowns; use a coarser model"))
        })?;
        symbolic
            .factorize_numeric_ldlt(
                &mut values,
                SparseColMatRef::new(matrix.structure(), &matrix.values),
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Spec::default(),
            )
            .map_err(|e| {
                failed(format!(
                    "the matrix cannot be factorised ({e:?}); look for a mechanism or a zero stiffness"
                ))
            })?;
        if values.iter().any(|v| !v.is_finite()) {
            return Err(failed(
                "the factor is not finite; look for a mechanism, a zero stiffness or NaN in the input"
                    .to_owned(),
            ));
        }
        Ok(Factor { symbolic, values })
    }

    /// Number of stored values of the factor.
    pub fn nonzeros(&self) -> usize {
        self.values.len()
    }

    /// Solves `A x = b` in place.
    pub fn solve_in_place(&self, b: &mut [f64]) {
        self.solve_columns(b, 1);
    }

    /// Solves for several right-hand sides at once, one after the other in `b`: the factor is read once for all.
    pub fn solve_columns(&self, b: &mut [f64], columns: usize) {
        if columns == 0 {
            return;
        }
        let mut memory = MemBuffer::new(self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq));
        let rows = b.len() / columns;
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(b, rows, columns),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }
}

fn invert(order: &[u32]) -> Vec<u32> {
    let mut inverse = vec![0; order.len()];
    for (k, &i) in order.iter().enumerate() {
        inverse[i as usize] = k as u32;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chain of springs with a multiplier: quasi-definite, solved in two orders.
    #[test]
    fn solves_a_quasi_definite_matrix_in_any_order() {
        let n = 40;
        let mut t = Triplets::default();
        for i in 0..n {
            t.push(i, i, if i == n - 1 { -1e-3 } else { 2.0 });
            if i > 0 {
                t.push(i, i - 1, -0.9);
            }
        }
        let a = SymmetricMatrix::from_triplets(n, &t);
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = vec![0.0; n];
        a.multiply_add(&x, &mut b);
        for order in [minimum_degree(&a).expect("small"), (0..n as u32).rev().collect()] {
            let factor = Factor::new(&a, &order).expect("it factorises");
            let mut y = b.clone();
            factor.solve_in_place(&mut y);
            let error = x.iter().zip(&y).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
            assert!(error < 1e-11, "{error:e}");
            // Two sides at once, the second one doubled.
            let mut both: Vec<f64> = b.iter().copied().chain(b.iter().map(|v| 2.0 * v)).collect();
            factor.solve_columns(&mut both, 2);
            let twice = x.iter().map(|x| 2.0 * x);
            let error = x.iter().copied().chain(twice).zip(&both).map(|(p, q)| (p - q).abs());
            assert!(error.fold(0.0, f64::max) < 1e-11);
        }
    }

    #[test]
    fn sums_scalings_and_parts_are_those_of_entries() {
        let of = |n: usize, entries: &[(usize, usize, f64)]| {
            let mut t = Triplets::default();
            entries.iter().for_each(|&(r, c, v)| t.push(r, c, v));
            SymmetricMatrix::from_triplets(n, &t)
        };
        let a = of(3, &[(0, 0, 1.0), (2, 0, 2.0), (1, 1, 3.0), (2, 2, 4.0)]);
        let b = of(4, &[(1, 0, 5.0), (2, 0, 6.0), (2, 1, 7.0), (3, 1, 8.0), (3, 3, 9.0)]);
        let entries = |m: &SymmetricMatrix| m.entries().collect::<Vec<_>>();
        let sum = [
            (0, 0, 1.0),
            (1, 0, 5.0),
            (2, 0, 8.0),
            (1, 1, 3.0),
            (2, 1, 7.0),
            (3, 1, 8.0),
            (2, 2, 4.0),
            (3, 3, 9.0),
        ];
        assert_eq!(entries(&a.plus(&b)), sum);
        assert_eq!(
            entries(&a.scaled(&[1.0, 2.0, 3.0])),
            [(0, 0, 1.0), (2, 0, 6.0), (1, 1, 12.0), (2, 2, 36.0)]
        );
        // Without the first unknown.
        assert_eq!(
            entries(&a.plus(&b).principal(&[usize::MAX, 0, 1, 2], 3)),
            entries(&of(3, &[(0, 0, 3.0), (1, 0, 7.0), (2, 0, 8.0), (1, 1, 4.0), (2, 2, 9.0),]))
        );
    }

    #[test]
    fn entries_of_one_place_add_up() {
        let mut t = Triplets::default();
        t.push_block(0, &[1, 0], &[1.0, 2.0, 2.0, 3.0]);
        t.push_block(0, &[0, 1], &[1.0, 2.0, 2.0, 3.0]);
        let a = SymmetricMatrix::from_triplets(2, &t);
        let entries: Vec<_> = a.entries().collect();
        assert_eq!(entries, [(0, 0, 4.0), (1, 0, 4.0), (1, 1, 4.0)]);
    }
}
