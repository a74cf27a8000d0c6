//! What a model must satisfy before it is solved.

use crate::error::{Error, Result};
use crate::fem::locate::Locator;
use crate::model::{Model, Part, PointValue};
use crate::space::Vec3;

/// Bodies may penetrate by this share of their size before they count as overlapping: rounding, not geometry.
const TOUCH: f64 = 1e-6;

/// Checks indices, values and that no two bodies overlap.
///
/// # Errors
/// The first thing that does not fit.
pub fn model(model: &Model) -> Result<()> {
    if model.parts.is_empty() {
        return Err(Error::Geometry {
            what: "model".to_owned(),
            message: "it has no bodies; add one".to_owned(),
        });
    }
    for part in &model.parts {
        if part.space() != model.space {
            return Err(misfit(
                part,
                format!("it is {:?}, the model {:?}; bodies must share one space", part.space(), model.space),
            ));
        }
        if part.positions().is_empty() {
            return Err(misfit(part, format!("it has no {}s", part.noun())));
        }
        if let Some(i) = part.positions().iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            return Err(misfit(part, format!("{} {i} has a position that is not finite", part.noun())));
        }
    }
    for (what, values) in [("support", &model.supports), ("load", &model.loads)] {
        values.iter().try_for_each(|v| point_value(model, what, v))?;
    }
    overlaps(model)
}

fn misfit(part: &Part, message: String) -> Error {
    Error::Geometry { what: format!("body '{}'", part.name()), message }
}

fn point_value(model: &Model, what: &str, v: &PointValue) -> Result<()> {
    let Some(part) = model.parts.get(v.part) else {
        return Err(Error::Geometry {
            what: what.to_owned(),
            message: format!("there is no part {}", v.part),
        });
    };
    if v.point >= part.positions().len() {
        return Err(misfit(
            part,
            format!("a {what} names {} {}, but it has {}", part.noun(), v.point, part.positions().len()),
        ));
    }
    if v.component >= part.dofs_per_point() {
        return Err(misfit(
            part,
            format!(
                "a {what} acts on component {}, but a {} has {}",
                v.component,
                part.noun(),
                part.dofs_per_point()
            ),
        ));
    }
    if !v.value.is_finite() {
        return Err(misfit(part, format!("the {what} on {} {} is not finite", part.noun(), v.point)));
    }
    Ok(())
}

fn overlaps(model: &Model) -> Result<()> {
    let boxes: Vec<(Vec3, Vec3)> = model.parts.iter().map(bounds).collect();
    for b in 1..model.parts.len() {
        for a in 0..b {
            let low = boxes[a].0.sup(&boxes[b].0);
            let high = boxes[a].1.inf(&boxes[b].1);
            let size = (boxes[a].1 - boxes[a].0).norm().min((boxes[b].1 - boxes[b].0).norm());
            let overlap = (0..model.space.dim()).map(|i| high[i] - low[i]).fold(f64::MAX, f64::min);
            if overlap <= TOUCH * size {
                continue;
            }
            let (first, second) = (&model.parts[a], &model.parts[b]);
            let meet = match (first, second) {
                (Part::Discrete { .. }, Part::Discrete { .. }) => true,
                _ => inside(first, second, TOUCH * size) || inside(second, first, TOUCH * size),
            };
            if meet {
                return Err(Error::Overlap {
                    first: first.name().to_owned(),
                    second: second.name().to_owned(),
                    overlap,
                });
            }
        }
    }
    Ok(())
}

fn bounds(part: &Part) -> (Vec3, Vec3) {
    let start = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    part.positions().iter().fold(start, |(low, high), x| (low.inf(x), high.sup(x)))
}

/// Whether a point or cell centre of `part` lies inside the elements of `body`, deeper than `touch`.
fn inside(part: &Part, body: &Part, touch: f64) -> bool {
    let Part::Continuum(body) = body else { return false };
    let locator = Locator::new(&body.mesh);
    // Off along the diagonals: at a re-entrant corner of the elements every axis still leads into or along them.
    let dim = body.mesh.space.dim();
    let off = |corner: usize| {
        Vec3::from_fn(|i, _| {
            if i >= dim {
                0.0
            } else if corner >> i & 1 == 0 {
                touch
            } else {
                -touch
            }
        })
    };
    let deep = |x: &Vec3| {
        locator.find(*x).is_some() && (0..1 << dim).all(|corner| locator.find(x + off(corner)).is_some())
    };
    let centres = match part {
        Part::Continuum(c) => {
            (0..c.mesh.cell_count()).map(|i| centre(c.mesh.cell(i), &c.mesh.nodes)).collect()
        }
        Part::Discrete { .. } => Vec::new(),
    };
    part.positions().iter().chain(&centres).any(deep)
}

fn centre(cell: &[usize], nodes: &[Vec3]) -> Vec3 {
    cell.iter().map(|&n| nodes[n]).sum::<Vec3>() / cell.len() as f64
}
