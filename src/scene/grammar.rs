//! The grammar of formulas: text to postfix code, every refusal with its position.
//!
//! ```text
//! comparison = sum [("<" | "<=" | ">" | ">=" | "==" | "!=") sum]          1 where it holds, 0 where not
//! sum        = product {("+" | "-") product}
//! product    = signed {("*" | "/") signed}
//! signed     = {"+" | "-"} power                                          −x² is −(x²)
//! power      = value ["^" signed]                                         2^3^2 is 2^9
//! value      = number | name | function "(" comparison {"," comparison} ")" | "(" comparison ")"
//! ```

use super::functions::{COMPARISONS, FUNCTIONS, RANDOM};
use super::op::{FormulaFault, FormulaPlace, Op, Variable, evaluate};
use super::random::RandomField;
use crate::error::name_help;

/// Longest formula [bytes].
const LONGEST: usize = 10_000;
/// Deepest nesting of brackets, functions and powers.
const DEEPEST: usize = 64;
/// Characters of the text shown on either side of a fault.
const AROUND: usize = 30;
/// Most random fields of a formula.
const MOST_FIELDS: usize = 16;
/// Seeds are below this.
const LARGEST_SEED: f64 = 9e15;

/// Compiles a text in which some names stand for columns.
pub(super) fn compile(text: &str, columns: &[&str]) -> Result<(Vec<Op>, Vec<RandomField>), FormulaFault> {
    let mut parser = Parser { text, columns, at: 0, code: Vec::new(), fields: Vec::new(), depth: 0 };
    if text.len() > LONGEST {
        return Err(parser.fault(0..0, "a formula of more than 10000 characters", "write it shorter"));
    }
    parser.comparison()?;
    match parser.peek() {
        None => Ok((parser.code, parser.fields)),
        Some(c) => Err(parser.leftover(c)),
    }
}

struct Parser<'a> {
    text: &'a str,
    /// Names of columns, which count before all others.
    columns: &'a [&'a str],
    /// Byte that comes next.
    at: usize,
    code: Vec<Op>,
    fields: Vec<RandomField>,
    depth: usize,
}

impl<'a> Parser<'a> {
    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// Takes the next symbol if it is this one.
    fn take(&mut self, symbol: &str) -> bool {
        let found = self.peek().is_some() && self.text[self.at..].starts_with(symbol);
        if found {
            self.at += symbol.len();
        }
        found
    }

    /// Appends an instruction, or its result where all its operands are numbers.
    fn emit(&mut self, op: Op) {
        self.code.push(op);
        let start = self.code.len().saturating_sub(1 + op.takes());
        let operands = &self.code[start..self.code.len() - 1];
        if op.takes() > 0 && operands.iter().all(|operand| matches!(operand, Op::Number(_))) {
            let value = evaluate(&self.code[start..], &self.fields, &FormulaPlace::default());
            self.code.truncate(start);
            self.code.push(Op::Number(value));
        }
    }

    fn comparison(&mut self) -> Result<(), FormulaFault> {
        self.sum()?;
        for (symbol, compare) in COMPARISONS {
            if self.take(symbol) {
                self.sum()?;
                self.emit(Op::Two(compare, |_, _| [0.0; 2]));
                break;
            }
        }
        Ok(())
    }

