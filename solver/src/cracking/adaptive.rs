//! Cracking that begins in elements: particles come where a criterion asks for them, ahead of the crack.
//!
//! The path is that of [`Cracking`]. Before each event, at its load factor, the criterion is asked of all elements that are left; those that
//! fire become particles, and those within the criterion's buffer of the last broken bonds, and the path goes on. Without particles the first event is the
//! load at which the criterion fires: stress in proportion to the load reaches its trigger at `trigger / largest value`.
//!
//! Between events the model is linear and its state is λ û, so there is nothing to map: the model is built anew from the elements it
//! began with and the grown box, bonds keep what is left of them, and the equilibrium is found at the same displacement q. What the
//! exchange does to energy, force and stiffness at held q is recorded ([`Exchange`]).

use super::inherit::same_bonds;
use super::{Cracking, Event, Exchange, Options, Outcome, Stop};
use crate::coupling::{Method, Multipliers};
use crate::dem::arrangement::Matter;
use crate::dem::block::Block;
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::failure::Failure;
use crate::fem::continuum::Continuum;
use crate::model::{Model, Part};
use crate::space::Vec3;
use crate::transfer::criterion::{Criterion, Indicator};
use crate::transfer::fields::Mode;
use crate::transfer::region::Region;
use crate::transfer::substitution::{Origin, Replaced, Switch, replace_elements};
use std::collections::BTreeSet;

/// Particles for a box, and the law by which they fail.
#[derive(Debug, Clone)]
pub struct Filled {
    /// Particles and bonds, none of them broken.
    pub network: Network,
    /// Made for this network; `None` where nothing may break.
    pub failure: Option<Failure>,
}

/// Where and how elements become particles while a crack grows.
pub struct Growth<'a> {
    /// Name of the rule and of the body of particles.
    pub name: String,
    /// Name of the body of elements.
    pub body: String,
    /// What chooses elements; by stress.
    pub criterion: Criterion,
    /// The region always holds this box.
    pub holds: Option<Block>,
    /// Axes along which it always reaches through the whole body.
    pub through: [bool; 3],
    /// Most times that it may be made or grow.
    pub most: usize,
    /// Fills a box. Larger boxes must hold the particles of smaller ones in their places.
    pub fill: &'a dyn Fn(Block, Matter) -> Result<Filled>,
    /// How the new faces are tied.
    pub method: Method,
    /// Which side of the new ties carries the multipliers.
    pub multipliers: Multipliers,
    /// Whether the new ties hold rotations.
    pub rotations: bool,
}

/// One growth of the region.
#[derive(Debug, Clone, PartialEq)]
pub struct Grown {
    /// The box of particles from now on.
    pub block: Block,
    /// Elements that are particles now, of those the body began with.
    pub elements: usize,
    /// Particles in the box.
    pub particles: usize,
    /// What it did at held displacement.
    pub exchange: Exchange,
}

/// A model of elements, or of both, on its way to failure.
pub struct Adaptive<'a> {
    /// As it began.
    start: Model,
    growth: Option<Growth<'a>>,
    /// Index of the body of elements at the start.
    part: usize,
    cracking: Cracking,
    /// Parts of the present model that are what is left of the body.
    pieces: Vec<usize>,
    discrete: Option<usize>,
    block: Option<Block>,
    grown: Vec<Grown>,
}

impl<'a> Adaptive<'a> {
    /// Solves the model as it is; `laws` go with its bodies of particles. Without `growth` the path is that of [`Cracking`].
    ///
    /// # Errors
    /// As [`Cracking::new`]; a rule for a body that is not there or not of elements; a criterion other than stress.
    pub fn new(
        model: &Model,
        laws: Vec<(usize, Failure)>,
        growth: Option<Growth<'a>>,
        options: Options,
    ) -> Result<Self> {
        let part = match &growth {
            Some(growth) => check(model, growth)?,
            None => 0,
        };
        let cracking = Cracking::new(model, laws, options)?;
        Ok(Adaptive {
            start: model.clone(),
            growth,
            part,
            cracking,
            pieces: vec![part],
            discrete: None,
            block: None,
            grown: Vec::new(),
        })
    }

    /// The path so far.
    pub fn cracking(&self) -> &Cracking {
        &self.cracking
    }

    /// How the region has grown.
    pub fn grown(&self) -> &[Grown] {
        &self.grown
    }

