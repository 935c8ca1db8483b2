//! Formulas of a scene, such as `5*cos(pi*x)`: compiled once, evaluated millions of times without allocation.
//!
//! A formula becomes postfix code for a small stack of numbers; what depends on no variable is worked out beforehand.
//! Names are `x`, `y`, `z` (place), `s` (0…1 along the group), `load_factor` (0…1 within the step), `pi`, `e`, and functions.

use super::grammar;
pub use super::op::{FormulaFault, FormulaPlace, Variable};
use super::op::{Op, STACK, derivative, evaluate, is_affine};
use super::random::RandomField;

/// A compiled formula.
#[derive(Debug, Clone)]
pub struct Expression {
    text: String,
    code: Vec<Op>,
    /// Random fields in it.
    fields: Vec<RandomField>,
}

impl Expression {
    /// Compiles a text.
    pub fn parse(text: &str) -> Result<Expression, FormulaFault> {
        Expression::over(text, &[])
    }

    /// Compiles a text over columns of these names.
    pub fn over(text: &str, columns: &[&str]) -> Result<Expression, FormulaFault> {
        let (code, fields) = grammar::compile(text, columns)?;
        let whole = |what: String, help: &str| FormulaFault { span: 0..text.len(), what, help: help.into() };
        let (mut height, mut highest) = (0, 0);
        for op in &code {
            height = height + 1 - op.takes();
            highest = highest.max(height);
        }
        if highest > STACK {
            let what = format!("a formula that remembers {highest} values at once");
            return Err(whole(what, &format!("it can remember {STACK}: nest it less")));
        }
        let expression = Expression { text: text.into(), code, fields };
        match expression.constant() {
            Some(value) if !value.is_finite() => {
                Err(whole(format!("\"{text}\" is {value}"), "a number of a scene is finite"))
            }
            _ => Ok(expression),
        }
    }

    /// The text it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its value if that depends on nothing.
    pub fn constant(&self) -> Option<f64> {
        match self.code.as_slice() {
            [Op::Number(value)] => Some(*value),
            _ => None,
        }
    }

    /// True if it depends on a variable.
    pub fn uses(&self, variable: Variable) -> bool {
        let place = matches!(variable, Variable::X | Variable::Y | Variable::Z);
        self.code.iter().any(|op| match op {
            Op::Variable(used) => *used == variable,
            Op::Random(_) => place,
            _ => false,
        })
    }

    /// True if it is affine in a variable, wherever it is asked.
    pub fn is_affine_in(&self, variable: Variable) -> bool {
        is_affine(&self.code, variable)
    }

    /// Its value at a place; not finite where the formula is not defined.
    pub fn at(&self, place: &FormulaPlace) -> f64 {
        evaluate(&self.code, &self.fields, place)
    }

    /// Its value for values of its columns at a load factor.
    pub fn of_columns(&self, columns: &[f64], load_factor: f64) -> f64 {
        let number = |op: &Op| match op {
            Op::Column(k) => Op::Number(columns.get(*k).copied().unwrap_or(f64::NAN)),
            other => *other,
        };
        let code: Vec<Op> = self.code.iter().map(number).collect();
        evaluate(&code, &self.fields, &FormulaPlace { load_factor, ..FormulaPlace::default() })
    }

    /// Its derivative by a variable there; one-sided at a kink.
    pub fn derivative(&self, place: &FormulaPlace, by: Variable) -> f64 {
        derivative(&self.code, &self.fields, place, by)
    }
}

impl PartialEq for Expression {
    fn eq(&self, other: &Expression) -> bool {
        self.text == other.text
    }
}

#[cfg(test)]
mod tests {
    use super::super::functions::{FUNCTIONS, RANDOM};
    use super::*;

    const PLACE: FormulaPlace =
        FormulaPlace { x: 3.0, y: -0.5, z: 0.0, s: 0.25, load_factor: 0.75, opening: 0.3, damage: 0.6 };

