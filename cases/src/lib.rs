//! Scene files, the catalogue of benchmark cases, and running them.
//!
//! The road: scene file → model → solution → observation → [`result::CaseResult`].

pub mod catalogue;
pub mod checkpoint;
pub mod defect;
pub mod error;
pub mod export;
pub mod expression;
pub mod file;
pub mod folder;
pub mod map;
pub mod margin;
pub mod model;
pub mod names;
pub mod observe;
pub mod overrides;
pub mod procedures;
pub mod result;
pub mod scene;
pub mod source;
pub mod study;
pub mod write;
