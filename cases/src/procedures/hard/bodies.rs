//! Bodies of the hard cases, each in the plane and in space.

use crate::error::Result;
use crate::procedures::Setting;
use crate::procedures::straight::hold;
use seam_solver::coupling::{Method as Tying, Multipliers, Tie};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::{BondStiffness, Network};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::error::Result as Solved;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid, jiggle};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use std::f64::consts::PI;

/// Plane and space, with the word that ids and labels use.
pub const SPACES: [(Space, &str); 2] = [(Space::Plane, "plane"), (Space::Solid, "solid")];

/// Three boxes in a row: elements, particles ([`cubic`]), elements; ν = 0 in all.
#[derive(Debug, Clone, Copy)]
pub struct Sandwich {
    /// Plane or solid.
    pub space: Space,
    /// E of all parts, in Pa.
    pub young_pa: f64,
    /// ρ of all parts, in kg/m³.
    pub density: f64,
    /// Thickness in the plane, in m.
    pub thickness_m: f64,
    /// Side of each box, in m.
    pub side: f64,
    /// Rows of particle spacings.
    pub rows: usize,
    /// Rows of elements, left and right.
    pub elements: [usize; 2],
    /// How the faces are tied.
    pub tying: Tying,
}

impl Sandwich {
    /// From the parameters of a scene, nested and tied pointwise.
    ///
    /// # Errors
    /// A missing parameter.
    pub fn of(setting: &Setting, space: Space) -> Result<Self> {
        let rows = setting.count("rows", 2)?;
        Ok(Sandwich {
            space,
            young_pa: setting.number("young_Pa")?,
            density: setting.number("density_kg_m3")?,
            thickness_m: setting.number("thickness_m")?,
            side: setting.number("side_m")?,
            rows,
            elements: [rows, rows],
            tying: Tying::Pointwise,
        })
    }

    /// Without supports and loads.
    ///
    /// # Errors
    /// Numbers that give no mesh, lattice or bond.
    pub fn model(&self) -> Solved<Model> {
        let middle = Part::Discrete { name: "middle".to_owned(), network: self.network()? };
        let [left, right] = self.elements;
        let parts =
            vec![self.elements("left", 0.0, [2, left])?, middle, self.elements("right", 2.0, [3, right])?];
        let tie = |first: usize, second: usize| Tie {
            name: format!("{first}-{second}"),
            first: (first, "right".to_owned()),
            second: (second, "left".to_owned()),
            method: self.tying,
            multipliers: Multipliers::Auto,
            rotations: false,
        };
        let ties = vec![tie(0, 1), tie(1, 2)];
        Ok(Model { space: self.space, parts, ties, supports: Vec::new(), loads: Vec::new() })
    }

    /// Held at the left, with a transverse force (N) spread over the right face.
    ///
    /// # Errors
    /// As [`Sandwich::model`].
    pub fn cantilever(&self, force: f64) -> Solved<Model> {
        let mut model = self.model()?;
        hold(&mut model, 0, |x| x.x < 1e-9 * self.side);
        let end = model.parts[2].face("right").unwrap_or_default();
        let value = -force / end.len() as f64;
        let load = |point| PointValue { part: 2, point, component: 1, value };
        model.loads = end.into_iter().map(load).collect();
        Ok(model)
    }

    fn corner(&self, x: f64, across: f64) -> Vec3 {
        let depth = if self.space == Space::Solid { across } else { 0.0 };
        Vec3::new(x, across, depth) * self.side
    }

    fn elements(&self, name: &str, x: f64, [along, across]: [usize; 2]) -> Solved<Part> {
        let (low, high) = (self.corner(x, 0.0), self.corner(x + 1.0, 1.0));
        let lines = |i: usize| even(low[i], high[i], if i == 0 { along } else { across });
        let axes = (0..self.space.dim()).map(lines).collect::<Solved<Vec<_>>>()?;
        let elasticity = Elasticity { young_pa: self.young_pa, poisson: 0.0, density: self.density };
        Ok(Part::Continuum(Continuum {
            name: name.to_owned(),
            mesh: grid(&axes)?,
            elasticity,
            hypothesis: hypothesis(self.space, self.thickness_m),
            formulation: Formulation::Incompatible,
        }))
    }

    fn network(&self) -> Solved<Network> {
        let block = Block::new(self.space, self.corner(1.0, 0.0), self.corner(2.0, 1.0))?;
        let matter = Matter { density: self.density, thickness_m: self.thickness_m };
        cubic((self.space, block), self.rows, self.young_pa, matter, Skin::Weighted)
    }
}

