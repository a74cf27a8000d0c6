//! Plane lattices with a slit from below at mid-span, bent or pulled, which procedures share.

use seam_solver::cracking::{Cracking, Options, Outcome};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, Pair, bond_network};
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::calibration::lattice::calibrate;
use seam_solver::dem::lattice::{Lattice, LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::error::{Error, Result};
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};

/// The body, its lattice and its material.
#[derive(Debug, Clone, Copy)]
pub struct SlitLattice {
    /// [`LatticeKind::TriangularZigzag`] or [`LatticeKind::Square`].
    pub kind: LatticeKind,
    /// Row intervals over the depth.
    pub rows: usize,
    /// Cells along x; the body is as long as they are.
    pub cells: usize,
    /// W, in m.
    pub depth: f64,
    /// B, in m.
    pub thickness: f64,
    /// E (Pa) and ν.
    pub moduli: Moduli,
    /// x of the slit, in m; mid-span is 0.
    pub slit: f64,
    /// Height the slit reaches, in m.
    pub notch: f64,
}

impl SlitLattice {
    /// Height of a row, in m.
    pub fn row(&self) -> f64 {
        self.depth / self.rows as f64
    }

    /// Distance of neighbours along x, in m.
    pub fn spacing(&self) -> f64 {
        match self.kind {
            LatticeKind::Square => self.row(),
            _ => self.row() * 2.0 / 3f64.sqrt(),
        }
    }

    /// Section of the plane that a whole bond stands for, in m²: its Voronoi facet times the thickness.
    pub fn facet(&self) -> f64 {
        match self.kind {
            LatticeKind::Square => self.row() * self.thickness,
            _ => self.spacing() / 3f64.sqrt() * self.thickness,
        }
    }

    /// The network. Bonds that cross the slit are absent.
    ///
    /// # Errors
    /// Sizes or moduli the lattice does not allow.
    pub fn network(&self) -> Result<Network> {
        let half = 0.5 * self.cells as f64 * self.spacing();
        let block = Block::new(Space::Plane, Vec3::new(-half, 0.0, 0.0), Vec3::new(half, self.depth, 0.0))?;
        let matter = Matter { density: 1.0, thickness_m: self.thickness };
        let Lattice { arrangement, pairs, .. } = lattice(self.kind, block, self.rows, matter)?;
        let material = calibrate(self.kind, self.spacing(), self.thickness, self.moduli, 0.3)?;
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: material.bond_young_pa, poisson: material.bond_poisson },
            section: Section::Uniform { ratio: material.radius_ratio },
            skin: Skin::Weighted,
        };
        let x = &arrangement.particles.position;
        let cut =
            |pair: &&Pair| self.crossing(x[pair.ends[0]], x[pair.ends[1]]).is_none_or(|y| y > self.notch);
        let pairs: Vec<Pair> = pairs.iter().filter(cut).copied().collect();
        bond_network(&arrangement, &pairs, &recipe)
    }

    /// Height at which a bond between two particles crosses the line of the slit.
    pub fn crossing(&self, a: Vec3, b: Vec3) -> Option<f64> {
        let share = (self.slit - a.x) / (b.x - a.x);
        ((a.x - self.slit) * (b.x - self.slit) < 0.0).then(|| a.y + share * (b.y - a.y))
    }

    /// The particle at a place, which must be one of the lattice's sites.
    ///
    /// # Errors
    /// No particle within a thousandth of a row.
    pub fn site(&self, network: &Network, x: f64, y: f64) -> Result<usize> {
        let place = Vec3::new(x, y, 0.0);
        let near = |p: &Vec3| (p - place).norm() < 1e-3 * self.row();
        network.particles.position.iter().position(near).ok_or_else(|| Error::Geometry {
            what: "slit lattice".to_owned(),
            message: format!("no particle at ({x}, {y}); choose cells and span to suit"),
        })
    }

    /// Follows the failure of the bonds that `breakable` says may break, each standing for its facet.
    ///
    /// `watch` sees every event with the displacements (m, rad) just before it.
    ///
    /// # Errors
    /// As [`Cracking::new`] and [`Cracking::advance`].
    pub fn crack(
        &self,
        model: &Model,
        law: FailureLaw,
        breakable: impl Fn(Vec3, Vec3) -> bool,
        options: Options,
        mut watch: impl FnMut(&[f64], f64, f64),
    ) -> Result<Outcome> {
        let Part::Discrete { network, name } = &model.parts[0] else {
            return Err(Error::Geometry {
                what: "slit lattice".to_owned(),
                message: "its body has no particles".to_owned(),
            });
        };
        let x = &network.particles.position;
        let may: Vec<bool> = network.bonds.ends.iter().map(|&[i, j]| breakable(x[i], x[j])).collect();
        let area = vec![self.facet(); network.bonds.len()];
        let place = Place { network, body: name, breakable: Some(&may), area_m2: Some(&area) };
        let failure = Failure::new(&FailureRecipe { law, weibull: None }, &place)?;
        let mut cracking = Cracking::new(model, vec![(0, failure)], options)?;
        loop {
            let before = cracking.displacements().to_vec();
            let Some(event) = cracking.advance()? else { break };
            let (factor, force) = (event.factor, event.force);
            let at: Vec<f64> = before.iter().map(|u| factor * u).collect();
            watch(&at, force, event.displacement);
        }
        Ok(cracking.outcome())
    }
}

/// The network as the only body of a model.
pub fn model(network: Network, supports: Vec<PointValue>, loads: Vec<PointValue>) -> Model {
    let parts = vec![Part::Discrete { name: "beam".to_owned(), network }];
    Model { space: Space::Plane, parts, ties: Vec::new(), supports, loads }
}

/// A value on a component of a particle: 0 and 1 displacement or force along x and y.
pub fn on(point: usize, component: usize, value: f64) -> PointValue {
    PointValue { part: 0, point, component, value }
}
