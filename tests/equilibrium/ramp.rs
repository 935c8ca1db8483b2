//! Claim: where all interfaces are elastic, an increment of a ramp is the answer to the loads at its level, whatever increments
//! come before it.

use crate::common::*;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;

/// Pressed, then pushed and pressed on to a part of what is asked for: loads and displacements of the push at a load factor.
fn scene(increments: usize, load_factor: f64, fields: &str) -> Scene {
    let (pressure, x, weight) = (2.0 + 3.0 * load_factor, 4e-4 * load_factor, -5.0 * load_factor);
    let joint = faces("lower.top", "upper.bottom").initial_traction(-0.5, 0.3);
    let press = step("press").pressure("upper.top", 2).fix("lower.bottom", "xy");
    let push = step("push")
        .increments(increments)
        .pressure("upper.top", pressure)
        .body_force("upper", 0, weight)
        .displace("upper.left", "x", x)
        .displace("upper.right", "x", x);
    Scene::new("strain")
        .subdomains(["lower", "upper"], "m")
        .material("m", 1e4, 0.2)
        .interface("joint", joint.law(elastic(1e6, 1e5)))
        .step(press.fix("upper.left", "x").fix("upper.right", "x"))
        .step(push)
        .with_in("output", "fields", fields)
        .probes([
            ("x", "upper.top.displacement_x"),
            ("y", "upper.top.displacement_y"),
            ("n", "joint.traction_n@0.5"),
            ("t", "joint.traction_t@0.3"),
            ("jump", "joint.jump_t@0.7"),
        ])
}

fn problem(increments: usize, load_factor: f64, fields: &str) -> Problem {
    let block =
        |n: usize, y: f64| -> Mesh { even_block([0.0, 0.4], [y, y + 0.2], [n, 2], Shape::Quadrilateral8) };
    scene(increments, load_factor, fields).bind(vec![block(3, -0.2), block(4, 0.0)]).unwrap()
}

/// Columns of the history, work and stored energy.
fn columns(problem: &Problem, state: &midplane::history::ModelState) -> Vec<f64> {
    [state.probes(problem), vec![state.work, state.stored]].concat()
}

#[test]
fn an_increment_of_a_linear_scene_is_the_answer_to_its_loads_alone() {
    let increments = 51;
    let alone: Vec<_> = (1..=increments)
        .map(|k| {
            let problem = problem(1, k as f64 / increments as f64, "every");
            let state = solve(&problem).0.pop().unwrap();
            (columns(&problem, &state), state.snapshot.u)
        })
        .collect();
    let largest = |i: usize| alone.iter().map(|(columns, _)| columns[i].abs()).fold(0.0, f64::max);
    for fields in ["every", "last"] {
        let problem = problem(increments, 1.0, fields);
        let (states, totals) = solve(&problem);
        assert_eq!((states.len(), totals.factorisations), (1 + increments, 1));
        let without = states[1..increments].iter().filter(|state| state.snapshot.u.is_empty()).count();
        assert_eq!(without, if fields == "last" { increments - 1 } else { 0 });
        assert!(totals.residual < 1e-14, "{:e}", totals.residual);
        for (k, (state, (alone, u))) in states[1..].iter().zip(&alone).enumerate() {
            for (i, (got, exact)) in columns(&problem, state).into_iter().zip(alone).enumerate() {
                let scale = largest(i);
                close(got, *exact, 1e-12, scale, &format!("{fields}: column {i}, increment {k}"));
            }
            let scale = u.iter().map(|u| u.abs()).fold(0.0, f64::max);
            // none where fields are not stored
            let all = state.snapshot.u.iter().zip(u);
            all.for_each(|(got, exact)| close(*got, *exact, 1e-12, scale, &format!("{fields}: u {k}")));
        }
    }
}
