//! Claim: the cracking law reproduces ten curves of an independent implementation.
//!
//! The curves (tests/reference) were integrated to 1e-9 or better by another program with another method. They list
//! the error that an exact backward Euler solver makes with 10 and with 100 equal steps per stored point: plain backward
//! Euler must be that good, error control must be as good as its tolerance says.

use crate::common::laws::{CURVES, Reference};
use midplane::law::Integration;

#[test]
fn plain_backward_euler_makes_the_errors_listed_with_the_curves() {
    for name in CURVES {
        let reference = Reference::read(name);
        for steps in [10, 100] {
            let errors = reference.errors(&reference.drive(Integration::BackwardEuler(steps)));
            let listed = &reference.file["accuracy"]["backward_euler_max_error_with_n_substeps_per_point"];
            let rounding = [1e-12, 1e-12, 1e-12]; // MPa, MPa, –: where the list has zeros
            for (i, key) in ["sigma", "tau", "W_over_gf1"].into_iter().enumerate() {
                let allowed = 1.5 * listed[steps.to_string()][key].as_f64().unwrap() + rounding[i];
                assert!(errors[i] <= allowed, "{name}, {steps} steps, {key}: {:e} > {allowed:e}", errors[i]);
            }
        }
    }
}

#[test]
fn under_error_control_the_curves_are_met_to_the_tolerance() {
    for name in CURVES {
        let reference = Reference::read(name);
        let errors = reference.errors(&reference.drive(Integration::Tolerance(1e-6)));
        println!("{name}: {:.1e} MPa, {:.1e} MPa, {:.1e} G_I", errors[0], errors[1], errors[2]);
        assert!(errors[0].max(errors[1]) <= 1e-5, "{name}: {errors:?}");
    }
}

/// Second order: a hundredth of the tolerance is about a hundredth of the error, for ten times the sub-steps.
#[test]
fn the_error_follows_the_tolerance() {
    for name in CURVES {
        let reference = Reference::read(name);
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            let errors = reference.errors(&reference.drive(Integration::Tolerance(tolerance)));
            let strength = reference.file["parameters"]["c0"].as_f64().unwrap(); // the larger one in all ten
            assert!(errors[0].max(errors[1]) <= tolerance * strength, "{name}, {tolerance:e}: {errors:?}");
        }
    }
}
