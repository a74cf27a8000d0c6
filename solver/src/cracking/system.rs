//! Equilibrium at load factor one of a model whose bonds lose stiffness.
//!
//! A factorised base `K₀` (with its ties) and a low-rank update for what was lost since: bond modes V with losses D,
//!
//! `(K₀ − V D Vᵀ)⁻¹ = K₀⁻¹ + Z (D⁻¹ − VᵀZ)⁻¹ Zᵀ`, `Z = K₀⁻¹V` (Woodbury 1950),
//!
//! so `u = u₀ + Z (D⁻¹ − VᵀZ)⁻¹ Vᵀu₀` — with Vᵀ on all unknowns, prescribed ones included, also where bonds at supports are lost.
//! The true residual is checked and refined on; where that fails, and after [`Updating::most`] modes, a new base is factorised.

use super::base::{Base, Lasting};
use super::modes::Mode;
use super::pieces::Pieces;
use crate::error::{Error, Result};
use crate::model::{Model, Numbering, Part};
use crate::solve::mechanism;
use crate::work::Work;

/// How the equilibrium is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Updating {
    /// Largest number of modes (three per bond in the plane, six in the solid) before the matrix is factorised anew; zero factorises at
    /// every event.
    pub most: usize,
}

impl Default for Updating {
    /// About where both cost the same on plane networks of some thousand bonds.
    fn default() -> Self {
        Updating { most: 90 }
    }
}

/// Whether the bodies still hold.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Holding {
    Held,
    /// What carries the load is no longer held; in words.
    Separated(String),
}

/// A bond that loses stiffness.
pub(super) struct Weakened {
    pub part: usize,
    pub bond: usize,
    /// Weight so far and from now on.
    pub before: f64,
    pub after: f64,
    /// Modes of the bond on all unknowns, with the weight so far.
    pub modes: Vec<Mode>,
}

impl Weakened {
    /// Part and index.
    pub fn bond(&self) -> (usize, usize) {
        (self.part, self.bond)
    }
}

/// The system.
pub(super) struct System {
    /// The model; weights of bonds are what is left.
    pub model: Model,
    pub numbering: Numbering,
    /// All unknowns at load factor one; zero for points that were torn off.
    pub u: Vec<f64>,
    pub load: Vec<f64>,
    pub prescribed: Vec<Option<f64>>,
    pub work: Work,
    pub notes: Vec<String>,
    /// Events that were followed by an update alone.
    pub updates: u64,
    pieces: Pieces,
    lasting: Lasting,
    updating: Updating,
    base: Base,
}

