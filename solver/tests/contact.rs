//! Contact after failure: restitution, friction, reach, energy, who may touch.

use seam_solver::contact::Contacts;
use seam_solver::contact::law::{ContactLaw, Normal};
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

const LINEAR: Normal = Normal::Linear { stiffness_n_m: 1e5 };
const HERTZ: Normal = Normal::Hertz { young_pa: 1e8, poisson: 0.25 };

fn law(normal: Normal, restitution: f64, friction: f64) -> ContactLaw {
    ContactLaw { normal, restitution, friction, stiffness_ratio: 2.0 / 7.0 }
}

/// Spheres of radius 0.01 and 0.015 m with their centres at given places; no bonds.
fn spheres(space: Space, position: Vec<Vec3>) -> Network {
    let count = position.len();
    let radius: Vec<f64> = (0..count).map(|p| if p % 2 == 0 { 0.01 } else { 0.015 }).collect();
    let mass: Vec<f64> = radius.iter().map(|r| 4e6 * r * r * r).collect();
    let inertia = mass.iter().zip(&radius).map(|(m, r)| 0.4 * m * r * r).collect();
    let particles = Particles { position, radius, mass, inertia };
    Network { space, particles, bonds: Bonds::default(), faces: Default::default() }
}

struct Run {
    network: Network,
    contacts: Contacts,
    u: Vec<f64>,
    v: Vec<f64>,
    work: Work,
}

impl Run {
    fn new(law: ContactLaw, network: Network) -> Self {
        let mut contacts = Contacts::new(law, &network).unwrap();
        (0..network.particles.len()).for_each(|p| contacts.activate(p));
        let n = network.space.dofs_per_particle() * network.particles.len();
        Run { network, contacts, u: vec![0.0; n], v: vec![0.0; n], work: Work::default() }
    }

    fn mass(&self, i: usize) -> f64 {
        let per = self.network.space.dofs_per_particle();
        let particles = &self.network.particles;
        if i % per < self.network.space.dim() { particles.mass[i / per] } else { particles.inertia[i / per] }
    }

    /// One leapfrog step; the forces.
    fn step(&mut self, dt: f64) -> Vec<f64> {
        let mut f = vec![0.0; self.u.len()];
        self.contacts.add_forces(&self.u, &self.v, dt, &mut f, &mut self.work);
        for i in 0..f.len() {
            self.v[i] += dt * f[i] / self.mass(i);
            self.u[i] += dt * self.v[i];
        }
        f
    }

    fn kinetic(&self) -> f64 {
        (0..self.v.len()).map(|i| 0.5 * self.mass(i) * self.v[i] * self.v[i]).sum()
    }

    fn momentum(&self) -> Vec3 {
        let (dim, per) = (self.network.space.dim(), self.network.space.dofs_per_particle());
        let of = |p: usize| Vec3::from_fn(|c, _| if c < dim { self.v[p * per + c] } else { 0.0 });
        (0..self.network.particles.len()).map(|p| self.network.particles.mass[p] * of(p)).sum()
    }
}

/// Rebound of a central collision, in the plane and in space, along any line, for both laws; Hertz at any speed.
#[test]
fn two_spheres_rebound_with_the_stated_restitution() {
    for (space, normal) in [(Space::Plane, LINEAR), (Space::Solid, LINEAR), (Space::Solid, HERTZ)] {
        for restitution in [1.0, 0.8, 0.5, 0.2] {
            for speed in [0.2, 2.0] {
                let depth = if space == Space::Plane { 0.0 } else { -0.3 };
                let n = Vec3::new(0.6, 0.5, depth).normalize();
                let network = spheres(space, vec![Vec3::zeros(), 0.0251 * n]);
                let mut run = Run::new(law(normal, restitution, 0.0), network);
                let per = space.dofs_per_particle();
                (0..space.dim()).for_each(|c| run.v[per + c] = -speed * n[c]);
                let before = run.momentum();
                let closing =
                    |run: &Run| (0..space.dim()).map(|c| (run.v[per + c] - run.v[c]) * n[c]).sum::<f64>();
                let dt = 2e-7;
                let mut touched = false;
                for _ in 0..100_000 {
                    run.step(dt);
                    touched |= run.contacts.touching() > 0;
                    if touched && run.contacts.touching() == 0 {
                        break;
                    }
                }
                let e = closing(&run) / speed;
                // Some thousand steps in contact, damping lags by half of one.
                assert!((e - restitution).abs() < 2e-3, "{space:?} {normal:?} {restitution} {speed}: {e}");
                assert!((run.momentum() - before).norm() < 1e-12 * before.norm());
            }
        }
    }
}

