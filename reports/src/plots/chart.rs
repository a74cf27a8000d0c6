//! Axes and layers of a chart, drawn by plotters and turned into classes.

use super::ink::{Ink, classes};
use super::{Figure, LegendEntry, csv_line, open_svg, ticks};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// An axis with its label (unit included) and range.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub label: String,
    pub range: [f64; 2],
    pub log: bool,
    /// Words in place of numbers at 0, 1, 2 …
    pub names: Vec<String>,
}

impl Axis {
    /// Axis over some values with a little room at both ends; `None` if nothing can be drawn on it.
    pub(super) fn over(label: &str, log: bool, values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let usable = values.into_iter().filter(|v| v.is_finite() && (!log || *v > 0.0));
        let place = |v: f64| if log { v.log10() } else { v };
        let range = usable
            .map(place)
            .fold(None, |r: Option<[f64; 2]>, v| Some(r.map_or([v, v], |[lo, hi]| [lo.min(v), hi.max(v)])));
        let [lo, hi] = range?;
        // A single value gets an axis as wide as itself, or one decade.
        let span = if hi > lo {
            hi - lo
        } else if log || hi == 0.0 {
            1.0
        } else {
            hi.abs()
        };
        let room = if log { 0.06 } else { 0.04 } * span + if hi > lo { 0.0 } else { 0.5 * span };
        let back = |v: f64| if log { 10f64.powf(v) } else { v };
        Some(Axis {
            label: label.to_owned(),
            range: [back(lo - room), back(hi + room)],
            log,
            names: Vec::new(),
        })
    }

    /// Where a value stands on the axis.
    fn place(&self, v: f64) -> f64 {
        if self.log { v.log10() } else { v }
    }

    fn ends(&self) -> [f64; 2] {
        self.range.map(|v| self.place(v))
    }

    /// Where the ticks stand, as values.
    fn ticks(&self) -> Vec<f64> {
        let [lo, hi] = self.ends();
        match (self.names.len(), self.log) {
            (0, true) => ticks::logarithmic(lo, hi).into_iter().map(|t| 10f64.powf(t)).collect(),
            (0, false) => ticks::linear(lo.min(hi), lo.max(hi), 6),
            (n, _) => (0..n).map(|i| i as f64).collect(),
        }
    }

