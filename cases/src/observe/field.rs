//! The displacement and stress fields of a model in some state at any point.

use super::moving_least_squares as mls;
use seam_solver::error::Result;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::locate::Locator;
use seam_solver::fem::stress::{Stress, stress_at};
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::{Space, Vec3};

/// A point may lie outside a body by this share of its size: rounding of coordinates.
const TOUCH: f64 = 1e-9;

/// The solved model, ready to be sampled.
pub struct Field<'a> {
    /// Plane or solid.
    pub space: Space,
    /// One per part of the model, in its order.
    pub parts: Vec<PartField<'a>>,
}

/// One solved part.
pub struct PartField<'a> {
    /// The part.
    pub part: &'a Part,
    /// Smallest and largest coordinates, in m.
    pub bounds: (Vec3, Vec3),
    /// Displacement of each node or particle, in m.
    pub displacement: Vec<Vec3>,
    way: Way<'a>,
}

enum Way<'a> {
    Elements { body: &'a Continuum, locator: Box<Locator<'a>>, unknowns: &'a [f64] },
    Particles { spacing: f64 },
}

impl<'a> Field<'a> {
    /// Prepares the displacements and rotations `u` of all unknowns, in m and rad.
    pub fn new(model: &'a Model, u: &'a [f64]) -> Self {
        let numbering = Numbering::new(model);
        let dim = model.space.dim();
        let part = |(index, part): (usize, &'a Part)| {
            let positions = part.positions();
            let mut bounds = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
            for x in positions {
                bounds = (bounds.0.inf(x), bounds.1.sup(x));
            }
            let at = |point: usize| {
                let first = numbering.unknown(index, point, 0);
                Vec3::from_fn(|c, _| if c < dim { u[first + c] } else { 0.0 })
            };
            let displacement = (0..positions.len()).map(at).collect();
            let way = match part {
                Part::Continuum(body) => {
                    let first = numbering.offset(index);
                    let unknowns = &u[first..first + body.dof_count()];
                    Way::Elements { body, locator: Box::new(Locator::new(&body.mesh)), unknowns }
                }
                Part::Discrete { .. } => {
                    Way::Particles { spacing: mls::spacing(model.space, bounds, positions.len()) }
                }
            };
            PartField { part, bounds, displacement, way }
        };
        Self { space: model.space, parts: model.parts.iter().enumerate().map(part).collect() }
    }

    /// Displacement at `x`, in m; elements are asked before particles. `None` outside of all bodies.
    pub fn displacement(&self, x: Vec3) -> Option<Vec3> {
        self.parts
            .iter()
            .find_map(|p| p.interpolate(x))
            .or_else(|| self.parts.iter().find_map(|p| p.average(self.space, x)))
    }

    /// The particles whose displacements are read at `x`, ascending, of the first part that has any there.
    pub fn particles_read_at(&self, x: Vec3) -> Vec<usize> {
        let of = |p: &PartField| match p.way {
            Way::Particles { spacing } => mls::neighbourhood(self.space, p.part.positions(), spacing, x),
            Way::Elements { .. } => Vec::new(),
        };
        self.parts.iter().map(of).find(|near| !near.is_empty()).unwrap_or_default()
    }

    /// Stress at `x`, in Pa; `None` outside of all finite elements.
    ///
    /// # Errors
    /// An inverted element.
    pub fn stress(&self, x: Vec3) -> Result<Option<Stress>> {
        for part in &self.parts {
            if let Way::Elements { body, locator, unknowns } = &part.way
                && let Some(found) = locator.find_nearest(x, TOUCH * part.size())
            {
                return Ok(stress_at(body, unknowns, found.cell, &[found.xi])?.first().copied());
            }
        }
        Ok(None)
    }
}

impl PartField<'_> {
    fn size(&self) -> f64 {
        (self.bounds.1 - self.bounds.0).amax()
    }

    /// Mean spacing of particles, in m; `None` for elements.
    pub fn spacing(&self) -> Option<f64> {
        if let Way::Particles { spacing } = self.way { Some(spacing) } else { None }
    }

    /// Whether `x` lies within the bounds along one axis.
    pub fn spans(&self, axis: usize, x: f64) -> bool {
        let margin = TOUCH * self.size();
        self.bounds.0[axis] - margin <= x && x <= self.bounds.1[axis] + margin
    }

    /// By shape functions; `None` for particles and outside.
    pub fn interpolate(&self, x: Vec3) -> Option<Vec3> {
        let Way::Elements { locator, .. } = &self.way else { return None };
        let found = locator.find_nearest(x, TOUCH * self.size())?;
        Some(found.weights.iter().map(|&(node, n)| self.displacement[node] * n).sum())
    }

    /// By moving least squares; `None` for elements and outside.
    fn average(&self, space: Space, x: Vec3) -> Option<Vec3> {
        let Way::Particles { spacing } = self.way else { return None };
        if !(0..space.dim()).all(|axis| self.spans(axis, x[axis])) {
            return None;
        }
        mls::value(space, self.part.positions(), &self.displacement, spacing, x)
    }
}
