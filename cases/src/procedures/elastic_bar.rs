//! A bar held at its left end, as a chain of particles and as a row of elements: what the two bar cases share.

use super::Setting;
use super::straight::{Chain, hold, plane, rectangle};
use crate::error::Result;
use seam_solver::dem::network::BondStiffness;
use seam_solver::dynamics::critical;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::Vec3;

/// Height of the elements in lengths: their shear, which nothing calls for, must not decide the critical step.
const TALL: f64 = 20.0;

/// Constants of the bar.
#[derive(Debug, Clone, Copy)]
pub struct Bar {
    /// E, in Pa.
    pub young_pa: f64,
    /// ρ, in kg/m³.
    pub density: f64,
    /// L, in m.
    pub length: f64,
    /// A, in m².
    pub section: f64,
    /// Bonds or elements.
    pub cells: usize,
}

/// One of the two bodies.
pub struct Body {
    /// For ids.
    pub id: &'static str,
    /// In words.
    pub name: &'static str,
    /// Free along x only, held at the left.
    pub model: Model,
    /// Unknowns `u_x` at the left end.
    pub left: Vec<usize>,
    /// Those at the right end.
    pub right: Vec<usize>,
    /// All of them that are free.
    pub free: Vec<usize>,
}

impl Bar {
    /// From the parameters of a scene.
    ///
    /// # Errors
    /// A missing parameter.
    pub fn new(setting: &Setting) -> Result<Self> {
        Ok(Bar {
            young_pa: setting.number("young_Pa")?,
            density: setting.number("density_kg_m3")?,
            length: setting.number("length_m")?,
            section: setting.number("section_m2")?,
            cells: setting.count("cells", 4)?,
        })
    }

    /// c = √(E/ρ), in m/s.
    pub fn speed(&self) -> f64 {
        (self.young_pa / self.density).sqrt()
    }

    /// cΔt/h = 1, at which central differences solve the wave equation exactly: the critical step of both bodies, which may
    /// come out a rounding below it.
    ///
    /// # Errors
    /// As [`critical::bound`].
    pub fn exact_step(&self, body: &Body) -> seam_solver::error::Result<f64> {
        let step = self.length / self.cells as f64 / self.speed();
        Ok(step.min(critical::bound(&body.model)?.step_s))
    }

    /// Chain and elements.
    ///
    /// # Errors
    /// Lengths that give no mesh.
    pub fn bodies(&self) -> seam_solver::error::Result<[Body; 2]> {
        let h = self.length / self.cells as f64;
        let kn = self.young_pa * self.section / h;
        let mass = self.density * self.section * h;
        // Bending plays no part, but must not ask for a smaller step.
        let stiffness = BondStiffness { kn, ks: 1e-3 * kn, kb: 1e-3 * kn * h * h, kt: 0.0 };
        let chain = Chain { bonds: self.cells, spacing: h, stiffness, mass, inertia: mass * h * h };
        let height = TALL * h;
        let elasticity = Elasticity { young_pa: self.young_pa, poisson: 0.0, density: self.density };
        let corners = [Vec3::zeros(), Vec3::new(self.length, height, 0.0)];
        let thickness_m = self.section / height;
        let elements =
            rectangle("bar", corners, [self.cells, 1], elasticity, thickness_m, Formulation::Plain)?;
        Ok([
            body("chain", "chain of particles", chain.part()),
            body("elements", "elements", Part::Continuum(elements)),
        ])
    }
}

fn body(id: &'static str, name: &'static str, part: Part) -> Body {
    let mut model = plane(vec![part]);
    hold(&mut model, 0, |x| x.x == 0.0);
    hold(&mut model, 1, |x| x.x > 0.0);
    let numbering = Numbering::new(&model);
    let part = &model.parts[0];
    let along = |points: Vec<usize>| -> Vec<usize> {
        points.into_iter().map(|p| numbering.unknown(0, p, 0)).collect()
    };
    let [left, right] = ["left", "right"].map(|face| along(part.face(face).unwrap_or_default()));
    let free = along((0..part.positions().len()).filter(|&p| part.positions()[p].x > 0.0).collect());
    Body { id, name, model, left, right, free }
}
