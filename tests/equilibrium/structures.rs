//! Claim: structures with many interfaces end alike whatever the increments: a notched beam in bending, a panel of three by three
//! bricks and a T of three interfaces, with 1, 5 and 50 increments.
//!
//! ```text
//!  ↓ u              ┌──┬──┬──┐ → u      ←┌────┬────┐→ u
//! ┌────┬────┐       ├──┼──┼──┤          │    │    │
//! │    ╷    │       ├──┼──┼──┤          ├────┴────┤
//! △─────────△       └──┴──┴──┘          └─────────┘
//! ```

use crate::common::*;
use midplane::mesh::{Group, Mesh};
use midplane::shape::Shape;

/// Part of its largest value by which a quantity may depend on the increments: five times the path tolerance.
const ALIKE: f64 = 5e-3;

/// Mortar in MPa and m.
fn mortar() -> Law {
    cracking(1e6, 1e6, [0.2, 0.3, 0.75], [2e-5, 1e-4])
}

/// Concrete.
fn concrete() -> Law {
    cracking(1e6, 1e6, [3.0, 5.0, 0.8], [1e-4, 1e-3])
}

/// A block of quadrilaterals.
fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], [nx, ny]: [usize; 2]) -> Mesh {
    even_block([x0, x1], [y0, y1], [nx, ny], Shape::Quadrilateral4)
}

/// Adds a group of the point at a place.
fn name_point(mesh: &mut Mesh, name: &str, at: [f64; 2]) {
    let there = |p: &[f64; 3]| (p[0] - at[0]).hypot(p[1] - at[1]) < 1e-9;
    let point = mesh.points.iter().position(there).unwrap();
    mesh.groups.insert(name.into(), Group::Points(vec![point]));
}

