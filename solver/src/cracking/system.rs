//! Equilibrium at load factor one of a model whose bonds lose stiffness.
//!
//! A factorised base `K₀` (with its ties) and a low-rank update for what was lost since: bond modes V with losses D,
//!
//! `(K₀ − V D Vᵀ)⁻¹ = K₀⁻¹ + Z (D⁻¹ − VᵀZ)⁻¹ Zᵀ`, `Z = K₀⁻¹V` (Woodbury 1950),
//!
//! so `u = u₀ + Z (D⁻¹ − VᵀZ)⁻¹ Vᵀu₀` — with Vᵀ on all unknowns, prescribed ones included, also where bonds at supports are lost.
//! The true residual is checked and refined on; where that fails, and after [`Updating::most`] modes, a new base is factorised.

use super::capacitance::Capacitance;
use super::modes::{Mode, modes, product};
use super::pieces::Pieces;
use crate::dem;
use crate::error::{Error, Result};
use crate::fem;
use crate::model::{Model, Numbering, Part};
use crate::solve::kkt::{EPSILONS, Kkt, KktSolution, Layout};
use crate::solve::mechanism;
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::solve::statics::{self, Constraints};
use crate::space::Vec3;
use crate::work::Work;
use std::collections::BTreeMap;

/// A residual (relative, scaled) above this is refined on.
const REFINED: f64 = 1e-13;
/// A residual that refinement leaves above this calls for a new base.
const REFUSED: f64 = 1e-11;
const MOST_REFINEMENTS: usize = 3;

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
    elements: Triplets,
    updating: Updating,
    base: Base,
}

struct Base {
    /// None without free unknowns.
    kkt: Option<Kkt>,
    /// On all unknowns.
    stiffness: SymmetricMatrix,
    free: Vec<usize>,
    tied: Constraints,
    /// `u₀` on all unknowns, then the multipliers.
    solution: Vec<f64>,
    /// Root of the diagonal of `K₀`, inverted: scales residuals.
    scale: Vec<f64>,
    updated: Vec<Updated>,
    place_of: BTreeMap<(usize, usize), std::ops::Range<usize>>,
    capacitance: Capacitance,
}

/// One mode of a bond that has lost stiffness since the base was factorised.
struct Updated {
    /// Weight of the bond in the base.
    weight: f64,
    /// On all unknowns.
    mode: Mode,
    /// `Z` on all unknowns, then the multipliers.
    z: Vec<f64>,
}

