//! Claim: a joint with a `closure` follows its hyperbola under any load and back, pressed in one increment to thirty times K V too;
//! friction on it is Coulomb's, and dilatancy adds to the closure until it ends.
//!
//! ```text
//!     ↓ p   ┌───────┐          u = −p/(K + p/V) − e₀,  e₀ = σ₀/(K − σ₀/V) under an initial σ₀
//!           │   b   │          u = −p/K, pulled (`elastic` alone)
//!           └───────┘          stored K V² (x − 1 − ln x),  x = 1/(1 + p/(K V))
//!           ┌───────┐          slid by D under p:  u_n = −p/(K + p/V) + tanψ min(λ, end),  λ = D − μ p/K_T
//!           └───a───┘
//! ```

use crate::common::*;
use midplane::error::Result;
use midplane::law::Local;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::json;

const E: f64 = 1e4;
const K: f64 = 1e4;
const V: f64 = 2e-4;
const KT: f64 = 5e3;
/// Jumps and tractions are found to this.
const TOLERANCE: f64 = 1e-9;

/// A law with a closure; "coulomb" has friction too.
fn closing(kind: &str) -> Law {
    let closure = json!({ "initial_stiffness": K, "maximum": V });
    let closing = law(kind).with("closure", closure).with("tangential_stiffness", KT);
    if kind == "coulomb" { closing.with("friction_coefficient", 0.5) } else { closing }
}

/// Two blocks of 1 m × 0.5 m on top of each other.
fn scene(joint: Interface, steps: impl IntoIterator<Item = Step>) -> Scene {
    Scene::new("strain")
        .subdomains(["a", "b"], "rock")
        .material("rock", E, 0.0)
        .interface("joint", joint)
        .steps(steps)
}

fn blocks(scene: Scene) -> Result<Problem> {
    let block = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 0.5], [n, 3], Shape::Quadrilateral4);
    scene.bind(vec![block(4, -0.5), block(7, 0.0)])
}

fn joint(law: Law) -> Interface {
    faces("a.top", "b.bottom").law(law)
}

/// A step to a pressure in so many increments.
fn press(name: &str, pressure: f64, increments: usize) -> Step {
    held(name, increments).pressure("b.top", pressure)
}

fn held(name: &str, increments: usize) -> Step {
    step(name).increments(increments).fix("a.bottom", "xy").fix("b.left", "x")
}

/// Normal jump under a pressure, from no traction.
fn jump_under(pressure: f64) -> f64 {
    if pressure < 0.0 { -pressure / K } else { -pressure / (K + pressure / V) }
}

fn stored_under(pressure: f64) -> f64 {
    if pressure < 0.0 {
        return 0.5 * pressure * pressure / K;
    }
    let x = 1.0 / (1.0 + pressure / (K * V));
    K * V * V * (x - 1.0 - x.ln())
}

#[test]
fn loads_go_up_and_down_the_hyperbola() {
    let kv = K * V;
    // up to thirty times K V at once and off it at once, in increments, and pulled where the law is
    let program = [(30.0 * kv, 1), (0.0, 1), (6.0 * kv, 5), (0.1 * kv, 3), (180.0 * kv, 2), (0.0, 4)];
    for kind in ["elastic", "coulomb"] {
        let pulled = if kind == "elastic" { -0.5 * kv } else { 0.2 * kv };
        let program: Vec<(f64, usize)> = program.into_iter().chain([(pulled, 2), (3.0 * kv, 1)]).collect();
        let steps: Vec<Step> =
            program.iter().enumerate().map(|(k, (p, n))| press(&format!("s{k}"), *p, *n)).collect();
        for strategy in ["condensed", "blocks", "plain"] {
            let scene = scene(joint(closing(kind)), steps.clone()).solution("strategy", strategy);
            let problem = blocks(scene).unwrap();
            let (states, _) = solve(&problem);
            let mut pressures = Vec::new();
            let mut before = 0.0;
            for (end, n) in &program {
                pressures.extend((1..=*n).map(|k| before + (end - before) * k as f64 / *n as f64));
                before = *end;
            }
            assert_eq!(states.len(), pressures.len());
            for (state, p) in states.iter().zip(pressures) {
                for (t, u) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
                    close(t[0], -p, TOLERANCE, 180.0 * kv, &format!("{kind} {strategy} t_n under {p}"));
                    close(u[0], jump_under(p), TOLERANCE, V, &format!("{kind} {strategy} u_n under {p}"));
                    close(t[1], 0.0, TOLERANCE, kv, "t_t");
                }
                let bodies = 0.5 * p * p / E;
                let exact = stored_under(p) + bodies;
                close(
                    state.stored,
                    exact,
                    TOLERANCE,
                    30.0 * kv * V,
                    &format!("{kind} {strategy} energy under {p}"),
                );
            }
        }
    }
}

