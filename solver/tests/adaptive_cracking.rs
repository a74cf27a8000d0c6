//! A beam of elements that cracks: particles come where the stress asks for them, and grow ahead of the crack.

mod common;

use common::{continuum, cubic};
use seam_solver::coupling::{Method, Multipliers};
use seam_solver::cracking::adaptive::{Adaptive, Filled, Growth};
use seam_solver::cracking::{Options, Outcome, Stop};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::network::Network;
use seam_solver::dem::skin::Skin;
use seam_solver::error::Result;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::strength::Strength;
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::criterion::{Criterion, Indicator, Memory};

const LENGTH: f64 = 12.0;
const HEIGHT: f64 = 3.0;
/// Spacing of the particles; elements are twice as long.
const SPACING: f64 = 0.25;
/// Mean stress of a section at which its bonds break, in Pa. Bonds are half as thick again as their facets, so they see less.
const STRENGTH: f64 = 1e4;

fn high() -> Vec3 {
    Vec3::new(LENGTH, HEIGHT, 0.0)
}

/// Bonds break in tension within half a height of mid-span and below the load.
fn law(network: &Network) -> Result<Failure> {
    let x = &network.particles.position;
    let middle = |&[i, j]: &[usize; 2]| 0.5 * (x[i] + x[j]);
    let breakable = |e: &[usize; 2]| (middle(e).x - 0.5 * LENGTH).abs() < 0.5 * HEIGHT && middle(e).y < 2.6;
    let breakable: Vec<bool> = network.bonds.ends.iter().map(breakable).collect();
    let facets = vec![SPACING * 0.5; network.bonds.len()];
    let strength = Strength::Stress { strength_pa: STRENGTH };
    let law = FailureLaw::BondStress(BondStress::Normal { tensile: strength });
    let place = Place { network, body: "zone", breakable: Some(&breakable), area_m2: Some(&facets) };
    Failure::new(&FailureRecipe { law, weibull: None }, &place)
}

fn fill(block: Block, _: Matter) -> Result<Filled> {
    let rows = (block.sides().y / SPACING).round() as usize;
    let network = cubic(Space::Plane, block.min, block.max, rows, Skin::Weighted);
    let failure = Some(law(&network)?);
    Ok(Filled { network, failure })
}

/// Three-point bend: a unit load on top, at mid-span.
fn bend(part: Part) -> Model {
    let at = |x: f64, y: f64| {
        let target = Vec3::new(x, y, 0.0);
        part.positions().iter().position(|p| (p - target).norm() < 1e-9).unwrap()
    };
    let value = |point: usize, component: usize, value: f64| PointValue { part: 0, point, component, value };
    let supports =
        vec![value(at(0.0, 0.0), 0, 0.0), value(at(0.0, 0.0), 1, 0.0), value(at(LENGTH, 0.0), 1, 0.0)];
    let loads = vec![value(at(0.5 * LENGTH, HEIGHT), 1, -1.0)];
    Model { space: Space::Plane, parts: vec![part], ties: Vec::new(), supports, loads }
}

fn elements() -> Model {
    bend(Part::Continuum(continuum("beam", Space::Plane, Vec3::zeros(), high(), [24, 6, 0])))
}

fn particles() -> (Model, Vec<(usize, Failure)>) {
    let network = cubic(Space::Plane, Vec3::zeros(), high(), 12, Skin::Weighted);
    let failure = law(&network).unwrap();
    (bend(Part::Discrete { name: "beam".to_owned(), network }), vec![(0, failure)])
}

fn growth(fill: &dyn Fn(Block, Matter) -> Result<Filled>) -> Growth<'_> {
    let indicator = Indicator::Stress { strength_pa: Some(STRENGTH), length_m: 2.0 * SPACING };
    Growth {
        name: "zone".to_owned(),
        body: "beam".to_owned(),
        criterion: Criterion { indicator, trigger: 0.5, buffer_m: 0.8, memory: Memory::Irreversible },
        stride_m: 0.0,
        holds: None,
        through: [false; 3],
        most: 20,
        fill,
        method: Method::Mortar,
        multipliers: Multipliers::Auto,
        rotations: true,
    }
}

fn options() -> Options {
    Options { least_stiffness: 0.05, ..Options::default() }
}

fn broken(outcome: &Outcome) -> Vec<Vec3> {
    outcome.events.iter().flat_map(|e| e.places.iter().copied()).collect()
}

/// Largest distance of a place of one set from the nearest of the other.
fn apart(a: &[Vec3], b: &[Vec3]) -> f64 {
    let one = |a: &[Vec3], b: &[Vec3]| {
        let nearest = |x: &Vec3| b.iter().map(|y| (x - y).norm()).fold(f64::INFINITY, f64::min);
        a.iter().map(nearest).fold(0.0, f64::max)
    };
    one(a, b).max(one(b, a))
}

