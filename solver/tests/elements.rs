//! Every element with every formulation: rigid motions, hourglasses, symmetry, patch tests.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3};
use proptest::prelude::*;
use seam_solver::error::Error;
use seam_solver::fem::assembly::for_each_stiffness;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::loads::{body_loads, facet_loads, lumped_mass};
use seam_solver::fem::mesh::Mesh;
use seam_solver::fem::norms::error_norms;
use seam_solver::fem::stress::{nodal_stress, stress_at};
use seam_solver::fem::structured::{even, grid, jiggle};
use seam_solver::space::{Space, Vec3};

const PLATE: Hypothesis = Hypothesis::PlaneStress { thickness_m: 0.5 };
const SLICE: Hypothesis = Hypothesis::PlaneStrain { thickness_m: 2.0 };

/// All pairs that exist.
fn pairs() -> Vec<(Hypothesis, Formulation)> {
    use Formulation::{BBar, Incompatible, Plain};
    let mut pairs = vec![(PLATE, Plain), (PLATE, Incompatible)];
    for hypothesis in [SLICE, Hypothesis::Solid] {
        pairs.extend([Plain, Incompatible, BBar].map(|f| (hypothesis, f)));
    }
    pairs
}

fn body(mesh: Mesh, (hypothesis, formulation): (Hypothesis, Formulation)) -> Continuum {
    let elasticity = Elasticity { young_pa: 3.0, poisson: 0.3, density: 2.0 };
    Continuum { name: "b".into(), mesh, elasticity, hypothesis, formulation }
}

/// A box of 2 × 1 (× 1.5) metres, `n` cells a side, interior nodes moved at random.
fn distorted(space: Space, n: usize, seed: u64) -> Mesh {
    let axes: Vec<Vec<f64>> =
        [2.0, 1.0, 1.5][..space.dim()].iter().map(|&length| even(0.0, length, n).unwrap()).collect();
    let mut mesh = grid(&axes).unwrap();
    jiggle(&mut mesh, 0.25, seed);
    mesh
}

/// One distorted cell.
fn one_cell(space: Space) -> Mesh {
    let mut mesh = grid(&vec![vec![0.0, 1.0]; space.dim()]).unwrap();
    for (n, x) in mesh.nodes.iter_mut().enumerate() {
        let shift = |i: usize| 0.2 * ((3 * n + 5 * i) as f64).sin();
        *x += Vec3::from_fn(|i, _| if i < space.dim() { shift(i) } else { 0.0 });
    }
    mesh
}

fn dense_stiffness(body: &Continuum) -> DMatrix<f64> {
    let mut k = DMatrix::zeros(body.dof_count(), body.dof_count());
    for_each_stiffness(body, |dofs, ke| {
        for (r, &i) in dofs.iter().enumerate() {
            for (c, &j) in dofs.iter().enumerate() {
                k[(i, j)] += ke[r * dofs.len() + c];
            }
        }
    })
    .unwrap();
    k
}

/// Degrees of freedom of a field at the nodes.
fn interpolate(mesh: &Mesh, field: impl Fn(Vec3) -> Vec3) -> DVector<f64> {
    let dim = mesh.space.dim();
    let values: Vec<Vec3> = mesh.nodes.iter().map(|&x| field(x)).collect();
    DVector::from_fn(values.len() * dim, |dof, _| values[dof / dim][dof % dim])
}

/// Solves with the nodes of the whole boundary held at `prescribed`, loads zero.
fn solve_interior(body: &Continuum, prescribed: &DVector<f64>) -> DVector<f64> {
    let mesh = &body.mesh;
    let dim = mesh.space.dim();
    let mut held = vec![false; body.dof_count()];
    for name in mesh.boundaries.keys() {
        for node in mesh.boundary_nodes(name).unwrap() {
            held[node * dim..(node + 1) * dim].fill(true);
        }
    }
    let free: Vec<usize> = (0..held.len()).filter(|&d| !held[d]).collect();
    let k = dense_stiffness(body);
    let rhs = DVector::from_fn(free.len(), |r, _| {
        -(0..held.len()).filter(|&d| held[d]).map(|d| k[(free[r], d)] * prescribed[d]).sum::<f64>()
    });
    let kff = DMatrix::from_fn(free.len(), free.len(), |r, c| k[(free[r], free[c])]);
    let solution = kff.cholesky().unwrap().solve(&rhs);
    let mut u = prescribed.clone();
    for (r, &d) in free.iter().enumerate() {
        u[d] = solution[r];
    }
    u
}

