//! Foreign numbers that results are compared with, each with its provenance.
//!
//! A reference is two files: `data/<case>/<source>.csv` holds the numbers, `<source>.toml` beside it
//! says where they come from, in which units, and the SHA-256 of the CSV. Both are written by a
//! script in `generators/` and by nothing else. Numbers can only be read through
//! [`Reference::open`], which refuses a table that is not the one its provenance describes.
//!
//! SHA-256 because every generator and every reader already has it (`hashlib`, `sha256sum`).

mod catalogue;
mod dataset;
mod hash;
mod problem;
mod provenance;
mod reference;
mod table;
mod unit;

pub use catalogue::{all, find, from_folder, in_folder};
pub use dataset::Dataset;
pub use hash::Sha256;
pub use problem::{Problem, Result};
pub use provenance::{Column, Kind, Provenance, Repeat};
pub use reference::Reference;
pub use unit::Unit;

/// Whether a reference is whole: provenance complete, hash as recorded, columns as described, every number finite.
///
/// # Errors
/// The first [`Problem`] found.
pub fn verify(reference: &Reference) -> Result<()> {
    reference.open().map(drop)
}
