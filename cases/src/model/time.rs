//! From `[dynamics]` and `[switches]` to a run of the solver.

use super::switches::Filling;
use super::{Built, Context, Refusal};
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::scene::contact::Contact;
use crate::scene::dynamics::{self, Dynamics, Loads, Rates};
use crate::scene::number::Number;
use seam_solver::contact::law::{ContactLaw, Normal};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::network::Network;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate;
use seam_solver::dynamics::newmark::Scheme;
use seam_solver::model::Model;
use seam_solver::simulation::{self, Outcome, Plan, Snapshot, Step, Stepping};
use seam_solver::space::Vec3;
use std::f64::consts::PI;

/// Packs particles into a box.
type Fill<'a> = Box<dyn Fn(Block, Matter) -> seam_solver::error::Result<Network> + 'a>;

/// Runs a scene in time, from the start or on from a checkpoint of the solver; `watch` sees every output. The notes of
/// `built` grow by what was packed for switches.
///
/// # Errors
/// A fault of the scene that only shows here, what the solver refuses, what `watch` returns.
pub fn run(
    file: &SceneFile,
    dynamics: &Dynamics,
    built: &mut Built,
    checkpoint: Option<&[u8]>,
    watch: &mut dyn FnMut(&Snapshot) -> Result<()>,
) -> Result<Outcome> {
    through(file, dynamics, built, checkpoint, watch).map_err(|refusal| refusal.of(file))
}

fn through(
    file: &SceneFile,
    dynamics: &Dynamics,
    built: &mut Built,
    checkpoint: Option<&[u8]>,
    watch: &mut dyn FnMut(&Snapshot) -> Result<()>,
) -> std::result::Result<Outcome, Refusal> {
    let context = Context::new(file)?;
    let number = |number: &Number, key: &str| number.value(context.values, &format!("dynamics.{key}"));
    let velocity = initial_velocity(&context, &built.model, dynamics)?;
    let fillings = context
        .scene
        .switches
        .iter()
        .map(|(name, switch)| Filling::new(&context, &built.model, name, switch))
        .collect::<std::result::Result<Vec<_>, Refusal>>()?;
    let fills: Vec<Fill> =
        fillings.iter().map(|filling| Box::new(|block, _| filling.fill(block)) as Fill).collect();
    let mut plan = Plan {
        stepping: stepping(&context, dynamics)?,
        end_s: number(&dynamics.end_s, "end_s")?,
        initial_velocity: velocity.as_deref(),
        loads: loads(&context, &dynamics.loads)?,
        damping: damping(&context, dynamics)?,
        rotations: match dynamics.rotations {
            dynamics::Rotations::Small => Rotations::Small,
            dynamics::Rotations::Finite => Rotations::Finite,
        },
        outputs: dynamics.outputs.count(context.values, 1, "dynamics.outputs")?,
        laws: built.laws.clone(),
        contact: context.scene.contact.as_ref().map(|given| contact(&context, given)).transpose()?,
        switches: fillings.iter().zip(&fills).map(|(filling, fill)| filling.rule(fill)).collect(),
    };
    file.spoil_plan(&mut plan);
    let model = built.model.clone();
    let mut watch = |snapshot: &Snapshot| Ok(watch(snapshot)?);
    let outcome = match checkpoint {
        None => simulation::run(model, &plan, &mut watch),
        Some(bytes) => simulation::resume(model, &plan, bytes, &mut watch),
    };
    drop(plan);
    drop(fills);
    built.calibration += context.calibration.get();
    built.packing += context.packing.get();
    built.notes.extend(fillings.into_iter().flat_map(Filling::into_notes));
    outcome
}

fn contact(context: &Context, given: &Contact) -> std::result::Result<ContactLaw, Fault> {
    let value = |number: &Number, key: &str| number.value(context.values, &format!("contact.{key}"));
    let normal = match (&given.linear, &given.hertz) {
        (Some(linear), _) => {
            Normal::Linear { stiffness_n_m: value(&linear.stiffness_n_m, "linear.stiffness_N_m")? }
        }
        (None, Some(hertz)) => Normal::Hertz {
            young_pa: value(&hertz.young_pa, "hertz.young_Pa")?,
            poisson: value(&hertz.poisson, "hertz.poisson")?,
        },
        (None, None) => {
            return Err(Fault::new("contact", "the normal force has no law", "give one of: linear, hertz"));
        }
    };
    Ok(ContactLaw {
        normal,
        restitution: value(&given.restitution, "restitution")?,
        friction: value(&given.friction, "friction")?,
        stiffness_ratio: value(&given.stiffness_ratio, "stiffness_ratio")?,
    })
}