#[test]
fn the_adaptive_path_is_that_of_particles_everywhere() {
    let (model, laws) = particles();
    let (whole, none) = Adaptive::new(&model, laws, None, options()).unwrap().run().unwrap();
    assert!(none.is_empty() && matches!(whole.stop, Stop::StiffnessLimit { .. }), "{:?}", whole.stop);
    let (outcome, grown) =
        Adaptive::new(&elements(), Vec::new(), Some(growth(&fill)), options()).unwrap().run().unwrap();
    assert!(matches!(outcome.stop, Stop::StiffnessLimit { .. }), "{:?}", outcome.stop);
    let ([_, peak], [_, reference]) = (outcome.peak().unwrap(), whole.peak().unwrap());
    assert!((peak / reference - 1.0).abs() < 0.02, "{peak} {reference}");
    let distance = apart(&broken(&outcome), &broken(&whole));
    assert!(distance <= 2.0 * SPACING, "{distance}");
    // It grew while it cracked, upwards, and never shrank.
    assert!(grown.len() > 1 && grown.iter().any(|g| g.exchange.after_events > 0), "{grown:?}");
    for pair in grown.windows(2) {
        assert_eq!(pair[1].block.around(&pair[0].block), pair[1].block);
        assert!(pair[1].particles > pair[0].particles);
    }
    // What changes at held displacement is the difference of two discretisations of the same body: small while it is whole, and as
    // large as the error of two coarse elements in what is left of the section later.
    for g in &grown {
        let most = if g.exchange.after_events == 0 { 0.01 } else { 0.1 };
        assert!(g.exchange.jump().abs() < most, "{g:?}");
    }
    assert!(outcome.energies().transfer != 0.0 && outcome.energies().closure() < 1e-10);
    for event in &outcome.events {
        let gap = event.energy_released - event.fracture_energy - event.radiated_energy;
        assert!(gap.abs() <= 1e-10 * 0.5 * event.force * event.displacement, "{event:?}");
    }
}

/// A stride lets the region grow less often, and the crack is the same.
#[test]
fn a_region_with_a_stride_grows_less_often() {
    let run = |stride_m: f64| {
        let growth = Growth { stride_m, ..growth(&fill) };
        Adaptive::new(&elements(), Vec::new(), Some(growth), options()).unwrap().run().unwrap()
    };
    let ((step, often), (stride, seldom)) = (run(0.0), run(1.0));
    assert!(seldom.len() < often.len(), "{} {}", seldom.len(), often.len());
    let ([_, peak], [_, reference]) = (stride.peak().unwrap(), step.peak().unwrap());
    assert!((peak / reference - 1.0).abs() < 0.02, "{peak} {reference}");
    let distance = apart(&broken(&stride), &broken(&step));
    assert!(distance <= 2.0 * SPACING, "{distance}");
    let refused = Growth { stride_m: -1.0, ..growth(&fill) };
    let error = Adaptive::new(&elements(), Vec::new(), Some(refused), options()).err().unwrap();
    assert!(error.to_string().contains("stride_m"), "{error}");
}

/// Bonds that broke before the region grew are broken after it, at the same places.
#[test]
fn cracks_stay_when_the_region_grows() {
    let mut path = Adaptive::new(&elements(), Vec::new(), Some(growth(&fill)), options()).unwrap();
    let mut before = 0;
    while path.advance().unwrap().is_some() {
        let (part, failure) = &path.cracking().laws()[0];
        let Part::Discrete { network, .. } = &path.cracking().model().parts[*part] else {
            panic!("no bonds")
        };
        let lost = failure.integrity().iter().filter(|g| **g == 0.0).count();
        let gone = network.bonds.weight.iter().filter(|w| **w == 0.0).count();
        let events: usize = path.cracking().events().iter().map(|e| e.bonds.len()).sum();
        assert_eq!([lost, gone], [events; 2]);
        before = before.max(path.grown().len());
    }
    assert!(before > 1);
}

/// A stress that never comes near the strength asks for nothing.
#[test]
fn elements_stay_below_the_trigger() {
    let limited = Options { factor_limit: 1.0, ..options() };
    let (outcome, grown) =
        Adaptive::new(&elements(), Vec::new(), Some(growth(&fill)), limited).unwrap().run().unwrap();
    assert!(grown.is_empty() && outcome.events.is_empty());
    // σ = 3FL/2bh² of a slender beam, b = 0.5: the local stress under the supports and load is higher.
    let slender = 0.5 * STRENGTH / (3.0 * LENGTH / (2.0 * 0.5 * HEIGHT * HEIGHT));
    let Stop::FactorLimit { factor } = outcome.stop else { panic!("{:?}", outcome.stop) };
    assert!((0.5..1.5).contains(&(factor / slender)), "{factor} {slender}");
    assert_eq!(outcome.work.factorisations, 1);
}

#[test]
fn rules_that_cannot_work_are_refused() {
    let refused = |rule: Growth, words: &str| {
        let error =
            Adaptive::new(&elements(), Vec::new(), Some(rule), options()).err().map(|e| e.to_string());
        assert!(error.as_ref().is_some_and(|e| e.contains(words)), "'{words}': {error:?}");
    };
    let error = Criterion { indicator: Indicator::Error, ..growth(&fill).criterion };
    refused(Growth { criterion: error, ..growth(&fill) }, "take a stress criterion");
    refused(Growth { body: "bean".to_owned(), ..growth(&fill) }, "no body 'bean'");
    let (model, _) = particles();
    let error = Adaptive::new(&model, Vec::new(), Some(growth(&fill)), options()).err().unwrap().to_string();
    assert!(error.contains("of particles already"), "{error}");
}

/// A lattice that moves as its box grows would lose the crack: it is said, not passed over.
#[test]
fn a_lattice_that_moves_loses_no_crack_silently() {
    let other = |block: Block, matter: Matter| {
        // Larger boxes get finer particles.
        let mut rows = (block.sides().y / SPACING).round() as usize;
        if block.sides().y > 1.9 {
            rows += 1;
        }
        let network = cubic(Space::Plane, block.min, block.max, rows, Skin::Weighted);
        let failure = Some(law(&network)?);
        assert!(matter.density > 0.0);
        Ok(Filled { network, failure })
    };
    let error =
        Adaptive::new(&elements(), Vec::new(), Some(growth(&other)), options()).unwrap().run().unwrap_err();
    assert!(error.to_string().contains("is no bond of the larger region"), "{error}");
}
