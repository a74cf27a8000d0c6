//! Quasi-static cracking by events: exact small cases, energy, updates against factorisations, a notch, every end.

mod common;

use common::{Sandwich, prescribe};
use seam_solver::coupling::Method;
use seam_solver::cracking::{Cracking, Event, Options, Outcome, Stop, Updating, envelope};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::{Bonds, Network, Particles};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::error::Error;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::softening::{Shape, Softening};
use seam_solver::failure::strength::{Strength, Weibull};
use seam_solver::failure::virial::{Measure, Release, VirialStress};
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place, Site};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use std::f64::consts::PI;

const MATERIAL: BondMaterial = BondMaterial { young_pa: 1000.0, poisson: 0.3 };
const STRENGTH: f64 = 2.0;
const TENSION: FailureLaw =
    FailureLaw::BondStress(BondStress::Normal { tensile: Strength::Stress { strength_pa: STRENGTH } });
/// What a single break may leave of its energy: the brief asks for 1e-10.
const CLOSED: f64 = 1e-10;

fn network(space: Space, position: Vec<Vec3>, bonds: &[([usize; 2], f64)]) -> Network {
    let count = position.len();
    let length = |&[i, j]: &[usize; 2]| (position[j] - position[i]).norm();
    let stiffness = bonds.iter().map(|(ends, r)| MATERIAL.cylinder(*r, length(ends))).collect();
    let bonds = Bonds {
        ends: bonds.iter().map(|b| b.0).collect(),
        radius: bonds.iter().map(|b| b.1).collect(),
        stiffness,
        weight: vec![1.0; bonds.len()],
    };
    let particles =
        Particles { position, radius: vec![0.5; count], mass: vec![1.0; count], inertia: vec![0.1; count] };
    Network { space, particles, bonds, faces: Default::default() }
}

fn line(count: usize, y: f64) -> Vec<Vec3> {
    (0..count).map(|p| Vec3::new(p as f64, y, 0.0)).collect()
}

/// All unknowns of the points where `on` holds follow `field`, rotations rest.
fn clamp(model: &mut Model, on: impl Fn(&Vec3) -> bool, value: Vec3) {
    for (part, body) in model.parts.iter().enumerate() {
        for (point, x) in body.positions().iter().enumerate().filter(|(_, x)| on(x)) {
            assert!(x.iter().all(|c| c.is_finite()));
            for component in 0..body.dofs_per_point() {
                let value = if component < model.space.dim() { value[component] } else { 0.0 };
                model.supports.push(PointValue { part, point, component, value });
            }
        }
    }
}

fn bare(network: Network) -> Model {
    let parts = vec![Part::Discrete { name: "body".to_owned(), network }];
    let space = parts[0].space();
    Model { space, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() }
}

/// Clamped at x = 0 and pulled at `end` by one unit.
fn pulled(network: Network, end: f64) -> Model {
    let mut model = bare(network);
    clamp(&mut model, |x| x.x < 1e-9, Vec3::zeros());
    clamp(&mut model, |x| x.x > end - 1e-9, Vec3::new(1.0, 0.0, 0.0));
    model
}

fn law(model: &Model, part: usize, law: FailureLaw, weibull: Option<Weibull>) -> (usize, Failure) {
    let Part::Discrete { network, name } = &model.parts[part] else { panic!("part {part} has no bonds") };
    let place = Place { network, body: name, breakable: None, area_m2: None };
    (part, Failure::new(&FailureRecipe { law, weibull }, &place).unwrap())
}

fn run(model: &Model, failure: FailureLaw, options: Options) -> Outcome {
    let outcome = Cracking::new(model, vec![law(model, 0, failure, None)], options).unwrap().run().unwrap();
    assert_closed(&outcome);
    outcome
}

