//! Scenes that move: what is accepted, and what an error says.

use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_cases::overrides::Override;
use seam_cases::result::{CaseResult, Plot, Series};
use seam_cases::scene::Tier;

const BEAM: &str = include_str!("scenes/switched-beam.toml");

fn read(text: &str, changes: &[&str]) -> Result<SceneFile, String> {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    SceneFile::read("beam.toml", text, Folder::Catalogue, &changes).map_err(|e| e.to_string())
}

#[test]
fn a_scene_that_moves_reads() {
    let file = read(BEAM, &[]).unwrap();
    assert!(file.scene.dynamics.is_some() && file.scene.switches.contains_key("middle"));
    // A switch that is off may still be named by probes.
    let off = read(BEAM, &["switches.middle.enabled=false"]).unwrap();
    assert!(off.scene.switches.is_empty() && off.scene.probes.contains_key("energy-jump"));
}

#[test]
fn none_takes_an_optional_key_away() {
    let changes = ["dynamics.stepping=explicit", "dynamics.step_share=0.8"];
    let twice = read(BEAM, &changes).unwrap_err();
    assert!(twice.contains("given twice"), "{twice}");
    let once = read(BEAM, &[changes[0], changes[1], "dynamics.step_s=none"]).unwrap();
    assert_eq!(once.scene.dynamics.as_ref().unwrap().step_s, None);
    let damped = ["dynamics.damping={ rate_per_s = 1 }", "dynamics.damping=none"];
    assert_eq!(read(BEAM, &damped).unwrap().scene.dynamics.unwrap().damping, None);
    let typo = read(BEAM, &["dynamics.damping={ rate = 1 }"]).unwrap_err();
    assert!(typo.contains("key: dynamics.damping.rate") && typo.contains("did you mean"), "{typo}");
}

