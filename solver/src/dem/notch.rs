//! A notch cut from a network: a slit or a wedge that opens downwards.
//!
//! Particles inside it or on its flanks go, and with them all bonds that would cross it. What the coarse outline of particles misses of
//! the mass, or has too much, is shared by the particles along the flanks, in proportion to their own.

use super::block::Block;
use super::network::{Bonds, Network, Particles};
use crate::error::{Error, Result};
use crate::space::Vec3;
use std::collections::BTreeMap;

/// Points this close to a flank, as a share of the notch's depth, lie on it.
const ON_FLANK: f64 = 1e-9;

/// The notch `|x − x_tip| ≤ (y_tip − y) tan(ω/2)`, `y < y_tip`; in the solid through the whole thickness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notch {
    /// Its tip, in m.
    pub tip: Vec3,
    /// Between the flanks, ω, in rad; zero is a slit.
    pub angle: f64,
}

/// A network without its notch, and which of the old bonds are left, in their new order.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// Particles and bonds.
    pub network: Network,
    /// Old number of each bond.
    pub bonds: Vec<usize>,
}

impl Notch {
    /// Half its width at height `y`, in m.
    pub fn half_opening(&self, y: f64) -> f64 {
        (self.tip.y - y).max(0.0) * (0.5 * self.angle).tan()
    }

    /// Whether it reaches into a box.
    pub fn meets(&self, block: &Block) -> bool {
        let half = self.half_opening(block.min.y);
        block.min.y < self.tip.y && block.min.x < self.tip.x + half && self.tip.x - half < block.max.x
    }

    /// Its area inside a box, in m².
    ///
    /// # Errors
    /// A tip outside of the box, or a mouth wider than it: it must hold the whole notch.
    pub fn area(&self, block: &Block) -> Result<f64> {
        let (low, high, tip) = (block.min, block.max, self.tip);
        let half = self.half_opening(low.y);
        let inside = low.y < tip.y && tip.y < high.y && low.x < tip.x - half && tip.x + half < high.x;
        if !inside {
            return Err(Error::Geometry {
                what: "notch".to_owned(),
                message: format!(
                    "its tip at ({}, {}) m with a mouth of {} m is not inside the box from ({}, {}) to ({}, {}) m; \
                     make the notch shallower or the box larger",
                    tip.x,
                    tip.y,
                    2.0 * half,
                    low.x,
                    low.y,
                    high.x,
                    high.y
                ),
            });
        }
        Ok((tip.y - low.y) * half)
    }

    /// Whether a point lies in the notch or on its flanks; the tip itself does not.
    pub fn holds(&self, x: Vec3) -> bool {
        let near = ON_FLANK * self.tip.y.abs().max(self.half_opening(x.y)).max(f64::MIN_POSITIVE);
        x.y < self.tip.y - near && (x.x - self.tip.x).abs() <= self.half_opening(x.y) + near
    }

    /// Whether the straight line between two points outside of the notch leads through it.
    ///
    /// `|x − x_tip| − (y_tip − y) tan(ω/2)` is convex along the line and positive at its ends: it is below zero somewhere if
    /// it is so where the line passes under the tip.
    pub fn crosses(&self, a: Vec3, b: Vec3) -> bool {
        let (left, right) = (a.x - self.tip.x, b.x - self.tip.x);
        if left * right >= 0.0 {
            return false;
        }
        let y = a.y + (b.y - a.y) * left / (left - right);
        self.holds(Vec3::new(self.tip.x, y, a.z))
    }

    /// Cuts the notch from the network that fills a box.
    ///
    /// # Errors
    /// As [`Notch::area`]; a network of which nothing is left.
    pub fn cut(&self, network: &Network, block: &Block) -> Result<Cut> {
        let outside = 1.0 - self.area(block)? / (block.sides().x * block.sides().y);
        let position = &network.particles.position;
        let stays: Vec<bool> = position.iter().map(|x| !self.holds(*x)).collect();
        let whole = |&[i, j]: &[usize; 2]| stays[i] && stays[j] && !self.crosses(position[i], position[j]);
        let ends = &network.bonds.ends;
        let bonds: Vec<usize> = (0..ends.len()).filter(|&b| whole(&ends[b])).collect();
        let mut bonded = vec![false; stays.len()];
        bonds.iter().for_each(|&b| ends[b].iter().for_each(|&p| bonded[p] = true));
        let mut lost = vec![false; stays.len()];
        (0..ends.len())
            .filter(|&b| !whole(&ends[b]))
            .for_each(|b| ends[b].iter().for_each(|&p| lost[p] = true));
        let kept: Vec<usize> = (0..stays.len()).filter(|&p| stays[p] && bonded[p]).collect();
        if kept.is_empty() {
            let message = "no bond is left beside it; use more particles".to_owned();
            return Err(Error::Geometry { what: "notch".to_owned(), message });
        }
        let mut number: BTreeMap<usize, usize> = BTreeMap::new();
        kept.iter().enumerate().for_each(|(new, &old)| {
            number.insert(old, new);
        });
        let mut particles = pick(&network.particles, &kept);
        let flanks: Vec<usize> = (0..kept.len()).filter(|&p| lost[kept[p]]).collect();
        share_mass(&mut particles, &flanks, outside * network.particles.mass.iter().sum::<f64>());
        let of = |list: &[f64]| bonds.iter().map(|&b| list[b]).collect();
        let faces = network
            .faces
            .iter()
            .map(|(face, on)| (face.clone(), on.iter().filter_map(|p| number.get(p).copied()).collect()));
        let cut = Network {
            space: network.space,
            bonds: Bonds {
                ends: bonds.iter().map(|&b| ends[b].map(|p| number[&p])).collect(),
                radius: of(&network.bonds.radius),
                stiffness: bonds.iter().map(|&b| network.bonds.stiffness[b]).collect(),
                weight: of(&network.bonds.weight),
            },
            faces: faces.collect(),
            particles,
        };
        Ok(Cut { network: cut, bonds })
    }
}

