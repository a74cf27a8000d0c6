//! Networks as CSV: errors that name their place, exact round trips, no panics.

use proptest::prelude::*;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::dem::network_csv::{bonds_csv, parse, particles_csv, read, write};
use seam_solver::space::{Space, Vec3};

const PARTICLES: &str = "id,x,y,z,radius,mass\n7,0,0,0,0.5,2\n-3,1,0,0,0.5,2\n12,0,1,0,0.25,1\n";
const BONDS: &str = "i,j,young_Pa,poisson,radius_m\n7,-3,1e9,0.3,0.2\n-3,12,1e9,0.3,0.2\n";

fn plane(particles: &str, bonds: &str) -> seam_solver::error::Result<Network> {
    parse(Space::Plane, ("p.csv", particles.as_bytes()), ("b.csv", bonds.as_bytes()))
}

#[test]
fn ids_are_any_numbers_and_defaults_are_filled_in() {
    let network = plane(PARTICLES, BONDS).unwrap();
    assert_eq!(network.bonds.ends, [[0, 1], [1, 2]]);
    assert_eq!(network.particles.inertia[2], 0.4 * 0.25 * 0.25);
    assert_eq!(network.bonds.weight, [1.0, 1.0]);
    let material = BondMaterial { young_pa: 1e9, poisson: 0.3 };
    assert_eq!(network.bonds.stiffness[0], material.cylinder(0.2, 1.0));
    assert_eq!(network.faces["left"], [0, 2]);
}

#[test]
fn columns_may_come_in_any_order_and_stiffnesses_replace_the_cylinder() {
    let particles = "mass, id ,z,y,x,inertia,radius\n2,1,0,0,0,,0.5\n2,2,0,0,1,0.125,0.5\n";
    let bonds = "j,i,kt,kb,ks,kn,weight,radius_m,poisson,young_Pa\n2,1,4,3,2,1,0.5,0.2,0.3,1e9\n";
    let network = plane(particles, bonds).unwrap();
    assert_eq!(network.particles.inertia, [0.4 * 2.0 * 0.25, 0.125]);
    assert_eq!(network.bonds.stiffness, [BondStiffness { kn: 1.0, ks: 2.0, kb: 3.0, kt: 4.0 }]);
    assert_eq!(network.bonds.weight, [0.5]);
}

#[test]
fn errors_name_file_line_column_and_value() {
    let particles = |from: &str, to: &str| plane(&PARTICLES.replace(from, to), BONDS);
    let bonds = |from: &str, to: &str| plane(PARTICLES, &BONDS.replace(from, to));
    let with_stiffness = |values: &str| {
        plane(PARTICLES, &format!("i,j,young_Pa,poisson,radius_m,kn,ks,kb,kt\n7,-3,1e9,0.3,0.2,{values}\n"))
    };
    let cases = [
        (particles("-3,1", "7,1"), "p.csv:3: column 'id': particle 7 comes twice"),
        (particles("-3,1", "a,1"), "p.csv:3: column 'id': 'a' is not a whole number"),
        (particles("-3,1", "-3,NaN"), "p.csv:3: column 'x': 'NaN' is not a finite number"),
        (particles("-3,1", "-3,"), "p.csv:3: column 'x': '' is not a finite number"),
        (particles("0,1,0,0.25", "0,1,0,-0.25"), "p.csv:4: column 'radius': -0.25 must be positive"),
        (particles("0.25,1", "0.25,0"), "p.csv:4: column 'mass': 0 must be positive"),
        (particles("0,1,0,0.25", "0,1,9,0.25"), "p.csv:4: column 'z': 9 must be 0"),
        (particles("radius", "size"), "p.csv:1: unknown column 'size'"),
        (particles(",mass", ""), "p.csv:1: column 'mass' is missing"),
        (particles("7,0,0,0,0.5,2\n", "7,0,0,0,0.5\n"), "p.csv:2: 5 fields where the header has 6"),
        (plane("id,x,y,z,radius\n", BONDS), "p.csv:1: column 'mass' is missing"),
        (plane("id,id,y,z,radius,mass\n", BONDS), "p.csv:1: column 'id' comes twice"),
        (plane("id,x,y,z,radius,mass\n", BONDS), "p.csv: no particles"),
        (plane("", BONDS), "p.csv:1: column 'id' is missing"),
        (bonds("-3,12", "-3,5"), "b.csv:3: column 'j': there is no particle 5"),
        (bonds("-3,12", "-3,7"), "b.csv:3: column 'j': these particles are already bonded in line 2"),
        (bonds("-3,12", "12,12"), "b.csv:3: column 'j': both ends are in the same place"),
        (bonds("7,-3,1e9", "7,-3,-1e9"), "b.csv:2: column 'young_Pa': -1000000000 must be positive"),
        (bonds("7,-3,1e9,0.3", "7,-3,1e9,0.7"), "b.csv:2: column 'poisson': 0.7 must be"),
        (bonds("0.3,0.2\n-3", "0.3,inf\n-3"), "b.csv:2: column 'radius_m': 'inf' is not a finite number"),
        (bonds("0.3,0.2\n-3", "0.3,1e200\n-3"), "b.csv:2: column 'radius_m': stiffnesses"),
        (with_stiffness("1,2,,4"), "b.csv:2: column 'kb': empty; give all"),
        (with_stiffness("1,2,-3,4"), "b.csv:2: column 'kb': -3 must be"),
    ];
    for (result, expected) in cases {
        let message = result.expect_err(expected).to_string();
        assert!(message.contains(expected), "{message}\nis not\n{expected}");
    }
}

