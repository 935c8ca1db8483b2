//! Functions and comparisons of formulas. What is not a number stays so in all of them, so that it is refused.

use std::f64::consts::LN_10;

use super::op::Op;

/// The random field.
pub(super) const RANDOM: &str = "random";

/// The functions by name, each with its derivatives.
#[rustfmt::skip]
pub(super) const FUNCTIONS: &[(&str, Op)] = &[
    ("abs", Op::One(f64::abs, sign)), ("sqrt", Op::One(f64::sqrt, |a| 0.5 / a.sqrt())),
    ("exp", Op::One(f64::exp, f64::exp)), ("ln", Op::One(f64::ln, f64::recip)),
    ("log10", Op::One(f64::log10, |a| (a * LN_10).recip())),
    ("sin", Op::One(f64::sin, f64::cos)), ("cos", Op::One(f64::cos, |a| -a.sin())),
    ("tan", Op::One(f64::tan, |a| a.cos().powi(-2))),
    ("asin", Op::One(f64::asin, |a| (1.0 - a * a).sqrt().recip())),
    ("acos", Op::One(f64::acos, |a| -(1.0 - a * a).sqrt().recip())), ("atan", Op::One(f64::atan, |a| (1.0 + a * a).recip())),
    ("sinh", Op::One(f64::sinh, f64::cosh)), ("cosh", Op::One(f64::cosh, f64::sinh)),
    ("tanh", Op::One(f64::tanh, |a| a.cosh().powi(-2))),
    ("floor", Op::One(f64::floor, |_| 0.0)), ("sign", Op::One(sign, |_| 0.0)),
    ("atan2", Op::Two(f64::atan2, |a, b| [b / (a * a + b * b), -a / (a * a + b * b)])),
    ("hypot", Op::Two(f64::hypot, |a, b| [a / a.hypot(b), b / a.hypot(b)])),
    ("mod", Op::Two(f64::rem_euclid, |a, b| [1.0, -(a / b).floor()])),
    ("min", Op::Two(min, |a, b| share(a <= b))), ("max", Op::Two(max, |a, b| share(a >= b))),
    ("if", Op::Three(choose, |condition, _, _| { let [yes, no] = share(condition != 0.0); [0.0, yes, no] })),
    ("ramp", Op::Three(ramp, ramp_slopes)),
    (RANDOM, Op::Two(min, |_, _| [0.0; 2])), // its arguments make a field when it is compiled
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

/// Derivatives of what is one of two operands.
fn share(first: bool) -> [f64; 2] {
    if first { [1.0, 0.0] } else { [0.0, 1.0] }
}

/// 0 up to a, 1 from b on, and a straight line between; a step where both are the same.
fn ramp(value: f64, a: f64, b: f64) -> f64 {
    if value.is_nan() || a.is_nan() || b.is_nan() {
        f64::NAN
    } else if a == b {
        f64::from(u8::from(value >= a))
    } else {
        ((value - a) / (b - a)).clamp(0.0, 1.0)
    }
}

fn ramp_slopes(value: f64, a: f64, b: f64) -> [f64; 3] {
    let part = (value - a) / (b - a);
    match part > 0.0 && part < 1.0 {
        true => [1.0, part - 1.0, -part].map(|slope| slope / (b - a)),
        false => [0.0; 3],
    }
}

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