fn assert_closed(outcome: &Outcome) {
    for (k, event) in outcome.events.iter().enumerate() {
        let before = 0.5 * event.force * event.displacement;
        let gap = (event.energy_released - event.fracture_energy - event.radiated_energy).abs();
        assert!(gap <= CLOSED * before, "event {k}: {event:?}");
    }
    assert!(outcome.energies().closure() <= CLOSED, "{:?}", outcome.energies());
}

fn area(r: f64) -> f64 {
    PI * r * r
}

fn chain() -> (Network, f64) {
    let radii = [0.3, 0.25, 0.2, 0.28, 0.3];
    let bonds: Vec<_> = radii.iter().enumerate().map(|(b, &r)| ([b, b + 1], r)).collect();
    let compliance: f64 = radii.iter().map(|&r| 1.0 / (MATERIAL.young_pa * area(r))).sum();
    (network(Space::Plane, line(6, 0.0), &bonds), compliance)
}

/// F = σ_t A of the thinnest bond, however it is loaded.
#[test]
fn a_chain_breaks_its_weakest_bond_at_the_exact_load() {
    let (network, compliance) = chain();
    let force = STRENGTH * area(0.2);
    let outcome = run(&pulled(network.clone(), 5.0), TENSION, Options::default());
    let [event] = &outcome.events[..] else { panic!("{outcome:?}") };
    assert_eq!((event.site, &event.bonds[..], &event.integrity[..]), (Site::Bond(2), &[2][..], &[0.0][..]));
    assert!((event.force / force - 1.0).abs() < 1e-12);
    assert!((event.displacement / (force * compliance) - 1.0).abs() < 1e-12);
    assert_eq!(event.factor, event.displacement);
    assert!(event.force_after.abs() < 1e-12 * force);
    assert!((event.energy_released / (0.5 * force * force * compliance) - 1.0).abs() < 1e-10);
    // The bond's own share; the rest of the chain lets go of the others.
    let own = 0.5 * force * force / (MATERIAL.young_pa * area(0.2));
    assert!((event.fracture_energy / own - 1.0).abs() < 1e-10);
    assert_eq!(outcome.stop, Stop::Unloaded);
    assert!(outcome.torn_off.is_empty());

    let mut model = bare(network);
    clamp(&mut model, |x| x.x < 1e-9, Vec3::zeros());
    model.loads.push(PointValue { part: 0, point: 5, component: 0, value: 0.5 });
    let loaded = run(&model, TENSION, Options::default());
    assert_eq!(loaded.events.len(), 1);
    assert!((0.5 * loaded.events[0].factor / force - 1.0).abs() < 1e-12);
    assert!(
        matches!(&loaded.stop, Stop::Separated { what } if what.contains("particle 5")),
        "{:?}",
        loaded.stop
    );
    assert!((loaded.energies().external / (0.5 * force * force * compliance) - 1.0).abs() < 1e-12);
}

/// The thinner of two chains breaks; the other, as stiff, keeps half the force and breaks later.
#[test]
fn of_two_parallel_chains_one_break_halves_the_load() {
    let position = [line(3, 0.0), line(3, 2.0)].concat();
    // Both chains have one thick and one thin bond; strength scatters by radius through bending-free tension.
    let bonds = [([0, 1], 0.3), ([1, 2], 0.3), ([3, 4], 0.3), ([4, 5], 0.3)];
    let mut net = network(Space::Plane, position, &bonds);
    // As stiff, but its section is smaller: it is stressed more.
    net.bonds.radius[2] = 0.24;
    let outcome = run(&pulled(net, 2.0), TENSION, Options::default());
    let [first, second] = &outcome.events[..] else { panic!("{outcome:?}") };
    assert_eq!(first.bonds, [2]);
    assert!((first.force_after / first.force - 0.5).abs() < 1e-12);
    assert!((first.force / (2.0 * STRENGTH * area(0.24)) - 1.0).abs() < 1e-12);
    // Then one of two equals: the lower number.
    assert_eq!(second.bonds, [0]);
    assert!((second.force / (STRENGTH * area(0.3)) - 1.0).abs() < 1e-12);
    assert!((first.energy_released / (0.25 * first.force * first.displacement) - 1.0).abs() < 1e-10);
    assert_eq!(outcome.peak(), Some([first.displacement, first.force]));
}

