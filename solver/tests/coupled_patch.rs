//! Coupled patch tests: a uniform strain passes FE | DE | FE unchanged.
//!
//! Exact (1e-10 of the largest displacement: rounding times the condition of the system) for weighted
//! square and simple cubic lattices, on nested faces with pointwise ties and on any faces with mortar ties.

mod common;

use common::{Sandwich, prescribe};
use seam_solver::coupling::{Method, Multipliers};
use seam_solver::dem::skin::Skin;
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};

/// Largest deviation from the field over the largest displacement.
fn patch_error(sandwich: &Sandwich, shear: bool) -> f64 {
    let mut model = sandwich.model();
    let field =
        |x: &Vec3| if shear { Vec3::new(1e-3 * x.y, 0.0, 0.0) } else { Vec3::new(1e-3 * x.x, 0.0, 0.0) };
    let solid = sandwich.space == Space::Solid;
    let end = |x: &Vec3| x.x < 1e-9 || x.x > 3.0 - 1e-9;
    // Shear needs its tractions on the sides too; there the displacements are given instead.
    let side = move |x: &Vec3| {
        let lateral = |c: f64| !(1e-9..=1.0 - 1e-9).contains(&c);
        lateral(x.y) || (solid && lateral(x.z))
    };
    prescribe(&mut model, move |x| end(x) || (shear && side(x)), field);
    let solution = statics::solve(&model).expect("the patch is well posed");
    let mut worst = 0.0f64;
    for (p, part) in model.parts.iter().enumerate() {
        for (i, x) in part.positions().iter().enumerate() {
            worst = worst.max((solution.displacement(&model, p, i) - field(x)).amax());
        }
    }
    worst / if shear { 1e-3 } else { 3e-3 }
}

const EXACT: f64 = 1e-10;

#[test]
fn pointwise_ties_pass_on_nested_faces() {
    for sandwich in [
        Sandwich::plane(4, 4, 2, Method::Pointwise),
        Sandwich::plane(1, 6, 3, Method::Pointwise),
        Sandwich::solid(2, 4, 4, Method::Pointwise),
        Sandwich { rotations: true, ..Sandwich::plane(2, 4, 4, Method::Pointwise) },
        Sandwich { rotations: true, ..Sandwich::solid(2, 4, 1, Method::Pointwise) },
    ] {
        for shear in [false, true] {
            let error = patch_error(&sandwich, shear);
            assert!(error < EXACT, "{:?}, shear {shear}: {error:.1e}", sandwich.space);
        }
    }
}

#[test]
fn mortar_ties_pass_on_any_faces() {
    for multipliers in [Multipliers::Auto, Multipliers::First, Multipliers::Second] {
        for rotations in [false, true] {
            for (left, rows, right) in [(3, 4, 5), (8, 5, 1)] {
                let plane =
                    Sandwich { multipliers, rotations, ..Sandwich::plane(left, rows, right, Method::Mortar) };
                for shear in [false, true] {
                    let error = patch_error(&plane, shear);
                    assert!(
                        error < EXACT,
                        "plane {left}|{rows}|{right} {multipliers:?} shear {shear}: {error:.1e}"
                    );
                }
            }
            let solid = Sandwich { multipliers, rotations, ..Sandwich::solid(2, 3, 4, Method::Mortar) };
            for shear in [false, true] {
                let error = patch_error(&solid, shear);
                assert!(
                    error < EXACT,
                    "solid {multipliers:?} rotations {rotations} shear {shear}: {error:.1e}"
                );
            }
        }
    }
}

/// The checks above can fail: other faces, or a skin at full stiffness, break the patch visibly.
#[test]
fn the_patch_test_sees_pointwise_mismatch_and_full_skin() {
    assert!(patch_error(&Sandwich::plane(4, 6, 8, Method::Pointwise), false) > 1e-6);
    let full = Sandwich { skin: Skin::Full, ..Sandwich::plane(4, 4, 4, Method::Pointwise) };
    assert!(patch_error(&full, false) > 1e-6);
}
