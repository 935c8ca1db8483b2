//! Claim: a slit inside one body, its lips two curves of that body that share the tips, is joined to itself: closed by a
//! stiff interface the body is what it is without the slit, whether the nodes of the lips match or not.
//!
//! ```text
//!   ┌───────────────┐
//!   │   ___slit___  │     lips at y = 0, 0.3 < x < 0.7
//!   └───────────────┘     E = 1e4, ν = 0: exact stresses are uniform
//! ```

use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::{Facet, Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;

const P: f64 = 10.0;
const E: f64 = 1e4;

/// A body 1 × 1 with a slit, `inside` edges on the lower and the upper lip, joined with stiffness `k`.
fn solved(inside: [usize; 2], k: f64, press: Step) -> (Problem, ModelState) {
    let half = |n: usize, from: f64, to: f64| {
        let xs =
            [even(0.0, 0.3, 6), even(0.3, 0.7, n)[1..].to_vec(), even(0.7, 1.0, 6)[1..].to_vec()].concat();
        rectangle(&xs, &even(from, to, 8), Shape::Quadrilateral4, |x, y| [x, y])
    };
    let weld = |x: f64| !(0.3 + 1e-9..0.7 - 1e-9).contains(&x);
    let mesh = welded(half(inside[0], -0.5, 0.0), half(inside[1], 0.0, 0.5), weld);
    let scene = Scene::new("strain")
        .subdomain("a", "rock")
        .material("rock", E, 0.0)
        .interface("slit", faces("a.lips below", "a.lips above").law(elastic(k, k)))
        .step(press);
    let problem = scene.bind(vec![mesh]).unwrap();
    let segments = &problem.model.interfaces[0].coupling.midplane.segments;
    assert!((segments.iter().map(|g| g.s[1] - g.s[0]).sum::<f64>() - 0.4).abs() < 1e-15);
    let state = solve(&problem).0.remove(0);
    (problem, state)
}

const LIPS: [[usize; 2]; 3] = [[8, 8], [8, 12], [9, 14]];

#[test]
fn b28_a_slit_closed_by_a_stiff_interface_is_none() {
    for inside in LIPS {
        // the interface gives by p/K, which strains the elements beside it, at least 0.4/14 wide, by no more than 10 p/(K h)
        for k in [1e9, 1e11] {
            let limit = 10.0 * E / (k * 0.4 / 14.0);
            let press = step("press").fix("a.bottom", "y").fix("a.left", "x").pressure("a.top", P);
            let (problem, state) = solved(inside, k, press);
            // the shared tips do not open: nodal jumps are off by e with e₋ + 4 e + e₊ = 0 from there on
            let h = 0.4 / 8.0;
            for (p, t) in problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.tractions[0])
            {
                let cells = |x: f64| ((p.position[0] - x).abs() / h).floor();
                let off = (2.0 - 3f64.sqrt()).powf(cells(0.3)) + (2.0 - 3f64.sqrt()).powf(cells(0.7));
                let good = (t[0] + P).abs() < (off + limit) * P && t[1].abs() < limit * P;
                assert!(good || inside != [8, 8], "{k:e}: {t:?} at {}", p.s);
            }
            for (i, [_, y, _]) in problem.model.subdomains[0].mesh.points.iter().enumerate() {
                let u = displacement(&problem, &state, 0, i);
                close(u[1], -P * (y + 0.5) / E, limit, P / E, "u_y");
                close(u[0], 0.0, limit, P / E, "u_x");
            }
        }
    }
}

/// Pressed along the slit nothing passes through the interface: exact at any stiffness.
#[test]
fn b28_a_slit_along_the_pressure_carries_nothing() {
    let press = step("press")
        .fix("a.left", "x")
        .fix("a.left above", "x")
        .fix("a.corner", "y")
        .pressure("a.right", P)
        .pressure("a.right above", P);
    for inside in LIPS {
        for k in [1e3, 1e8] {
            let (problem, state) = solved(inside, k, press.clone());
            assert!(state.snapshot.tractions[0].iter().flatten().all(|t| t.abs() < 1e-8 * P));
            for (i, [x, _, _]) in problem.model.subdomains[0].mesh.points.iter().enumerate() {
                let u = displacement(&problem, &state, 0, i);
                close(u[0], -P * x / E, 1e-11, P / E, "u_x");
                close(u[1], 0.0, 1e-11, P / E, "u_y");
            }
        }
    }
}

/// Two meshes in one, the nodes of top and bottom shared where `weld` says so; the rest are the lips.
fn welded(below: Mesh, above: Mesh, weld: impl Fn(f64) -> bool) -> Mesh {
    let mut mesh = below.clone();
    let at = |mesh: &Mesh, name: &str| mesh.groups[name].points(mesh);
    let mut number = vec![usize::MAX; above.points.len()];
    for i in at(&above, "bottom") {
        let x = above.points[i][0];
        if weld(x) {
            let twin = at(&below, "top").into_iter().find(|&j| (below.points[j][0] - x).abs() < 1e-9);
            number[i] = twin.unwrap();
        }
    }
    for (i, number) in number.iter_mut().enumerate().filter(|(_, number)| **number == usize::MAX) {
        *number = mesh.points.len();
        mesh.points.push(above.points[i]);
    }
    let first = mesh.cells.len();
    for c in 0..above.cells.len() {
        let nodes: Vec<usize> = above.cells.nodes(c).iter().map(|&node| number[node]).collect();
        mesh.cells.push(above.cells.shapes[c], &nodes);
    }
    let lips = |mesh: &Mesh, name: &str, number: &dyn Fn(usize) -> usize, first: usize| -> Vec<Facet> {
        let Group::Edges(edges) = &mesh.groups[name] else { unreachable!() };
        let free = |edge: &&Facet| !edge.nodes()[..2].iter().all(|&node| weld(mesh.points[node][0]));
        let moved = |edge: &Facet| moved_to(edge.renumbered(number), first + edge.cell, true);
        edges.iter().filter(free).map(moved).collect()
    };
    let (one, two) = (lips(&below, "top", &|i| i, 0), lips(&above, "bottom", &|i| number[i], first));
    for (from, to) in [("top", "top"), ("right", "right above"), ("left", "left above")] {
        let Group::Edges(of) = &above.groups[from] else { unreachable!() };
        let moved = |e: &Facet| moved_to(e.renumbered(|i| number[i]), first + e.cell, e.boundary);
        mesh.groups.insert(to.into(), Group::Edges(of.iter().map(moved).collect()));
    }
    mesh.groups.insert("lips below".into(), Group::Edges(one));
    mesh.groups.insert("lips above".into(), Group::Edges(two));
    mesh
}

/// A facet of another cell.
fn moved_to(mut facet: Facet, cell: usize, boundary: bool) -> Facet {
    (facet.cell, facet.boundary) = (cell, boundary);
    facet
}
