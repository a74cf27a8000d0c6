//! A compact coupled solver: finite elements, bonded discrete elements, and Lagrange
//! multipliers that tie them without overlap.
//!
//! It knows no scene file, no reference and no report: a [`model::Model`] goes in, a
//! solution with its residual and its [`work::Work`] comes out.

pub mod check;
pub mod checkpoint;
pub mod contact;
pub mod coupling;
pub mod cracking;
pub mod dem;
pub mod dynamics;
pub mod error;
pub mod failure;
pub mod fem;
pub mod files;
pub mod fracture_mechanics;
pub mod limits;
pub mod model;
pub mod simulation;
pub mod solve;
pub mod space;
pub mod stage;
pub mod transfer;
pub mod vtu;
pub mod work;
