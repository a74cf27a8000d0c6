//! Which rules switch now, and doing it.

use super::boxes::without;
use super::plan::{Plan, SwitchRule, When};
use super::start::admit;
use crate::dem::block::Block;
use crate::dynamics::State;
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::model::{Model, Numbering, Part};
use crate::space::Vec3;
use crate::transfer::criterion::Criterion;
use crate::transfer::region::{Region, cells_in};
use crate::transfer::report::SwitchReport;
use crate::transfer::substitution::{Origin, Switch, substitute};
use crate::work::Work;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A box whose elements are to be replaced now.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Job {
    rule: usize,
    block: Block,
}

/// The rules of a plan and how far each has come.
pub(super) struct Rules<'a> {
    rules: &'a [SwitchRule<'a>],
    /// How far each has come.
    pub progress: Vec<Progress>,
    /// What was replaced so far, in order.
    pub done: Vec<Job>,
}

/// How far a rule has come.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Progress {
    /// When it wants to be asked, in s; infinite when it is through.
    next_s: f64,
    /// Times that it chose something.
    rounds: usize,
    /// Box around its body at the start.
    body: Option<Block>,
    /// Box around all that it chose.
    grown: Option<Block>,
    /// Boxes of particles that it made.
    filled: Vec<Block>,
    /// Parts of the present model that are pieces of its body.
    pieces: Vec<usize>,
}

impl<'a> Rules<'a> {
    /// Rules of a plan that was checked.
    pub fn new(model: &Model, plan: &'a Plan) -> Self {
        let of = |rule: &SwitchRule| Progress {
            next_s: match rule.when {
                When::Time { time_s, .. } => time_s,
                When::LoadLevel { factor, .. } => {
                    plan.loads.first_reaches(factor, plan.end_s).unwrap_or(f64::INFINITY)
                }
                When::Criterion { every_s, .. } => every_s,
            },
            rounds: 0,
            body: model.parts.iter().find(|p| p.name() == rule.body).and_then(|p| bounds(p.positions())),
            grown: None,
            filled: Vec::new(),
            pieces: (0..model.parts.len()).filter(|&p| model.parts[p].name() == rule.body).collect(),
        };
        Rules { rules: &plan.switches, progress: plan.switches.iter().map(of).collect(), done: Vec::new() }
    }

    /// When the next rule wants to be asked, in s.
    pub fn next_time(&self) -> f64 {
        self.progress.iter().map(|p| p.next_s).fold(f64::INFINITY, f64::min)
    }

    /// What the first rule that is due and chooses something wants to replace; nothing if none does.
    ///
    /// # Errors
    /// What a criterion refuses.
    pub fn ask(&mut self, model: &Model, u: &[f64], now: f64) -> Result<Vec<Job>> {
        for rule in 0..self.rules.len() {
            if self.progress[rule].next_s > now {
                continue;
            }
            let blocks = match &self.rules[rule].when {
                When::Time { block, .. } | When::LoadLevel { block, .. } => {
                    self.progress[rule].next_s = f64::INFINITY;
                    vec![*block]
                }
                When::Criterion { criterion, every_s, most, through } => {
                    let blocks = self.grow(rule, (criterion, through), model, u)?;
                    let progress = &mut self.progress[rule];
                    progress.rounds += usize::from(!blocks.is_empty());
                    let again = ((now / every_s).floor() + 1.0) * every_s;
                    progress.next_s = if progress.rounds < *most { again } else { f64::INFINITY };
                    blocks
                }
            };
            if !blocks.is_empty() {
                return Ok(blocks.into_iter().map(|block| Job { rule, block }).collect());
            }
        }
        Ok(Vec::new())
    }

    /// The boxes by which the region of a criterion grows: the box around all it ever chose, less what is particles already.
    fn grow(
        &mut self,
        rule: usize,
        (criterion, through): (&Criterion, &[bool; 3]),
        model: &Model,
        u: &[f64],
    ) -> Result<Vec<Block>> {
        let numbering = Numbering::new(model);
        let mut wanted: Option<Block> = None;
        for &part in &self.progress[rule].pieces {
            let Part::Continuum(body) = &model.parts[part] else { continue };
            let first = numbering.offset(part);
            let cells = criterion.choose(body, &u[first..first + body.dof_count()], &BTreeSet::new())?;
            let nodes = cells.iter().flat_map(|&c| body.mesh.cell(c)).map(|&n| &body.mesh.nodes[n]);
            if let Some(block) = bounds(nodes) {
                wanted = Some(wanted.map_or(block, |all| all.around(&block)));
            }
        }
        let Some(mut wanted) = wanted else { return Ok(Vec::new()) };
        if let Some(body) = &self.progress[rule].body {
            for i in (0..3).filter(|&i| through[i]) {
                (wanted.min[i], wanted.max[i]) = (body.min[i], body.max[i]);
            }
        }
        let whole = self.progress[rule].grown.map_or(wanted, |old| old.around(&wanted));
        self.progress[rule].grown = Some(whole);
        let body = &self.rules[rule].body;
        let same_body = self.rules.iter().zip(&self.progress).filter(|(r, _)| r.body == *body);
        let filled = same_body.flat_map(|(_, p)| &p.filled);
        Ok(filled.fold(vec![whole], |rest, hole| {
            rest.into_iter().flat_map(|b| without(model.space, b, hole)).collect()
        }))
    }

