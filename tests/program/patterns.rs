//! Claim: a pattern in a step is the names that fit it, and the reaction of a pattern the sum over all its nodes, each counted once.

use crate::common::*;
use midplane::error::Result;
use midplane::history::ModelState;
use midplane::mesh::{Facet, Group};
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::{Value, json};

fn springs() -> Law {
    elastic(1e5, 5e4)
}

/// Three blocks on top of each other, each of 1 m × 0.5 m.
fn scene() -> Scene {
    Scene::new("strain")
        .subdomains(["base", "brick_1", "brick_2"], "m")
        .material("m", 1e4, 0.2)
        .density("m", 2.0)
        .expansion("m", 1e-5)
        .interface("j", between("*", "*").law(springs()))
}

fn tower(steps: impl IntoIterator<Item = Step>, history: &[(&str, Value)]) -> Result<Problem> {
    let scene =
        history.iter().fold(scene().steps(steps), |scene, (name, column)| scene.column(name, column.clone()));
    let block = |k: usize, n: usize| {
        let y = 0.5 * k as f64;
        even_block([0.0, 1.0], [y, y + 0.5], [n, 3], Shape::Quadrilateral4)
    };
    scene.bind(vec![block(0, 4), block(1, 5), block(2, 3)])
}

fn last(steps: [Step; 3]) -> (Problem, ModelState) {
    let problem = tower(steps, &[]).unwrap();
    let state = solve(&problem).0.pop().unwrap();
    (problem, state)
}

#[test]
fn a_pattern_is_the_names_that_fit_it() {
    let explicit = [
        step("a")
            .fix("base.bottom", "y")
            .fix("base.left", "x")
            .fix("brick_1.left", "x")
            .fix("brick_2.left", "x")
            .traction("brick_1.right", "-y", 0)
            .traction("brick_2.right", "-y", 0)
            .body_force("brick_1", 0, -1)
            .body_force("brick_2", 0, -1)
            .with_in("gravity", "base", vec![0, -3])
            .temperature("brick_1", 5)
            .temperature("brick_2", 5)
            .strain("base", vec![1e-5, 0.0, 0.0, 0.0])
            .strain("brick_1", vec![2e-5, 0.0, 0.0, 0.0])
            .strain("brick_2", vec![2e-5, 0.0, 0.0, 0.0]),
        step("b")
            .hold("brick_1.right", "x")
            .hold("brick_2.right", "x")
            .release("base.left", "x")
            .release("brick_1.left", "x")
            .release("brick_2.left", "x"),
        step("c").displace("brick_1.right", "x", "1e-4*y").displace("brick_2.right", "x", "1e-4*y"),
    ];
    let patterns = [
        step("a")
            .fix("base.bottom", "y")
            .fix("*.left", "x")
            .traction("brick_?.right", "-y", 0)
            .body_force("brick*", 0, -1)
            .with_in("gravity", "b*e", vec![0, -3])
            .temperature("br*", 5)
            .strain("base", vec![1e-5, 0.0, 0.0, 0.0])
            .strain("*", vec![2e-5, 0.0, 0.0, 0.0]),
        step("b").hold("brick_*.r*t", "x").release("*.left", "x"),
        step("c").displace("brick_?.right", "x", "1e-4*y"),
    ];
    let ((_, one), (_, other)) = (last(explicit), last(patterns));
    assert_eq!(one.snapshot.u, other.snapshot.u);
    assert_eq!(one.reactions, other.reactions);
    assert!(one.snapshot.u.iter().any(|u| u.abs() > 1e-6));
}