impl System {
    /// # Errors
    /// As [`statics::solve`].
    pub fn new(model: &Model, updating: Updating) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let n = numbering.len();
        let mut work = Work::default();
        let mut prescribed = vec![None; n];
        model.supports.iter().for_each(|s| {
            prescribed[numbering.unknown(s.part, s.point, s.component)] = Some(s.value);
        });
        let mut load = vec![0.0; n];
        model.loads.iter().for_each(|l| load[numbering.unknown(l.part, l.point, l.component)] += l.value);
        let elements = elements(model, &numbering, &mut work)?;
        let (base, softest) = Base::new(model, &numbering, &elements, &load, &prescribed, &mut work)?;
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
            elements,
            updating,
            base,
        };
        system.u = system.base.solution[..n].to_vec();
        Ok(system)
    }

    /// `K u` on all unknowns, with what is left of the bonds.
    pub fn internal(&self) -> Vec<f64> {
        self.base.internal(&self.u)
    }

    /// Points that were torn off, as (part, point), in the order they were.
    pub fn torn_off(&self) -> &[(usize, usize)] {
        self.pieces.torn_off()
    }

    /// Sets what is left of some bonds (part, bond, weight) and finds the new equilibrium.
    ///
    /// # Errors
    /// Solves that fail.
    pub fn weaken(&mut self, bonds: &[(usize, usize, f64)]) -> Result<Holding> {
        let mut broken = false;
        let mut before = Vec::with_capacity(bonds.len());
        for &(part, bond, weight) in bonds {
            let Part::Discrete { network, .. } = &mut self.model.parts[part] else { continue };
            before.push(network.bonds.weight[bond]);
            network.bonds.weight[bond] = weight;
            broken |= weight == 0.0;
        }
        let mut released = false;
        if broken {
            let loaded = |i: usize| self.load[i] != 0.0 || self.prescribed[i].is_some_and(|v| v != 0.0);
            let found = self.pieces.release(&self.model, &self.numbering, &self.prescribed, loaded);
            match found {
                Err(what) => return Ok(Holding::Separated(what)),
                Ok(fixed) => {
                    released = !fixed.is_empty();
                    fixed.into_iter().for_each(|i| self.prescribed[i] = Some(0.0));
                }
            }
        }
        if !released && self.try_update(bonds, &before)? {
            self.updates += 1;
            return Ok(Holding::Held);
        }
        self.refactorise()
    }

    /// Follows by an update; `false` where a new base is called for.
    fn try_update(&mut self, bonds: &[(usize, usize, f64)], before: &[f64]) -> Result<bool> {
        let per_bond = self.model.space.dofs_per_particle();
        if self.base.capacitance.len() + per_bond * bonds.len() > self.updating.most {
            // Further teeth of bonds that are in the update already cost nothing new.
            if !bonds.iter().all(|&(p, b, _)| self.base.place_of.contains_key(&(p, b))) {
                return Ok(false);
            }
        }
        for (&(part, bond, weight), before) in bonds.iter().zip(before) {
            let Part::Discrete { network, .. } = &self.model.parts[part] else { continue };
            if !self.base.place_of.contains_key(&(part, bond)) {
                let offset = self.numbering.offset(part);
                let own = modes(network, bond, *before);
                let own = own.into_iter().map(|m| m.into_iter().map(|(i, v)| (i + offset, v)).collect());
                self.base.add((part, bond), [*before, weight], own, &mut self.work)?;
            } else {
                self.base.lose((part, bond), weight);
            }
        }
        if !self.base.capacitance.factorise() {
            return Ok(false);
        }
        match self.base.updated_solution(&self.load, &mut self.work)? {
            Some(solution) => {
                self.u = solution;
                Ok(true)
            }
            None => Ok(false),
        }
    }

    /// Factorises what is left; pieces that turn out to move freely go too.
    fn refactorise(&mut self) -> Result<Holding> {
        loop {
            let (base, softest) = Base::new(
                &self.model,
                &self.numbering,
                &self.elements,
                &self.load,
                &self.prescribed,
                &mut self.work,
            )?;
            self.base = base;
            if softest.1 > mechanism::FREE {
                self.u = self.base.solution[..self.numbering.len()].to_vec();
                return Ok(Holding::Held);
            }
            let mut motion = vec![0.0; self.numbering.len()];
            self.base.free.iter().zip(&softest.0).for_each(|(&i, &v)| motion[i] = v);
            let loaded = |i: usize| self.load[i] != 0.0 || self.prescribed[i].is_some_and(|v| v != 0.0);
            match self.pieces.release_moving(&self.model, &self.numbering, &motion, loaded) {
                Err(what) => return Ok(Holding::Separated(what)),
                Ok(fixed) => fixed.into_iter().for_each(|i| self.prescribed[i] = Some(0.0)),
            }
        }
    }
}

/// Stiffness of all elements, on all unknowns: it never changes.
fn elements(model: &Model, numbering: &Numbering, work: &mut Work) -> Result<Triplets> {
    let mut triplets = Triplets::default();
    for (p, part) in model.parts.iter().enumerate() {
        if let Part::Continuum(body) = part {
            let offset = numbering.offset(p);
            fem::assembly::for_each_stiffness(body, |dofs, k| {
                work.element_updates += 1;
                let shifted: Vec<usize> = dofs.iter().map(|d| d + offset).collect();
                triplets.push_block(&shifted, k);
            })?;
        }
    }
    Ok(triplets)
}

