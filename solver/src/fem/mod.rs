//! Finite elements: meshes, elements, elasticity, assembly.

pub mod assembly;
pub mod continuum;
pub mod elasticity;
pub mod element;
pub mod energy_release;
pub mod facets;
pub mod formulation;
pub mod gmsh;
pub mod h8;
pub mod loads;
pub mod locate;
pub mod manufactured;
pub mod mesh;
pub mod norms;
pub mod notched_beam;
pub mod q4;
pub mod quadrature;
pub mod refined;
pub mod sample;
mod stiffness;
pub mod stress;
pub mod structured;
pub mod trace;