#[test]
fn reactions_and_means_of_a_pattern_count_every_node_once() {
    let push = step("a").fix("base.bottom", "xy").fix("*.left", "x").fix("base.left", "x").traction(
        "brick_2.right",
        -3,
        0,
    );
    let history = |push: &str| {
        [
            ("all", "reaction:*.left:x".into()),
            ("bottom", "reaction:base.bottom:x".into()),
            ("both", "reaction:base.*:x".into()),
            ("rest", "reaction:brick_*.left:x".into()),
            ("mean", "*.right.displacement_x".into()),
            ("r1", "base.right.displacement_x".into()),
            ("r2", "brick_1.right.displacement_x".into()),
            ("r3", "brick_2.right.displacement_x".into()),
            ("third", json!({ "formula": "(r1 + r2 + r3)/3 - mean" })),
            ("push", json!({ "formula": push })),
        ]
    };
    let refused =
        tower([push.clone()], &history("both + reaction_rest*load_factor")).unwrap_err().to_string();
    assert!(refused.contains("unknown name \"reaction_rest\""), "{refused}");
    let history = history("-(both*load_factor)");
    let problem = tower([push.clone()], &history).unwrap();
    let columns = problem.columns();
    assert!(columns.contains(&"reaction:*.left:x".into()), "{columns:?}");
    for fields in ["every", "last", "none"] {
        let mut problem = tower([push.clone().increments(8)], &history).unwrap();
        problem.fields = match fields {
            "every" => midplane::scene::Fields::Every,
            "last" => midplane::scene::Fields::Last,
            _ => midplane::scene::Fields::None,
        };
        let (states, _) = solve(&problem);
        for (k, state) in states.iter().enumerate() {
            let load = 3.0 * 0.5 * (k + 1) as f64 / 8.0;
            let values = state.probes(&problem);
            let [all, bottom, both, rest, .., third, push] = values[..10] else { panic!("{values:?}") };
            // the corner of base.left and base.bottom is a node of both
            close(both + rest, load, 1e-9, 1.5, &format!("{fields}: all supports"));
            assert!((all + bottom - load).abs() > 1e-3 * load, "{all} {bottom}");
            close(third, 0.0, 1e-12, 1e-3, "mean of means of equal lengths");
            close(push, -both * (k + 1) as f64 / 8.0, 1e-12, 1.0, "formula");
        }
    }
}

#[test]
fn patterns_that_fit_nothing_or_twice_are_refused() {
    let s = || step("s").fix("base.bottom", "xy");
    for (step, words) in [
        (
            step("s").fix("bick_*.left", "x"),
            "no subdomain is called like \"bick_*\"; there is base, brick_1, brick_2. Did you mean",
        ),
        (
            step("s").fix("brick_*.lft", "x"),
            "no group is called like \"brick_*.lft\"; did you mean \"brick_1.left\"? There is brick_1.bottom, brick_1.right",
        ),
        (s().pressure("*.side*", 1), "no curve is called like \"*.side*\"; there is base."),
        (s().pressure("*.top", 1).pressure("brick_2.top", 2), "both load brick_2.top"),
        (
            s().with_in("gravity", "*", vec![0, -1]).with_in("gravity", "b*", vec![0, -2]),
            "\"*\" and \"b*\" both fit base",
        ),
        (
            s().with_in("gravity", "bas", vec![0, -1]),
            "no subdomain \"bas\"; there is base, brick_1, brick_2. Did you mean \"base\"?",
        ),
        (s().with("gravity", 9.81), "it takes two numbers or formulas such as [0, -9.81]"),
    ] {
        let what = step.to_string();
        let Err(message) = tower([step], &[]) else { panic!("accepted: {what}") };
        let message = message.to_string();
        assert!(message.contains(words), "{message}\n  should contain\n{words}");
    }
    for (probe, words) in [
        ("j*.jump_n@0.5", "jump_n of a pattern; name one interface, or take max_jump_n"),
        ("j*.mean_jump_n", "of a pattern; resultants, moment, uplift, lengths and max_"),
        ("k*.resultant_n", "no interface is called like \"k*\""),
        ("reaction:bas.left:x", "no subdomain \"bas\""),
        ("reaction:base.left:z", "has no direction"),
        (
            "j~base~brick_1.jump_n",
            "does not say where; add a fraction of the length from 0 to 1, such as jump_n@0.5, or take max_jump_n",
        ),
    ] {
        let message = tower([s()], &[("p", probe.into())]).unwrap_err().to_string();
        assert!(message.contains(words), "{message}\n  should contain\n{words}");
    }
}