/// Pressed together and sheared: sticks below `μN`, slides at it, in both laws; the couple balances.
#[test]
fn friction_stays_in_its_cone() {
    for normal in [LINEAR, HERTZ] {
        let friction = 0.4;
        let network = spheres(Space::Plane, vec![Vec3::zeros(), Vec3::new(0.025, 0.0, 0.0)]);
        let mut contacts = Contacts::new(law(normal, 1.0, friction), &network).unwrap();
        contacts.activate(0);
        let (mut work, dt, speed) = (Work::default(), 1e-4, 1e-3);
        let mut u = [0.0; 6];
        u[3] = -1e-5;
        let v = [0.0, 0.0, 0.0, 0.0, speed, 0.0];
        let (mut stuck, mut slid) = (0, 0);
        for _ in 0..400 {
            let mut f = [0.0; 6];
            contacts.add_forces(&u, &v, dt, &mut f, &mut work);
            let (pressed, dragged) = (-f[0], f[1]);
            assert!(pressed > 0.0 && dragged >= 0.0 && dragged <= friction * pressed * (1.0 + 1e-12));
            if dragged < 0.999 * friction * pressed {
                stuck += 1
            } else {
                slid += 1
            }
            assert!((f[0] + f[3]).abs() < 1e-15 && (f[1] + f[4]).abs() < 1e-15);
            // Both moments turn the same way and balance the couple of the drag.
            assert!((f[2] + f[5] - 0.02499 * dragged).abs() < 1e-12 * dragged, "{f:?}");
        }
        assert!(stuck > 10 && slid > 10, "{stuck} {slid}");
        let energy = contacts.energy();
        assert!(energy.friction > 0.0 && energy.damped == 0.0);
        // Let go, everything is forgotten.
        u[3] = 1e-3;
        contacts.add_forces(&u, &v, dt, &mut [0.0; 6], &mut work);
        assert_eq!((contacts.touching(), contacts.energy().stored), (0, 0.0));
    }
}

#[test]
fn there_is_no_force_at_a_distance_and_no_work_without_loss() {
    let network = spheres(Space::Plane, vec![Vec3::zeros(), Vec3::new(0.026, 0.0, 0.0)]);
    let mut contacts = Contacts::new(law(LINEAR, 0.9, 0.3), &network).unwrap();
    let (mut work, mut f) = (Work::default(), [0.0; 6]);
    // Overlapping by far, but neither has lost a bond.
    let closed = [0.0, 0.0, 0.0, -5e-3, 0.0, 0.0];
    contacts.add_forces(&closed, &[0.0; 6], 1e-4, &mut f, &mut work);
    assert_eq!((f, work.contact_checks), ([0.0; 6], 0));
    contacts.activate(1);
    for gap in [0.0, -9.9e-4] {
        contacts.add_forces(&[0.0, 0.0, 0.0, gap, 0.0, 0.0], &[0.0; 6], 1e-4, &mut f, &mut work);
        assert_eq!(f, [0.0; 6]);
    }
    assert!(work.contact_checks > 0);
    contacts.add_forces(&[0.0, 0.0, 0.0, -1.1e-3, 0.0, 0.0], &[0.0; 6], 1e-4, &mut f, &mut work);
    // k δ = 1e5 · 1e-4.
    assert!((f[3] - 10.0).abs() < 1e-9 && (f[0] + f[3]).abs() < 1e-12, "{f:?}");
}

/// Bonded particles overlap and do not press; once broken they press from their reference distance on, and never pull.
#[test]
fn a_broken_pair_presses_and_does_not_heal() {
    let mut network = spheres(Space::Plane, vec![Vec3::zeros(), Vec3::new(0.02, 0.0, 0.0)]);
    network.bonds = Bonds {
        ends: vec![[1, 0]],
        radius: vec![0.01],
        stiffness: vec![BondStiffness::default()],
        weight: vec![1.0],
    };
    let mut contacts = Contacts::new(law(LINEAR, 1.0, 0.0), &network).unwrap();
    let mut work = Work::default();
    let mut force = |contacts: &mut Contacts, gap: f64| {
        let mut f = [0.0; 6];
        contacts.add_forces(&[0.0, 0.0, 0.0, gap, 0.0, 0.0], &[0.0; 6], 1e-4, &mut f, &mut work);
        f[3]
    };
    contacts.activate(0);
    assert_eq!(force(&mut contacts, -1e-4), 0.0);
    contacts.bond_lost([0, 1]);
    assert_eq!(force(&mut contacts, 0.0), 0.0);
    assert!((force(&mut contacts, -1e-4) - 10.0).abs() < 1e-9);
    assert_eq!(force(&mut contacts, 1e-4), 0.0);
    assert_eq!(force(&mut contacts, 1e-3), 0.0);
}