/// `σ = r P L/I` at the clamp, in the plane and in space, in any direction.
#[test]
fn a_cantilever_bond_breaks_in_bending() {
    let (r, length) = (0.2, 1.5);
    for (space, direction) in [(Space::Plane, 1), (Space::Solid, 1), (Space::Solid, 2)] {
        let position = vec![Vec3::zeros(), Vec3::new(length, 0.0, 0.0)];
        let mut model = bare(network(space, position, &[([0, 1], r)]));
        clamp(&mut model, |x| x.x < 1e-9, Vec3::zeros());
        model.loads.push(PointValue { part: 0, point: 1, component: direction, value: -1.0 });
        let outcome = run(&model, TENSION, Options::default());
        let load = STRENGTH * 0.25 * PI * r.powi(4) / (r * length);
        assert!((outcome.events[0].factor / load - 1.0).abs() < 1e-12);
    }
}

/// A middle particle that loses both bonds at once is torn off; the ends are held.
#[test]
fn a_particle_without_bonds_is_torn_off() {
    let net = network(Space::Plane, line(3, 0.0), &[([0, 1], 0.3), ([1, 2], 0.3)]);
    let virial = FailureLaw::VirialStress(VirialStress {
        measure: Measure::LargestPrincipal,
        strength: Strength::Stress { strength_pa: STRENGTH },
        density_kg_m3: 1.0,
        release: Release::AllBonds,
    });
    let outcome = run(&pulled(net, 2.0), virial, Options::default());
    let [event] = &outcome.events[..] else { panic!("{outcome:?}") };
    // Stress of the middle: (1/2Ω)(L F + L F) = F on unit volume.
    assert_eq!((event.site, &event.bonds[..]), (Site::Particle(1), &[0, 1][..]));
    assert!((event.force / STRENGTH - 1.0).abs() < 1e-12);
    assert!(outcome.torn_off.contains(&(0, 1)), "{:?}", outcome.torn_off);
    assert_eq!(outcome.stop, Stop::EveryBondBroken);
}

/// All points held: no unknown is free, and every bond breaks, the shorter first.
#[test]
fn every_bond_broken_is_an_end() {
    let position = vec![
        Vec3::zeros(),
        Vec3::new(0.0, 2.0, 0.0),
        Vec3::new(0.0, 4.0, 0.0),
        Vec3::new(1.2, 0.0, 0.0),
        Vec3::new(1.1, 2.0, 0.0),
        Vec3::new(1.0, 4.0, 0.0),
    ];
    let net = network(Space::Plane, position, &[([0, 3], 0.2), ([1, 4], 0.2), ([2, 5], 0.2)]);
    let outcome = run(&pulled(net, 1.0), TENSION, Options::default());
    let order: Vec<usize> = outcome.events.iter().flat_map(|e| e.bonds.clone()).collect();
    assert_eq!(order, [2, 1, 0]);
    assert_eq!(outcome.stop, Stop::EveryBondBroken);
    let ledger = outcome.energies();
    assert!(ledger.strain.abs() <= 1e-15 * ledger.fracture, "{ledger:?}");
}

