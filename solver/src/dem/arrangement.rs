//! Particles in their places, before they are bonded.

use super::block::Block;
use super::grid::Boundary;
use super::network::Particles;
use super::voronoi;
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use std::collections::BTreeMap;

/// Particles that fill a box, and the faces they lie on.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    /// Plane or solid.
    pub space: Space,
    /// The box they fill.
    pub block: Block,
    /// Whether the box ends at its faces or repeats.
    pub boundary: Boundary,
    /// Thickness of a plane body, in metres; 1 in the solid, where it has no meaning.
    pub thickness_m: f64,
    /// The particles.
    pub particles: Particles,
    /// Particles on each named face; empty lists if the box repeats.
    pub faces: BTreeMap<String, Vec<usize>>,
    /// Neighbours across each facet of a particle's Voronoi (power) cell, and the cell's size.
    pub cells: Vec<voronoi::Cell>,
}

/// The matter a body is made of, as far as particles carry it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matter {
    /// Density, in kg/m³.
    pub density: f64,
    /// Thickness of a plane body, in metres; ignored in the solid.
    pub thickness_m: f64,
}

impl Default for Matter {
    /// Unit density and thickness: for statics, where mass plays no part.
    fn default() -> Self {
        Self { density: 1.0, thickness_m: 1.0 }
    }
}

impl Arrangement {
    /// Places particles of given radii (m). Each gets the mass of its Voronoi (power) cell
    /// clipped by the box, so that the masses add up to `ρV`, and the inertia `0.4 mR²`.
    ///
    /// # Errors
    /// Density or thickness not positive; particles of which one has no cell (coincident ones).
    pub fn new(
        space: Space,
        block: Block,
        boundary: Boundary,
        matter: Matter,
        position: Vec<Vec3>,
        radius: Vec<f64>,
    ) -> Result<Self> {
        let thickness_m = if space == Space::Plane { matter.thickness_m } else { 1.0 };
        for (name, value) in [("density_kg_m3", matter.density), ("thickness_m", thickness_m)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::Material {
                    what: "particles".into(),
                    name,
                    value,
                    mend: "give a positive number",
                });
            }
        }
        let cells = voronoi::cells(space, block, boundary, &position, &radius)?;
        let mass: Vec<f64> = cells.iter().map(|cell| matter.density * thickness_m * cell.measure).collect();
        let inertia = mass.iter().zip(&radius).map(|(m, r)| 0.4 * m * r * r).collect();
        let faces = match boundary {
            Boundary::Closed => block.points_on_faces(space, &position),
            Boundary::Periodic => BTreeMap::new(),
        };
        let particles = Particles { position, radius, mass, inertia };
        Ok(Self { space, block, boundary, thickness_m, particles, faces, cells })
    }
}
