//! Claim: parts come free of stress where their neighbours are, and go with their forces let go over a step.
//!
//! ```text
//!     ↓ p  ┌───────┐      weight γ of both, ν = 0, E, joint K: blocks of height H = 1
//!          │   b   │      b comes later:  joint  σ = −γ_b H,  a  u(H) = −γ_a H²/2E − γ_b H²/E
//!          ├───────┤                       b  u(2H) = Δu_a − γ_b H/K − γ_b H²/2E from where it came
//!          │   a   │      b goes by half:  a keeps half of what lay on it
//!          └───────┘
//! ```

use crate::common::*;
use midplane::error::Result;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::json;

const E: f64 = 1e4;
const K: f64 = 5e4;
const GAMMA: [f64; 2] = [20.0, 24.0];

fn springs() -> Law {
    elastic(5e4, 5e4)
}

fn friction() -> Law {
    coulomb(5e4, 5e4, 0.6)
}

fn rock() -> Law {
    cracking(5e4, 5e4, [300.0, 500.0, 0.7], [100.0, 1000.0])
}

fn scene(law: Law, subdomains: [Subdomain; 2]) -> Scene {
    let [a, b] = subdomains;
    Scene::new("stress")
        .body("a", a)
        .body("b", b)
        .material("a", E, 0.0)
        .density("a", GAMMA[0])
        .material("b", E, 0.0)
        .density("b", GAMMA[1])
        .interface("joint", faces("a.top", "b.bottom").law(law))
}

fn blocks() -> Vec<Mesh> {
    let block = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 1.0], [n, 2], Shape::Quadrilateral8);
    vec![block(3, 0.0), block(4, 1.0)]
}

fn stack(law: &Law, strategy: &str, steps: impl IntoIterator<Item = Step>) -> Result<Problem> {
    let scene = scene(law.clone(), [mesh("a", "a"), mesh("b", "b")]);
    scene.solution("strategy", strategy).steps(steps).bind(blocks())
}

fn weight() -> Step {
    step("ground").gravity(0, -1).fix("a.bottom", "xy")
}

fn top(problem: &Problem, state: &ModelState, subdomain: usize) -> f64 {
    displacement(problem, state, subdomain, group(problem, subdomain, "top")[0])[1]
}

#[test]
fn a_lift_comes_where_its_neighbours_are() {
    let come = step("lift").increments(3).activate(["b"]);
    for law in [springs(), friction(), rock()] {
        for strategy in ["auto", "condensed", "blocks", "plain"] {
            let problem = stack(&law, strategy, [weight(), come.clone()]).unwrap();
            let (states, _) = solve(&problem);
            let alone = -GAMMA[0] / (2.0 * E);
            let scale = GAMMA[1] / E;
            close(top(&problem, &states[0], 0), alone, 1e-11, scale, "a alone");
            close(top(&problem, &states[0], 1), 0.0, 1e-16, scale, "b is not there");
            assert!(states[0].snapshot.presence.absent[0] && !states[1].snapshot.presence.absent[0]);
            assert!(states[0].snapshot.tractions[0].iter().all(|t| t.norm() == 0.0));
            for (k, state) in states[1..].iter().enumerate() {
                let share = (k + 1) as f64 / 3.0;
                let below = -share * GAMMA[1] / E;
                close(
                    top(&problem, state, 0),
                    alone + below,
                    1e-10,
                    scale,
                    &format!("{law} {strategy}: a under b"),
                );
                let above = below - share * GAMMA[1] * (1.0 / K + 1.0 / (2.0 * E));
                close(top(&problem, state, 1), above, 1e-10, scale, "b since it came");
                for (t, r) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
                    close(t[0], -share * GAMMA[1], 1e-10, GAMMA[1], "t_n");
                    close(r[0], -share * GAMMA[1] / K, 1e-10, GAMMA[1] / K, "jump since it came");
                }
                assert!(state.energy_balance().abs() < 1e-10, "{}", state.energy_balance());
            }
        }
    }
}

/// Forces of b on a go by half, wait, and go wholly; the energy stored in b goes with it.
#[test]
fn forces_are_held_and_let_go() {
    held_and_let_go(step("load").pressure("b.top", 30));
}

/// Water between the two carries a part of what lies on it: the whole is the same.
#[test]
fn forces_of_water_are_held_and_let_go() {
    for pressure in [json!(7), json!("7 + 100*opening")] {
        held_and_let_go(step("load").pressure("b.top", 30).pressure("joint", pressure));
    }
}

fn held_and_let_go(load: Step) {
    let half = step("half").increments(2).deactivate("b", 0.5);
    let rest = step("rest").increments(2).deactivate("*b", 1.0);
    for law in [springs(), friction()] {
        for strategy in ["auto", "plain", "blocks"] {
            let steps = [weight(), load.clone(), half.clone(), step("wait"), rest.clone()];
            let problem = stack(&law, strategy, steps).unwrap();
            let (states, _) = solve(&problem);
            let on = 30.0 + GAMMA[1];
            let own = -GAMMA[0] / (2.0 * E);
            let left = [GAMMA[1], on, 0.75 * on, 0.5 * on, 0.5 * on, 0.25 * on, 0.0];
            for (k, (state, left)) in states.iter().zip(left).enumerate() {
                close(
                    top(&problem, state, 0),
                    own - left / E,
                    1e-10,
                    on / E,
                    &format!("{law} {strategy}: a, row {k}"),
                );
                assert!(state.energy_balance().abs() < 1e-9, "row {k}: {}", state.energy_balance());
            }
            let last = states.last().unwrap();
            assert!(top(&problem, last, 1).abs() < 1e-30);
            assert!(last.snapshot.stresses[1].cells.iter().flatten().all(|s| s.abs() < 1e-30));
            // a alone stores γ²/6E, whatever was there between
            close(last.stored, GAMMA[0] * GAMMA[0] / (6.0 * E), 1e-9, 0.01, "stored");
        }
    }
}