/// A softening bond in a long elastic chain: the path snaps back, and all teeth together spend `A G_f`.
#[test]
fn a_softening_bond_snaps_back_and_spends_its_fracture_energy() {
    // The bond alone softens stably: k G_f/(A f_t²) = 5; with eleven bonds in series it is 5/11, and its first line falls too steeply.
    let energy = 2e-2;
    let softening = FailureLaw::Softening(Softening {
        tensile: Strength::Stress { strength_pa: STRENGTH },
        fracture_energy_j_m2: energy,
        shape: Shape::PETERSSON,
        teeth: 12,
    });
    for (count, snaps) in [(2, false), (12, true)] {
        let bonds: Vec<_> = (1..count).map(|b| ([b - 1, b], 0.3)).collect();
        let model = pulled(network(Space::Plane, line(count, 0.0), &bonds), count as f64 - 1.0);
        let Part::Discrete { network, .. } = &model.parts[0] else { unreachable!("it has bonds") };
        let breakable: Vec<bool> = (0..bonds.len()).map(|b| b == 0).collect();
        let place = Place { network, body: "body", breakable: Some(&breakable), area_m2: None };
        let failure = Failure::new(&FailureRecipe { law: softening, weibull: None }, &place).unwrap();
        let outcome = Cracking::new(&model, vec![(0, failure)], Options::default()).unwrap().run().unwrap();
        assert_closed(&outcome);
        assert_eq!(outcome.events.len(), 12);
        assert_eq!(outcome.stop, Stop::EveryBondBroken);
        let ledger = outcome.energies();
        assert!((ledger.fracture / (energy * area(0.3)) - 1.0).abs() < 1e-10, "{ledger:?}");
        // Held by its ends alone, the bond opens no further in a failure: nothing is left over.
        assert_eq!(ledger.radiated > 1e-3 * ledger.fracture, snaps, "{ledger:?}");
        let back = outcome.events.windows(2).any(|e| e[1].displacement < e[0].displacement);
        assert_eq!(back, snaps, "{count}");
        // Under displacement control never.
        let corners = outcome.envelope();
        assert!(corners.windows(2).all(|c| c[1][0] >= c[0][0]), "{corners:?}");
        if snaps {
            assert!(corners.len() < 2 * outcome.events.len() + 1);
        }
    }
}

#[test]
fn the_envelope_skips_what_snaps_back() {
    let event = |displacement: f64, force: f64, force_after: f64| Event {
        part: 0,
        site: Site::Bond(0),
        bonds: vec![0],
        integrity: vec![0.0],
        places: Vec::new(),
        factor: displacement,
        displacement,
        force,
        force_after,
        energy_released: 0.0,
        fracture_energy: 0.0,
        radiated_energy: 0.0,
        torn_off: 0,
    };
    let events = [event(2.0, 4.0, 3.0), event(1.0, 1.5, 1.0), event(3.0, 3.0, 1.5)];
    assert_eq!(envelope(&events), [[0.0, 0.0], [2.0, 4.0], [2.0, 2.0], [3.0, 3.0], [3.0, 1.5]]);
    assert_eq!(envelope(&[]), [[0.0, 0.0]]);
}

/// Triangular lattice 2 × 1 of `rows` rows, notched at x = 1 from below to half the height.
fn notched(rows: usize) -> Model {
    let block = Block::new(Space::Plane, Vec3::zeros(), Vec3::new(2.0, 1.0, 0.0)).unwrap();
    let l = lattice(LatticeKind::Triangular, block, rows, Matter { density: 1.0, thickness_m: 1.0 }).unwrap();
    let position = &l.arrangement.particles.position;
    // Slightly beside the middle, so that no particle lies on the notch.
    let at = 1.0 + 0.2 / rows as f64;
    let crosses = |i: usize, j: usize| {
        let (a, b) = (position[i], position[j]);
        (a.x - at) * (b.x - at) < 0.0 && 0.5 * (a.y + b.y) < 0.5
    };
    let pairs: Vec<_> = l.pairs.iter().copied().filter(|p| !crosses(p.ends[0], p.ends[1])).collect();
    let recipe =
        BondRecipe { material: MATERIAL, section: Section::Uniform { ratio: 0.7 }, skin: Skin::Weighted };
    pulled(bond_network(&l.arrangement, &pairs, &recipe).unwrap(), 2.0)
}