/// Claim: quantities of whole interfaces are sums, means and bounds over their law points, of a pattern over all of them.
#[test]
fn quantities_of_interfaces_are_those_of_their_law_points() {
    let load = step("a").fix("base.bottom", "xy").traction("brick_2.right", "1 + y", -3);
    let history = [
        ("max", "j~base~brick_1.max_traction_n".into()),
        ("min", "j~base~brick_1.min_traction_n".into()),
        ("mean", "j~base~brick_1.mean_traction_n".into()),
        ("most", "j*.max_traction_n".into()),
        ("n", "j*.resultant_n".into()),
        ("m", "j*.moment".into()),
        ("open", "j*.open_length".into()),
        ("cracked", "j*.cracked_length".into()),
    ];
    let problem = tower([load], &history).unwrap();
    let state = solve(&problem).0.pop().unwrap();
    let values = state.probes(&problem);
    let tractions = |k: usize| state.snapshot.tractions[k].iter().map(|t| t[0]);
    let weights = |k: usize| problem.model.interfaces[k].coupling.points.iter().map(|point| point.weight);
    let k = problem.model.interfaces.iter().position(|own| own.name == "j~base~brick_1").unwrap();
    let sum = |k: usize| tractions(k).zip(weights(k)).map(|(t, w)| t * w).sum::<f64>();
    let largest = |k: usize| tractions(k).fold(f64::NEG_INFINITY, f64::max);
    let expected = [
        largest(k),
        tractions(k).fold(f64::INFINITY, f64::min),
        sum(k) / weights(k).sum::<f64>(),
        largest(0).max(largest(1)),
        sum(0) + sum(1),
    ];
    for (value, exact) in values.iter().zip(expected) {
        close(*value, exact, 1e-12, 10.0, "quantity");
    }
    assert!(values[0] > values[2] && values[2] > values[1]);
    assert_eq!(values[6..8], [0.0, 0.0]);
}

/// Claim: a pattern names the curves of a side, and those along which bodies are opened, as a list of them does.
#[test]
fn patterns_name_curves_of_interfaces() {
    let block = |k: usize, n: usize| {
        let y = 0.5 * k as f64;
        let mut mesh = even_block([0.0, 1.0], [y, y + 0.5], [n, 4], Shape::Quadrilateral4);
        // along the middle
        let row = |i: usize| 2 * (n + 1) + i;
        let edges = (0..n).map(|i| Facet::edge(&[row(i), row(i + 1)], n + i, false)).collect();
        mesh.groups.insert("middle".into(), Group::Edges(edges));
        mesh
    };
    let joined = |middle: Value, upper: &str| {
        let scene = Scene::new("strain")
            .subdomains(["base", "brick_1", "brick_2"], "m")
            .material("m", 1e4, 0.2)
            .interface("m", within(middle).law(springs()))
            .interface("low", between("base", "brick_1").law(springs()))
            .interface("j", faces("brick_1.top", upper).law(springs()))
            .step(step("s").fix("base.bottom", "xy").traction("brick_2.top", 1, -2));
        scene.bind(vec![block(0, 4), block(1, 5), block(2, 3)])
    };
    let names = |problem: &Problem| -> Vec<String> {
        problem.model.interfaces.iter().map(|interface| interface.name.clone()).collect()
    };
    let list = joined(json!(["brick_1.middle", "brick_2.middle"]), "brick_2.bottom").unwrap();
    let pattern = joined("brick_?.mid*".into(), "*_2.bott*").unwrap();
    assert_eq!(list.model.interfaces.len(), 4);
    assert_eq!(names(&list), names(&pattern));
    assert_eq!(solve(&list).0[0].snapshot.u, solve(&pattern).0[0].snapshot.u);
    let message = joined("brick_?.mid".into(), "brick_2.bottom").unwrap_err().to_string();
    assert!(message.contains("no curve is called like \"brick_?.mid\""), "{message}");
}

#[test]
fn names_may_have_spaces() {
    let work = |upper: &str, joint: &str| {
        let top = |what: &str| format!("{upper}.{what}");
        let scene = Scene::new("strain")
            .subdomains(["base", upper], "m")
            .material("m", 1e4, 0.2)
            .interface(joint, faces("base.top", top("bottom")).law(springs()))
            .step(step("a").fix("base.bottom", "xy").traction(&top("top"), 0, -3))
            .probe("n", &format!("{joint}.traction_n@0.5"))
            .probe("r", "reaction:base.bottom:y")
            .probe("u", &top("top.displacement_y"));
        let block = |y: f64| even_block([0.0, 1.0], [y, y + 0.5], [3, 2], Shape::Quadrilateral4);
        let problem = scene.bind(vec![block(0.0), block(0.5)]).unwrap();
        solve(&problem).0.pop().unwrap().probes(&problem)
    };
    let spaced = work("upper part", "bed joint");
    assert!((spaced[1] - 3.0).abs() < 1e-10, "{spaced:?}");
    assert_eq!(spaced, work("upper", "joint"));
}
