//! A stress criterion that is asked of one body again and again: what does not change between the questions is kept.

use super::criterion::{Criterion, Indicator};
use super::region::{centre, measure};
use crate::dem::block::Block;
use crate::dem::grid::{Boundary, Grid};
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::fem::mesh::Mesh;
use crate::fem::stress::{Stress, centre_operator};
use crate::space::Vec3;

/// Stress at the centres of all cells as a linear function of the displacements, and which cells are averaged with which.
pub struct Watch {
    strength: f64,
    /// Six rows per cell, as of [`centre_operator`].
    operators: Vec<f64>,
    /// Degrees of freedom of a cell.
    width: usize,
    /// Area (m²) or volume (m³) of each cell.
    size: Vec<f64>,
    /// `around[first[c]..first[c + 1]]` are averaged for cell c.
    around: Vec<u32>,
    first: Vec<usize>,
    stress: Vec<[f64; 6]>,
    values: Vec<f64>,
}

impl Watch {
    /// Prepares all cells of a body.
    ///
    /// # Errors
    /// As [`Criterion::check`]; a criterion other than stress; an inverted element.
    pub fn new(criterion: &Criterion, body: &Continuum) -> Result<Self> {
        criterion.check()?;
        let Indicator::Stress { strength_pa, length_m } = criterion.indicator else {
            let message = "an estimated error has nothing to keep; ask it anew, or take stress".to_owned();
            return Err(Error::Switch { what: "criterion".to_owned(), message });
        };
        let mesh = &body.mesh;
        let cells = mesh.cell_count();
        let mut operators = Vec::new();
        for cell in 0..cells {
            operators.extend(centre_operator(body, cell)?);
        }
        let centres: Vec<Vec3> = (0..cells).map(|c| centre(mesh, c)).collect();
        // As Criterion::values: centres at just this distance count.
        let radius = 0.5 * length_m * (1.0 + 1e-9);
        let (mut around, mut first) = (Vec::new(), vec![0]);
        let box_of = centres.iter().map(|&x| Block { min: x, max: x }).reduce(|a, b| a.around(&b));
        let grid = box_of
            .filter(|_| radius > 0.0)
            .map(|block| Grid::new(mesh.space, block, Boundary::Closed, &centres, radius));
        for (cell, x) in centres.iter().enumerate() {
            match &grid {
                Some(grid) => grid.for_each_within(*x, radius, |near| around.push(near.point as u32)),
                None => around.push(cell as u32),
            }
            first.push(around.len());
        }
        Ok(Watch {
            strength: strength_pa.unwrap_or(f64::INFINITY),
            width: if cells > 0 { operators.len() / (6 * cells) } else { 0 },
            operators,
            size: (0..cells).map(|c| measure(mesh, c)).collect(),
            around,
            first,
            stress: vec![[0.0; 6]; cells],
            values: vec![0.0; cells],
        })
    }

    /// The indicator of every cell that is `left`, zero of the others, which are averaged with none; `u` (m) over all degrees of
    /// freedom of the body of mesh `mesh`.
    pub fn values(&mut self, mesh: &Mesh, u: &[f64], left: &[bool]) -> &[f64] {
        let dim = mesh.space.dim();
        for cell in (0..left.len()).filter(|&c| left[c]) {
            let rows = &self.operators[cell * 6 * self.width..(cell + 1) * 6 * self.width];
            let mut stress = [0.0; 6];
            for (a, &node) in mesh.cell(cell).iter().enumerate() {
                for i in 0..dim {
                    let (column, u) = (a * dim + i, u[node * dim + i]);
                    stress.iter_mut().enumerate().for_each(|(r, s)| *s += rows[r * self.width + column] * u);
                }
            }
            self.stress[cell] = stress;
        }
        for cell in 0..left.len() {
            self.values[cell] =
                if left[cell] { self.averaged(cell, left).largest() / self.strength } else { 0.0 };
        }
        &self.values
    }

    fn averaged(&self, cell: usize, left: &[bool]) -> Stress {
        let (mut sum, mut whole) = ([0.0; 6], 0.0);
        for &near in &self.around[self.first[cell]..self.first[cell + 1]] {
            let near = near as usize;
            if left[near] {
                sum.iter_mut().zip(self.stress[near]).for_each(|(s, v)| *s += v * self.size[near]);
                whole += self.size[near];
            }
        }
        Stress { voigt: sum.map(|s| s / whole) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::elasticity::{Elasticity, Hypothesis};
    use crate::fem::formulation::Formulation;
    use crate::fem::notched_beam::{NotchedBeam, Through};
    use crate::fem::refined::Refinement;
    use crate::transfer::criterion::Memory;

    /// What is kept gives what is computed anew, on a mesh with a notch, whether stress is averaged or not.
    #[test]
    fn a_watch_sees_what_the_criterion_sees() {
        let beam = NotchedBeam { length: 4.0, depth: 1.0, notch_depth: 0.3, angle: 1.0, reach: 0.5 };
        let by = Refinement { finest: 0.05, growth: 1.4, coarsest: 0.3 };
        let body = Continuum {
            name: "beam".to_owned(),
            mesh: beam.mesh(by, &Through::default()).unwrap().mesh,
            elasticity: Elasticity { young_pa: 2.0, poisson: 0.25, density: 1.0 },
            hypothesis: Hypothesis::PlaneStress { thickness_m: 0.1 },
            formulation: Formulation::Incompatible,
        };
        let u: Vec<f64> = (0..body.dof_count()).map(|i| (0.7 * i as f64).sin()).collect();
        let all = vec![true; body.mesh.cell_count()];
        for length_m in [0.0, 0.2] {
            let criterion = Criterion {
                indicator: Indicator::Stress { strength_pa: Some(5.0), length_m },
                trigger: 0.5,
                buffer_m: 0.0,
                memory: Memory::Irreversible,
            };
            let anew = criterion.values(&body, &u).unwrap();
            let mut watch = Watch::new(&criterion, &body).unwrap();
            let kept = watch.values(&body.mesh, &u, &all);
            let largest = anew.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            for (a, b) in anew.iter().zip(kept) {
                assert!((a - b).abs() < 1e-12 * largest, "{length_m}: {a} {b}");
            }
            let mut some = all.clone();
            some[0] = false;
            let values = watch.values(&body.mesh, &u, &some);
            assert!(values[0] == 0.0 && values.iter().all(|v| v.is_finite()));
        }
    }

    #[test]
    fn an_estimated_error_is_refused() {
        let criterion = Criterion {
            indicator: Indicator::Error,
            trigger: 1.0,
            buffer_m: 0.0,
            memory: Memory::Irreversible,
        };
        let body = Continuum {
            name: "none".to_owned(),
            mesh: crate::fem::structured::mapped(
                &[vec![0.0, 1.0], vec![0.0, 1.0]],
                crate::fem::structured::BOX_SIDES,
                |x| x,
            )
            .unwrap(),
            elasticity: Elasticity { young_pa: 1.0, poisson: 0.0, density: 1.0 },
            hypothesis: Hypothesis::PlaneStress { thickness_m: 1.0 },
            formulation: Formulation::Plain,
        };
        assert!(Watch::new(&criterion, &body).is_err());
    }
}
