//! Failure laws: known stress states, scale, frame, order of the particles, strength and its scatter, bad input.

mod common;

use common::{YOUNG, cubic};
use proptest::prelude::*;
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::dem::skin::Skin;
use seam_solver::error::Error;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::forces::BondForce;
use seam_solver::failure::softening::{Shape, Softening};
use seam_solver::failure::strength::{Strength, Weibull};
use seam_solver::failure::virial::{Measure, Release, VirialStress};
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place, Site};
use seam_solver::space::{Space, Vec3};
use std::f64::consts::PI;

const K: BondStiffness = BondStiffness { kn: 5.0, ks: 2.0, kb: 0.7, kt: 0.4 };
const R: f64 = 0.2;

fn network(space: Space, position: Vec<Vec3>, ends: Vec<[usize; 2]>) -> Network {
    let (count, bonds) = (position.len(), ends.len());
    let radius = (0..count).map(|p| 0.3 + 0.02 * p as f64).collect();
    let particles = Particles { position, radius, mass: vec![2.0; count], inertia: vec![0.1; count] };
    let bonds = Bonds { ends, radius: vec![R; bonds], stiffness: vec![K; bonds], weight: vec![1.0; bonds] };
    Network { space, particles, bonds, faces: Default::default() }
}

fn tetrahedron(ends: Vec<[usize; 2]>) -> Network {
    let position =
        vec![Vec3::zeros(), Vec3::new(1.0, 0.2, -0.3), Vec3::new(0.3, 1.1, 0.5), Vec3::new(-0.2, 0.4, 0.9)];
    network(Space::Solid, position, ends)
}

const ROUND: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]];
const ONE: Strength = Strength::Stress { strength_pa: 1.0 };

fn virial(measure: Measure, release: Release, density_kg_m3: f64) -> FailureLaw {
    FailureLaw::VirialStress(VirialStress { measure, strength: ONE, density_kg_m3, release })
}

fn softening(shape: Shape, teeth: usize) -> FailureLaw {
    FailureLaw::Softening(Softening { tensile: ONE, fracture_energy_j_m2: 3.0, shape, teeth })
}

fn laws() -> Vec<FailureLaw> {
    let shear = Strength::Toughness { toughness_pa_sqrt_m: 2.0, factor: 0.6 };
    vec![
        FailureLaw::BondStress(BondStress::Normal { tensile: ONE }),
        FailureLaw::BondStress(BondStress::Shear { shear }),
        FailureLaw::BondStress(BondStress::Mixed { tensile: ONE, shear }),
        virial(Measure::LargestPrincipal, Release::AllBonds, 4.0),
        virial(Measure::Hydrostatic, Release::MostTensile, 4.0),
        softening(Shape::PETERSSON, 7),
    ]
}

fn made(law: FailureLaw, network: &Network) -> Failure {
    try_make(law, None, network).unwrap()
}

fn try_make(law: FailureLaw, weibull: Option<Weibull>, network: &Network) -> Result<Failure, Error> {
    let place = Place { network, body: "b", breakable: None, area_m2: None };
    Failure::new(&FailureRecipe { law, weibull }, &place)
}

fn demands(law: FailureLaw, network: &Network, u: &[f64]) -> Vec<f64> {
    let failure = made(law, network);
    failure.demands(network, &BondForce::all(network, u, failure.integrity()))
}

fn close(a: &[f64], b: &[f64], share: f64) -> bool {
    let scale = b.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= share * scale)
}

proptest! {
    // Rounding of sums and square roots of a dozen terms: 1e-12 leaves two digits.
    #[test]
    fn demands_are_homogeneous_of_degree_one(u in prop::collection::vec(-1.0..1.0f64, 24), factor in 0.01..100.0f64) {
        let network = tetrahedron(ROUND.to_vec());
        let larger: Vec<f64> = u.iter().map(|u| factor * u).collect();
        for law in laws() {
            let expected: Vec<f64> = demands(law, &network, &u).iter().map(|d| factor * d).collect();
            prop_assert!(close(&demands(law, &network, &larger), &expected, 1e-12), "{law:?}");
        }
    }

    #[test]
    fn a_turned_frame_changes_nothing(u in prop::collection::vec(-1.0..1.0f64, 24), axis in prop::array::uniform3(-2.0..2.0f64)) {
        let turn = nalgebra::Rotation3::new(Vec3::from(axis));
        let network = tetrahedron(ROUND.to_vec());
        let mut turned = network.clone();
        turned.particles.position.iter_mut().for_each(|x| *x = turn * *x);
        let v: Vec<f64> =
            u.chunks(3).flat_map(|t| { let t = turn * Vec3::from_column_slice(t); [t.x, t.y, t.z] }).collect();
        for law in laws() {
            prop_assert!(close(&demands(law, &turned, &v), &demands(law, &network, &u), 1e-12), "{law:?}");
        }
    }

    #[test]
    fn the_order_of_a_bonds_particles_does_not_matter(u in prop::collection::vec(-1.0..1.0f64, 24)) {
        let network = tetrahedron(ROUND.to_vec());
        let swapped = tetrahedron(ROUND.iter().map(|&[i, j]| [j, i]).collect());
        for law in laws() {
            prop_assert!(close(&demands(law, &swapped, &u), &demands(law, &network, &u), 1e-12), "{law:?}");
        }
    }
}

