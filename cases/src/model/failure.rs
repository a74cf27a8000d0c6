//! `[failure.NAME]` as laws of the solver.

use super::particles::Filled;
use super::{Context, Refusal};
use crate::error::Fault;
use crate::scene::failure::{self as scene, Area, Failure};
use crate::scene::number::Number;
use seam_solver::dem::block::Block;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::softening::{Shape, Softening};
use seam_solver::failure::strength::{Strength, Weibull};
use seam_solver::failure::virial::{Measure, Release, VirialStress};
use seam_solver::failure::{self, FailureLaw, FailureRecipe, Place};
use seam_solver::model::{Part, PointValue};
use seam_solver::space::Vec3;
use std::collections::{BTreeMap, BTreeSet};

/// The law of a body among some; its name in the scene first.
pub fn of_body<'a>(laws: &'a BTreeMap<String, Failure>, body: &str) -> Option<(&'a str, &'a Failure)> {
    laws.iter().find(|(_, law)| law.body == body).map(|(name, law)| (name.as_str(), law))
}

/// Makes a law for particles of a body, of which `held` are held or loaded.
pub fn law(
    context: &Context,
    (name, given): (&str, &Failure),
    filled: &Filled,
    held: &BTreeSet<usize>,
) -> Result<failure::Failure, Refusal> {
    let key = format!("failure.{name}");
    let network = &filled.network;
    let facets = match (given.area, &filled.facets) {
        (Area::Section, _) => None,
        (Area::Facet, Some(facets)) => Some(facets.as_slice()),
        (Area::Facet, None) => {
            let message = format!("a bond of body '{}' has no Voronoi facet", given.body);
            let mend = "bond by Delaunay, or take area = \"section\"";
            return Err(Fault::new(format!("{key}.area"), message, mend).into());
        }
    };
    let zone = zone(context, given, &key)?;
    let position = &network.particles.position;
    let may = |&[i, j]: &[usize; 2]| match &zone {
        Some(zone) => inside(context, zone, 0.5 * (position[i] + position[j])),
        None => !held.contains(&i) && !held.contains(&j),
    };
    let breakable: Vec<bool> = network.bonds.ends.iter().map(may).collect();
    if !breakable.contains(&true) {
        let message = format!("no bond of body '{}' may break", given.body);
        return Err(Fault::new(format!("{key}.zone"), message, "enlarge the zone").into());
    }
    let recipe =
        FailureRecipe { law: recipe(context, given, &key)?, weibull: scatter(context, given, &key)? };
    let place = Place { network, body: &given.body, breakable: Some(&breakable), area_m2: facets };
    Ok(failure::Failure::new(&recipe, &place)?)
}

fn zone(context: &Context, given: &Failure, key: &str) -> Result<Option<Block>, Refusal> {
    let Some(zone) = &given.zone else { return Ok(None) };
    let min = context.vector(&zone.min, &format!("{key}.zone.min"))?;
    let max = context.vector(&zone.max, &format!("{key}.zone.max"))?;
    Ok(Some(Block::new(context.space, min, max)?))
}

fn inside(context: &Context, zone: &Block, x: Vec3) -> bool {
    (0..context.space.dim()).all(|i| zone.min[i] < x[i] && x[i] < zone.max[i])
}

/// Refuses supports and loads inside of a zone where bonds may break: what they hold would be torn off.
pub fn check_zones(
    context: &Context,
    parts: &[Part],
    supports: &[(String, PointValue)],
    loads: &[PointValue],
) -> Result<(), Refusal> {
    for (name, given) in &context.scene.failure {
        let key = format!("failure.{name}");
        let Some(zone) = zone(context, given, &key)? else { continue };
        let held = supports.iter().map(|(support, v)| (format!("support '{support}'"), v));
        let loaded = loads.iter().map(|v| ("a load".to_owned(), v));
        for (what, value) in held.chain(loaded) {
            let part = &parts[value.part];
            let x = part.positions()[value.point];
            if part.name() == given.body && inside(context, &zone, x) {
                let message = format!("{what} acts at ({:.6}, {:.6}) m, where bonds may break", x.x, x.y);
                return Err(Fault::new(format!("{key}.zone"), message, "shrink the zone, or move it").into());
            }
        }
    }
    Ok(())
}