#[test]
fn faults_name_key_and_mend() {
    for (changes, expected) in [
        (&["dynamics.step_s=none"][..], ["the time step is missing", "key: dynamics", "give step_s"]),
        (&["dynamics.step_s=1"], ["longer than the run", "dynamics.step_s", "shorten"]),
        (&["dynamics.end_s=0"], ["expected a positive number", "dynamics.end_s", ""]),
        (&["dynamics.outputs=0"], ["at least 1", "dynamics.outputs", ""]),
        (&["dynamics.alpha=-0.5"], ["makes HHT unstable", "dynamics.alpha", "-1/3"]),
        (
            &["dynamics.stepping=quasi-static", "dynamics.alpha=0"],
            ["quasi-static stepping does not know `alpha`", "dynamics.alpha", "stepping = \"implicit\""],
        ),
        (
            &["dynamics.method=gravouil-combescure"],
            ["implicit stepping does not know `method`", "dynamics.method", "two-rates"],
        ),
        (&["dynamics.step_share=0.5"], ["does not know `step_share`", "dynamics.step_share", "explicit"]),
        (&["dynamics.stepping=two-rates"], ["missing, or given twice", "dynamics", "fine_s, fine_share"]),
        (
            &["dynamics.stepping=two-rates", "dynamics.fine_share=1.2"],
            ["unstable", "dynamics.fine_share", "at most 1"],
        ),
        (&["dynamics.damping={}"], ["exactly one way", "dynamics.damping", "ratio with period_s"]),
        (&["dynamics.damping={ ratio = 0.1 }"], ["exactly one way", "dynamics.damping", ""]),
        (
            &["dynamics.damping={ share = 0.7 }"],
            ["implicit stepping does not know local damping", "dynamics.damping.share", "explicit"],
        ),
        (&["dynamics.damping={ rate_per_s = -1 }"], ["feed energy in", "dynamics.damping.rate_per_s", ""]),
        (
            &["dynamics.stepping=quasi-static", "dynamics.damping={ rate_per_s = 1 }"],
            ["does not know `damping`", "dynamics.damping", "remove"],
        ),
        (&["dynamics.loads.ramp.start_s=1"], ["the run ends at", "dynamics.loads.ramp.start_s", "earlier"]),
        (&["dynamics.loads.ramp.rise_s=0"], ["expected a positive number", "dynamics.loads.ramp.rise_s", ""]),
        (&["dynamics.loads={ table = [] }"], ["the table is empty", "dynamics.loads.table", ""]),
        (&["dynamics.loads={ table = [[0, 0], [0, 1]] }"], ["not later", "dynamics.loads.table[1]", "sort"]),
        (&["dynamics.loads=suden"], ["unknown value 'suden'", "dynamics.loads", "did you mean 'sudden'?"]),
        (&["dynamics.rotations=finite"], ["explicit", "dynamics.rotations", ""]),
        (
            &["dynamics.stepping=explicit", "dynamics.rotations=finite"],
            ["body 'beam' has finite elements", "dynamics.rotations", "small"],
        ),
        (&["switches.middle.at_s=0.001"], ["exactly one way", "switches.middle", "at_s, at_load, criterion"]),
        (&["switches.middle.at_load=1.5"], ["never gets to 1.5", "switches.middle.at_load", ""]),
        (&["switches.middle.body=baem"], ["no body 'baem'", "switches.middle.body", "did you mean 'beam'?"]),
        (&["switches.middle.box.max[0]=0"], ["flat or inside out", "switches.middle.box.max[0]", ""]),
        (
            &["switches.middle.de.arrangement=fcc"],
            ["does not exist in the space", "switches.middle.de.arrangement", ""],
        ),
        (
            &["switches.middle.fields=everything"],
            ["unknown value 'everything'", "switches.middle.fields", ""],
        ),
        (&["probes.energy-jump.switch=left"], ["no switch 'left'", "probes.energy-jump.switch", ""]),
        (
            &["probes.root.support=clmp"],
            ["no support 'clmp'", "probes.root.support", "did you mean 'clamp'?"],
        ),
        (
            &["probes.root.support=clamp", "probes.root.point=[0, 0]"],
            ["where", "probes.root", "give `support` alone"],
        ),
        (&["quantities.tip.take=largest"], ["one value only", "quantities.tip.take", ""]),
        (&["quantities.tip.zone=de"], ["zone does not fit", "quantities.tip.zone", "after-switch"]),
        (&["quantities.mid-line.zone=end"], ["zone does not fit", "quantities.mid-line.zone", "whole or de"]),
        (&["parameters.t=1"], ["unknown key 't'", "", ""]),
    ] {
        let message = read(BEAM, changes).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{changes:?}: expected '{part}' in:\n{message}");
        }
    }
}

