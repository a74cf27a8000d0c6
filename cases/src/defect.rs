//! Seams at which a defect can be put into a run, for testing that its checks find it.
//!
//! A scene carries at most one [`Defect`], and none unless `seam selftest` seeds it. Defects are done to what has
//! been built, solved or read, never inside a loop: without one a run passes a handful of tests for `None`.

use crate::file::SceneFile;
use seam_references::Reference;
use seam_solver::dem::network::Network;
use seam_solver::model::Model;
use seam_solver::simulation::Plan;
use seam_solver::solve::statics::Solution;

/// What a defect is done to.
#[derive(Debug, Clone, Copy)]
pub enum Defect {
    /// A model that has been built, before it is solved.
    Model(fn(&mut Model)),
    /// An equilibrium, before it is read.
    Solution(fn(&Model, &mut Solution)),
    /// A run in time with its switches, before it starts.
    Plan(fn(&mut Plan)),
    /// The particles that come with a switch, or a periodic cell.
    Network(fn(&mut Network)),
    /// The matrix of a bond: 12 × 12 on `u₁, θ₁, u₂, θ₂`, by rows.
    Bond(fn(&mut [[f64; 12]; 12])),
    /// A reference, before it is opened.
    Reference(fn(&mut Reference)),
}

/// Does the defect of a scene to a thing, if it has one of this kind.
macro_rules! seam {
    ($name:ident, $kind:ident, $thing:ty) => {
        pub(crate) fn $name(&self, thing: &mut $thing) {
            if let Some(Defect::$kind(spoil)) = self.defect {
                spoil(thing);
            }
        }
    };
}

impl SceneFile {
    seam!(spoil_model, Model, Model);
    seam!(spoil_plan, Plan, Plan);
    seam!(spoil_network, Network, Network);
    seam!(spoil_bond, Bond, [[f64; 12]; 12]);
    seam!(spoil_reference, Reference, Reference);

    pub(crate) fn spoil_solution(&self, model: &Model, solution: &mut Solution) {
        if let Some(Defect::Solution(spoil)) = self.defect {
            spoil(model, solution);
        }
    }

    /// The same scene with a defect, in all runs that it makes.
    #[must_use]
    pub fn with_defect(mut self, defect: Defect) -> Self {
        self.defect = Some(defect);
        self
    }

    /// The same scene with these quantities alone, and its claims if they are wanted: no other studies or diagrams.
    #[must_use]
    pub fn trimmed(mut self, quantities: &[&str], claims: bool) -> Self {
        let scene = &mut self.scene;
        scene.quantities.retain(|name, _| quantities.contains(&name.as_str()));
        scene.convergence.clear();
        scene.budgets.clear();
        scene.costs.clear();
        if !claims {
            scene.claims.clear();
            scene.families.clear();
        }
        self
    }
}
