//! Linear statics of a model: one factorisation, one right-hand side.

use super::kkt::{Kkt, KktSolution, Layout};
use super::mechanism;
use super::sparse::{SymmetricMatrix, Triplets};
use crate::coupling::{Row, assemble, rank};
use crate::dem;
use crate::error::Result;
use crate::fem;
use crate::model::{Model, Numbering, Part, PointValue};
use crate::space::Vec3;
use crate::stage::{Stage, timed};
use crate::work::Work;

/// Equilibrium of a model.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Numbering of the unknowns.
    pub numbering: Numbering,
    /// All unknowns, prescribed ones included: displacements in m, rotations in rad.
    pub u: Vec<f64>,
    /// Forces that the supports and ties exert, `K u − f`, per unknown, in N and N m.
    pub reactions: Vec<f64>,
    /// Constraint rows that were kept, with the multiplier of each.
    pub multipliers: Vec<(Row, f64)>,
    /// Strain energy `½ uᵀK u`, in J.
    pub energy: f64,
    /// Relative residual of the true system.
    pub residual: f64,
    /// What was done.
    pub work: Work,
    /// Constraint rows that were dropped, and why.
    pub notes: Vec<String>,
}

impl Solution {
    /// Displacement of a node or particle, in m.
    pub fn displacement(&self, model: &Model, part: usize, point: usize) -> Vec3 {
        let mut u = Vec3::zeros();
        for c in 0..model.space.dim() {
            u[c] = self.u[self.numbering.unknown(part, point, c)];
        }
        u
    }

    /// Rotation of a particle, in rad; zero for a node.
    pub fn rotation(&self, model: &Model, part: usize, point: usize) -> Vec3 {
        let mut theta = Vec3::zeros();
        if matches!(model.parts[part], Part::Discrete { .. }) {
            for (k, &axis) in model.space.rotation_axes().iter().enumerate() {
                theta[axis] = self.u[self.numbering.unknown(part, point, model.space.dim() + k)];
            }
        }
        theta
    }
}

/// Solves for equilibrium.
///
/// # Errors
/// Bad elements or bonds, overlapping bodies, ties that cannot be made, mechanisms, contradicting constraints,
/// and solves whose true residual is too large.
pub fn solve(model: &Model) -> Result<Solution> {
    crate::check::model(model)?;
    let numbering = Numbering::new(model);
    let mut work = Work { steps: 1, ..Work::default() };
    let stiffness = assemble_stiffness(model, &numbering, &mut work)?;
    let n = numbering.len();

    let mut prescribed: Vec<Option<f64>> = vec![None; n];
    for PointValue { part, point, component, value } in &model.supports {
        prescribed[numbering.unknown(*part, *point, *component)] = Some(*value);
    }
    let mut f = vec![0.0; n];
    for PointValue { part, point, component, value } in &model.loads {
        f[numbering.unknown(*part, *point, *component)] += value;
    }

    let free: Vec<usize> = (0..n).filter(|&i| prescribed[i].is_none()).collect();
    let mut place = vec![usize::MAX; n];
    free.iter().enumerate().for_each(|(k, &i)| place[i] = k);

    let tied = constraints(model, &numbering, &prescribed, &place)?;
    let (reduced, load) = eliminate(&stiffness, &f, &prescribed, &free, &place);
    let (group, positions) = points_of(model, &numbering, &free);
    let row_positions: Vec<Vec3> = tied.rows.iter().map(|r| r.position).collect();
    let layout =
        Layout { space: model.space, group: &group, positions: &positions, row_positions: &row_positions };

    let KktSolution { u: free_u, multipliers, residual } =
        equilibrium(&reduced, &tied, &layout, &load, &mut work, |softest| {
            mechanism::refuse(model, &numbering, &free, softest)
        })?;

    let mut u: Vec<f64> = prescribed.iter().map(|p| p.unwrap_or(0.0)).collect();
    free.iter().zip(&free_u).for_each(|(&i, &v)| u[i] = v);
    let mut internal = vec![0.0; n];
    stiffness.multiply_add(&u, &mut internal);
    let energy = 0.5 * u.iter().zip(&internal).map(|(u, k)| u * k).sum::<f64>();
    let reactions = internal.iter().zip(&f).map(|(k, f)| k - f).collect();
    let multipliers = tied.rows.into_iter().zip(multipliers).collect();
    Ok(Solution { numbering, u, reactions, multipliers, energy, residual, work, notes: tied.notes })
}