fn recipe(context: &Context, given: &Failure, key: &str) -> Result<FailureLaw, Fault> {
    let strength = |s: &scene::Strength, name: &str| strength(context, s, &format!("{key}.{name}"));
    if let Some(law) = &given.virial_stress {
        let material = &context.scene.materials[&context.scene.bodies[&given.body].material];
        return Ok(FailureLaw::VirialStress(VirialStress {
            measure: match law.measure {
                scene::Measure::LargestPrincipal => Measure::LargestPrincipal,
                scene::Measure::Hydrostatic => Measure::Hydrostatic,
            },
            strength: strength(&law.strength, "virial_stress.strength")?,
            density_kg_m3: material.density_kg_m3.value(context.values, "density_kg_m3")?,
            release: match law.release {
                scene::Release::AllBonds => Release::AllBonds,
                scene::Release::MostTensile => Release::MostTensile,
            },
        }));
    }
    if let Some(law) = &given.softening {
        let number = |n: &Number, name: &str| n.value(context.values, &format!("{key}.softening.{name}"));
        let shape = match &law.kink {
            None => Shape::Linear,
            Some([stress, opening]) => Shape::Bilinear {
                kink_stress: number(stress, "kink[0]")?,
                kink_opening: number(opening, "kink[1]")?,
            },
        };
        return Ok(FailureLaw::Softening(Softening {
            tensile: strength(&law.tensile, "softening.tensile")?,
            fracture_energy_j_m2: number(&law.fracture_energy_j_m2, "fracture_energy_J_m2")?,
            shape,
            teeth: law.teeth.count(context.values, 1, &format!("{key}.softening.teeth"))?,
        }));
    }
    let given = given.bond_stress.as_ref();
    let tensile = given.and_then(|g| g.tensile.as_ref()).map(|s| strength(s, "bond_stress.tensile"));
    let shear = given.and_then(|g| g.shear.as_ref()).map(|s| strength(s, "bond_stress.shear"));
    Ok(FailureLaw::BondStress(match (tensile.transpose()?, shear.transpose()?) {
        (Some(tensile), Some(shear)) => BondStress::Mixed { tensile, shear },
        (Some(tensile), None) => BondStress::Normal { tensile },
        (None, Some(shear)) => BondStress::Shear { shear },
        (None, None) => {
            let mend = "give one of: bond_stress, virial_stress, softening";
            return Err(Fault::new(key, "the law is missing", mend));
        }
    }))
}

fn strength(context: &Context, given: &scene::Strength, key: &str) -> Result<Strength, Fault> {
    let number = |n: &Number, name: &str| n.value(context.values, &format!("{key}.{name}"));
    match (&given.stress_pa, &given.toughness_pa_sqrt_m, &given.factor) {
        (Some(stress), ..) => Ok(Strength::Stress { strength_pa: number(stress, "stress_Pa")? }),
        (None, Some(toughness), Some(factor)) => Ok(Strength::Toughness {
            toughness_pa_sqrt_m: number(toughness, "toughness_Pa_sqrt_m")?,
            factor: number(factor, "factor")?,
        }),
        _ => Err(Fault::new(
            key,
            "the strength is missing",
            "give stress_Pa, or toughness_Pa_sqrt_m with factor",
        )),
    }
}

fn scatter(context: &Context, given: &Failure, key: &str) -> Result<Option<Weibull>, Fault> {
    let Some(scatter) = &given.scatter else { return Ok(None) };
    let modulus = scatter.modulus.value(context.values, &format!("{key}.scatter.modulus"))?;
    Ok(Some(Weibull { modulus, seed: scatter.seed }))
}
