//! Forces of the supports of a scene, also after a switch has handed them to particles.

use crate::model::Built;
use seam_solver::model::{Model, Numbering};
use seam_solver::space::Vec3;

/// A held component at a place, and the name of its support.
struct Hold {
    name: usize,
    component: usize,
    position: Vec3,
}

/// The supports as they are at the start, and the unknowns that they hold now.
pub struct Supports {
    names: Vec<String>,
    holds: Vec<Hold>,
    /// Name and component of each held unknown of the present model.
    now: Vec<(usize, usize, usize)>,
    /// Switches before the present model.
    switches: Option<usize>,
}

impl Supports {
    /// The supports of a model that has just been built.
    pub fn new(built: &Built) -> Self {
        let mut names = built.held_by.clone();
        names.dedup();
        let place = |name: &String| names.iter().position(|n| n == name).unwrap_or(0);
        let holds = built.held_by.iter().zip(&built.model.supports).map(|(name, held)| Hold {
            name: place(name),
            component: held.component,
            position: built.model.parts[held.part].positions()[held.point],
        });
        let holds = holds.collect();
        Self { names, holds, now: Vec::new(), switches: None }
    }

    /// Finds the held unknowns of a model after some switches: each belongs to the support that held the same
    /// component nearest to it at the start.
    pub fn follow(&mut self, model: &Model, switches: usize) {
        if self.switches == Some(switches) {
            return;
        }
        self.switches = Some(switches);
        let numbering = Numbering::new(model);
        let mut now: Vec<(usize, usize, usize)> = Vec::new();
        for held in model.supports.iter().filter(|held| held.component < model.space.dim()) {
            let x = model.parts[held.part].positions()[held.point];
            let same = self.holds.iter().filter(|hold| hold.component == held.component);
            let nearest = same.min_by(|a, b| (a.position - x).norm().total_cmp(&(b.position - x).norm()));
            let unknown = numbering.unknown(held.part, held.point, held.component);
            now.extend(nearest.map(|hold| (unknown, hold.name, held.component)));
        }
        // Two supports may hold one unknown, which has one force.
        now.sort_unstable();
        now.dedup_by_key(|held| held.0);
        self.now = now;
    }

    /// Force of a support along an axis, in N, from the forces on all unknowns.
    pub fn reaction(&self, name: &str, axis: usize, reactions: &[f64]) -> f64 {
        let own = self.now.iter().filter(|held| self.names[held.1] == name && held.2 == axis);
        own.map(|held| reactions[held.0]).sum()
    }
}
