//! When bonds break: laws that turn bond forces into demands.
//!
//! A *site* is what fails: a bond, or a particle with bonds around it. Its *demand* is stress over strength: it fails at one.
//! All demands are homogeneous of degree one in the forces, so that a linear model loaded in proportion fails first
//! where the demand is largest, at the load factor `1 / demand`.
//!
//! [`bond_stress`] judges each bond alone, [`virial`] the mean stress of a particle, and [`softening`] lets a bond
//! lose its stiffness in steps that dissipate a given fracture energy. [`strength`] says how strong.

pub mod bond_stress;
pub mod forces;
pub mod softening;
pub mod strength;
pub mod virial;

use crate::dem::network::Network;
use crate::error::{Error, Result};
use forces::BondForce;
use serde::{Deserialize, Serialize};
use strength::Weibull;

/// The laws there are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum FailureLaw {
    /// Stress in the section of a bond.
    BondStress(bond_stress::BondStress),
    /// Mean stress of a particle.
    VirialStress(virial::VirialStress),
    /// Stress in the section of a bond, then gradual loss of stiffness.
    Softening(softening::Softening),
}

/// A law and the scatter of its strengths.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FailureRecipe {
    /// The law.
    pub law: FailureLaw,
    /// Scatter of strength from site to site; `None` for none.
    pub weibull: Option<Weibull>,
}

/// The network a law is made for.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// Particles and bonds.
    pub network: &'a Network,
    /// Name of the body, for messages.
    pub body: &'a str,
    /// Which bonds may break; `None` for all.
    pub breakable: Option<&'a [bool]>,
    /// Area (m²) that each bond stands for, as its Voronoi facet; stresses are forces over it. `None`: the section `πr²`.
    /// In the plane only the facet makes stress independent of thickness and particle size.
    pub area_m2: Option<&'a [f64]>,
}

/// What fails as one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Site {
    /// A bond, by index.
    Bond(usize),
    /// A particle, by index: bonds of it.
    Particle(usize),
}

/// A law made for a network: strengths of all sites, and what is left of the bonds.
#[derive(Debug, Clone)]
pub struct Failure {
    law: Made,
    pub(crate) sections: Vec<Section>,
    breakable: Vec<bool>,
    /// Share of its stiffness that each bond still has.
    integrity: Vec<f64>,
    /// Softening: number of steps taken.
    stage: Vec<usize>,
}

#[derive(Debug, Clone)]
enum Made {
    BondStress(bond_stress::Strengths),
    Virial(virial::Thresholds),
    Softening(softening::Curves),
}

/// Section of a bond as stresses see it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Section {
    /// Radius r of the cylinder, in m.
    pub radius: f64,
    /// Area that stresses refer to, in m².
    pub area: f64,
    /// Share of the bond inside the body: its forces are this times those of the whole section.
    pub weight: f64,
}

impl Failure {
    /// Makes a law for a network.
    ///
    /// # Errors
    /// A strength, fracture energy or scatter that is not positive and finite; lists that do not have one entry per bond;
    /// bonds without radius or area.
    pub fn new(recipe: &FailureRecipe, place: &Place) -> Result<Self> {
        let bonds = place.network.bonds.len();
        check_length(place, "breakable", place.breakable.map(<[bool]>::len))?;
        check_length(place, "area_m2", place.area_m2.map(<[f64]>::len))?;
        if let Some(weibull) = recipe.weibull {
            weibull.check()?;
        }
        let sections: Vec<Section> = (0..bonds).map(|b| section(place, b)).collect::<Result<_>>()?;
        let law = match recipe.law {
            FailureLaw::BondStress(law) => {
                Made::BondStress(bond_stress::Strengths::new(law, place.network, recipe.weibull)?)
            }
            FailureLaw::VirialStress(law) => {
                Made::Virial(virial::Thresholds::new(law, place, recipe.weibull)?)
            }
            FailureLaw::Softening(law) => {
                Made::Softening(softening::Curves::new(law, place.network, &sections, recipe.weibull)?)
            }
        };
        // A bond without weight carries nothing that could break it.
        let breakable =
            (0..bonds).map(|b| place.breakable.is_none_or(|may| may[b]) && sections[b].weight > 0.0);
        let breakable = breakable.collect();
        Ok(Failure { law, sections, breakable, integrity: vec![1.0; bonds], stage: vec![0; bonds] })
    }

    /// Share of its stiffness that each bond still has: 1 intact, 0 broken.
    pub fn integrity(&self) -> &[f64] {
        &self.integrity
    }

    /// Whether a bond may break and has not.
    pub fn may_break(&self, bond: usize) -> bool {
        self.breakable[bond] && self.integrity[bond] > 0.0
    }

    /// Takes over what bonds have lost already: `from[b]` is the bond of `old` that bond `b` of this network is; the others are new.
    pub fn inherit(&mut self, old: &Failure, from: &[Option<usize>]) {
        for (b, source) in from.iter().enumerate() {
            if let Some(o) = *source {
                (self.integrity[b], self.stage[b]) = (old.integrity[o], old.stage[o]);
            }
        }
    }