impl System {
    /// # Errors
    /// As [`statics::solve`].
    pub fn new(model: &Model, updating: Updating) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let n = numbering.len();
        let mut work = Work::default();
        let (prescribed, load) = conditions(model, &numbering);
        let lasting = Lasting::new(model, &numbering, &mut work)?;
        let (base, softest) = Base::new(model, &numbering, &lasting, &load, &prescribed, &mut work)?;
        mechanism::refuse(model, &numbering, &base.free, softest)?;
        let pieces = Pieces::new(model, &numbering, &base.tied.rows);
        let notes = base.tied.notes.clone();
        let mut system = System {
            model: model.clone(),
            numbering,
            u: Vec::new(),
            load,
            prescribed,
            work,
            notes,
            updates: 0,
            pieces,
            lasting,
            updating,
            base,
        };
        system.u = system.base.solution[..n].to_vec();
        Ok(system)
    }

    /// The system of a model that takes the place of the one of `old`: with bonds that are broken already, whose pieces are taken off, and
    /// with the work and notes of both.
    ///
    /// # Errors
    /// As [`System::new`]; what carries load is not held.
    pub fn resumed(model: &Model, updating: Updating, old: &System) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let mut work = old.work;
        let (mut prescribed, load) = conditions(model, &numbering);
        let lasting = Lasting::new(model, &numbering, &mut work)?;
        let mut pieces = Pieces::resumed(model, &numbering, &lasting.rows);
        let held = match release(model, &numbering, &load, &mut prescribed, &mut pieces) {
            Holding::Held => {
                settle(model, &numbering, &lasting, &load, &mut prescribed, &mut pieces, &mut work)?
            }
            Holding::Separated(what) => Err(what),
        };
        let base = held.map_err(|message| Error::Load { what: "cracking".to_owned(), message })?;
        let mut notes = old.notes.clone();
        notes.extend(base.tied.notes.iter().filter(|note| !old.notes.contains(note)).cloned());
        let u = base.solution[..numbering.len()].to_vec();
        let (model, updates) = (model.clone(), old.updates);
        Ok(System {
            model,
            numbering,
            u,
            load,
            prescribed,
            work,
            notes,
            updates,
            pieces,
            lasting,
            updating,
            base,
        })
    }

    /// `K u` on all unknowns, with what is left of the bonds.
    pub fn internal(&self) -> Vec<f64> {
        self.base.internal(&self.u)
    }

    /// Points that were torn off, as (part, point), in the order they were.
    pub fn torn_off(&self) -> &[(usize, usize)] {
        self.pieces.torn_off()
    }

    /// Sets what is left of some bonds and finds the new equilibrium.
    ///
    /// # Errors
    /// Solves that fail.
    pub fn weaken(&mut self, bonds: &[Weakened]) -> Result<Holding> {
        let mut broken = false;
        for &Weakened { part, bond, after, .. } in bonds {
            if let Part::Discrete { network, .. } = &mut self.model.parts[part] {
                network.bonds.weight[bond] = after;
                broken |= after == 0.0;
            }
        }
        let held = self.prescribed.iter().flatten().count();
        if broken {
            let System { model, numbering, load, prescribed, pieces, .. } = self;
            if let Holding::Separated(what) = release(model, numbering, load, prescribed, pieces) {
                return Ok(Holding::Separated(what));
            }
        }
        let released = self.prescribed.iter().flatten().count() > held;
        if !released && self.try_update(bonds) {
            self.updates += 1;
            return Ok(Holding::Held);
        }
        self.refactorise()
    }

    /// Follows by an update; `false` where a new base is called for.
    fn try_update(&mut self, bonds: &[Weakened]) -> bool {
        // Further teeth of bonds that are in the update already cost nothing new.
        let new: usize = bonds.iter().filter(|b| !self.base.has(b.bond())).map(|b| b.modes.len()).sum();
        if self.base.updated_modes() + new > self.updating.most {
            return false;
        }
        for weakened in bonds {
            if self.base.has(weakened.bond()) {
                self.base.lose(weakened);
            } else {
                self.base.add(weakened, &mut self.work);
            }
        }
        if !self.base.factorise_update() {
            return false;
        }
        let solution = self.base.updated_solution(&self.load, &mut self.work);
        let found = solution.is_some();
        if let Some(solution) = solution {
            self.u = solution;
        }
        found
    }

    /// Factorises what is left.
    fn refactorise(&mut self) -> Result<Holding> {
        let System { model, numbering, lasting, load, prescribed, pieces, work, .. } = self;
        match settle(model, numbering, lasting, load, prescribed, pieces, work)? {
            Err(what) => Ok(Holding::Separated(what)),
            Ok(base) => {
                self.base = base;
                self.u = self.base.solution[..self.numbering.len()].to_vec();
                Ok(Holding::Held)
            }
        }
    }
}

/// Whether an unknown is loaded, by a force or a prescribed motion.
fn is_loaded(load: &[f64], prescribed: &[Option<f64>], i: usize) -> bool {
    load[i] != 0.0 || prescribed[i].is_some_and(|v| v != 0.0)
}

/// Takes off what hangs on nothing: its unknowns rest from now on.
fn release(
    model: &Model,
    numbering: &Numbering,
    load: &[f64],
    prescribed: &mut [Option<f64>],
    pieces: &mut Pieces,
) -> Holding {
    match pieces.release(model, numbering, prescribed, |i| is_loaded(load, prescribed, i)) {
        Err(what) => Holding::Separated(what),
        Ok(fixed) => {
            fixed.into_iter().for_each(|i| prescribed[i] = Some(0.0));
            Holding::Held
        }
    }
}

/// Factorises; pieces that turn out to move freely go. The base, or in words what of them was loaded.
fn settle(
    model: &Model,
    numbering: &Numbering,
    lasting: &Lasting,
    load: &[f64],
    prescribed: &mut [Option<f64>],
    pieces: &mut Pieces,
    work: &mut Work,
) -> Result<std::result::Result<Base, String>> {
    loop {
        let (base, softest) = Base::new(model, numbering, lasting, load, prescribed, work)?;
        if softest.1 > mechanism::FREE {
            return Ok(Ok(base));
        }
        let mut motion = vec![0.0; numbering.len()];
        base.free.iter().zip(&softest.0).for_each(|(&i, &v)| motion[i] = v);
        let found = pieces.release_moving(model, numbering, &motion, |i| is_loaded(load, prescribed, i));
        match found {
            Err(what) => return Ok(Err(what)),
            Ok(fixed) => fixed.into_iter().for_each(|i| prescribed[i] = Some(0.0)),
        }
    }
}

/// Prescribed values and loads on all unknowns.
fn conditions(model: &Model, numbering: &Numbering) -> (Vec<Option<f64>>, Vec<f64>) {
    let mut prescribed = vec![None; numbering.len()];
    for s in &model.supports {
        prescribed[numbering.unknown(s.part, s.point, s.component)] = Some(s.value);
    }
    let mut load = vec![0.0; numbering.len()];
    model.loads.iter().for_each(|l| load[numbering.unknown(l.part, l.point, l.component)] += l.value);
    (prescribed, load)
}
