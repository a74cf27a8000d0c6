//! Numbers for people: a few significant digits, percent, counts.

/// A number with up to `digits` significant digits and without trailing zeros; scientific outside
/// 1e-3 … 1e6.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "not a number".to_owned() } else { format!("{value}") };
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    if !(-3..6).contains(&power) {
        return format!("{}e{power}", trim_zeros(mantissa));
    }
    let decimals = (digits as i32 - 1 - power).max(0) as usize;
    trim_zeros(&format!("{value:.decimals$}")).to_owned()
}

fn trim_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// A value with four or five significant digits.
pub fn value(v: f64) -> String {
    significant(v, 5)
}

/// A value with its unit; the unit `1` is not written.
pub fn with_unit(v: f64, unit: &str) -> String {
    if unit == "1" || unit.is_empty() { value(v) } else { format!("{} {unit}", value(v)) }
}

/// An error or bound, as a percentage with two significant digits.
pub fn percent(fraction: f64) -> String {
    let p = 100.0 * fraction;
    if p.is_finite() && p.abs() >= 99.5 { format!("{p:.0} %") } else { format!("{} %", significant(p, 2)) }
}

/// A signed error, as a percentage with two significant digits and its sign.
pub fn signed_percent(fraction: f64) -> String {
    if fraction > 0.0 { format!("+{}", percent(fraction)) } else { percent(fraction) }
}

/// A share of a family, as a whole percentage that says 0 or 100 only when it is all or nothing.
pub fn share(fraction: f64) -> String {
    let p = (100.0 * fraction).round();
    let p = if fraction > 0.0 && fraction < 1.0 { p.clamp(1.0, 99.0) } else { p };
    format!("{p:.0} %")
}

/// A large count in groups of three digits, parted by narrow spaces that do not break.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let first = digits.len() % 3;
    let groups =
        digits.as_bytes()[first..].chunks(3).map(|c| c.iter().map(|b| char::from(*b)).collect::<String>());
    let head = (first > 0).then(|| digits[..first].to_owned());
    head.into_iter().chain(groups).collect::<Vec<_>>().join("\u{202f}")
}

/// Numbers in a text as they are printed: `4.2·10⁻⁷` for `4.2e-7`, and a minus sign for a hyphen before a digit.
pub fn typeset(text: &str) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + (digit as u32 - '0' as u32)).unwrap_or(digit),
    };
    let chars: Vec<char> = text.chars().collect();
    let digit = |i: usize| chars.get(i).is_some_and(char::is_ascii_digit);
    let mut out = String::new();
    let mut i = 0;
    while i < chars.len() {
        let before = i.checked_sub(1);
        let sign = usize::from(chars.get(i + 1) == Some(&'-'));
        if chars[i] == 'e' && before.is_some_and(digit) && digit(i + 1 + sign) {
            out.push_str("·10");
            i += 1;
            while digit(i) || (chars.get(i) == Some(&'-') && digit(i + 1)) {
                out.push(raised(chars[i]));
                i += 1;
            }
            continue;
        }
        let begins = before.is_none_or(|b| !chars[b].is_alphanumeric());
        out.push(if chars[i] == '-' && begins && digit(i + 1) { '−' } else { chars[i] });
        i += 1;
    }
    out
}

/// A count with its noun, `1 setting` or `12 settings`.
pub fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.0089, "0.0089"),
            (-23.967, "-23.967"),
            (1.0, "1"),
            (1.5e-13, "1.5e-13"),
            (72.5e9, "7.25e10"),
            (999_999.6, "1e6"),
            (123_456.0, "123456"),
            (f64::NAN, "not a number"),
        ];
        for (v, text) in cases {
            assert_eq!(value(v), text);
        }
        assert_eq!(with_unit(2.0, "1"), "2");
        assert_eq!(with_unit(2.0, "m"), "2 m");
        assert_eq!(
            [0, 999, 1000, 12_345_678].map(grouped),
            ["0", "999", "1\u{202f}000", "12\u{202f}345\u{202f}678"]
        );
    }

    #[test]
    fn powers_of_ten_are_printed_as_such() {
        let cases = [
            ("4.1597e7 Pa", "4.1597·10⁷ Pa"),
            ("-3.9e-5 %", "−3.9·10⁻⁵ %"),
            ("1e-13 … 2e10", "1·10⁻¹³ … 2·10¹⁰"),
            ("rows-16, stage 3, -0.5", "rows-16, stage 3, −0.5"),
            ("", ""),
        ];
        for (plain, printed) in cases {
            assert_eq!(typeset(plain), printed);
        }
    }

    #[test]
    fn percentages() {
        assert_eq!(percent(0.07), "7 %");
        assert_eq!(percent(0.00702), "0.7 %");
        assert_eq!(percent(0.154), "15 %");
        assert_eq!(percent(12.0), "1200 %");
        assert_eq!(signed_percent(0.01), "+1 %");
        assert_eq!(signed_percent(-0.01), "-1 %");
        assert_eq!(share(0.999), "99 %");
        assert_eq!(share(1.0), "100 %");
        assert_eq!(share(0.001), "1 %");
    }
}