/// One bond of length 2 along x in space: each component alone gives its textbook stress.
#[test]
fn one_bond_has_the_stresses_of_a_beam() {
    let network = network(Space::Solid, vec![Vec3::zeros(), Vec3::new(2.0, 0.0, 0.0)], vec![[0, 1]]);
    let (a, i) = (PI * R * R, 0.25 * PI * R.powi(4));
    let normal = FailureLaw::BondStress(BondStress::Normal { tensile: ONE });
    let shear = FailureLaw::BondStress(BondStress::Shear { shear: ONE });
    let mixed = FailureLaw::BondStress(BondStress::Mixed { tensile: ONE, shear: ONE });
    let of = |law, unknown: usize, value: f64| {
        let mut u = vec![0.0; 12];
        u[unknown] = value;
        demands(law, &network, &u)[0]
    };
    // Stretch: N = k_n u. Compression does no harm.
    assert!((of(normal, 6, 0.1) - 0.5 / a).abs() < 1e-12);
    assert_eq!(of(normal, 6, -0.1), 0.0);
    assert_eq!(of(shear, 6, 0.1), 0.0);
    // Deflection w of one end, both held straight: V = k_s w, moments ±V L/2 at the ends.
    let (v, m) = (0.2, 0.2);
    assert!((of(normal, 7, 0.1) - R * m / i).abs() < 1e-12);
    assert!((of(shear, 7, 0.1) - v * 4.0 / (3.0 * a)).abs() < 1e-12);
    assert!((of(mixed, 7, 0.1) - (R * m / i).hypot(v * 4.0 / (3.0 * a))).abs() < 1e-12);
    // Twist: M_x = k_t θ.
    assert!((of(shear, 9, 0.1) - R * 0.04 / (2.0 * i)).abs() < 1e-12);
    assert_eq!(of(normal, 9, 0.1), 0.0);
}

/// Half of a bond in a face carries half the force over half the section; a facet twice as large halves the stress.
#[test]
fn stress_is_that_of_the_whole_section_or_of_the_area_given() {
    let whole = network(Space::Plane, vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)], vec![[0, 1]]);
    let u = [0.0, 0.0, 0.0, 0.1, 0.2, 0.3];
    let mut half = whole.clone();
    half.bonds.weight[0] = 0.5;
    for law in laws().into_iter().filter(|law| !matches!(law, FailureLaw::VirialStress(_))) {
        let expected = demands(law, &whole, &u);
        assert!(close(&demands(law, &half, &u), &expected, 1e-14), "{law:?}");
    }
    let law = FailureLaw::BondStress(BondStress::Mixed { tensile: ONE, shear: ONE });
    let area = [2.0 * PI * R * R];
    let place = Place { network: &whole, body: "b", breakable: None, area_m2: Some(&area) };
    let failure = Failure::new(&FailureRecipe { law, weibull: None }, &place).unwrap();
    let demand = failure.demands(&whole, &BondForce::all(&whole, &u, &[1.0]))[0];
    assert!((2.0 * demand / demands(law, &whole, &u)[0] - 1.0).abs() < 1e-14);
}

/// Square and simple cubic lattices under uniform strain without lateral contraction: `σ = E ε` in every particle, faces
/// included, since bonds and volumes there are shared alike.
#[test]
fn virial_stress_of_uniform_tension_is_exact() {
    for space in [Space::Plane, Space::Solid] {
        let upper = if space == Space::Plane { Vec3::new(2.0, 1.0, 0.0) } else { Vec3::new(2.0, 1.0, 1.0) };
        let network = cubic(space, Vec3::zeros(), upper, 4, Skin::Weighted);
        let per = space.dofs_per_particle();
        let mut u = vec![0.0; per * network.particles.len()];
        network.particles.position.iter().enumerate().for_each(|(p, x)| u[per * p] = 1e-6 * x.x);
        // Particles in the end faces have bonds on one side only.
        let inside = |p: usize| (0.1..1.9).contains(&network.particles.position[p].x);
        for (measure, share) in
            [(Measure::LargestPrincipal, 1.0), (Measure::Hydrostatic, 1.0 / space.dim() as f64)]
        {
            let found = demands(virial(measure, Release::AllBonds, 1.0), &network, &u);
            let worst = (0..found.len())
                .filter(|&p| inside(p))
                .map(|p| (found[p] / (share * YOUNG * 1e-6) - 1.0).abs());
            assert!(worst.fold(0.0, f64::max) < 1e-12, "{space:?} {measure:?}");
        }
    }
}