/// An oblique, spinning, frictional collision: kinetic, stored and spent energies add up, better with smaller steps.
#[test]
fn energy_is_accounted_for() {
    for normal in [LINEAR, HERTZ] {
        let gap = |dt: f64| {
            let network = spheres(Space::Solid, vec![Vec3::zeros(), Vec3::new(0.0251, 0.0, 0.0)]);
            let mut run = Run::new(law(normal, 0.7, 0.3), network);
            (run.v[6], run.v[7], run.v[8], run.v[5]) = (-1.0, 0.8, -0.3, 20.0);
            let start = run.kinetic();
            let steps = (4e-2 / dt) as usize;
            (0..steps).for_each(|_| drop(run.step(dt)));
            let spent = run.contacts.energy();
            assert!(spent.friction > 0.02 * start && spent.damped > 0.02 * start, "{spent:?} of {start}");
            assert_eq!(spent.stored, 0.0);
            (run.kinetic() + spent.damped + spent.friction - start).abs() / start
        };
        let (coarse, fine) = (gap(2e-5), gap(5e-6));
        // First order: a quarter of the step, a quarter of the gap, give or take the step on which contact begins.
        assert!(coarse < 0.02 && fine < 0.4 * coarse, "{normal:?}: {coarse:e} {fine:e}");
    }
}

/// The grid finds the pairs that looking at all of them finds, while they move far.
#[test]
fn the_search_misses_nothing() {
    let side = 6;
    let position: Vec<Vec3> = (0..side * side * side)
        .map(|k| {
            let jitter = |s: f64| 0.004 * (s * k as f64).sin();
            let [x, y, z] = [k % side, k / side % side, k / side / side].map(|c| 0.026 * c as f64);
            Vec3::new(x + jitter(12.9), y + jitter(78.2), z + jitter(37.7))
        })
        .collect();
    let count = position.len();
    let mut run = Run::new(law(LINEAR, 1.0, 0.0), spheres(Space::Solid, position));
    (0..run.v.len()).filter(|i| i % 6 < 3).for_each(|i| run.v[i] = 2.0 * (3.7 * i as f64).sin());
    let mut most = 0;
    for _ in 0..400 {
        // As `step` will see them.
        let x = |p: usize| run.network.particles.position[p] + Vec3::from_fn(|c, _| run.u[6 * p + c]);
        let particles = &run.network.particles;
        let mut touching = 0;
        for i in 0..count {
            for j in i + 1..count {
                let reference = (particles.position[j] - particles.position[i]).norm();
                let reach = (particles.radius[i] + particles.radius[j]).min(reference);
                touching += usize::from((x(j) - x(i)).norm() < reach);
            }
        }
        run.step(2e-5);
        assert_eq!(run.contacts.touching(), touching);
        most = most.max(touching);
    }
    assert!(most > 50, "{most}");
    let all = (400 * count * (count - 1) / 2) as u64;
    assert!(run.work.contact_checks < all / 10, "{} of {all}", run.work.contact_checks);
}

#[test]
fn bad_constants_are_refused_by_name() {
    let network = spheres(Space::Plane, vec![Vec3::zeros()]);
    let refused = |law: ContactLaw, name: &str| {
        let error = Contacts::new(law, &network).unwrap_err().to_string();
        assert!(error.contains(name), "'{name}' is missing in: {error}");
    };
    for bad in [0.0, -1.0, f64::NAN] {
        refused(law(Normal::Linear { stiffness_n_m: bad }, 1.0, 0.0), "stiffness_N_m");
        refused(law(Normal::Hertz { young_pa: bad, poisson: 0.3 }, 1.0, 0.0), "young_Pa");
    }
    refused(law(Normal::Hertz { young_pa: 1.0, poisson: 0.6 }, 1.0, 0.0), "poisson");
    for bad in [0.1, 1.1, f64::NAN] {
        refused(law(LINEAR, bad, 0.0), "restitution");
    }
    for bad in [-0.1, f64::NAN] {
        refused(law(LINEAR, 1.0, bad), "friction");
        refused(ContactLaw { stiffness_ratio: bad, ..law(LINEAR, 1.0, 0.1) }, "stiffness_ratio");
    }
    let mut massless = network.clone();
    massless.particles.mass[0] = 0.0;
    let error = Contacts::new(law(LINEAR, 1.0, 0.0), &massless).unwrap_err().to_string();
    assert!(error.contains("particle 0 has mass"), "{error}");
}
