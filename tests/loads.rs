//! Loads, supports and history on scenes with exact solutions; bodies that nothing holds.

use crate::common::*;
use midplane::error::Code;
use midplane::shape::Shape;

/// An interface between two unit squares, one above the other, with the given first lines and steps.
fn two_squares(
    head: &str,
    law: &str,
    steps: &str,
    history: &str,
) -> midplane::error::Result<midplane::problem::Problem> {
    let flat = |x: f64, y: f64| [x, y];
    let lower = rectangle(&even(0.0, 1.0, 3), &even(0.0, 1.0, 3), Shape::Quadrilateral4, flat);
    let upper = rectangle(&even(0.0, 1.0, 5), &even(1.0, 2.0, 4), Shape::Triangle3, flat);
    let text = format!(
        r#"{{ {head}
          "subdomains": {{ "lower": {{ "msh": "l", "material": "rock" }}, "upper": {{ "msh": "u", "material": "rock" }} }},
          "materials": {{ "rock": {{ "young": 1e4, "poisson": 0.0, "density": 2.5 }} }},
          "interfaces": {{ "joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", {law} }} }},
          "steps": [ {steps} ], "output": {{ "history": {{ {history} }} }} }}"#
    );
    bind(&text, vec![lower, upper])
}

const SPRINGS: &str = r#""law": { "type": "elastic", "normal_stiffness": 1e5, "tangential_stiffness": 2e4 }"#;
const HEAD: &str = r#""plane": "strain", "thickness": 0.5,"#;
const HELD: &str = r#""fix": { "lower.bottom": ["x", "y"] }"#;

fn last(problem: &midplane::problem::Problem) -> Vec<f64> {
    let (states, _) = solve(problem);
    states[states.len() - 1].probes(problem)
}