#[test]
fn a_failing_particle_lets_go_all_its_bonds_or_the_most_tensile() {
    let network = tetrahedron(ROUND.to_vec());
    let mut u = vec![0.0; 24];
    u[6] = 0.3;
    for (release, expected) in [(Release::AllBonds, vec![0, 1, 4]), (Release::MostTensile, vec![0])] {
        let failure = made(virial(Measure::LargestPrincipal, release, 4.0), &network);
        let forces = BondForce::all(&network, &u, failure.integrity());
        assert_eq!(failure.site(1), Site::Particle(1));
        assert_eq!(failure.bonds_of(Site::Particle(1), &network, &forces), expected);
    }
}

/// Drives one bond through its teeth: the elongations and secants spend `A G_f`, and the peak tends to `f_t`.
#[test]
fn softening_spends_the_fracture_energy() {
    let network = network(Space::Plane, vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)], vec![[0, 1]]);
    let area = PI * R * R;
    for shape in [Shape::Linear, Shape::PETERSSON, Shape::Bilinear { kink_stress: 0.2, kink_opening: 0.5 }] {
        let mut above = Vec::new();
        for teeth in [1, 4, 16, 64] {
            let mut failure = made(softening(shape, teeth), &network);
            let (mut spent, mut peaks) = (0.0, Vec::new());
            for _ in 0..teeth {
                let before = failure.integrity()[0];
                let unit = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
                let forces = BondForce::all(&network, &unit, failure.integrity());
                let elongation = 1.0 / failure.demands(&network, &forces)[0];
                peaks.push(before * K.kn * elongation / area);
                let after = failure.fail(0);
                assert!(after < before);
                spent += 0.5 * K.kn * (before - after) * elongation * elongation;
            }
            assert_eq!(failure.integrity()[0], 0.0);
            assert!((spent / (3.0 * area) - 1.0).abs() < 1e-13, "{shape:?} {teeth}: {spent}");
            assert!(peaks.windows(2).all(|p| p[1] < p[0]), "{shape:?} {teeth}: {peaks:?}");
            above.push(peaks[0] - 1.0);
        }
        // Less than a tooth's step 1/q above f_t, and first order in 1/teeth: less than half from 16 to 64.
        assert!(above[3] > 0.0 && above[3] < 0.5 * above[2] && above[2] < 0.5 * above[1], "{above:?}");
        assert!(above[3] < 0.12, "{above:?}");
    }
}

/// `K_Ic/√R`: four times the size, half the strength, so twice the demand of the same stress.
#[test]
fn strength_from_toughness_falls_with_the_root_of_size() {
    let law = FailureLaw::BondStress(BondStress::Normal {
        tensile: Strength::Toughness { toughness_pa_sqrt_m: 1.5, factor: 0.4 },
    });
    let small = network(Space::Plane, vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)], vec![[0, 1]]);
    let mut large = small.clone();
    large.particles.radius.iter_mut().for_each(|r| *r *= 4.0);
    let u = [0.0, 0.0, 0.0, 0.1, 0.0, 0.0];
    let [small, large] = [small, large].map(|n| demands(law, &n, &u)[0]);
    // R = 0.31: σ_t = 0.4 · 1.5 / √0.31.
    assert!((small - 0.5 / (PI * R * R) * 0.31f64.sqrt() / 0.6).abs() < 1e-12);
    assert!((large / small - 2.0).abs() < 1e-13);
}

#[test]
fn scatter_is_seeded_and_of_the_right_shape() {
    let n = 20_000;
    for modulus in [2.0, 10.0] {
        let weibull = Weibull { modulus, seed: 7 };
        let factors = weibull.factors(n);
        assert_eq!(factors, weibull.factors(n));
        assert_ne!(factors, Weibull { seed: 8, ..weibull }.factors(n));
        // P(factor < x) = 1 − exp(−x^m); three standard deviations of a share of 20000 are 0.011.
        for x in [0.7f64, 1.0, 1.2] {
            let share = factors.iter().filter(|f| **f < x).count() as f64 / n as f64;
            assert!((share - (1.0 - (-x.powf(modulus)).exp())).abs() < 0.011, "{modulus} {x} {share}");
        }
    }
    let network = tetrahedron(ROUND.to_vec());
    let mut u = vec![0.0; 24];
    u[6] = 0.3;
    let weibull = Weibull { modulus: 3.0, seed: 1 };
    for law in laws() {
        let failure = try_make(law, Some(weibull), &network).unwrap();
        let forces = BondForce::all(&network, &u, failure.integrity());
        let plain = demands(law, &network, &u);
        let scattered = failure.demands(&network, &forces);
        if !matches!(law, FailureLaw::Softening(_) | FailureLaw::BondStress(BondStress::Mixed { .. })) {
            for ((s, p), f) in scattered.iter().zip(&plain).zip(weibull.factors(plain.len())) {
                assert!((s * f - p).abs() < 1e-13 * (1.0 + p), "{law:?}");
            }
        }
        assert_ne!(scattered, plain, "{law:?}");
    }
}

