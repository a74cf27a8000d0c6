//! A small block of a solid lattice: what rigid rotation and the long run share.

use super::Setting;
use crate::error::Result;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::space::{Space, Vec3};

/// A face-centred cubic block, longer than wide: bonds of all weights in six directions.
///
/// # Errors
/// A missing parameter; a lattice that does not fit the block.
pub fn block(setting: &Setting) -> Result<Network> {
    let (side, density) = (setting.number("side_m")?, setting.number("density_kg_m3")?);
    let material =
        BondMaterial { young_pa: setting.number("young_Pa")?, poisson: setting.number("poisson")? };
    let rows = setting.count("rows", 1)?;
    let ratio = setting.number("radius_ratio")?;
    let built = || {
        let block = Block::at_origin(Space::Solid, Vec3::new(2.0 * side, side, side))?;
        let matter = Matter { density, thickness_m: 1.0 };
        let particles = lattice(LatticeKind::FaceCentredCubic, block, rows, matter)?;
        let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin: Skin::Weighted };
        bond_network(&particles.arrangement, &particles.pairs, &recipe)
    };
    built().map_err(|e| setting.solver(e))
}

/// Smooth and without symmetry: component `i` of a vector that is as large as `amplitude`.
pub fn wave(i: usize, amplitude: f64) -> f64 {
    amplitude * (2.3 * i as f64 + 0.4).sin()
}
