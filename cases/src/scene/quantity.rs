//! `[quantities.NAME]`: a number to be judged, what it is compared with, and how close it must be.

use super::Tier;
use super::number::Number;
use crate::error::Fault;
use crate::result::ReferenceKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A number read off the solution: the value of a scalar probe, or the error of a curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// What it is, in words.
    pub label: String,
    /// SI unit, `1` for a pure number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Name of the probe.
    pub probe: String,
    /// When it is measured.
    #[serde(default = "super::both_tiers")]
    pub tiers: Vec<Tier>,
    /// Variants of the scene it is read off; the scene itself if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
    /// Measure it once for every combination of one variant of each of these lists: as a quantity `NAME-variant-variant…` of its own, with
    /// the combination before `variants`, and before the variants of its reference.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub across: Vec<Vec<String>>,
    /// Histories only: which of its values; the one at the end if neither this nor `norm` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub take: Option<Take>,
    /// Curves and histories only: how its distance from the reference model is measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub norm: Option<Norm>,
    /// With `norm` only: where, or when.
    #[serde(default)]
    pub zone: Zone,
    /// Take the value extrapolated from the levels of a convergence study of this quantity.
    #[serde(default)]
    pub extrapolated: bool,
    /// Take the value over that of the reference, a pure number: a tenth of the work.
    #[serde(default)]
    pub as_share: bool,
    /// What it is compared with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<Reference>,
    /// How close it must be; without it the number is shown and not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accept: Option<Accept>,
}

/// Distance between a curve s and its reference r, as a fraction. Histories are compared at the reference's times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    /// `max |s−r|/|r|` over the stations where `|r|` is at least 5 % of its largest value.
    Pointwise,
    /// `max |s−r| / max |r|`.
    Largest,
    /// `Σ (s−r) sgn r / Σ |r|`: positive where s is larger, and linear in s, so that parts add up.
    Mean,
    /// Crack paths only: Hausdorff distance of the two sets of places, `max(max min |a−b|, max min |b−a|)`, in m.
    Hausdorff,
}

/// One value of a history.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Take {
    /// The last one.
    #[default]
    End,
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
    /// The one farthest from zero, with its sign.
    LargestMagnitude,
}

/// Part of a curve.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Zone {
    /// All stations.
    #[default]
    Whole,
    /// Lines: stations inside bodies that have a `de` section and boxes of switches.
    De,
    /// Histories: times after the first switch.
    AfterSwitch,
    /// Histories: the last time.
    End,
}

impl Zone {
    /// Whether it is a part of time rather than of space.
    pub fn is_time(self) -> bool {
        matches!(self, Self::AfterSwitch | Self::End)
    }
}

/// A reference value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Where it comes from.
    pub kind: ReferenceKind,
    /// The value; computed by the scene's `[reference]` model if neither this nor `variants` nor `peer` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Number>,
    /// Read it off the scene itself with these variants: with kind `own-run`, a difference and not an accuracy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variants: Option<Vec<String>>,
    /// Read it off what another code computed: name of a `[peers.NAME]` of the same kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peer: Option<String>,
    /// Author, year, equation.
    pub source: String,
    /// Standard uncertainty, in the unit of the quantity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Number>,
}

/// Accepted distance from the reference: `|a − ref| ≤ max(relative·|ref|, absolute)`, or an interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Accept {
    /// Share of the reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<Number>,
    /// In the unit of the quantity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub absolute: Option<Number>,
    /// Smallest and largest value, in the unit of the quantity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval: Option<[Number; 2]>,
    /// Why it is as wide as it is.
    pub why: String,
}

/// Puts the members of a grid in the place of each quantity that is measured across lists of variants.
///
/// # Errors
/// A list without variants; a member with the name of another quantity.
pub fn spread(quantities: &mut BTreeMap<String, Quantity>) -> Result<(), Fault> {
    for (name, grid) in quantities.extract_if(.., |_, q| !q.across.is_empty()).collect::<Vec<_>>() {
        let key = format!("quantities.{name}.across");
        if let Some(empty) = grid.across.iter().position(Vec::is_empty) {
            let mend = "name variants, or remove the list";
            return Err(Fault::new(format!("{key}[{empty}]"), "there is nothing to choose from", mend));
        }
        let mut combinations = vec![Vec::new()];
        for list in &grid.across {
            let with = |c: &Vec<String>| {
                list.iter().map(|v| [c.clone(), vec![v.clone()]].concat()).collect::<Vec<_>>()
            };
            combinations = combinations.iter().flat_map(with).collect();
        }
        for combination in combinations {
            let mut member = Quantity { across: Vec::new(), ..grid.clone() };
            member.label = format!("{}, {}", grid.label, combination.join(", "));
            member.variants = [combination.clone(), grid.variants.clone()].concat();
            if let Some(own) = member.reference.as_mut().and_then(|r| r.variants.as_mut()) {
                *own = [combination.clone(), own.clone()].concat();
            }
            let id = format!("{name}-{}", combination.join("-"));
            if quantities.insert(id.clone(), member).is_some() {
                let message = format!("a member of the grid is called '{id}', as another quantity is");
                return Err(Fault::new(key, message, "rename one of them"));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn quantity(more: serde_json::Value) -> Quantity {
        let mut all = json!({ "label": "Peak", "probe": "peak" });
        all.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        serde_json::from_value(all).unwrap()
    }

    #[test]
    fn a_grid_becomes_its_members() {
        let reference = json!({ "kind": "own-run", "variants": ["whole"], "source": "all" });
        let across = json!([["a", "b"], ["x", "y", "z"]]);
        let grid = quantity(json!({ "across": across, "variants": ["fine"], "reference": reference }));
        let mut all = BTreeMap::from([("peak".to_owned(), grid), ("one".to_owned(), quantity(json!({})))]);
        spread(&mut all).unwrap();
        assert_eq!(all.len(), 7);
        let member = &all["peak-b-z"];
        assert_eq!(member.variants, ["b", "z", "fine"]);
        assert_eq!(member.reference.as_ref().unwrap().variants.as_ref().unwrap(), &["b", "z", "whole"]);
        assert_eq!(member.label, "Peak, b, z");
        assert!(all.values().all(|q| q.across.is_empty()));
    }

    #[test]
    fn a_grid_without_members_or_with_a_taken_name_is_refused() {
        let across = |across: serde_json::Value| quantity(json!({ "across": across }));
        let mut empty = BTreeMap::from([("peak".to_owned(), across(json!([["a"], []])))]);
        assert_eq!(spread(&mut empty).unwrap_err().key, "quantities.peak.across[1]");
        let taken = ("peak-a".to_owned(), quantity(json!({})));
        let mut taken = BTreeMap::from([("peak".to_owned(), across(json!([["a"]]))), taken]);
        assert!(spread(&mut taken).unwrap_err().message.contains("'peak-a'"));
    }
}
