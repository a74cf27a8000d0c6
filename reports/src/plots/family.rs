//! Error against number of particles over a family of settings.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::claims::decides::{READING, words};
use crate::format::percent;
use crate::results::ClaimResult;
use seam_cases::result::{Family, Member};
use std::collections::BTreeSet;

/// The members of a family under its main reading, coloured by the axis that decides, with the bounds of the
/// claim and of an own claim that is held to it; `None` if there is nothing to draw.
pub fn scatter(family: &Family, claim: &ClaimResult, own: Option<&Family>) -> Option<Figure> {
    let axis = claim.decides.iter().map(|e| e.axis.as_str()).find(|a| *a != READING);
    let reading = &family.main_reading;
    let mine = points(family.members.iter(), reading);
    let theirs = own.map_or(Vec::new(), |o| points(o.members.iter(), &o.main_reading));
    let all = || mine.iter().chain(&theirs);
    let bounds = [Some(family), own].into_iter().flatten().map(|f| 100.0 * f.bound);
    let x = Axis::over("particles (1)", true, all().map(|p| p[0]))?;
    let y = Axis::over("error (%)", true, all().map(|p| p[1]).chain(bounds))?;
    let mut layers = vec![bound(Ink::Bound, family.bound, x.range)];
    let mut legend =
        vec![LegendEntry::line(Ink::Bound, format!("bound of the claim, {}", percent(family.bound)))];
    for (i, value) in values(family, axis).into_iter().enumerate() {
        let has = |m: &&Member| axis.is_none_or(|a| m.settings.get(a) == Some(&value));
        let points = points(family.members.iter().filter(has), reading);
        let name = axis.map_or("members".to_owned(), |a| format!("{} {value}", words(a)));
        legend.push(LegendEntry::dot(Ink::series(i), name));
        layers.push(Layer::Dots { ink: Ink::series(i), points, radius: 8 });
    }
    if let Some(own) = own {
        layers.push(bound(Ink::OwnBound, own.bound, x.range));
        legend.push(LegendEntry::line(
            Ink::OwnBound,
            format!("bound of our own claim, {}", percent(own.bound)),
        ));
        legend.push(LegendEntry::dot(Ink::Own, "members of our own claim"));
        layers.push(Layer::Dots { ink: Ink::Own, points: theirs, radius: 10 });
    }
    let title = format!("Error against particles: {}", family.claim);
    let meaning = family.readings.get(reading).map_or(reading.as_str(), String::as_str);
    let description = format!("{} of {} members; {meaning}", mine.len(), family.members.len());
    let note = gaps(family, meaning);
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

fn points<'a>(members: impl Iterator<Item = &'a Member>, reading: &str) -> Vec<[f64; 2]> {
    members.filter_map(|m| Some([m.particles as f64, 100.0 * m.errors.get(reading)?])).collect()
}

/// Values of the axis in the order of its declaration, then any that were not declared.
fn values(family: &Family, axis: Option<&str>) -> Vec<String> {
    let Some(axis) = axis else { return vec![String::new()] };
    let used: BTreeSet<&String> = family.members.iter().filter_map(|m| m.settings.get(axis)).collect();
    let declared = family.axes.get(axis).map_or(&[][..], Vec::as_slice);
    let mut values: Vec<String> = declared.iter().filter(|v| used.contains(v)).cloned().collect();
    let others: Vec<String> = used.into_iter().filter(|v| !declared.contains(v)).cloned().collect();
    values.extend(others);
    values
}

fn bound(ink: Ink, bound: f64, [left, right]: [f64; 2]) -> Layer {
    let at = 100.0 * bound;
    Layer::Line { ink, points: vec![[left, at], [right, at]] }
}

fn gaps(family: &Family, meaning: &str) -> String {
    let failed = family.members.iter().filter(|m| m.failed.is_some()).count();
    let gaps =
        if failed > 0 { format!(" {failed} could not be run and are missing here.") } else { String::new() };
    format!("Reading: {meaning}.{gaps}")
}
