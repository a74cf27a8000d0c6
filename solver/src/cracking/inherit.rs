//! Which bonds of a network are those of another one: a region that grows is filled anew, and its cracks stay.

use crate::dem::block::Block;
use crate::dem::grid::{Boundary, Grid};
use crate::dem::network::Network;
use std::collections::BTreeMap;

/// Particles closer than this share of the smallest radius are one: rounding of coordinates.
const SAME: f64 = 1e-6;

/// For each bond of `new` the bond of `old` between the same two places, if there is one.
pub(super) fn same_bonds(old: &Network, new: &Network) -> Vec<Option<usize>> {
    let position = &old.particles.position;
    let Some(block) = position.iter().map(|&x| Block { min: x, max: x }).reduce(|a, b| a.around(&b)) else {
        return vec![None; new.bonds.len()];
    };
    let smallest = old.particles.radius.iter().fold(f64::INFINITY, |m, r| m.min(*r));
    let grid = Grid::new(old.space, block, Boundary::Closed, position, 2.0 * smallest);
    let same: Vec<Option<usize>> = new
        .particles
        .position
        .iter()
        .map(|&x| {
            let mut found = None;
            grid.for_each_within(x, SAME * smallest, |near| found = Some(near.point));
            found
        })
        .collect();
    let ordered = |i: usize, j: usize| (i.min(j), i.max(j));
    let bonds: BTreeMap<(usize, usize), usize> =
        old.bonds.ends.iter().enumerate().map(|(b, &[i, j])| (ordered(i, j), b)).collect();
    let of = |&[i, j]: &[usize; 2]| bonds.get(&ordered(same[i]?, same[j]?)).copied();
    new.bonds.ends.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, bond_network};
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::space::{Space, Vec3};

    fn square(columns: f64, rows: usize) -> Network {
        let block = Block::at_origin(Space::Plane, Vec3::new(columns, rows as f64, 0.0)).unwrap();
        let l = lattice(LatticeKind::Square, block, rows, Matter::default()).unwrap();
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
            section: Section::Uniform { ratio: 0.6 },
            skin: Skin::Weighted,
        };
        bond_network(&l.arrangement, &l.pairs, &recipe).unwrap()
    }

    /// A larger box of the same lattice holds each bond of the smaller one once, between the same places.
    #[test]
    fn every_bond_of_the_smaller_box_is_found_again() {
        let (old, new) = (square(4.0, 3), square(6.0, 5));
        let from = same_bonds(&old, &new);
        let mut found: Vec<usize> = from.iter().flatten().copied().collect();
        found.sort_unstable();
        assert_eq!(found, (0..old.bonds.len()).collect::<Vec<_>>());
        for (b, source) in from.iter().enumerate().filter_map(|(b, s)| Some((b, (*s)?))) {
            let at = |n: &Network, b: usize| n.bonds.ends[b].map(|p| n.particles.position[p]);
            assert_eq!(at(&new, b), at(&old, source));
        }
        assert!(same_bonds(&new, &old).iter().all(Option::is_some));
    }
}