fn stepping(context: &Context, dynamics: &Dynamics) -> std::result::Result<Stepping, Fault> {
    let value = |number: &Option<Number>, key: &str| match number {
        Some(number) => number.value(context.values, &format!("dynamics.{key}")),
        None => Err(Fault::new("dynamics", format!("`{key}` is missing"), "add it")),
    };
    let step =
        |share: &Option<Number>, seconds: &Option<Number>, [by_share, by_seconds]: [&str; 2]| match share {
            Some(_) => value(share, by_share).map(Step::ShareOfCritical),
            None => value(seconds, by_seconds).map(Step::Seconds),
        };
    Ok(match dynamics.stepping {
        dynamics::Stepping::QuasiStatic => {
            Stepping::QuasiStatic { step_s: value(&dynamics.step_s, "step_s")? }
        }
        dynamics::Stepping::Implicit => {
            let alpha =
                dynamics.alpha.as_ref().map_or(Ok(0.0), |a| a.value(context.values, "dynamics.alpha"))?;
            let scheme = Scheme::hht(alpha).map_err(|error| {
                Fault::new("dynamics.alpha", error.to_string(), "take a number from -1/3 to 0")
            })?;
            Stepping::Implicit { scheme, step_s: value(&dynamics.step_s, "step_s")? }
        }
        dynamics::Stepping::Explicit => Stepping::Explicit {
            step: step(&dynamics.step_share, &dynamics.step_s, ["step_share", "step_s"])?,
        },
        dynamics::Stepping::TwoRates => Stepping::TwoRates {
            method: match dynamics.method.unwrap_or_default() {
                Rates::PrakashHjelmstad => multirate::Method::PrakashHjelmstad,
                Rates::GravouilCombescure => multirate::Method::GravouilCombescure,
            },
            scheme: Scheme::TRAPEZOIDAL,
            step_s: value(&dynamics.step_s, "step_s")?,
            fine: step(&dynamics.fine_share, &dynamics.fine_s, ["fine_share", "fine_s"])?,
        },
    })
}

fn damping(context: &Context, dynamics: &Dynamics) -> std::result::Result<Damping, Fault> {
    let Some(given) = &dynamics.damping else { return Ok(Damping::None) };
    let value = |number: &Number, key: &str| number.value(context.values, &format!("dynamics.damping.{key}"));
    let damping = match (&given.rate_per_s, &given.ratio, &given.period_s, &given.share) {
        (Some(rate), ..) => Damping::MassProportional { rate: value(rate, "rate_per_s")? },
        // ζ = α/2ω at ω = 2π/T.
        (None, Some(ratio), Some(period), _) => {
            let omega = 2.0 * PI / value(period, "period_s")?;
            Damping::MassProportional { rate: 2.0 * value(ratio, "ratio")? * omega }
        }
        (.., Some(share)) => Damping::NonViscous { share: value(share, "share")? },
        _ => Damping::None,
    };
    // Steppings without damping take one of zero.
    let zero = [Damping::MassProportional { rate: 0.0 }, Damping::NonViscous { share: 0.0 }];
    Ok(if zero.contains(&damping) { Damping::None } else { damping })
}

/// The factor on the loads.
///
/// # Errors
/// A number without a value.
pub fn factor(file: &SceneFile, dynamics: &Dynamics) -> Result<LoadFactor> {
    let context = Context::new(file).map_err(|fault| file.error(fault))?;
    loads(&context, &dynamics.loads).map_err(|fault| file.error(fault))
}

fn loads(context: &Context, loads: &Loads) -> std::result::Result<LoadFactor, Fault> {
    let value = |number: &Number, key: &str| number.value(context.values, &format!("dynamics.loads.{key}"));
    Ok(match loads {
        Loads::Sudden => LoadFactor::Sudden,
        Loads::Ramp(ramp) => LoadFactor::Ramp {
            start_s: value(&ramp.start_s, "ramp.start_s")?,
            rise_s: value(&ramp.rise_s, "ramp.rise_s")?,
        },
        Loads::Table(rows) => {
            let row = |(i, [time, factor]): (usize, &[Number; 2])| {
                let key = format!("table[{i}]");
                Ok((value(time, &key)?, value(factor, &key)?))
            };
            LoadFactor::Table(rows.iter().enumerate().map(row).collect::<std::result::Result<_, Fault>>()?)
        }
    })
}

type Velocity<'a> = Box<dyn Fn(usize, Vec3) -> Vec3 + 'a>;

/// The velocity field, tried at every point beforehand: later it has nobody to complain to.
fn initial_velocity<'a>(
    context: &'a Context,
    model: &Model,
    dynamics: &'a Dynamics,
) -> std::result::Result<Option<Velocity<'a>>, Fault> {
    let field = &dynamics.initial_velocity;
    if field.is_empty() {
        return Ok(None);
    }
    let dim = context.space.dim();
    for x in model.parts.iter().flat_map(|part| part.positions()) {
        for (c, number) in field.iter().take(dim).enumerate() {
            number.at(*x, context.values, &format!("dynamics.initial_velocity[{c}]"))?;
        }
    }
    Ok(Some(Box::new(move |_, x| {
        Vec3::from_fn(|c, _| match field.get(c) {
            Some(number) if c < dim => number.at(x, context.values, "").unwrap_or(f64::NAN),
            _ => 0.0,
        })
    })))
}
