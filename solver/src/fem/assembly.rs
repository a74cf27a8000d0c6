//! Element stiffness matrices, cell by cell.

use super::continuum::Continuum;
use super::element::Element;
use super::h8::H8;
use super::q4::Q4;
use super::stiffness::ElementModel;
use crate::error::Result;
use crate::space::Space;

/// Calls `sink(dofs, k)` for every element: `dofs` are degrees of freedom of the body
/// (node · dimension + component), `k` its stiffness matrix (N/m), row by row.
///
/// # Errors
/// As [`Continuum::check`]; [`crate::error::Error::InvertedElement`] for a Jacobian that is not
/// positive at an integration point.
pub fn for_each_stiffness(continuum: &Continuum, sink: impl FnMut(&[usize], &[f64])) -> Result<()> {
    continuum.check()?;
    match continuum.mesh.space {
        Space::Plane => assemble::<Q4, 2, 4, 4>(continuum, sink),
        Space::Solid => assemble::<H8, 3, 8, 6>(continuum, sink),
    }
}

fn assemble<E: Element<D, N>, const D: usize, const N: usize, const V: usize>(
    continuum: &Continuum,
    mut sink: impl FnMut(&[usize], &[f64]),
) -> Result<()> {
    let model = ElementModel::<D, V>::new(continuum);
    let mut dofs = Vec::with_capacity(N * D);
    let mut k = Vec::with_capacity(N * D * N * D);
    for cell in 0..continuum.mesh.cell_count() {
        let condensed = model
            .kinematics::<E, N>(cell)
            .and_then(|kinematics| model.stiffness(&kinematics))
            .map_err(|inverted| continuum.inverted(cell, inverted.0))?;
        condensed.copy_stiffness(&mut k);
        dofs.clear();
        dofs.extend(continuum.mesh.cell(cell).iter().flat_map(|&node| (0..D).map(move |i| node * D + i)));
        sink(&dofs, &k);
    }
    Ok(())
}
