//! Statics of the clamped FE | DE | FE beam: assembly, constraint rank, factorisation and solve.
//!
//! `cargo bench -p seam-solver --bench statics`; the ids carry the number of unknowns. For the memory a solve
//! takes, run one under `/usr/bin/time -v`: `cargo bench … -- --profile-time 1 plane/500k`.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use seam_solver::coupling::{Method, Multipliers, Tie};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured;
use seam_solver::model::{Model, Numbering, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use std::hint::black_box;

/// A beam of height 1 and length 9, the middle third of particles; `rows` elements and particles over the height.
fn beam(space: Space, rows: usize) -> Model {
    let depth = if space == Space::Solid { 1.0 } else { 0.0 };
    let corner = |x: f64, upper: f64| Vec3::new(x, upper, upper * depth);
    let continuum = |name: &str, from: f64| {
        let divisions = [3 * rows, rows, rows];
        let (low, high) = (corner(from, 0.0), corner(from + 3.0, 1.0));
        let axes: Vec<_> = (0..space.dim())
            .map(|i| structured::even(low[i], high[i], divisions[i]).expect("a box"))
            .collect();
        Continuum {
            name: name.to_owned(),
            mesh: structured::grid(&axes).expect("a grid"),
            elasticity: Elasticity { young_pa: 1e9, poisson: 0.2, density: 1.0 },
            hypothesis: if space == Space::Solid {
                Hypothesis::Solid
            } else {
                Hypothesis::PlaneStress { thickness_m: 1.0 }
            },
            formulation: Formulation::Incompatible,
        }
    };
    let kind = if space == Space::Solid { LatticeKind::SimpleCubic } else { LatticeKind::Triangular };
    let block = Block::new(space, corner(3.0, 0.0), corner(6.0, 1.0)).expect("a block");
    let l = lattice(kind, block, rows, Matter { density: 1.0, thickness_m: 1.0 }).expect("a lattice");
    let recipe = BondRecipe {
        material: BondMaterial { young_pa: 1e9, poisson: 0.3 },
        section: Section::Uniform { ratio: 0.7 },
        skin: Skin::Weighted,
    };
    let network = bond_network(&l.arrangement, &l.pairs, &recipe).expect("a network");
    let left = continuum("left", 0.0);
    let clamped = left.mesh.boundary_nodes("left").expect("a boundary");
    let support = |point: usize, component: usize| PointValue { part: 0, point, component, value: 0.0 };
    let tie = |first: usize| Tie {
        name: format!("tie {first}"),
        first: (first, "right".to_owned()),
        second: (first + 1, "left".to_owned()),
        method: Method::Pointwise,
        multipliers: Multipliers::Auto,
        rotations: false,
    };
    Model {
        space,
        supports: clamped.iter().flat_map(|&p| (0..space.dim()).map(move |c| support(p, c))).collect(),
        parts: vec![
            Part::Continuum(left),
            Part::Discrete { name: "middle".to_owned(), network },
            Part::Continuum(continuum("right", 6.0)),
        ],
        ties: vec![tie(0), tie(1)],
        loads: vec![PointValue { part: 2, point: 3 * rows, component: 1, value: -1.0 }],
    }
}

fn statics_of_the_beam(c: &mut Criterion) {
    let mut group = c.benchmark_group("statics");
    group.sample_size(10);
    for (space, name, rows) in [
        (Space::Plane, "plane/25k", 33),
        (Space::Plane, "plane/100k", 67),
        (Space::Plane, "plane/500k", 151),
        (Space::Solid, "solid/60k", 12),
    ] {
        let model = beam(space, rows);
        let unknowns = Numbering::new(&model).len();
        group.bench_with_input(BenchmarkId::new(name, unknowns), &model, |b, model| {
            b.iter(|| black_box(statics::solve(model).expect("well posed").energy));
        });
    }
    group.finish();
}

criterion_group!(benches, statics_of_the_beam);
criterion_main!(benches);
