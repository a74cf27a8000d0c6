//! Finite elements: meshes, elements, elasticity, assembly.

pub mod elasticity;
pub mod element;
pub mod facets;
pub mod h8;
pub mod locate;
pub mod mesh;
pub mod q4;
pub mod quadrature;
pub mod sample;
pub mod structured;
pub mod trace;