    #[test]
    fn formulas_follow_the_rules_of_school() {
        use std::f64::consts::{E, PI};
        for (text, exact) in [
            ("1", 1.0),
            (" 1e-3 * x ", 3e-3),
            ("1.5E+2", 150.0),
            (".5+1.", 1.5),
            ("-x^2", -9.0),
            ("(-x)^2", 9.0),
            ("-2*x^2", -18.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("x^3", 27.0),
            ("x^0.5", 3f64.sqrt()),
            ("1-2-3", -4.0),
            ("8/2*4", 16.0),
            ("2*8/4", 4.0),
            ("2*-x", -6.0),
            ("--x", 3.0),
            ("5*cos(pi*x)", -5.0),
            ("e", E),
            ("2*π", 2.0 * PI),
            ("exp(y)+ln(x)", (-0.5f64).exp() + 3f64.ln()),
            ("sqrt(abs(y))", 0.5f64.sqrt()),
            ("sinh(y)+cosh(y)-tanh(x)", (-0.5f64).exp() - 3f64.tanh()),
            ("min(max(x, 1), min(2, 3), 9)", 2.0),
            ("if(x > 2, 10, sqrt(y))", 10.0),
            ("if(x < 2, 10, 20)", 20.0),
            ("(x >= 3)*(y != 0) + (x == 3) + (x <= 2)", 2.0),
            ("atan2(1, 1) + hypot(3, 4)", PI / 4.0 + 5.0),
            ("mod(-1, 4) + floor(y) + sign(y)", 1.0),
            ("s + load_factor", 1.0),
            ("ramp(opening, 0.2, 0.6) + ramp(opening, 0, 0.1) + ramp(damage, 0.7, 1)", 1.25),
            ("ramp(opening, 0.5, 0.2) + ramp(opening, 0.3, 0.3) + ramp(opening, 0.4, 0.4)", 5.0 / 3.0),
        ] {
            let value = Expression::parse(text).unwrap().at(&PLACE);
            assert!((value - exact).abs() <= 4e-16 * exact.abs().max(1.0), "{text}: {value}, exact {exact}");
        }
    }

    #[test]
    fn what_depends_on_nothing_is_worked_out_beforehand() {
        assert_eq!(Expression::parse("2*3^2").unwrap().constant(), Some(18.0));
        let expression = Expression::parse("2*pi*x").unwrap();
        assert_eq!(expression.code.len(), 3);
        assert!(expression.uses(Variable::X) && !expression.uses(Variable::S));
    }

    /// Claim: what is called affine is so, to rounding, at any place; what is not is not called so.
    #[test]
    fn affine_formulas_are_told_from_others() {
        for (text, expected) in [
            ("9.81e-3*(60 + 20*load_factor - y)", true),
            ("-load_factor/(1 + x^2) + sin(y)*load_factor*3", true),
            ("if(x > 0.5, 1, 2)*(1 - load_factor)", true),
            ("x + y", true),
            ("max(0, 60*load_factor - y)", false),
            ("load_factor*load_factor", false),
            ("1/(1 + load_factor)", false),
            ("load_factor^1", false),
            ("(load_factor > 0.5)*x", false),
        ] {
            let formula = Expression::parse(text).unwrap();
            assert_eq!(formula.is_affine_in(Variable::LoadFactor), expected, "{text}");
            let at = |load_factor: f64| formula.at(&FormulaPlace { load_factor, ..PLACE });
            let bend = at(0.0) - 2.0 * at(0.5) + at(1.0);
            assert!(!expected || bend.abs() < 1e-14, "{text}: {bend:e}");
        }
        assert!(Expression::parse("load_factor^2*x").unwrap().is_affine_in(Variable::X));
    }

    /// Claim: derivatives are those of central differences, for every function and operator, alone and nested.
    #[test]
    fn derivatives_are_those_of_differences() {
        let texts = FUNCTIONS.iter().filter(|(name, _)| *name != RANDOM).map(|(name, op)| match op.takes() {
            1 => format!("damage*{name}(0.7*opening + 0.1)"),
            2 => format!("{name}(opening*damage, 0.2 + x*opening)"),
            _ => format!("{name}(opening, damage - 0.5*opening, 2*opening + s)"),
        });
        let own = [
            "opening^2 - opening^3/damage + 2^opening + opening^damage - -opening",
            "if(opening > 0.2, opening*damage, 3)*(opening < 1)",
            "9.81e-3*(60 - y)*ramp(opening, 0.1, 0.7)*(1 - ramp(damage, 0.2, 1.4))",
        ];
        for text in texts.chain(own.map(String::from)) {
            let formula = Expression::parse(&text).unwrap();
            for by in Variable::OF_INTERFACES {
                let at = |shift: f64| {
                    let (mut opening, mut damage) = (PLACE.opening, PLACE.damage);
                    *(if by == Variable::Opening { &mut opening } else { &mut damage }) += shift;
                    formula.at(&FormulaPlace { opening, damage, ..PLACE })
                };
                let differences = (at(1e-6) - at(-1e-6)) / 2e-6;
                let exact = formula.derivative(&PLACE, by);
                assert!(
                    (exact - differences).abs() < 1e-8 * exact.abs().max(1.0),
                    "{text}: {exact}, {differences}"
                );
            }
        }
    }

    #[test]
    fn what_is_not_a_number_stays_so() {
        for text in ["sqrt(y)", "min(sqrt(y), 1)", "max(1, sqrt(y))", "sqrt(y) < 1", "if(sqrt(y), 1, 2)"] {
            assert!(Expression::parse(text).unwrap().at(&PLACE).is_nan(), "{text}");
        }
    }

    #[test]
    fn no_formula_makes_the_door_panic() {
        let pieces = [
            "x", "s", "1", "2.5", ".", "e", "1e", "(", ")", "+", "-", "*", "/", "^", ",", "sin", "max(",
            "if(", " ", "pi", "<", "=", "!", "é", "π", "−", "\u{301}", "\t", "{", "_",
        ];
        let mut seed = 1_u64; // a fixed walk through short texts
        for _ in 0..200_000 {
            let mut text = String::new();
            for _ in 0..8 {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                text.push_str(pieces[(seed >> 33) as usize % pieces.len()]);
            }
            if let Ok(formula) = Expression::parse(&text) {
                formula.at(&Default::default());
            }
        }
        for (piece, good) in
            [("(", false), ("-", false), ("x^", false), ("max(1,", false), ("x+", false), ("é", false)]
        {
            for n in [1, 63, 64, 65, 1000, 9_999, 100_000] {
                assert_eq!(Expression::parse(&piece.repeat(n)).is_ok(), good, "{n} times {piece}");
                let _ = Expression::parse(&(piece.repeat(n) + "x"));
            }
        }
        let many = "x+".repeat(4_999) + "x";
        assert_eq!(
            Expression::parse(&many).unwrap().at(&FormulaPlace { x: 1.0, ..FormulaPlace::default() }),
            5_000.0
        );
    }
}
