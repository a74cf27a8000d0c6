//! Scenes that crack: what is accepted, what an error says, and what a run tells.

use seam_cases::checkpoint::Checkpoints;
use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_cases::overrides::Override;
use seam_cases::result::CaseResult;
use seam_cases::scene::Tier;

/// A square lattice in tension between two faces, notched by nothing: it breaks in its zone.
const STRIP: &str = r#"id = "strip"
title = "A strip in tension"

[parameters]
strength_Pa = 1e6

[materials.stuff]
young_Pa = 1e9
poisson = 0

[bodies.strip]
method = "de"
material = "stuff"
box = { min = [0, 0], max = [2, 1] }
fe = { divisions = [8, 4] }
de = { arrangement = "square", rows = 8, bond = { calibrate = "young", radius_ratio = 1.1547005383792517 } }

[supports.left]
on = "strip.left"
ux = 0
uy = 0

[supports.right]
on = "strip.right"
ux = 1e-3

[failure.tension]
body = "strip"
bond_stress = { tensile = { stress_Pa = "strength_Pa" } }
zone = { min = [0.5, -1], max = [1.5, 2] }

[cracking]

[probes.peak]
read = "peak-force"

[probes.closure]
read = "path-closure"

[quantities.peak]
label = "Peak"
probe = "peak"

[quantities.closure]
label = "Closure"
probe = "closure"
accept = { interval = [0, 1e-10], why = "Rounding." }
"#;

fn read(changes: &[&str]) -> Result<SceneFile, String> {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    SceneFile::read("strip.toml", STRIP, Folder::Catalogue, &changes).map_err(|e| e.to_string())
}

fn run(changes: &[&str]) -> Result<CaseResult, String> {
    seam_cases::study::run(&read(changes)?, Tier::Quick, &Checkpoints::default())
        .map(|run| run.result)
        .map_err(|e| e.to_string())
}

fn value(result: &CaseResult, id: &str) -> f64 {
    result.quantities.iter().find(|q| q.id == id).unwrap().value
}

#[test]
fn faults_name_key_and_mend() {
    for (changes, expected) in [
        (&["cracking=none"][..], ["nothing lets bonds fail", "key: failure.tension", "add [cracking]"]),
        (&["effects=[]"], ["`bond-failure` is off", "failure.tension", "add \"bond-failure\""]),
        (&["failure.tension.enabled=false"], ["nothing can fail", "cracking", "add a [failure.NAME]"]),
        (
            &["failure.tension.body=stripe"],
            ["no body 'stripe'", "failure.tension.body", "did you mean 'strip'?"],
        ),
        (
            &["bodies.strip.method=fe"],
            ["no bonds that could break", "failure.tension.body", "method = \"de\""],
        ),
        (
            &["failure.tension.bond_stress={}"],
            ["no stress breaks a bond", "failure.tension.bond_stress", "tensile, shear"],
        ),
        (
            &["failure.tension.softening={ tensile = { stress_Pa = 1 }, fracture_energy_J_m2 = 1 }"],
            ["exactly one way", "failure.tension", "bond_stress, virial_stress, softening"],
        ),
        (
            &["failure.tension.bond_stress.tensile={ toughness_Pa_sqrt_m = 1 }"],
            ["strength is given in exactly one way", "tensile", "with factor"],
        ),
        (&["parameters.strength_Pa=0"], ["expected a positive number", "stress_Pa", ""]),
        (
            &["failure.tension.scatter={ modulus = -1 }"],
            ["expected a positive number", "failure.tension.scatter.modulus", ""],
        ),
        (&["cracking.events=0"], ["at least 1", "cracking.events", ""]),
        (&["cracking.least_stiffness=1"], ["no share", "cracking.least_stiffness", "below one"]),
        (
            &["contact={ linear = { stiffness_N_m = 1 }, restitution = 0.5 }"],
            ["explicit steps", "contact", ""],
        ),
        (&["probes.peak.up_to_m=1"], ["does not fit", "probes.peak.up_to_m", "envelope-work"]),
        (&["probes.peak.read=crack-path"], ["norm does not fit", "quantities.peak.norm", ""]),
        (
            &["dynamics={ stepping = \"explicit\", step_share = 0.5, end_s = 1 }"],
            ["have no time", "cracking", "keep one"],
        ),
    ] {
        let message = read(changes).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{changes:?}: expected '{part}' in:\n{message}");
        }
    }
}

