//! Numbering particles so that neighbours in space are neighbours in memory.

use crate::dem::bond::check_bond;
use crate::dem::network::Network;
use crate::error::Result;
use crate::space::Vec3;
use std::sync::Mutex;

/// Fewer particles fit the nearest caches in any order (`u` and `f` are 96 bytes each).
const MANY: usize = 10_000;
/// Copying to a better order and back costs about a third of the forces: worth it where bonds reach this much further.
const WORTH: usize = 4;

/// Order of the particles by cells of a grid, slab after slab across the longest side: `order[new] = old`.
///
/// A cell holds about one particle. Bonds then reach no further than a slab or two, which stay in the cache, and
/// cutting the order into equal parts cuts the body across its longest side.
pub fn order(network: &Network) -> Vec<usize> {
    let positions = &network.particles.position;
    let start = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    let (low, high) = positions.iter().fold(start, |(low, high), x| (low.inf(x), high.sup(x)));
    let dim = network.space.dim();
    let sides = high - low;
    let measure: f64 = sides.iter().take(dim).product();
    let edge = (measure / positions.len().max(1) as f64).powf(1.0 / dim as f64);
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| sides[b].total_cmp(&sides[a]));
    let cell = |x: &Vec3| axes.map(|axis| ((x[axis] - low[axis]) / edge) as u64);
    let mut keyed: Vec<([u64; 3], usize)> = positions.iter().map(cell).zip(0..).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, particle)| particle).collect()
}

/// The order of [`order`] if it is worth renumbering for: many particles, numbered without regard to where they are.
///
/// # Errors
/// As [`crate::dem::bond::for_each_stiffness`].
pub fn better_order(network: &Network, body: &str) -> Result<Option<Vec<usize>>> {
    let ends = &network.bonds.ends;
    (0..ends.len()).try_for_each(|b| check_bond(network, body, b))?;
    if network.particles.len() < MANY {
        return Ok(None);
    }
    let order = order(network);
    let new = inverse(&order);
    let reach =
        |of: &dyn Fn(usize) -> usize| -> usize { ends.iter().map(|e| of(e[0]).abs_diff(of(e[1]))).sum() };
    Ok((reach(&|p| p) > WORTH * reach(&|p| new[p])).then_some(order))
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut new = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &old)| new[old] = k);
    new
}

/// The same network with its particles in the given order: `order[new] = old`. Bonds keep their places.
pub fn renumber(network: &Network, order: &[usize]) -> Network {
    let new = inverse(order);
    let mut result = network.clone();
    let from = &network.particles;
    let to = &mut result.particles;
    to.position = order.iter().map(|&p| from.position[p]).collect();
    for (to, from) in
        [(&mut to.radius, &from.radius), (&mut to.mass, &from.mass), (&mut to.inertia, &from.inertia)]
    {
        *to = order.iter().map(|&p| from[p]).collect();
    }
    result.bonds.ends.iter_mut().for_each(|ends| *ends = ends.map(|p| new[p]));
    for face in result.faces.values_mut() {
        face.iter_mut().for_each(|p| *p = new[*p]);
        face.sort_unstable();
    }
    result
}

/// Copies between a network's own numbering and a better one, and room for them.
#[derive(Debug)]
pub(crate) struct Detour {
    order: Vec<usize>,
    per_particle: usize,
    room: Mutex<[Vec<f64>; 2]>,
}

impl Clone for Detour {
    fn clone(&self) -> Self {
        Detour::new(self.order.clone(), self.per_particle)
    }
}

impl Detour {
    pub fn new(order: Vec<usize>, per_particle: usize) -> Self {
        let room = Mutex::new([(); 2].map(|()| vec![0.0; order.len() * per_particle]));
        Detour { order, per_particle, room }
    }

    /// Place of a particle in the better order.
    pub fn place(&self, particle: usize) -> usize {
        self.order.iter().position(|&p| p == particle).unwrap_or(particle)
    }

    /// Calls `with` on `u` in the better order.
    pub fn read<T>(&self, u: &[f64], with: impl FnOnce(&[f64]) -> T) -> T {
        let [there, _] = &mut *self.room.lock().expect("no thread panics in a detour");
        self.gather(u, there);
        with(there)
    }

    /// Adds to `f` what `with` adds to a vector of zeros at `u`, both in the better order.
    pub fn add(&self, u: &[f64], f: &mut [f64], with: impl FnOnce(&[f64], &mut [f64])) {
        let [there, back] = &mut *self.room.lock().expect("no thread panics in a detour");
        self.gather(u, there);
        back.fill(0.0);
        with(there, back);
        let per = self.per_particle;
        for (from, &p) in back.chunks_exact(per).zip(&self.order) {
            f[p * per..][..per].iter_mut().zip(from).for_each(|(f, from)| *f += from);
        }
    }

    fn gather(&self, u: &[f64], there: &mut [f64]) {
        let per = self.per_particle;
        for (to, &p) in there.chunks_exact_mut(per).zip(&self.order) {
            to.copy_from_slice(&u[p * per..][..per]);
        }
    }
}