    /// Demand of every site, from the forces in all bonds (those of broken bonds are zero and do not count): one per bond, or one per
    /// particle. Sites that cannot fail have demand zero.
    pub fn demands(&self, network: &Network, forces: &[BondForce]) -> Vec<f64> {
        let of_bond = |b: usize, demand: f64| if self.may_break(b) { demand } else { 0.0 };
        let stress = |b: usize| forces[b].stress(&self.sections[b]);
        match &self.law {
            Made::BondStress(law) => {
                (0..forces.len()).map(|b| of_bond(b, law.demand(b, stress(b)))).collect()
            }
            Made::Softening(law) => {
                let demand = |b: usize| law.demand(b, self.stage[b], stress(b));
                (0..forces.len()).map(|b| of_bond(b, demand(b))).collect()
            }
            Made::Virial(law) => {
                let mut able = vec![false; network.particles.len()];
                for (b, ends) in network.bonds.ends.iter().enumerate() {
                    ends.iter().for_each(|&p| able[p] |= self.may_break(b));
                }
                let demands = law.demands(network, forces);
                demands.into_iter().zip(able).map(|(d, able)| if able { d } else { 0.0 }).collect()
            }
        }
    }

    /// The site with an index in [`Failure::demands`].
    pub fn site(&self, index: usize) -> Site {
        match self.law {
            Made::Virial(_) => Site::Particle(index),
            Made::BondStress(_) | Made::Softening(_) => Site::Bond(index),
        }
    }

    /// The bonds that a failing site takes with it, ascending.
    pub fn bonds_of(&self, site: Site, network: &Network, forces: &[BondForce]) -> Vec<usize> {
        match (site, &self.law) {
            (Site::Particle(particle), Made::Virial(law)) => {
                let around = (0..network.bonds.len())
                    .filter(|&b| self.may_break(b) && network.bonds.ends[b].contains(&particle));
                law.released(around.collect(), forces, &self.sections)
            }
            (Site::Bond(bond), _) => vec![bond],
            (Site::Particle(_), _) => Vec::new(),
        }
    }

    /// Lets a bond fail once: it breaks, or softens by a step. Returns what is left of its stiffness.
    pub fn fail(&mut self, bond: usize) -> f64 {
        self.stage[bond] += 1;
        self.integrity[bond] = match &self.law {
            Made::Softening(law) => law.integrity(bond, self.stage[bond]),
            Made::BondStress(_) | Made::Virial(_) => 0.0,
        };
        self.integrity[bond]
    }

    /// Demand of a bond under a law of single bonds, at the displacements `u` of a network whose weights are what is left of its bonds.
    fn demand_at(&self, network: &Network, u: &[f64], b: usize) -> f64 {
        let stress = BondForce::of(network, b, u, 1.0).stress(&self.sections[b]);
        match &self.law {
            Made::BondStress(law) => law.demand(b, stress),
            Made::Softening(law) => law.demand(b, self.stage[b], stress),
            Made::Virial(_) => 0.0,
        }
    }

    /// As [`Failure::demands`], at the displacements `u` of a network whose weights are what is left of its bonds, in place of what `demands`
    /// held. Returns how many bonds were looked at: laws of single bonds look at those that may break.
    pub fn demands_at(&self, network: &Network, u: &[f64], demands: &mut Vec<f64>) -> u64 {
        let bonds = network.bonds.len();
        demands.clear();
        if let Made::Virial(_) = &self.law {
            let forces = BondForce::all(network, u, &vec![1.0; bonds]);
            demands.extend(self.demands(network, &forces));
            return bonds as u64;
        }
        demands.resize(bonds, 0.0);
        let mut seen = 0;
        for b in (0..bonds).filter(|&b| self.may_break(b)) {
            seen += 1;
            demands[b] = self.demand_at(network, u, b);
        }
        seen
    }

    /// The bonds that fail at the displacements `u` of a network whose weights are what is left of its bonds, ascending, in place of what
    /// `failing` held. Returns how many bonds were looked at. Laws of single bonds look at those that may break and need no room.
    pub fn failing_at(&self, network: &Network, u: &[f64], failing: &mut Vec<usize>) -> u64 {
        failing.clear();
        let bonds = network.bonds.len();
        if let Made::Virial(_) = &self.law {
            let forces = BondForce::all(network, u, &vec![1.0; bonds]);
            failing.extend(self.failing(network, &forces));
            return bonds as u64;
        }
        let mut seen = 0;
        for b in (0..bonds).filter(|&b| self.may_break(b)) {
            seen += 1;
            if self.demand_at(network, u, b) >= 1.0 {
                failing.push(b);
            }
        }
        seen
    }

    /// All bonds of sites whose demand has reached one, ascending: what an explicit integrator lets [`Failure::fail`]
    /// after each step.
    pub fn failing(&self, network: &Network, forces: &[BondForce]) -> Vec<usize> {
        let demands = self.demands(network, forces);
        let sites = (0..demands.len()).filter(|&s| demands[s] >= 1.0);
        let mut bonds: Vec<usize> =
            sites.flat_map(|s| self.bonds_of(self.site(s), network, forces)).collect();
        bonds.sort_unstable();
        bonds.dedup();
        bonds
    }
}

fn check_length(place: &Place, list: &str, length: Option<usize>) -> Result<()> {
    let bonds = place.network.bonds.len();
    match length {
        Some(length) if length != bonds => Err(Error::Geometry {
            what: format!("body '{}'", place.body),
            message: format!("{list} has {length} entries for {bonds} bonds; give one per bond"),
        }),
        _ => Ok(()),
    }
}

fn section(place: &Place, bond: usize) -> Result<Section> {
    let bonds = &place.network.bonds;
    let radius = bonds.radius[bond];
    let area = place.area_m2.map_or(std::f64::consts::PI * radius * radius, |a| a[bond]);
    let [i, j] = bonds.ends[bond];
    if !(radius.is_finite() && radius > 0.0 && area.is_finite() && area > 0.0) {
        let message =
            format!("radius {radius} m and area {area} m² must be positive for a stress; give the bond both");
        return Err(Error::Bond { body: place.body.to_owned(), bond, i, j, message });
    }
    Ok(Section { radius, area, weight: bonds.weight[bond] })
}
