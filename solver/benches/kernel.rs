//! Bond updates per second on solid networks, and the share of the machine's limits that this is.
//!
//! `cargo bench -p seam-solver --bench kernel`. Everything is measured in turns, on the spot, so that whatever else the
//! machine does meets all alike: the table gives medians, and medians of the ratios within a turn. On a busy machine the
//! ratio of the bests tells what two threads can do, and the median what they got. Integration is included, but for
//! `forces`. Also the limits are measured as this crate is compiled, so that arithmetic is that of SSE2.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::corotational::Corotational;
use seam_solver::dem::kernel::Kernel;
use seam_solver::dem::kernel::locality::{order, renumber};
use seam_solver::dem::kernel::per_bond::PerBond;
use seam_solver::dem::kernel::vibration::Vibration;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::Rotations;
use seam_solver::limits::{arithmetic, bandwidth};
use seam_solver::model::{Model, Part};
use seam_solver::space::{Space, Vec3};
use std::hint::black_box;
use std::time::Instant;

const TURNS: usize = 31;
/// Bond updates of each contender and turn: long beside the start of a thread.
const UPDATES: usize = 2_000_000;

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

struct Contender<'a> {
    name: &'static str,
    /// The contender that the ratio is against.
    against: usize,
    /// Updates every bond so many times.
    run: Box<dyn FnMut(usize) + 'a>,
}

fn explicit(network: &Network, rotations: Rotations) -> Explicit {
    let model = Model {
        space: Space::Solid,
        parts: vec![Part::Discrete { name: "bar".to_owned(), network: network.clone() }],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    let options = Options { step_s: 1e-6, rotations, ..Options::default() };
    let mut start = State::at_rest(6 * network.particles.len());
    start.u.iter_mut().enumerate().filter(|(i, _)| i % 6 < 3).for_each(|(i, u)| *u = wave(i));
    Explicit::new(&model, options, &start).expect("a run")
}

fn wave(i: usize) -> f64 {
    1e-6 * (0.1 * i as f64).sin()
}

fn vibration(network: &Network, threads: usize) -> Vibration {
    let mut vibration = Vibration::new(network, "bar", threads).expect("a network");
    let n = 6 * network.particles.len();
    vibration.set(&(0..n).map(wave).collect::<Vec<_>>(), &vec![0.0; n]);
    vibration
}

/// The same network, its particles numbered at random.
fn shuffled(network: &Network) -> Network {
    let mut shuffle: Vec<usize> = (0..network.particles.len()).collect();
    shuffle.shuffle(&mut ChaCha8Rng::seed_from_u64(1));
    renumber(network, &shuffle)
}

fn contenders(network: &Network) -> Vec<Contender<'_>> {
    let n = 6 * network.particles.len();
    let u: Vec<f64> = (0..n).map(|i| 100.0 * wave(i)).collect();
    let kernel = Kernel::new(network, "bar").expect("a network");
    let mut finite = Corotational::new(network, "bar").expect("a network");
    let [mut one, mut two] = [1, 2].map(|threads| vibration(network, threads));
    let [mut small_run, mut finite_run] =
        [Rotations::Small, Rotations::Finite].map(|rotations| explicit(network, rotations));
    let mut shuffled_run = explicit(&shuffled(network), Rotations::Small);
    let (v, mut f, mut g) = (u.clone(), vec![0.0; n], vec![0.0; n]);
    vec![
        Contender {
            name: "Vibration, 1 thread",
            against: 0,
            run: Box::new(move |steps| one.advance(1e-6, steps)),
        },
        Contender {
            name: "Vibration, 2 threads",
            against: 0,
            run: Box::new(move |steps| two.advance(1e-6, steps)),
        },
        Contender {
            name: "Explicit, small",
            against: 0,
            run: Box::new(move |steps| small_run.advance(steps as u64).expect("steps")),
        },
        Contender {
            name: "Explicit, finite",
            against: 2,
            run: Box::new(move |steps| finite_run.advance(steps as u64).expect("steps")),
        },
        Contender {
            name: "Explicit, small, shuffled",
            against: 2,
            run: Box::new(move |steps| shuffled_run.advance(steps as u64).expect("steps")),
        },
        Contender {
            name: "forces, small",
            against: 5,
            run: Box::new(move |steps| (0..steps).for_each(|_| kernel.add_internal(black_box(&u), &mut f))),
        },
        Contender {
            name: "turn and forces, finite",
            against: 5,
            run: Box::new(move |steps| {
                for _ in 0..steps {
                    // Turning the particles is part of the price.
                    finite.turn(&v, 1e-3);
                    finite.add_internal(black_box(&v), &mut g);
                }
            }),
        },
    ]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let stream = [1, 2].map(bandwidth);
    let flops = [1, 2].map(arithmetic);
    for (what, unit, [one, two]) in [("stream", "GB/s", stream), ("arithmetic", "Gflop/s", flops)] {
        println!(
            "limit: {what} {:.1} {unit} on one thread, {:.1} on two, {:.2} ×",
            one * 1e-9,
            two * 1e-9,
            two / one
        );
    }
    for (size, rows) in [("20k", 13), ("200k", 29)] {
        let network = network(rows);
        let (particles, bonds) = (network.particles.len(), network.bonds.len());
        let PerBond { bytes, operations } = PerBond::solid(&network);
        println!(
            "\n{size}: {particles} particles, {bonds} bonds; {bytes:.0} bytes and {operations:.0} products and sums per bond"
        );
        let mut contenders = contenders(&network);
        let steps = UPDATES / bonds + 1;
        // M/s of each contender in each turn; the first turn warms up.
        let turns: Vec<Vec<f64>> = (0..=TURNS)
            .map(|_| {
                let speed = |c: &mut Contender| {
                    let start = Instant::now();
                    (c.run)(steps);
                    (steps * bonds) as f64 / start.elapsed().as_secs_f64() * 1e-6
                };
                contenders.iter_mut().map(speed).collect()
            })
            .skip(1)
            .collect();
        println!("{:<26} {:>9} {:>9} {:>6} {:>6}  against", "", "median", "best", "ratio", "bests");
        for (i, c) in contenders.iter().enumerate() {
            let of = |i: usize| turns.iter().map(move |t| t[i]);
            let best = |i: usize| of(i).fold(0.0, f64::max);
            let ratio = median(turns.iter().map(|t| t[i] / t[c.against]).collect());
            println!(
                "{:<26} {:>5.1} M/s {:>5.1} M/s {ratio:>6.2} {:>6.2}  {}",
                c.name,
                median(of(i).collect()),
                best(i),
                best(i) / best(c.against),
                contenders[c.against].name
            );
        }
        let share = |threads: usize, per_bond: f64, limit: [f64; 2]| {
            let speed = median(turns.iter().map(|t| t[threads - 1]).collect()) * 1e6;
            100.0 * speed * per_bond / limit[threads - 1]
        };
        println!(
            "share of the stream bandwidth: {:.0} % on one thread, {:.0} % on two; of the arithmetic: {:.0} % and {:.0} %",
            share(1, bytes, stream),
            share(2, bytes, stream),
            share(1, operations, flops),
            share(2, operations, flops)
        );
    }
}
