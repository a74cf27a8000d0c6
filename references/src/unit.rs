//! Units of columns: SI, without prefixes, so that no column is off by a thousand.

use serde::Deserialize;

/// Base and derived units that occur, `1` for a pure number; `kg` is the one with a prefix.
const SYMBOLS: [&str; 10] = ["1", "m", "kg", "s", "N", "Pa", "J", "W", "rad", "Hz"];

/// The unit of a column that holds names and no numbers.
const NAME: &str = "name";

/// An SI unit such as `1`, `m`, `N m`, `m/s`, `kg/m^3`; or `name` for a column of names.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Unit(String);

impl Unit {
    /// As written.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether the column holds names and no numbers.
    pub fn is_name(&self) -> bool {
        self.0 == NAME
    }
}

impl TryFrom<String> for Unit {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let is_factor = |factor: &str| {
            let (symbol, power) = factor.split_once('^').unwrap_or((factor, "1"));
            SYMBOLS.contains(&symbol) && power.parse::<u8>().is_ok_and(|p| p > 0)
        };
        if text == NAME || text.split([' ', '/']).all(is_factor) {
            Ok(Self(text))
        } else {
            Err(format!(
                "'{text}' is no SI unit; use products and quotients of {} such as 'N m' or 'kg/m^3'",
                SYMBOLS.join(", ")
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_si_units_without_prefixes_are_units() {
        for good in ["1", "m", "rad", "Pa", "N m", "m/s", "kg/m^3", "name"] {
            assert!(Unit::try_from(good.to_owned()).is_ok(), "{good}");
        }
        for bad in ["", "mm", "MPa", "m^", "m^0", "m//s", "metres", "name/s"] {
            assert!(Unit::try_from(bad.to_owned()).is_err(), "{bad}");
        }
    }
}