    /// Grows the region where the criterion asks for it, and makes the next event; `None` at the end.
    ///
    /// # Errors
    /// What the criterion, filling or solving refuses; broken bonds on a face of the region that moves.
    pub fn advance(&mut self) -> Result<Option<&Event>> {
        while self.cracking.stop().is_none() {
            let first = match self.cracking.next_factor() {
                Some(factor) => factor,
                None => match self.first_firing()? {
                    Some(factor) => factor,
                    None => break,
                },
            };
            let limit = self.cracking.options.factor_limit;
            if first > limit {
                self.cracking.end(Stop::FactorLimit { factor: first });
                break;
            }
            match self.wanted(first)? {
                Some(region) => self.grow(&region, first)?,
                None => break,
            }
        }
        self.cracking.advance()
    }

    /// Goes on to the end.
    ///
    /// # Errors
    /// As [`Adaptive::advance`].
    pub fn run(mut self) -> Result<(Outcome, Vec<Grown>)> {
        while self.advance()?.is_some() {}
        Ok(self.outcome())
    }

    /// What has happened so far.
    pub fn outcome(self) -> (Outcome, Vec<Grown>) {
        (self.cracking.outcome(), self.grown)
    }

    /// Load factor at which the criterion first fires, where there are no particles yet.
    fn first_firing(&mut self) -> Result<Option<f64>> {
        let Some(growth) = self.growth.as_ref().filter(|g| self.block.is_none() && g.most > 0) else {
            return Ok(None);
        };
        let Some(Part::Continuum(body)) = self.cracking.model().parts.get(self.part) else { return Ok(None) };
        let first = self.cracking.numbering().offset(self.part);
        let u = &self.cracking.displacements()[first..first + body.dof_count()];
        let values = growth.criterion.values(body, u)?;
        let largest = values.iter().fold(0.0f64, |m, v| m.max(*v));
        let cells = body.mesh.cell_count();
        self.cracking.system.work.element_updates += cells as u64;
        // Just beyond, so that rounding does not keep it from firing.
        Ok((largest > 0.0).then(|| growth.criterion.trigger / largest * (1.0 + 1e-12)))
    }

    /// The region that the criterion asks for at a load factor; `None` if the present one will do.
    fn wanted(&mut self, factor: f64) -> Result<Option<Region>> {
        let Some(growth) = self.growth.as_ref().filter(|g| self.grown.len() < g.most) else {
            return Ok(None);
        };
        let mut wanted: Option<Block> = None;
        let mut asked = 0;
        let last = self.cracking.events().last().map_or(&[][..], |event| &event.places);
        for &piece in &self.pieces {
            let Part::Continuum(body) = &self.cracking.model().parts[piece] else { continue };
            let first = self.cracking.numbering().offset(piece);
            let u = &self.cracking.displacements()[first..first + body.dof_count()];
            let u: Vec<f64> = u.iter().map(|u| factor * u).collect();
            asked += body.mesh.cell_count() as u64;
            let mut chosen = growth.criterion.choose(body, &u, &BTreeSet::new())?;
            chosen.extend(near(body, last, growth.criterion.buffer_m));
            let nodes = chosen.iter().flat_map(|&c| body.mesh.cell(c)).map(|&n| body.mesh.nodes[n]);
            wanted = nodes.map(|x| Block { min: x, max: x }).chain(wanted).reduce(|a, b| a.around(&b));
        }
        self.cracking.system.work.element_updates += asked;
        let Some(wanted) = wanted else { return Ok(None) };
        let Part::Continuum(body) = &self.start.parts[self.part] else { return Ok(None) };
        let mut whole =
            [self.block, growth.holds].into_iter().flatten().fold(wanted, |all, b| all.around(&b));
        for i in (0..3).filter(|&i| growth.through[i]) {
            let along = || body.mesh.nodes.iter().map(|x| x[i]);
            whole.min[i] = along().fold(f64::INFINITY, f64::min);
            whole.max[i] = along().fold(f64::NEG_INFINITY, f64::max);
        }
        let region = Region::around(body, whole)?;
        Ok((Some(region.block) != self.block).then_some(region))
    }

