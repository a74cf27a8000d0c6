//! A region of elements becomes a body of particles: the new model and its state.
//!
//! What stays of the elements falls into pieces, each a body of its own; the particles fill exactly the box of the elements that
//! go and are tied to every piece along the faces they share. Ties of the old body are kept where its faces are, and made to the particles where
//! they were of elements that go: so a region can grow by a second switch beside the first.

use super::equilibrium;
use super::fields::Mode;
use super::pieces::{Piece, cut, face_between, new_boundary, pieces};
use super::points::{move_supports, spread};
use super::region::Region;
use super::report::{self, InterfaceForce, SwitchReport};
use super::state::map_state;
use crate::coupling::{Method, Multipliers, Tie};
use crate::dem::arrangement::Matter;
use crate::dem::block::Block;
use crate::dem::network::Network;
use crate::dynamics::State;
use crate::dynamics::semidiscrete::lumped;
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::model::{Model, Numbering, Part, PointValue};
use crate::space::Vec3;
use crate::stage::{Stage, timed};
use crate::work::Work;
use std::collections::{BTreeMap, BTreeSet};

/// What to switch, and how.
pub struct Switch<'a> {
    /// Index of the body of elements.
    pub part: usize,
    /// The elements that go.
    pub region: Region,
    /// Name of the new body.
    pub name: String,
    /// Packs particles into a box.
    pub fill: &'a dyn Fn(Block, Matter) -> Result<Network>,
    /// How the new faces are tied.
    pub method: Method,
    /// Which side of the new ties carries the multipliers.
    pub multipliers: Multipliers,
    /// Whether the new ties hold rotations.
    pub rotations: bool,
    /// What the particles take over.
    pub mode: Mode,
    /// Whether rotations are taken from the polar decomposition.
    pub finite: bool,
}

/// A model after a switch.
#[derive(Debug, Clone)]
pub struct Switched {
    /// The new model. Parts keep their indices; the first piece of the old body takes its index, further pieces and then the
    /// particles come last (the particles take its index if nothing stays).
    pub model: Model,
    /// The new state.
    pub state: State,
    /// Index of the new body of particles.
    pub discrete: usize,
    /// For every new part, where it comes from.
    pub origins: Vec<Origin>,
    /// What the switch did.
    pub report: SwitchReport,
}

/// Where a part of the new model comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// This part of the old model, unchanged.
    Kept(usize),
    /// Elements of a part: node `i` was `nodes[i]`.
    Piece {
        /// The old part.
        part: usize,
        /// Its old nodes.
        nodes: Vec<usize>,
    },
    /// New particles.
    Filled,
}

/// Replaces elements by particles in a model and a state, with the loads scaled by `factor` at this time.
///
/// # Errors
/// As [`replace_elements`], and whatever solving the new model refuses.
pub fn substitute(
    model: &Model,
    state: &State,
    switch: &Switch,
    factor: f64,
    work: &mut Work,
) -> Result<Switched> {
    let (Replaced { model: new, origins, discrete }, pieces) = replace(model, switch)?;
    let mut mapped = map_state(model, state, &new, &origins, switch, discrete)?;
    let before = report::balance(model, state, factor, work)?;
    let as_mapped = report::balance(&new, &mapped, factor, work)?;
    if switch.mode >= Mode::ReEquilibrate {
        let mass = lumped(&new, &Numbering::new(&new))?;
        let relax = || equilibrium::relax(&new, discrete, &mut mapped, factor, &mass);
        *work += timed(Stage::Relaxation, relax)?;
    }
    let after = report::balance(&new, &mapped, factor, work)?;
    let interface = interface_forces(model, state, &new, &mapped, switch, &pieces, discrete)?;
    let report = SwitchReport {
        time: state.time,
        elements: switch.region.cells.len(),
        particles: new.parts[discrete].positions().len(),
        before,
        mapped: as_mapped,
        after,
        interface,
    };
    Ok(Switched { model: new, state: mapped, discrete, origins, report })
}

/// A model with particles in place of elements, without a state.
#[derive(Debug, Clone)]
pub struct Replaced {
    /// The new model; parts as in [`Switched`].
    pub model: Model,
    /// For every new part, where it comes from.
    pub origins: Vec<Origin>,
    /// Index of the new body of particles.
    pub discrete: usize,
}

/// Replaces elements by particles in a model; its state has to be found anew.
///
/// # Errors
/// A part that is not made of elements, a filling that does not fill, supports or loads that cannot move.
pub fn replace_elements(model: &Model, switch: &Switch) -> Result<Replaced> {
    replace(model, switch).map(|(replaced, _)| replaced)
}

