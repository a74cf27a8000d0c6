//! Expressions: value, precedence, errors with their column, and no panic on any text.

use proptest::prelude::*;
use seam_cases::expression::{Expression, Values};

fn values() -> Values {
    [("height_m", 0.1), ("slenderness", 9.0), ("P", 1000.0)].map(|(k, v)| (k.to_owned(), v)).into()
}

fn eval(text: &str) -> f64 {
    Expression::parse(text).unwrap().value(&values()).unwrap()
}

fn error(text: &str) -> String {
    let result = Expression::parse(text).and_then(|e| e.value(&values()));
    result.unwrap_err().to_string()
}

#[test]
fn precedence_is_as_on_paper() {
    assert_eq!(eval("1 + 2*3"), 7.0);
    assert_eq!(eval("-2^2"), -4.0);
    assert_eq!(eval("2^3^2"), 512.0);
    assert_eq!(eval("2^-1"), 0.5);
    assert_eq!(eval("8/4/2"), 1.0);
    assert_eq!(eval("10 - 2 - 3"), 5.0);
    assert_eq!(eval("(1+2)*-3"), -9.0);
    assert_eq!(eval("1.5e-3*2E2"), 0.3);
}

#[test]
fn names_and_functions() {
    assert_eq!(eval("slenderness*height_m"), 0.9);
    assert_eq!(eval("max(min(P, 3), sqrt(16)) + abs(-1)"), 5.0);
    assert_eq!(eval("cos(pi)"), -1.0);
    assert_eq!(eval("log(exp(2))"), 2.0);
    assert_eq!(Expression::parse("P*x^2/P + pi").unwrap().names(), ["P", "x"]);
}

#[test]
fn errors_say_where_and_what() {
    for (text, expected) in [
        ("2*heigth_m", "column 3: unknown name 'heigth_m'; did you mean 'height_m'?"),
        ("P/(slenderness-9)", "column 2: division by zero"),
        ("sqrt(0-1)", "column 1: the result is NaN"),
        ("2*(3", "column 5: expected ')'"),
        ("2 3", "column 3: expected an operator"),
        ("", "column 1: expected a number, a name or '(', found the end"),
        ("1.2.3", "column 1: '1.2.3' is not a number"),
        ("max(1)", "column 6: 'max' takes 2 arguments"),
        ("sqr(4)", "column 1: unknown function 'sqr'; did you mean 'sqrt'?"),
    ] {
        let message = error(text);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn depth_is_limited_and_length_is_not() {
    assert!(error(&"(".repeat(10_000)).contains("nested too deeply"));
    assert!(error(&"-".repeat(10_000)).contains("nested too deeply"));
    assert_eq!(eval(&vec!["1"; 20_000].join("+")), 20_000.0);
}

proptest! {
    #[test]
    fn any_text_is_a_finite_value_or_an_error(text in "[-+*/^().,0-9a-z_ é]{0,40}") {
        if let Ok(value) = Expression::parse(&text).and_then(|e| e.value(&values())) {
            prop_assert!(value.is_finite());
        }
    }
}