impl Base {
    /// Factorises and solves; gives the softest motion of the free unknowns too.
    fn new(
        model: &Model,
        numbering: &Numbering,
        elements: &Triplets,
        load: &[f64],
        prescribed: &[Option<f64>],
        work: &mut Work,
    ) -> Result<(Self, (Vec<f64>, f64))> {
        let n = numbering.len();
        let mut triplets = elements.clone();
        for (p, part) in model.parts.iter().enumerate() {
            if let Part::Discrete { name, network } = part {
                let offset = numbering.offset(p);
                dem::bond::for_each_stiffness(network, name, |dofs, k| {
                    work.bond_updates += 1;
                    let shifted: Vec<usize> = dofs.iter().map(|d| d + offset).collect();
                    triplets.push_block(&shifted, k);
                })?;
            }
        }
        let stiffness = SymmetricMatrix::from_triplets(n, &triplets);
        let free: Vec<usize> = (0..n).filter(|&i| prescribed[i].is_none()).collect();
        let mut place = vec![usize::MAX; n];
        free.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let tied = statics::constraints(model, numbering, prescribed, &place)?;
        let (reduced, force) = statics::eliminate(&stiffness, load, prescribed, &free, &place);
        let (group, positions) = statics::points_of(model, numbering, &free);
        let row_positions: Vec<Vec3> = tied.rows.iter().map(|r| r.position).collect();
        let layout = Layout {
            space: model.space,
            group: &group,
            positions: &positions,
            row_positions: &row_positions,
        };
        let scale = reduced.diagonal().iter().map(|d| if *d > 0.0 { 1.0 / d.sqrt() } else { 0.0 }).collect();
        let mut base = Base {
            kkt: None,
            stiffness,
            free,
            tied,
            solution: Vec::new(),
            scale,
            updated: Vec::new(),
            place_of: BTreeMap::new(),
            capacitance: Capacitance::default(),
        };
        let held: Vec<f64> = prescribed.iter().map(|p| p.unwrap_or(0.0)).collect();
        if base.free.is_empty() {
            base.solution = held;
            return Ok((base, (Vec::new(), f64::INFINITY)));
        }
        let mut failure = None;
        for epsilon in EPSILONS {
            let kkt = Kkt::new(&reduced, &base.tied.reduced, &layout, epsilon, work)?;
            let softest = kkt.softest_motion(work);
            if softest.1 <= mechanism::FREE {
                base.solution = held;
                return Ok((base, softest));
            }
            match kkt.solve(&force, &base.tied.rhs, work) {
                Ok(solution) => {
                    base.solution = base.spread(&solution, &held);
                    base.kkt = Some(kkt);
                    return Ok((base, softest));
                }
                Err(error) => failure = Some(error),
            }
        }
        Err(failure.unwrap_or_else(|| Error::Solve { message: "no factorisation was tried".to_owned() }))
    }

    /// A solution on all unknowns, then the multipliers; `held` are the values of the others.
    fn spread(&self, solution: &KktSolution, held: &[f64]) -> Vec<f64> {
        let mut all = held.to_vec();
        self.free.iter().zip(&solution.u).for_each(|(&i, &v)| all[i] = v);
        all.extend(&solution.multipliers);
        all
    }

    /// `K₀⁻¹` on forces (all unknowns) and row values; prescribed unknowns rest.
    fn solve(&self, force: &[f64], gaps: &[f64], work: &mut Work) -> Result<Vec<f64>> {
        let held = vec![0.0; force.len()];
        let Some(kkt) = &self.kkt else { return Ok(held) };
        let reduced: Vec<f64> = self.free.iter().map(|&i| force[i]).collect();
        Ok(self.spread(&kkt.solve(&reduced, gaps, work)?, &held))
    }

