//! Finite rotations: gradient of the energy, rigid motion, order of the particles, elastica, roll-up.

use seam_solver::dem::corotational::Corotational;
use seam_solver::dem::corotational::equilibrium;
use seam_solver::dem::kernel::Kernel;
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::space::{Space, Vec3};
use std::f64::consts::{PI, TAU};

fn network(space: Space, position: Vec<Vec3>, ends: Vec<[usize; 2]>, k: BondStiffness) -> Network {
    let (count, bonds) = (position.len(), ends.len());
    let particles =
        Particles { position, radius: vec![0.1; count], mass: vec![1.0; count], inertia: vec![0.1; count] };
    let bonds = Bonds { ends, radius: vec![0.1; bonds], stiffness: vec![k; bonds], weight: vec![1.0; bonds] };
    Network { space, particles, bonds, faces: Default::default() }
}

const K: BondStiffness = BondStiffness { kn: 5.0, ks: 2.0, kb: 0.7, kt: 0.4 };

/// Three particles in space, bonded all round.
fn triangle(ends: [[usize; 2]; 3]) -> Network {
    let position = vec![Vec3::zeros(), Vec3::new(1.0, 0.2, -0.3), Vec3::new(0.3, 1.1, 0.5)];
    network(Space::Solid, position, ends.to_vec(), K)
}

const ROUND: [[usize; 2]; 3] = [[0, 1], [1, 2], [0, 2]];

fn wave(n: usize, amplitude: f64) -> Vec<f64> {
    (0..n).map(|i| amplitude * (2.3 * i as f64 + 0.4).sin()).collect()
}

fn turned(network: &Network, q: &[f64]) -> Corotational {
    let mut bonds = Corotational::new(network, "b").unwrap();
    bonds.turn(q, 1.0);
    bonds
}

fn forces(bonds: &Corotational, u: &[f64]) -> Vec<f64> {
    let mut f = vec![0.0; u.len()];
    bonds.add_internal(u, &mut f);
    f
}

#[test]
fn forces_are_the_gradient_of_the_energy() {
    let network = triangle(ROUND);
    for amplitude in [0.05, 0.5, 0.9] {
        let u = wave(18, amplitude);
        let bonds = turned(&network, &u);
        let f = forces(&bonds, &u);
        let size = f.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        for i in 0..18 {
            let energy = |h: f64| {
                let (mut bonds, mut u, mut change) = (bonds.clone(), u.clone(), vec![0.0; 18]);
                u[i] += h;
                change[i] = h;
                bonds.turn(&change, 1.0);
                bonds.energy(&u)
            };
            let h = 1e-5;
            // Fourth order, so that rounding, 1e-16/h, is what limits.
            let slope = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
            assert!((slope - f[i]).abs() < 1e-9 * size, "{amplitude}, {i}: {slope} {}", f[i]);
        }
    }
}

#[test]
fn forces_and_moments_balance() {
    let network = triangle(ROUND);
    let u = wave(18, 0.8);
    let f = forces(&turned(&network, &u), &u);
    let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
    for p in 0..3 {
        let part = |q: &[f64], c: usize| Vec3::new(q[6 * p + c], q[6 * p + c + 1], q[6 * p + c + 2]);
        force += part(&f, 0);
        moment += part(&f, 3) + (network.particles.position[p] + part(&u, 0)).cross(&part(&f, 0));
    }
    assert!(force.amax() < 1e-14 && moment.amax() < 1e-14, "{force} {moment}");
}

#[test]
fn the_order_of_the_two_particles_changes_nothing() {
    let u = wave(18, 0.8);
    let there = forces(&turned(&triangle(ROUND), &u), &u);
    let back = forces(&turned(&triangle(ROUND.map(|[i, j]| [j, i])), &u), &u);
    assert_eq!(there, back);
    // Numbering the particles the other way round makes every bond start at its other end.
    let mut mirrored = triangle(ROUND);
    mirrored.particles.position.reverse();
    mirrored.bonds.ends.iter_mut().for_each(|ends| *ends = ends.map(|p| 2 - p));
    let reverse = |q: &[f64]| -> Vec<f64> { q.chunks(6).rev().flatten().copied().collect() };
    let f = forces(&turned(&mirrored, &reverse(&u)), &reverse(&u));
    let off = there.iter().zip(reverse(&f)).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(off < 1e-14, "{off:e}");
}

