//! Checks of peers: a code that can answer, variants that are there.

use super::Scene;
use super::check::{Checked, known};
use super::check_study::variants;
use super::quantity::Quantity;
use crate::error::Fault;
use crate::result::ReferenceKind;

/// Checks all peers.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene) -> Checked {
    for (name, peer) in &scene.peers {
        let key = format!("peers.{name}");
        let network = match peer.code {
            ReferenceKind::Yade | ReferenceKind::Lammps => true,
            ReferenceKind::Calculix => false,
            _ => {
                let mend = "name yade, lammps or calculix";
                return Err(Fault::new(format!("{key}.code"), "it is not another code", mend));
            }
        };
        if peer.variants.is_empty() == network {
            let mend = "yade and lammps are given the network of some variants, calculix is given none";
            return Err(Fault::new(format!("{key}.variants"), "the code does not fit the variants", mend));
        }
        variants(scene, &peer.variants, &format!("{key}.variants"))?;
    }
    Ok(())
}

/// The peer that a quantity is compared with is there, and of the kind the quantity says.
///
/// # Errors
/// The first fault; `key` is that of the quantity's reference.
pub fn check_reference(scene: &Scene, quantity: &Quantity, key: &str) -> Checked {
    let Some(reference) = &quantity.reference else { return Ok(()) };
    let Some(name) = &reference.peer else { return Ok(()) };
    known(name, "peer", scene.peers.keys(), &format!("{key}.peer"))?;
    if scene.peers[name].code != reference.kind {
        let mend = "the kind is the code of the peer";
        return Err(Fault::new(format!("{key}.kind"), "the kind does not fit where the value is from", mend));
    }
    if reference.value.is_some() || reference.variants.is_some() {
        return Err(Fault::new(format!("{key}.peer"), "there are two references", "keep one of them"));
    }
    Ok(())
}
