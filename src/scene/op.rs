//! Postfix code of formulas and its evaluation.

use super::random::RandomField;

/// Values that an expression may have to remember at once.
pub(super) const STACK: usize = 32;

/// Place and load factor at which a formula is evaluated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FormulaPlace {
    /// Coordinate [length].
    pub x: f64,
    /// Coordinate [length].
    pub y: f64,
    /// Coordinate, 0 in the plane [length].
    pub z: f64,
    /// Fraction of the arc length along the group, 0 to 1.
    pub s: f64,
    /// Load factor within the step, 0 to 1.
    pub load_factor: f64,
}

/// Variables of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// Coordinate x.
    X,
    /// Coordinate y.
    Y,
    /// Coordinate z.
    Z,
    /// Fraction of the arc length along the group.
    S,
    /// Load factor within the step.
    LoadFactor,
}

/// Fault of a text that is no expression, with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FormulaFault {
    /// Bytes of the text that are wrong.
    pub span: std::ops::Range<usize>,
    /// The fault, with its position and the text around it.
    pub what: String,
    /// The remedy.
    pub help: String,
}

/// One instruction: takes its operands from the stack and leaves its result there.
#[derive(Debug, Clone, Copy)]
pub(super) enum Op {
    Number(f64),
    Variable(Variable),
    /// The field of this number.
    Random(usize),
    Add,
    Subtract,
    Multiply,
    Divide,
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
    Three(fn(f64, f64, f64) -> f64),
}

impl Op {
    /// Number of operands.
    pub(super) fn takes(&self) -> usize {
        match self {
            Op::Number(_) | Op::Variable(_) | Op::Random(_) => 0,
            Op::One(_) => 1,
            Op::Add | Op::Subtract | Op::Multiply | Op::Divide | Op::Two(_) => 2,
            Op::Three(_) => 3,
        }
    }
}

impl Variable {
    /// All of them.
    pub const ALL: [Variable; 5] = [Variable::X, Variable::Y, Variable::Z, Variable::S, Variable::LoadFactor];

    /// Its name in a formula.
    pub fn name(self) -> &'static str {
        match self {
            Variable::X => "x",
            Variable::Y => "y",
            Variable::Z => "z",
            Variable::S => "s",
            Variable::LoadFactor => "load_factor",
        }
    }
}

/// Runs postfix code, whose need of stack was checked when it was compiled.
pub(super) fn evaluate(code: &[Op], fields: &[RandomField], place: &FormulaPlace) -> f64 {
    let mut stack = [0.0; STACK];
    let mut height = 0;
    for op in code {
        height -= op.takes();
        let a = stack[height];
        stack[height] = match *op {
            Op::Number(value) => value,
            Op::Variable(Variable::X) => place.x,
            Op::Variable(Variable::Y) => place.y,
            Op::Variable(Variable::Z) => place.z,
            Op::Random(field) => fields[field].at(place.x, place.y, place.z),
            Op::Variable(Variable::S) => place.s,
            Op::Variable(Variable::LoadFactor) => place.load_factor,
            Op::Add => a + stack[height + 1],
            Op::Subtract => a - stack[height + 1],
            Op::Multiply => a * stack[height + 1],
            Op::Divide => a / stack[height + 1],
            Op::One(f) => f(a),
            Op::Two(f) => f(a, stack[height + 1]),
            Op::Three(f) => f(a, stack[height + 1], stack[height + 2]),
        };
        height += 1;
    }
    stack[0]
}
