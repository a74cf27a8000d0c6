//! Boxes around boxes: a region that grows by whole boxes.

use crate::dem::block::Block;
use crate::space::Space;

/// Sides shorter than this share of the box are rounding.
const ROUNDING: f64 = 1e-9;

/// What is left of a box without a hole, in boxes: for each axis in turn the slab before the hole and the one after it.
pub(super) fn without(space: Space, whole: Block, hole: &Block) -> Vec<Block> {
    let small = ROUNDING * whole.sides().max();
    let apart = |i: usize| hole.min[i] >= whole.max[i] - small || hole.max[i] <= whole.min[i] + small;
    if (0..space.dim()).any(apart) {
        return vec![whole];
    }
    let (mut rest, mut slabs) = (whole, Vec::new());
    for i in 0..space.dim() {
        if hole.min[i] > rest.min[i] + small {
            let mut slab = rest;
            (slab.max[i], rest.min[i]) = (hole.min[i], hole.min[i]);
            slabs.push(slab);
        }
        if hole.max[i] < rest.max[i] - small {
            let mut slab = rest;
            (slab.min[i], rest.max[i]) = (hole.max[i], hole.max[i]);
            slabs.push(slab);
        }
    }
    slabs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Vec3;

    fn solid(min: [f64; 3], max: [f64; 3]) -> Block {
        Block::new(Space::Solid, Vec3::from(min), Vec3::from(max)).unwrap()
    }

    #[test]
    fn slabs_and_hole_make_up_the_box() {
        let whole = solid([0.0; 3], [4.0, 3.0, 2.0]);
        for (hole, slabs) in [
            (solid([1.0, 1.0, 0.5], [2.0, 2.0, 1.0]), 6),
            (solid([1.0, 0.0, 0.0], [2.0, 3.0, 2.0]), 2),
            (solid([0.0; 3], [2.0, 2.0, 2.0]), 2),
            (whole, 0),
        ] {
            let rest = without(Space::Solid, whole, &hole);
            assert_eq!(rest.len(), slabs);
            let volume: f64 = rest.iter().map(|b| b.measure(Space::Solid)).sum();
            // Small whole numbers and halves are exact.
            assert_eq!(volume + hole.measure(Space::Solid), 24.0);
            for (k, a) in rest.iter().enumerate() {
                let others = rest.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, b)| b);
                assert!(others.chain([&hole]).all(|b| without(Space::Solid, *a, b) == [*a]));
            }
        }
        assert_eq!(without(Space::Solid, whole, &solid([4.0, 0.0, 0.0], [5.0, 1.0, 1.0])), [whole]);
        assert_eq!(
            whole.around(&solid([-1.0, 1.0, 1.0], [1.0, 5.0, 2.0])),
            solid([-1.0, 0.0, 0.0], [4.0, 5.0, 2.0])
        );
    }
}
