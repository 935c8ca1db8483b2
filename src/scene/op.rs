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
    /// Normal jump of an interface, 0 where its faces touch [length].
    pub opening: f64,
    /// Damage of an interface, 0 to 1.
    pub damage: f64,
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
    /// Normal jump of an interface, 0 where its faces touch.
    Opening,
    /// Damage of an interface.
    Damage,
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

/// Derivatives of a function by its operands.
pub(super) type ByTwo = fn(f64, f64) -> [f64; 2];
pub(super) type ByThree = fn(f64, f64, f64) -> [f64; 3];

/// One instruction: takes its operands from the stack and leaves its result there.
#[derive(Debug, Clone, Copy)]
pub(super) enum Op {
    Number(f64),
    Variable(Variable),
    /// The field of this number.
    Random(usize),
    /// The column of this number; a number once its value is known.
    Column(usize),
    Add,
    Subtract,
    Multiply,
    Divide,
    Negate,
    /// With its derivative, as those of two and three operands.
    One(fn(f64) -> f64, fn(f64) -> f64),
    Two(fn(f64, f64) -> f64, ByTwo),
    Three(fn(f64, f64, f64) -> f64, ByThree),
}

impl Op {
    /// Number of operands.
    pub(super) fn takes(&self) -> usize {
        match self {
            Op::Number(_) | Op::Variable(_) | Op::Random(_) | Op::Column(_) => 0,
            Op::Negate | Op::One(..) => 1,
            Op::Add | Op::Subtract | Op::Multiply | Op::Divide | Op::Two(..) => 2,
            Op::Three(..) => 3,
        }
    }
}

impl FormulaPlace {
    /// Value of a variable.
    pub fn value(&self, variable: Variable) -> f64 {
        match variable {
            Variable::X => self.x,
            Variable::Y => self.y,
            Variable::Z => self.z,
            Variable::S => self.s,
            Variable::LoadFactor => self.load_factor,
            Variable::Opening => self.opening,
            Variable::Damage => self.damage,
        }
    }
}

impl Variable {
    /// All of them.
    pub const ALL: [Variable; 7] = [
        Variable::X,
        Variable::Y,
        Variable::Z,
        Variable::S,
        Variable::LoadFactor,
        Variable::Opening,
        Variable::Damage,
    ];
    /// Coordinates.
    pub const OF_PLACES: [Variable; 3] = [Variable::X, Variable::Y, Variable::Z];
    /// Variables that only the pressure in an interface has.
    pub const OF_INTERFACES: [Variable; 2] = [Variable::Opening, Variable::Damage];

    /// Its name in a formula.
    pub fn name(self) -> &'static str {
        match self {
            Variable::X => "x",
            Variable::Y => "y",
            Variable::Z => "z",
            Variable::S => "s",
            Variable::LoadFactor => "load_factor",
            Variable::Opening => "opening",
            Variable::Damage => "damage",
        }
    }
}

/// Runs postfix code, whose need of stack was checked when it was compiled.
pub(super) fn evaluate(code: &[Op], fields: &[RandomField], place: &FormulaPlace) -> f64 {
    let mut stack = [0.0; STACK + 2];
    let mut height = 0;
    for op in code {
        height -= op.takes();
        let operands = [stack[height], stack[height + 1], stack[height + 2]];
        stack[height] = evaluate_one(op, operands, fields, place);
        height += 1;
    }
    stack[0]
}

/// The result of one instruction.
#[inline]
fn evaluate_one(op: &Op, [a, b, c]: [f64; 3], fields: &[RandomField], place: &FormulaPlace) -> f64 {
    match *op {
        Op::Number(value) => value,
        Op::Variable(variable) => place.value(variable),
        Op::Random(field) => fields[field].at(place.x, place.y, place.z),
        Op::Column(_) => f64::NAN,
        Op::Add => a + b,
        Op::Subtract => a - b,
        Op::Multiply => a * b,
        Op::Divide => a / b,
        Op::Negate => -a,
        Op::One(f, _) => f(a),
        Op::Two(f, _) => f(a, b),
        Op::Three(f, _) => f(a, b, c),
    }
}

/// True if postfix code is affine in a variable: it is only added to, subtracted from, multiplied and divided by what does not depend
/// on it.
pub(super) fn is_affine(code: &[Op], by: Variable) -> bool {
    let mut depends: Vec<bool> = Vec::new();
    for op in code {
        let operands = depends.split_off(depends.len() - op.takes());
        let any = operands.contains(&true);
        let is_affine = match op {
            Op::Multiply => operands != [true, true],
            Op::Divide => !operands[1],
            Op::One(..) | Op::Two(..) | Op::Three(..) => !any,
            _ => true,
        };
        if !is_affine {
            return false;
        }
        depends.push(any || matches!(op, Op::Variable(variable) if *variable == by));
    }
    true
}

/// The derivative of postfix code by a variable, by the chain rule; one-sided where there is a kink.
pub(super) fn derivative(code: &[Op], fields: &[RandomField], place: &FormulaPlace, by: Variable) -> f64 {
    let (mut stack, mut slopes) = ([0.0; STACK + 2], [0.0; STACK + 2]);
    let mut height = 0;
    for op in code {
        height -= op.takes();
        let at = |k: usize| stack[height + k];
        let by_operand = |k: usize| slopes[height + k];
        // what does not depend on the variable has no part in it, whatever its own derivative
        let times = |slope: f64, k: usize| if by_operand(k) == 0.0 { 0.0 } else { slope * by_operand(k) };
        let value = evaluate_one(op, [at(0), at(1), at(2)], fields, place);
        let slope = match *op {
            Op::Number(_) | Op::Random(_) | Op::Column(_) => 0.0,
            Op::Variable(variable) => f64::from(u8::from(variable == by)),
            Op::Add => by_operand(0) + by_operand(1),
            Op::Subtract => by_operand(0) - by_operand(1),
            Op::Negate => -by_operand(0),
            Op::Multiply => times(at(1), 0) + times(at(0), 1),
            Op::Divide => times(1.0 / at(1), 0) - times(value / at(1), 1),
            Op::One(_, slope) => times(slope(at(0)), 0),
            Op::Two(_, slopes) => {
                let [a, b] = slopes(at(0), at(1));
                times(a, 0) + times(b, 1)
            }
            Op::Three(_, slopes) => {
                let [a, b, c] = slopes(at(0), at(1), at(2));
                times(a, 0) + times(b, 1) + times(c, 2)
            }
        };
        (stack[height], slopes[height]) = (value, slope);
        height += 1;
    }
    slopes[0]
}
