//! Claim: numbers of a scene may be formulas of the place and of the load factor, exact where they act; what cannot be meant is
//! refused with its key and its place.
//!
//! ```text
//!   t_x = 5 cos πx   no resultant on 0 < x < 1         t_y = 2 + 3x   h (t_a/3 + t_b/6) to the ends of an edge
//!   ∫ 6 x y dA = 3/2                                   s: fraction of the arc length of a group
//! ```

use crate::common::*;
use midplane::error::Result;
use midplane::mesh::{Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::Value;

/// The unit square with a material of ν = 0 and thickness 0.5, under the given steps.
fn square(mesh: Mesh, steps: impl IntoIterator<Item = Step>) -> Result<Problem> {
    Scene::new("stress")
        .with("thickness", 0.5)
        .subdomain("block", "rock")
        .material("rock", 1e4, 0.0)
        .density("rock", 2.0)
        .steps(steps)
        .bind(vec![mesh])
}

fn unit(nx: usize, ny: usize, shape: Shape) -> Mesh {
    even_block([0.0, 1.0], [0.0, 1.0], [nx, ny], shape)
}

/// A step with the bottom held.
fn held(name: &str) -> Step {
    step(name).fix("block.bottom", "xy")
}

/// Nodal forces at the end of the first step.
fn forces(mesh: Mesh, load: Step) -> Vec<f64> {
    let problem = square(mesh, [load]).unwrap();
    problem.steps[0].force(&problem.model, 1.0).unwrap()
}

fn total(force: &[f64], direction: usize) -> f64 {
    force.iter().skip(direction).step_by(2).sum()
}

/// t_x = 5 cos πx has no resultant on 0 < x < 1; t_y = 2 + 3x gives h (t_a/3 + t_b/6) L to the ends of every edge.
#[test]
fn a_traction_in_x_gives_its_exact_nodal_forces() {
    let load = held("go").traction("block.top", "5*cos(pi*x)", "2 + 3*x");
    let force = forces(unit(8, 2, Shape::Quadrilateral4), load);
    close(total(&force, 0), 0.0, 1e-15, 5.0, "resultant of 5 cos πx");
    let t = |i: usize| 2.0 + 3.0 * i as f64 / 8.0;
    for i in 0..=8 {
        let from_left = if i > 0 { t(i - 1) / 6.0 + t(i) / 3.0 } else { 0.0 };
        let from_right = if i < 8 { t(i) / 3.0 + t(i + 1) / 6.0 } else { 0.0 };
        close(force[2 * (18 + i) + 1], 0.5 / 8.0 * (from_left + from_right), 1e-15, 1.0, "consistent force");
    }
}

/// ∫ 6 x y dA = 3/2 over the unit square, on coarse triangles and squares; gravity acts on the density 2.
#[test]
fn a_subdomain_force_that_varies_has_its_exact_resultant() {
    for shape in [Shape::Triangle3, Shape::Quadrilateral4] {
        let force = forces(unit(2, 1, shape), held("go").body_force("block", "6*x*y", "x^4"));
        close(total(&force, 0), 0.5 * 1.5, 1e-14, 1.0, "∫ 6 x y");
        close(total(&force, 1), 0.5 / 5.0, 1e-14, 1.0, "∫ x⁴");
        let force = forces(unit(2, 1, shape), held("go").gravity(0, "-3*y"));
        close(total(&force, 1), -0.5 * 2.0 * 1.5, 1e-14, 1.0, "∫ ρ 3 y");
    }
}

/// p(λ) as written, then as it was left, then ramps, then as written again.
#[test]
fn a_load_in_load_factor_is_not_ramped_and_stays_afterwards() {
    let pressed = |name: &str, p: Value| held(name).increments(2).pressure("block.top", p);
    let steps = [
        pressed("a", "4*load_factor^2 + 1".into()),
        step("b").increments(2),
        pressed("c", 3.into()),
        pressed("d", "1 + load_factor".into()),
        pressed("e", "2*2".into()),
    ];
    let problem = square(unit(2, 2, Shape::Quadrilateral4), steps).unwrap();
    let (states, totals) = solve(&problem);
    assert_eq!(totals.factorisations, 1);
    for (state, p) in states.iter().zip([2.0, 5.0, 5.0, 5.0, 4.0, 3.0, 1.5, 2.0, 3.0, 4.0]) {
        close(state.probes(&problem)[1], 0.5 * p, 1e-12, 5.0, "reaction");
        // ν = 0: the block shortens by p H / E
        let top = group(&problem, 0, "top")[0];
        close(displacement(&problem, state, 0, top)[1], -p / 1e4, 1e-12, 5e-4, "shortening");
    }
}

/// u(λ) as written; a later step ramps from where it was left.
#[test]
fn a_displacement_in_load_factor_is_the_total_one() {
    let wave = "1e-3*(sin(2*pi*load_factor) + load_factor)";
    let steps = [
        held("wave").increments(4).displace("block.top", "y", wave),
        step("back").increments(2).displace("block.top", "y", 0),
    ];
    let problem = square(unit(2, 2, Shape::Triangle3), steps).unwrap();
    let (states, _) = solve(&problem);
    for (state, u) in states.iter().zip([1.25, 0.5, -0.25, 1.0, 0.5, 0.0]) {
        for &node in &group(&problem, 0, "top") {
            close(displacement(&problem, state, 0, node)[1], 1e-3 * u, 1e-14, 1.0, "top");
        }
    }
}

/// s runs from the end with smaller x, then y, whichever way the mesh lists the edges: y on the left, x on the top.
#[test]
fn s_is_the_fraction_of_arc_length() {
    for (group, coordinate) in [("left", "y"), ("right", "y"), ("top", "x")] {
        for turned in [0.0, 30.0, 210.0] {
            let mesh =
                || rectangle(&even(0.0, 1.0, 4), &even(0.0, 1.0, 3), Shape::Triangle3, rotation(turned));
            let curve = format!("block.{group}");
            let load = |text: &str| forces(mesh(), held("go").traction(&curve, text, 0));
            // the turned square counts from the other end where x or, on a line of one x, y falls
            let (sin, cos) = f64::to_radians(turned).sin_cos();
            let along =
                if coordinate == "x" { format!("{cos}*x + {sin}*y") } else { format!("{cos}*y - {sin}*x") };
            let direction = if coordinate == "x" { [cos, sin] } else { [-sin, cos] };
            let rises = if direction[0].abs() > 1e-9 { direction[0] > 0.0 } else { direction[1] > 0.0 };
            let exact = load(&if rises { format!("3*({along})") } else { format!("3*(1 - ({along}))") });
            for (s, exact) in load("3*s").iter().zip(exact) {
                close(*s, exact, 1e-14, 1.0, &format!("{group} turned by {turned}"));
            }
        }
    }
    // displacements: s at nodes
    let moved = |text: &str| held("go").displace("block.left", "x", format!("1e-3*{text}"));
    let [by_s, by_y] = ["s", "y"].map(|text| {
        let problem = square(unit(2, 5, Shape::Quadrilateral4), [moved(text)]).unwrap();
        problem.steps[0].prescribed(&vec![0.0; problem.model.dofs()], 1.0).unwrap()
    });
    assert!(by_s.iter().zip(&by_y).all(|(s, y)| (s - y).abs() < 1e-18) && by_y.contains(&1e-3));
}

/// A formula that cannot be meant is refused with its key, and the place where a formula has no value with x and y.
#[test]
fn formulas_that_fail_where_they_act_are_refused() {
    let go = || held("go");
    for (step, expected) in [
        (
            go().pressure("block.top", "sqrt(x - 0.5)"),
            "load.block.top.pressure: \"sqrt(x - 0.5)\" is NaN at x = ",
        ),
        (go().body_force("block", 0, "1/(x - x)"), "body_force.block.1: \"1/(x - x)\" is inf at x = "),
        (
            go().force("block.corner", "ln(x)", 0),
            "load.block.corner.force.0: \"ln(x)\" is -inf at x = 0, y = 0",
        ),
        (go().increments(4).pressure("block.top", "1/(load_factor - 0.75)"), "is inf at x = "),
        (
            go().displace("block.top", "y", "sqrt(0.4 - load_factor)"),
            "displace.block.top.y: \"sqrt(0.4 - load_factor)\" is NaN at x = 0, y = 1, load_factor = 1",
        ),
        (
            go().pressure("block.rim", "s"),
            "load.block.rim.pressure: s in \"s\", but the curve is a closed loop",
        ),
        (
            go().displace("block.body", "x", "s"),
            "displace.block.body.x: s in \"s\", but \"block.body\" is a surface",
        ),
        (
            go().body_force("block", "s", 0),
            "body_force.block.0: s in \"s\", but a body has no such coordinate",
        ),
        (
            go().displace("block.left", "x", "1e-3*y + 1e-6"),
            "\"block.left\" wants displacement_x = 0.000001 where \"block.bottom\" wants 0",
        ),
    ] {
        let mut mesh = unit(3, 3, Shape::Quadrilateral4);
        let rim = ["bottom", "right", "top", "left"].iter().flat_map(|name| match &mesh.groups[*name] {
            Group::Edges(edges) => edges.clone(),
            _ => Vec::new(),
        });
        let rim = Group::Edges(rim.collect());
        mesh.groups.insert("rim".into(), rim);
        let error = square(mesh, [step]).unwrap_err();
        let message = error.to_string();
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert_eq!(error.exit_code(), 2);
    }
}

/// Groups that agree but for rounding, such as sin πx and 0 at x = 1, are no conflict.
#[test]
fn rounding_is_no_conflict_of_supports() {
    let sine = held("go").fix("block.right", "y").displace("block.top", "y", "1e-3*sin(pi*x)");
    square(unit(3, 3, Shape::Quadrilateral4), [sine]).unwrap();
}

/// t₀(s) on an interface between two blocks that nothing else moves: it relaxes by the jump −t₀/K_N point by point where it is
/// linear, and s counts as the probes do.
#[test]
fn an_initial_traction_varies_along_the_interface() {
    let lower = even_block([0.0, 2.0], [0.0, 1.0], [3, 2], Shape::Quadrilateral4);
    let upper = even_block([0.0, 2.0], [1.0, 2.0], [5, 2], Shape::Triangle3);
    for [n, t] in [["2*s", "1 - s"], ["x", "1 - x/2"]] {
        let joint = faces("lower.top", "upper.bottom").initial_traction(n, t).law(elastic(1e5, 2e4));
        let scene = Scene::new("strain")
            .subdomains(["lower", "upper"], "rock")
            .material("rock", 1e4, 0.2)
            .interface("joint", joint)
            .step(step("go").fix("lower", "xy").fix("upper", "xy"));
        let problem = scene.bind(vec![lower.clone(), upper.clone()]).unwrap();
        let (states, _) = solve(&problem);
        // chain A runs along +x with n up on its left
        for (point, traction) in
            problem.model.interfaces[0].coupling.points.iter().zip(&states[0].snapshot.tractions[0])
        {
            close(traction[0], point.position[0], 1e-14, 2.0, "t_n");
            close(traction[1], 1.0 - 0.5 * point.position[0], 1e-14, 1.0, "t_t");
        }
    }
}
