//! Meshes and scenes for tests, all but `meshed` without gmsh.

pub mod boundary;
pub mod boxes;
pub mod chains;
pub mod laws;
pub mod mesh_text;
pub mod place;
pub mod rings;
pub mod round;
pub mod scene;
pub mod squares;
pub mod strip;
pub mod table;

pub use scene::*;

use indexmap::IndexMap;
use midplane::history::{Clock, Equations, History, Increment, Means, ModelState, Totals};
use midplane::mesh::{Cells, Facet, Gmsh, Group, Job, Mesh, mesh_all, read};
use midplane::problem::Problem;
use midplane::shape::Shape;
use midplane::shape::vector::in_space;

/// The mesh that gmsh makes of a geometry.
pub fn meshed(geo: &str) -> Mesh {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("body.geo");
    std::fs::write(&path, geo).unwrap();
    let job = Job { name: "body".into(), geo: path, parameters: Vec::new() };
    read(&mesh_all(&Gmsh::default(), folder.path(), &[job]).unwrap().remove(0).path).unwrap()
}

/// n + 1 equally spaced places from `start` to `end`.
pub fn even(start: f64, end: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|i| if i == n { end } else { start + (end - start) * i as f64 / n as f64 }).collect()
}

/// n + 1 places from `start` to `end`, the last cell `ratio` times the first.
pub fn graded(start: f64, end: f64, n: usize, ratio: f64) -> Vec<f64> {
    let q = ratio.powf(1.0 / (n as f64 - 1.0));
    let sums: Vec<f64> = (0..=n).map(|i| (0..i).map(|k| q.powi(k as i32)).sum()).collect();
    sums.iter().map(|s| start + (end - start) * s / sums[n]).collect()
}

/// A rectangle of triangles (alternating diagonals) or quadrilaterals, mapped into the plane by `place`.
///
/// ```text
///   ┌── top ──┐      groups: bottom, right, top, left (curves), corner (point 0), body (surface)
///  left     right
///   └ bottom ─┘
/// ```
pub fn rectangle(xs: &[f64], ys: &[f64], shape: Shape, place: impl Fn(f64, f64) -> [f64; 2]) -> Mesh {
    match shape {
        Shape::Triangle6 => quadratic(linear_rectangle(xs, ys, Shape::Triangle3, place), shape),
        Shape::Quadrilateral8 => quadratic(linear_rectangle(xs, ys, Shape::Quadrilateral4, place), shape),
        _ => linear_rectangle(xs, ys, shape, place),
    }
}

/// A rectangle between x[0] and x[1], y[0] and y[1], of n[0] × n[1] equal quadrilaterals or as many pairs of triangles.
pub fn even_block(x: [f64; 2], y: [f64; 2], n: [usize; 2], shape: Shape) -> Mesh {
    rectangle(&even(x[0], x[1], n[0]), &even(y[0], y[1], n[1]), shape, |x, y| [x, y])
}

/// The mesh with mid-nodes on the straight edges.
fn quadratic(mesh: Mesh, shape: Shape) -> Mesh {
    let mut points = mesh.points.clone();
    let mut mids = std::collections::HashMap::new();
    let mut mid = |a: usize, b: usize| {
        *mids.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let (p, q) = (points[a], points[b]);
            points.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.0]);
            points.len() - 1
        })
    };
    let mut cells = Cells::default();
    for c in 0..mesh.cells.len() {
        let mut nodes = mesh.cells.nodes(c).to_vec();
        let corners = nodes.len();
        for k in 0..corners {
            nodes.push(mid(nodes[k], nodes[(k + 1) % corners]));
        }
        cells.push(shape, &nodes);
    }
    let mut groups = mesh.groups;
    for group in groups.values_mut() {
        if let Group::Edges(edges) = group {
            for edge in edges {
                let [start, end] = [edge.nodes()[0], edge.nodes()[1]];
                *edge = Facet::edge(&[start, end, mid(start, end)], edge.cell, edge.boundary);
            }
        }
    }
    Mesh { file: mesh.file, points, cells, corners: mesh.corners, groups }
}