/// Faults that need the particles.
#[test]
fn supports_in_the_zone_and_empty_zones_are_refused() {
    for (changes, expected) in [
        (
            &["failure.tension.zone.min=[-1, -1]"][..],
            ["support 'left' acts at (0.0", "failure.tension.zone", "shrink"],
        ),
        (
            &["failure.tension.zone.max=[3, 2]"],
            ["support 'right' acts at (2.0", "failure.tension.zone", "shrink"],
        ),
        (&["failure.tension.zone.max=[0.51, 2]"], ["no bond of body 'strip' may break", "zone", "enlarge"]),
    ] {
        let message = run(changes).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{changes:?}: expected '{part}' in:\n{message}");
        }
    }
}

/// Skin weights make uniform strain an equilibrium of the square lattice, so the first bond breaks at the load `σ_t A`.
#[test]
fn a_strip_breaks_at_its_strength() {
    let result = run(&[]).unwrap();
    let peak = value(&result, "peak") / 1e6;
    // Rounding of the solve and of the facets.
    assert!((peak - 1.0).abs() < 1e-8, "{peak}");
    assert!(value(&result, "closure") < 1e-10);
    let effect = result.effects.iter().find(|e| e.name == "bond-failure").unwrap();
    assert!(effect.on && effect.counter > 0, "{effect:?}");
    let broken = result.pictures.iter().map(|p| p.broken.len()).max().unwrap();
    assert!(broken as u64 >= 9 && result.curves.iter().any(|c| c.id == "path"), "{broken}");
    // Teeth stand above and below the curve; the highest stress is above the strength by less than a tooth.
    let softened = run(&[
        "failure.tension.bond_stress=none",
        "failure.tension.softening={ tensile = { stress_Pa = \"strength_Pa\" }, fracture_energy_J_m2 = 500 }",
    ])
    .unwrap();
    let peak = value(&softened, "peak") / 1e6;
    assert!((0.9..1.3).contains(&peak) && value(&softened, "closure") < 1e-10, "{peak}");
}

/// A trigger above what the elements at the notch see when the first bond fails: particles come beyond the peak, and the result says so.
#[test]
fn particles_that_come_too_late_are_not_trusted() {
    let late = Override::parse("parameters.trigger=0.4").unwrap();
    let coarse = Override::parse("parameters.rows=30").unwrap();
    let file = seam_cases::catalogue::case("v-notch-bend", &[late, coarse]).unwrap();
    let result = seam_cases::study::run(&file, Tier::Quick, &Checkpoints::default()).unwrap().result;
    let substitution = result.effects.iter().find(|e| e.name == "substitution").unwrap();
    let indicator = substitution.indicator.as_ref().unwrap();
    assert!(
        substitution.on && substitution.called_for && indicator.value > indicator.limit,
        "{substitution:?}"
    );
    assert!(substitution.why.contains("lower the trigger"), "{}", substitution.why);
}

/// A crack that closes on the way and is open again at the end: its broken pairs have run into each other, and the result says so.
#[test]
fn a_crack_that_closes_on_the_way_calls_for_contact() {
    let called_for = |changes: &[&str]| {
        let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
        let file = seam_cases::catalogue::case("effects-contact", &changes).unwrap();
        let result = seam_cases::study::run(&file, Tier::Quick, &Checkpoints::default()).unwrap().result;
        let contact = result.effects.iter().find(|e| e.name == "contact").unwrap().clone();
        assert!(!contact.on);
        contact.called_for
    };
    let opened = [
        "contact=none",
        "dynamics.end_s=5*period_s",
        "dynamics.loads={ table = [[0, 0], [\"2*period_s\", 1]] }",
    ];
    assert!(!called_for(&opened));
    let reopened = [
        "contact=none",
        "dynamics.end_s=13*period_s",
        "dynamics.loads={ table = [[0, 0], [\"2*period_s\", 1], [\"4*period_s\", 1], [\"7*period_s\", -1], [\"10*period_s\", 1]] }",
    ];
    assert!(called_for(&reopened));
}