fn pick(particles: &Particles, kept: &[usize]) -> Particles {
    let of = |list: &[f64]| kept.iter().map(|&p| list[p]).collect();
    Particles {
        position: kept.iter().map(|&p| particles.position[p]).collect(),
        radius: of(&particles.radius),
        mass: of(&particles.mass),
        inertia: of(&particles.inertia),
    }
}

/// Scales masses and inertias of some particles so that all together have the mass `whole` (kg).
fn share_mass(particles: &mut Particles, flanks: &[usize], whole: f64) {
    let missing = whole - particles.mass.iter().sum::<f64>();
    let own: f64 = flanks.iter().map(|&p| particles.mass[p]).sum();
    let factor = 1.0 + missing / own;
    // Without flanks there is nothing to share; a factor below zero would be no mass.
    if own > 0.0 && factor > 0.0 {
        for &p in flanks {
            particles.mass[p] *= factor;
            particles.inertia[p] *= factor;
        }
    }
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
    use crate::space::Space;
    use proptest::prelude::*;

    fn block() -> Block {
        Block::new(Space::Plane, Vec3::new(-2.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 0.0)).unwrap()
    }

    fn network(rows: usize) -> Network {
        let l = lattice(LatticeKind::Triangular, block(), rows, Matter::default()).unwrap();
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
            section: Section::Uniform { ratio: 0.6 },
            skin: Skin::Weighted,
        };
        bond_network(&l.arrangement, &l.pairs, &recipe).unwrap()
    }

    proptest! {
        /// No particle in the notch, no bond through it, and the mass of what is left of the box.
        #[test]
        fn nothing_is_left_in_the_notch(depth in 0.2..0.8f64, degrees in 0.0..120.0f64, rows in 8usize..20) {
            let notch = Notch { tip: Vec3::new(0.0, depth, 0.0), angle: degrees.to_radians() };
            let whole = network(rows);
            let cut = notch.cut(&whole, &block()).unwrap();
            let x = &cut.network.particles.position;
            prop_assert!(x.iter().all(|x| !notch.holds(*x)));
            for (k, &[i, j]) in cut.network.bonds.ends.iter().enumerate() {
                // Many points of the bond, none of them inside.
                let inside = (0..=100).any(|t| notch.holds(x[i] + (x[j] - x[i]) * (f64::from(t) / 100.0)));
                prop_assert!(!inside, "bond {k}");
                let [a, b] = whole.bonds.ends[cut.bonds[k]].map(|p| whole.particles.position[p]);
                prop_assert!(a == x[i] && b == x[j]);
            }
            let area = 4.0 - depth * depth * (0.5 * notch.angle).tan();
            let mass: f64 = cut.network.particles.mass.iter().sum();
            prop_assert!((mass / area - 1.0).abs() < 1e-12, "{mass} {area}");
            prop_assert!(cut.network.particles.mass.iter().all(|m| *m > 0.0));
        }
    }

    /// Straight through the tip is not through the notch.
    #[test]
    fn the_tip_belongs_to_the_body() {
        let notch = Notch { tip: Vec3::new(0.0, 0.5, 0.0), angle: 0.0 };
        let at = |x: f64, y: f64| Vec3::new(x, y, 0.0);
        assert!(!notch.holds(at(0.0, 0.5)) && notch.holds(at(0.0, 0.4)) && !notch.holds(at(0.1, 0.4)));
        assert!(!notch.crosses(at(-1.0, 0.5), at(1.0, 0.5)) && notch.crosses(at(-1.0, 0.4), at(1.0, 0.5)));
        assert!(!notch.crosses(at(0.1, 0.0), at(1.0, 0.4)) && !notch.crosses(at(-0.1, 0.9), at(0.1, 0.4)));
    }

    #[test]
    fn a_notch_outside_of_the_box_is_refused() {
        let network = network(8);
        for (tip, degrees) in [([0.0, 1.2], 0.0), ([0.0, -0.1], 0.0), ([3.0, 0.5], 0.0), ([0.0, 0.9], 140.0)]
        {
            let notch = Notch { tip: Vec3::new(tip[0], tip[1], 0.0), angle: f64::to_radians(degrees) };
            let refusal = notch.cut(&network, &block()).unwrap_err().to_string();
            assert!(refusal.contains("is not inside the box"), "{refusal}");
        }
    }
}