    fn tick_label(&self, at: f64) -> String {
        let [lo, hi] = self.ends();
        match (self.names.is_empty(), self.log) {
            (false, _) => self.names.get(at.round() as usize).cloned().unwrap_or_default(),
            (true, true) => ticks::logarithmic_label(at.log10()),
            (true, false) => {
                let ticks = self.ticks();
                ticks::linear_label(at, if ticks.len() > 1 { ticks[1] - ticks[0] } else { hi - lo })
            }
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    /// Place of a value between two pixels; a value beyond the axis is held at its end.
    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let [lo, hi] = self.ends();
        let share = ((self.place(*value) - lo) / (hi - lo)).clamp(0.0, 1.0);
        (f64::from(first) + share * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks()
    }

    fn range(&self) -> Range<f64> {
        self.range[0]..self.range[1]
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        value.to_string()
    }

    fn format_ext(&self, value: &f64) -> String {
        self.tick_label(*value)
    }
}

impl From<Axis> for Range<f64> {
    fn from(axis: Axis) -> Self {
        axis.range()
    }
}

/// Something drawn in a chart, in the values of its axes.
pub(super) enum Layer {
    Line { ink: Ink, points: Vec<[f64; 2]> },
    Dots { ink: Ink, points: Vec<[f64; 2]>, radius: u32 },
    Area { ink: Ink, points: Vec<[f64; 2]> },
    Text { at: [f64; 2], anchor: HPos, text: String },
}

/// A chart: axes, and layers from back to front.
pub(super) struct Chart {
    pub title: String,
    pub description: String,
    pub x: Axis,
    pub y: Axis,
    pub layers: Vec<Layer>,
    /// Height in units of which the width has [`WIDTH`].
    pub height: u32,
    /// Room for the labels at the left.
    pub left: u32,
}

/// Width of every chart. plotters works in whole pixels: this many keep curves smooth.
pub(super) const WIDTH: u32 = 1200;
/// Height of most charts.
pub(super) const HEIGHT: u32 = 700;
/// Room for numbers and a label at the left, at the larger letters of narrow windows.
pub(super) const LEFT: u32 = 200;
const FONT: u32 = 31;

impl Chart {
    /// The chart with its legend, a sentence to take home, and the points of everything the legend names.
    pub(super) fn figure(self, legend: Vec<LegendEntry>, note: String) -> Figure {
        let csv = self.csv(&legend);
        self.figure_of(legend, note, csv)
    }

    /// The same with a table of its own in place of the points.
    pub(super) fn figure_of(self, legend: Vec<LegendEntry>, note: String, csv: String) -> Figure {
        Figure { svg: self.svg(), title: self.title, legend, note, csv }
    }

    /// `series,x,y`, one line per point; a series drawn as a line with dots on it is written once.
    fn csv(&self, legend: &[LegendEntry]) -> String {
        let mut text = csv_line(&["series", &self.x.label, &self.y.label]);
        let mut last: Option<(Ink, &Vec<[f64; 2]>)> = None;
        for layer in &self.layers {
            let (Layer::Line { ink, points } | Layer::Dots { ink, points, .. } | Layer::Area { ink, points }) =
                layer
            else {
                continue;
            };
            let Some(entry) = legend.iter().find(|e| e.ink == ink.class()) else { continue };
            if last.replace((*ink, points)) == Some((*ink, points)) {
                continue;
            }
            for [x, y] in points {
                text += &csv_line(&[&entry.text, &format!("{x:?}"), &format!("{y:?}")]);
            }
        }
        text
    }

    /// The SVG element. A chart that plotters refuses becomes a sentence in its place.
    fn svg(&self) -> String {
        let mut svg = String::new();
        if let Err(message) = self.draw(&mut svg) {
            svg = format!("<svg>\n<text x=\"8\" y=\"24\">{}</text></svg>", super::escape(&message));
        }
        let body = svg.split_once('\n').map_or("", |(_, body)| body);
        open_svg(WIDTH.into(), self.height.into(), &self.title, &self.description) + &classes(body)
    }

    fn draw(&self, svg: &mut String) -> Result<(), String> {
        let root = SVGBackend::with_string(svg, (WIDTH, self.height)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(20)
            .margin_right(32)
            .x_label_area_size(98)
            .y_label_area_size(self.left)
            .build_cartesian_2d(self.x.clone(), self.y.clone())
            .map_err(|e| e.to_string())?;
        let font = ("sans-serif", FONT).into_font();
        let mut mesh = chart.configure_mesh();
        mesh.bold_line_style(Ink::Grid.colour())
            .light_line_style(TRANSPARENT)
            .axis_style(Ink::Axis.colour())
            .label_style(font.clone().color(&Ink::Text.colour()))
            .axis_desc_style(font.clone().color(&Ink::Text.colour()))
            .x_desc(self.x.label.as_str());
        // An empty text would still be one, outside the figure.
        if !self.y.label.is_empty() {
            mesh.y_desc(self.y.label.as_str());
        }
        mesh.draw().map_err(|e| e.to_string())?;
        for layer in &self.layers {
            match layer {
                Layer::Line { ink, points } => {
                    let line = LineSeries::new(self.placed(points), ink.colour().stroke_width(4));
                    chart.draw_series(line).map_err(|e| e.to_string())?;
                }
                Layer::Dots { ink, points, radius } => {
                    let dots = self
                        .placed(points)
                        .into_iter()
                        .map(|p| Circle::new(p, *radius, ink.colour().filled()));
                    chart.draw_series(dots).map_err(|e| e.to_string())?;
                }
                Layer::Area { ink, points } => {
                    let area = Polygon::new(self.placed(points), ink.colour());
                    chart.draw_series([area]).map_err(|e| e.to_string())?;
                }
                Layer::Text { at, anchor, text } => {
                    let style = font.clone().color(&Ink::Text.colour()).pos(Pos::new(*anchor, VPos::Center));
                    chart
                        .draw_series([Text::new(text.clone(), (at[0], at[1]), style)])
                        .map_err(|e| e.to_string())?;
                }
            }
        }
        root.present().map_err(|e| e.to_string())
    }

    /// Points that the axes can show.
    fn placed(&self, points: &[[f64; 2]]) -> Vec<(f64, f64)> {
        let shown = |[x, y]: &&[f64; 2]| self.x.place(*x).is_finite() && self.y.place(*y).is_finite();
        points.iter().filter(shown).map(|[x, y]| (*x, *y)).collect()
    }
}
