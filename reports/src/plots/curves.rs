//! Curves with their reference and its tolerance band, and what is left between them.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::compare::{Tolerance, compare_curves};
use crate::format::percent;
use seam_cases::result::{Plot, Role, Series};

/// The curves of a plot: reference dashed, model solid, data as dots; `None` if there is nothing to draw.
pub fn curves(plot: &Plot) -> Option<Figure> {
    let band = band(plot);
    let all = || plot.series.iter();
    let band_y = band.iter().map(|p| p[1]);
    let x = Axis::over(&plot.x_label, plot.log[0], all().flat_map(|s| s.x.iter().copied()))?;
    let y =
        Axis::over(short(&plot.y_label), plot.log[1], all().flat_map(|s| s.y.iter().copied()).chain(band_y))?;
    let (mut layers, mut legend) = zones(plot, y.range);
    if !band.is_empty() {
        layers.push(Layer::Area { ink: Ink::Band, points: band });
        let width = percent(plot.band.unwrap_or_default());
        legend.push(LegendEntry::area(Ink::Band, format!("reference ± {width}")));
    }
    let (mut models, mut clouds) = (0, 0);
    let mut references = [Ink::Reference].into_iter();
    for series in all() {
        let points = points(series);
        match series.role {
            Role::Reference => {
                let ink = references.next().unwrap_or(Ink::Theory);
                legend.push(LegendEntry::line(ink, &series.name));
                layers.push(Layer::Line { ink, points });
            }
            Role::Model => {
                let ink = Ink::series(models);
                models += 1;
                legend.push(LegendEntry::line(ink, &series.name));
                layers.push(Layer::Line { ink, points });
            }
            Role::Data => {
                // Further clouds are smaller, so that dots on the same place are both seen.
                let (ink, radius) = if clouds == 0 { (Ink::Data, 8) } else { (Ink::series(clouds - 1), 5) };
                clouds += 1;
                legend.push(LegendEntry::dot(ink, &series.name));
                layers.push(Layer::Dots { ink, points, radius });
            }
        }
    }
    let names: Vec<&str> = plot.series.iter().map(|s| s.name.as_str()).collect();
    let description = format!("{} over {}: {}", plot.y_label, plot.x_label, names.join(", "));
    let chart = Chart { title: plot.title.clone(), description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, String::new()))
}

/// What is left of each model after the reference is taken away, in percent of the reference's largest value.
pub fn residuals(plot: &Plot) -> Option<Figure> {
    let reference = plot.series.iter().find(|s| s.role == Role::Reference)?;
    let largest = reference.y.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    let percent_of = |[x, d]: [f64; 2]| [x, 100.0 * d / largest];
    let of_model = |s: &Series| {
        let c = compare_curves((&s.x, &s.y), (&reference.x, &reference.y), 0.0).ok()?;
        Some((s.name.clone(), c.residual.into_iter().map(percent_of).collect::<Vec<_>>()))
    };
    let models: Vec<(String, Vec<[f64; 2]>)> =
        plot.series.iter().filter(|s| s.role == Role::Model).filter_map(of_model).collect();
    if models.is_empty() || largest <= 0.0 {
        return None;
    }
    let all = || models.iter().flat_map(|(_, p)| p.iter());
    let x = Axis::over(&plot.x_label, plot.log[0], all().map(|p| p[0]))?;
    let y = Axis::over("error (% of largest)", false, all().map(|p| p[1]).chain([0.0]))?;
    let (mut layers, mut legend) = zones(plot, y.range);
    layers.push(Layer::Line { ink: Ink::Reference, points: x.range.map(|x| [x, 0.0]).to_vec() });
    for (i, (name, points)) in models.into_iter().enumerate() {
        legend.push(LegendEntry::line(Ink::series(i), name));
        layers.push(Layer::Line { ink: Ink::series(i), points });
    }
    let title = format!("{}: residual", plot.title);
    let description = format!("model minus reference over {}", plot.x_label);
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, String::new()))
}

/// A label that fits beside the axis: its unit alone where the whole is too long and stands in the caption anyway.
fn short(label: &str) -> &str {
    const MOST: usize = 30;
    let unit = label.rfind('(').map_or(label, |at| &label[at..]);
    if label.chars().count() > MOST { unit } else { label }
}

fn points(series: &Series) -> Vec<[f64; 2]> {
    series.x.iter().zip(&series.y).map(|(x, y)| [*x, *y]).collect()
}

/// Outline of the tolerance band around the first reference: there along its upper edge, back along its lower one.
fn band(plot: &Plot) -> Vec<[f64; 2]> {
    let reference = plot.series.iter().find(|s| s.role == Role::Reference);
    let (Some(relative), Some(reference)) = (plot.band, reference) else { return Vec::new() };
    let tolerance = Tolerance { relative, absolute: 0.0 };
    let edge =
        |side: usize| points(reference).into_iter().map(move |[x, r]| [x, tolerance.interval(r)[side]]);
    edge(1).chain(edge(0).rev()).collect()
}

fn zones(plot: &Plot, [bottom, top]: [f64; 2]) -> (Vec<Layer>, Vec<LegendEntry>) {
    let zone = |[a, b]: &[f64; 2]| Layer::Area {
        ink: Ink::Zone,
        points: vec![[*a, bottom], [*b, bottom], [*b, top], [*a, top]],
    };
    let legend = plot.shaded.first().map(|_| LegendEntry::area(Ink::Zone, "discrete elements"));
    (plot.shaded.iter().map(zone).collect(), legend.into_iter().collect())
}
