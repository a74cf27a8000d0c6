//! Elements replaced by particles: what is kept, what each mode costs, what is refused.

mod common;

use common::{YOUNG, continuum, cubic, prescribe};
use seam_solver::coupling::{Method, Multipliers};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, Bonding, bond_network};
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::calibration::stretched;
use seam_solver::dem::grid::Boundary;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::packing::{PackingRecipe, pack};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::State;
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::{Error, Result};
use seam_solver::fem::continuum::Continuum;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::fields::Mode;
use seam_solver::transfer::region::Region;
use seam_solver::transfer::substitution::{Switch, Switched, substitute};
use seam_solver::work::Work;
use std::collections::BTreeSet;

const ROWS: usize = 8;
const POISSON: f64 = 0.2;

/// Cantilever of length 9 and height 1, clamped at the left, with a transverse force of 10 N at its right end.
fn cantilever() -> Model {
    let mut body =
        continuum("beam", Space::Plane, Vec3::zeros(), Vec3::new(9.0, 1.0, 0.0), [9 * ROWS, ROWS, 0]);
    body.elasticity.poisson = POISSON;
    let end = body.mesh.boundary_nodes("right").unwrap();
    let parts = vec![Part::Continuum(body)];
    let mut model =
        Model { space: Space::Plane, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() };
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    for &point in &end {
        model.loads.push(PointValue { part: 0, point, component: 1, value: 10.0 / end.len() as f64 });
    }
    model
}

fn beam(model: &Model) -> &Continuum {
    match &model.parts[0] {
        Part::Continuum(body) => body,
        Part::Discrete { .. } => panic!("part 0 is of elements"),
    }
}

fn region(model: &Model, from: f64, to: f64) -> Region {
    let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let wanted = Block::new(Space::Plane, corner(from, 0.0), corner(to, 1.0)).unwrap();
    Region::in_box(beam(model), wanted).unwrap()
}

/// The triangular lattice that shows the beam's material.
fn triangular(block: Block, matter: Matter) -> Result<Network> {
    let kind = LatticeKind::Triangular;
    let l = lattice(kind, block, ROWS, matter)?;
    let target = Moduli { young_pa: YOUNG, poisson: POISSON };
    let spacing = 2.0 * l.arrangement.particles.radius[0];
    let found = stretched::calibrate(kind, spacing, l.stretch, matter, target, 0.3, &mut Work::default())?;
    let material = BondMaterial { young_pa: found.bond_young_pa, poisson: 0.3 };
    let section = Section::Uniform { ratio: found.radius_ratio };
    bond_network(&l.arrangement, &l.pairs, &BondRecipe { material, section, skin: Skin::Weighted })
}

fn packing(block: Block, matter: Matter) -> Result<Network> {
    let recipe = PackingRecipe {
        space: Space::Plane,
        block,
        boundary: Boundary::Closed,
        mean_radius_m: 0.06,
        solid_fraction: 0.84,
        radius_spread: 0.2,
        seed: 1,
    };
    let packed = pack(&recipe, matter)?;
    let pairs = Bonding::Coordination { z: 4.5 }.pairs(&packed.arrangement)?;
    // Bonds fill a thirtieth of the section: about the beam's modulus, not a calibration.
    let material = BondMaterial { young_pa: 60.0 * YOUNG, poisson: 0.3 };
    let section = Section::Uniform { ratio: 0.4 };
    bond_network(&packed.arrangement, &pairs, &BondRecipe { material, section, skin: Skin::Weighted })
}

fn switch<'a>(region: Region, fill: &'a dyn Fn(Block, Matter) -> Result<Network>, mode: Mode) -> Switch<'a> {
    Switch {
        part: 0,
        region,
        name: "middle".to_owned(),
        fill,
        method: Method::Pointwise,
        multipliers: Multipliers::Auto,
        rotations: false,
        mode,
        finite: false,
    }
}

