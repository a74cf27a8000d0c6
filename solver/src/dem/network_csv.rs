//! Networks from and to `particles.csv` and `bonds.csv`, so that anyone can bring one from another code.
//!
//! `particles.csv`: `id,x,y,z,radius,mass` and optionally `inertia` (else `0.4 mR²`); ids are any whole numbers, SI units.
//! `bonds.csv`: `i,j,young_Pa,poisson,radius_m` and optionally `weight` (else 1) and the four stiffnesses
//! `kn,ks,kb,kt` (N/m and N m), which then replace those of the cylinder. Columns may come in any order; an
//! empty optional field counts as absent. Every line is checked, and an error names file, line, column and value.

mod read;
mod table;
mod write;

pub use read::{parse, read};
pub use write::{bonds_csv, particles_csv, write};
