//! What all integrators share: masses, supports, loads and constraint rows.

use super::semidiscrete::{lumped, row_product};
use crate::coupling::Row;
use crate::error::Result;
use crate::model::{Model, Numbering, PointValue};
use crate::solve::norm::norm;
use crate::solve::statics;

/// The constant parts of the equations of motion of a model.
#[derive(Debug, Clone)]
pub struct System {
    /// Numbering of the unknowns.
    pub numbering: Numbering,
    /// Lumped mass of each unknown: kg for displacements, kg m² for rotations.
    pub mass: Vec<f64>,
    /// Prescribed value of each unknown (m, rad) at load factor one, where there is one.
    pub prescribed: Vec<Option<f64>>,
    /// Force on each unknown (N, N m) at load factor one.
    pub load: Vec<f64>,
    /// Independent rows of `C`, on all unknowns.
    pub rows: Vec<Row>,
    /// Rows that were dropped, and why.
    pub notes: Vec<String>,
}

impl System {
    /// Checks a model and gathers its masses, supports, loads and rows.
    ///
    /// # Errors
    /// As [`crate::check::model`]; ties that cannot be made or contradict; a body or particle without mass.
    pub fn new(model: &Model) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let n = numbering.len();
        let mut prescribed = vec![None; n];
        for PointValue { part, point, component, value } in &model.supports {
            prescribed[numbering.unknown(*part, *point, *component)] = Some(*value);
        }
        let mut load = vec![0.0; n];
        for PointValue { part, point, component, value } in &model.loads {
            load[numbering.unknown(*part, *point, *component)] += value;
        }
        let mut place = vec![usize::MAX; n];
        (0..n).filter(|&i| prescribed[i].is_none()).enumerate().for_each(|(k, i)| place[i] = k);
        let tied = statics::constraints(model, &numbering, &prescribed, &place)?;
        let mass = lumped(model, &numbering)?;
        Ok(System { numbering, mass, prescribed, load, rows: tied.rows, notes: tied.notes })
    }

    /// Whether an unknown is prescribed.
    pub fn is_prescribed(&self, unknown: usize) -> bool {
        self.prescribed[unknown].is_some()
    }

    /// Largest gap of a row, in m.
    pub fn gap(&self, u: &[f64]) -> f64 {
        norm(self.rows.iter().map(|row| row_product(&row.terms, u)))
    }
}