fn at_rest(u: Vec<f64>) -> State {
    let n = u.len();
    State { u, ..State::at_rest(n) }
}

fn middle_switched(mode: Mode, fill: &dyn Fn(Block, Matter) -> Result<Network>) -> Switched {
    let model = cantilever();
    let u = statics::solve(&model).unwrap().u;
    let region = region(&model, 3.0, 6.0);
    substitute(&model, &at_rest(u), &switch(region, fill, mode), 1.0, &mut Work::default()).unwrap()
}

#[test]
fn displacement_alone_stores_tens_of_times_the_energy_and_rotations_cure_it() {
    let jump = |mode| middle_switched(mode, &triangular).report.strain_energy_jump();
    let (alone, turned) = (jump(Mode::Displacement), jump(Mode::Rotation));
    println!("strain energy jumps by {alone:.2} with displacement alone, {turned:.4} with rotations");
    // A trial with another material gave 31 and 0.7 %; the claim is a factor of tens and under 2 %.
    assert!(alone > 10.0, "{alone}");
    assert!(turned.abs() < 0.02, "{turned}");
    let relaxed = jump(Mode::ReEquilibrate);
    // On a calibrated lattice, after relaxation: under 1 %.
    assert!(relaxed.abs() < 0.01, "{relaxed}");
}

#[test]
fn relaxing_a_packing_frees_the_excess_energy_and_balances_the_forces() {
    let report = middle_switched(Mode::ReEquilibrate, &packing).report;
    // A disordered packing is no equilibrium under an affine field: excess energy that relaxation takes away.
    assert!(report.mapped.strain > 1.02 * report.after.strain, "{report:?}");
    assert!(report.after.unbalanced < 0.7 * report.mapped.unbalanced, "{report:?}");
}

/// A velocity field with all of spin, stretch and curvature, at a deformed state.
fn moving(model: &Model) -> State {
    let mut state = at_rest(vec![0.0; 2 * beam(model).mesh.nodes.len()]);
    for (node, x) in beam(model).mesh.nodes.iter().enumerate() {
        state.u[2 * node] = 1e-3 * x.x * x.y;
        state.u[2 * node + 1] = 1e-4 * x.x * x.x;
        state.v[2 * node] = 0.3 - 0.5 * x.y + 0.1 * x.x * x.y;
        state.v[2 * node + 1] = 0.2 * x.x * x.x - 0.7;
    }
    state
}

#[test]
fn momentum_and_mass_are_kept() {
    let model = cantilever();
    let state = moving(&model);
    let mut work = Work::default();
    let go = |mode: Mode, work: &mut Work| {
        let switch = switch(region(&model, 3.0, 6.0), &packing, mode);
        substitute(&model, &state, &switch, 0.0, work).unwrap()
    };
    let kept = go(Mode::Velocity, &mut work);
    assert!(kept.report.momentum_jump() < 1e-12, "{}", kept.report.momentum_jump());
    assert!(kept.report.angular_momentum_jump(9.0) < 1e-12, "{}", kept.report.angular_momentum_jump(9.0));
    // Without velocities the particles stand still, and the report says so.
    assert!(go(Mode::Rotation, &mut work).report.momentum_jump() > 0.1);
    let mass =
        |model: &Model| Semidiscrete::new(model, &mut Work::default()).unwrap().mass.iter().sum::<f64>();
    let free = |mut model: Model| {
        model.supports.clear();
        // Rotations have inertia, not mass: held out of the sum.
        for (part, body) in model.parts.iter().enumerate() {
            if matches!(body, Part::Discrete { .. }) {
                let points = 0..body.positions().len();
                model.supports.extend(points.map(|point| PointValue {
                    part,
                    point,
                    component: 2,
                    value: 0.0,
                }));
            }
        }
        model
    };
    let (before, after) = (mass(&free(model.clone())), mass(&free(kept.model)));
    // Sums of some hundred terms.
    assert!((after / before - 1.0).abs() < 1e-12, "{after} {before}");
}

