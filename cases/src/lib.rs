//! Scene files, the catalogue of benchmark cases, and running them.
//!
//! The road: scene file → model → solution → observation → [`result::CaseResult`].

pub mod expression;
pub mod names;
pub mod result;
