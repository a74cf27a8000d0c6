//! Several bonds at once: arrays with one lane per bond, and a loop over the lanes without branches, which the compiler
//! makes vector instructions of.
//!
//! Compiled for AVX2 as well and chosen at run time. Products and sums are never fused, so that every machine finds the
//! same bits. A bond that turns too far for the short series is evaluated again on its own: what a bond does never
//! depends on its neighbours in the batch.

use super::bond::{Any, FiniteBond, Loads, Small};
use crate::space::Vec3;
use pulp::{Arch, Simd, WithSimd};
use std::array::from_fn;

/// Bonds of a batch: two vectors of AVX2, so that one waits while the other computes.
pub(super) const LANES: usize = 8;

/// `K` numbers of each bond.
type Numbers<const K: usize> = [[f64; LANES]; K];

#[inline(always)]
fn lane<const K: usize>(numbers: &Numbers<K>, l: usize) -> [f64; K] {
    // Not `from_fn`: where it is not inlined, the loop over the lanes stays scalar.
    let mut values = [0.0; K];
    for k in 0..K {
        values[k] = numbers[k][l];
    }
    values
}

#[inline(always)]
fn set_lane<const K: usize>(numbers: &mut Numbers<K>, l: usize, values: [f64; K]) {
    for k in 0..K {
        numbers[k][l] = values[k];
    }
}

/// Up to [`LANES`] bonds; unused lanes hold a bond without stiffness.
#[derive(Debug, Clone)]
pub(super) struct Batch(Numbers<8>);

impl Batch {
    pub fn new(bonds: &[FiniteBond]) -> Self {
        let nothing = FiniteBond::new(Vec3::x(), Default::default(), 0.0);
        let of_lane = |l: usize| *bonds.get(l).unwrap_or(&nothing);
        let numbers: [[f64; 8]; LANES] = from_fn(|l| of_lane(l).to_numbers());
        Batch(from_fn(|k| from_fn(|l| numbers[l][k])))
    }

    /// The bond in one lane.
    #[inline(always)]
    pub fn bond(&self, l: usize) -> FiniteBond {
        FiniteBond::from_numbers(lane(&self.0, l))
    }
}

/// Where the particles of a batch are.
pub(super) struct Pose {
    stretch: Numbers<3>,
    turned: [Numbers<4>; 2],
}

impl Pose {
    /// Nothing moved.
    pub fn new() -> Self {
        let unturned = from_fn(|k| [if k == 3 { 1.0 } else { 0.0 }; LANES]);
        Pose { stretch: [[0.0; LANES]; 3], turned: [unturned; 2] }
    }

    #[inline(always)]
    pub fn set(&mut self, l: usize, stretch: [f64; 3], [q1, q2]: [[f64; 4]; 2]) {
        set_lane(&mut self.stretch, l, stretch);
        set_lane(&mut self.turned[0], l, q1);
        set_lane(&mut self.turned[1], l, q2);
    }

    #[inline(always)]
    fn get(&self, l: usize) -> (Vec3, [[f64; 4]; 2]) {
        (lane(&self.stretch, l).into(), [lane(&self.turned[0], l), lane(&self.turned[1], l)])
    }
}

/// Forces and moments of a batch.
pub(super) struct BatchLoads {
    force: Numbers<3>,
    moments: [Numbers<3>; 2],
    reach: [f64; LANES],
}

impl BatchLoads {
    pub fn new() -> Self {
        let zero = [[0.0; LANES]; 3];
        BatchLoads { force: zero, moments: [zero; 2], reach: [0.0; LANES] }
    }

    /// Force on the higher particle, moments on the lower and the higher one.
    #[inline(always)]
    pub fn get(&self, l: usize) -> [[f64; 3]; 3] {
        [lane(&self.force, l), lane(&self.moments[0], l), lane(&self.moments[1], l)]
    }

    #[inline(always)]
    fn set(&mut self, l: usize, loads: Loads) {
        set_lane(&mut self.force, l, loads.force.into());
        set_lane(&mut self.moments[0], l, loads.moments[0].into());
        set_lane(&mut self.moments[1], l, loads.moments[1].into());
        self.reach[l] = loads.reach;
    }

    /// Evaluates all lanes.
    #[inline(always)]
    pub fn evaluate(&mut self, arch: Arch, batch: &Batch, pose: &Pose) {
        arch.dispatch(AllLanes { batch, pose, loads: self });
        if self.reach.iter().any(|r| *r >= 1.0) {
            self.evaluate_far(batch, pose);
        }
    }

    #[cold]
    fn evaluate_far(&mut self, batch: &Batch, pose: &Pose) {
        for l in (0..LANES).filter(|l| self.reach[*l] >= 1.0).collect::<Vec<_>>() {
            let (stretch, turned) = pose.get(l);
            self.set(l, batch.bond(l).loads::<Any>(stretch, turned));
        }
    }
}

struct AllLanes<'a> {
    batch: &'a Batch,
    pose: &'a Pose,
    loads: &'a mut BatchLoads,
}

impl WithSimd for AllLanes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        all_lanes(self.batch, self.pose, self.loads);
    }
}

/// A function of its own: references as arguments tell the compiler that nothing overlaps, fields do not.
#[inline(always)]
fn all_lanes(batch: &Batch, pose: &Pose, loads: &mut BatchLoads) {
    for l in 0..LANES {
        let (stretch, turned) = pose.get(l);
        loads.set(l, batch.bond(l).loads::<Small>(stretch, turned));
    }
}
