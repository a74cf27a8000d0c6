//! From measured results to judged ones.

use crate::compare::{CurveComparison, LEAST_COVERAGE, Tolerance, compare_curves, headroom, signed_error};
use crate::loosened;
use crate::margins;
use crate::record::{self, Recorded};
use crate::results::{CaseJudgement, ClaimResult, CurveResult, Provenance, QuantityResult, Results, SCHEMA};
use crate::statistics::convergence::fitted_order;
use crate::verdict::{Verdict, of_quantity};
use crate::{ablation, claims, cost, growth};
use seam_cases::result::{CaseResult, Convergence, Family, Observation, Plot, ReferenceKind, Role, Series};
use std::collections::BTreeSet;

/// Judges every number, curve and claim of some cases, in their order.
pub fn judge(cases: &[CaseResult], provenance: Provenance, recorded: &Recorded) -> Results {
    Results {
        schema: SCHEMA.to_owned(),
        provenance,
        cases: cases.iter().map(|case| judge_case(case, recorded)).collect(),
        race: None,
    }
}

/// Judges every number, curve and claim of one case.
pub fn judge_case(case: &CaseResult, recorded: &Recorded) -> CaseJudgement {
    let orders = case.convergence.iter().filter_map(order_of);
    let growths = case.growths.iter().map(growth::of_work);
    let promises = case.costs.iter().filter_map(cost::promised);
    let observed = case.quantities.iter().cloned().chain(orders).chain(growths).chain(promises);
    let quantities: Vec<QuantityResult> = observed
        .map(|o| {
            let last = recorded.value(&case.tier, &case.id, &o.id);
            let known = case.expected_failures.get(&o.id).cloned();
            QuantityResult { expected_failure: known, ..judge_quantity(o, last) }
        })
        .collect();
    let judged = |id: &&String| quantities.iter().any(|q| q.id == **id && q.verdict.is_some());
    // What a study by itself does not measure is neither looser nor less than recorded.
    let whole = !case.study_alone;
    let work = recorded.work(&case.tier, &case.id, &case.scene_hash).filter(|_| whole);
    let tolerances = if whole { recorded.tolerances(&case.tier, &case.id) } else { None };
    CaseJudgement {
        id: case.id.clone(),
        title: case.title.clone(),
        tier: case.tier.clone(),
        scene_hash: case.scene_hash.clone(),
        command: case.command.clone(),
        effects: case.effects.clone(),
        expected_in_vain: case.expected_failures.keys().filter(|id| whole && !judged(id)).cloned().collect(),
        loosened: loosened::loosened(tolerances, &quantities),
        tags: case.tags.clone(),
        quantities,
        curves: case.curves.iter().flat_map(judge_curves).collect(),
        claims: claims_in_order(case, recorded),
        margins: case
            .margins
            .iter()
            .map(|m| margins::judge(m, recorded.margin(&case.tier, &case.id, &m.id)))
            .collect(),
        trusted: case.effects.iter().all(|effect| !effect.called_for),
        costs: case.costs.iter().map(cost::judge).collect(),
        timed: case.growths.iter().filter_map(growth::of_seconds).collect(),
        ablations: case.ablations.iter().map(ablation::judge).collect(),
        work: case.work,
        recorded_work: work.map(|w| w.total),
        recorded_counters: work.map_or_else(Default::default, |w| w.counters.clone()),
        seconds: case.seconds,
    }
}

fn judge_quantity(o: Observation, last: Option<f64>) -> QuantityResult {
    let verdict = match o.reference {
        Some(r) if !r.is_finite() => o.accepted.map(|_| Verdict::Undetermined),
        _ => of_quantity(o.value, o.accepted),
    };
    QuantityResult {
        error: o.reference.map(|r| signed_error(o.value, r)).and_then(finite),
        headroom: o.accepted.and_then(|a| headroom(o.value, a, o.reference)),
        regression: last.map(|l| signed_error(o.value, l)).and_then(finite),
        verdict,
        id: o.id,
        label: o.label,
        unit: o.unit,
        value: finite(o.value),
        reference: o.reference.and_then(finite),
        kind: o.kind,
        source: o.source,
        u_num: finite(o.u_num),
        u_ref: finite(o.u_ref),
        accepted: o.accepted.map(|ends| ends.map(finite)),
        why: o.why,
        agreement: o.agreement,
        expected_failure: None,
    }
}

