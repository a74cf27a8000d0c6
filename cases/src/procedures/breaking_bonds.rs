//! A notched network loaded until bonds break: which ones, in which order and under which force, against YADE.

use super::Setting;
use super::breaking_specimens::{Specimen, bent, pulled};
use super::compared::{exact, plot, series, within};
use super::rounding;
use crate::error::Result;
use crate::export::Code;
use crate::file::SceneFile;
use crate::result::{Agreement, CaseResult, Observation, Plot, Role};
use crate::scene::Tier;
use seam_references::Dataset;
use seam_solver::cracking::{Cracking, Event, Options};
use seam_solver::dem::network::Network;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::forces::BondForce;
use seam_solver::failure::strength::Strength;
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place, Site};
use seam_solver::model::Part;

/// Procedures of this family.
pub(super) const PULLED: &str = "breaking-bonds";
pub(super) const BENT: &str = "breaking-bend";

/// Whether a procedure is of this family.
pub(crate) fn answers(procedure: &str) -> bool {
    [PULLED, BENT].contains(&procedure)
}

/// The specimen of a case.
///
/// # Errors
/// Parameters that are missing or out of range.
pub(crate) fn specimen(file: &SceneFile) -> Result<Specimen> {
    build(&Setting { file, tier: Tier::Quick })
}

fn build(setting: &Setting) -> Result<Specimen> {
    match setting.file.scene.procedure.as_str() {
        BENT => bent(setting),
        _ => pulled(setting),
    }
}

/// Order of the bonds, force and displacement, and the path of both codes as a plot.
pub(super) fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let specimen = build(setting)?;
    let data = setting.dataset(&setting.file.scene.id, Code::Yade.name())?;
    let (path, closest) = crack(setting, &specimen, result)?;
    let theirs = Steps::of_yade(setting, &data)?;
    result.curves.push(force_displacement(&path.envelope, &theirs));
    let source = format!(
        "YADE {}, run on {} ({})",
        data.provenance.version, data.provenance.date, data.provenance.machine
    );
    let of_yade = |compared: &str, observation: Observation| Observation {
        kind: Code::Yade.kind(),
        agreement: Some(Agreement {
            code: Code::Yade.title().to_owned(),
            version: data.provenance.version.clone(),
            date: data.provenance.date.to_string(),
            model: specimen.about.to_owned(),
            compared: compared.to_owned(),
            same_model: true,
        }),
        ..observation
    };
    let same = path.bonds.iter().zip(&theirs.bonds).take_while(|(a, b)| a == b).count();
    let events = specimen.events as f64;
    result.quantities.push(of_yade(
        "bonds broken in the same order",
        within(
            ["same-bonds", "Bonds that break in the same order as in YADE, from the first on", "1"],
            same as f64,
            [events, events],
            ["All that are compared: one criterion on the same network leaves no choice.", &source],
        ),
    ));
    let tolerance = setting.number("tolerance")?;
    let why = "YADE pulls slowly but in motion, and follows the particles as they move; what is moved goes 1e-4 beyond the point where a bond fails.";
    let (peak, at) = path.peak();
    let (their_peak, their_at) = theirs.peak();
    for (id, label, unit, own, yade) in [
        ("peak-force", "Largest force", "N", peak, their_peak),
        ("peak-displacement", "Displacement at the largest force", "m", at, their_at),
    ] {
        let observation = exact([id, label, unit], own, yade, tolerance, [why, &source]);
        result.quantities.push(of_yade(&label.to_lowercase(), observation));
    }
    let apart = path.apart(&theirs) / their_peak;
    let label = "Force when a bond breaks, largest difference from YADE over the largest force";
    result
        .quantities
        .push(of_yade("force at every break", rounding("force", label, apart, tolerance, why, &source)));
    result.quantities.push(within(
        ["closest-tie", "Lead of the bond that breaks over the next, smallest over all events", "1"],
        closest,
        [setting.number("least_lead")?, 1.0],
        [
            "A check of the check: above what the two codes differ by, so that no tie decides the order.",
            "this run",
        ],
    ));
    Ok(())
}

/// Breaks under a displacement that never falls.
struct Steps {
    /// Ends of the broken bonds.
    bonds: Vec<[usize; 2]>,
    /// Displacement at each break, in m.
    displacement: Vec<f64>,
    /// Force before each break, in N.
    force: Vec<f64>,
    /// Corners of the path `(m, N)`.
    envelope: Vec<(f64, f64)>,
}

