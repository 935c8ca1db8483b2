//! Functions and comparisons of formulas. What is not a number stays so in all of them, so that it is refused.

use super::op::Op;

/// The random field.
pub(super) const RANDOM: &str = "random";

/// The functions by name.
#[rustfmt::skip]
pub(super) const FUNCTIONS: &[(&str, Op)] = &[
    ("abs", Op::One(f64::abs)), ("sqrt", Op::One(f64::sqrt)), ("exp", Op::One(f64::exp)),
    ("ln", Op::One(f64::ln)), ("log10", Op::One(f64::log10)),
    ("sin", Op::One(f64::sin)), ("cos", Op::One(f64::cos)), ("tan", Op::One(f64::tan)),
    ("asin", Op::One(f64::asin)), ("acos", Op::One(f64::acos)), ("atan", Op::One(f64::atan)),
    ("sinh", Op::One(f64::sinh)), ("cosh", Op::One(f64::cosh)), ("tanh", Op::One(f64::tanh)),
    ("floor", Op::One(f64::floor)), ("sign", Op::One(sign)),
    ("atan2", Op::Two(f64::atan2)), ("hypot", Op::Two(f64::hypot)), ("mod", Op::Two(f64::rem_euclid)),
    ("min", Op::Two(min)), ("max", Op::Two(max)), ("if", Op::Three(choose)),
    (RANDOM, Op::Two(min)), // its arguments make a field when it is compiled
];

type Compare = fn(f64, f64) -> f64;

/// The comparisons; longer signs come first.
pub(super) const COMPARISONS: [(&str, Compare); 6] = [
    ("<=", |a, b| truth(a, b, a <= b)),
    (">=", |a, b| truth(a, b, a >= b)),
    ("==", |a, b| truth(a, b, a == b)),
    ("!=", |a, b| truth(a, b, a != b)),
    ("<", |a, b| truth(a, b, a < b)),
    (">", |a, b| truth(a, b, a > b)),
];

fn sign(a: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a.signum() }
}

// f64::min and max would drop what is not a number
fn min(a: f64, b: f64) -> f64 {
    if a <= b || a.is_nan() { a } else { b }
}

fn max(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

fn truth(a: f64, b: f64, holds: bool) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { f64::from(u8::from(holds)) }
}

fn choose(condition: f64, yes: f64, no: f64) -> f64 {
    if condition.is_nan() {
        condition
    } else if condition != 0.0 {
        yes
    } else {
        no
    }
}
