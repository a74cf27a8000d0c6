//! Arithmetic with parameters, as it stands in a scene file: `"slenderness*height_m"`.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = unary   { ("*" | "/") unary }
//! unary   = { "-" | "+" } power
//! power   = atom [ "^" unary ]
//! atom    = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! `-x^2` is `-(x^2)` and `2^3^2` is `2^(3^2)`, as on paper.

mod parser;

use crate::names::hint;
use parser::Parser;
use std::collections::BTreeMap;
use std::fmt;
use thiserror::Error;

/// What is wrong with an expression.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("in the expression \"{text}\", column {column}: {message}")]
pub struct ExpressionError {
    /// The expression.
    pub text: String,
    /// Where in the expression, in characters, from 1.
    pub column: usize,
    /// What is wrong and what to do.
    pub message: String,
}

/// Names and their values.
pub type Values = BTreeMap<String, f64>;

/// Names that mean something in every expression and so cannot be parameters.
pub const RESERVED: [&str; 16] = [
    "x", "y", "z", "t", "pi", "sqrt", "abs", "min", "max", "sin", "cos", "tan", "exp", "log", "ceil", "round",
];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Function {
    Sqrt,
    Abs,
    Min,
    Max,
    Sin,
    Cos,
    Tan,
    Exp,
    Log,
    Ceil,
    Round,
}

impl Function {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sqrt" => Self::Sqrt,
            "abs" => Self::Abs,
            "min" => Self::Min,
            "max" => Self::Max,
            "sin" => Self::Sin,
            "cos" => Self::Cos,
            "tan" => Self::Tan,
            "exp" => Self::Exp,
            "log" => Self::Log,
            "ceil" => Self::Ceil,
            "round" => Self::Round,
            _ => return None,
        })
    }

    fn arguments(self) -> usize {
        if matches!(self, Self::Min | Self::Max) { 2 } else { 1 }
    }
}

/// One step of a stack machine: a flat program needs no recursion to evaluate.
#[derive(Debug, Clone, PartialEq)]
enum Step {
    Number(f64),
    Name(String),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Call(Function),
}

/// A parsed expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    text: String,
    /// Steps in evaluation order, each with its column.
    program: Vec<(Step, usize)>,
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Expression {
    /// Parses `text`.
    ///
    /// # Errors
    /// Anything that is not in the grammar above, with its column.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        Ok(Self { text: text.to_owned(), program: Parser::new(text).program()? })
    }

    /// Names the expression uses, each once, `pi` and functions left out.
    pub fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self
            .program
            .iter()
            .filter_map(|(step, _)| if let Step::Name(n) = step { Some(n.as_str()) } else { None })
            .collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    /// The value, with the names in `values`.
    ///
    /// # Errors
    /// An unknown name, a division by zero, a result that is not a finite number.
    pub fn value(&self, values: &Values) -> Result<f64, ExpressionError> {
        let fail = |column, message| ExpressionError { text: self.text.clone(), column, message };
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for (step, column) in &self.program {
            if let Step::Name(name) = step
                && !values.contains_key(name)
            {
                let known = values.keys().map(String::as_str);
                return Err(fail(*column, format!("unknown name '{name}'; {}", hint(name, known))));
            }
            if *step == Step::Divide && stack.last() == Some(&0.0) {
                return Err(fail(*column, "division by zero".to_owned()));
            }
            apply(step, values, &mut stack);
            if !stack[stack.len() - 1].is_finite() {
                return Err(fail(*column, format!("the result is {}", stack[stack.len() - 1])));
            }
        }
        Ok(stack[0])
    }
}

/// The parser has made sure that each step finds its operands.
fn apply(step: &Step, values: &Values, stack: &mut Vec<f64>) {
    let mut pop = || stack.pop().unwrap_or(f64::NAN);
    let result = match step {
        Step::Number(v) => *v,
        Step::Name(n) => values[n],
        Step::Negate => -pop(),
        Step::Call(f) if f.arguments() == 1 => {
            let a = pop();
            match f {
                Function::Sqrt => a.sqrt(),
                Function::Abs => a.abs(),
                Function::Sin => a.sin(),
                Function::Cos => a.cos(),
                Function::Tan => a.tan(),
                Function::Exp => a.exp(),
                Function::Ceil => a.ceil(),
                Function::Round => a.round(),
                _ => a.ln(),
            }
        }
        binary => {
            let (b, a) = (pop(), pop());
            match binary {
                Step::Add => a + b,
                Step::Subtract => a - b,
                Step::Multiply => a * b,
                Step::Divide => a / b,
                Step::Power => a.powf(b),
                Step::Call(Function::Min) => a.min(b),
                _ => a.max(b),
            }
        }
    };
    stack.push(result);
}