fn finite(v: f64) -> Option<f64> {
    v.is_finite().then_some(v)
}

/// The observed order of a refinement study as a quantity beside the others. Where an order was promised and
/// the study gives none, the value is NaN: not measured.
fn order_of(study: &Convergence) -> Option<Observation> {
    let fit = fitted_order(&study.h, &study.error).map(|fit| fit.order);
    let order = fit.or(study.tolerance.map(|_| f64::NAN))?;
    let accepted = |absolute| Tolerance { relative: 0.0, absolute }.interval(study.formal_order);
    Some(Observation {
        id: format!("order-{}", study.id),
        label: format!("observed order: {}", study.label),
        unit: "1".to_owned(),
        value: order,
        reference: Some(study.formal_order),
        kind: ReferenceKind::Exact,
        source: "theory of the method".to_owned(),
        accepted: study.tolerance.map(accepted),
        why: format!("least-squares fit over {} levels", study.h.len()),
        ..Observation::default()
    })
}

/// The model's curves against the first reference of their plot, where the plot declares a tolerance band.
fn judge_curves(plot: &Plot) -> Vec<CurveResult> {
    let reference = plot.series.iter().find(|s| s.role == Role::Reference);
    let Some(reference) = reference.filter(|_| plot.band.is_some()) else { return Vec::new() };
    let models = plot.series.iter().filter(|s| s.role == Role::Model);
    models.map(|model| judge_curve(plot, model, reference)).collect()
}

fn judge_curve(plot: &Plot, model: &Series, reference: &Series) -> CurveResult {
    // Floor 0: a declared floor is the scene's matter, and bands are drawn around |r| > 0 only.
    let (comparison, failure) = match compare_curves((&model.x, &model.y), (&reference.x, &reference.y), 0.0)
    {
        Ok(c) => (Some(c), String::new()),
        Err(e) => (None, e.to_string()),
    };
    let coverage = comparison.as_ref().map_or(0.0, |c| c.coverage);
    let (verdict, why) = match &comparison {
        None => (Verdict::Undetermined, failure),
        Some(c) if c.coverage < LEAST_COVERAGE => (Verdict::Fail, too_short(c)),
        Some(_) => (Verdict::Pass, String::new()),
    };
    CurveResult {
        plot: plot.id.clone(),
        series: model.name.clone(),
        kind: plot.against,
        coverage,
        e2: comparison.as_ref().and_then(|c| c.e2),
        e_max: comparison.as_ref().and_then(|c| c.e_max),
        absolute: comparison.as_ref().map_or(0.0, |c| c.absolute),
        verdict,
        why,
    }
}

fn too_short(c: &CurveComparison) -> String {
    format!(
        "only {:.0} % of the reference's stations lie inside the model's range; {:.0} % are needed",
        100.0 * c.coverage,
        100.0 * LEAST_COVERAGE
    )
}

/// The claims under test before our own, which answer them.
fn claims_in_order(case: &CaseResult, recorded: &Recorded) -> Vec<ClaimResult> {
    let mut claims: Vec<ClaimResult> = case.families.iter().map(|f| judge_claim(case, f, recorded)).collect();
    claims.sort_by_key(|claim| claim.own);
    claims
}

fn judge_claim(case: &CaseResult, family: &Family, recorded: &Recorded) -> ClaimResult {
    let paper =
        family.no_more_particles_than.as_ref().and_then(|id| case.families.iter().find(|f| f.claim == *id));
    let judged = claims::judge(family, paper);
    let seeds: BTreeSet<u64> = family.members.iter().filter_map(|m| m.seed).collect();
    let hash = record::family_hash(family);
    let last = recorded.claim(&case.tier, &family.claim);
    let full = if family.complete { None } else { recorded.claim("full", &family.claim) };
    ClaimResult {
        id: family.claim.clone(),
        statement: family.statement.clone(),
        source: family.source.clone(),
        own: family.own,
        bound: family.bound,
        record: record::compare(last, judged.verdict, &hash),
        recorded: last.cloned(),
        recorded_full: full.cloned(),
        verdict: judged.verdict,
        share: judged.share,
        reason: judged.reason,
        readings: judged.readings,
        seeds: seeds.into_iter().collect(),
        settings: judged.settings,
        complete: family.complete,
        decides: judged.decides,
        needed: judged.needed,
        most_particles: judged.most_particles,
        unmeasured: judged.unmeasured,
        hash,
    }
}
