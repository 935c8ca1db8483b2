//! Claim: loads, supports and histories of elastic scenes meet their exact solutions, and bodies that nothing holds, supports that
//! contradict each other and stiffness beyond double precision are told.
//!
//! ```text
//!     ┌───────┐ 2     column under its weight   u(2) = −γ 2²/2E − γ 1/K_N,  γ = ρ g
//!     │ upper │       shear in series           u = τ (Σ h/G + 1/K_T)
//!     ├───────┤ 1     moment of the joint       p (1 + x) on the top: p/12 about its middle
//!     │ lower │
//!     └─△───△─┘ 0
//! ```

use crate::common::*;
use midplane::error::{Code, Result};
use midplane::problem::Problem;
use midplane::shape::Shape;

/// Two unit squares, one above the other, with an interface.
fn two_squares(joint: Interface, steps: impl IntoIterator<Item = Step>) -> Scene {
    Scene::new("strain")
        .with("thickness", 0.5)
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.0)
        .density("rock", 2.5)
        .interface("joint", joint)
        .steps(steps)
}

fn bound(scene: &Scene) -> Result<Problem> {
    let lower = even_block([0.0, 1.0], [0.0, 1.0], [3, 3], Shape::Quadrilateral4);
    let upper = even_block([0.0, 1.0], [1.0, 2.0], [5, 4], Shape::Triangle3);
    scene.bind(vec![lower, upper])
}

/// The interface with any law.
fn joint(law: Law) -> Interface {
    faces("lower.top", "upper.bottom").law(law)
}

fn springs() -> Interface {
    joint(elastic(1e5, 2e4))
}

/// A step with the lower square held at its bottom.
fn held(name: &str) -> Step {
    step(name).fix("lower.bottom", "xy")
}

fn last(problem: &Problem) -> Vec<f64> {
    let (states, _) = solve(problem);
    states[states.len() - 1].probes(problem)
}

