//! Events of quasi-static cracking: a notched plane lattice pulled apart, with scattered strength.
//!
//! `cargo bench -p seam-solver --bench cracking`; the ids carry the number of bonds and the largest number of modes in an update
//! (0: a factorisation per event). One iteration is the first [`EVENTS`] events, the first solve included.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use seam_solver::cracking::{Cracking, Options, Updating};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::strength::{Strength, Weibull};
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use std::hint::black_box;

/// Events of one run.
const EVENTS: usize = 200;

/// A 2 × 1 block of `rows` rows, notched from below to 30 % of its height, and its law.
fn notched(rows: usize) -> (Model, Failure) {
    let block = Block::new(Space::Plane, Vec3::zeros(), Vec3::new(2.0, 1.0, 0.0)).expect("a block");
    let l = lattice(LatticeKind::Triangular, block, rows, Matter::default()).expect("a lattice");
    let position = &l.arrangement.particles.position;
    let at = 1.0 + 0.2 / rows as f64;
    let crosses = |[i, j]: [usize; 2]| {
        let (a, b) = (position[i], position[j]);
        (a.x - at) * (b.x - at) < 0.0 && 0.5 * (a.y + b.y) < 0.3
    };
    let pairs: Vec<_> = l.pairs.iter().copied().filter(|p| !crosses(p.ends)).collect();
    let recipe = BondRecipe {
        material: BondMaterial { young_pa: 1e9, poisson: 0.3 },
        section: Section::Uniform { ratio: 0.7 },
        skin: Skin::Weighted,
    };
    let network = bond_network(&l.arrangement, &pairs, &recipe).expect("a network");
    // Wide scatter: breaks all over the body, many of them before it is torn.
    let law = FailureLaw::BondStress(BondStress::Normal { tensile: Strength::Stress { strength_pa: 1e6 } });
    let recipe = FailureRecipe { law, weibull: Some(Weibull { modulus: 1.5, seed: 1 }) };
    let place = Place { network: &network, body: "body", breakable: None, area_m2: None };
    let failure = Failure::new(&recipe, &place).expect("a law");
    let mut supports = Vec::new();
    for (face, value) in [("left", 0.0), ("right", 1.0)] {
        for &point in &network.faces[face] {
            let on = |component, value| PointValue { part: 0, point, component, value };
            supports.extend([on(0, value), on(1, 0.0), on(2, 0.0)]);
        }
    }
    let parts = vec![Part::Discrete { name: "body".to_owned(), network }];
    (Model { space: Space::Plane, parts, ties: Vec::new(), supports, loads: Vec::new() }, failure)
}

fn events(c: &mut Criterion) {
    let mut group = c.benchmark_group("cracking");
    group.sample_size(10).throughput(Throughput::Elements(EVENTS as u64));
    for rows in [18, 60] {
        let (model, failure) = notched(rows);
        let bonds = failure.integrity().len();
        for most in [0, 30, 60, 90, 150, 300, 600] {
            let options = Options { events: EVENTS, updating: Updating { most }, ..Options::default() };
            group.bench_function(BenchmarkId::new(format!("{bonds}-bonds"), most), |b| {
                b.iter(|| {
                    let laws = vec![(0, failure.clone())];
                    black_box(Cracking::new(&model, laws, options).expect("a model").run().expect("a path"))
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, events);
criterion_main!(benches);