#[test]
fn a_crack_grows_from_the_notch() {
    let rows = 12;
    let model = notched(rows);
    let outcome = run(&model, TENSION, Options::default());
    let Part::Discrete { network, .. } = &model.parts[0] else { unreachable!("it has bonds") };
    let middle = |b: usize| {
        let [i, j] = network.bonds.ends[b];
        0.5 * (network.particles.position[i] + network.particles.position[j])
    };
    let broken: Vec<Vec3> = outcome.events.iter().map(|e| middle(e.bonds[0])).collect();
    let spacing = 1.0 / rows as f64;
    assert!((broken[0] - Vec3::new(1.0, 0.5, 0.0)).norm() < 1.5 * spacing, "{}", broken[0]);
    // Straight up within two diameters, each break within two of the crack so far, up to the top.
    let far = |k: usize| broken[..k].iter().map(|x| (x - broken[k]).norm()).fold(f64::MAX, f64::min);
    assert!(broken.iter().all(|x| (x.x - 1.0).abs() < 2.5 * spacing), "{broken:?}");
    assert!((1..broken.len()).all(|k| far(k) < 2.5 * spacing), "{broken:?}");
    assert!(broken.iter().any(|x| x.y > 1.0 - spacing));
    assert_eq!(outcome.stop, Stop::Unloaded);
    // The notch weakens: the first break is the peak of a crack that runs unstably under held grips.
    assert!(outcome.events.len() >= rows / 2, "{}", outcome.events.len());
    assert!(outcome.updates > 0 && outcome.work.steps == outcome.events.len() as u64);
    // Again: the same bits.
    assert_eq!(run(&model, TENSION, Options::default()), outcome);
}

fn agree(model: &Model, laws: impl Fn() -> Vec<(usize, Failure)>, events: usize) {
    let with = |most: usize| {
        let options = Options { events, updating: Updating { most }, ..Options::default() };
        let outcome = Cracking::new(model, laws(), options).unwrap().run().unwrap();
        assert_closed(&outcome);
        outcome
    };
    let (redone, updated, mixed) = (with(0), with(10_000), with(model.space.dofs_per_particle()));
    assert_eq!(redone.updates, 0);
    let updates = [&updated, &mixed].map(|o| (o.updates, o.work.factorisations, o.events.len()));
    assert!(updates[0].0 > updates[1].0 && updates[1].0 > 0, "{updates:?} {:?}", redone.stop);
    assert!(updated.work.factorisations < mixed.work.factorisations);
    assert!(mixed.work.factorisations < redone.work.factorisations);
    for other in [&updated, &mixed] {
        assert_eq!(other.stop, redone.stop);
        assert_eq!(other.torn_off, redone.torn_off);
        assert_eq!(other.events.len(), redone.events.len());
        let top = redone.peak().unwrap()[1];
        for (a, b) in other.events.iter().zip(&redone.events) {
            assert_eq!((a.site, &a.bonds), (b.site, &b.bonds));
            assert!((a.factor / b.factor - 1.0).abs() < 1e-10, "{a:?} {b:?}");
            assert!((a.force_after - b.force_after).abs() < 1e-10 * top, "{a:?} {b:?}");
        }
    }
}

/// The same events to 1e-10 whether the factor is updated or made anew.
#[test]
fn updates_and_factorisations_agree() {
    let weibull = Some(Weibull { modulus: 6.0, seed: 3 });
    let model = notched(8);
    agree(&model, || vec![law(&model, 0, TENSION, weibull)], 60);
    let softening = FailureLaw::Softening(Softening {
        tensile: Strength::Stress { strength_pa: STRENGTH },
        fracture_energy_j_m2: 1e-3,
        shape: Shape::Linear,
        teeth: 5,
    });
    agree(&model, || vec![law(&model, 0, softening, weibull)], 60);
}

/// Particles between elements, tied pointwise and by mortar, in the plane and in space.
#[test]
fn particles_tied_to_elements_crack() {
    let weibull = Some(Weibull { modulus: 6.0, seed: 5 });
    for sandwich in [
        Sandwich::plane(4, 8, 4, Method::Pointwise),
        Sandwich::plane(3, 6, 5, Method::Mortar),
        Sandwich::solid(2, 4, 2, Method::Pointwise),
    ] {
        let mut model = sandwich.model();
        prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
        prescribe(&mut model, |x| x.x > 3.0 - 1e-9, |_| Vec3::new(1e-3, 0.0, 0.0));
        agree(&model, || vec![law(&model, 1, TENSION, weibull)], 30);
    }
}

