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

use crate::names::hint;
use std::collections::BTreeMap;
use std::fmt;
use thiserror::Error;

/// Parentheses, powers and signs may nest this deep; far beyond any formula, far below the stack.
const DEEPEST: usize = 64;

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
pub const RESERVED: [&str; 15] =
    ["x", "y", "z", "pi", "sqrt", "abs", "min", "max", "sin", "cos", "tan", "exp", "log", "ceil", "round"];

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
        let mut parser = Parser { text, chars: text.chars().collect(), at: 0, depth: 0, program: Vec::new() };
        parser.sum()?;
        if parser.peek().is_some() {
            return Err(parser.fail("expected an operator (+ - * / ^) or the end"));
        }
        Ok(Self { text: text.to_owned(), program: parser.program })
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

struct Parser<'a> {
    text: &'a str,
    chars: Vec<char>,
    at: usize,
    depth: usize,
    program: Vec<(Step, usize)>,
}

impl Parser<'_> {
    fn fail(&self, message: &str) -> ExpressionError {
        ExpressionError { text: self.text.to_owned(), column: self.at + 1, message: message.to_owned() }
    }

    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        while self.chars.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.chars.get(self.at).copied()
    }

    fn emit(&mut self, step: Step, at: usize) {
        self.program.push((step, at + 1));
    }

    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.product()?;
        while let Some(sign @ ('+' | '-')) = self.peek() {
            let at = self.at;
            self.at += 1;
            self.product()?;
            self.emit(if sign == '+' { Step::Add } else { Step::Subtract }, at);
        }
        Ok(())
    }

    fn product(&mut self) -> Result<(), ExpressionError> {
        self.unary()?;
        while let Some(sign @ ('*' | '/')) = self.peek() {
            let at = self.at;
            self.at += 1;
            self.unary()?;
            self.emit(if sign == '*' { Step::Multiply } else { Step::Divide }, at);
        }
        Ok(())
    }

    fn unary(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fail("nested too deeply; introduce a parameter for a part of it"));
        }
        match self.peek() {
            Some('+') => {
                self.at += 1;
                self.unary()?;
            }
            Some('-') => {
                let at = self.at;
                self.at += 1;
                self.unary()?;
                self.emit(Step::Negate, at);
            }
            _ => self.power()?,
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Result<(), ExpressionError> {
        self.atom()?;
        if self.peek() == Some('^') {
            let at = self.at;
            self.at += 1;
            self.unary()?;
            self.emit(Step::Power, at);
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), ExpressionError> {
        match self.peek() {
            Some('(') => {
                self.at += 1;
                self.sum()?;
                self.close()
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(),
            Some(c) => Err(self.fail(&format!("expected a number, a name or '(', found '{c}'"))),
            None => Err(self.fail("expected a number, a name or '(', found the end")),
        }
    }

    fn close(&mut self) -> Result<(), ExpressionError> {
        if self.peek() != Some(')') {
            return Err(self.fail("expected ')'"));
        }
        self.at += 1;
        Ok(())
    }

    fn number(&mut self) -> Result<(), ExpressionError> {
        let start = self.at;
        let digits = |p: &mut Self| {
            while p.chars.get(p.at).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
                p.at += 1;
            }
        };
        digits(self);
        if matches!(self.chars.get(self.at), Some('e' | 'E')) {
            self.at += 1;
            if matches!(self.chars.get(self.at), Some('+' | '-')) {
                self.at += 1;
            }
            digits(self);
        }
        let word: String = self.chars[start..self.at].iter().collect();
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => self.emit(Step::Number(value), start),
            _ => {
                self.at = start;
                return Err(self.fail(&format!("'{word}' is not a number")));
            }
        }
        Ok(())
    }

    fn name(&mut self) -> Result<(), ExpressionError> {
        let start = self.at;
        while self.chars.get(self.at).is_some_and(|c| c.is_alphanumeric() || *c == '_') {
            self.at += 1;
        }
        let word: String = self.chars[start..self.at].iter().collect();
        if self.peek() == Some('(') {
            return self.call(&word, start);
        }
        let step = if word == "pi" { Step::Number(std::f64::consts::PI) } else { Step::Name(word) };
        self.emit(step, start);
        Ok(())
    }

    fn call(&mut self, word: &str, start: usize) -> Result<(), ExpressionError> {
        let Some(function) = Function::named(word) else {
            self.at = start;
            let known = hint(word, RESERVED[4..].iter().copied());
            return Err(self.fail(&format!("unknown function '{word}'; {known}")));
        };
        self.at += 1;
        self.sum()?;
        for _ in 1..function.arguments() {
            if self.peek() != Some(',') {
                return Err(self.fail(&format!("'{word}' takes {} arguments", function.arguments())));
            }
            self.at += 1;
            self.sum()?;
        }
        self.close()?;
        self.emit(Step::Call(function), start);
        Ok(())
    }
}