fn replace(model: &Model, switch: &Switch) -> Result<(Replaced, Vec<Piece>)> {
    let Some(Part::Continuum(body)) = model.parts.get(switch.part) else {
        let message = format!("part {} is not made of elements; name one that is", switch.part);
        return Err(Error::Switch { what: "switch".to_owned(), message });
    };
    if model.parts.iter().any(|p| p.name() == switch.name) {
        let message =
            format!("there is a body '{}' already; give every switch a name of its own", switch.name);
        return Err(Error::Switch { what: "switch".to_owned(), message });
    }
    let network = fill(body, switch)?;
    let pieces = pieces(body, switch);
    let discrete = if pieces.is_empty() { switch.part } else { model.parts.len() + pieces.len() - 1 };
    let mut parts = model.parts.clone();
    let mut origins: Vec<Origin> = (0..parts.len()).map(Origin::Kept).collect();
    let mut index_of_piece = Vec::new();
    for (k, piece) in pieces.iter().enumerate() {
        let (part, origin) = (
            Part::Continuum(piece.body.clone()),
            Origin::Piece { part: switch.part, nodes: piece.nodes.clone() },
        );
        place(&mut parts, &mut origins, if k == 0 { switch.part } else { usize::MAX }, part, origin);
        index_of_piece.push(if k == 0 { switch.part } else { parts.len() - 1 });
    }
    let particles = Part::Discrete { name: switch.name.clone(), network };
    place(
        &mut parts,
        &mut origins,
        if pieces.is_empty() { switch.part } else { usize::MAX },
        particles,
        Origin::Filled,
    );
    let mut new = Model {
        space: model.space,
        parts,
        ties: ties(model, switch, body, &pieces, &index_of_piece, discrete),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    move_values(model, &mut new, switch, &pieces, &index_of_piece, discrete)?;
    Ok((Replaced { model: new, origins, discrete }, pieces))
}

/// Puts a part at an index, or at the end beyond the last.
fn place(parts: &mut Vec<Part>, origins: &mut Vec<Origin>, at: usize, part: Part, origin: Origin) {
    if at < parts.len() {
        (parts[at], origins[at]) = (part, origin);
    } else {
        parts.push(part);
        origins.push(origin);
    }
}

/// Mass of the particles may differ from that of the elements by this share: sums of thousands of cells.
const MASS: f64 = 1e-9;

/// The particles, checked to fill the box with the mass of the elements.
fn fill(body: &Continuum, switch: &Switch) -> Result<Network> {
    let matter = Matter { density: body.elasticity.density, thickness_m: body.hypothesis.thickness() };
    let network = (switch.fill)(switch.region.block, matter)?;
    let refuse = |message: String| {
        Err(Error::Switch { what: format!("filling '{}' of body '{}'", switch.name, body.name), message })
    };
    if network.space != body.mesh.space {
        return refuse(format!("it is {:?}, the body {:?}; use one space", network.space, body.mesh.space));
    }
    let mass: f64 = network.particles.mass.iter().sum();
    let wanted = matter.density * switch.region.measure(&body.mesh) * matter.thickness_m;
    let off = (mass / wanted - 1.0).abs();
    if off.is_nan() || off > MASS {
        return refuse(format!(
            "its mass is {mass:.9e} kg, that of the elements {wanted:.9e} kg; fill the whole box, but for its notch"
        ));
    }
    for (face, _, _) in Block::faces(network.space) {
        if network.faces.get(*face).is_none_or(|f| f.len() < 2) {
            return refuse(format!(
                "it has no particles on its face '{face}'; its faces must be flat and filled"
            ));
        }
    }
    Ok(network)
}

/// New ties along the faces of the region, and the old ones where their faces went.
fn ties(
    model: &Model,
    switch: &Switch,
    body: &Continuum,
    pieces: &[Piece],
    index_of_piece: &[usize],
    discrete: usize,
) -> Vec<Tie> {
    let mut ties = Vec::new();
    for tie in &model.ties {
        let firsts = successors(&tie.first, switch, body, pieces, index_of_piece, discrete);
        let seconds = successors(&tie.second, switch, body, pieces, index_of_piece, discrete);
        let several = firsts.len() * seconds.len() > 1;
        for first in &firsts {
            for second in &seconds {
                let name =
                    if several { format!("{}.{}", tie.name, ties.len() + 1) } else { tie.name.clone() };
                ties.push(Tie { name, first: first.clone(), second: second.clone(), ..tie.clone() });
            }
        }
    }
    for (piece, &index) in pieces.iter().zip(index_of_piece) {
        for (face, _, _) in Block::faces(model.space) {
            let boundary = new_boundary(switch, face);
            if piece.body.mesh.boundaries.contains_key(&boundary) {
                ties.push(Tie {
                    name: format!("{} of '{}'", boundary, piece.body.name),
                    first: (index, boundary),
                    second: (discrete, (*face).to_owned()),
                    method: switch.method,
                    multipliers: switch.multipliers,
                    rotations: switch.rotations,
                });
            }
        }
    }
    ties
}

/// Where the end of an old tie is now: the pieces that still have facets of its face, and the particles where elements went.
fn successors(
    end: &(usize, String),
    switch: &Switch,
    body: &Continuum,
    pieces: &[Piece],
    index_of_piece: &[usize],
    discrete: usize,
) -> Vec<(usize, String)> {
    if end.0 != switch.part {
        return vec![end.clone()];
    }
    let mut found = Vec::new();
    for (piece, &index) in pieces.iter().zip(index_of_piece) {
        if piece.body.mesh.boundaries.contains_key(&end.1) {
            found.push((index, end.1.clone()));
        }
    }
    let gone = body.mesh.boundaries.get(&end.1).into_iter().flatten();
    let gone = gone.filter(|f| switch.region.cells.binary_search(&f.cell).is_ok());
    let faces: BTreeSet<&str> = gone.filter_map(|f| face_between(&body.mesh, &switch.region, f)).collect();
    found.extend(faces.into_iter().map(|face| (discrete, face.to_owned())));
    found
}

/// Supports and loads of the new model.
fn move_values(
    model: &Model,
    new: &mut Model,
    switch: &Switch,
    pieces: &[Piece],
    index_of_piece: &[usize],
    discrete: usize,
) -> Result<()> {
    let (Part::Continuum(body), Part::Discrete { network, .. }) =
        (&model.parts[switch.part], &new.parts[discrete])
    else {
        return Ok(());
    };
    let successor = |node: usize| {
        pieces
            .iter()
            .zip(index_of_piece)
            .find_map(|(piece, &index)| Some((index, piece.nodes.binary_search(&node).ok()?)))
    };
    let gone: BTreeSet<usize> = switch
        .region
        .cells
        .iter()
        .flat_map(|&c| body.mesh.cell(c).iter().copied())
        .filter(|&n| successor(n).is_none())
        .collect();
    let stays = |v: &PointValue| match v.part == switch.part {
        false => Some(*v),
        true => successor(v.point).map(|(part, point)| PointValue { part, point, ..*v }),
    };
    let mut supports: Vec<PointValue> = model.supports.iter().filter_map(stays).collect();
    let mut loads: Vec<PointValue> = model.loads.iter().filter_map(stays).collect();
    let own = model.supports.iter().filter(|v| v.part == switch.part);
    let held: BTreeMap<(usize, usize), f64> = own.map(|v| ((v.point, v.component), v.value)).collect();
    for ((point, component), value) in move_supports(body, network, &held, &gone)? {
        supports.push(PointValue { part: discrete, point, component, value });
    }
    for load in model.loads.iter().filter(|l| l.part == switch.part && gone.contains(&l.point)) {
        for (point, share) in spread(&switch.name, network, body.mesh.nodes[load.point])? {
            loads.push(PointValue { part: discrete, point, value: share * load.value, ..*load });
        }
    }
    (new.supports, new.loads) = (supports, loads);
    Ok(())
}

/// Force through every coupled face of the region, by the elements that went and by the particles that came.
fn interface_forces(
    model: &Model,
    state: &State,
    new: &Model,
    mapped: &State,
    switch: &Switch,
    pieces: &[Piece],
    discrete: usize,
) -> Result<Vec<InterfaceForce>> {
    let Part::Continuum(body) = &model.parts[switch.part] else { return Ok(Vec::new()) };
    let gone = cut(body, &switch.region.cells, body.name.clone(), |_| None);
    let dim = model.space.dim();
    let first = Numbering::new(model).offset(switch.part);
    let u =
        gone.nodes.iter().flat_map(|&n| state.u[first + n * dim..first + (n + 1) * dim].to_vec()).collect();
    let rest = vec![0.0; gone.nodes.len() * dim];
    let alone_state = State { time: state.time, u, v: rest.clone(), a: rest };
    let alone = Model {
        space: model.space,
        parts: vec![Part::Continuum(gone.body)],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    let mut forces = Vec::new();
    for (face, axis, upper) in Block::faces(model.space) {
        let boundary = new_boundary(switch, face);
        if !pieces.iter().any(|p| p.body.mesh.boundaries.contains_key(&boundary)) {
            continue;
        }
        let on = |x: Vec3| switch.region.block.on_face(x, *axis, *upper);
        let before = report::force_on(&alone, 0, &alone_state, &report::points_on(&alone.parts[0], on))?;
        let points = report::points_on(&new.parts[discrete], on);
        let after = report::force_on(new, discrete, mapped, &points)?;
        forces.push(InterfaceForce { face: (*face).to_owned(), before, after });
    }
    Ok(forces)
}