#[test]
fn a_missing_file_is_named() {
    let missing = std::path::Path::new("no/such/particles.csv");
    let message = read(Space::Plane, missing, missing).unwrap_err().to_string();
    assert!(message.contains("no/such/particles.csv"), "{message}");
}

#[test]
fn files_come_back_as_they_went() {
    let network = plane(PARTICLES, BONDS).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (p, b) = (folder.path().join("particles.csv"), folder.path().join("bonds.csv"));
    write(&network, BondMaterial { young_pa: 1e9, poisson: 0.3 }, &p, &b).unwrap();
    assert_eq!(read(Space::Plane, &p, &b).unwrap(), network);
}

/// A chain of particles with arbitrary positive numbers.
fn chain() -> impl Strategy<Value = Network> {
    let number = || (1e-9..1e9f64, 1e-9..1.0f64).prop_map(|(a, b)| a * b);
    let particle = (number(), number(), [number(), number(), number()]);
    let bond = (number(), [number(), number(), number(), number()], 0.0..=1.0f64);
    (prop::collection::vec(particle, 2..8), prop::collection::vec(bond, 8)).prop_map(|(particles, bonds)| {
        let mut network = Network {
            space: Space::Solid,
            particles: Particles::default(),
            bonds: Bonds::default(),
            faces: Default::default(),
        };
        for (k, (x, y, [radius, mass, inertia])) in particles.into_iter().enumerate() {
            network.particles.position.push(Vec3::new(x, -y, k as f64));
            network.particles.radius.push(radius);
            network.particles.mass.push(mass);
            network.particles.inertia.push(inertia);
        }
        for (b, (radius, [kn, ks, kb, kt], weight)) in
            bonds.into_iter().take(network.particles.len() - 1).enumerate()
        {
            network.bonds.ends.push([b + 1, b]);
            network.bonds.radius.push(radius);
            network.bonds.stiffness.push(BondStiffness { kn, ks, kb, kt });
            network.bonds.weight.push(weight);
        }
        network
    })
}

proptest! {
    #[test]
    fn arbitrary_bytes_never_panic(p in prop::collection::vec(any::<u8>(), 0..200), b in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = parse(Space::Solid, ("p.csv", &p), ("b.csv", &b));
        let _ = parse(Space::Solid, ("p.csv", PARTICLES.as_bytes()), ("b.csv", &b));
    }

    #[test]
    fn damaged_tables_never_panic_and_never_let_nan_through(at in 0..BONDS.len(), by in "[0-9eE.,+\\-naif\"\n ]{0,4}") {
        let mut bonds = BONDS.to_owned();
        bonds.replace_range(at..at + 1, &by);
        if let Ok(network) = plane(PARTICLES, &bonds) {
            prop_assert!(network.bonds.stiffness.iter().all(|k| (k.kn + k.ks + k.kb + k.kt).is_finite()));
        }
    }

    #[test]
    fn round_trip_is_exact(network in chain()) {
        let material = BondMaterial { young_pa: 1.0, poisson: 0.0 };
        let (p, b) = (particles_csv(&network), bonds_csv(&network, material));
        let back = parse(Space::Solid, ("p.csv", p.as_bytes()), ("b.csv", b.as_bytes())).unwrap();
        prop_assert_eq!(&back.particles, &network.particles);
        prop_assert_eq!(&back.bonds, &network.bonds);
    }
}