    fn sum(&mut self) -> Result<(), FormulaFault> {
        self.product()?;
        loop {
            let op = match self.peek() {
                Some('+') => Op::Add,
                Some('-') => Op::Subtract,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.emit(op);
        }
    }

    fn product(&mut self) -> Result<(), FormulaFault> {
        self.signed()?;
        loop {
            let op = match self.peek() {
                Some('*') => Op::Multiply,
                Some('/') => Op::Divide,
                _ => return Ok(()),
            };
            self.at += 1;
            self.signed()?;
            self.emit(op);
        }
    }

    fn signed(&mut self) -> Result<(), FormulaFault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.fault_here("nested too deep", "nest at most 64 brackets, functions and powers"));
        }
        let mut negative = false;
        while let Some(c @ ('+' | '-')) = self.peek() {
            self.at += 1;
            negative ^= c == '-';
        }
        self.power()?;
        if negative {
            self.emit(Op::Negate);
        }
        self.depth -= 1;
        Ok(())
    }

    fn power(&mut self) -> Result<(), FormulaFault> {
        self.value()?;
        if self.take("^") {
            self.signed()?;
            // the common powers need no logarithm
            let short = match self.code.last() {
                Some(Op::Number(2.0)) => Some(Op::One(|a| a * a, |a| 2.0 * a)),
                Some(Op::Number(3.0)) => Some(Op::One(|a| a * a * a, |a| 3.0 * a * a)),
                _ => None,
            };
            match short {
                Some(short) => {
                    self.code.pop();
                    self.emit(short);
                }
                None => self.emit(Op::Two(f64::powf, |a, b| [b * a.powf(b - 1.0), a.powf(b) * a.ln()])),
            }
        }
        Ok(())
    }

    fn value(&mut self) -> Result<(), FormulaFault> {
        match self.peek() {
            Some('(') => {
                let open = self.at;
                self.at += 1;
                self.comparison()?;
                self.close(open)
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() || c == '_' => self.name(),
            Some('*') => Err(self.fault_here("a value is missing", "a power is written ^")),
            Some(c) if !"+-/^(),<>=!".contains(c) => Err(self.leftover(c)),
            _ => Err(self.fault_here("a value is missing", "write a number, a name or ( … ) there")),
        }
    }

    fn number(&mut self) -> Result<(), FormulaFault> {
        let bytes = self.text.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let start = self.at;
        let mut end = digits(start);
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if let Some(b'e' | b'E') = bytes.get(end) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let last = digits(end + 1 + sign);
            if last > end + 1 + sign {
                end = last;
            }
        }
        match self.text[start..end].parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.at = end;
                self.code.push(Op::Number(value));
                Ok(())
            }
            _ => Err(self.fault(start..end.max(start + 1), "not a number", "write it like 2, 0.5 or 1.5e-3")),
        }
    }

    fn name(&mut self) -> Result<(), FormulaFault> {
        let rest = &self.text[self.at..];
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let (name, span) = (&rest[..length], self.at..self.at + length);
        self.at = span.end;
        let called = self.peek() == Some('(');
        let column = self.columns.iter().position(|column| *column == name);
        let op = match name {
            _ if column.is_some() => column.map(Op::Column),
            "pi" | "π" => Some(Op::Number(std::f64::consts::PI)),
            "e" => Some(Op::Number(std::f64::consts::E)),
            _ => Variable::ALL.into_iter().find(|v| v.name() == name).map(Op::Variable),
        };
        match (op, FUNCTIONS.iter().find(|(known, _)| *known == name)) {
            (Some(_), _) if called => {
                let what = format!("\"{name}\" is not a function");
                Err(self.fault(span, &what, &format!("write {name}*( … ) for a product")))
            }
            (Some(op), _) => {
                self.code.push(op);
                Ok(())
            }
            (None, Some((_, function))) if called => self.call(name, *function),
            (None, Some(_)) => {
                Err(self.fault(span, &format!("\"{name}\" is a function"), &format!("write {name}( … )")))
            }
            (None, None) => {
                let mut names: Vec<&str> = self.columns.to_vec();
                let known = Variable::ALL.into_iter().map(Variable::name).chain(["pi", "e"]);
                known.chain(FUNCTIONS.iter().map(|(name, _)| *name)).for_each(|name| names.push(name));
                let short: String = name.chars().take(AROUND).collect();
                let help = name_help(&short, names);
                Err(self.fault(span, &format!("unknown name \"{short}\""), &help))
            }
        }
    }

    /// The arguments of a function and its code; min and max take more than two one after the other.
    fn call(&mut self, name: &str, function: Op) -> Result<(), FormulaFault> {
        let open = self.at;
        self.at += 1;
        let mut given = 1;
        self.comparison()?;
        while self.take(",") {
            self.comparison()?;
            given += 1;
        }
        self.close(open)?;
        let (many, takes) = (matches!(name, "min" | "max"), function.takes());
        if given != takes && !(many && given > takes) {
            let or_more = if many { " or more" } else { "" };
            let what = format!("{name} takes {takes}{or_more}, not {given},");
            return Err(self.fault(open..self.at, &what, "separate the values by commas"));
        }
        if name == RANDOM {
            return self.field(open);
        }
        for _ in 0..if many { given - 1 } else { 1 } {
            self.emit(function);
        }
        Ok(())
    }

    /// A random field from its seed and correlation length, which are numbers.
    fn field(&mut self, open: usize) -> Result<(), FormulaFault> {
        let given = self.code.split_off(self.code.len().saturating_sub(2));
        let [Op::Number(seed), Op::Number(length)] = given[..] else {
            let help = "its seed and its correlation length are numbers, such as random(1, 0.5)";
            return Err(self.fault(open..self.at, "a random field that depends on the place", help));
        };
        if !(seed >= 0.0 && seed.fract() == 0.0 && seed < LARGEST_SEED) {
            let help = "it is a whole number from 0 on";
            return Err(self.fault(open..self.at, &format!("{seed} is no seed"), help));
        }
        if !(length > 0.0 && length.is_finite()) {
            let help = "it is more than zero";
            return Err(self.fault(open..self.at, &format!("{length} is no correlation length"), help));
        }
        if self.fields.len() == MOST_FIELDS {
            return Err(self.fault(open..self.at, "more than 16 random fields", "take fewer"));
        }
        self.code.push(Op::Random(self.fields.len()));
        self.fields.push(RandomField::new(seed as u64, length));
        Ok(())
    }

    fn close(&mut self, open: usize) -> Result<(), FormulaFault> {
        match self.peek() {
            Some(')') => {
                self.at += 1;
                Ok(())
            }
            None => Err(self.fault(open..open + 1, "\"(\" is not closed", "add \")\"")),
            Some(c) => Err(self.leftover(c)),
        }
    }

    /// A character that cannot follow.
    fn leftover(&self, c: char) -> FormulaFault {
        let between = "write one of + - * / ^ between two values";
        let (what, help) = match c {
            ')' => ("\")\" closes nothing".into(), "remove it, or open \"(\" before it"),
            ',' => ("\",\" stands outside of a function".into(), "decimals take a point, as in 0.5"),
            '=' => ("a lone \"=\"".into(), "equality is written =="),
            '<' | '>' | '!' => {
                (format!("\"{c}\" cannot follow"), "combine comparisons by *, as (x > 0)*(x < 1)")
            }
            '&' | '|' => (format!("unknown sign \"{c}\""), "write (a)*(b) for a and b, max(a, b) for a or b"),
            c if c.is_alphanumeric() || "_(.".contains(c) => ("an operator is missing".into(), between),
            c => (format!("unknown sign \"{c}\""), "a formula has numbers, names, + - * / ^ ( ) , < > == !="),
        };
        self.fault(self.at..self.at + c.len_utf8(), &what, help)
    }

    fn fault_here(&self, what: &str, help: &str) -> FormulaFault {
        let length = self.text[self.at..].chars().next().map_or(0, char::len_utf8);
        self.fault(self.at..self.at + length, what, help)
    }

    fn fault(&self, span: std::ops::Range<usize>, what: &str, help: &str) -> FormulaFault {
        let number = self.text[..span.start].chars().count();
        let shown: String = self.text.chars().skip(number.saturating_sub(AROUND)).take(2 * AROUND).collect();
        let left = if number > AROUND { "…" } else { "" };
        let right =
            if number.saturating_sub(AROUND) + 2 * AROUND < self.text.chars().count() { "…" } else { "" };
        let what = format!("{what} at character {} of \"{left}{shown}{right}\"", number + 1);
        FormulaFault { span, what, help: help.into() }
    }
}