    /// Replaces the elements of a job, piece by piece. Returns names and reports of the new bodies.
    ///
    /// # Errors
    /// As [`substitute`]; a box without elements, or of elements that do not fill it.
    pub fn apply(
        &mut self,
        job: &Job,
        model: &mut Model,
        state: &mut State,
        factor: f64,
        work: &mut Work,
    ) -> Result<Vec<(String, SwitchReport)>> {
        let mut reports = Vec::new();
        while let Some((part, region)) = self.find(job, model)? {
            reports.push(self.replace(job.rule, part, region, (&mut *model, &mut *state), factor, work)?);
        }
        if !reports.is_empty() {
            self.done.push(*job);
            return Ok(reports);
        }
        let SwitchRule { name, body, .. } = &self.rules[job.rule];
        Err(Error::Switch {
            what: format!("rule '{name}'"),
            message: format!(
                "no elements of body '{body}' are left in its box; other rules took them: move the box or drop the rule"
            ),
        })
    }

    /// The first piece that has elements in the box of a job.
    fn find(&self, job: &Job, model: &Model) -> Result<Option<(usize, Region)>> {
        for &part in &self.progress[job.rule].pieces {
            match &model.parts[part] {
                Part::Continuum(body) if !cells_in(&body.mesh, &job.block).is_empty() => {
                    return Ok(Some((part, Region::in_box(body, job.block)?)));
                }
                _ => {}
            }
        }
        Ok(None)
    }

    fn replace(
        &mut self,
        index: usize,
        part: usize,
        region: Region,
        (model, state): (&mut Model, &mut State),
        factor: f64,
        work: &mut Work,
    ) -> Result<(String, SwitchReport)> {
        let rule = &self.rules[index];
        let filled = &mut self.progress[index].filled;
        filled.push(region.block);
        let name = match filled.len() {
            1 => rule.name.clone(),
            several => format!("{}-{several}", rule.name),
        };
        let switch = Switch {
            part,
            region,
            name: name.clone(),
            fill: rule.fill,
            method: rule.method,
            multipliers: rule.multipliers,
            rotations: rule.rotations,
            mode: rule.mode,
            finite: rule.finite,
        };
        let mut switched = substitute(model, state, &switch, factor, work)?;
        admit(&switched.model, &mut switched.state, work)?;
        for progress in &mut self.progress {
            let is_piece = |origin: &Origin| match origin {
                Origin::Kept(old) | Origin::Piece { part: old, .. } => progress.pieces.contains(old),
                Origin::Filled => false,
            };
            let new = switched.origins.iter().enumerate().filter(|(_, o)| is_piece(o));
            progress.pieces = new.map(|(p, _)| p).collect();
        }
        (*model, *state) = (switched.model, switched.state);
        Ok((name, switched.report))
    }
}

/// Box around points; `None` without any.
fn bounds<'p>(points: impl IntoIterator<Item = &'p Vec3>) -> Option<Block> {
    points.into_iter().map(|&x| Block { min: x, max: x }).reduce(|a, b| a.around(&b))
}

/// The body of elements of a rule.
///
/// # Errors
/// A body that is not there, or not of elements.
pub(super) fn body_of<'m>(model: &'m Model, rule: &SwitchRule) -> Result<&'m Continuum> {
    let refuse = |message: String| Error::Switch { what: format!("rule '{}'", rule.name), message };
    match model.parts.iter().find(|p| p.name() == rule.body) {
        Some(Part::Continuum(body)) => Ok(body),
        Some(Part::Discrete { .. }) => {
            Err(refuse(format!("body '{}' is of particles already; name one of elements", rule.body)))
        }
        None => {
            let names: Vec<&str> = model.parts.iter().map(Part::name).collect();
            Err(refuse(format!("there is no body '{}'; there are: {}", rule.body, names.join(", "))))
        }
    }
}
