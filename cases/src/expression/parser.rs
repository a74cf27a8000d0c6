//! Recursive descent over the grammar of [`super`].

use super::{ExpressionError, Function, RESERVED, Step};
use crate::names::hint;

/// Parentheses, powers and signs may nest this deep; far beyond any formula, far below the stack.
const DEEPEST: usize = 64;

pub(super) struct Parser<'a> {
    text: &'a str,
    chars: Vec<char>,
    at: usize,
    depth: usize,
    program: Vec<(Step, usize)>,
}

impl<'a> Parser<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, chars: text.chars().collect(), at: 0, depth: 0, program: Vec::new() }
    }

    /// The steps of the whole text, each with its column.
    pub fn program(mut self) -> Result<Vec<(Step, usize)>, ExpressionError> {
        self.sum()?;
        if self.peek().is_some() {
            return Err(self.fail("expected an operator (+ - * / ^) or the end"));
        }
        Ok(self.program)
    }

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
            let known = hint(word, RESERVED[5..].iter().copied());
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