/// Faults that no override can make: keys that are missing.
#[test]
fn faults_of_the_text_name_key_and_mend() {
    let at = "at_load = 0.5";
    let place = "box = { min = [\"length_m/3\", 0], max = [\"2*length_m/3\", \"height_m\"] }";
    let criterion = |inside: &str| format!("criterion = {{ {inside} }}");
    let whole = "trigger = 1, every_s = 1e-4";
    for (from, to, expected) in [
        (at, String::new(), ["exactly one way", "switches.middle", ""]),
        (at, "at_s = 1".to_owned(), ["outside of the run", "switches.middle.at_s", "switch earlier"]),
        (place, String::new(), ["does not say where", "switches.middle", "box"]),
        (
            at,
            criterion(&format!("error = {{}}, {whole}")),
            ["finds its own place", "switches.middle.box", "remove"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(whole),
            ["exactly one indicator", "switches.middle.criterion", "stress, error"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(&format!("stress = {{}}, {whole}")),
            ["strength that is not given", "criterion.stress", "strength_Pa"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(&format!("error = {{}}, release = 2, {whole}")),
            ["below the trigger", "criterion.release", ""],
        ),
        (
            "method = \"fe\"",
            "method = \"de\"\nde = { arrangement = \"square\", rows = 2, bond = {} }".to_owned(),
            ["no finite elements to switch", "switches.middle.body", ""],
        ),
        (
            &BEAM[BEAM.find("[dynamics]").unwrap()..BEAM.find("[switches.middle]").unwrap()],
            String::new(),
            ["stands still", "switches.middle", "[dynamics]"],
        ),
    ] {
        assert!(BEAM.contains(from), "{from}");
        let message = read(&BEAM.replacen(from, &to, 1), &[]).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{to}: expected '{part}' in:\n{message}");
        }
    }
    // Without a switch and without a run there is no history to read either.
    let still = &BEAM[BEAM.find("[dynamics]").unwrap()..BEAM.find("[probes.tip]").unwrap()];
    let message = read(&BEAM.replacen(still, "", 1), &[]).unwrap_err();
    assert!(message.contains("read in a run in time"), "{message}");
}

/// Runs the beam; the report of one run.
fn run(changes: &[&str]) -> CaseResult {
    seam_cases::procedures::run(&read(BEAM, changes).unwrap(), Tier::Quick).unwrap().result
}

fn value(result: &CaseResult, id: &str) -> f64 {
    result.quantities.iter().find(|q| q.id == id).unwrap().value
}

fn plot<'a>(result: &'a CaseResult, id: &str) -> &'a Plot {
    result.curves.iter().find(|p| p.id == id).unwrap()
}

fn own<'a>(result: &'a CaseResult, id: &str) -> &'a Series {
    &plot(result, id).series[0]
}

#[test]
fn histories_go_on_through_a_switch() {
    let result = run(&[]);
    for id in ["tip", "middle", "root", "load", "closure", "particles", "bond-stress"] {
        let (plot, own) = (plot(&result, id), own(&result, id));
        assert_eq!((own.x.len(), plot.x_label.as_str()), (41, "Time t (s)"), "{id}");
        assert_eq!(plot.shaded, [[result.switches[0].time_s, *own.x.last().unwrap()]], "{id}");
    }
    // The load is known at every time; a time step is a sum of rounded ones.
    let load = plot(&result, "load");
    assert!(load.series[0].y.iter().zip(&load.series[1].y).all(|(f, exact)| (f - exact).abs() < 1e-12));
    // The point in the middle is read off elements before the switch and off particles after it.
    let particles = own(&result, "particles");
    let after = particles.y.iter().position(|n| *n > 0.0).unwrap();
    assert_eq!((particles.y[0], *particles.y.last().unwrap()), (0.0, result.switches[0].particles as f64));
    assert!(particles.x[after] >= result.switches[0].time_s);
    let [model, reference] = &plot(&result, "middle").series[..] else { panic!("no reference") };
    let largest = reference.y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    let off = model.y.iter().zip(&reference.y).map(|(s, r)| (s - r).abs()).fold(0.0, f64::max);
    // Before the switch both are the same model; after it the lattice of 4 rows is a third of a per cent off at the tip.
    assert!(model.y[..after - 1] == reference.y[..after - 1] && off > 0.0 && off < 0.01 * largest);
    assert!(own(&result, "bond-stress").y[after] > 0.0 && own(&result, "bond-stress").y[0] == 0.0);
}

