//! Claim: where an interface ends on nodes that are held on both sides, unmatched meshes carry what matched ones do, at every
//! stiffness.
//!
//! The cantilever of tests/coupling/cantilever.rs next to its clamp, x < 0.3 m: two first edges of different length have hats that no jump of
//! the grid can make equal, so the end of the grid follows its neighbours there.

use crate::common::*;
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Support, Surroundings};
use midplane::law::Local;
use midplane::mesh::Facet;
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
    let bending = step("bending")
        .fix("lower.left", "xy")
        .fix("upper.left", "xy")
        .traction("lower.right", 0.0, -1.0)
        .traction("upper.right", 0.0, -1.0);
    let scene = layers(k).step(bending).probe("end", "upper.right.displacement_y");
    let problem = scene.bind(vec![layer([0.0, 0.5], n[0]), layer([0.5, 1.0], n[1])]).unwrap();
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

/// Two layers on springs.
fn layers(k: f64) -> Scene {
    Scene::new("strain")
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.3)
        .interface("joint", faces("lower.top", "upper.bottom").law(elastic(k, k)))
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

/// Four blocks, or two under one, around (1, 1), with the exact field of a continuous body on their outer sides:
///
/// ```text
/// Airy φ = x³y − xy³ (from (0.4, 0.7)):  σ_xx = −6xy, σ_yy = 6xy, σ_xy = 3y² − 3x²
/// u = (1+ν)/E (y³ − 3x²y),  v = (1+ν)/E (3xy² − x³)
/// ```
/// Largest error of the traction within 0.3 of the junction, of the largest stress. `e`: edges of the blocks in x and y.
fn junction(e: [[usize; 2]; 4], shape: Shape, k: f64, t: bool) -> f64 {
    let at = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let names = ["sw", "se", "nw", "ne"];
    let sides = [["left", "bottom"], ["right", "bottom"], ["left", "top"], ["right", "top"]];
    let mut meshes: Vec<_> = (0..4)
        .map(|i| {
            even_block([at[i][0], at[i][0] + 1.0], [at[i][1], at[i][1] + 1.0], [e[i][0], e[i][1]], shape)
        })
        .collect();
    let mut names: Vec<&str> = names.to_vec();
    let mut sides: Vec<Vec<&str>> = sides.iter().map(|s| s.to_vec()).collect();
    let mut ints = vec![
        ("sw.right", "se.left"),
        ("nw.right", "ne.left"),
        ("sw.top", "nw.bottom"),
        ("se.top", "ne.bottom"),
    ];
    if t {
        // one block on top
        meshes.truncate(2);
        names.truncate(2);
        sides.truncate(2);
        meshes.push(even_block([0.0, 2.0], [1.0, 2.0], [2 * e[2][0] + 1, e[2][1]], shape));
        names.push("top");
        sides.push(vec!["left", "right", "top"]);
        ints = vec![("sw.right", "se.left"), ("sw.top", "top.bottom"), ("se.top", "top.bottom")];
    }
    let nu = 0.3;
    let c = (1.0 + nu) / 1e4;
    let [x, y] = [
        format!("{c:e}*((y-0.7)^3 - 3*(x-0.4)^2*(y-0.7))"),
        format!("{c:e}*(3*(x-0.4)*(y-0.7)^2 - (x-0.4)^3)"),
    ];
    let outer =
        names.iter().zip(&sides).flat_map(|(name, sides)| sides.iter().map(move |s| format!("{name}.{s}")));
    let go = outer
        .fold(step("go"), |go, side| go.displace(&side, "x", x.as_str()).displace(&side, "y", y.as_str()));
    let scene = Scene::new("stress").subdomains(names.iter().copied(), "rock").material("rock", 1e4, nu);
    let joined = ints.iter().enumerate().fold(scene, |scene, (i, (a, b))| {
        scene.interface(&format!("j{i}"), faces(*a, *b).law(elastic(k, k)))
    });
    let problem = joined.step(go).bind(meshes).unwrap();
    let (states, _) = solve(&problem);
    let mut near = 0.0_f64;
    for (j, interface) in problem.model.interfaces.iter().enumerate() {
        for (point, t) in interface.coupling.points.iter().zip(&states[0].snapshot.tractions[j]) {
            let [x, y] = [point.position[0] - 0.4, point.position[1] - 0.7];
            let (xx, yy, xy) = (-6.0 * x * y, 6.0 * x * y, 3.0 * y * y - 3.0 * x * x);
            let [[nx, ny, _], [tx, ty, _], _] = point.rotation;
            let exact = [
                nx * nx * xx + ny * ny * yy + 2.0 * nx * ny * xy,
                nx * tx * xx + ny * ty * yy + (nx * ty + ny * tx) * xy,
            ];
            let off = (t[0] - exact[0]).hypot(t[1] - exact[1]) / 6.0;
            let r = (point.position[0] - 1.0).hypot(point.position[1] - 1.0);
            near = if r < 0.3 { near.max(off) } else { near };
        }
    }
    near
}