/// Probes and energies at the rows that the fewest increments share, of runs with 1, 5 and 50 increments.
fn compare(what: &str, scene: impl Fn(usize) -> Scene, meshes: impl Fn() -> Vec<Mesh>) {
    let runs = [1, 5, 50].map(|increments| {
        let problem = scene(increments).bind(meshes()).unwrap();
        let march = try_solve(&problem);
        let totals = march.end.unwrap_or_else(|error| panic!("{what}, {increments} increments: {error}"));
        let rows: Vec<Vec<f64>> = (march.states.iter().zip(&march.load_factors))
            .filter(|(_, load_factor)| {
                (5.0 * *load_factor - (5.0 * *load_factor).round()).abs() < 1e-9 && **load_factor > 0.0
            })
            .map(|(state, _)| {
                let mut row = state.probes(&problem);
                row.extend([state.stored, state.dissipated, state.released]);
                row
            })
            .collect();
        println!(
            "{what}, {increments} increments: {} iterations, {} parts, {} snaps, last row {:?}",
            march.iterations.iter().sum::<usize>(),
            totals.parts,
            totals.snaps.len(),
            rows[rows.len() - 1]
        );
        rows
    });
    let [one, five, fifty] = runs;
    // all columns of the history are forces, the last three are energies
    let forces = fifty[0].len() - 3;
    let largest = |range: std::ops::Range<usize>| {
        fifty.iter().flat_map(|row| &row[range.clone()]).fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let (force, energy) = (largest(0..forces), largest(forces..forces + 3));
    let scale = |k: usize| if k < forces { force } else { energy };
    let alike = |a: &[f64], b: &[f64], which: &str| {
        for (k, (a, b)) in a.iter().zip(b).enumerate() {
            assert!(
                (a - b).abs() <= ALIKE * scale(k),
                "{what}, {which}, column {k}: {a} and {b} of {}",
                scale(k)
            );
        }
    };
    assert_eq!(five.len(), fifty.len(), "{what}");
    for (a, b) in five.iter().zip(&fifty) {
        alike(a, b, "5 and 50");
    }
    alike(&one[one.len() - 1], &fifty[fifty.len() - 1], "1 and 50");
    assert!(fifty[fifty.len() - 1].iter().rev().nth(1).unwrap() > &0.0, "{what}: nothing cracks");
}

#[test]
fn a_notched_beam() {
    let meshes = || {
        let notch = |mesh: &mut Mesh, side: &str| {
            let Some(Group::Edges(edges)) = mesh.groups.get(side) else { panic!("{side}") };
            let above = |node: usize| mesh.points[node][1] > 0.03 - 1e-9;
            let ligament =
                edges.iter().filter(|edge| above(edge.nodes()[0]) && above(edge.nodes()[1])).cloned();
            let ligament = Group::Edges(ligament.collect());
            mesh.groups.insert("ligament".into(), ligament);
        };
        let mut left = block([-0.2, 0.0], [0.0, 0.1], [20, 20]);
        let mut right = block([0.0, 0.2], [0.0, 0.1], [16, 30]);
        notch(&mut left, "right");
        notch(&mut right, "left");
        name_point(&mut left, "support", [-0.2, 0.0]);
        name_point(&mut right, "support", [0.2, 0.0]);
        name_point(&mut left, "load", [0.0, 0.1]);
        name_point(&mut right, "load", [0.0, 0.1]);
        vec![left, right]
    };
    let scene = |increments: usize| {
        let bend = step("bend")
            .increments(increments)
            .fix("l.support", "xy")
            .fix("r.support", "y")
            .displace("l.load", "y", -2e-4)
            .displace("r.load", "y", -2e-4);
        Scene::new("stress")
            .subdomains(["l", "r"], "m")
            .material("m", 3e4, 0.2)
            .interface("j", faces("l.ligament", "r.ligament").law(concrete()))
            .step(bend)
    };
    compare("notched beam", scene, meshes);
}

#[test]
fn a_panel_of_three_by_three_bricks() {
    let meshes = || {
        let brick = |k: usize| {
            let (column, row) = (k % 3, k / 3);
            let (x, y) = (0.2 * column as f64, 0.1 * row as f64);
            let edges = if (column + row) % 2 == 0 { [8, 4] } else { [6, 5] };
            block([x, x + 0.2], [y, y + 0.1], edges)
        };
        (0..9).map(brick).collect()
    };
    let scene = |increments: usize| {
        let side = |k: usize, side: &str| format!("b{k}.{side}");
        let joint = |a: String, b: String| faces(a, b).law(mortar());
        let mut scene = Scene::new("stress").material("brick", 1e4, 0.2);
        for k in 0..9 {
            scene = scene.subdomain(&format!("b{k}"), "brick");
        }
        for k in 0..6 {
            scene = scene.interface(&format!("bed{k}"), joint(side(k, "top"), side(k + 3, "bottom")));
        }
        for k in [0, 1, 3, 4, 6, 7] {
            scene = scene.interface(&format!("head{k}"), joint(side(k, "right"), side(k + 1, "left")));
        }
        let (mut press, mut push) = (step("press"), step("push").increments(increments));
        for k in 0..3 {
            press = press.fix(&side(k, "bottom"), "xy");
            scene = scene.probe(&format!("shear{k}"), &format!("bed{k}.resultant_t"));
        }
        for top in (6..9).map(|k| side(k, "top")) {
            press = press.fix(&top, "x").pressure(&top, 0.5);
            push = push.displace(&top, "x", 2e-4);
        }
        scene.step(press).step(push)
    };
    compare("panel", scene, meshes);
}

#[test]
fn a_t_of_interfaces() {
    let meshes = || {
        vec![
            block([-0.1, 0.1], [-0.1, 0.0], [10, 5]),
            block([-0.1, 0.0], [0.0, 0.1], [6, 6]),
            block([0.0, 0.1], [0.0, 0.1], [7, 8]),
        ]
    };
    let scene = |increments: usize| {
        // where cracks close, what its two snaps release in 1 and in 50 increments differs by 2 % of the energy
        let joint = |a: &str, b: &str| faces(a, b).law(concrete().with("unloading", "plastic"));
        let part = step("part")
            .increments(increments)
            .fix("base.bottom", "xy")
            .displace("l.left", "x", -1e-4)
            .displace("r.right", "x", 1e-4);
        Scene::new("stress")
            .subdomains(["base", "l", "r"], "m")
            .material("m", 3e4, 0.2)
            .interface("left", joint("base.top", "l.bottom"))
            .interface("right", joint("base.top", "r.bottom"))
            .interface("web", joint("l.right", "r.left"))
            .step(part)
            .probes([
                ("web", "web.resultant_n"),
                ("left", "left.resultant_t"),
                ("right", "right.resultant_t"),
            ])
    };
    compare("T", scene, meshes);
}