#[test]
fn a_switch_is_recorded_and_read() {
    let result = run(&[]);
    let [switch] = &result.switches[..] else { panic!("one switch") };
    assert_eq!((switch.name.as_str(), switch.elements, switch.reaction_jump.len()), ("middle", 32, 2));
    assert_eq!(value(&result, "energy-jump"), switch.strain_energy_jump);
    let [before, after] = [switch.strain_energy.before, switch.strain_energy.after];
    assert!((switch.strain_energy_jump - (after - before) / before).abs() < 1e-15);
    let time = result.quantities.iter().find(|q| q.id == "switch-time").unwrap();
    assert!((time.value / time.reference.unwrap() - 1.0).abs() < 1e-12);
    for (id, end) in [("left-end", 0.2), ("right-end", 0.4)] {
        assert!((value(&result, id) - end).abs() < 1e-12, "{id}");
    }
    let on = |name: &str| result.effects.iter().find(|e| e.name == name).unwrap();
    assert!(on("inertia").on && on("inertia").counter == 200 && on("substitution").counter == 1);
    assert!(!on("damping").on && on("damping").counter == 0);
    let energies = plot(&result, "energy-balance");
    assert_eq!(energies.series.len(), 6);
    // What comes in is what is there: the last values of all entries.
    let last: Vec<f64> = energies.series.iter().map(|s| *s.y.last().unwrap()).collect();
    assert!((last[0] + last[1] - last[2..].iter().sum::<f64>()).abs() < 1e-9 * last[2]);
}

/// A ramp of equilibria: the clamp bears the load at every time, also where particles have taken it over.
#[test]
fn the_clamp_bears_the_load_before_and_after_a_switch_at_the_clamp() {
    // Eight periods: at two, inertia would sway by 8 %.
    let quasi_static =
        ["dynamics.stepping=quasi-static", "switches.middle.box.min[0]=0", "parameters.ramp_periods=8"];
    let result = run(&quasi_static);
    assert_eq!(value(&result, "left-end"), 0.0);
    let (root, load) = (own(&result, "root"), own(&result, "load"));
    for (force, factor) in root.y.iter().zip(&load.y) {
        // The residual of one solve, relative to the largest force of the bending beam (6 kN at the clamp).
        assert!((force - 1000.0 * factor).abs() < 1e-5, "{force} {factor}");
    }
    let inertia = result.effects.iter().find(|e| e.name == "inertia").unwrap();
    assert!(!inertia.on && inertia.counter == 0 && inertia.why.contains(", below 0.05"), "{}", inertia.why);
    let sudden = run(&[
        "dynamics.stepping=quasi-static",
        "dynamics.loads=sudden",
        "switches.middle.enabled=false",
        "quantities={}",
        "budgets={}",
        "costs={}",
    ]);
    let why = &sudden.effects.iter().find(|e| e.name == "inertia").unwrap().why;
    assert!(why.contains("is 1.00e0, past 0.05") && why.contains("not trusted"), "{why}");
}

#[test]
fn other_steppings_come_to_the_same_deflection() {
    let implicit = value(&run(&[]), "deflection");
    let explicit = ["dynamics.stepping=explicit", "dynamics.step_share=0.8", "dynamics.step_s=none"];
    let two_rates = ["dynamics.stepping=two-rates", "dynamics.fine_share=0.8"];
    // The implicit step of a hundredth of the period lengthens it by π²/3·10⁻⁴. Two rates tie velocities: displacements
    // drift, and the interface does some per cent of the physical work.
    for (changes, limit) in [(&explicit[..], 1e-3), (&two_rates, 5e-3)] {
        let result = run(changes);
        let off = (value(&result, "deflection") / implicit - 1.0).abs();
        assert!(off > 0.0 && off < limit, "{changes:?} {off}");
    }
    // Other steps than the reference of its own, and yet the error of the particles is the same to a tenth of it.
    let off = value(&run(&explicit), "tip-end") / value(&run(&[]), "tip-end") - 1.0;
    assert!(off.abs() < 0.1, "{off}");
}

/// At two rates the ties open under waves that the coarse steps cannot follow, and the result says so.
#[test]
fn ties_that_drift_open_are_not_trusted() {
    let inertia = |changes: &[&str]| {
        let result = run(changes);
        result.effects.into_iter().find(|e| e.name == "inertia").unwrap()
    };
    let two_rates = ["dynamics.stepping=two-rates", "dynamics.fine_share=0.8"];
    let mapped = inertia(&two_rates);
    let indicator = mapped.indicator.as_ref().unwrap();
    assert!(mapped.on && mapped.called_for && indicator.value > 2e-3, "{mapped:?}");
    assert!(mapped.why.contains("re-equilibrate what is switched"), "{}", mapped.why);
    let at_rest = "switches.middle.fields=displacement+rotation+velocity+re-equilibrate";
    let relaxed = inertia(&[&two_rates[..], &[at_rest, "dynamics.step_s=period_s/400"]].concat());
    assert!(relaxed.on && !relaxed.called_for && relaxed.indicator.is_none(), "{relaxed:?}");
}

