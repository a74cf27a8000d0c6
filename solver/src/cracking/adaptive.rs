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
use crate::transfer::criterion::{Criterion, Indicator, buffered};
use crate::transfer::fields::Mode;
use crate::transfer::region::Region;
use crate::transfer::substitution::{Origin, Replaced, Switch, replace_elements};
use crate::transfer::watch::Watch;

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
    /// When a region has to grow, it takes elements that are this much farther (m) than those it has to: it grows less often.
    pub stride_m: f64,
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
    /// The criterion, ready to be asked of the body as it began; `None` without growth.
    watch: Option<Watch>,
    /// Which of its elements are left.
    left: Vec<bool>,
    /// Parts of the present model that are what is left of the body, with the node that each of theirs was.
    pieces: Vec<(usize, Vec<usize>)>,
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
        let (mut watch, mut left, mut pieces) = (None, Vec::new(), Vec::new());
        if let (Some(growth), Some(Part::Continuum(body))) = (&growth, model.parts.get(part)) {
            watch = Some(Watch::new(&growth.criterion, body)?);
            left = vec![true; body.mesh.cell_count()];
            pieces = vec![(part, (0..body.mesh.nodes.len()).collect())];
        }
        Ok(Adaptive {
            start: model.clone(),
            growth,
            part,
            cracking,
            watch,
            left,
            pieces,
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
                None => match self.first_firing() {
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

    /// The criterion's indicator of every element that is left at load factor one; zero of those that are particles.
    fn indicators(&mut self) -> Vec<f64> {
        let (Some(watch), Part::Continuum(body)) = (&mut self.watch, &self.start.parts[self.part]) else {
            return Vec::new();
        };
        let dim = body.mesh.space.dim();
        let mut u = vec![0.0; body.dof_count()];
        for (piece, nodes) in &self.pieces {
            let first = self.cracking.numbering().offset(*piece);
            let own = self.cracking.displacements()[first..].chunks_exact(dim);
            nodes.iter().zip(own).for_each(|(n, own)| u[n * dim..(n + 1) * dim].copy_from_slice(own));
        }
        self.cracking.system.work.element_updates += self.left.iter().filter(|left| **left).count() as u64;
        watch.values(&body.mesh, &u, &self.left).to_vec()
    }

    /// Load factor at which the criterion first fires, where there are no particles yet.
    fn first_firing(&mut self) -> Option<f64> {
        let growth = self.growth.as_ref().filter(|g| self.block.is_none() && g.most > 0)?;
        let trigger = growth.criterion.trigger;
        let largest = self.indicators().into_iter().fold(0.0f64, f64::max);
        // Just beyond, so that rounding does not keep it from firing.
        (largest > 0.0).then(|| trigger / largest * (1.0 + 1e-12))
    }

    /// The region that the criterion asks for at a load factor; `None` if the present one will do.
    fn wanted(&mut self, factor: f64) -> Result<Option<Region>> {
        if self.growth.as_ref().is_none_or(|g| self.grown.len() >= g.most) {
            return Ok(None);
        }
        let values = self.indicators();
        let (Some(growth), Part::Continuum(body)) = (&self.growth, &self.start.parts[self.part]) else {
            return Ok(None);
        };
        // Stress grows with the load, and its indicator with it.
        let fired: Vec<usize> =
            (0..values.len()).filter(|&c| factor * values[c] >= growth.criterion.trigger).collect();
        let last = self.cracking.events().last().map_or(&[][..], |event| &event.places);
        let within = |distance: f64| -> Vec<usize> {
            let mut chosen = near(body, last, distance);
            if !fired.is_empty() {
                chosen.extend(buffered(body, &fired, distance));
            }
            chosen.retain(|&c| self.left[c]);
            chosen
        };
        let buffer = growth.criterion.buffer_m;
        let mut chosen = within(buffer);
        if !chosen.is_empty() && growth.stride_m > 0.0 && self.block.is_some() {
            chosen = within(buffer + growth.stride_m);
        }
        let nodes = chosen.iter().flat_map(|&c| body.mesh.cell(c)).map(|&n| body.mesh.nodes[n]);
        let Some(wanted) = nodes.map(|x| Block { min: x, max: x }).reduce(|a, b| a.around(&b)) else {
            return Ok(None);
        };
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
        let piece = |(p, origin): (usize, Origin)| match origin {
            Origin::Piece { part, nodes } if part == self.part => Some((p, nodes)),
            _ => None,
        };
        self.pieces = origins.into_iter().enumerate().filter_map(piece).collect();
        region.cells.iter().for_each(|&c| self.left[c] = false);
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
    if !(growth.stride_m.is_finite() && growth.stride_m >= 0.0) {
        return refuse(format!("stride_m = {}; give a length, zero for none", growth.stride_m));
    }
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
