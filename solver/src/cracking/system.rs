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
    /// All unknowns at load factor one in the last equilibrium there was; zero for points that were torn off.
    pub u: Vec<f64>,
    /// `K u` on all unknowns, with what was left of the bonds in this equilibrium.
    pub internal: Vec<f64>,
    pub load: Vec<f64>,
    pub prescribed: Vec<Option<f64>>,
    pub work: Work,
    pub notes: Vec<String>,
    /// Events that were followed by an update alone.
    pub updates: u64,
    pieces: Pieces,
    lasting: Lasting,
    updating: Updating,
    /// `None` once it was let go: what fails next calls for a new one.
    base: Option<Base>,
}

impl System {
    /// # Errors
    /// As [`statics::solve`].
    pub fn new(model: &Model, updating: Updating) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let mut work = Work::default();
        let (prescribed, load) = conditions(model, &numbering);
        let lasting = Lasting::new(model, &numbering, &mut work)?;
        let (base, softest) = Base::new(model, &numbering, &lasting, &load, &prescribed, &mut work)?;
        mechanism::refuse(model, &numbering, &base.free, softest)?;
        let pieces = Pieces::new(model, &numbering, &base.tied.rows);
        let notes = base.tied.notes.clone();
        let (u, internal) = base.state();
        Ok(System {
            model: model.clone(),
            numbering,
            u,
            internal,
            load,
            prescribed,
            work,
            notes,
            updates: 0,
            pieces,
            lasting,
            updating,
            base: Some(base),
        })
    }

    /// The system of a model that takes the place of the one of `old`: with bonds that are broken already, whose pieces are taken off, and
    /// with the work and notes of both. The old one lets its factor go, to make room; it is sound without.
    ///
    /// # Errors
    /// As [`System::new`]; what carries load is not held.
    pub fn resumed(model: &Model, updating: Updating, old: &mut System) -> Result<Self> {
        old.base = None;
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
        let (u, internal) = base.state();
        let (model, updates) = (model.clone(), old.updates);
        Ok(System {
            model,
            numbering,
            u,
            internal,
            load,
            prescribed,
            work,
            notes,
            updates,
            pieces,
            lasting,
            updating,
            base: Some(base),
        })
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
        let Some(base) = &mut self.base else { return false };
        // Further teeth of bonds that are in the update already cost nothing new.
        let new: usize = bonds.iter().filter(|b| !base.has(b.bond())).map(|b| b.modes.len()).sum();
        if base.updated_modes() + new > self.updating.most {
            return false;
        }
        for weakened in bonds {
            if base.has(weakened.bond()) {
                base.lose(weakened);
            } else {
                base.add(weakened, &mut self.work);
            }
        }
        if !base.factorise_update() {
            return false;
        }
        let updated = base.updated_state(&self.load, &mut self.work);
        let found = updated.is_some();
        if let Some(state) = updated {
            (self.u, self.internal) = state;
        }
        found
    }

    /// Factorises what is left.
    fn refactorise(&mut self) -> Result<Holding> {
        let System { model, numbering, lasting, load, prescribed, pieces, work, base, .. } = self;
        *base = None;
        match settle(model, numbering, lasting, load, prescribed, pieces, work)? {
            Err(what) => Ok(Holding::Separated(what)),
            Ok(settled) => {
                (self.u, self.internal) = settled.state();
                self.base = Some(settled);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cracking::modes::modes;
    use crate::cracking::{Cracking, Options, Stop};
    use crate::dem::arrangement::Matter;
    use crate::dem::block::Block;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, bond_network};
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::failure::bond_stress::BondStress;
    use crate::failure::strength::Strength;
    use crate::failure::{Failure, FailureLaw, FailureRecipe, Place};
    use crate::model::PointValue;
    use crate::space::{Space, Vec3};

    /// A strip that hangs from its left end.
    fn strip() -> Model {
        let block = Block::at_origin(Space::Plane, Vec3::new(8.0, 3.0, 0.0)).unwrap();
        let l = lattice(LatticeKind::Square, block, 3, Matter::default()).unwrap();
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
            section: Section::Uniform { ratio: 0.6 },
            skin: Skin::Weighted,
        };
        let network = bond_network(&l.arrangement, &l.pairs, &recipe).unwrap();
        let value = |point, component, value| PointValue { part: 0, point, component, value };
        let x = &network.particles.position;
        let left = (0..x.len()).filter(|&p| x[p].x < 1e-9);
        let supports = left.flat_map(|p| (0..3).map(move |c| value(p, c, 0.0))).collect();
        let tip = (0..x.len()).max_by(|&a, &b| (x[a].x + x[a].y).total_cmp(&(x[b].x + x[b].y))).unwrap();
        let loads = vec![value(tip, 1, -1.0)];
        let parts = vec![Part::Discrete { name: "strip".to_owned(), network }];
        Model { space: Space::Plane, parts, ties: Vec::new(), supports, loads }
    }

    /// A bond breaks.
    fn weaken(system: &mut System, bond: usize) {
        let Part::Discrete { network, .. } = &system.model.parts[0] else { panic!("no bonds") };
        let modes = modes(network, bond, 1.0);
        let broken = Weakened { part: 0, bond, before: 1.0, after: 0.0, modes };
        assert_eq!(system.weaken(&[broken]).unwrap(), Holding::Held);
    }

    /// What let its factor go for a model that never came goes on as if it had not.
    #[test]
    fn a_system_without_its_factor_is_sound() {
        let model = strip();
        let mut kept = System::new(&model, Updating::default()).unwrap();
        let mut left = System::new(&model, Updating::default()).unwrap();
        let inner = |system: &System| {
            let Part::Discrete { network, .. } = &system.model.parts[0] else { panic!("no bonds") };
            (0..network.bonds.len()).filter(|&b| network.bonds.weight[b] == 1.0).collect::<Vec<_>>()
        };
        let bonds = inner(&kept);
        weaken(&mut kept, bonds[3]);
        weaken(&mut left, bonds[3]);
        let mut unsound = model.clone();
        if let Part::Discrete { network, .. } = &mut unsound.parts[0] {
            network.bonds.stiffness[0].kn = f64::NAN;
        }
        assert!(System::resumed(&unsound, Updating::default(), &mut left).is_err());
        assert!(left.base.is_none() && left.u == kept.u && left.internal == kept.internal);
        for &bond in &bonds[7..9] {
            weaken(&mut kept, bond);
            weaken(&mut left, bond);
            let largest = kept.u.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            let off = kept.u.iter().zip(&left.u).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-11 * largest, "{off:e} of {largest:e}");
            // What is kept of K u is that of a model which never had these bonds.
            let fresh = System::new(&left.model, Updating::default()).unwrap();
            for system in [&kept, &left] {
                let off = system.internal.iter().zip(&fresh.internal).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) <= 1e-11, "of a unit load");
            }
        }
        // One was factorised once, the other again where it had let go.
        assert_eq!([kept.work.factorisations, left.work.factorisations], [1, 2]);
    }

    /// A solve that fails after a bond has: the path is over, and what it says is of the equilibrium before.
    #[test]
    fn a_path_ends_where_a_solve_fails() {
        let model = strip();
        let Part::Discrete { network, .. } = &model.parts[0] else { panic!("no bonds") };
        let tensile = Strength::Stress { strength_pa: 1.0 };
        let law = FailureLaw::BondStress(BondStress::Normal { tensile });
        let place = Place { network, body: "strip", breakable: None, area_m2: None };
        let failure = Failure::new(&FailureRecipe { law, weibull: None }, &place).unwrap();
        let anew = Options { updating: Updating { most: 0 }, ..Options::default() };
        let mut path = Cracking::new(&model, vec![(0, failure)], anew).unwrap();
        assert!(path.advance().unwrap().is_some());
        let (before, events) = (path.displacements().to_vec(), path.events().len());
        if let Part::Discrete { network, .. } = &mut path.system.model.parts[0] {
            network.bonds.stiffness[0].kn = f64::NAN;
        }
        assert!(path.advance().is_err());
        assert_eq!(path.stop(), Some(&Stop::Unsolved));
        assert!(path.advance().unwrap().is_none());
        assert!(path.displacements() == before && path.events().len() == events);
    }
}
