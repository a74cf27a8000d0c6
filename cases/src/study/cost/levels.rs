//! Resolutions of a study: a key at several values, or all divisions and rows times a factor.

use super::super::{at_level, level_name, resolution};
use crate::file::SceneFile;
use crate::overrides::{Override, label};
use crate::scene::Scene;
use crate::scene::number::Number;
use crate::scene::study::{CostDeclaration, Levels};
use serde_json::{Value, json};

/// Fewest levels of a study.
const LEAST: usize = 4;
/// Factors where a scene names no resolution.
const FACTORS: [f64; LEAST] = [0.5, 1.0, 2.0, 4.0];

/// What is refined.
pub enum Resolution {
    /// A key that the scene itself refines.
    Key(Levels),
    /// Every count of cells and rows.
    Factor,
}

impl Resolution {
    /// The key of the scene's own diagrams, refinement studies or reference model, else everything by a factor.
    pub fn of(scene: &Scene) -> Self {
        let of_costs = scene.costs.values().map(|c| &c.levels);
        let of_convergence = scene.convergence.values().map(|c| &c.levels);
        let of_reference = scene.reference.iter().map(|r| &r.levels);
        let found = of_costs.chain(of_convergence).chain(of_reference).find(|levels| numbers(levels));
        found.map_or(Self::Factor, |levels| Self::Key(at_least_four(levels)))
    }

    /// That of one diagram: its own levels where there are enough of them, else those of another diagram over the same key.
    pub fn of_diagram(scene: &Scene, declared: &CostDeclaration) -> Self {
        let enough = |levels: &&Levels| levels.values.len() >= LEAST && numbers(levels);
        let others = scene.costs.values().map(|c| &c.levels).filter(|l| l.key == declared.levels.key);
        match std::iter::once(&declared.levels).chain(others).find(enough) {
            Some(levels) => Self::Key(levels.clone()),
            None if numbers(&declared.levels) => Self::Key(at_least_four(&declared.levels)),
            None => Self::of(scene),
        }
    }

    /// Number of levels.
    pub fn len(&self) -> usize {
        match self {
            Self::Key(levels) => levels.values.len(),
            Self::Factor => FACTORS.len(),
        }
    }

    /// Rows and divisions at a level, up to a factor.
    pub fn size(&self, index: usize) -> f64 {
        match self {
            Self::Key(levels) => levels.values[index].as_f64().unwrap_or(1.0),
            Self::Factor => FACTORS[index],
        }
    }

    /// Name of a level and what makes it; `file` has the setting applied.
    pub fn level(&self, file: &SceneFile, index: usize) -> (String, Vec<Override>) {
        match self {
            Self::Key(levels) => {
                let value = &levels.values[index];
                (level_name(levels, value), vec![at_level(levels, value)])
            }
            Self::Factor => {
                let factor = FACTORS[index];
                (format!("{factor} × the scene"), scaled(&file.scene, factor))
            }
        }
    }

    /// What makes a level finer than all: the reference where a scene has none.
    pub fn beyond(&self, file: &SceneFile) -> (String, Vec<Override>) {
        match self {
            Self::Key(levels) => {
                let last = levels.values.last().and_then(Value::as_f64).unwrap_or(1.0);
                let value = whole(2.0 * last);
                (level_name(levels, &value), vec![at_level(levels, &value)])
            }
            Self::Factor => {
                let factor = 2.0 * FACTORS[LEAST - 1];
                (format!("{factor} × the scene"), scaled(&file.scene, factor))
            }
        }
    }
}

/// The declared levels, and more by doubling the finest: four points make a line worth looking at.
fn at_least_four(levels: &Levels) -> Levels {
    let mut values = levels.values.clone();
    while values.len() < LEAST {
        let last = values.last().and_then(Value::as_f64).unwrap_or(1.0);
        values.push(whole(2.0 * last));
    }
    Levels { key: levels.key.clone(), values }
}

/// Whether a key is refined in numbers, at least twice.
fn numbers(levels: &Levels) -> bool {
    levels.values.len() > 1 && levels.values.iter().all(|v| resolution(v).is_some())
}

/// A count is written as one: 32, not 32.0.
fn whole(value: f64) -> Value {
    if value.fract() == 0.0 && value < 1e15 { json!(value as u64) } else { json!(value) }
}

/// Every count of cells and rows of particles times a factor, at least one.
fn scaled(scene: &Scene, factor: f64) -> Vec<Override> {
    let mut changes = Vec::new();
    let mut scale = |key: String, number: &Number| {
        let value = json!(format!("max(1, round(({})*{factor}))", text(number)));
        changes.push(Override { key, value });
    };
    for (name, body) in &scene.bodies {
        if let Some(fe) = &body.fe {
            let divisions = fe.divisions.iter().enumerate();
            divisions.for_each(|(i, n)| scale(format!("bodies.{name}.fe.divisions[{i}]"), n));
        }
        if let Some(de) = &body.de {
            scale(format!("bodies.{name}.de.rows"), &de.rows);
        }
    }
    for (name, switch) in &scene.switches {
        scale(format!("switches.{name}.de.rows"), &switch.de.rows);
    }
    changes
}

/// A number as it stands in an expression.
pub fn text(number: &Number) -> String {
    serde_json::to_value(number).map_or(String::new(), |value| label(&value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    #[test]
    fn levels_beyond_the_declared_ones_are_whole_and_a_short_diagram_takes_those_of_a_long_one() {
        let levels = |values: &[f64]| Levels {
            key: "parameters.rows".to_owned(),
            values: values.iter().map(|v| whole(*v)).collect(),
        };
        assert_eq!(at_least_four(&levels(&[4.0, 8.0])).values, [json!(4), json!(8), json!(16), json!(32)]);
        assert_eq!(at_least_four(&levels(&[0.5, 1.5])).values[3], json!(6));
        let ramp = catalogue::case("ramp-transfer", &[]).unwrap().scene;
        let of = |name: &str| match Resolution::of_diagram(&ramp, &ramp.costs[name]) {
            Resolution::Key(levels) => levels.values,
            Resolution::Factor => panic!("'{name}' declares levels"),
        };
        assert_eq!(of("rates"), of("deflection"));
        assert_eq!(of("deflection"), ramp.costs["deflection"].levels.values);
    }

    #[test]
    fn a_scene_is_refined_by_its_own_key_or_as_a_whole() {
        let beam = catalogue::case("clamped-beam-rotation", &[]).unwrap();
        let Resolution::Key(levels) = Resolution::of(&beam.scene) else { panic!("it declares levels") };
        assert_eq!((levels.key.as_str(), levels.values.len()), ("parameters.rows", 4));
        // Without any study the counts themselves are scaled, and the scene still reads.
        let mut bare = beam.clone();
        bare.scene.costs.clear();
        bare.scene.reference = None;
        bare.scene.convergence.clear();
        assert!(matches!(Resolution::of(&bare.scene), Resolution::Factor));
        let (_, changes) = Resolution::Factor.level(&beam, 2);
        let finer = beam.with(&changes).unwrap();
        let rows = |file: &SceneFile| {
            file.scene.bodies["middle"].de.as_ref().unwrap().rows.count(&file.values, 1, "").unwrap()
        };
        assert_eq!([rows(&beam), rows(&finer)], [8, 16]);
    }
}