/// Pointwise ties and particles that lose all their bonds at the interface: to the end, in two pieces.
#[test]
fn a_tied_body_cracks_to_the_end() {
    let mut model = Sandwich::plane(4, 4, 4, Method::Pointwise).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    prescribe(&mut model, |x| x.x > 3.0 - 1e-9, |_| Vec3::new(1e-3, 0.0, 0.0));
    let weibull = Some(Weibull { modulus: 3.0, seed: 1 });
    let outcome = Cracking::new(&model, vec![law(&model, 1, TENSION, weibull)], Options::default())
        .unwrap()
        .run()
        .unwrap();
    assert_closed(&outcome);
    assert_eq!(outcome.stop, Stop::Unloaded);
    assert!(outcome.energies().strain.abs() < 1e-12 * outcome.energies().external);
}

#[test]
fn limits_stop_the_path() {
    let model = notched(8);
    let all = run(&model, TENSION, Options::default());
    let some = run(&model, TENSION, Options { events: 2, ..Options::default() });
    assert_eq!((some.events.len(), &some.stop), (2, &Stop::EventLimit));
    assert_eq!(some.events, all.events[..2]);
    let first = all.events[0].factor;
    let none = run(&model, TENSION, Options { factor_limit: 0.99 * first, ..Options::default() });
    assert!(none.events.is_empty());
    assert!(matches!(none.stop, Stop::FactorLimit { factor } if (factor / first - 1.0).abs() < 1e-12));
    // Pushed instead of pulled along a line, nothing is in tension.
    let (net, _) = chain();
    let mut model = pulled(net, 5.0);
    model.supports.iter_mut().for_each(|s| s.value = -s.value);
    let outcome = run(&model, TENSION, Options::default());
    assert_eq!((outcome.events.len(), outcome.stop), (0, Stop::Unloaded));
}

#[test]
fn bad_input_is_refused() {
    let (net, _) = chain();
    let model = pulled(net, 5.0);
    let refused = |model: &Model, laws: Vec<(usize, Failure)>, options: Options, words: &str| {
        let error = Cracking::new(model, laws, options).err().expect(words);
        assert!(error.to_string().contains(words), "'{words}' is missing in: {error}");
        error
    };
    let good = || vec![law(&model, 0, TENSION, None)];
    let mut both = model.clone();
    both.loads.push(PointValue { part: 0, point: 2, component: 0, value: 1.0 });
    refused(&both, good(), Options::default(), "one kind");
    let mut idle = model.clone();
    idle.supports.iter_mut().for_each(|s| s.value = 0.0);
    refused(&idle, good(), Options::default(), "nothing loads it");
    let mut loose = model.clone();
    loose.supports.retain(|s| s.component == 1);
    loose.loads.push(PointValue { part: 0, point: 2, component: 0, value: 1.0 });
    let error = refused(&loose, good(), Options::default(), "mechanism");
    assert!(matches!(error, Error::Mechanism { .. }));
    let other = notched(4);
    refused(&model, vec![law(&other, 0, TENSION, None)], Options::default(), "made for");
    refused(&model, [good(), good()].concat(), Options::default(), "two failure laws");
    let mut used = good();
    used[0].1.fail(0);
    refused(&model, used, Options::default(), "broken bonds");
    let nowhere = vec![(3, good().remove(0).1)];
    refused(&model, nowhere, Options::default(), "no part 3");
    refused(&model, good(), Options { factor_limit: f64::NAN, ..Options::default() }, "factor_limit");
    refused(&model, good(), Options { tie_tolerance: 1.0, ..Options::default() }, "tie_tolerance");
}
