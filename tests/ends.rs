//! Claim: where an interface ends on nodes that are held on both sides, unmatched meshes carry what matched ones do, at every
//! stiffness.
//!
//! The cantilever of tests/cantilever.rs next to its clamp, x < 0.3 m: two first edges of different length have hats that no jump of
//! the grid can make equal, so the end of the grid follows its neighbours there.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use common::*;
use midplane::law::Local;
use midplane::shape::Shape;

/// Tractions on x < 0.3 m.
struct NearClamp {
    /// Largest |t_n| in the first cell.
    first: f64,
    /// Largest |t_n| beyond it.
    beyond: f64,
    /// Largest |t|.
    all: f64,
}

fn clamp(n: [usize; 2], k: f64, shape: Shape) -> NearClamp {
    let rows = |n: usize| ((n as f64 / 4.0).round() as usize).max(2);
    let flat = |x: f64, y: f64| [x, y];
    let layer =
        |y: [f64; 2], n: usize| rectangle(&even(0.0, 2.0, n), &even(y[0], y[1], rows(n)), shape, flat);
    let text = format!(
        r#"{{ "plane": "strain",
          "subdomains": {{ "lower": {{ "msh": "l", "material": "rock" }}, "upper": {{ "msh": "u", "material": "rock" }} }},
          "materials": {{ "rock": {{ "young": 1e4, "poisson": 0.3 }} }},
          "interfaces": {{ "joint": {{ "side_a": "lower.top", "side_b": "upper.bottom",
            "law": {{ "type": "elastic", "normal_stiffness": {k}, "tangential_stiffness": {k} }} }} }},
          "steps": [ {{ "name": "bending", "fix": {{ "lower.left": ["x", "y"], "upper.left": ["x", "y"] }},
            "load": {{ "lower.right": {{ "traction": [0.0, -1.0] }}, "upper.right": {{ "traction": [0.0, -1.0] }} }} }} ],
          "output": {{ "history": {{ "end": "upper.right.displacement_y" }} }} }}"#
    );
    let problem = bind(&text, vec![layer([0.0, 0.5], n[0]), layer([0.5, 1.0], n[1])]).unwrap();
    let (states, _) = solve(&problem);
    let coupling = &problem.model.interfaces[0].coupling;
    let points: Vec<_> = coupling.points.iter().zip(&states[0].snapshot.tractions[0]).collect();
    let ends = coupling.midplane.cells.iter().map(|cell| cell.places[0][0].max(cell.places[1][0]));
    let cell = ends.fold(2.0, f64::min);
    let most = |from: f64, to: f64, of: fn(&Local) -> f64| {
        let near = points.iter().filter(|(p, _)| p.position[0] > from && p.position[0] < to);
        near.map(|(_, t)| of(t)).fold(0.0, f64::max)
    };
    let normal = |t: &Local| t.x.abs();
    NearClamp {
        first: most(0.0, cell, normal),
        beyond: most(cell, 0.3, normal),
        all: most(0.0, 0.3, |t| t.norm()),
    }
}

#[test]
fn a_clamped_end_carries_no_spurious_normal_traction() {
    for shape in [Shape::Quadrilateral4, Shape::Quadrilateral8, Shape::Triangle3, Shape::Triangle6] {
        for n in [[24, 25], [16, 17], [22, 23], [31, 32], [23, 37], [36, 25]] {
            // matched meshes of either side
            let matched = n.map(|n| clamp([n, n], 1e10, shape).all);
            let found = [1e7, 1e10, 1e14].map(|k| clamp(n, k, shape));
            let what = format!("{} {n:?}", shape.label());
            let [soft, stiff, stiffest] = &found;
            println!(
                "{what}: |t_n| {:.3} in the first cell, {:.3} beyond, |t| {:.3} ({:.3} {:.3} matched)",
                stiffest.first, stiffest.beyond, stiffest.all, matched[0], matched[1]
            );
            for near in &found {
                assert!(near.first < 0.3 && near.beyond < 0.1, "{what}: {} {}", near.first, near.beyond);
                let off = matched.map(|matched| (near.all / matched - 1.0).abs());
                assert!(off.iter().any(|off| *off < 0.1), "{what}: {} {matched:?}", near.all);
            }
            assert!((stiff.all / stiffest.all - 1.0).abs() < 0.01, "{what}: {} {}", stiff.all, stiffest.all);
            assert!((soft.all / stiff.all - 1.0).abs() < 0.01, "{what}: {} {}", soft.all, stiff.all);
        }
    }
}
