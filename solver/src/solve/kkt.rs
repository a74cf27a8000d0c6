//! Equilibrium under constraints: `K u + Bᵀλ = f`, `B u = g`.
//!
//! K alone may be singular: bodies may float and be held by ties only. The unknowns are scaled
//! to a unit diagonal (so that rotations and displacements, soft and stiff bodies weigh
//! alike), B to unit rows. Factorised is the quasi-definite
//!
//! `[K + γBᵀB + δ, Bᵀ; B, −ε]`, γ = 1, ε = 1e-13, δ = 1e-15 in scaled units,
//!
//! and refinement runs on the residual of the *true* system with the right-hand side
//! `[r_u + γBᵀr_λ; r_λ]` (Vanderbei 1995; augmented Lagrangian: Fortin and Glowinski 1983). One pass leaves
//! about ε over the softest constraint's response. ε can be that small because each row is eliminated after its unknowns: its pivot is
//! then `−ε − b·(K + γBᵀB)⁻¹b` and of order one; eliminated before them, it would be −ε alone and `b bᵀ/ε` would drown
//! the stiffness. δ lets a mechanism through to where it is named.

use super::norm::norm;
use super::order::{nested_dissection, rows_after_unknowns};
use super::sparse::{Factor, SymmetricMatrix, Triplets, minimum_degree};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use crate::stage::{Stage, timed};
use crate::work::Work;

const GAMMA: f64 = 1.0;
const DELTA: f64 = 1e-15;
const EPSILON: f64 = 1e-13;
/// A relative residual that is rounding alone: refinement stops.
const SETTLED: f64 = 1e-15;
/// It also stops when the residual no longer halves, at the latest after this many steps.
const MOST_REFINEMENTS: usize = 12;
/// A solution with a larger relative residual is refused, unless rounding alone keeps it there.
pub const LARGEST_RESIDUAL: f64 = 1e-9;
/// Such a solution is taken if one more correction moves it by no more than this, relative to its largest unknown: where
/// `|K||u|` is a million times the load, as in slender beams, the residual says less than the correction does.
pub const LARGEST_CORRECTION: f64 = 1e-6;
/// What rounding leaves of a sum of terms, in units of the last place of the largest sum of their magnitudes.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What the elimination order is made from.
pub struct Layout<'a> {
    /// Plane models are ordered by minimum degree, solid ones by nested dissection.
    pub space: Space,
    /// Point that each unknown belongs to, ascending from 0.
    pub group: &'a [u32],
    /// Position of each point.
    pub positions: &'a [Vec3],
    /// Position of each constraint row.
    pub row_positions: &'a [Vec3],
}

/// A factorised system.
pub struct Kkt {
    stiffness: SymmetricMatrix,
    rows: Vec<Vec<(usize, f64)>>,
    unknown_scale: Vec<f64>,
    row_scale: Vec<f64>,
    factor: Factor,
}

/// Solution of one right-hand side.
#[derive(Debug, Clone)]
pub struct KktSolution {
    /// Unknowns.
    pub u: Vec<f64>,
    /// Multipliers, one per row.
    pub multipliers: Vec<f64>,
    /// Largest residual of the true system relative to the terms it balances.
    pub residual: f64,
}

impl Kkt {
    /// Scales and factorises. `stiffness` is positive semi-definite on the free unknowns.
    ///
    /// # Errors
    /// An unknown without any stiffness or constraint, or a factorisation that fails.
    pub fn new(
        stiffness: &SymmetricMatrix,
        rows: &[Vec<(usize, f64)>],
        layout: &Layout,
        work: &mut Work,
    ) -> Result<Self> {
        let n = stiffness.len();
        let diagonal = stiffness.diagonal();
        if let Some(bad) = diagonal.iter().find(|d| !d.is_finite()) {
            return Err(Error::Solve {
                message: format!("a stiffness is {bad}; look for NaN or infinite input"),
            });
        }
        let largest = diagonal.iter().fold(0.0f64, |m, d| m.max(*d));
        // An unknown without stiffness gets the largest one as its scale: a tie may still hold it.
        let scale_of = |d: &f64| if *d > 1e-14 * largest { 1.0 / d.sqrt() } else { 1.0 / largest.sqrt() };
        let unknown_scale: Vec<f64> = diagonal.iter().map(scale_of).collect();
        let mut scaled_rows: Vec<Vec<(usize, f64)>> = Vec::with_capacity(rows.len());
        let mut row_scale = Vec::with_capacity(rows.len());
        for row in rows {
            let scaled: Vec<(usize, f64)> = row.iter().map(|&(i, b)| (i, b * unknown_scale[i])).collect();
            let norm = scaled.iter().map(|t| t.1 * t.1).sum::<f64>().sqrt();
            row_scale.push(1.0 / norm);
            scaled_rows.push(scaled.into_iter().map(|(i, b)| (i, b / norm)).collect());
        }
        let stiffness = stiffness.scaled(&unknown_scale);
        let mut added = Triplets::with_capacity(n + rows.len());
        (0..n).for_each(|i| added.push(i, i, DELTA));
        for (k, row) in scaled_rows.iter().enumerate() {
            for &(i, bi) in row {
                row.iter().for_each(|&(j, bj)| added.push(i, j, GAMMA * bi * bj));
                added.push(n + k, i, bi);
            }
            added.push(n + k, n + k, -EPSILON);
        }
        let matrix = stiffness.plus(&SymmetricMatrix::from_triplets(n + rows.len(), &added));
        let factor = timed(Stage::Factorisation, || factorise(&matrix, &scaled_rows, layout))?;
        work.factored(factor.nonzeros());
        Ok(Kkt { stiffness, rows: scaled_rows, unknown_scale, row_scale, factor })
    }

