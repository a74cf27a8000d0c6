//! Supports and loads of nodes that go, moved to the particles that come.

use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::fem::locate::Locator;
use crate::space::Vec3;
use nalgebra::{Matrix4, Vector4};
use std::collections::{BTreeMap, BTreeSet};

/// A value on a component of a node or particle.
pub type PointComponent = (usize, usize);

/// A particle counts as being at a node within this share of the body's size, and a shape function as zero below it.
const COINCIDENT: f64 = 1e-9;

/// Supports of particles from `supports` of nodes, component by component: a particle is held where every node that its place depends
/// on is held, with the interpolated value. `gone` are the nodes that must find a successor.
///
/// # Errors
/// A support of a node that goes which no particle can take over.
pub fn move_supports(
    body: &Continuum,
    network: &Network,
    supports: &BTreeMap<PointComponent, f64>,
    gone: &BTreeSet<usize>,
) -> Result<BTreeMap<PointComponent, f64>> {
    let mut moved = BTreeMap::new();
    let mut orphans: BTreeSet<PointComponent> =
        supports.keys().copied().filter(|(node, _)| gone.contains(node)).collect();
    if orphans.is_empty() {
        return Ok(moved);
    }
    let locator = Locator::new(&body.mesh);
    for (particle, &x) in network.particles.position.iter().enumerate() {
        let Some(at) = locator.find(x) else { continue };
        let nodes: Vec<(usize, f64)> = at.weights.into_iter().filter(|w| w.1.abs() > COINCIDENT).collect();
        // Where no node goes, the remaining elements hold the particle by its tie.
        if !nodes.iter().any(|w| gone.contains(&w.0)) {
            continue;
        }
        for component in 0..body.mesh.space.dim() {
            let values = nodes.iter().map(|&(node, n)| Some(n * supports.get(&(node, component))?));
            if let Some(value) = values.sum::<Option<f64>>() {
                moved.insert((particle, component), value);
                nodes.iter().for_each(|w| {
                    orphans.remove(&(w.0, component));
                });
            }
        }
    }
    match orphans.first() {
        None => Ok(moved),
        Some((node, component)) => Err(Error::Switch {
            what: format!("body '{}'", body.name),
            message: format!(
                "no particle can take over the support of node {node}, component {component}, at {:?}; leave its elements out of the \
                 region, or hold a whole face",
                body.mesh.nodes[*node].as_slice()
            ),
        }),
    }
}

/// Shares of the particles in a force at `x` that keep force and moment: `Σ w = 1`, `Σ w x_i = x`.
/// Particles on the faces of the box that hold `x`, nearest first; a particle at `x` takes it all.
///
/// # Errors
/// Too few particles nearby to keep the moment.
pub fn spread(body: &str, network: &Network, x: Vec3) -> Result<Vec<(usize, f64)>> {
    let position = &network.particles.position;
    let low = position.iter().fold(Vec3::repeat(f64::INFINITY), |m, p| m.inf(p));
    let high = position.iter().fold(Vec3::repeat(f64::NEG_INFINITY), |m, p| m.sup(p));
    let near = COINCIDENT * (high - low).norm();
    let same_faces = |p: &Vec3| {
        (0..network.space.dim())
            .all(|i| [low[i], high[i]].iter().all(|f| (x[i] - f).abs() > near || (p[i] - f).abs() <= near))
    };
    let mut candidates: Vec<usize> = (0..position.len()).filter(|&i| same_faces(&position[i])).collect();
    let distance = |i: usize| (position[i] - x).norm();
    candidates.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    if let Some(&first) = candidates.first().filter(|&&i| distance(i) <= near) {
        return Ok(vec![(first, 1.0)]);
    }
    // Enough to surround a point of the face or the inside in most packings.
    candidates.truncate(4 * network.space.dim());
    // Moving least squares: w_i = g_i p_iᵀ A⁻¹ p(0), A = Σ g p pᵀ, p = (1, (x_i − x)/ℓ), g = (ℓ/|x_i − x|)⁴.
    let scale = candidates.first().map_or(1.0, |&i| distance(i));
    let basis = |i: usize| {
        let d = (position[i] - x) / scale;
        Vector4::new(1.0, d.x, d.y, d.z)
    };
    let nearness = |i: usize| (scale / distance(i)).powi(4);
    let moments: Matrix4<f64> =
        candidates.iter().map(|&i| basis(i) * basis(i).transpose() * nearness(i)).sum();
    // Directions that no candidate spans (the normal of a face) have no moment to keep.
    let solved = moments.svd(true, true).solve(&Vector4::new(1.0, 0.0, 0.0, 0.0), 1e-10).unwrap_or_default();
    let shares: Vec<(usize, f64)> =
        candidates.iter().map(|&i| (i, nearness(i) * basis(i).dot(&solved))).collect();
    let kept: Vector4<f64> = shares.iter().map(|&(i, w)| basis(i) * w).sum();
    // Sums of a dozen shares of order one.
    if (kept - Vector4::new(1.0, 0.0, 0.0, 0.0)).amax() > 1e-8 {
        return Err(Error::Switch {
            what: format!("body '{body}'"),
            message: format!(
                "too few particles near the load at {:?} to keep its moment; use more particles",
                x.as_slice()
            ),
        });
    }
    Ok(shares)
}