#[test]
fn next_to_junctions_tractions_follow_the_field() {
    const COARSE: [[[usize; 2]; 4]; 2] = [[[6, 5], [7, 8], [5, 9], [8, 6]], [[8, 9], [9, 8], [9, 8], [8, 9]]];
    for t in [false, true] {
        for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
            for coarse in COARSE {
                let fine = coarse.map(|edges| edges.map(|n| 2 * n));
                let [near, nearer] = [coarse, fine].map(|edges| junction(edges, shape, 1e10, t));
                let stiffer = junction(coarse, shape, 1e13, t);
                let what = format!("{} {} {coarse:?}", if t { "T" } else { "X" }, shape.label());
                println!("{what}: {near:.4}, {nearer:.4} on half the edges");
                assert!((stiffer - near).abs() <= 0.02 * near, "{what}: {near} {stiffer}");
                assert!(near < 0.06 && nearer < 0.025, "{what}: {near} {nearer}");
            }
        }
    }
}

/// The grid is one for the whole history: a support that comes in a later step slaves the same components.
#[test]
fn a_support_that_comes_later_makes_the_same_grid() {
    let joint = |steps: Vec<Step>| {
        let layer =
            |y: [f64; 2], n: usize| even_block([0.0, 2.0], [y[0], y[1]], [n, 3], Shape::Quadrilateral4);
        let meshes = vec![layer([0.0, 0.5], 12), layer([0.5, 1.0], 13)];
        let problem = layers(1e9).steps(steps).bind(meshes).unwrap();
        problem.model.interfaces[0].coupling.jump.clone()
    };
    let [a, b] = ["a", "b"].map(step);
    let lower = a.fix("lower.left", "xy");
    let both = lower.clone().fix("upper.left", "xy");
    let held = vec![both.clone()];
    let later = vec![lower.clone().fix("lower.bottom", "xy"), b.clone().hold("upper.left", "xy")];
    let gone = vec![both, b.fix("lower.bottom", "xy").release("upper.left", "xy")];
    let free = vec![lower];
    let [held, later, gone, free] = [held, later, gone, free].map(joint);
    assert!(held == later && held == gone && held != free);
}

/// G of a straight joint from x = 0 to 2 of so many edges on either side, the nodes at x = 0 held or not.
fn operator(edges: [usize; 2], held: bool) -> Vec<(Vec<usize>, Vec<f64>)> {
    operator_of(edges, held, false, JumpScheme::Projected)
}

/// The same of edges with or without mid-nodes, by a scheme.
fn operator_of(
    edges: [usize; 2],
    held: bool,
    quadratic: bool,
    kind: JumpScheme,
) -> Vec<(Vec<usize>, Vec<f64>)> {
    let chain = |n: usize, forward: bool| {
        let place = |s: f64| [2.0 * s / n as f64, 0.0, 0.0];
        let mut points: Vec<[f64; 3]> = (0..=n).map(|i| place(i as f64)).collect();
        points.extend((0..if quadratic { n } else { 0 }).map(|i| place(i as f64 + 0.5)));
        let edge = |i: usize| {
            let [start, end] = if forward { [i, i + 1] } else { [i + 1, i] };
            Facet::edge(&[start, end, n + 1 + i][..if quadratic { 3 } else { 2 }], i, true)
        };
        (points, (0..n).map(edge).collect::<Vec<Facet>>())
    };
    let [a, b] = [chain(edges[0], false), chain(edges[1], true)];
    let side = |k: usize, first: usize| {
        let (points, edges) = [&a, &b][k];
        [Side { name: "side", points, edges, corners: &[usize::MAX], first }]
    };
    let mut supports = vec![Support::Free; 2 * (a.0.len() + b.0.len())];
    if held {
        for d in 0..2 {
            (supports[d], supports[2 * a.0.len() + d]) = (Support::Held, Support::Held);
        }
    }
    let scheme = Scheme { kind, points: Points::Gauss, gap: Gap::Closed };
    let around = Surroundings { supports: &supports, junctions: &[] };
    let coupling = Coupling::build("joint", &side(0, 0), &side(1, a.0.len()), scheme, around).unwrap();
    let row = |i: usize| coupling.jump.row(i);
    (0..coupling.jump.rows()).map(|i| (row(i).0.to_vec(), row(i).1.to_vec())).collect()
}

#[test]
fn ends_whose_edges_match_or_leave_room_keep_their_own_jump() {
    for edges in [[9, 9], [4, 16], [16, 4], [5, 40]] {
        assert_eq!(operator(edges, true), operator(edges, false), "{edges:?}");
    }
    for edges in [[9, 10], [10, 9], [6, 9], [5, 19]] {
        assert_ne!(operator(edges, true), operator(edges, false), "{edges:?}");
    }
}

/// Claim: between edges with mid-nodes a quadratic grid has an end that follows, a linear one leaves room.
#[test]
fn quadratic_grids_follow_at_held_ends_and_linear_ones_between_quadratic_sides_need_not() {
    for edges in [[9, 10], [10, 9], [6, 9]] {
        let [quadratic, linear] = [JumpScheme::Projected, JumpScheme::ProjectedLinear]
            .map(|kind| operator_of(edges, true, true, kind) == operator_of(edges, false, true, kind));
        assert!(!quadratic && linear, "{edges:?}: {quadratic} {linear}");
    }
}
