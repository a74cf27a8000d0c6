//! Finite elements: meshes, elements, elasticity, assembly.

pub mod mesh;