    /// Fills a larger region, and goes on at the same displacement.
    fn grow(&mut self, region: &Region, factor: f64) -> Result<()> {
        let Some(growth) = &self.growth else { return Ok(()) };
        let start = self.with_present_bonds();
        let Part::Continuum(body) = &start.parts[self.part] else { return Ok(()) };
        let matter = Matter { density: body.elasticity.density, thickness_m: body.hypothesis.thickness() };
        let Filled { mut network, mut failure } = (growth.fill)(region.block, matter)?;
        let (old_model, discrete) = (self.cracking.model(), self.discrete);
        if let (Some(part), Some(failure)) = (discrete, &mut failure)
            && let Part::Discrete { network: old, .. } = &old_model.parts[part]
            && let Some((_, old_failure)) = self.cracking.laws().iter().find(|(p, _)| *p == part)
        {
            keep_cracks(&growth.name, (old, old_failure), (&mut network, failure))?;
        }
        let switch = Switch {
            part: self.part,
            region: region.clone(),
            name: growth.name.clone(),
            fill: &|_, _| Ok(network.clone()),
            method: growth.method,
            multipliers: growth.multipliers,
            rotations: growth.rotations,
            mode: Mode::Displacement,
            finite: false,
        };
        let Replaced { model, origins, discrete: filled } = replace_elements(&start, &switch)?;
        let others = self.cracking.laws().iter().filter(|(p, _)| Some(*p) != discrete).cloned();
        let laws = others.chain(failure.map(|law| (filled, law))).collect();
        self.cracking.exchange(&model, laws, factor)?;
        let is_piece = |o: &Origin| matches!(o, Origin::Piece { part, .. } if *part == self.part);
        self.pieces = (0..origins.len()).filter(|&p| is_piece(&origins[p])).collect();
        (self.discrete, self.block) = (Some(filled), Some(region.block));
        let exchange = self.cracking.exchanges().last().copied();
        self.grown.extend(exchange.map(|exchange| Grown {
            block: region.block,
            elements: region.cells.len(),
            particles: network.particles.len(),
            exchange,
        }));
        Ok(())
    }

    /// The model as it began, with what is left of the bonds of its own particles. Parts keep their indices in all models that follow.
    fn with_present_bonds(&self) -> Model {
        let mut start = self.start.clone();
        for (part, present) in start.parts.iter_mut().zip(&self.cracking.model().parts) {
            if let (Part::Discrete { network, .. }, Part::Discrete { network: now, .. }) = (part, present) {
                network.bonds.weight.clone_from(&now.bonds.weight);
            }
        }
        start
    }
}

/// The body of a rule, after a look at what could never work.
fn check(model: &Model, growth: &Growth) -> Result<usize> {
    let refuse = |message: String| Err(Error::Switch { what: format!("rule '{}'", growth.name), message });
    growth.criterion.check()?;
    if growth.criterion.indicator == Indicator::Error {
        return refuse(
            "the estimated error does not grow with the load, so it tells no load factor; take a stress criterion".to_owned(),
        );
    }
    match model.parts.iter().position(|p| p.name() == growth.body) {
        Some(part) if matches!(model.parts[part], Part::Continuum(_)) => Ok(part),
        Some(_) => refuse(format!("body '{}' is of particles already; name one of elements", growth.body)),
        None => refuse(format!("there is no body '{}'", growth.body)),
    }
}

/// Cells whose bounding box comes within `distance` (m) of one of some places.
fn near(body: &Continuum, places: &[Vec3], distance: f64) -> Vec<usize> {
    let mesh = &body.mesh;
    let within = |cell: usize| {
        let nodes = || mesh.cell(cell).iter().map(|&n| mesh.nodes[n]);
        let low = nodes().fold(Vec3::repeat(f64::INFINITY), |m, x| m.inf(&x));
        let high = nodes().fold(Vec3::repeat(f64::NEG_INFINITY), |m, x| m.sup(&x));
        places.iter().any(|x| (low - x).sup(&(x - high)).sup(&Vec3::zeros()).norm() < distance)
    };
    (0..mesh.cell_count()).filter(|&c| within(c)).collect()
}

/// Gives the bonds of a larger network what was left of them in the smaller one.
fn keep_cracks(
    rule: &str,
    (old, old_failure): (&Network, &Failure),
    (new, failure): (&mut Network, &mut Failure),
) -> Result<()> {
    let from = same_bonds(old, new);
    let mut kept = vec![false; old.bonds.len()];
    from.iter().flatten().for_each(|&b| kept[b] = true);
    if let Some(lost) = (0..kept.len()).find(|&b| !kept[b] && old_failure.integrity()[b] < 1.0) {
        let [i, j] = old.bonds.ends[lost];
        let x = 0.5 * (old.particles.position[i] + old.particles.position[j]);
        return Err(Error::Switch {
            what: format!("rule '{rule}'"),
            message: format!(
                "the broken bond {lost} at ({:.6}, {:.6}) m is no bond of the larger region: a crack has reached a face before the \
                 region grew, or the lattice has moved; widen the buffer, and let boxes end on rows of the lattice",
                x.x, x.y
            ),
        });
    }
    failure.inherit(old_failure, &from);
    new.bonds.weight.iter_mut().zip(failure.integrity()).for_each(|(w, integrity)| *w *= integrity);
    Ok(())
}
