//! Times of the linear path on two unmatched layers of N dofs, made in memory: `cargo bench --bench large -- 400000`.
//!
//! Prints every stage, the factor in the order of nested dissection joined and in parts, that in the order of minimum
//! degree, the stages of a whole march, and peak memory.

use std::time::Instant;

use indexmap::IndexMap;
use midplane::assembly::{Pattern, Symmetric};
use midplane::mesh::{Cells, Edge, Group, Mesh};
use midplane::problem::Problem;
use midplane::run::{Clock, march, memory};
use midplane::scene;
use midplane::shape::Shape;
use midplane::solver::{Cut, Parts, Plan, Symbolic, nested_dissection};

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
    // n edges along and n/4 rows in each layer: n² dofs in both
    let n = (dofs as f64).sqrt();
    let (a, b) = ((0.98 * n).round() as usize, (1.02 * n).round() as usize);
    let scene = scene::parse("scene.json".into(), SCENE.into(), &[]).map_err(|e| e.to_string())?;
    let meshes = vec![layer(a, a / 4, -0.5), layer(b, b / 4, 0.0)];
    let problem = timed("bind", || Problem::bind(&scene, meshes)).map_err(|e| e.to_string())?;
    let model = &problem.model;
    println!("{} dofs", model.dofs());

    let pattern = timed("pattern", || model.pattern());
    let mut matrix = timed("continuum", || model.continuum(&pattern));
    for joint in &model.joints {
        let stiffness = [1e7, 0.0, 0.0, 1e7].repeat(joint.coupling.points.len());
        timed("joint", || joint.add_stiffness(&pattern, &stiffness, &mut matrix));
    }
    matrix.hold(&pattern, &problem.stages[0].held);
    let coordinates = model.coordinates();
    let order = timed("nested dissection", || nested_dissection(&pattern, &coordinates));
    let joined = timed("symbolic", || Symbolic::with_order(&pattern, &order));
    let joined = joined.map_err(|e| format!("{e:?}"))?;
    println!("    {:<27} {:8.2} GFlop", "joined", joined.operations() / 1e9);
    factor(&Plan::Joined(joined), &pattern, &matrix)?;
    let parts = timed("cut, symbolic of parts", || Parts::new(&pattern, Cut::new(&pattern, &order)));
    factor(&Plan::InParts(parts.map_err(|e| format!("{e:?}"))?), &pattern, &matrix)?;
    let degree = timed("minimum degree, symbolic", || Symbolic::minimum_degree(&pattern));
    factor(&Plan::Joined(degree.map_err(|e| format!("{e:?}"))?), &pattern, &matrix)?;
    drop((pattern, matrix));

    let mut clock = Clock::new("march");
    march(&problem, &mut clock, &mut |_| (), &mut |_, _, _, _| Ok(())).map_err(|e| e.to_string())?;
    for (stage, seconds) in clock.stages() {
        println!("    march: {stage:<20} {seconds:8.3} s");
    }
    if let Some(peak) = memory::peak() {
        println!("    {:<27} {}", "peak memory so far", memory::gigabytes(peak));
    }
    Ok(())
}

fn factor(plan: &Plan, pattern: &Pattern, matrix: &Symmetric) -> Result<(), String> {
    println!("    {:<27} {:8.2} million entries", plan.strategy(), plan.entries() as f64 / 1e6);
    let factor = timed("numeric", || plan.factor(pattern, matrix)).map_err(|e| format!("{e:?}"))?;
    let mut x = vec![1.0; pattern.size()];
    timed("solve", || factor.solve(&mut x));
    Ok(())
}

fn timed<T>(stage: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    println!("    {stage:<27} {:8.3} s", start.elapsed().as_secs_f64());
    result
}

/// A layer 2 × 0.5 of Q4 whose lower edge is at `y`.
fn layer(nx: usize, ny: usize, y: f64) -> Mesh {
    let node = |i: usize, j: usize| j * (nx + 1) + i;
    let mut mesh = Mesh { file: "layer.msh".into(), ..Mesh::default() };
    for j in 0..=ny {
        let y = y + 0.5 * j as f64 / ny as f64;
        mesh.points.extend((0..=nx).map(|i| [2.0 * i as f64 / nx as f64, y]));
    }
    let mut cells = Cells::default();
    for j in 0..ny {
        for i in 0..nx {
            cells.push(
                Shape::Quadrilateral4,
                &[node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)],
            );
        }
    }
    mesh.cells = cells;
    let edge = |start, end, cell| Edge { nodes: [start, end, end], cell, boundary: true };
    let mut groups = IndexMap::new();
    let mut curve = |name: &str, edges: Vec<Edge>| groups.insert(name.to_string(), Group::Edges(edges));
    curve("bottom", (0..nx).map(|i| edge(node(i, 0), node(i + 1, 0), i)).collect());
    curve("right", (0..ny).map(|j| edge(node(nx, j), node(nx, j + 1), j * nx + nx - 1)).collect());
    curve("top", (0..nx).map(|i| edge(node(i + 1, ny), node(i, ny), (ny - 1) * nx + i)).collect());
    curve("left", (0..ny).map(|j| edge(node(0, j + 1), node(0, j), j * nx)).collect());
    mesh.groups = groups;
    mesh
}
