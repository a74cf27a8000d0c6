//! What still hangs together, and what has come off.
//!
//! Points are joined by bonds that carry something, elements and constraint rows. A piece without any support is *torn off*:
//! its unknowns leave the system. A particle without bonds stays where ties and supports hold it; what holds nothing of it
//! leaves the system too.

use crate::coupling::Row;
use crate::dem::clusters::Clusters;
use crate::model::{Model, Numbering, Part};
use std::collections::BTreeSet;

/// A point counts as moving in a mechanism from this share of the fastest one on.
const MOVING: f64 = 1e-3;

/// The lasting joints of a model, and what was torn off.
#[derive(Debug, Clone)]
pub(super) struct Pieces {
    /// First point of each part, then the number of points.
    first: Vec<usize>,
    /// Elements and ties.
    lasting: Clusters,
    /// Whether a constraint row acts on an unknown.
    tied: Vec<bool>,
    bonded: Vec<bool>,
    torn: BTreeSet<usize>,
    order: Vec<(usize, usize)>,
}

type Released = std::result::Result<Vec<usize>, String>;

impl Pieces {
    pub fn new(model: &Model, numbering: &Numbering, rows: &[Row]) -> Self {
        let mut first = vec![0];
        model.parts.iter().for_each(|p| first.push(first[first.len() - 1] + p.positions().len()));
        let count = first[model.parts.len()];
        let mut lasting = Clusters::new(count);
        for (p, part) in model.parts.iter().enumerate() {
            if let Part::Continuum(body) = part {
                for cell in 0..body.mesh.cell_count() {
                    let nodes = body.mesh.cell(cell);
                    nodes.iter().for_each(|n| {
                        lasting.join(first[p] + nodes[0], first[p] + n);
                    });
                }
            }
        }
        let mut tied = vec![false; numbering.len()];
        let point = |i: usize| {
            let (part, point, _) = numbering.locate(i);
            first[part] + point
        };
        for row in rows {
            for &(i, _) in &row.terms {
                tied[i] = true;
                lasting.join(point(row.terms[0].0), point(i));
            }
        }
        let mut pieces = Pieces {
            first,
            lasting,
            tied,
            bonded: vec![false; count],
            torn: BTreeSet::new(),
            order: Vec::new(),
        };
        pieces.bonded = pieces.bonded_now(model);
        pieces
    }

    /// The pieces of a model some of whose bonds were broken before: what hung on them is still to be taken off.
    pub fn resumed(model: &Model, numbering: &Numbering, rows: &[Row]) -> Self {
        let mut pieces = Pieces::new(model, numbering, rows);
        for (p, part) in model.parts.iter().enumerate() {
            if let Part::Discrete { network, .. } = part {
                network.bonds.ends.iter().flatten().for_each(|&i| pieces.bonded[pieces.first[p] + i] = true);
            }
        }
        pieces
    }

    pub fn torn_off(&self) -> &[(usize, usize)] {
        &self.order
    }

    fn bonded_now(&self, model: &Model) -> Vec<bool> {
        let mut bonded = vec![false; self.bonded.len()];
        bonds(model).for_each(|(p, [i, j])| {
            bonded[self.first[p] + i] = true;
            bonded[self.first[p] + j] = true;
        });
        bonded
    }

    fn clusters(&self, model: &Model) -> Clusters {
        let mut clusters = self.lasting.clone();
        bonds(model).for_each(|(p, [i, j])| {
            clusters.join(self.first[p] + i, self.first[p] + j);
        });
        clusters
    }

    fn place(&self, point: usize) -> (usize, usize) {
        let part = self.first.partition_point(|&f| f <= point) - 1;
        (part, point - self.first[part])
    }

    fn unknowns(&self, model: &Model, numbering: &Numbering, point: usize) -> std::ops::Range<usize> {
        let (part, point) = self.place(point);
        let first = numbering.unknown(part, point, 0);
        first..first + model.parts[part].dofs_per_point()
    }

