//! The small dense matrix `C = D⁻¹ − VᵀZ` of a low-rank update, and its growing Cholesky factor.

/// A factor pivot below this share of its diagonal entry has lost so many digits that the whole matrix is factorised anew.
const LEAST_PIVOT: f64 = 1e-8;

/// Lower triangles of `VᵀZ` and of the factor L of `C = LLᵀ`; both grow by rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Capacitance {
    products: Vec<Vec<f64>>,
    loss: Vec<f64>,
    factor: Vec<Vec<f64>>,
}

impl Capacitance {
    /// Number of modes.
    pub fn len(&self) -> usize {
        self.loss.len()
    }

    /// Adds a mode: its row of `VᵀZ` up to the diagonal, and its loss D.
    pub fn push(&mut self, products: Vec<f64>, loss: f64) {
        self.products.push(products);
        self.loss.push(loss);
    }

    /// Changes the loss of a mode; rows of the factor from there on are made again.
    pub fn set_loss(&mut self, mode: usize, loss: f64) {
        self.loss[mode] = loss;
        self.factor.truncate(mode);
    }

    /// Losses D of all modes: the shares of stiffness they no longer have.
    pub fn losses(&self) -> &[f64] {
        &self.loss
    }

    /// Completes the factor; `false` where a pivot is lost in rounding.
    ///
    /// `L_ij = (C_ij − Σ_{k<j} L_ik L_jk)/L_jj`, `L_ii² = C_ii − Σ L_ik²`.
    pub fn factorise(&mut self) -> bool {
        for i in self.factor.len()..self.len() {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..i {
                let sum = -self.products[i][j] - dot(&row, &self.factor[j][..j]);
                row.push(sum / self.factor[j][j]);
            }
            let scale = 1.0 / self.loss[i];
            let pivot = scale - self.products[i][i] - dot(&row, &row);
            // Not a number fails too.
            if pivot.is_nan() || pivot <= LEAST_PIVOT * scale {
                return false;
            }
            row.push(pivot.sqrt());
            self.factor.push(row);
        }
        true
    }

    /// Solves `C y = t`.
    pub fn solve(&self, mut y: Vec<f64>) -> Vec<f64> {
        for i in 0..y.len() {
            y[i] = (y[i] - dot(&self.factor[i][..i], &y[..i])) / self.factor[i][i];
        }
        for i in (0..y.len()).rev() {
            y[i] /= self.factor[i][i];
            let (before, at) = y.split_at_mut(i);
            before.iter_mut().zip(&self.factor[i]).for_each(|(b, l)| *b -= l * at[0]);
        }
        y
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
