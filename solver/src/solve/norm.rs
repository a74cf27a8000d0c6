//! The largest magnitude of numbers.

use std::borrow::Borrow;

/// Largest magnitude; zero of none, NaN if there is one.
pub(crate) fn norm(values: impl IntoIterator<Item: Borrow<f64>>) -> f64 {
    values.into_iter().fold(0.0, |m, v| {
        let v = v.borrow().abs();
        if v > m || v.is_nan() { v } else { m }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_is_not_lost() {
        assert_eq!(norm([1.0, -3.0, 2.0]), 3.0);
        assert_eq!(norm([0.0; 0]), 0.0);
        for values in [[f64::NAN, 1.0], [1.0, f64::NAN]] {
            assert!(norm(values).is_nan());
        }
    }
}
