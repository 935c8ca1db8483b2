//! Text as a formula, and its values and derivatives.

#![no_main]

use libfuzzer_sys::fuzz_target;
use midplane::scene::expression::Expression;
use midplane::scene::{FormulaPlace, Variable};

const PLACES: [FormulaPlace; 2] = [
    FormulaPlace { x: 0.5, y: -2.0, z: 0.0, s: 0.25, load_factor: 0.75, opening: 1e-3, damage: 0.5 },
    FormulaPlace { x: 1e300, y: -1e300, z: 0.0, s: 1.0, load_factor: 1.0, opening: -1e9, damage: 1.0 },
];

fuzz_target!(|text: &str| {
    let _ = Expression::over(text, &["x", "force"]).map(|formula| formula.of_columns(&[0.5, -2.0], 0.25));
    match Expression::parse(text) {
        Err(fault) => assert!(text.get(fault.span.clone()).is_some(), "{:?} of {text:?}", fault.span),
        Ok(formula) => {
            let constant = formula.constant();
            for place in PLACES {
                let value = formula.at(&place);
                if let Some(constant) = constant {
                    assert!(value == constant || value.is_nan() && constant.is_nan());
                }
                for variable in Variable::ALL {
                    let slope = formula.derivative(&place, variable);
                    assert!(formula.uses(variable) || slope == 0.0 || slope.is_nan());
                }
            }
        }
    }
});