#[test]
fn an_initial_traction_has_closed_the_joint_before() {
    let kv = K * V;
    let sigma = -2.0 * kv;
    for kind in ["elastic", "coulomb"] {
        // held from the start
        let pressed = held("as it was", 1).pressure("b.top", format!("{} + 0*load_factor", 2.0 * kv));
        let steps = [pressed, press("more", 9.0 * kv, 3), press("less", 0.5 * kv, 2)];
        let joint = joint(closing(kind)).initial_traction(sigma, 0);
        let problem = blocks(scene(joint, steps)).unwrap();
        let (states, _) = solve(&problem);
        for (state, p) in [0, 3, 5].map(|k| &states[k]).into_iter().zip([2.0, 9.0, 0.5]) {
            let exact = jump_under(p * kv) - jump_under(2.0 * kv);
            for (t, u) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
                close(t[0], -p * kv, TOLERANCE, kv, "t_n");
                close(u[0], exact, TOLERANCE, V, &format!("{kind}: u_n under {p} K V"));
            }
        }
    }
}

#[test]
fn dilatancy_opens_what_is_closed_until_it_ends() {
    let (mu, psi, end) = (0.6, 0.3, 4e-4);
    let p = 3.0 * K * V;
    let law =
        closing("coulomb").with("friction_coefficient", mu).with("dilatancy", psi).with("dilatancy_end", end);
    let slide = |x: f64| {
        step(format!("to {x}"))
            .increments(6)
            .fix("a.bottom", "y")
            .fix("a", "x")
            .pressure("b.top", p)
            .displace("b", "x", x)
    };
    let steps = [slide(0.0), slide(3e-3), slide(-1e-3)];
    // both blocks move as one along the joint
    let problem = blocks(scene(joint(law), steps)).unwrap();
    let (states, _) = solve(&problem);
    let stick = mu * p / KT;
    for (k, state) in states.iter().enumerate().skip(6) {
        let way = if k < 12 { 3e-3 * (k - 5) as f64 / 6.0 } else { 3e-3 - 4e-3 * (k - 11) as f64 / 6.0 };
        let slip = if k < 12 {
            (way - stick).max(0.0)
        } else {
            (3e-3 - stick) + (3e-3 - way - 2.0 * stick).max(0.0)
        };
        let exact = jump_under(p) + psi * slip.min(end);
        for (t, u) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
            close(t[0], -p, TOLERANCE, p, "t_n");
            close(u[0], exact, TOLERANCE, V, &format!("u_n slid by {way}"));
        }
    }
}

#[test]
fn a_joint_cannot_close_by_its_maximum() {
    let law: midplane::law::Law = serde_json::from_value(closing("elastic").into()).unwrap();
    let start = law.initial_state(Local::zeros(), 0.0).unwrap();
    let step = midplane::law::Integration::Tolerance(1e-4);
    assert!(law.respond(Local::new(-0.999_999 * V, 0.0, 0.0), &start, step).is_ok());
    for part in [1.0, 2.0] {
        let refused = law.respond(Local::new(-part * V, 0.0, 0.0), &start, step).unwrap_err().to_string();
        assert!(refused.contains("closes the joint by its maximum of 2e-4 or more"), "{refused}");
    }
}

#[test]
fn a_closure_is_instead_of_a_stiffness() {
    let refused = |law: Law| match blocks(scene(joint(law), [press("s", 1.0, 1)])) {
        Ok(_) => "accepted".to_string(),
        Err(error) => error.to_string(),
    };
    for kind in ["elastic", "coulomb"] {
        let both = refused(closing(kind).with("normal_stiffness", 1e4));
        assert!(both.contains("law.closure") && both.contains("normal_stiffness are given"), "{both}");
        let without = law(kind).with("tangential_stiffness", 1e4);
        let without = if kind == "elastic" { without } else { without.with("friction_coefficient", 0.5) };
        let none = refused(without);
        assert!(none.contains("law.normal_stiffness") && none.contains("no normal stiffness"), "{none}");
        let wrong = refused(closing(kind).with_in("closure", "maximum", 0));
        assert!(
            wrong.contains("law.closure.maximum") && wrong.contains("it must be more than zero"),
            "{wrong}"
        );
        let varies = refused(closing(kind).with_in("closure", "maximum", "0.5 - x"));
        assert!(varies.contains("law.closure.maximum") && varies.contains(" at (0."), "{varies}");
    }
    let overlap = joint(closing("coulomb")).with("initial_gap", -3e-4);
    let overlap = blocks(scene(overlap, [press("s", 1.0, 1)])).unwrap_err().to_string();
    assert!(overlap.contains("initial_gap") && overlap.contains("more of an overlap"), "{overlap}");
}