/// Column of height H under its own weight γ: the linear element is exact at nodes in one dimension, and the interface sees
/// the weight above it: u(H) = −γ (H²/2)/E − γ h₂/K_N. Q4 follows it exactly, T3 to its discretisation in the mean.
#[test]
fn a_column_stands_under_its_own_weight() {
    let gamma = 2.5 * 9.81;
    let probes = r#""joint": "joint.resultant_n", "stored": "energy.stored", "work": "work.external""#;
    for load in [
        r#""gravity": [0.0, -9.81]"#,
        r#""body_force": { "lower": [0.0, -24.525], "upper": [0.0, -24.525] }"#,
    ] {
        let steps = format!(r#"{{ "name": "weight", {HELD}, {load} }}"#);
        let problem = two_squares(HEAD, SPRINGS, &steps, probes).unwrap();
        let values = last(&problem);
        close(values[0], -gamma * 0.5, 1e-12, gamma, "the joint carries the upper body");
        close(values[1], values[2], 1e-11, values[2], "energy and work");
        close(values[4], gamma, 1e-12, gamma, "the support carries both"); // area 2, thickness 0.5
        close(values[3], 0.0, 1e-12, gamma, "no side force");
    }
}

/// Shear by a displacement: interface and bodies are springs in series. With ν = 0 and both bodies held against rotation by
/// u_y = 0 everywhere, τ = u / (2/G + 1/K_T).
#[test]
fn a_prescribed_shear_meets_springs_in_series() {
    let steps = r#"{ "name": "hold", "fix": { "lower.bottom": ["x"], "lower": ["y"], "upper": ["y"] } },
                   { "name": "shear", "increments": 4, "displace": { "upper.top": { "x": 1e-3 } } },
                   { "name": "back", "increments": 2, "displace": { "upper.top": { "x": 0.0 } } }"#;
    let probes = r#""tau": "joint.traction_t@0.25", "slip": "joint.jump_t@0.9", "work": "work.external", "stored": "energy.stored""#;
    let problem = two_squares(HEAD, SPRINGS, steps, probes).unwrap();
    let (states, totals) = solve(&problem);
    // the first step holds other dofs than the second; the third holds the same
    assert_eq!((states.len(), totals.increments, totals.factorisations), (7, 7, 2));
    let tau = 1e-3 / (2.0 / 5e3 + 1.0 / 2e4);
    for (state, share) in states.iter().zip([0.0, 0.25, 0.5, 0.75, 1.0, 0.5, 0.0]) {
        let values = state.probes(&problem);
        close(values[0], share * tau, 1e-11, tau, "τ");
        close(values[1], share * tau / 2e4, 1e-11, tau / 2e4, "slip");
        // elastic: the work depends on where we are, not on the way
        close(values[2], share * share * 0.5 * 0.5 * tau * 1e-3, 1e-11, tau * 1e-3, "work");
        close(values[3], values[2], 1e-11, tau * 1e-3, "stored");
        let reaction = problem.reactions.iter().position(|r| r.group == "upper.top").unwrap();
        close(values[4 + reaction], share * tau * 0.5, 1e-11, tau, "reaction");
    }
}

/// Loads ramp from their last value to the new one; a force at a point moves its reaction.
#[test]
fn loads_ramp_from_their_last_value() {
    let steps = format!(
        r#"{{ "name": "down", "increments": 2, {HELD}, "load": {{ "upper.top": {{ "pressure": 4.0 }} }} }},
           {{ "name": "on", "increments": 4, "load": {{ "upper.top": {{ "pressure": 2.0 }}, "upper.corner": {{ "force": [0.3, 0.0] }} }} }}"#
    );
    let problem = two_squares(HEAD, SPRINGS, &steps, "").unwrap();
    let (states, totals) = solve(&problem);
    assert_eq!(totals.factorisations, 1);
    let pressures = [2.0, 4.0, 3.5, 3.0, 2.5, 2.0];
    let forces = [0.0, 0.0, 0.075, 0.15, 0.225, 0.3];
    for ((state, p), f) in states.iter().zip(pressures).zip(forces) {
        let reactions = state.probes(&problem); // x, y of lower.bottom
        close(reactions[0], -f, 1e-12, 1.0, "x");
        close(reactions[1], 0.5 * p, 1e-12, 1.0, "y");
    }
}

/// An initial traction t₀ on a free interface opens it by −t₀/K until nothing is left (paper eq. 10).
#[test]
fn an_initial_traction_relaxes_to_nothing_where_nothing_resists() {
    let law = format!(r#"{SPRINGS}, "initial_traction": [-2.0, 0.5]"#);
    let probes = r#""n": "joint.traction_n@0.5", "t": "joint.traction_t@0.5", "jn": "joint.jump_n@0.5", "jt": "joint.jump_t@0.5", "stored": "energy.stored", "work": "work.external""#;
    let problem = two_squares(HEAD, &law, &format!(r#"{{ "name": "go", {HELD} }}"#), probes).unwrap();
    let values = last(&problem);
    close(values[0], 0.0, 1e-12, 1.0, "t_n");
    close(values[1], 0.0, 1e-12, 1.0, "t_t");
    close(values[2], 2.0 / 1e5, 1e-11, 2e-5, "jump n");
    close(values[3], -0.5 / 2e4, 1e-11, 2.5e-5, "jump t");
    // the springs give back what they had stored: −½ t₀²/K per area
    close(values[4], -0.5 * 0.5 * (4.0 / 1e5 + 0.25 / 2e4), 1e-11, 1e-5, "energy");
}

/// An initial traction acts on both sides; what of it and of the first loads is not held by supports is out of balance, over the sum of
/// the initial forces: all of 2 t₀, and a pressure p on the other end of a body beside it. The springs alone release ½ t₀²/K per area.
#[test]
fn what_an_initial_traction_lacks_of_balance_is_told() {
    for (n, pressure) in [(-2.0, 0.0), (-0.02, 0.0), (-6.0, 3.0), (-2.0, 5.0)] {
        let law = format!(r#"{SPRINGS}, "initial_traction": [{n}, 0]"#);
        let load = format!(r#""load": {{ "upper.top": {{ "pressure": "{pressure} + 0*load_factor" }} }}"#);
        let problem = two_squares(HEAD, &law, &format!(r#"{{ "name": "go", {HELD}, {load} }}"#), "").unwrap();
        let (_, totals) = solve(&problem);
        let exact = 1.0 - 0.5 * pressure / n;
        close(totals.initial.rest, exact, 1e-10, 1.0, &format!("{n}, {pressure}"));
        if pressure == 0.0 {
            close(totals.initial.released, 0.5 * 0.5 * n * n / 1e5, 1e-9, 1e-8, "released");
        }
    }
}

/// Zero load gives zeros exactly.
#[test]
fn zero_load_gives_zeros() {
    let problem = two_squares(HEAD, SPRINGS, &format!(r#"{{ "name": "nothing", {HELD} }}"#), "").unwrap();
    let (states, totals) = solve(&problem);
    assert!(states[0].snapshot.u.iter().all(|&u| u == 0.0) && totals.residual == 0.0);
    assert!(states[0].snapshot.tractions[0].iter().flatten().all(|&t| t == 0.0));
}

/// What can move freely is named with its motion, and not solved.
#[test]
fn a_free_subdomain_is_reported_by_name_and_mode() {
    let springs = |kn: f64, kt: f64| {
        format!(r#""law": {{ "type": "elastic", "normal_stiffness": {kn}, "tangential_stiffness": {kt} }}"#)
    };
    for (law, fix, expected) in [
        (
            springs(1e5, 0.0),
            r#"{ "lower.bottom": ["x", "y"] }"#,
            "subdomain upper can move freely: translation in x",
        ),
        (
            springs(0.0, 1e5),
            r#"{ "lower.bottom": ["x", "y"] }"#,
            "subdomain upper can move freely: translation in y",
        ),
        (
            springs(0.0, 0.0),
            r#"{ "lower.bottom": ["x", "y"] }"#,
            "subdomain upper can move freely: translation in x",
        ),
        (springs(1e5, 1e5), r#"{ "lower.bottom": ["y"] }"#, "(with "),
        (springs(1e5, 1e5), r#"{ "lower.bottom": ["y"] }"#, "translation along (1.0000, 0.0000)"),
        (springs(1e5, 1e5), r#"{ "lower.corner": ["x", "y"] }"#, "rotation about (0.0000, 0.0000)"),
    ] {
        let steps =
            format!(r#"{{ "name": "go", "fix": {fix}, "load": {{ "upper.top": {{ "pressure": 1.0 }} }} }}"#);
        let error = two_squares(HEAD, &law, &steps, "").unwrap_err();
        let message =
            error.to_string().replace("(-1.0000, -0.0000)", "(1.0000, 0.0000)").replace("-0.0000", "0.0000");
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert_eq!(error.exit_code(), 2);
    }
}

/// A body that only springs hold is known to ε E/(K h): told below K h/E = 1e-6, free below 1e-12 (h = 1/3, E = 1e4).
#[test]
fn a_subdomain_on_springs_of_nothing_is_hardly_constrained_or_free() {
    let on = |k: f64| {
        let law = format!(
            r#""law": {{ "type": "elastic", "normal_stiffness": {k:e}, "tangential_stiffness": {k:e} }}"#
        );
        let steps = r#"{ "name": "go", "fix": { "lower.bottom": ["x", "y"] } }"#;
        two_squares(HEAD, &law, steps, "")
    };
    assert!(on(1.0).unwrap().warnings.is_empty());
    let told = on(1e-3).unwrap().warnings;
    assert!(told.len() == 1 && told[0].code == Code::HardlyHeld, "{told:?}");
    assert!(told[0].what.contains("subdomain upper is hardly held"), "{told:?}");
    for k in [1e-10, 5e-324] {
        let message = on(k).unwrap_err().to_string();
        assert!(message.contains("subdomain upper can move freely"), "{message}");
    }
}

/// One dof, two values: refused, naming both groups; the same value twice is fine.
#[test]
fn conflicting_supports_are_refused() {
    let go = |fix: &str| two_squares(HEAD, SPRINGS, &format!(r#"{{ "name": "go", {fix} }}"#), "");
    assert!(go(r#""fix": { "lower.bottom": ["x", "y"], "lower.left": ["x"] }"#).is_ok());
    let error = go(r#""fix": { "lower.bottom": ["x", "y"] }, "displace": { "lower.left": { "x": 1e-3 } }"#);
    let message = error.unwrap_err().to_string();
    assert!(message.contains("steps.0.displace.lower.left") && message.contains("lower.bottom"), "{message}");
}

/// ε K_N h/E with `pointwise`: warned of from 1e-6, refused from 1e-3 with the largest stiffness that makes sense (h = 1/3,
/// E = 1e4). With `projected` the jumps are unknowns, and only what cannot be represented is refused.
#[test]
fn stiffness_beyond_double_precision_is_refused() {
    let go = |coupling: &str, kn: f64| {
        let law = format!(
            r#""coupling": "{coupling}",
               "law": {{ "type": "elastic", "normal_stiffness": {kn:e}, "tangential_stiffness": 1e5 }}"#
        );
        two_squares(HEAD, &law, &format!(r#"{{ "name": "go", {HELD} }}"#), "")
    };
    assert!(go("pointwise", 1e12).unwrap().warnings.iter().all(|warning| !warning.what.contains("rounding")));
    assert!(go("pointwise", 1e15).unwrap().warnings[0].what.contains("K_N h/E = 3.3e10"));
    let message = go("pointwise", 1e18).unwrap_err().to_string();
    assert!(message.contains("interfaces.joint.law.normal_stiffness: K_N h/E = 3.3e13"), "{message}");
    assert!(message.contains("take 1e14 or less"), "{message}");
    assert!(go("projected", 1e24).unwrap().warnings.is_empty());
    let message = go("projected", 1e110).unwrap_err().to_string();
    assert!(message.contains("K_N h/E = 3.3e105 is beyond double precision"), "{message}");
}

/// Loads that overflow end as no equilibrium, never as numbers that are none.
#[test]
fn overflow_is_no_equilibrium() {
    for pressure in [1e307, 1.7e308] {
        let steps = format!(
            r#"{{ "name": "first", {HELD}, "load": {{ "upper.top": {{ "pressure": 1.0 }} }} }},
               {{ "name": "push", "load": {{ "upper.top": {{ "pressure": {pressure:e} }} }} }}"#
        );
        let problem = two_squares(HEAD, SPRINGS, &steps, "").unwrap();
        let mut kept = 0;
        let error = each_increment(&problem, |increment, _| kept = increment.increment).unwrap_err();
        assert_eq!((kept, error.exit_code()), (1, 3));
        let message = error.to_string();
        assert!(
            message.contains("step \"push\", increment 1") && message.contains("overflowed"),
            "{message}"
        );
    }
}

/// Residuals count against what was carried before where nothing is carried any more.
#[test]
fn a_load_may_be_taken_off_wholly() {
    let springs = r#""normal_stiffness": 1e5, "tangential_stiffness": 2e4"#;
    let laws = [
        format!(r#"{{ "type": "coulomb", {springs}, "friction_coefficient": 0.5 }}"#),
        format!(
            r#"{{ "type": "cohesive", {springs}, "tensile_strength": 1.0, "shear_strength": 2.0, "fracture_energy_i": 0.01,
               "fracture_energy_ii": 0.02 }}"#
        ),
        format!(
            r#"{{ "type": "cracking", {springs}, "tensile_strength": 1.0, "cohesion": 2.0, "tan_friction": 0.5,
               "fracture_energy_i": 0.01, "fracture_energy_iia": 0.02, "dilatancy_stress": 0 }}"#
        ),
    ];
    for law in laws {
        for increments in [1, 3] {
            let step = |name: &str, pressure: f64| {
                format!(
                    r#"{{ "name": "{name}", "increments": {increments}, {HELD}, "load": {{ "upper.top": {{ "pressure": {pressure} }} }} }}"#
                )
            };
            let steps = [step("on", 2.0), step("off", 0.0), step("on again", 3.0), step("off again", 0.0)];
            let problem = two_squares(HEAD, &format!(r#""law": {law}"#), &steps.join(", "), "").unwrap();
            let (states, totals) = solve(&problem);
            for off in [2, 4] {
                for t in &states[off * increments - 1].snapshot.tractions[0] {
                    close(t.norm(), 0.0, 1e-12, 3.0, "what is left in the joint");
                }
            }
            assert!(totals.iterations <= 2 * states.len(), "{law}: {} iterations", totals.iterations);
        }
    }
}

/// Statics alone: p (1 + x) on the top turns about the middle of the joint by p/12 per thickness.
#[test]
fn the_moment_of_a_joint_is_that_of_the_load_above() {
    let steps =
        format!(r#"{{ "name": "press", {HELD}, "load": {{ "upper.top": {{ "pressure": "2*(1 + x)" }} }} }}"#);
    let problem =
        two_squares(HEAD, SPRINGS, &steps, r#""m": "joint.moment", "n": "joint.resultant_n""#).unwrap();
    let values = last(&problem);
    close(values[0], -0.5 * 2.0 / 12.0, 1e-11, 1.0, "moment");
    close(values[1], -0.5 * 3.0, 1e-11, 1.0, "force");
}
