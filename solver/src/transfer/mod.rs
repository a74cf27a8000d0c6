//! From elements to particles while the model moves.
//!
//! A [`criterion`] says which elements ([`watch`] asks it again and again); [`region`] makes a box of them; [`substitution`] builds the new model, [`points`] moves
//! supports and loads, [`fields`] gives the motion with its [`momentum`]; [`equilibrium`] relaxes the new particles;
//! [`report`] says what the switch did to forces, energies and momentum.

pub mod criterion;
pub mod equilibrium;
pub mod fields;
pub mod momentum;
mod pieces;
pub mod points;
pub mod region;
pub mod report;
mod state;
pub mod substitution;
pub mod ties;
pub mod watch;
