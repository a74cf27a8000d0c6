//! A factorised matrix with its ties, and the low-rank update for what its bonds have lost since; see [`super::system`].

use super::capacitance::Capacitance;
use super::modes::{Mode, product};
use super::system::Weakened;
use crate::coupling::{Row, assemble};
use crate::dem;
use crate::error::Result;
use crate::fem::{self, continuum::Continuum};
use crate::model::{Model, Numbering, Part};
use crate::solve::kkt::{Kkt, Layout};
use crate::solve::mechanism;
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::solve::statics::{self, Constraints};
use crate::space::Vec3;
use crate::work::Work;
use std::collections::BTreeMap;

/// Equilibrium of one state, and of what follows from it by losses.
pub(super) struct Base {
    /// None without free unknowns.
    kkt: Option<Kkt>,
    /// On all unknowns.
    stiffness: SymmetricMatrix,
    pub free: Vec<usize>,
    pub tied: Constraints,
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

/// What bonds that fail do not change.
pub(super) struct Lasting {
    /// Stiffness of all elements, on all unknowns.
    elements: Triplets,
    /// Rows of all ties.
    pub rows: Vec<Row>,
}

impl Lasting {
    pub fn new(model: &Model, numbering: &Numbering, work: &mut Work) -> Result<Self> {
        Ok(Lasting { elements: elements(model, numbering, work)?, rows: assemble::rows(model, numbering)? })
    }
}

fn elements(model: &Model, numbering: &Numbering, work: &mut Work) -> Result<Triplets> {
    let entries = |part: &Part| match part {
        Part::Continuum(Continuum { mesh, .. }) => {
            mesh.cell_count() * lower_triangle(mesh.nodes_per_cell() * mesh.space.dim())
        }
        Part::Discrete { .. } => 0,
    };
    let mut triplets = Triplets::with_capacity(model.parts.iter().map(entries).sum());
    for (p, part) in model.parts.iter().enumerate() {
        if let Part::Continuum(body) = part {
            let offset = numbering.offset(p);
            fem::assembly::for_each_stiffness(body, |dofs, k| {
                work.element_updates += 1;
                triplets.push_block(offset, dofs, k);
            })?;
        }
    }
    Ok(triplets)
}

/// Entries of an n × n matrix on and below its diagonal.
fn lower_triangle(n: usize) -> usize {
    n * (n + 1) / 2
}

/// A residual (relative, scaled) above this is refined on.
const REFINED: f64 = 1e-13;
/// A residual that refinement leaves above this calls for a new base.
const REFUSED: f64 = 1e-11;
/// One is rarely called for; more only where the update is close to losing a pivot.
const MOST_REFINEMENTS: usize = 5;

impl Base {
    /// Modes in the update.
    pub fn updated_modes(&self) -> usize {
        self.updated.len()
    }

    /// Whether a bond (part, index) is in the update.
    pub fn has(&self, bond: (usize, usize)) -> bool {
        self.place_of.contains_key(&bond)
    }

    /// Completes the update; `false` where a pivot is lost in rounding.
    pub fn factorise_update(&mut self) -> bool {
        self.capacitance.factorise()
    }

    /// Factorises and solves; gives the softest motion of the free unknowns too.
    pub fn new(
        model: &Model,
        numbering: &Numbering,
        lasting: &Lasting,
        load: &[f64],
        prescribed: &[Option<f64>],
        work: &mut Work,
    ) -> Result<(Self, (Vec<f64>, f64))> {
        let n = numbering.len();
        let bonds = |part: &Part| match part {
            Part::Discrete { network, .. } => network.bonds.len(),
            _ => 0,
        };
        let bonds: usize = model.parts.iter().map(bonds).sum();
        let of_bonds = bonds * lower_triangle(2 * model.space.dofs_per_particle());
        let mut triplets = Triplets::with_capacity(lasting.elements.len() + of_bonds);
        triplets.append(&lasting.elements);
        for (p, part) in model.parts.iter().enumerate() {
            if let Part::Discrete { name, network } = part {
                let offset = numbering.offset(p);
                dem::bond::for_each_stiffness(network, name, |dofs, k| {
                    work.bond_updates += 1;
                    triplets.push_block(offset, dofs, k);
                })?;
            }
        }
        let stiffness = SymmetricMatrix::from_triplets(n, &triplets);
        let free: Vec<usize> = (0..n).filter(|&i| prescribed[i].is_none()).collect();
        let mut place = vec![usize::MAX; n];
        free.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let tied = statics::independent_rows(&lasting.rows, prescribed, &place)?;
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
        let kkt = Kkt::new(&reduced, &base.tied.reduced, &layout, work)?;
        let softest = kkt.softest_motion(work);
        if softest.1 <= mechanism::FREE {
            base.solution = held;
            return Ok((base, softest));
        }
        let solution = kkt.solve(&force, &base.tied.rhs, work)?;
        base.solution = base.spread([&solution.u, &solution.multipliers], &held);
        base.kkt = Some(kkt);
        Ok((base, softest))
    }

