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
const MORTAR: &str = r#""type": "cracking", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 0.2,
    "cohesion": 0.3, "tan_friction": 0.75, "fracture_energy_i": 2e-5, "fracture_energy_iia": 1e-4, "dilatancy_stress": 0"#;
/// Concrete.
const CONCRETE: &str = r#""type": "cracking", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 3,
    "cohesion": 5, "tan_friction": 0.8, "fracture_energy_i": 1e-4, "fracture_energy_iia": 1e-3, "dilatancy_stress": 0"#;

/// A block of quadrilaterals.
fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], [nx, ny]: [usize; 2]) -> Mesh {
    rectangle(&even(x0, x1, nx), &even(y0, y1, ny), Shape::Quadrilateral4, |x, y| [x, y])
}

/// Adds a group of the point at a place.
fn name_point(mesh: &mut Mesh, name: &str, at: [f64; 2]) {
    let there = |p: &[f64; 3]| (p[0] - at[0]).hypot(p[1] - at[1]) < 1e-9;
    let point = mesh.points.iter().position(there).unwrap();
    mesh.groups.insert(name.into(), Group::Points(vec![point]));
}

/// Probes and energies at the rows that the fewest increments share, of runs with 1, 5 and 50 increments.
fn compare(what: &str, scene: impl Fn(usize) -> String, meshes: impl Fn() -> Vec<Mesh>) {
    let runs = [1, 5, 50].map(|increments| {
        let problem = bind(&scene(increments), meshes()).unwrap();
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
        format!(
            r#"{{"plane": "stress", "subdomains": {{"l": {{"msh": "l", "material": "m"}}, "r": {{"msh": "r", "material": "m"}}}},
            "materials": {{"m": {{"young": 3e4, "poisson": 0.2}}}},
            "interfaces": {{"j": {{"side_a": "l.ligament", "side_b": "r.ligament", "law": {{{CONCRETE}}}}}}},
            "steps": [{{"name": "bend", "increments": {increments},
              "fix": {{"l.support": ["x", "y"], "r.support": ["y"]}},
              "displace": {{"l.load": {{"y": -2e-4}}, "r.load": {{"y": -2e-4}}}}}}]}}"#
        )
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
        let all = |of: &dyn Fn(usize) -> String, which: &[usize]| -> String {
            which.iter().map(|&k| of(k)).collect::<Vec<_>>().join(",")
        };
        let every: Vec<usize> = (0..9).collect();
        let bricks = all(&|k| format!(r#""b{k}": {{"msh": "b{k}", "material": "brick"}}"#), &every);
        let beds = all(
            &|k| {
                let above = k + 3;
                format!(
                    r#""bed{k}": {{"side_a": "b{k}.top", "side_b": "b{above}.bottom", "law": {{{MORTAR}}}}}"#
                )
            },
            &every[..6],
        );
        let heads = all(
            &|k| {
                let beside = k + 1;
                format!(
                    r#""head{k}": {{"side_a": "b{k}.right", "side_b": "b{beside}.left", "law": {{{MORTAR}}}}}"#
                )
            },
            &[0, 1, 3, 4, 6, 7],
        );
        let bottom = all(&|k| format!(r#""b{k}.bottom": ["x", "y"]"#), &every[..3]);
        let constrained = all(&|k| format!(r#""b{k}.top": ["x"]"#), &every[6..]);
        let pressed = all(&|k| format!(r#""b{k}.top": {{"pressure": 0.5}}"#), &every[6..]);
        let pushed = all(&|k| format!(r#""b{k}.top": {{"x": 2e-4}}"#), &every[6..]);
        let shear = all(&|k| format!(r#""shear{k}": "bed{k}.resultant_t""#), &every[..3]);
        format!(
            r#"{{"plane": "stress", "subdomains": {{{bricks}}},
            "materials": {{"brick": {{"young": 1e4, "poisson": 0.2}}}}, "interfaces": {{{beds}, {heads}}},
            "steps": [{{"name": "press", "fix": {{{bottom}, {constrained}}}, "load": {{{pressed}}}}},
                      {{"name": "push", "increments": {increments}, "displace": {{{pushed}}}}}],
            "output": {{"history": {{{shear}}}}}}}"#
        )
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
        let interface = |name: &str, a: &str, b: &str| {
            // where cracks close, what its two snaps release in 1 and in 50 increments differs by 2 % of the energy
            let law = format!(r#"{CONCRETE}, "unloading": "plastic""#);
            format!(r#""{name}": {{"side_a": "{a}", "side_b": "{b}", "law": {{{law}}}}}"#)
        };
        let interfaces = [
            interface("left", "base.top", "l.bottom"),
            interface("right", "base.top", "r.bottom"),
            interface("web", "l.right", "r.left"),
        ];
        format!(
            r#"{{"plane": "stress", "subdomains": {{"base": {{"msh": "b", "material": "m"}}, "l": {{"msh": "l", "material": "m"}},
              "r": {{"msh": "r", "material": "m"}}}},
            "materials": {{"m": {{"young": 3e4, "poisson": 0.2}}}}, "interfaces": {{{}}},
            "steps": [{{"name": "part", "increments": {increments}, "fix": {{"base.bottom": ["x", "y"]}},
              "displace": {{"l.left": {{"x": -1e-4}}, "r.right": {{"x": 1e-4}}}}}}],
            "output": {{"history": {{"web": "web.resultant_n", "left": "left.resultant_t", "right": "right.resultant_t"}}}}}}"#,
            interfaces.join(",")
        )
    };
    compare("T", scene, meshes);
}