    /// Takes off what hangs on no support. Gives the unknowns that leave the system, or, in words, what of it was loaded.
    pub fn release(
        &mut self,
        model: &Model,
        numbering: &Numbering,
        prescribed: &[Option<f64>],
        loaded: impl Fn(usize) -> bool,
    ) -> Released {
        let mut clusters = self.clusters(model);
        let mut held = vec![false; self.bonded.len()];
        for (part, body) in model.parts.iter().enumerate() {
            for p in 0..body.positions().len() {
                let point = self.first[part] + p;
                let supported = self.unknowns(model, numbering, point).any(|i| prescribed[i].is_some());
                if supported && !self.torn.contains(&point) {
                    held[clusters.root(point)] = true;
                }
            }
        }
        let loose: Vec<usize> = (0..held.len()).filter(|&p| !held[clusters.root(p)]).collect();
        let mut fixed = self.take_off(model, numbering, &loose, &loaded)?;
        let bonded = self.bonded_now(model);
        for point in 0..bonded.len() {
            if self.bonded[point] && !bonded[point] && !self.torn.contains(&point) {
                let free = self.unknowns(model, numbering, point);
                let loose: Vec<usize> = free.filter(|&i| prescribed[i].is_none() && !self.tied[i]).collect();
                if loose.iter().any(|&i| loaded(i)) {
                    return Err(self.lost_load(model, point));
                }
                fixed.extend(loose);
                self.torn.insert(point);
                self.order.push(self.place(point));
            }
        }
        self.bonded = bonded;
        Ok(fixed)
    }

    /// Takes off the pieces that move in a mechanism. Gives the unknowns that leave the system, or what of it was loaded.
    pub fn release_moving(
        &mut self,
        model: &Model,
        numbering: &Numbering,
        motion: &[f64],
        loaded: impl Fn(usize) -> bool,
    ) -> Released {
        let count = self.bonded.len();
        let speed: Vec<f64> = (0..count)
            .map(|p| self.unknowns(model, numbering, p).map(|i| motion[i] * motion[i]).sum::<f64>().sqrt())
            .collect();
        let top = speed.iter().fold(0.0f64, |m, v| m.max(*v));
        let mut clusters = self.clusters(model);
        let moving: BTreeSet<usize> =
            (0..count).filter(|&p| speed[p] > MOVING * top).map(|p| clusters.root(p)).collect();
        let loose: Vec<usize> = (0..count).filter(|&p| moving.contains(&clusters.root(p))).collect();
        let before = self.torn.len();
        let fixed = self.take_off(model, numbering, &loose, &loaded)?;
        if self.torn.len() == before {
            return Err("what is left moves without resistance".to_owned());
        }
        Ok(fixed)
    }

    fn take_off(
        &mut self,
        model: &Model,
        numbering: &Numbering,
        points: &[usize],
        loaded: impl Fn(usize) -> bool,
    ) -> Released {
        let new: Vec<usize> = points.iter().copied().filter(|p| !self.torn.contains(p)).collect();
        for &point in &new {
            if self.unknowns(model, numbering, point).any(&loaded) {
                return Err(self.lost_load(model, point));
            }
        }
        let mut fixed = Vec::new();
        for point in new {
            self.torn.insert(point);
            self.order.push(self.place(point));
            fixed.extend(self.unknowns(model, numbering, point));
        }
        Ok(fixed)
    }

    fn lost_load(&self, model: &Model, point: usize) -> String {
        let (part, point) = self.place(point);
        let body = &model.parts[part];
        format!("{} {point} of body '{}' carries load and is no longer held", body.noun(), body.name())
    }
}

/// Bonds that carry something, with their part.
fn bonds(model: &Model) -> impl Iterator<Item = (usize, [usize; 2])> + '_ {
    model.parts.iter().enumerate().flat_map(|(p, part)| {
        let network = match part {
            Part::Discrete { network, .. } => Some(network),
            Part::Continuum(_) => None,
        };
        network.into_iter().flat_map(move |network| {
            let ends = network.bonds.ends.iter().zip(&network.bonds.weight);
            ends.filter(|(_, w)| **w > 0.0).map(move |(e, _)| (p, *e))
        })
    })
}
