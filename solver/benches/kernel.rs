//! Bond updates per second, integration included, on solid networks; and the share of the machine's limit.
//!
//! `cargo bench -p seam-solver --bench kernel`. Throughput is in bond updates. The limits are measured on
//! the spot: the stream bandwidth of one core (`a ← b + s c`, three streams), and what one bond moves.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::corotational::Corotational;
use seam_solver::dem::kernel::Kernel;
use seam_solver::dem::kernel::locality::{order, renumber};
use seam_solver::dem::kernel::vibration::Vibration;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::space::{Space, Vec3};
use std::hint::black_box;
use std::time::Instant;

/// A face-centred cubic bar, twice as long as high, of about `4·2·rows³` particles.
fn network(rows: usize) -> Network {
    let block = Block::at_origin(Space::Solid, Vec3::new(2.0, 1.0, 1.0)).expect("a block");
    let matter = Matter { density: 1.0, thickness_m: 1.0 };
    let l = lattice(LatticeKind::FaceCentredCubic, block, rows, matter).expect("a lattice");
    let recipe = BondRecipe {
        material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
        section: Section::Uniform { ratio: 0.5 },
        skin: Skin::Weighted,
    };
    let network = bond_network(&l.arrangement, &l.pairs, &recipe).expect("a network");
    renumber(&network, &order(&network))
}

/// Bytes per second of `a ← b + s c` on arrays far larger than the caches of one core.
fn stream_bandwidth() -> f64 {
    const N: usize = 8_000_000;
    let (mut a, b, c) = (vec![0.0; N], vec![1.0; N], vec![2.0; N]);
    let mut best = f64::INFINITY;
    for round in 0..8 {
        let s = f64::from(round);
        let start = Instant::now();
        a.iter_mut().zip(b.iter().zip(&c)).for_each(|(a, (b, c))| *a = b + s * c);
        best = best.min(start.elapsed().as_secs_f64());
        black_box(&a);
    }
    24.0 * N as f64 / best
}

fn bond_updates(c: &mut Criterion) {
    let bandwidth = stream_bandwidth();
    let mut group = c.benchmark_group("bond_updates");
    group.sample_size(20);
    for (name, rows) in [("solid/20k", 13), ("solid/200k", 29)] {
        let network = network(rows);
        let (particles, bonds) = (network.particles.len(), network.bonds.len());
        // A bond's record and partner, 60 bytes; a particle's u, v, f (read and written), inverse mass and inertia.
        let bytes = 60.0 + particles as f64 / bonds as f64 * (2.0 * 3.0 * 48.0 + 16.0);
        eprintln!(
            "{name}: {particles} particles, {bonds} bonds, {bytes:.0} bytes per bond; stream {:.1} GB/s allows {:.0} M/s per core",
            bandwidth * 1e-9,
            bandwidth / bytes * 1e-6
        );
        let n = 6 * particles;
        let u: Vec<f64> = (0..n).map(|i| 1e-6 * (0.1 * i as f64).sin()).collect();
        let steps = 4_000_000 / bonds + 1;
        group.throughput(Throughput::Elements((steps * bonds) as u64));
        for threads in [1, 2] {
            let mut vibration = Vibration::new(&network, "bar", threads).expect("a network");
            vibration.set(&u, &vec![0.0; n]);
            group.bench_function(BenchmarkId::new(name, format!("{threads} thread")), |b| {
                b.iter(|| vibration.advance(1e-6, black_box(steps)));
            });
        }
    }
    group.finish();
}

/// One thread against two in pairs, and the best of each: on a machine that others use, the best tells what the
/// threads can do and the median what they got.
fn threads_in_pairs(_: &mut Criterion) {
    // Criterion's filter knows its own benchmarks only.
    if std::env::args().any(|a| a.starts_with("forces") || a.starts_with("bond_updates")) {
        return;
    }
    for (name, rows) in [("solid/20k", 13), ("solid/200k", 29)] {
        let network = network(rows);
        let n = 6 * network.particles.len();
        let mut runs = [1, 2].map(|threads| {
            let mut vibration = Vibration::new(&network, "bar", threads).expect("a network");
            vibration.set(&vec![1e-6; n], &vec![0.0; n]);
            vibration
        });
        let steps = 2_000_000 / network.bonds.len() + 1;
        let pairs: Vec<[f64; 2]> = (0..41)
            .map(|_| {
                [0, 1].map(|t| {
                    let start = Instant::now();
                    runs[t].advance(1e-6, steps);
                    (steps * network.bonds.len()) as f64 / start.elapsed().as_secs_f64() * 1e-6
                })
            })
            .collect();
        let best = |t: usize| pairs.iter().map(|p| p[t]).fold(0.0, f64::max);
        let mut ratios: Vec<f64> = pairs.iter().map(|p| p[1] / p[0]).collect();
        ratios.sort_by(f64::total_cmp);
        eprintln!(
            "{name}: best {:.1} M/s on one thread, {:.1} M/s on two ({:.2} times); median of the pairs {:.2} times",
            best(0),
            best(1),
            best(1) / best(0),
            ratios[ratios.len() / 2]
        );
    }
}

/// Forces alone, small against finite rotations on the same network and one thread: finite ones may cost three times as much.
fn finite_rotations(c: &mut Criterion) {
    let mut group = c.benchmark_group("forces");
    group.sample_size(20);
    let network = network(13);
    let n = 6 * network.particles.len();
    let u: Vec<f64> = (0..n).map(|i| 1e-4 * (0.1 * i as f64).sin()).collect();
    let mut f = vec![0.0; n];
    group.throughput(Throughput::Elements(network.bonds.len() as u64));
    let small = Kernel::new(&network, "bar").expect("a network");
    group.bench_function("small", |b| b.iter(|| small.add_internal(black_box(&u), &mut f)));
    let mut finite = Corotational::new(&network, "bar").expect("a network");
    group.bench_function("finite", |b| {
        b.iter(|| {
            // Turning the particles is part of the price.
            finite.turn(&u, 1e-3);
            finite.add_internal(black_box(&u), &mut f);
        });
    });
    group.finish();
}

criterion_group!(benches, bond_updates, threads_in_pairs, finite_rotations);
criterion_main!(benches);
