//! Times of the linear path on two unmatched layers of N dofs, made in memory: `cargo bench --bench large -- 400000`.
//!
//! Prints every stage, the factor in the order of nested dissection joined and in parts, that in the order of minimum
//! degree, the stages of a whole march, and peak memory.

use std::time::Instant;

use midplane::assembly::{Pattern, Symmetric, add_stiffness};
use midplane::history::{Clock, Equations, History, Means, memory};
use midplane::problem::Problem;
use midplane::solver::{Cut, FactorPlan, Parts, Symbolic, nested_dissection};

mod layers;
use layers::layers;

const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "lower": { "msh": "lower", "material": "rock" }, "upper": { "msh": "upper", "material": "rock" } },
  "materials": { "rock": { "young": 1e4, "poisson": 0.3 } },
  "interfaces": { "joint": { "side_a": "lower.top", "side_b": "upper.bottom",
    "law": { "type": "elastic", "normal_stiffness": 1e7, "tangential_stiffness": 1e7 } } },
  "steps": [ { "name": "bending", "fix": { "lower.left": ["x", "y"], "upper.left": ["x", "y"] },
    "load": { "lower.right": { "traction": [0.0, -1.0] }, "upper.right": { "traction": [0.0, -1.0] } } } ] }"#;

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    for dofs in if sizes.is_empty() { vec![100_000, 400_000, 1_000_000] } else { sizes } {
        if let Err(error) = measure(dofs) {
            eprintln!("{dofs} dofs: {error}");
        }
    }
}

fn measure(dofs: usize) -> Result<(), String> {
    let scene =
        midplane::run::parse_scene("scene.json".into(), SCENE.into(), &[]).map_err(|e| e.to_string())?;
    let problem = timed("bind", || Problem::bind(&scene, layers(dofs))).map_err(|e| e.to_string())?;
    let model = &problem.model;
    println!("{} dofs", model.dofs());

    let pattern = timed("pattern", || model.pattern());
    let mut matrix = timed("continuum", || model.continuum(&pattern));
    for interface in &model.interfaces {
        let stiffness = [1e7, 0.0, 0.0, 1e7].repeat(interface.coupling.points.len());
        timed("joint", || add_stiffness(interface, &pattern, &stiffness, &mut matrix));
    }
    matrix.hold(&pattern, &problem.steps[0].constrained);
    let coordinates = model.coordinates();
    let order = timed("nested dissection", || nested_dissection(&pattern, &coordinates));
    let joined = timed("symbolic", || Symbolic::with_order(&pattern, &order));
    let joined = joined.map_err(|e| format!("{e:?}"))?;
    println!("    {:<27} {:8.2} GFlop", "joined", joined.operations() / 1e9);
    factor(&FactorPlan::Joined(joined), &pattern, &matrix)?;
    let parts = timed("cut, symbolic of parts", || Parts::new(&pattern, Cut::new(&pattern, &order)));
    factor(&FactorPlan::InParts(parts.map_err(|e| format!("{e:?}"))?), &pattern, &matrix)?;
    let degree = timed("minimum degree, symbolic", || Symbolic::minimum_degree(&pattern));
    factor(&FactorPlan::Joined(degree.map_err(|e| format!("{e:?}"))?), &pattern, &matrix)?;
    drop((pattern, matrix));

    let mut clock = Clock::new("march");
    let equations = Equations::new(&problem, Means::default(), &mut clock).map_err(|e| e.to_string())?;
    let mut history = History::new(&problem, &equations, clock);
    while history.next().map_err(|e| e.to_string())?.is_some() {}
    for (step, seconds) in history.clock().stages() {
        println!("    march: {step:<20} {seconds:8.3} s");
    }
    if let Some(peak) = memory::peak() {
        println!("    {:<27} {}", "peak memory so far", memory::gigabytes(peak));
    }
    Ok(())
}

fn factor(plan: &FactorPlan, pattern: &Pattern, matrix: &Symmetric) -> Result<(), String> {
    println!("    {:<27} {:8.2} million entries", plan.method().name(), plan.entries() as f64 / 1e6);
    let factor = timed("numeric", || plan.factor(pattern, matrix)).map_err(|e| format!("{e:?}"))?;
    let mut x = vec![1.0; pattern.size()];
    timed("solve", || factor.solve(std::slice::from_mut(&mut x)));
    Ok(())
}

fn timed<T>(step: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    println!("    {step:<27} {:8.3} s", start.elapsed().as_secs_f64());
    result
}
