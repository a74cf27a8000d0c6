//! Reading a network.

use super::table::{Row, Table};
use crate::dem::block::Block;
use crate::dem::bond::BondMaterial;
use crate::dem::network::{BondStiffness, Bonds, Network, Particles};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use std::collections::BTreeMap;
use std::path::Path;

const STIFFNESSES: [&str; 4] = ["kn", "ks", "kb", "kt"];

/// Reads a network from two files. Its faces are the particles on the sides of the box around all centres.
///
/// # Errors
/// A file that cannot be read, or anything in it that is not a network: the message names file, line, column and value.
pub fn read(space: Space, particles: &Path, bonds: &Path) -> Result<Network> {
    let load = |path: &Path| {
        std::fs::read(path).map_err(|e| Error::File {
            file: path.display().to_string(),
            line: None,
            message: format!("{e}; check the path"),
        })
    };
    let (p, b) = (load(particles)?, load(bonds)?);
    parse(space, (&particles.display().to_string(), &p), (&bonds.display().to_string(), &b))
}

/// Parses a network from the names (for messages) and contents of two files.
///
/// # Errors
/// As for [`read`].
pub fn parse(space: Space, particles: (&str, &[u8]), bonds: (&str, &[u8])) -> Result<Network> {
    let (particles, index) = parse_particles(space, particles.0, particles.1)?;
    let bonds = parse_bonds(bonds.0, bonds.1, &particles, &index)?;
    let faces = faces(space, &particles.position);
    Ok(Network { space, particles, bonds, faces })
}

fn parse_particles(space: Space, file: &str, bytes: &[u8]) -> Result<(Particles, BTreeMap<i64, usize>)> {
    let table = Table::parse(file, bytes, &["id", "x", "y", "z", "radius", "mass"], &["inertia"])?;
    let mut particles = Particles::default();
    let mut index = BTreeMap::new();
    for row in table.rows() {
        let id = row.id("id")?;
        if index.insert(id, particles.len()).is_some() {
            return Err(row.error("id", &format!("particle {id} comes twice; give each its own id")));
        }
        let z = row.number("z")?;
        if space == Space::Plane && z != 0.0 {
            return Err(row.error("z", &format!("{z} must be 0 in a plane model")));
        }
        let positive = |column| row.number_that(column, |v| v > 0.0, "positive");
        let (radius, mass) = (positive("radius")?, positive("mass")?);
        particles.position.push(Vec3::new(row.number("x")?, row.number("y")?, z));
        particles.radius.push(radius);
        particles.mass.push(mass);
        let inertia = if row.has("inertia") { positive("inertia")? } else { 0.4 * mass * radius * radius };
        particles.inertia.push(inertia);
    }
    if particles.is_empty() {
        return Err(Error::File {
            file: file.to_owned(),
            line: None,
            message: "no particles; add at least one line below the header".into(),
        });
    }
    Ok((particles, index))
}

fn parse_bonds(
    file: &str,
    bytes: &[u8],
    particles: &Particles,
    index: &BTreeMap<i64, usize>,
) -> Result<Bonds> {
    let optional = ["weight", "kn", "ks", "kb", "kt"];
    let table = Table::parse(file, bytes, &["i", "j", "young_Pa", "poisson", "radius_m"], &optional)?;
    let mut bonds = Bonds::default();
    let mut seen: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for row in table.rows() {
        let end = |column| {
            let id = row.id(column)?;
            index.get(&id).copied().ok_or_else(|| row.error(column, &format!("there is no particle {id}")))
        };
        let (i, j) = (end("i")?, end("j")?);
        let length = (particles.position[j] - particles.position[i]).norm();
        if !length.is_normal() {
            return Err(
                row.error("j", "both ends are in the same place (or beyond all bounds); a bond needs two")
            );
        }
        if let Some(line) = seen.insert([i.min(j), i.max(j)], row.line()) {
            return Err(
                row.error("j", &format!("these particles are already bonded in line {line}; remove one"))
            );
        }
        let radius = row.number_that("radius_m", |v| v > 0.0, "positive")?;
        bonds.ends.push([i, j]);
        bonds.radius.push(radius);
        bonds.stiffness.push(stiffness(&row, radius, length)?);
        let share = |v| (0.0..=1.0).contains(&v);
        bonds.weight.push(if row.has("weight") {
            row.number_that("weight", share, "from 0 to 1")?
        } else {
            1.0
        });
    }
    Ok(bonds)
}

/// The given stiffnesses, or those of the cylinder.
fn stiffness(row: &Row, radius: f64, length: f64) -> Result<BondStiffness> {
    let material = BondMaterial {
        young_pa: row.number_that("young_Pa", |v| v > 0.0, "positive")?,
        poisson: row.number_that("poisson", |v| v > -1.0 && v <= 0.5, "above -1 and up to 0.5")?,
    };
    if !STIFFNESSES.iter().any(|k| row.has(k)) {
        let k = material.cylinder(radius, length);
        let all = [k.kn, k.ks, k.kb, k.kt];
        let is_usable = all.iter().all(|k| k.is_finite());
        return is_usable.then_some(k).ok_or_else(|| {
            row.error(
                "radius_m",
                &format!("stiffnesses {all:?} of the cylinder are beyond all bounds; check the units"),
            )
        });
    }
    let given = |column| {
        if !row.has(column) {
            return Err(row.error(column, "empty; give all of kn, ks, kb, kt or none"));
        }
        row.number_that(column, |v| v >= 0.0, "zero or positive")
    };
    let [kn, ks, kb, kt] = STIFFNESSES.map(given);
    Ok(BondStiffness { kn: kn?, ks: ks?, kb: kb?, kt: kt? })
}

/// Particles on the sides of the box around all centres; none where the centres span no box.
fn faces(space: Space, position: &[Vec3]) -> BTreeMap<String, Vec<usize>> {
    let (mut min, mut max) = (position[0], position[0]);
    for x in position {
        (min, max) = (min.inf(x), max.sup(x));
    }
    Block::new(space, min, max)
        .map_or_else(|_| BTreeMap::new(), |block| block.points_on_faces(space, position))
}
