//! Observations and curves that several procedures share.

use crate::result::{Observation, Plot, Role, Series};

/// A value beside an exact one, accepted within a relative distance.
pub fn exact(
    [id, label, unit]: [&str; 3],
    value: f64,
    reference: f64,
    relative: f64,
    [why, source]: [&str; 2],
) -> Observation {
    let half = (relative * reference).abs();
    Observation {
        reference: Some(reference),
        ..within([id, label, unit], value, [reference - half, reference + half], [why, source])
    }
}

/// A value that must lie in an interval.
pub fn within(
    [id, label, unit]: [&str; 3],
    value: f64,
    accepted: [f64; 2],
    [why, source]: [&str; 2],
) -> Observation {
    Observation {
        id: id.to_owned(),
        label: label.to_owned(),
        unit: unit.to_owned(),
        value,
        source: source.to_owned(),
        accepted: Some(accepted),
        why: why.to_owned(),
        ..Observation::default()
    }
}

/// A plot without band and shading.
pub fn plot([id, title, x_label, y_label]: [&str; 4], log: [bool; 2], series: Vec<Series>) -> Plot {
    Plot {
        id: id.to_owned(),
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        log,
        series,
        ..Plot::default()
    }
}

/// One line or cloud of dots.
pub fn series(name: &str, role: Role, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
    let (x, y) = points.into_iter().unzip();
    Series { name: name.to_owned(), role, x, y }
}