    /// Solves for forces `f` and prescribed constraint values `g`.
    ///
    /// # Errors
    /// A residual that refinement cannot bring below [`LARGEST_RESIDUAL`].
    pub fn solve(&self, f: &[f64], g: &[f64], work: &mut Work) -> Result<KktSolution> {
        self.solve_beside(f, g, [&[], &[]], work)
    }

    /// As [`Kkt::solve`], where `f` and the solution are what is left of larger forces and motions that cancelled, as in a
    /// time step near rest: residuals are judged beside these too (forces, then motions, on all unknowns; empty for none).
    ///
    /// # Errors
    /// As [`Kkt::solve`].
    pub fn solve_beside(
        &self,
        f: &[f64],
        g: &[f64],
        [forces, motions]: [&[f64]; 2],
        work: &mut Work,
    ) -> Result<KktSolution> {
        let (n, m) = (f.len(), g.len());
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0f64, |m, v| m.max(v.abs()));
        let beside = [
            largest(&mut forces.iter().zip(&self.unknown_scale).map(|(f, s)| f * s)),
            // A row weighs at most the whole of a motion: unit rows.
            largest(&mut motions.iter().zip(&self.unknown_scale).map(|(u, s)| u / s)),
        ];
        let f: Vec<f64> = f.iter().zip(&self.unknown_scale).map(|(f, s)| f * s).collect();
        let g: Vec<f64> = g.iter().zip(&self.row_scale).map(|(g, s)| g * s).collect();
        let mut x = vec![0.0; n + m];
        let mut best = (f64::INFINITY, x.clone());
        for _ in 0..MOST_REFINEMENTS {
            let (mut r, sizes) = self.residual(&x, &f, &g, beside);
            let now = norm(sizes);
            if !now.is_finite() {
                return Err(Error::Solve {
                    message: "the solution is not finite; look for a mechanism".to_owned(),
                });
            }
            let stalled = now > 0.5 * best.0;
            if now < best.0 {
                best = (now, x.clone());
            }
            if stalled || now <= SETTLED {
                break;
            }
            self.correct(&mut r, work);
            x.iter_mut().zip(&r).for_each(|(x, d)| *x += d);
        }
        let (residual, x) = best;
        if residual > LARGEST_RESIDUAL && !self.is_rounding(&x, &f, &g, beside, work) {
            let message = format!(
                "the residual stays at {residual:.1e} of the forces, above {LARGEST_RESIDUAL:.0e}; \
                 look for a mechanism, contradicting supports or an extreme stiffness contrast"
            );
            return Err(Error::Solve { message });
        }
        Ok(KktSolution {
            u: x[..n].iter().zip(&self.unknown_scale).map(|(x, s)| x * s).collect(),
            multipliers: x[n..].iter().zip(&self.row_scale).map(|(x, s)| x * s).collect(),
            residual,
        })
    }

    /// Whether rounding alone leaves this residual, and leaves the solution good all the same.
    ///
    /// With `r = f − K u − Bᵀλ` at the rounding of its terms, `|r| ≤ c eps |K||u|` (Oettli and Prager 1964), the next
    /// correction is what rounding does to the solution (Skeel 1980): it has to be small beside the solution.
    fn is_rounding(&self, x: &[f64], f: &[f64], g: &[f64], beside: [f64; 2], work: &mut Work) -> bool {
        let n = f.len();
        let (mut r, [_, gap]) = self.residual(x, f, g, beside);
        let rounding = ROUNDING * norm(self.stiffness.multiply_magnitudes(&x[..n]));
        if norm(&r[..n]) > rounding || gap > LARGEST_RESIDUAL {
            return false;
        }
        self.correct(&mut r, work);
        norm(&r[..n]) <= LARGEST_CORRECTION * norm(&x[..n])
    }

    /// Residual of the true scaled system, and the sizes of its two parts relative to the forces and displacements that they
    /// balance. Multipliers are no yardstick: they are large where rows are nearly dependent.
    fn residual(&self, x: &[f64], f: &[f64], g: &[f64], beside: [f64; 2]) -> (Vec<f64>, [f64; 2]) {
        let n = f.len();
        let mut internal = vec![0.0; n];
        self.stiffness.multiply_add(&x[..n], &mut internal);
        let force = norm(&internal).max(norm(f)).max(beside[0]);
        let mut motion = norm(g).max(beside[1]);
        let mut r: Vec<f64> = f.iter().zip(&internal).map(|(f, k)| f - k).chain(g.iter().copied()).collect();
        for (k, row) in self.rows.iter().enumerate() {
            for &(i, b) in row {
                r[i] -= b * x[n + k];
                r[n + k] -= b * x[i];
                motion = motion.max((b * x[i]).abs());
            }
        }
        // A state of rest has nothing to be relative to.
        let relative = |part: &[f64], size: f64| if size > 0.0 { norm(part) / size } else { norm(part) };
        let sizes = [relative(&r[..n], force), relative(&r[n..], motion)];
        (r, sizes)
    }

    /// Unknowns and multipliers for several right-hand sides (forces, row values) by one pass through the factor, not refined: exact to
    /// rounding as long as rows are not nearly dependent. For loops that refine on a residual of their own.
    pub fn apply(&self, sides: &[[&[f64]; 2]], work: &mut Work) -> Vec<[Vec<f64>; 2]> {
        let (n, m) = (self.unknown_scale.len(), self.row_scale.len());
        let mut x = Vec::with_capacity((n + m) * sides.len());
        for [f, g] in sides {
            let from = x.len();
            x.extend(f.iter().zip(&self.unknown_scale).map(|(f, s)| f * s));
            x.extend(g.iter().zip(&self.row_scale).map(|(g, s)| g * s));
            self.augment(&mut x[from..]);
        }
        self.factor.solve_columns(&mut x, sides.len());
        sides.iter().for_each(|_| work.solved(self.factor.nonzeros()));
        let unscaled = |x: &[f64], scale: &[f64]| x.iter().zip(scale).map(|(x, s)| x * s).collect();
        let columns = x.chunks_exact((n + m).max(1));
        columns
            .map(|x| [unscaled(&x[..n], &self.unknown_scale), unscaled(&x[n..], &self.row_scale)])
            .collect()
    }

    /// `[r_u + γBᵀr_λ; r_λ]`.
    fn augment(&self, r: &mut [f64]) {
        let n = self.unknown_scale.len();
        for (k, row) in self.rows.iter().enumerate() {
            row.iter().for_each(|&(i, b)| r[i] += GAMMA * b * r[n + k]);
        }
    }

    /// Applies the factor to a residual.
    fn correct(&self, r: &mut [f64], work: &mut Work) {
        self.augment(r);
        self.factor.solve_in_place(r);
        work.solved(self.factor.nonzeros());
    }

    /// The softest motion and its stiffness relative to a unit diagonal: at the rounding floor it is a mechanism.
    ///
    /// One step of inverse iteration is enough to tell: it enlarges a mechanism by 1/δ.
    pub fn softest_motion(&self, work: &mut Work) -> (Vec<f64>, f64) {
        let n = self.unknown_scale.len();
        // Any start that is not orthogonal to the motion will do; irrational steps repeat no pattern.
        let mut z: Vec<f64> = (0..n).map(|i| (1.0 + i as f64 * 0.754_877_666).sin()).collect();
        z.resize(n + self.rows.len(), 0.0);
        self.factor.solve_in_place(&mut z);
        work.solved(self.factor.nonzeros());
        z.truncate(n);
        let length = dot(&z, &z).sqrt();
        z.iter_mut().for_each(|v| *v /= length);
        let mut internal = vec![0.0; n];
        self.stiffness.multiply_add(&z, &mut internal);
        let gap: f64 =
            self.rows.iter().map(|row| row.iter().map(|&(i, b)| b * z[i]).sum::<f64>().powi(2)).sum();
        let stiffness = dot(&z, &internal).abs() + gap;
        let motion = z.iter().zip(&self.unknown_scale).map(|(x, s)| x * s).collect();
        (motion, stiffness)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn factorise(matrix: &SymmetricMatrix, rows: &[Vec<(usize, f64)>], layout: &Layout) -> Result<Factor> {
    let order = match layout.space {
        Space::Plane => minimum_degree(matrix)?,
        Space::Solid => {
            let points = layout.positions.len() as u32;
            let of_rows = (0..layout.row_positions.len() as u32).map(|k| points + k);
            let group: Vec<u32> = layout.group.iter().copied().chain(of_rows).collect();
            nested_dissection(matrix, &group, &[layout.positions, layout.row_positions].concat())
        }
    };
    Factor::new(matrix, &rows_after_unknowns(&order, rows))
}