fn linear_rectangle(xs: &[f64], ys: &[f64], shape: Shape, place: impl Fn(f64, f64) -> [f64; 2]) -> Mesh {
    let (nx, ny) = (xs.len() - 1, ys.len() - 1);
    let node = |i: usize, j: usize| j * (nx + 1) + i;
    let mut points = Vec::new();
    for &y in ys {
        points.extend(xs.iter().map(|&x| in_space(place(x, y))));
    }
    let mut cells = Cells::default();
    for j in 0..ny {
        for i in 0..nx {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            match shape {
                Shape::Quadrilateral4 => cells.push(shape, &[a, b, c, d]),
                Shape::Triangle3 if j % 2 == 0 => {
                    cells.push(shape, &[a, b, c]);
                    cells.push(shape, &[a, c, d]);
                }
                Shape::Triangle3 => {
                    cells.push(shape, &[a, b, d]);
                    cells.push(shape, &[b, c, d]);
                }
                other => unimplemented!("{other:?}"),
            }
        }
    }
    let mut on_left = std::collections::HashMap::new();
    for c in 0..cells.len() {
        let nodes = cells.nodes(c);
        for k in 0..nodes.len() {
            on_left.insert((nodes[k], nodes[(k + 1) % nodes.len()]), c);
        }
    }
    let edge = |start: usize, end: usize| Facet::edge(&[start, end], on_left[&(start, end)], true);
    let mut groups = IndexMap::new();
    let mut curve = |name: &str, edges: Vec<Facet>| groups.insert(name.to_string(), Group::Edges(edges));
    curve("bottom", (0..nx).map(|i| edge(node(i, 0), node(i + 1, 0))).collect());
    curve("right", (0..ny).map(|j| edge(node(nx, j), node(nx, j + 1))).collect());
    curve("top", (0..nx).rev().map(|i| edge(node(i + 1, ny), node(i, ny))).collect());
    curve("left", (0..ny).rev().map(|j| edge(node(0, j + 1), node(0, j))).collect());
    groups.insert("corner".into(), Group::Points(vec![0]));
    groups.insert("body".into(), Group::Cells((0..cells.len()).collect()));
    let corners = vec![node(0, 0), node(nx, 0), node(0, ny), node(nx, ny)];
    Mesh { file: "test.msh".into(), points, cells, corners, groups }
}

/// Rotation by degrees about the origin.
pub fn rotation(degrees: f64) -> impl Fn(f64, f64) -> [f64; 2] + Copy {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |x, y| [cos * x - sin * y, sin * x + cos * y]
}

/// A history: iterations, load factors and states of its increments, and how it ended.
pub struct March {
    pub iterations: Vec<usize>,
    pub load_factors: Vec<f64>,
    pub states: Vec<ModelState>,
    pub end: midplane::error::Result<Totals>,
}

/// Goes through a history, to its end or not.
pub fn try_solve(problem: &Problem) -> March {
    let (iterations, load_factors, states) = (Vec::new(), Vec::new(), Vec::new());
    let mut march = March { iterations, load_factors, states, end: Ok(Totals::default()) };
    march.end = each_increment(problem, |increment, history| {
        if increment.number > 0 && !increment.ended {
            march.iterations.push(increment.iterations);
            march.load_factors.push(increment.load_factor);
            march.states.push(history.state().clone());
        }
    });
    march
}

/// Goes through a history and looks at every increment.
pub fn each_increment(
    problem: &Problem,
    mut look: impl FnMut(&Increment, &History),
) -> midplane::error::Result<Totals> {
    let mut clock = Clock::new("test");
    let equations = Equations::new(problem, Means::default(), &mut clock)?;
    let mut history = History::new(problem, &equations, clock);
    while let Some(increment) = history.next()? {
        look(&increment, &history);
    }
    Ok(history.totals().clone())
}

/// All states of a scene after its increments, and the counts.
pub fn solve(problem: &Problem) -> (Vec<ModelState>, Totals) {
    let mut states = Vec::new();
    let totals = each_increment(problem, |increment, history| {
        if increment.number > 0 {
            states.push(history.state().clone());
        }
    });
    (states, totals.unwrap())
}

/// Displacement of a node of a body.
pub fn displacement(problem: &Problem, state: &ModelState, subdomain: usize, node: usize) -> [f64; 2] {
    let dof = 2 * (problem.model.subdomains[subdomain].first_node + node);
    [state.snapshot.u[dof], state.snapshot.u[dof + 1]]
}

/// Points of a group of a body.
pub fn group(problem: &Problem, subdomain: usize, name: &str) -> Vec<usize> {
    let mesh = &problem.model.subdomains[subdomain].mesh;
    mesh.groups[name].points(mesh)
}

/// Asserts |got − exact| ≤ tolerance · scale.
#[track_caller]
pub fn close(got: f64, exact: f64, tolerance: f64, scale: f64, what: &str) {
    assert!((got - exact).abs() <= tolerance * scale.abs(), "{what}: {got:e}, exact {exact:e}");
}