/// Column of height H under its own weight γ: the linear element is exact at nodes in one dimension, and the interface sees
/// the weight above it: u(H) = −γ (H²/2)/E − γ h₂/K_N. Q4 follows it exactly, T3 to its discretisation in the mean.
#[test]
fn a_column_stands_under_its_own_weight() {
    let gamma = 2.5 * 9.81;
    for weight in [
        held("weight").gravity(0.0, -9.81),
        held("weight").body_force("lower", 0.0, -24.525).body_force("upper", 0.0, -24.525),
    ] {
        let scene = two_squares(springs(), [weight]).probes([
            ("joint", "joint.resultant_n"),
            ("stored", "energy.stored"),
            ("work", "work.external"),
        ]);
        let problem = bound(&scene).unwrap();
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
    let steps = [
        step("hold").fix("lower.bottom", "x").fix("lower", "y").fix("upper", "y"),
        step("shear").increments(4).displace("upper.top", "x", 1e-3),
        step("back").increments(2).displace("upper.top", "x", 0.0),
    ];
    let scene = two_squares(springs(), steps).probes([
        ("tau", "joint.traction_t@0.25"),
        ("slip", "joint.jump_t@0.9"),
        ("work", "work.external"),
        ("stored", "energy.stored"),
    ]);
    let problem = bound(&scene).unwrap();
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
    let steps = [
        held("down").increments(2).pressure("upper.top", 4.0),
        step("on").increments(4).pressure("upper.top", 2.0).force("upper.corner", 0.3, 0.0),
    ];
    let problem = bound(&two_squares(springs(), steps)).unwrap();
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
    let scene = two_squares(springs().initial_traction(-2.0, 0.5), [held("go")]).probes([
        ("n", "joint.traction_n@0.5"),
        ("t", "joint.traction_t@0.5"),
        ("jn", "joint.jump_n@0.5"),
        ("jt", "joint.jump_t@0.5"),
        ("stored", "energy.stored"),
        ("work", "work.external"),
    ]);
    let problem = bound(&scene).unwrap();
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
        let load = held("go").pressure("upper.top", format!("{pressure} + 0*load_factor"));
        let problem = bound(&two_squares(springs().initial_traction(n, 0), [load])).unwrap();
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
    let problem = bound(&two_squares(springs(), [held("nothing")])).unwrap();
    let (states, totals) = solve(&problem);
    assert!(states[0].snapshot.u.iter().all(|&u| u == 0.0) && totals.residual == 0.0);
    assert!(states[0].snapshot.tractions[0].iter().flatten().all(|&t| t == 0.0));
}

/// A body that can move freely is named with its motion, and not solved.
#[test]
fn a_free_subdomain_is_reported_by_name_and_mode() {
    let go = || step("go").pressure("upper.top", 1.0);
    for (kn, kt, step, expected) in [
        (1e5, 0.0, go().fix("lower.bottom", "xy"), "subdomain upper can move freely: translation in x"),
        (0.0, 1e5, go().fix("lower.bottom", "xy"), "subdomain upper can move freely: translation in y"),
        (0.0, 0.0, go().fix("lower.bottom", "xy"), "subdomain upper can move freely: translation in x"),
        (1e5, 1e5, go().fix("lower.bottom", "y"), "(with "),
        (1e5, 1e5, go().fix("lower.bottom", "y"), "translation along (1.0000, 0.0000)"),
        (1e5, 1e5, go().fix("lower.corner", "xy"), "rotation about (0.0000, 0.0000)"),
    ] {
        let error = bound(&two_squares(joint(elastic(kn, kt)), [step])).unwrap_err();
        let message =
            error.to_string().replace("(-1.0000, -0.0000)", "(1.0000, 0.0000)").replace("-0.0000", "0.0000");
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert_eq!(error.exit_code(), 2);
    }
}

/// A body that only springs hold is known to ε E/(K h): told below K h/E = 1e-6, free below 1e-12 (h = 1/3, E = 1e4).
#[test]
fn a_subdomain_on_springs_of_nothing_is_hardly_constrained_or_free() {
    let on = |k: f64| bound(&two_squares(joint(elastic(k, k)), [held("go")]));
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
    let go = |step: Step| bound(&two_squares(springs(), [step]));
    assert!(go(held("go").fix("lower.left", "x")).is_ok());
    let error = go(held("go").displace("lower.left", "x", 1e-3));
    let message = error.unwrap_err().to_string();
    assert!(message.contains("steps.0.displace.lower.left") && message.contains("lower.bottom"), "{message}");
}

/// ε K_N h/E with `pointwise`: warned of from 1e-6, refused from 1e-3 with the largest stiffness that makes sense (h = 1/3,
/// E = 1e4). With `projected` the jumps are unknowns, and only what cannot be represented is refused.
#[test]
fn stiffness_beyond_double_precision_is_refused() {
    let go = |coupling: &str, kn: f64| {
        bound(&two_squares(joint(elastic(kn, 1e5)).coupling(coupling), [held("go")]))
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
        let steps = [held("first").pressure("upper.top", 1.0), step("push").pressure("upper.top", pressure)];
        let problem = bound(&two_squares(springs(), steps)).unwrap();
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
    let laws = [
        coulomb(1e5, 2e4, 0.5),
        cohesive(1e5, 2e4, [1.0, 2.0], [0.01, 0.02]),
        cracking(1e5, 2e4, [1.0, 2.0, 0.5], [0.01, 0.02]),
    ];
    for law in laws {
        for increments in [1, 3] {
            let press = |name: &str, p: f64| held(name).increments(increments).pressure("upper.top", p);
            let steps =
                [press("on", 2.0), press("off", 0.0), press("on again", 3.0), press("off again", 0.0)];
            let problem = bound(&two_squares(joint(law.clone()), steps)).unwrap();
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
    let scene = two_squares(springs(), [held("press").pressure("upper.top", "2*(1 + x)")])
        .probes([("m", "joint.moment"), ("n", "joint.resultant_n")]);
    let problem = bound(&scene).unwrap();
    let values = last(&problem);
    close(values[0], -0.5 * 2.0 / 12.0, 1e-11, 1.0, "moment");
    close(values[1], -0.5 * 3.0, 1e-11, 1.0, "force");
}
