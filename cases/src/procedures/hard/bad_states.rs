//! NaN and infinity in every input, an interface with nothing to tie, every bond broken: a typed error or a defined result.

use super::super::Setting;
use super::super::compared::within;
use super::super::rounding;
use super::bodies::{SPACES, Sandwich};
use crate::error::Result;
use crate::result::CaseResult;
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::{Error, Result as Solved};
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::solve::statics;
use seam_solver::work::Work;

/// What a bad number is put into, and whether statics looks at it.
type Damage = (&'static str, bool, fn(&mut Model, f64));

const DAMAGES: [Damage; 14] = [
    ("position of a node", true, |m, x| elements(m).mesh.nodes[3].x = x),
    ("Young's modulus", true, |m, x| elements(m).elasticity.young_pa = x),
    ("Poisson's ratio", true, |m, x| elements(m).elasticity.poisson = x),
    ("density", false, |m, x| elements(m).elasticity.density = x),
    ("position of a particle", true, |m, x| particles(m).particles.position[5].y = x),
    ("mass of a particle", false, |m, x| particles(m).particles.mass[5] = x),
    ("inertia of a particle", false, |m, x| particles(m).particles.inertia[5] = x),
    ("normal stiffness of a bond", true, |m, x| particles(m).bonds.stiffness[4].kn = x),
    ("shear stiffness of a bond", true, |m, x| particles(m).bonds.stiffness[4].ks = x),
    ("bending stiffness of a bond", true, |m, x| particles(m).bonds.stiffness[4].kb = x),
    ("weight of a bond", true, |m, x| particles(m).bonds.weight[4] = x),
    ("support", true, |m, x| m.supports[0].value = x),
    ("load", true, |m, x| m.loads[0].value = x),
    ("bond between a particle and itself", true, |m, x| {
        // The number does not matter here: the bond has no length.
        if !x.is_finite() {
            particles(m).bonds.ends[4] = [2, 2];
        }
    }),
];

/// Each damage in statics, explicit and implicit runs, plane and solid.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    for (space, id) in SPACES {
        let sound = Sandwich::of(setting, space)?.cantilever(1.0).map_err(|e| setting.solver(e))?;
        let (mut asked, mut refused) = (0, 0);
        let mut let_in = Vec::new();
        for (name, in_statics, damage) in DAMAGES {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut model = sound.clone();
                damage(&mut model, bad);
                let mut ways: Vec<(&str, Solved<()>)> =
                    vec![("explicit", stepping(&model)), ("implicit", matrices(&model))];
                if in_statics {
                    ways.push(("statics", statics::solve(&model).map(|_| ())));
                }
                for (way, answer) in ways {
                    asked += 1;
                    match answer {
                        Err(_) => refused += 1,
                        Ok(()) => let_in.push(format!("{name} = {bad}, {way}")),
                    }
                }
            }
        }
        let label = format!("Bad numbers that are refused by a typed error, of all inputs, {id}");
        let why = [
            "Every one, before anything is computed with it; a panic would end this very run.",
            "the solver's own errors",
        ];
        result.quantities.push(within(
            [&format!("refused-{id}"), &label, "1"],
            refused as f64,
            [asked as f64, asked as f64],
            why,
        ));
        if !let_in.is_empty() {
            result.notes.push(format!("{id}, let in: {}", let_in.join("; ")));
        }
        interfaces(&sound, id, result);
        broken(setting, &sound, id, result)?;
    }
    Ok(())
}

fn elements(model: &mut Model) -> &mut seam_solver::fem::continuum::Continuum {
    match &mut model.parts[0] {
        Part::Continuum(body) => body,
        Part::Discrete { .. } => unreachable!("a sandwich begins with elements"),
    }
}

fn particles(model: &mut Model) -> &mut seam_solver::dem::network::Network {
    match &mut model.parts[1] {
        Part::Discrete { network, .. } => network,
        Part::Continuum(_) => unreachable!("a sandwich has particles in the middle"),
    }
}

fn stepping(model: &Model) -> Solved<()> {
    let rest = State::at_rest(Numbering::new(model).len());
    let mut run = Explicit::new(model, Options { step_s: 1e-9, ..Options::default() }, &rest)?;
    run.advance(3)
}

fn matrices(model: &Model) -> Solved<()> {
    Semidiscrete::new(model, &mut Work::default()).map(|_| ())
}

/// No face of that name, a face without points, faces that do not touch.
fn interfaces(sound: &Model, id: &str, result: &mut CaseResult) {
    let empties: [fn(&mut Model); 3] = [
        |m| m.ties[0].first.1 = "nowhere".to_owned(),
        |m| particles(m).faces.entry("left".to_owned()).or_default().clear(),
        |m| {
            let shift = 0.5 * (elements(m).mesh.nodes[1].x - elements(m).mesh.nodes[0].x);
            elements(m).mesh.nodes.iter_mut().for_each(|x| x.x -= shift);
        },
    ];
    let named = |empty: &fn(&mut Model)| {
        let mut model = sound.clone();
        empty(&mut model);
        let all = [statics::solve(&model).map(|_| ()), stepping(&model), matrices(&model)];
        all.iter().filter(|a| matches!(a, Err(Error::EmptyInterface { .. } | Error::Geometry { .. }))).count()
    };
    let count: usize = empties.iter().map(named).sum();
    let label = format!("Empty interfaces that are refused by name, {id}");
    let why = ["No face, no points, a gap: three ways each.", "the solver's own errors"];
    result.quantities.push(within([&format!("empty-{id}"), &label, "1"], count as f64, [9.0, 9.0], why));
}

/// Without bonds particles hang on nothing: statics names them; in motion they fly on, and momentum stays.
fn broken(setting: &Setting, sound: &Model, id: &str, result: &mut CaseResult) -> Result<()> {
    let mut model = sound.clone();
    particles(&mut model).bonds.weight.fill(0.0);
    let refused = matches!(statics::solve(&model), Err(Error::Disconnected { .. } | Error::Mechanism { .. }));
    let label = format!("Statics with every bond broken is refused by name, {id}");
    let why = ["A typed error that says what moves.", "the solver's own error"];
    result.quantities.push(within(
        [&format!("broken-statics-{id}"), &label, "1"],
        f64::from(u8::from(refused)),
        [1.0, 1.0],
        why,
    ));
    let mut free = model.clone();
    free.supports.clear();
    free.loads.clear();
    free.ties.clear();
    let n = Numbering::new(&free).len();
    let first = Numbering::new(&free).offset(1);
    let last = Numbering::new(&free).offset(2);
    let mut start = State::at_rest(n);
    start.v[first..last].iter_mut().enumerate().for_each(|(i, v)| *v = (i as f64 * 0.7).sin());
    let go = || -> Solved<f64> {
        let step_s = 0.5 * seam_solver::dynamics::critical::bound(&free)?.step_s;
        let mut run = Explicit::new(&free, Options { step_s, ..Options::default() }, &start)?;
        run.advance(100)?;
        let seen = run.observe()?;
        let flown = |i: usize| (seen.state.u[i] - seen.state.time * start.v[i]).abs();
        Ok((first..last).map(flown).fold(0.0, crate::observe::curve::nan_max) / seen.state.time)
    };
    let off = go().map_err(|e| setting.solver(e))?;
    let label = format!("Particles without bonds fly on: distance from v·t, over t and 1 m/s, {id}");
    let why = "Nothing acts on them: rounding of a hundred additions.";
    result.quantities.push(rounding(&format!("broken-motion-{id}"), &label, off, 1e-13, why, "u = v t"));
    Ok(())
}
