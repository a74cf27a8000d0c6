//! What Seam exports for references, by the id of the reference.

use anyhow::Result;
use seam_cases::catalogue;
use seam_cases::export::{Code, Export, has_networks, of};
use std::collections::BTreeMap;

/// Every network of the catalogue that another code is to answer.
pub fn all() -> Result<BTreeMap<String, Export>> {
    let mut exports = BTreeMap::new();
    for id in catalogue::ids() {
        let file = catalogue::case(id, &[])?;
        for code in [Code::Yade, Code::Lammps] {
            if has_networks(&file, code) {
                exports.extend(of(&file, code)?.into_iter().map(|export| (export.reference(), export)));
            }
        }
    }
    Ok(exports)
}