/// Factorises, refuses mechanisms and solves.
fn equilibrium(
    stiffness: &SymmetricMatrix,
    tied: &Constraints,
    layout: &Layout,
    load: &[f64],
    work: &mut Work,
    refuse_mechanism: impl Fn((Vec<f64>, f64)) -> Result<()>,
) -> Result<KktSolution> {
    let kkt = Kkt::new(stiffness, &tied.reduced, layout, work)?;
    refuse_mechanism(kkt.softest_motion(work))?;
    timed(Stage::Steps, || kkt.solve(load, &tied.rhs, work))
}

/// Stiffness matrix of all parts on all unknowns.
pub(crate) fn assemble_stiffness(
    model: &Model,
    numbering: &Numbering,
    work: &mut Work,
) -> Result<SymmetricMatrix> {
    timed(Stage::Assembly, || assemble_parts(model, numbering, work))
}

fn assemble_parts(model: &Model, numbering: &Numbering, work: &mut Work) -> Result<SymmetricMatrix> {
    let mut triplets = Triplets::default();
    for (p, part) in model.parts.iter().enumerate() {
        let offset = numbering.offset(p);
        let mut count = 0;
        let mut push = |dofs: &[usize], block: &[f64]| {
            count += 1;
            triplets.push_block(offset, dofs, block);
        };
        match part {
            Part::Continuum(body) => {
                fem::assembly::for_each_stiffness(body, &mut push)?;
                work.element_updates += count;
            }
            Part::Discrete { name, network } => {
                dem::bond::for_each_stiffness(network, name, &mut push)?;
                work.bond_updates += count;
            }
        }
    }
    Ok(SymmetricMatrix::from_triplets(numbering.len(), &triplets))
}

/// Independent constraint rows of a model.
pub(crate) struct Constraints {
    /// Rows kept, on all unknowns.
    pub rows: Vec<Row>,
    /// The same on the free unknowns.
    pub reduced: Vec<Vec<(usize, f64)>>,
    /// What each row has to give: what the prescribed unknowns leave.
    pub rhs: Vec<f64>,
    /// Rows dropped, and why.
    pub notes: Vec<String>,
}

/// Rows of all ties that the supports leave independent; `place` numbers the free unknowns.
pub(crate) fn constraints(
    model: &Model,
    numbering: &Numbering,
    prescribed: &[Option<f64>],
    place: &[usize],
) -> Result<Constraints> {
    timed(Stage::Assembly, || independent_rows(&assemble::rows(model, numbering)?, prescribed, place))
}

/// As [`constraints`], from the rows of all ties.
pub(crate) fn independent_rows(
    all: &[Row],
    prescribed: &[Option<f64>],
    place: &[usize],
) -> Result<Constraints> {
    let mut rhs = Vec::with_capacity(all.len());
    let mut reduced = Vec::with_capacity(all.len());
    for row in all {
        rhs.push(-row.terms.iter().filter_map(|&(i, b)| Some(b * prescribed[i]?)).sum::<f64>());
        let terms =
            row.terms.iter().filter(|t| prescribed[t.0].is_none()).map(|&(i, b)| (place[i], b)).collect();
        reduced.push(Row { terms, label: row.label.clone(), position: row.position });
    }
    let scale = prescribed.iter().flatten().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
    let found = rank::independent(&reduced, &rhs, scale)?;
    Ok(Constraints {
        rows: found.kept.iter().map(|&k| all[k].clone()).collect(),
        rhs: found.kept.iter().map(|&k| rhs[k]).collect(),
        reduced: found.kept.iter().map(|&k| std::mem::take(&mut reduced[k].terms)).collect(),
        notes: found.notes,
    })
}

/// Stiffness on the free unknowns, and the load less what the prescribed ones cause.
pub(crate) fn eliminate(
    stiffness: &SymmetricMatrix,
    f: &[f64],
    prescribed: &[Option<f64>],
    free: &[usize],
    place: &[usize],
) -> (SymmetricMatrix, Vec<f64>) {
    let mut load: Vec<f64> = free.iter().map(|&i| f[i]).collect();
    for (r, c, v) in stiffness.entries() {
        match (prescribed[r], prescribed[c]) {
            (Some(value), None) => load[place[c]] -= v * value,
            (None, Some(value)) => load[place[r]] -= v * value,
            _ => {}
        }
    }
    (stiffness.principal(place, free.len()), load)
}

/// For each free unknown the point it belongs to, and the positions of these points.
pub(crate) fn points_of(model: &Model, numbering: &Numbering, free: &[usize]) -> (Vec<u32>, Vec<Vec3>) {
    let mut group = Vec::with_capacity(free.len());
    let mut positions = Vec::new();
    let mut last = None;
    for &i in free {
        let (part, point, _) = numbering.locate(i);
        if last != Some((part, point)) {
            last = Some((part, point));
            positions.push(model.parts[part].positions()[point]);
        }
        group.push(positions.len() as u32 - 1);
    }
    (group, positions)
}