#[test]
fn the_solid_keeps_momentum_too() {
    let body = continuum("bar", Space::Solid, Vec3::zeros(), Vec3::new(3.0, 1.0, 1.0), [6, 2, 2]);
    let mut state = at_rest(vec![0.0; 3 * body.mesh.nodes.len()]);
    for (node, x) in body.mesh.nodes.iter().enumerate() {
        let v = Vec3::new(0.3, -0.2, 0.4).cross(x) + Vec3::new(x.y * x.x, 0.2 - x.z * x.z, x.x);
        state.v[3 * node..3 * node + 3].copy_from_slice(v.as_slice());
    }
    let parts = vec![Part::Continuum(body)];
    let model =
        Model { space: Space::Solid, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() };
    let fill = |block: Block, _: Matter| Ok(cubic(Space::Solid, block.min, block.max, 4, Skin::Weighted));
    let wanted = Block::new(Space::Solid, Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 1.0)).unwrap();
    let region = Region::in_box(beam(&model), wanted).unwrap();
    let switch = switch(region, &fill, Mode::Velocity);
    let report = substitute(&model, &state, &switch, 0.0, &mut Work::default()).unwrap().report;
    assert!(report.momentum_jump() < 1e-12 && report.angular_momentum_jump(3.0) < 1e-12, "{report:?}");
}

/// Tip deflection of a model under its loads.
fn tip(model: &Model) -> f64 {
    let solution = statics::solve(model).unwrap();
    let end = |p: &Part| p.positions().iter().position(|x| (x - Vec3::new(9.0, 0.5, 0.0)).norm() < 1e-9);
    let (part, point) = (0..model.parts.len()).find_map(|k| Some((k, end(&model.parts[k])?))).unwrap();
    solution.displacement(model, part, point).y
}

#[test]
fn the_coupled_beam_bends_as_the_beam_of_elements() {
    let switched = middle_switched(Mode::Velocity, &triangular);
    let (coupled, elements) = (tip(&switched.model), tip(&cantilever()));
    // Eight rows of particles: below a per cent, as coupled from the start.
    assert!((coupled / elements - 1.0).abs() < 0.01, "{coupled} {elements}");
    assert_eq!(switched.model.ties.len(), 2);
    assert!(switched.report.after.gap < 1e-15, "nested faces: {}", switched.report.after.gap);
    let jump = |mode| middle_switched(mode, &triangular).report.reaction_jump();
    // Interpolated from elements, the lattice is off its equilibrium: shear at the faces comes from small kinks. Relaxed
    // inside the held interface it carries the force of the beam, to the lattice's accuracy.
    println!("interface force jumps by {} and, relaxed, {}", jump(Mode::Velocity), jump(Mode::ReEquilibrate));
    assert!(jump(Mode::ReEquilibrate) < 0.05);
}

#[test]
fn supports_and_loads_move_to_the_particles() {
    let model = cantilever();
    let elements = tip(&model);
    let u = at_rest(statics::solve(&model).unwrap().u);
    for (from, to) in [(0.0, 3.0), (6.0, 9.0), (0.0, 9.0)] {
        let switch = switch(region(&model, from, to), &triangular, Mode::Velocity);
        let switched = substitute(&model, &u, &switch, 1.0, &mut Work::default()).unwrap();
        let force: f64 = switched.model.loads.iter().map(|l| l.value).sum();
        assert!((force - 10.0).abs() < 1e-12, "{force}");
        let moved = tip(&switched.model);
        // Half weights on eight rows bend too stiffly by 2/n² = 3.1 % (see the skin); the rest is below a per cent.
        assert!((moved / elements - 1.0).abs() < 0.04, "{from}..{to}: {moved} {elements}");
    }
}

