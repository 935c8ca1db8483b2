//! Claim: factored in parts or joined, a model has the same displacements, for any number of threads.
//!
//! ```text
//!   ┌──┬──┬──┐  upper: floats on its interfaces or is held     pressure, bending
//!   ├─┬┴─┬┴┬─┤  middle
//!   ├─┴┬─┴─┴─┤  lower: held                                 every body with a mesh of its own
//!   └──┴─────┘
//! ```

use crate::common::*;
use midplane::problem::Problem;
use midplane::shape::Shape;
use midplane::solver::{Cut, FactorPlan, Linear, Parts, Symbolic, System, nested_dissection};

/// Layers 2 × 0.5 on each other, `edges` along each, with an interface between neighbours or with none.
fn layers(edges: &[usize], shape: Shape, jointed: bool, fix: &str) -> Problem {
    let meshes = edges.iter().enumerate().map(|(k, &n)| {
        let y = 0.5 * k as f64;
        even_block([0.0, 2.0], [y, y + 0.5], [n, n / 4], shape)
    });
    let name = |k: usize, side: &str| format!("l{k}{side}");
    let load = step("load").traction(&name(edges.len() - 1, ".top"), 0.3, -1.0);
    let mut scene = Scene::new("strain").material("rock", 1e4, 0.3);
    for k in 0..edges.len() {
        scene = scene.subdomain(&name(k, ""), "rock");
    }
    for k in 1..if jointed { edges.len() } else { 1 } {
        let faces = faces(name(k - 1, ".top"), name(k, ".bottom"));
        scene = scene.interface(&format!("joint{k}"), faces.law(elastic(1e7, 1e7)));
    }
    let load = fix.split(' ').fold(load, |load, side| load.fix(side, "xy"));
    scene.step(load).bind(meshes.collect()).unwrap()
}

/// Displacements in parts and joined.
fn solve(problem: &Problem) -> (Vec<f64>, Vec<f64>) {
    let model = &problem.model;
    let pattern = model.pattern();
    let continuum = model.continuum(&pattern);
    let stiffness: Vec<Vec<f64>> = model
        .interfaces
        .iter()
        .map(|interface| [1e7, 0.0, 0.0, 1e7].repeat(interface.coupling.points.len()))
        .collect();
    let system = System {
        interfaces: &model.interfaces,
        stiffness: &stiffness,
        pattern: &pattern,
        continuum: &continuum,
    };
    let step = &problem.steps[0];
    let f = step.force(model, 1.0).unwrap();
    let order = nested_dissection(&pattern, &model.coordinates());
    let cut = Cut::new(&pattern, &order);
    let in_parts = FactorPlan::InParts(Parts::new(&pattern, cut).unwrap());
    let joined = FactorPlan::Joined(Symbolic::with_order(&pattern, &order).unwrap());
    let [a, b] = [in_parts, joined].map(|plan| {
        let solution = Linear::new(system, &plan, &step.constrained).unwrap().solve(&f, &vec![0.0; f.len()]);
        assert!(solution.backward_error < 1e-14, "{}: {:e}", plan.method().name(), solution.backward_error);
        solution.u
    });
    (a, b)
}

#[test]
fn in_parts_and_joined_agree() {
    let [quadrilateral, triangle] = [Shape::Quadrilateral4, Shape::Triangle3];
    for (name, problem) in [
        ("cantilever", layers(&[80, 100], quadrilateral, true, "l0.left l1.left")),
        ("floating upper body", layers(&[60, 76], triangle, true, "l0.bottom")),
        ("three bodies", layers(&[60, 76, 52], quadrilateral, true, "l0.bottom")),
        ("body without joint", layers(&[80, 100, 60], triangle, false, "l0.left l1.left l2.left")),
        ("one body", layers(&[100], triangle, true, "l0.bottom")),
    ] {
        let (in_parts, joined) = solve(&problem);
        let scale = joined.iter().fold(0.0_f64, |m, u| m.max(u.abs()));
        let worst = in_parts.iter().zip(&joined).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / scale;
        println!("{name}: {} dofs, {worst:.1e}", joined.len());
        assert!(scale > 0.0 && worst <= 1e-11, "{name}: {worst:e}");
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let problem = layers(&[80, 100], Shape::Quadrilateral4, true, "l0.bottom");
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| solve(&problem).0)
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}

#[test]
fn a_large_model_is_factored_in_parts_and_a_small_one_joined() {
    for (edges, strategy) in [([80, 100], "joined"), ([240, 250], "in parts")] {
        let problem = layers(&edges, Shape::Quadrilateral4, true, "l0.bottom");
        let plan = FactorPlan::analyse(&problem.model.pattern(), &problem.model.coordinates()).unwrap();
        assert_eq!(plan.method().name(), strategy, "{} dofs", problem.model.dofs());
    }
}
