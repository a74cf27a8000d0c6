//! The lattice of a whole body, filled in by boxes.

use super::calibration::{Target, Unit};
use super::particles::{Filled, Made, bonded, lattice_kind, limit, recipe};
use super::{Context, Refusal};
use crate::error::Fault;
use crate::scene::body::Body;
use crate::scene::de::De;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bonding::BondRecipe;
use seam_solver::dem::lattice::{Fit, LatticeKind, fit, lattice};
use seam_solver::error::Error;
use seam_solver::space::Vec3;

/// The lattice of a whole body, of which boxes can be filled: particles of all boxes sit in the same places.
pub struct Blueprint {
    kind: LatticeKind,
    whole: Block,
    /// Sides of a cell, in m.
    cell: Vec3,
    matter: Matter,
    recipe: BondRecipe,
    /// The table that holds the section `de`.
    key: String,
}

/// A box may miss the lines of the lattice by this share of a cell: rounding.
const OFF_LINE: f64 = 1e-6;

impl Blueprint {
    /// Lays the lattice and calibrates its bonds; `key` is the table that holds the section `de`.
    pub fn new(
        context: &Context,
        key: &str,
        (body, de): (&Body, &De),
        whole: Block,
        notes: &mut Vec<String>,
    ) -> Result<Self, Refusal> {
        let Some(kind) = lattice_kind(de) else {
            let message = "a region that grows is filled anew, and a random packing would not be the same";
            return Err(Fault::new(format!("{key}.de.arrangement"), message, "take a lattice").into());
        };
        let elasticity = context.elasticity(body)?;
        let matter = Matter { density: elasticity.density, thickness_m: context.hypothesis.thickness() };
        let rows = de.rows.count(context.values, 1, &format!("{key}.de.rows"))?;
        let Fit { stretch, cell, spacing, .. } = fit(kind, whole, rows)?;
        let made = Made::Lattice(Unit { kind, spacing, stretch });
        let target = Target { elasticity, hypothesis: context.hypothesis, thickness_m: matter.thickness_m };
        let recipe = recipe(context, key, de, &made, &target, notes)?;
        Ok(Blueprint { kind, whole, cell, matter, recipe, key: key.to_owned() })
    }

    /// Fills a box between lines of the lattice.
    pub fn fill(&self, context: &Context, block: &Block) -> Result<Filled, Refusal> {
        let shifted = matches!(self.kind, LatticeKind::Triangular | LatticeKind::TriangularZigzag);
        for axis in 0..context.space.dim() {
            for (end, x) in [block.min[axis], block.max[axis]].into_iter().enumerate() {
                let cells = (x - self.whole.min[axis]) / self.cell[axis];
                // Every other row of a triangular lattice is shifted: boxes begin with one that is not.
                let step = if end == 0 && axis == 1 && shifted { 2.0 } else { 1.0 };
                if (cells / step - (cells / step).round()).abs() * step > OFF_LINE {
                    return Err(Error::Switch {
                        what: "region".to_owned(),
                        message: format!(
                            "its face at {} = {x:.6} m lies {cells:.3} cells of the lattice ({:.6} m each) from the end of the body; \
                             put the lines of the mesh on whole cells (triangular rows: even ones below)",
                            ["x", "y", "z"][axis],
                            self.cell[axis]
                        ),
                    }
                    .into());
                }
            }
        }
        let rows = (block.sides().y / self.cell.y).round() as usize;
        let lattice = lattice(self.kind, *block, rows, self.matter)?;
        limit(context, &self.key, &lattice.arrangement)?;
        bonded(context, &lattice.arrangement, &lattice.pairs, &self.recipe)
    }
}