impl Steps {
    fn of_yade(setting: &Setting, data: &Dataset) -> Result<Self> {
        let column = |name: &str, unit: &str| {
            data.column(name, unit).map(<[f64]>::to_vec).map_err(|problem| setting.reference(problem))
        };
        let ends = column("i", "1")?.into_iter().zip(column("j", "1")?);
        let bonds = ends.map(|(i, j)| [i as usize, j as usize]).collect();
        let after = column("force_after", "N")?;
        Ok(Self::new(bonds, column("displacement", "m")?, column("force", "N")?, &after))
    }

    /// What an event path is under displacement control: events at a smaller displacement happen where it is.
    fn of_events(network: &Network, events: &[Event]) -> Self {
        let (mut held, mut steps) = (0.0f64, [const { Vec::new() }; 3]);
        let mut bonds = Vec::new();
        for event in events {
            held = held.max(event.displacement);
            let share = held / event.displacement;
            for (list, value) in steps.iter_mut().zip([held, share * event.force, share * event.force_after])
            {
                list.push(value);
            }
            if let Site::Bond(bond) = event.site {
                bonds.push(network.bonds.ends[bond]);
            }
        }
        let [displacement, force, after] = steps;
        Self::new(bonds, displacement, force, &after)
    }

    fn new(bonds: Vec<[usize; 2]>, displacement: Vec<f64>, force: Vec<f64>, after: &[f64]) -> Self {
        let drops = displacement.iter().zip(force.iter().zip(after));
        let corners = drops.flat_map(|(&q, (&before, &after))| [(q, before), (q, after)]);
        let envelope = std::iter::once((0.0, 0.0)).chain(corners).collect();
        Self { bonds, displacement, force, envelope }
    }

    /// Largest force (N), and where it acts (m).
    fn peak(&self) -> (f64, f64) {
        let pairs = self.force.iter().copied().zip(self.displacement.iter().copied());
        pairs.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NAN, f64::NAN))
    }

    /// Largest difference of the forces of events with the same number, in N; NaN if they are not equally many.
    fn apart(&self, other: &Steps) -> f64 {
        match self.force.len() == other.force.len() {
            true => self.force.iter().zip(&other.force).fold(0.0, |m, (a, b)| m.max((a - b).abs())),
            false => f64::NAN,
        }
    }
}

/// Seam's own path, and the smallest lead of a failing bond over the next one.
fn crack(setting: &Setting, specimen: &Specimen, result: &mut CaseResult) -> Result<(Steps, f64)> {
    let refuse = |e| setting.solver(e);
    let Part::Discrete { name, network } = &specimen.model.parts[0] else {
        return Ok((Steps::new(Vec::new(), Vec::new(), Vec::new(), &[]), f64::NAN));
    };
    let tensile = Strength::Stress { strength_pa: specimen.strength_pa };
    let recipe = FailureRecipe { law: FailureLaw::BondStress(BondStress::Normal { tensile }), weibull: None };
    let place = Place { network, body: name, breakable: Some(&specimen.breakable), area_m2: None };
    let failure = Failure::new(&recipe, &place).map_err(refuse)?;
    let mut cracking =
        Cracking::new(&specimen.model, vec![(0, failure)], Options::default()).map_err(refuse)?;
    let (mut events, mut closest) = (Vec::new(), f64::INFINITY);
    while events.len() < specimen.events {
        let failure = &cracking.laws()[0].1;
        let forces = BondForce::all(network, cracking.displacements(), failure.integrity());
        let mut demands = failure.demands(network, &forces);
        demands.sort_by(|a, b| b.total_cmp(a));
        closest = closest.min(1.0 - demands[1] / demands[0]);
        let Some(event) = cracking.advance().map_err(refuse)? else { break };
        events.push(event.clone());
    }
    result.work += cracking.work();
    Ok((Steps::of_events(network, &events), closest))
}

fn force_displacement(own: &[(f64, f64)], yade: &Steps) -> Plot {
    let text = ["path", "Force until bonds break", "displacement of what is moved (m)", "force (N)"];
    let lines = vec![
        series("Seam", Role::Model, own.iter().copied()),
        series("YADE", Role::Reference, yade.envelope.iter().copied()),
    ];
    plot(text, [false, false], lines)
}