    /// A solution on all unknowns, then the multipliers; `held` are the values of the others.
    fn spread(&self, [u, multipliers]: [&[f64]; 2], held: &[f64]) -> Vec<f64> {
        let mut all = held.to_vec();
        self.free.iter().zip(u).for_each(|(&i, &v)| all[i] = v);
        all.extend(multipliers);
        all
    }

    /// `K₀⁻¹` on several forces (all unknowns) with row values, by one pass through the factor; prescribed unknowns rest. What this leaves
    /// of the residual is refined on in [`Base::updated_state`].
    fn solve(&self, sides: &[[&[f64]; 2]], work: &mut Work) -> Vec<Vec<f64>> {
        let held = vec![0.0; self.stiffness.len()];
        let Some(kkt) = &self.kkt else { return vec![held; sides.len()] };
        let reduced: Vec<Vec<f64>> =
            sides.iter().map(|[force, _]| self.free.iter().map(|&i| force[i]).collect()).collect();
        let reduced: Vec<[&[f64]; 2]> =
            reduced.iter().zip(sides).map(|(force, [_, gaps])| [force.as_slice(), *gaps]).collect();
        kkt.apply(&reduced, work)
            .iter()
            .map(|[u, multipliers]| self.spread([u, multipliers], &held))
            .collect()
    }

    /// Takes a bond into the update.
    pub fn add(&mut self, weakened: &Weakened, work: &mut Work) {
        let Weakened { before, after, .. } = *weakened;
        let first = self.updated.len();
        let gaps = vec![0.0; self.tied.rows.len()];
        let mut forces = vec![vec![0.0; self.stiffness.len()]; weakened.modes.len()];
        for (force, mode) in forces.iter_mut().zip(&weakened.modes) {
            mode.iter().for_each(|&(i, v)| force[i] = v);
        }
        let sides: Vec<[&[f64]; 2]> = forces.iter().map(|force| [force.as_slice(), &gaps]).collect();
        let solved = self.solve(&sides, work);
        for (mode, z) in weakened.modes.iter().cloned().zip(solved) {
            let mut products: Vec<f64> = self.updated.iter().map(|u| product(&u.mode, &z)).collect();
            products.push(product(&mode, &z));
            self.capacitance.push(products, (before - after) / before);
            self.updated.push(Updated { weight: before, mode, z });
        }
        self.place_of.insert(weakened.bond(), first..self.updated.len());
    }

    /// Further loss of a bond that is in the update.
    pub fn lose(&mut self, weakened: &Weakened) {
        for k in self.place_of[&weakened.bond()].clone() {
            let before = self.updated[k].weight;
            self.capacitance.set_loss(k, (before - weakened.after) / before);
        }
    }

    /// `x + Z C⁻¹ Vᵀx`.
    fn update(&self, x: &mut [f64]) {
        let t = self.updated.iter().map(|u| product(&u.mode, x)).collect();
        for (y, updated) in self.capacitance.solve(t).into_iter().zip(&self.updated) {
            x.iter_mut().zip(&updated.z).for_each(|(x, z)| *x += y * z);
        }
    }

    /// The equilibrium it was factorised for, and `K u` there, both on all unknowns.
    pub fn state(&self) -> (Vec<f64>, Vec<f64>) {
        let u = self.solution[..self.stiffness.len()].to_vec();
        let internal = self.internal(&u);
        (u, internal)
    }

    /// The updated equilibrium, as [`Base::state`]; `None` where refinement cannot make it accurate.
    pub fn updated_state(&self, load: &[f64], work: &mut Work) -> Option<(Vec<f64>, Vec<f64>)> {
        let n = self.stiffness.len();
        let mut x = self.solution.clone();
        self.update(&mut x);
        let (mut last, mut internal) = (f64::INFINITY, Vec::new());
        for step in 0..=MOST_REFINEMENTS {
            internal = self.internal(&x[..n]);
            let (force, gaps, size) = self.residual(&x, &internal, load);
            if size <= REFINED || step == MOST_REFINEMENTS || size.is_nan() || size > 0.5 * last {
                last = size;
                break;
            }
            last = size;
            for mut correction in self.solve(&[[&force, &gaps]], work) {
                self.update(&mut correction);
                x.iter_mut().zip(&correction).for_each(|(x, d)| *x += d);
            }
        }
        x.truncate(n);
        (last <= REFUSED).then_some((x, internal))
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

    /// What is missing from equilibrium and from the rows at x, where `K u` is `internal`, and its size relative to the forces and
    /// motions in it.
    fn residual(&self, x: &[f64], internal: &[f64], load: &[f64]) -> (Vec<f64>, Vec<f64>, f64) {
        let (u, multipliers) = x.split_at(self.stiffness.len());
        let mut force: Vec<f64> = load.iter().zip(internal).map(|(f, k)| f - k).collect();
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
