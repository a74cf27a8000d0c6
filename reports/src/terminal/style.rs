//! Colours, only where they are wanted, and wrapped text.

use crate::record::RecordState;
use crate::results::ClaimResult;
use crate::verdict::{ClaimVerdict, Verdict};

/// Whether to colour. The caller knows whether it writes to a terminal and honours `NO_COLOR`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Text only.
    Plain,
    /// With ANSI escape sequences.
    Colour,
}

/// What a piece of text means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Paint {
    /// As promised.
    Good,
    /// Not as promised.
    Bad,
    /// Worth a look.
    Mixed,
    /// A heading.
    Bold,
    /// Not the point.
    Dim,
}

impl Style {
    /// The text, coloured if wanted.
    pub(super) fn paint(self, paint: Paint, text: &str) -> String {
        let code = match paint {
            Paint::Good => "32",
            Paint::Bad => "1;31",
            Paint::Mixed => "33",
            Paint::Bold => "1",
            Paint::Dim => "2",
        };
        match self {
            Style::Plain => text.to_owned(),
            Style::Colour => {
                let (body, newline) = text.strip_suffix('\n').map_or((text, ""), |body| (body, "\n"));
                format!("\u{1b}[{code}m{body}\u{1b}[0m{newline}")
            }
        }
    }
}

impl Paint {
    pub(super) fn verdict(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Pass => Paint::Good,
            Verdict::Fail | Verdict::Undetermined => Paint::Bad,
        }
    }

    /// A paper's claim is a finding: red only where the gate is.
    pub(super) fn claim(claim: &ClaimResult) -> Self {
        let changed = matches!(claim.record, RecordState::Changed | RecordState::OtherFamily);
        match claim.verdict {
            _ if claim.unmeasured.is_some() || (!claim.own && changed) => Paint::Bad,
            ClaimVerdict::Supported => Paint::Good,
            ClaimVerdict::Contradicted | ClaimVerdict::Conditional if claim.own => Paint::Bad,
            _ => Paint::Mixed,
        }
    }
}

/// Text broken at spaces so that no line exceeds `width`, each line indented; empty text gives nothing.
/// A percent sign stays with its number.
pub(super) fn wrap(text: &str, width: usize, indent: usize) -> String {
    let mut out = String::new();
    let mut column = 0;
    let bound = text.replace(" %", "\u{a0}%");
    for word in bound.split([' ', '\n']).filter(|w| !w.is_empty()) {
        let length = word.chars().count();
        if column > 0 && column + 1 + length <= width {
            out.push(' ');
            column += 1 + length;
        } else {
            if column > 0 {
                out.push('\n');
            }
            out.push_str(&" ".repeat(indent));
            column = indent + length;
        }
        out.push_str(word);
    }
    if column > 0 {
        out.push('\n');
    }
    out.replace('\u{a0}', " ")
}