#[test]
fn a_load_keeps_its_moment_off_the_particles_too() {
    // Lattice rows of 1/7 under nodes at 1/8: no particle is at an inner node of the face.
    let seven = |block: Block, _: Matter| Ok(cubic(Space::Plane, block.min, block.max, 7, Skin::Weighted));
    let model = cantilever();
    let u = at_rest(vec![0.0; 2 * beam(&model).mesh.nodes.len()]);
    let mut loaded = model.clone();
    for load in &mut loaded.loads {
        load.component = 0;
        load.value *= 1.0 + load.point as f64;
    }
    let switched = substitute(
        &loaded,
        &u,
        &switch(region(&model, 6.0, 9.0), &seven, Mode::Velocity),
        1.0,
        &mut Work::default(),
    )
    .unwrap();
    let sums = |model: &Model| {
        let place = |l: &PointValue| model.parts[l.part].positions()[l.point];
        let force: f64 = model.loads.iter().map(|l| l.value).sum();
        (force, model.loads.iter().map(|l| l.value * place(l).y).sum::<f64>())
    };
    let ((force, moment), (old_force, old_moment)) = (sums(&switched.model), sums(&loaded));
    // A dozen shares per load, solved by singular values.
    assert!((force / old_force - 1.0).abs() < 1e-10 && (moment / old_moment - 1.0).abs() < 1e-10);
}

#[test]
fn a_region_grows_by_a_second_switch() {
    let model = cantilever();
    let u = at_rest(statics::solve(&model).unwrap().u);
    let mut work = Work::default();
    let first = switch(region(&model, 3.0, 4.5), &triangular, Mode::Velocity);
    let first = substitute(&model, &u, &first, 1.0, &mut work).unwrap();
    // Part 0 is the piece at the clamp; the one at the tip holds the next 1.5 m.
    let Part::Continuum(right) = &first.model.parts[1] else { panic!("the right piece is of elements") };
    let wanted = Block::new(Space::Plane, Vec3::new(4.5, 0.0, 0.0), Vec3::new(6.0, 1.0, 0.0)).unwrap();
    let region = Region::in_box(right, wanted).unwrap();
    let second = Switch { part: 1, name: "more".to_owned(), ..switch(region, &triangular, Mode::Velocity) };
    let grown = substitute(&first.model, &first.state, &second, 1.0, &mut work).unwrap();
    let names: Vec<&str> = grown.model.parts.iter().map(Part::name).collect();
    assert_eq!(names, ["beam", "beam.middle", "middle", "more"]);
    assert_eq!(grown.model.ties.len(), 3, "{:?}", grown.model.ties);
    assert!(grown.report.momentum_jump() < 1e-12);
    let (in_two, in_one) = (tip(&grown.model), tip(&middle_switched(Mode::Velocity, &triangular).model));
    // Both are within a per cent of the elements; cells of the halves are stretched a little otherwise.
    assert!((in_two / in_one - 1.0).abs() < 5e-3, "{in_two} {in_one}");
    assert!(grown.report.after.gap < 1e-5 * 1e-3, "{}", grown.report.after.gap);
}

#[test]
fn what_does_not_fit_is_refused() {
    let model = cantilever();
    let u = at_rest(vec![0.0; 2 * beam(&model).mesh.nodes.len()]);
    let message = |model: &Model, switch: Switch| {
        let error = substitute(model, &u, &switch, 1.0, &mut Work::default()).map(|_| ()).unwrap_err();
        assert!(matches!(error, Error::Switch { .. }), "{error:?}");
        error.to_string()
    };
    let sound = || switch(region(&model, 3.0, 6.0), &triangular, Mode::Velocity);
    assert!(message(&model, Switch { part: 5, ..sound() }).contains("not made of elements"));
    assert!(message(&model, Switch { name: "beam".to_owned(), ..sound() }).contains("name of its own"));
    let half = |block: Block, matter: Matter| {
        triangular(Block { max: Vec3::new(block.max.x, 0.5, 0.0), ..block }, matter)
    };
    assert!(message(&model, Switch { fill: &half, ..sound() }).contains("fill the whole box"));
    let mut pinned = model.clone();
    pinned.supports.push(PointValue { part: 0, point: 4 * (9 * ROWS + 1) + 36, component: 0, value: 0.0 });
    let off = |block: Block, _: Matter| Ok(cubic(Space::Plane, block.min, block.max, 7, Skin::Weighted));
    assert!(message(&pinned, Switch { fill: &off, ..sound() }).contains("take over the support"));
    let nowhere = Block::new(Space::Plane, Vec3::new(20.0, 0.0, 0.0), Vec3::new(21.0, 1.0, 0.0)).unwrap();
    let empty = Region::in_box(beam(&model), nowhere).unwrap_err();
    assert!(empty.to_string().contains("no element"), "{empty}");
    let none = Region::covering(beam(&model), &BTreeSet::new()).unwrap_err();
    assert!(none.to_string().contains("no elements"), "{none}");
}