/// The slip of a part is forgotten when it goes: the joint is as at the start while the part is away.
#[test]
fn a_part_that_goes_takes_its_slip_along() {
    let load = step("load").pressure("b.top", 30);
    let slide = step("slide").displace("b.top", "x", 0.05);
    let away = step("away").deactivate("b", 1.0);
    let problem = stack(&friction(), "auto", [weight(), load, slide, away]).unwrap();
    let (states, _) = solve(&problem);
    let slip = |state: &ModelState| {
        state.snapshot.states[0].iter().map(|state| state.jump_plastic.norm()).fold(0.0, f64::max)
    };
    assert!(slip(&states[2]) > 1e-6, "{}", slip(&states[2]));
    assert_eq!(slip(&states[3]), 0.0);
    assert!(states[3].snapshot.jumps[0].iter().all(|jump| jump.norm() == 0.0));
}

/// Taken away and filled again without stress, twice: the same every time.
#[test]
fn taking_away_and_filling_again_repeats() {
    let away = |n: usize| step(format!("away {n}")).deactivate("b", 1.0);
    let fill = |n: usize| step(format!("fill {n}")).activate(["b"]);
    for law in [springs(), friction(), rock()] {
        let problem = stack(&law, "auto", [weight(), away(1), fill(1), away(2), fill(2)]).unwrap();
        let (states, _) = solve(&problem);
        for (one, two) in [(1, 3), (2, 4)] {
            let scale = GAMMA[1] / E;
            for (a, b) in states[one].snapshot.u.iter().zip(&states[two].snapshot.u) {
                close(*a, *b, 1e-10, scale, &law.to_string());
            }
            for (a, b) in states[one].snapshot.tractions[0].iter().zip(&states[two].snapshot.tractions[0]) {
                close((a - b).norm(), 0.0, 1e-10, GAMMA[1], &law.to_string());
            }
        }
    }
}

/// A part under initial stress goes: its neighbours lose what it carried, and what comes in its place carries nothing from before.
#[test]
fn ground_is_dug_and_filled() {
    let ground = |name: &str, top: f64, q: f64| {
        let stress = json!({ "gravity": [0, -1], "surface": top, "overburden": q, "k0": 0 });
        mesh(name, name).with("initial_stress", stress)
    };
    let scene = scene(friction(), [ground("a", 1.0, GAMMA[1]), ground("b", 2.0, 0.0)])
        .step(weight())
        .step(step("dig").increments(2).deactivate("b", 1))
        .step(step("fill").activate(["b"]));
    let problem = scene.bind(blocks()).unwrap();
    assert!(problem.warnings.is_empty(), "{:?}", problem.warnings);
    let (states, _) = solve(&problem);
    let scale = GAMMA[1] / E;
    for (state, heave) in states.iter().zip([0.0, 0.5, 1.0, 0.0]) {
        close(top(&problem, state, 0), heave * scale, 1e-10, scale, "heave");
    }
    let last = states.last().unwrap();
    close(top(&problem, last, 1), -scale * (1.0 + E / K + 0.5), 1e-10, scale, "what was filled settles");
    for s in &last.snapshot.stresses[1].nodes {
        assert!(s[1] <= 1e-9 && s[1] >= -GAMMA[1] - 1e-9, "{s:?}");
    }
}

/// Strains of a part count from when it comes: those before leave no stress, later ones move its free top by Δε H.
#[test]
fn strains_of_a_part_count_from_when_it_comes() {
    let strain = |name: &str, yy: f64| step(name).strain("b", vec![0.0, yy, 0.0, 0.0]);
    let before = strain("before", 3e-4).fix("a.bottom", "xy");
    for law in [springs(), rock()] {
        let steps = [before.clone(), step("come").activate(["b"]), strain("after", 5e-4)];
        let problem = stack(&law, "auto", steps).unwrap();
        let (states, _) = solve(&problem);
        for (state, exact) in states.iter().zip([0.0, 0.0, 2e-4]) {
            close(top(&problem, state, 1), exact, 1e-12, 1e-4, "free top");
            let stresses = state.snapshot.stresses[1].cells.iter().flatten();
            assert!(stresses.into_iter().all(|s| s.abs() < 1e-10), "no stress");
        }
    }
}

#[test]
fn what_cannot_come_or_go_is_refused() {
    let refused = |steps: &[Step]| {
        let steps = [weight()].into_iter().chain(steps.iter().cloned());
        stack(&springs(), "auto", steps).unwrap_err().to_string()
    };
    let gone = |name: &str, share: f64| step(name).deactivate("b", share);
    let there = |name: &str| step(name).activate(["b"]);
    let message = refused(&[step("s").activate(["c*"])]);
    assert!(message.contains("no subdomain is called like \"c*\""), "{message}");
    let message = refused(&[gone("s", 1.0), gone("t", 1.0)]);
    assert!(message.contains("steps.2.deactivate.b") && message.contains("is not there"), "{message}");
    let message = refused(&[gone("s", 1.5)]);
    assert!(message.contains("1.5 is no share"), "{message}");
    let message = refused(&[there("s"), there("t")]);
    assert!(message.contains("is there already"), "{message}");
    let message = refused(&[gone("s", 0.5), there("t")]);
    assert!(message.contains("is not wholly let go"), "{message}");
    let message = refused(&[gone("s", 1.0).pressure("b.top", 1)]);
    assert!(
        message.contains("steps.1.load.b.top") && message.contains("is not there in this step"),
        "{message}"
    );
}