#[test]
fn stiffness_is_symmetric_with_rigid_motions_and_nothing_else_free() {
    for pair in pairs() {
        let k = dense_stiffness(&body(one_cell(pair.0.space()), pair));
        assert_eq!(k, k.transpose(), "{pair:?}");
        let mut eigenvalues: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
        eigenvalues.sort_by(f64::total_cmp);
        let largest = eigenvalues[eigenvalues.len() - 1];
        let rigid = if pair.0.space() == Space::Plane { 3 } else { 6 };
        // Rounding leaves 1e-16, the softest deformation is of order 1e-2 of the stiffest.
        let zeros = eigenvalues.iter().filter(|v| v.abs() < 1e-12 * largest).count();
        assert_eq!(zeros, rigid, "{pair:?}: {eigenvalues:?}");
        assert!(eigenvalues[rigid] > 1e-4 * largest, "{pair:?}: {eigenvalues:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn rigid_motions_store_no_energy(
        seed in 0u64..1000,
        shift in prop::array::uniform3(-10.0..10.0f64),
        turn in prop::array::uniform3(-1.0..1.0f64),
    ) {
        for pair in pairs() {
            let space = pair.0.space();
            let body = body(distorted(space, 2, seed), pair);
            let turn = match space {
                Space::Plane => Vec3::new(0.0, 0.0, turn[2]),
                Space::Solid => Vec3::from(turn),
            };
            let q = interpolate(&body.mesh, |x| Vec3::from(shift) + turn.cross(&x));
            let k = dense_stiffness(&body);
            // Forces of rounding only: n·ulp·‖K‖‖q‖.
            prop_assert!((&k * &q).amax() <= 1e-13 * k.amax() * q.amax().max(1.0), "{pair:?}");
        }
    }
}

/// Irons' patch test: a linear field on the boundary of a distorted mesh has to come out exactly
/// inside, displacement, stress and energy alike.
#[test]
fn patch_tests_hold_on_distorted_meshes() {
    for pair in pairs() {
        let space = pair.0.space();
        let body = body(distorted(space, 4, 11), pair);
        let mut slope = Matrix3::new(1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, -0.1, 0.8);
        if space == Space::Plane {
            slope.fill_row(2, 0.0);
            slope.fill_column(2, 0.0);
        }
        let field = |x: Vec3| Vec3::new(0.1, -0.2, 0.0) + slope * x;
        let exact = interpolate(&body.mesh, field);
        let u = solve_interior(&body, &exact);
        // Condition number of these meshes is below 1e3; the issue asks for 1e-10.
        assert!((&u - &exact).amax() < 1e-12, "{pair:?}: displacement");
        let (error, size) = error_norms(&body, u.as_slice(), |x| (field(x), slope)).unwrap();
        assert!(error.l2 < 1e-12 * size.l2 && error.h1 < 1e-12 * size.h1, "{pair:?}: {error:?}");
        assert!(error.energy < 1e-12 * size.energy, "{pair:?}: {error:?}");

        let strain = [
            slope[(0, 0)],
            slope[(1, 1)],
            slope[(2, 2)],
            slope[(0, 1)] + slope[(1, 0)],
            slope[(1, 2)] + slope[(2, 1)],
            slope[(2, 0)] + slope[(0, 2)],
        ];
        let stress = body.elasticity.stiffness(pair.0) * nalgebra::Vector6::from(strain);
        let at_points = stress_at(&body, u.as_slice(), 5, &[[0.3, -0.9, 0.5], [0.0; 3]]).unwrap();
        for computed in at_points.into_iter().chain(nodal_stress(&body, u.as_slice()).unwrap()) {
            for i in 0..6 {
                assert!((computed.voigt[i] - stress[i]).abs() < 1e-11, "{pair:?}: {computed:?}");
            }
        }
    }
}

/// Energy and forces must not depend on the frame.
#[test]
fn stiffness_turns_with_the_element() {
    for pair in pairs() {
        let space = pair.0.space();
        let turn = match space {
            Space::Plane => Rotation3::from_axis_angle(&Vec3::z_axis(), 0.7),
            Space::Solid => Rotation3::from_euler_angles(0.4, -0.8, 1.1),
        };
        let mesh = one_cell(space);
        let mut turned = mesh.clone();
        turned.nodes.iter_mut().for_each(|x| *x = turn * *x);
        let field = |x: Vec3| Vec3::new(x.x * x.y, (1.3 * x.x).sin() - x.y, 0.0);
        let q = interpolate(&mesh, field);
        let q_turned = interpolate(&turned, |x| turn * field(turn.inverse() * x));
        let energy = q.dot(&(dense_stiffness(&body(mesh, pair)) * &q));
        let turned_energy = q_turned.dot(&(dense_stiffness(&body(turned, pair)) * &q_turned));
        assert!((energy / turned_energy - 1.0).abs() < 1e-13, "{pair:?}: {energy} {turned_energy}");
    }
}

/// One row of cells in pure bending: incompatible modes give the beam's curvature on rectangles
/// exactly, plain elements lock by the textbook factor (Cook et al. 2002, §3.6).
#[test]
fn incompatible_modes_bend_and_plain_ones_lock() {
    let (length, height) = (4.0, 1.0);
    let energy = |formulation| {
        let mut continuum =
            body(grid(&[vec![0.0, length], vec![0.0, height]]).unwrap(), (PLATE, formulation));
        continuum.elasticity.poisson = 0.0;
        // Hourglass displacement of curvature one: u = −y'x'.
        let q = interpolate(&continuum.mesh, |x| Vec3::new(-(x.x - 2.0) * (x.y - 0.5), 0.0, 0.0));
        q.dot(&(dense_stiffness(&continuum) * &q))
    };
    // EI κ² L with E = 3, thickness 0.5.
    let exact = 3.0 * 0.5 / 12.0 * length;
    assert!((energy(Formulation::Incompatible) / exact - 1.0).abs() < 1e-14);
    // ν = 0: the parasitic shear adds ½ (a/b)² of the aspect ratio.
    let locked = 1.0 + 0.5 * (length / height).powi(2);
    assert!((energy(Formulation::Plain) / exact / locked - 1.0).abs() < 1e-14);
}

/// The recovered strain, modes included, stores the energy of the stiffness matrix: on a box the
/// strain is linear in each coordinate, so two and four Gauss points integrate alike.
#[test]
fn recovered_strain_stores_the_energy_of_the_stiffness() {
    for pair in pairs() {
        let dim = pair.0.space().dim();
        let body = body(grid(&vec![vec![0.0, 0.7, 1.5]; dim]).unwrap(), pair);
        let q = interpolate(&body.mesh, |x| {
            Vec3::new((3.0 * x.x + 7.0 * x.y).sin(), (5.0 * x.y + x.x * x.z).cos(), (4.0 * x.x).sin())
        });
        let energy = q.dot(&(dense_stiffness(&body) * &q));
        let (recovered, _) = error_norms(&body, q.as_slice(), |_| (Vec3::zeros(), Matrix3::zeros())).unwrap();
        assert!((recovered.energy.powi(2) / energy - 1.0).abs() < 1e-13, "{pair:?}");
    }
}

/// `σ_xx = −E κ y` at the corners of a cell bent with curvature κ = 1.
#[test]
fn nodal_stress_is_extrapolated_to_the_corners() {
    let body = body(grid(&[vec![0.0, 4.0], vec![-0.5, 0.5]]).unwrap(), (PLATE, Formulation::Incompatible));
    let q = interpolate(&body.mesh, |x| Vec3::new(-(x.x - 2.0) * x.y, 0.0, 0.0));
    for (x, stress) in body.mesh.nodes.iter().zip(nodal_stress(&body, q.as_slice()).unwrap()) {
        assert!((stress.voigt[0] + 3.0 * x.y).abs() < 1e-14, "{stress:?}");
        // The modes relieve the transverse stress that ν would cause.
        assert!(stress.voigt[1].abs() < 1e-14);
    }
}

/// Near incompressibility: a volume-preserving hourglass costs energy of order μ with B-bar, of order λ without.
#[test]
fn b_bar_does_not_lock_by_volume() {
    for hypothesis in [SLICE, Hypothesis::Solid] {
        let energy = |formulation| {
            let mesh = grid(&vec![vec![-1.0, 1.0]; hypothesis.space().dim()]).unwrap();
            let mut continuum = body(mesh, (hypothesis, formulation));
            continuum.elasticity.poisson = 0.4999;
            let q = interpolate(&continuum.mesh, |x| Vec3::new(x.x * x.y, 0.0, 0.0));
            q.dot(&(dense_stiffness(&continuum) * &q)) / continuum.elasticity.shear_pa()
        };
        // λ/μ is 5000 here; without the mean the mode stores a good share of it.
        assert!(energy(Formulation::Plain) > 1000.0, "{}", energy(Formulation::Plain));
        assert!(energy(Formulation::BBar) < 20.0, "{}", energy(Formulation::BBar));
    }
}

#[test]
fn loads_carry_their_resultants() {
    for pair in [(PLATE, Formulation::Plain), (Hypothesis::Solid, Formulation::Plain)] {
        let space = pair.0.space();
        let dim = space.dim();
        let body = body(distorted(space, 3, 4), pair);
        let depth = if space == Space::Plane { 0.5 } else { 1.5 };
        // Shear 1 − y² on the right face at x = 2: resultant ⅔ of the depth, lever 2.
        let loads = facet_loads(&body, &body.mesh.boundaries["right"], |x, normal| {
            assert!((normal - Vec3::x()).norm() < 1e-14);
            Vec3::new(0.0, 1.0 - x.y * x.y, 0.0)
        })
        .unwrap();
        let on_right = body.mesh.boundary_nodes("right").unwrap();
        assert!(loads.iter().all(|(dof, _)| on_right.contains(&(dof / dim))));
        let (force, moment) = loads
            .iter()
            .filter(|(dof, _)| dof % dim == 1)
            .fold((0.0, 0.0), |sum, (dof, f)| (sum.0 + f, sum.1 + f * body.mesh.nodes[dof / dim].x));
        assert!((force / (2.0 / 3.0 * depth) - 1.0).abs() < 1e-14, "{force}");
        assert!((moment / force - 2.0).abs() < 1e-13);

        let weight = body_loads(&body, |_| Vec3::new(0.0, -9.81, 0.0)).unwrap();
        let mass = lumped_mass(&body).unwrap();
        assert!((mass.iter().sum::<f64>() / (2.0 * 2.0 * depth) - 1.0).abs() < 1e-13);
        assert!(mass.iter().all(|&m| m > 0.0));
        let down: f64 = weight.iter().map(|(_, f)| f).sum();
        assert!((down / (-9.81 * 2.0 * depth) - 1.0).abs() < 1e-13);
        assert!(facet_loads(&body, &body.mesh.boundaries["top"], |_, _| Vec3::repeat(f64::NAN)).is_err());
    }
}

#[test]
fn bad_bodies_are_refused_with_their_place() {
    let sound = || body(distorted(Space::Plane, 2, 1), (PLATE, Formulation::Plain));
    let refuse = |body: Continuum| for_each_stiffness(&body, |_, _| {}).unwrap_err();

    let mut inverted = sound();
    inverted.mesh.cells.swap(5, 6);
    let Error::InvertedElement { element: 1, .. } = refuse(inverted) else { panic!("expected element 1") };
    let mut flat = sound();
    flat.mesh.nodes.iter_mut().for_each(|x| x.y = 0.0);
    assert!(matches!(refuse(flat), Error::InvertedElement { element: 0, .. }));
    assert!(matches!(
        refuse(Continuum { formulation: Formulation::BBar, ..sound() }),
        Error::Formulation { .. }
    ));
    assert!(matches!(refuse(Continuum { hypothesis: Hypothesis::Solid, ..sound() }), Error::Geometry { .. }));
    let mut foreign = sound();
    foreign.mesh.cells[3] = 99;
    assert!(refuse(foreign).to_string().contains("cell 0 uses node 99"));
    let mut nan = sound();
    nan.mesh.nodes[4].x = f64::NAN;
    assert!(refuse(nan).to_string().contains("node 4 is not finite"));
    let mut soft = sound();
    soft.elasticity.young_pa = -1.0;
    assert!(matches!(refuse(soft), Error::Material { name: "young_pa", .. }));
    let mut detached = sound();
    detached.mesh.boundaries.get_mut("left").unwrap()[0].cell = 1;
    assert!(refuse(detached).to_string().contains("boundary 'left'"));
}