/// What an explicit integrator asks after each step; broken and unbreakable bonds stay out.
#[test]
fn bonds_of_demand_one_and_more_fail() {
    let position = (0..4).map(|p| Vec3::new(f64::from(p), 0.0, 0.0)).collect();
    let network = network(Space::Plane, position, vec![[0, 1], [1, 2], [2, 3]]);
    let law = FailureLaw::BondStress(BondStress::Normal { tensile: ONE });
    let breakable = [true, true, false];
    let place = Place { network: &network, body: "b", breakable: Some(&breakable), area_m2: None };
    let mut failure = Failure::new(&FailureRecipe { law, weibull: None }, &place).unwrap();
    let area = PI * R * R;
    // Elongations of 1.1, 0.9 and 2 times the one at strength.
    let mut u = vec![0.0; 12];
    for (p, e) in [(1, 1.1), (2, 2.0), (3, 4.0)] {
        u[3 * p] = e * area / K.kn;
    }
    let forces = BondForce::all(&network, &u, failure.integrity());
    assert_eq!(failure.failing(&network, &forces), [0]);
    assert_eq!(failure.fail(0), 0.0);
    let forces = BondForce::all(&network, &u, failure.integrity());
    assert_eq!(forces[0].force, Vec3::zeros());
    assert!(failure.failing(&network, &forces).is_empty());
    assert!(!failure.may_break(0) && failure.may_break(1) && !failure.may_break(2));
}

#[test]
fn bad_constants_are_refused_by_name() {
    let network = tetrahedron(ROUND.to_vec());
    let refused = |law: FailureLaw, weibull: Option<Weibull>, name: &str| {
        let error = try_make(law, weibull, &network).unwrap_err();
        assert!(matches!(error, Error::Material { .. }), "{error}");
        assert!(error.to_string().contains(name), "'{name}' is missing in: {error}");
    };
    for strength_pa in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let bad = Strength::Stress { strength_pa };
        refused(FailureLaw::BondStress(BondStress::Normal { tensile: bad }), None, "tensile strength_Pa");
        refused(
            FailureLaw::BondStress(BondStress::Mixed { tensile: ONE, shear: bad }),
            None,
            "shear strength_Pa",
        );
        let toughness = Strength::Toughness { toughness_pa_sqrt_m: strength_pa, factor: 1.0 };
        refused(FailureLaw::BondStress(BondStress::Shear { shear: toughness }), None, "toughness");
        let mut law = VirialStress {
            measure: Measure::Hydrostatic,
            strength: bad,
            density_kg_m3: 1.0,
            release: Release::AllBonds,
        };
        refused(FailureLaw::VirialStress(law), None, "strength_Pa");
        (law.strength, law.density_kg_m3) = (ONE, strength_pa);
        refused(FailureLaw::VirialStress(law), None, "density");
        let mut law = Softening { tensile: bad, fracture_energy_j_m2: 1.0, shape: Shape::Linear, teeth: 5 };
        refused(FailureLaw::Softening(law), None, "tensile");
        (law.tensile, law.fracture_energy_j_m2) = (ONE, strength_pa);
        refused(FailureLaw::Softening(law), None, "fracture_energy");
        let weibull = Weibull { modulus: strength_pa, seed: 0 };
        refused(softening(Shape::Linear, 5), Some(weibull), "Weibull");
    }
    refused(softening(Shape::Linear, 0), None, "teeth");
    refused(softening(Shape::Bilinear { kink_stress: 1.5, kink_opening: 0.1 }, 5), None, "kink_stress");
    refused(softening(Shape::Bilinear { kink_stress: 0.5, kink_opening: 1.5 }, 5), None, "kink_opening");
    let breakable = [true; 5];
    let place = Place { network: &network, body: "disc", breakable: Some(&breakable), area_m2: None };
    let error =
        Failure::new(&FailureRecipe { law: laws()[0], weibull: None }, &place).unwrap_err().to_string();
    assert!(error.contains("'disc'") && error.contains("5 entries for 6 bonds"), "{error}");
}
