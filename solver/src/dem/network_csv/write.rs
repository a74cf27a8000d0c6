//! Writing a network: what [`super::read`](fn@super::read) gives back bit by bit.

use crate::dem::bond::BondMaterial;
use crate::dem::network::Network;
use crate::error::{Error, Result};
use std::fmt::Write;
use std::path::Path;

/// Content of `particles.csv`; ids are the indices of the particles.
pub fn particles_csv(network: &Network) -> String {
    let p = &network.particles;
    let mut text = String::from("id,x,y,z,radius,mass,inertia\n");
    for i in 0..p.len() {
        let x = p.position[i];
        // `{:?}` is the shortest text that reads back as the same number.
        let _ = writeln!(
            text,
            "{i},{:?},{:?},{:?},{:?},{:?},{:?}",
            x.x, x.y, x.z, p.radius[i], p.mass[i], p.inertia[i]
        );
    }
    text
}

/// Content of `bonds.csv`, stiffnesses included. A network does not keep the material of its bonds: `material` fills the
/// columns that are informative only, since the stiffnesses count.
pub fn bonds_csv(network: &Network, material: BondMaterial) -> String {
    let bonds = &network.bonds;
    let mut text = String::from("i,j,young_Pa,poisson,radius_m,weight,kn,ks,kb,kt\n");
    for b in 0..bonds.len() {
        let ([i, j], k) = (bonds.ends[b], bonds.stiffness[b]);
        let _ = writeln!(
            text,
            "{i},{j},{:?},{:?},{:?},{:?},{:?},{:?},{:?},{:?}",
            material.young_pa, material.poisson, bonds.radius[b], bonds.weight[b], k.kn, k.ks, k.kb, k.kt
        );
    }
    text
}

/// Writes both files.
///
/// # Errors
/// A file that cannot be written.
pub fn write(network: &Network, material: BondMaterial, particles: &Path, bonds: &Path) -> Result<()> {
    let save = |path: &Path, text: String| {
        std::fs::write(path, text).map_err(|e| Error::File {
            file: path.display().to_string(),
            line: None,
            message: format!("{e}; check the folder and its permissions"),
        })
    };
    save(particles, particles_csv(network))?;
    save(bonds, bonds_csv(network, material))
}