/// The ramp: load over four first periods, switch at half of it; largest deflection error afterwards over the largest deflection.
fn ramp_error(mode: Mode) -> f64 {
    let model = cantilever();
    let mut work = Work::default();
    // First bending period of the beam: (βL)² = 3.516, ρ = 1.
    let period = 2.0 * std::f64::consts::PI / (3.516 * (YOUNG / 12.0).sqrt() / 81.0);
    let (steps, end) = (400, 4.0 * period);
    let step = end / steps as f64;
    let factor = |k: usize| (k as f64 / steps as f64).min(1.0);
    let run = |model: &Model, from: State, first: usize, last: usize, work: &mut Work| {
        let system = Semidiscrete::new(model, work).unwrap();
        let begin = system.motion(&from);
        let (mut motion, _) =
            start(&system, (begin.u, begin.v), from.time, factor(first), 0.0, work).unwrap();
        let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work).unwrap();
        let mut tips = Vec::new();
        for k in first..last {
            newmark.step(&mut motion, [factor(k), factor(k + 1)], work).unwrap();
            tips.push(tip_of(model, &system.state(&motion)));
        }
        (system.state(&motion), tips)
    };
    let rest = at_rest(vec![0.0; 2 * beam(&model).mesh.nodes.len()]);
    let (half_way, _) = run(&model, rest, 0, steps / 2, &mut work);
    let (_, reference) = run(&model, half_way.clone(), steps / 2, steps, &mut work);
    let chosen = switch(region(&model, 3.0, 6.0), &triangular, mode);
    let switched = substitute(&model, &half_way, &chosen, 0.5, &mut work).unwrap();
    let (_, coupled) = run(&switched.model, switched.state, steps / 2, steps, &mut work);
    let largest = reference.iter().fold(0.0f64, |m, r| m.max(r.abs()));
    reference.iter().zip(&coupled).fold(0.0f64, |m, (r, c)| m.max((c - r).abs())) / largest
}

fn tip_of(model: &Model, state: &State) -> f64 {
    let numbering = seam_solver::model::Numbering::new(model);
    let end = |p: &Part| p.positions().iter().position(|x| (x - Vec3::new(9.0, 0.5, 0.0)).norm() < 1e-9);
    let (part, point) = (0..model.parts.len()).find_map(|k| Some((k, end(&model.parts[k])?))).unwrap();
    state.u[numbering.unknown(part, point, 1)]
}

#[test]
fn the_ramp_goes_on_after_the_switch() {
    let modes = [Mode::Displacement, Mode::Rotation, Mode::Velocity, Mode::ReEquilibrate];
    let errors = modes.map(ramp_error);
    println!("tip error on the ramp, 202 particles: {errors:?}");
    let [alone, _, velocity, relaxed] = errors;
    // Trials gave 1.1 % with displacement alone and 0.6 % with rotation and velocity at 202 particles.
    assert!(velocity < 0.01 && relaxed < 0.01, "{errors:?}");
    assert!(alone > velocity, "{errors:?}");
}
