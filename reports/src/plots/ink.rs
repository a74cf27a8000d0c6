//! What a line or area stands for; the page turns it into a colour.

use plotters::style::RGBColor;

/// Meaning of a line, dot or area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// Text and tick labels.
    Text,
    /// Axes.
    Axis,
    /// Grid lines.
    Grid,
    /// The reference: dashed.
    Reference,
    /// A second reference beside the first: dotted.
    Theory,
    /// Data: dots.
    Data,
    /// A tolerance band.
    Band,
    /// A shaded part of the abscissa.
    Zone,
    /// A bound that must not be passed: dotted.
    Bound,
    /// The bound of an own claim: dotted.
    OwnBound,
    /// Members of an own claim's family.
    Own,
    /// A part that raises a sum.
    Rise,
    /// A part that lowers a sum.
    Fall,
    /// A sum.
    Total,
    /// Part of a map: a run that stayed bounded.
    Bounded,
    /// Part of a map: a run that was refused, though it would stay bounded.
    Cautious,
    /// Part of a map: a run that was refused.
    Refused,
    /// Part of a map: a run that was stopped.
    Stopped,
    /// Part of a map: a run that went wrong and nothing said so.
    Silent,
    /// Series 0 to 5, in an order of colours that stay apart for colour-blind readers.
    Series(u8),
}

/// Every ink, so that colours can be turned back into classes.
const ALL: [Ink; 25] = [
    Ink::Text,
    Ink::Axis,
    Ink::Grid,
    Ink::Reference,
    Ink::Theory,
    Ink::Data,
    Ink::Band,
    Ink::Zone,
    Ink::Bound,
    Ink::OwnBound,
    Ink::Own,
    Ink::Rise,
    Ink::Fall,
    Ink::Total,
    Ink::Bounded,
    Ink::Cautious,
    Ink::Refused,
    Ink::Stopped,
    Ink::Silent,
    Ink::Series(0),
    Ink::Series(1),
    Ink::Series(2),
    Ink::Series(3),
    Ink::Series(4),
    Ink::Series(5),
];

impl Ink {
    /// Ink of the n-th series; after the sixth they repeat.
    pub fn series(n: usize) -> Self {
        Ink::Series((n % 6) as u8)
    }

    /// CSS class.
    pub fn class(self) -> &'static str {
        match self {
            Ink::Text => "ink-text",
            Ink::Axis => "ink-axis",
            Ink::Grid => "ink-grid",
            Ink::Reference => "ink-reference",
            Ink::Theory => "ink-theory",
            Ink::Data => "ink-data",
            Ink::Band => "ink-band",
            Ink::Zone => "ink-zone",
            Ink::Bound => "ink-bound",
            Ink::OwnBound => "ink-own-bound",
            Ink::Own => "ink-own",
            Ink::Rise => "ink-rise",
            Ink::Fall => "ink-fall",
            Ink::Total => "ink-total",
            Ink::Bounded => "ink-bounded",
            Ink::Cautious => "ink-cautious",
            Ink::Refused => "ink-refused",
            Ink::Stopped => "ink-stopped",
            Ink::Silent => "ink-silent",
            Ink::Series(0) => "ink-0",
            Ink::Series(1) => "ink-1",
            Ink::Series(2) => "ink-2",
            Ink::Series(3) => "ink-3",
            Ink::Series(4) => "ink-4",
            Ink::Series(_) => "ink-5",
        }
    }

    /// The colour that stands for this ink while a chart is being drawn.
    pub(super) fn colour(self) -> RGBColor {
        let index = ALL.iter().position(|ink| *ink == self).unwrap_or(ALL.len());
        RGBColor(index as u8, 0xA5, 0x5A)
    }
}

/// Turns the colours of [`Ink::colour`] into classes: `stroke="#03A55A"` becomes `class="line ink-reference"`.
pub(super) fn classes(svg: &str) -> String {
    let mut out = svg.to_owned();
    for ink in ALL {
        let RGBColor(r, g, b) = ink.colour();
        let hex = format!("#{r:02X}{g:02X}{b:02X}");
        for (attribute, kind) in [("stroke", "line"), ("fill", "fill")] {
            let class = format!("class=\"{kind} {}\"", ink.class());
            out = out.replace(&format!("{attribute}=\"{hex}\""), &class);
        }
    }
    out
}