    /// Takes a bond whose weight falls from `before` to `after` into the update.
    fn add(
        &mut self,
        bond: (usize, usize),
        [before, after]: [f64; 2],
        modes: impl Iterator<Item = Mode>,
        work: &mut Work,
    ) -> Result<()> {
        let first = self.updated.len();
        let gaps = vec![0.0; self.tied.rows.len()];
        for mode in modes {
            let mut force = vec![0.0; self.stiffness.len()];
            mode.iter().for_each(|&(i, v)| force[i] = v);
            let z = self.solve(&force, &gaps, work)?;
            let mut products: Vec<f64> = self.updated.iter().map(|u| product(&u.mode, &z)).collect();
            products.push(product(&mode, &z));
            self.capacitance.push(products, (before - after) / before);
            self.updated.push(Updated { weight: before, mode, z });
        }
        self.place_of.insert(bond, first..self.updated.len());
        Ok(())
    }

    /// Further loss of a bond that is in the update.
    fn lose(&mut self, bond: (usize, usize), after: f64) {
        for k in self.place_of[&bond].clone() {
            let before = self.updated[k].weight;
            self.capacitance.set_loss(k, (before - after) / before);
        }
    }

    /// `x + Z C⁻¹ Vᵀx`.
    fn update(&self, x: &mut [f64]) {
        let t = self.updated.iter().map(|u| product(&u.mode, x)).collect();
        for (y, updated) in self.capacitance.solve(t).into_iter().zip(&self.updated) {
            x.iter_mut().zip(&updated.z).for_each(|(x, z)| *x += y * z);
        }
    }

    /// The updated equilibrium; `None` where refinement cannot make it accurate.
    fn updated_solution(&self, load: &[f64], work: &mut Work) -> Result<Option<Vec<f64>>> {
        let n = self.stiffness.len();
        let mut x = self.solution.clone();
        self.update(&mut x);
        let mut last = f64::INFINITY;
        for step in 0..=MOST_REFINEMENTS {
            let (force, gaps, size) = self.residual(&x, load);
            if size <= REFINED || step == MOST_REFINEMENTS || size.is_nan() || size > 0.5 * last {
                last = last.min(size);
                break;
            }
            last = size;
            let mut correction = self.solve(&force, &gaps, work)?;
            self.update(&mut correction);
            x.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
        }
        x.truncate(n);
        Ok((last <= REFUSED).then_some(x))
    }

    /// `K u = K₀u − V D Vᵀu` on all unknowns.
    fn internal(&self, u: &[f64]) -> Vec<f64> {
        let mut internal = vec![0.0; self.stiffness.len()];
        self.stiffness.multiply_add(u, &mut internal);
        for (updated, loss) in self.updated.iter().zip(self.capacitance.losses()) {
            let lost = loss * product(&updated.mode, u);
            updated.mode.iter().for_each(|&(i, v)| internal[i] -= lost * v);
        }
        internal
    }

    /// What is missing from equilibrium and from the rows, and its size relative to the forces and motions in it.
    fn residual(&self, x: &[f64], load: &[f64]) -> (Vec<f64>, Vec<f64>, f64) {
        let (u, multipliers) = x.split_at(self.stiffness.len());
        let internal = self.internal(u);
        let mut force: Vec<f64> = load.iter().zip(&internal).map(|(f, k)| f - k).collect();
        let mut gaps = vec![0.0; multipliers.len()];
        let (mut gap, mut motion) = (0.0f64, 0.0f64);
        for ((row, multiplier), out) in self.tied.rows.iter().zip(multipliers).zip(&mut gaps) {
            for &(i, b) in &row.terms {
                force[i] -= b * multiplier;
                *out -= b * u[i];
                motion = motion.max((b * u[i]).abs());
            }
            gap = gap.max(out.abs());
        }
        let (mut largest, mut size) = (0.0f64, 0.0f64);
        for (&i, s) in self.free.iter().zip(&self.scale) {
            largest = if force[i].is_nan() { f64::NAN } else { largest.max((force[i] * s).abs()) };
            // K_ii u_i stands for the forces that balance there.
            let balanced = if *s > 0.0 { (u[i] / s).abs() } else { 0.0 };
            size = size.max(balanced).max((load[i] * s).abs());
        }
        let relative = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { part };
        (force, gaps, relative(largest, size).max(relative(gap, motion)))
    }
}