/// A square or simple cubic lattice with `k_n = k_s`, that is `3(r/L)² = 1`: isotropic with `E = k_n/t` or `k_n/a` and ν = 0.
///
/// # Errors
/// Numbers that give no lattice or bond.
pub fn cubic(
    (space, block): (Space, Block),
    rows: usize,
    young_pa: f64,
    matter: Matter,
    skin: Skin,
) -> Solved<Network> {
    let kind = match space {
        Space::Plane => LatticeKind::Square,
        Space::Solid => LatticeKind::SimpleCubic,
    };
    let particles = lattice(kind, block, rows, matter)?;
    let a = 2.0 * particles.arrangement.particles.radius[0];
    let ratio = 2.0 / 3f64.sqrt();
    let area = PI * (0.5 * ratio * a).powi(2);
    let across = if space == Space::Plane { matter.thickness_m } else { a };
    let material = BondMaterial { young_pa: young_pa * across * a / area, poisson: 0.3 };
    let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin };
    bond_network(&particles.arrangement, &particles.pairs, &recipe)
}

/// Plane stress or solid.
pub fn hypothesis(space: Space, thickness_m: f64) -> Hypothesis {
    match space {
        Space::Plane => Hypothesis::PlaneStress { thickness_m },
        Space::Solid => Hypothesis::Solid,
    }
}

/// A block of 2 × 1 (× 1) sides of a triangular or face-centred cubic lattice, with cylinder bonds.
///
/// # Errors
/// Numbers that give no lattice or bond.
pub fn close_packed(
    space: Space,
    side: f64,
    rows: usize,
    material: BondMaterial,
    ratio: f64,
    matter: Matter,
) -> Solved<Network> {
    let depth = if space == Space::Solid { side } else { 0.0 };
    let block = Block::new(space, Vec3::zeros(), Vec3::new(2.0 * side, side, depth))?;
    let kind = match space {
        Space::Plane => LatticeKind::Triangular,
        Space::Solid => LatticeKind::FaceCentredCubic,
    };
    let particles = lattice(kind, block, rows, matter)?;
    let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin: Skin::Weighted };
    bond_network(&particles.arrangement, &particles.pairs, &recipe)
}

/// The same from the parameters of a scene.
///
/// # Errors
/// A missing parameter; numbers that give no lattice or bond.
pub fn close_packed_of(setting: &Setting, space: Space) -> Result<Network> {
    let material =
        BondMaterial { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? };
    let matter =
        Matter { density: setting.number("density_kg_m3")?, thickness_m: setting.number("thickness_m")? };
    let (side, ratio, rows) =
        (setting.number("side_m")?, setting.number("radius_ratio")?, setting.count("rows", 1)?);
    close_packed(space, side, rows, material, ratio, matter).map_err(|e| setting.solver(e))
}

/// A block of 2 × 1 (× 1) sides of elements, inner nodes moved at random by a share of the shortest edge.
///
/// # Errors
/// Numbers that give no mesh.
pub fn distorted(
    space: Space,
    side: f64,
    rows: usize,
    elasticity: Elasticity,
    (hypothesis, formulation): (Hypothesis, Formulation),
    share: f64,
) -> Solved<Continuum> {
    let lines =
        |i: usize| even(0.0, if i == 0 { 2.0 * side } else { side }, if i == 0 { 2 * rows } else { rows });
    let axes = (0..space.dim()).map(lines).collect::<Solved<Vec<_>>>()?;
    let mut mesh = grid(&axes)?;
    jiggle(&mut mesh, share, 11);
    Ok(Continuum { name: "block".to_owned(), mesh, elasticity, hypothesis, formulation })
}

/// One body without supports and loads.
pub fn alone(part: Part) -> Model {
    Model {
        space: part.space(),
        parts: vec![part],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    }
}

/// One network as a body.
pub fn bonded(network: Network) -> Model {
    alone(Part::Discrete { name: "block".to_owned(), network })
}

/// Makes the particles of a model stiffer and heavier.
pub fn scale(model: &mut Model, stiffer: f64, heavier: f64) {
    for part in &mut model.parts {
        let Part::Discrete { network, .. } = part else { continue };
        for k in &mut network.bonds.stiffness {
            let BondStiffness { kn, ks, kb, kt } = *k;
            *k = BondStiffness { kn: kn * stiffer, ks: ks * stiffer, kb: kb * stiffer, kt: kt * stiffer };
        }
        let particles = &mut network.particles;
        particles.mass.iter_mut().chain(&mut particles.inertia).for_each(|m| *m *= heavier);
    }
}