/// What damps takes energy out, and the balance knows how much.
#[test]
fn hht_and_both_kinds_of_damping_are_reached_from_scenes() {
    let explicit = ["dynamics.stepping=explicit", "dynamics.step_share=0.8", "dynamics.step_s=none"];
    let local = [&explicit[..], &["dynamics.damping={ share = 0.1 }"]].concat();
    for (changes, lossy, damped) in [
        (&[][..], false, false),
        (&["dynamics.alpha=-0.2"], true, false),
        (&["dynamics.damping={ ratio = 0.05, period_s = \"period_s\" }"], true, true),
        (&local, true, true),
    ] {
        let result = run(changes);
        let loss = plot(&result, "energy-balance").series.iter().find(|s| s.name == "damping").unwrap();
        let loss = *loss.y.last().unwrap();
        assert!(if lossy { loss < 0.0 } else { loss == 0.0 }, "{changes:?} {loss:e}");
        assert!(value(&result, "closure") < 1e-8, "{changes:?} {:e}", value(&result, "closure"));
        let damping = result.effects.iter().find(|e| e.name == "damping").unwrap();
        assert_eq!((damping.on, damping.counter > 0), (damped, damped), "{changes:?} {}", damping.why);
    }
}

#[test]
fn curves_of_other_settings_are_drawn_beside() {
    let beside = ["probes.tip.beside={ \"eight rows\" = [\"finer\"] }"];
    let file = read(BEAM, &beside).unwrap();
    let result = seam_cases::procedures::run(&file, Tier::Quick).unwrap().result;
    let other = plot(&result, "tip").series.iter().find(|s| s.name == "eight rows").unwrap();
    let finer = run(&["parameters.rows=8"]);
    assert_eq!(other.y, own(&finer, "tip").y);
    assert_ne!(other.y, own(&result, "tip").y);
    for (change, expected) in [
        ("probes.tip.beside={ a = [\"fner\"] }", "did you mean 'finer'?"),
        ("probes.left-end.beside={ a = [\"finer\"] }", "no curve to draw beside"),
    ] {
        let message = read(BEAM, &[change]).unwrap_err();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn studies_work_on_histories() {
    let result = run(&[]);
    let budget = &result.budgets[0];
    assert_eq!(budget.total, value(&result, "mean"));
    let sum: f64 = budget.parts.iter().map(|p| p.value).sum();
    assert!((sum - budget.total).abs() < 1e-15 && budget.parts[1].value != 0.0);
    // Coupled from the start, the lattice's own error is read over the same times: from the switch of the scene on.
    let from_the_start = run(&["switches.middle.at_load=0"]);
    let (own_history, exact) = (own(&from_the_start, "tip"), &plot(&from_the_start, "tip").series[1]);
    let after = (0..exact.x.len()).filter(|&i| exact.x[i] > result.switches[0].time_s);
    let (miss, whole) = after.fold((0.0, 0.0), |(miss, whole), i| {
        (miss + (own_history.y[i] - exact.y[i]) * exact.y[i].signum(), whole + exact.y[i].abs())
    });
    assert!((budget.parts[0].value - miss / whole).abs() < 1e-12);
    let point = &result.costs[0].settings[0].points[0];
    assert_eq!((point.error, point.particles), (Some(value(&result, "tip")), result.switches[0].particles));
    // The value at the end over its reference is the distance at the end.
    let deflection = result.quantities.iter().find(|q| q.id == "deflection").unwrap();
    let off = (deflection.value / deflection.reference.unwrap() - 1.0).abs();
    let largest = plot(&result, "tip").series[1].y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    assert!((off * deflection.reference.unwrap().abs() / largest - value(&result, "tip-end")).abs() < 1e-12);
}

#[test]
fn a_criterion_switches_again() {
    let at = BEAM.find("at_load").unwrap();
    let until = BEAM.find("fields = ").unwrap();
    let criterion = "criterion = { stress = { strength_Pa = 3e6, length_m = 0.025 }, trigger = 0.5, buffer_m = \"height_m\", every_s = \"period_s/10\", most = 3 }\n";
    // A square lattice fits every box of square elements.
    let square =
        "arrangement = \"square\", rows = \"rows\", bond = { calibrate = \"young\", radius_ratio = 0.6 }";
    let text = format!("{}{criterion}{}", &BEAM[..at], &BEAM[until..]);
    let de = text.find("de = {").unwrap();
    let text = format!("{}de = {{ {square} }}\n{}", &text[..de], &text[text.find("[probes.tip]").unwrap()..]);
    let file = read(&text, &["quantities={}", "budgets={}", "costs={}"]).unwrap();
    let result = seam_cases::procedures::run(&file, Tier::Quick).unwrap().result;
    let names: Vec<&str> = result.switches.iter().map(|s| s.name.as_str()).collect();
    assert!(names.starts_with(&["middle", "middle-2"]), "{names:?}");
    let particles: usize = result.switches.iter().map(|s| s.particles).sum();
    assert_eq!(*own(&result, "particles").y.last().unwrap(), particles as f64);
}

const FAMILY: &str = r#"
[variants.random]
"switches.middle.de.arrangement" = "random"
"switches.middle.de.rows" = 6
"switches.middle.de.skin" = "weighted"
"switches.middle.de.packing" = { seed = 7 }

[claims.small]
statement = "The deflection is right"
source = "this test"
bound = 0.1
family = "packings"
main_reading = "largest"
readings = { largest = { about = "largest over time", probe = "tip", zone = "after-switch", norm = "largest" }, end = { about = "at the end", probe = "tip", zone = "end", norm = "pointwise" } }

[variants.lattice]

[families.packings]
axes = { network = { variants = ["lattice", "random"] } }
paper_like = { network = "random" }
seeds = { body = "middle", full = [1, 2], quick = [1, 2] }
full = [{ network = ["lattice", "random"] }]
quick = [{ network = ["lattice", "random"] }]
"#;

#[test]
fn a_family_packs_the_particles_of_a_switch_with_its_seeds() {
    let file = read(&format!("{BEAM}{FAMILY}"), &["budgets={}", "costs={}"]).unwrap();
    let result = seam_cases::procedures::run(&file, Tier::Quick).unwrap().result;
    let members = &result.families[0].members;
    let seeds: Vec<Option<u64>> = members.iter().map(|m| m.seed).collect();
    assert_eq!(
        seeds,
        [None, Some(1), Some(2)],
        "{:?}",
        members.iter().map(|m| &m.failed).collect::<Vec<_>>()
    );
    assert!(
        members.iter().all(|m| m.failed.is_none()),
        "{:?}",
        members.iter().map(|m| &m.failed).collect::<Vec<_>>()
    );
    let error = |member: usize, reading: &str| members[member].errors[reading];
    // The lattice is the scene itself; a seed changes the packing and with it the error.
    assert_eq!(error(0, "largest"), value(&result, "tip"));
    assert!(error(1, "largest") != error(2, "largest") && error(1, "end") > 0.0 && error(2, "end") < 0.2);
    let nobody = read(&format!("{BEAM}{FAMILY}").replace("body = \"middle\"", "body = \"midle\""), &[]);
    let message = nobody.unwrap_err();
    assert!(
        message.contains("no body or switch 'midle'; ") || message.contains("did you mean 'middle'?"),
        "{message}"
    );
}
