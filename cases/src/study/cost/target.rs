//! What the error of a setting is of, and what it is measured against.

use super::super::evaluate::{self, Readings, distance};
use super::super::reference::Reference;
use super::super::{Study, variants};
use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::result::{CostDiagram, ReferenceKind};
use crate::scene::quantity::{Norm, Quantity, Zone};
use crate::scene::study::CostDeclaration;
use std::sync::Arc;

/// A quantity and its reference.
pub struct Target {
    quantity: Quantity,
    against: Against,
    /// Time of the first switch of the scene as it is, in s: settings without a switch are read over the same times.
    first_switch: Option<f64>,
}

/// What a setting is compared with.
enum Against {
    /// A given value.
    Value(f64),
    /// The scene's `[reference]` model, made out of each setting.
    OfSetting,
    /// One reference for all settings.
    Fixed(Arc<Reference>),
}

impl Target {
    /// What a declared diagram asks for.
    ///
    /// # Errors
    /// A reference model that fails.
    pub fn declared(study: &Study, declared: &CostDeclaration) -> Result<Self> {
        let quantity = study.file.scene.quantities[&declared.quantity].clone();
        let against = match &declared.reference {
            Some(model) => Against::Fixed(study.library.model(study.file, model, study.tally)?),
            None => given(study, &quantity)?.map_or(Against::OfSetting, Against::Value),
        };
        Self::new(study, quantity, against)
    }

    /// What a scene without a diagram is looked at for: its first quantity with a reference; without one, its first probe
    /// against `finest`.
    ///
    /// # Errors
    /// A scene that reads nothing off; a reference model that fails.
    pub fn found(study: &Study, finest: impl FnOnce() -> Result<(SceneFile, String)>) -> Result<Self> {
        let scene = &study.file.scene;
        let independent =
            |q: &&Quantity| q.reference.as_ref().is_none_or(|r| r.kind != ReferenceKind::OwnRun);
        let plain = |q: &&Quantity| q.variants.is_empty() && q.norm != Some(Norm::Mean);
        for quantity in scene.quantities.values().filter(independent).filter(plain) {
            if let Some(value) = given(study, quantity)? {
                return Self::new(study, quantity.clone(), Against::Value(value));
            }
            if scene.reference.is_some() && (quantity.norm.is_some() || quantity.reference.is_some()) {
                return Self::new(study, quantity.clone(), Against::OfSetting);
            }
        }
        let Some((name, probe)) = scene.probes.iter().next() else {
            let message = "there is nothing to measure an error of; add a [probes.NAME] table, best with a [quantities.NAME] \
                           that has a reference";
            return Err(Error::Study { case: scene.id.clone(), message: message.to_owned() });
        };
        let curve = probe.line.is_some() || probe.is_history();
        let quantity = Quantity {
            label: if probe.title.is_empty() { name.clone() } else { probe.title.clone() },
            unit: None,
            probe: name.clone(),
            tiers: scene.tiers.clone(),
            variants: Vec::new(),
            across: Vec::new(),
            take: None,
            norm: curve.then_some(Norm::Largest),
            zone: Zone::Whole,
            extrapolated: false,
            as_share: false,
            reference: None,
            accept: None,
        };
        let (file, about) = finest()?;
        let reference = study.library.own_run(&file, &about, study.tally)?;
        Self::new(study, quantity, Against::Fixed(reference))
    }

    fn new(study: &Study, quantity: Quantity, against: Against) -> Result<Self> {
        let switched = quantity.zone == Zone::AfterSwitch;
        let first_switch =
            if switched { evaluate::solve(study.file, study.tally)?.readings.first_switch() } else { None };
        Ok(Self { quantity, against, first_switch })
    }

    /// Error of a setting, as a fraction of the reference.
    ///
    /// # Errors
    /// A reference model that fails; nothing to compare, or a reference of zero.
    pub fn error(&self, study: &Study, file: &SceneFile, readings: Readings) -> Result<f64> {
        let own_switch = readings.first_switch();
        let readings = readings.counted_from(own_switch.or(self.first_switch));
        let reference = match &self.against {
            Against::Value(_) => None,
            Against::OfSetting => Some(study.library.of(file, study.tally)?),
            Against::Fixed(reference) => Some(Arc::clone(reference)),
        };
        let found = match (self.quantity.norm, reference) {
            (Some(norm), Some(reference)) => {
                let what = (self.quantity.probe.as_str(), norm, self.quantity.zone);
                distance(file, &readings, &reference, what).map(f64::abs)
            }
            (Some(_), None) => None,
            (None, reference) => {
                let computed =
                    reference.and_then(|r| r.estimate(&self.quantity)).map(|estimate| estimate.value);
                let exact = computed.or(self.value());
                readings
                    .value(&self.quantity)
                    .zip(exact)
                    .map(|(value, exact)| ((value - exact) / exact).abs())
            }
        };
        found.filter(|error| error.is_finite()).ok_or_else(|| {
            let message = format!(
                "'{}' has no relative error here: no station, or a reference of zero",
                self.quantity.label
            );
            Error::Study { case: file.scene.id.clone(), message }
        })
    }

    fn value(&self) -> Option<f64> {
        if let Against::Value(value) = self.against { Some(value) } else { None }
    }

    /// A diagram without points: what its error is, and what the scene's claims say about it.
    pub fn head(&self, study: &Study) -> CostDiagram {
        let scene = &study.file.scene;
        let mut claimed: Vec<f64> = scene.claims.values().filter(|c| !c.own).map(|c| c.bound).collect();
        claimed.sort_by(f64::total_cmp);
        claimed.dedup();
        let reference = match &self.against {
            Against::Value(_) => self.quantity.reference.as_ref().map_or(String::new(), |r| r.source.clone()),
            Against::OfSetting => scene.reference.as_ref().map_or(String::new(), |r| r.about.clone()),
            Against::Fixed(reference) => reference.about.clone(),
        };
        CostDiagram { error_label: self.quantity.label.clone(), reference, claimed, ..CostDiagram::default() }
    }
}

/// The value that a quantity is given to compare with.
fn given(study: &Study, quantity: &Quantity) -> Result<Option<f64>> {
    let Some(number) = quantity.reference.as_ref().and_then(|r| r.value.as_ref()) else { return Ok(None) };
    let file = study.file.with(&variants(study.file, &quantity.variants))?;
    let value = number.value(&file.values, "quantities");
    value.map(Some).map_err(|fault| file.error(fault))
}
