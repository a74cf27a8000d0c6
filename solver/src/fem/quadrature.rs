//! Gauss–Legendre rules on `[−1, 1]^d`.

/// Points and weights of the `n`-point Gauss rule on [−1, 1], exact to degree 2n − 1
/// (Abramowitz & Stegun 1972, table 25.4), for `n` from 1 to 4; larger `n` gives 4.
pub fn gauss(n: usize) -> Vec<(f64, f64)> {
    match n {
        0 | 1 => vec![(0.0, 2.0)],
        2 => {
            let x = 1.0 / 3f64.sqrt();
            vec![(-x, 1.0), (x, 1.0)]
        }
        3 => {
            let x = 0.6f64.sqrt();
            vec![(-x, 5.0 / 9.0), (0.0, 8.0 / 9.0), (x, 5.0 / 9.0)]
        }
        _ => {
            let root = (6.0 / 5.0f64).sqrt();
            let (near, far) = ((3.0 - 2.0 * root) / 7.0, (3.0 + 2.0 * root) / 7.0);
            let (heavy, light) = ((18.0 + 30f64.sqrt()) / 36.0, (18.0 - 30f64.sqrt()) / 36.0);
            let (near, far) = (near.sqrt(), far.sqrt());
            vec![(-far, light), (-near, heavy), (near, heavy), (far, light)]
        }
    }
}

/// Tensor product of [`gauss`] in `dimension` 1, 2 or 3: natural coordinates (zero beyond the
/// dimension) and weight.
pub fn tensor_gauss(dimension: usize, n: usize) -> Vec<([f64; 3], f64)> {
    let line = gauss(n);
    let mut rule = vec![([0.0; 3], 1.0)];
    for axis in 0..dimension {
        rule = rule
            .iter()
            .flat_map(|&(xi, w)| {
                line.iter().map(move |&(x, wx)| {
                    let mut xi = xi;
                    xi[axis] = x;
                    (xi, w * wx)
                })
            })
            .collect();
    }
    rule
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_monomials_to_its_degree() {
        for n in 1..=4 {
            for degree in 0..2 * n {
                let integral: f64 = gauss(n).iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = if degree % 2 == 0 { 2.0 / (degree as f64 + 1.0) } else { 0.0 };
                // Four terms of order one: a few ulp.
                assert!((integral - exact).abs() < 1e-15 * 8.0, "n = {n}, degree {degree}: {integral}");
            }
        }
    }

    #[test]
    fn tensor_rule_has_the_volume_of_the_cube() {
        for d in 1..=3 {
            let rule = tensor_gauss(d, 3);
            assert_eq!(rule.len(), 3usize.pow(d as u32));
            let volume: f64 = rule.iter().map(|(_, w)| w).sum();
            assert!((volume - f64::powi(2.0, d as i32)).abs() < 1e-14);
        }
    }
}