/// Small motion: the small-rotation kernel, up to second order.
#[test]
fn small_rotations_give_the_linear_forces() {
    let network = triangle(ROUND);
    let off = |amplitude: f64| {
        let u = wave(18, amplitude);
        let mut linear = vec![0.0; 18];
        Kernel::new(&network, "b").unwrap().add_internal(&u, &mut linear);
        let f = forces(&turned(&network, &u), &u);
        f.iter().zip(&linear).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / amplitude
    };
    let ratio = off(1e-3) / off(1e-4);
    // The difference is of second order: relative to the forces it falls with the amplitude.
    assert!((ratio - 10.0).abs() < 0.1, "{ratio}");
}

/// Two full turns about an oblique axis, in steps: no energy beside that of a unit strain.
#[test]
fn rigid_rotation_by_720_degrees_stores_nothing() {
    let network = triangle(ROUND);
    let axis = Vec3::new(1.0, 2.0, -0.5).normalize();
    let mut bonds = Corotational::new(&network, "b").unwrap();
    let steps = 720;
    let increment: Vec<f64> = (0..3)
        .flat_map(|_| [Vec3::zeros(), axis * (4.0 * PI / steps as f64)])
        .flat_map(|v| [v.x, v.y, v.z])
        .collect();
    for step in 1..=steps {
        bonds.turn(&increment, 1.0);
        let rotation = nalgebra::Rotation3::from_scaled_axis(axis * (4.0 * PI * step as f64 / steps as f64));
        let u: Vec<f64> = network
            .particles
            .position
            .iter()
            .flat_map(|x| {
                let shift = rotation * x - x;
                [shift.x, shift.y, shift.z, 0.0, 0.0, 0.0]
            })
            .collect();
        // Strain scale: every bond at a strain of one, ½ k_n L² each.
        assert!(bonds.energy(&u) < 1e-12 * 3.0 * 0.5 * K.kn, "step {step}");
        assert!(forces(&bonds, &u).iter().all(|f| f.abs() < 1e-12));
    }
}

/// A cantilever of `n` bonds along x, length 1, EI = 1, and EA so large that it does not stretch.
fn cantilever(n: usize) -> Network {
    let l = 1.0 / n as f64;
    let k = BondStiffness { kn: 1e6 / l, ks: 12.0 / l.powi(3), kb: 1.0 / l, kt: 1.0 / l };
    let position = (0..=n).map(|i| Vec3::new(i as f64 * l, 0.0, 0.0)).collect();
    network(Space::Plane, position, (0..n).map(|i| [i, i + 1]).collect(), k)
}

/// Tip force P L²/EI = 1 and 5 (Mattiasson 1981): error O(n⁻²), and small at n = 40.
#[test]
fn the_elastica_is_met_at_second_order() {
    for (force, w, u) in [(1.0, 0.301_720_774, 0.056_433_236), (5.0, 0.713_791_524, 0.387_628_366)] {
        let error = |n: usize| {
            let mut bonds = Corotational::new(&cantilever(n), "beam").unwrap();
            let mut load = vec![0.0; 3 * (n + 1)];
            load[3 * n + 1] = force;
            let found = equilibrium::solve(&mut bonds, &[0, 1, 2], &load, 4).unwrap();
            [(found.u[3 * n + 1] - w).abs(), (-found.u[3 * n] - u).abs()]
        };
        let [coarse, fine] = [error(10), error(20)];
        for i in 0..2 {
            let order = (coarse[i] / fine[i]).log2();
            // EA = 1e6 leaves a stretch of 5e-6, a share of the finer error.
            assert!((order - 2.0).abs() < 0.1, "{force}: {order} {coarse:?} {fine:?}");
            assert!(fine[i] < 2e-3, "{force}: {fine:?}");
        }
    }
}

/// Tip moment 2π EI/L: the beam closes; its tip turns by 2π exactly, its particles lie on the circle up to O(n⁻²).
#[test]
fn a_beam_rolls_up_to_a_circle() {
    let error = |n: usize| {
        let mut bonds = Corotational::new(&cantilever(n), "beam").unwrap();
        let mut load = vec![0.0; 3 * (n + 1)];
        load[3 * n + 2] = TAU;
        let found = equilibrium::solve(&mut bonds, &[0, 1, 2], &load, 8).unwrap();
        assert!((found.u[3 * n + 2] / TAU - 1.0).abs() < 1e-9, "{}", found.u[3 * n + 2]);
        let off = |p: usize| {
            let s = p as f64 / n as f64;
            let exact = Vec3::new((TAU * s).sin(), 1.0 - (TAU * s).cos(), 0.0) / TAU;
            (Vec3::new(s + found.u[3 * p], found.u[3 * p + 1], 0.0) - exact).norm()
        };
        (0..=n).map(off).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(10), error(20));
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.1, "{order} {coarse:e} {fine:e}");
}
