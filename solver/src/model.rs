//! A model: parts, ties between them, supports and loads; and the numbering of its unknowns.

use crate::coupling::Tie;
use crate::dem::network::Network;
use crate::fem::continuum::Continuum;
use crate::space::{Space, Vec3};

/// A body of a model.
#[derive(Debug, Clone)]
pub enum Part {
    /// Finite elements.
    Continuum(Continuum),
    /// Bonded particles, with the name of the body.
    Discrete {
        /// Name, for messages.
        name: String,
        /// Particles and bonds.
        network: Network,
    },
}

impl Part {
    /// Name of the body.
    pub fn name(&self) -> &str {
        match self {
            Part::Continuum(c) => &c.name,
            Part::Discrete { name, .. } => name,
        }
    }

    /// Plane or solid.
    pub fn space(&self) -> Space {
        match self {
            Part::Continuum(c) => c.mesh.space,
            Part::Discrete { network, .. } => network.space,
        }
    }

    /// Positions of its nodes or particles, in m.
    pub fn positions(&self) -> &[Vec3] {
        match self {
            Part::Continuum(c) => &c.mesh.nodes,
            Part::Discrete { network, .. } => &network.particles.position,
        }
    }

    /// Unknowns per node (2 or 3) or particle (3 or 6).
    pub fn dofs_per_point(&self) -> usize {
        match self {
            Part::Continuum(c) => c.mesh.space.dim(),
            Part::Discrete { network, .. } => network.space.dofs_per_particle(),
        }
    }

    /// Nodes or particles on a named face, ascending; `None` if there is no such face.
    pub fn face(&self, name: &str) -> Option<Vec<usize>> {
        match self {
            Part::Continuum(c) => c.mesh.boundary_nodes(name),
            Part::Discrete { network, .. } => network.faces.get(name).cloned(),
        }
    }

    /// `node` or `particle`.
    pub fn noun(&self) -> &'static str {
        match self {
            Part::Continuum(_) => "node",
            Part::Discrete { .. } => "particle",
        }
    }
}

/// A value on one degree of freedom: a prescribed displacement or rotation (m, rad) or a force or moment (N, N m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointValue {
    /// Index of the part.
    pub part: usize,
    /// Node or particle.
    pub point: usize,
    /// Displacement components first (2 or 3), then rotations (particles only).
    pub component: usize,
    /// The value.
    pub value: f64,
}

/// Parts, ties, supports and loads.
#[derive(Debug, Clone)]
pub struct Model {
    /// Plane or solid; all parts alike.
    pub space: Space,
    /// The bodies.
    pub parts: Vec<Part>,
    /// The ties between their faces.
    pub ties: Vec<Tie>,
    /// Prescribed displacements and rotations.
    pub supports: Vec<PointValue>,
    /// Forces and moments; those on one degree of freedom add up.
    pub loads: Vec<PointValue>,
}

/// Where the unknowns of each part begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Numbering {
    offsets: Vec<usize>,
    per_point: Vec<usize>,
}

impl Numbering {
    /// Numbers all unknowns: parts in order, points in order, components in order.
    pub fn new(model: &Model) -> Self {
        let mut offsets = vec![0];
        let mut per_point = Vec::new();
        for part in &model.parts {
            per_point.push(part.dofs_per_point());
            offsets.push(offsets[offsets.len() - 1] + part.dofs_per_point() * part.positions().len());
        }
        Numbering { offsets, per_point }
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.offsets[self.offsets.len() - 1]
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// First unknown of a part.
    pub fn offset(&self, part: usize) -> usize {
        self.offsets[part]
    }

    /// Unknown of one component of one point.
    pub fn unknown(&self, part: usize, point: usize, component: usize) -> usize {
        self.offsets[part] + point * self.per_point[part] + component
    }

    /// Part, point and component of an unknown.
    pub fn locate(&self, unknown: usize) -> (usize, usize, usize) {
        let part = self.offsets.partition_point(|&o| o <= unknown) - 1;
        let within = unknown - self.offsets[part];
        (part, within / self.per_point[part], within % self.per_point[part])
    }
}
