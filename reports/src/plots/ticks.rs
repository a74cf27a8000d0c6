//! Where the ticks of an axis stand, and what is written at them.

use crate::format::{significant, typeset};

/// Round numbers inside `[lo, hi]`, about `count` of them: multiples of 1, 2 or 5 times a power of ten.
pub(super) fn linear(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    let raw = (hi - lo) / count as f64;
    let power = 10f64.powf(raw.log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|s| *s >= raw * 0.999).unwrap_or(raw);
    let first = (lo / step - 1e-9).ceil() as i64;
    let last = (hi / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// Logarithms of the ticks inside `[lo, hi]`, both decimal logarithms: the decades, and 2 and 5 between them
/// where there are few; every second one or fewer where there are many.
pub(super) fn logarithmic(lo: f64, hi: f64) -> Vec<f64> {
    let decades = (hi - lo).max(0.0);
    let multiples: &[f64] = if decades < 3.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let stride = ((decades / 7.0).ceil() as i32).max(1);
    let range = (lo.floor() as i32)..=(hi.ceil() as i32);
    let powers = range.filter(|p| p.rem_euclid(stride) == 0);
    powers
        .flat_map(|p| multiples.iter().map(move |m| f64::from(p) + m.log10()))
        .filter(|t| *t >= lo - 1e-9 && *t <= hi + 1e-9)
        .collect()
}

/// Label of a linear tick, with the decimals that tell it from its neighbour a `step` away.
pub(super) fn linear_label(value: f64, step: f64) -> String {
    let digit = |v: f64| v.abs().log10().floor() as i32;
    // A tick that is zero up to the rounding of its multiple.
    if value.abs() < 1e-6 * step {
        return "0".to_owned();
    }
    let digits = (digit(value) - digit(step * (1.0 + 1e-9)) + 1).max(1) as usize;
    typeset(&significant(value, digits))
}

/// Label of a logarithmic tick: plain from 0.001 to 5000, a power of ten beyond.
pub(super) fn logarithmic_label(log: f64) -> String {
    let power = (log + 1e-9).floor() as i32;
    let multiple = 10f64.powf(log - f64::from(power)).round();
    if (-3..4).contains(&power) {
        return significant(multiple * 10f64.powi(power), 2);
    }
    if multiple == 1.0 {
        typeset(&format!("1e{power}"))["1·".len()..].to_owned()
    } else {
        typeset(&format!("{multiple}e{power}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ticks_are_round_and_inside() {
        let near =
            |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(&linear(0.0, 1.0, 5), &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]));
        assert!(near(&linear(-0.013, 0.021, 4), &[-0.01, 0.0, 0.01, 0.02]));
    }

    #[test]
    fn neighbouring_ticks_have_different_labels() {
        let labels = |lo: f64, hi: f64, step| {
            linear(lo, hi, 5).into_iter().map(|t| linear_label(t, step)).collect::<Vec<_>>()
        };
        assert_eq!(labels(0.994, 1.013, 0.005), ["0.995", "1", "1.005", "1.01"]);
        assert_eq!(labels(-10.5, 3.0, 5.0), ["−10", "−5", "0"]);
        assert_eq!(labels(0.0, 4e6, 1e6), ["0", "1·10⁶", "2·10⁶", "3·10⁶", "4·10⁶"]);
    }

    #[test]
    fn logarithmic_labels() {
        let labels =
            |lo: f64, hi: f64| logarithmic(lo, hi).into_iter().map(logarithmic_label).collect::<Vec<_>>();
        assert_eq!(labels(-1.1, 1.0), ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        assert_eq!(labels(3.0, 6.0), ["1000", "10⁴", "10⁵", "10⁶"]);
        assert_eq!(labels(-13.0, -11.9), ["10⁻¹³", "2·10⁻¹³", "5·10⁻¹³", "10⁻¹²"]);
    }
}
