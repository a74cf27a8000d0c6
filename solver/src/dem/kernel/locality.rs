//! Numbering particles so that neighbours in space are neighbours in memory.

use crate::dem::network::Network;
use crate::space::Vec3;

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

/// The same network with its particles in the given order: `order[new] = old`. Bonds keep their places.
pub fn renumber(network: &Network, order: &[usize]) -> Network {
    let mut new = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &old)| new[old] = k);
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
