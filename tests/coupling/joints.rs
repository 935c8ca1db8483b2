//! Claim: geometry at its extremes is joined exactly, or refused with the reason. Each test names its row of docs/EXTREMES.md.
//!
//! ```text
//!   ●───────────────────●   one edge on a thousand, offsets of any size, edges of almost no length, corners, polygons of one arc,
//!   ●●●●●●●●●●●●●●●●●●●●●   partial overlap, gaps, T-junctions; from micrometres to thousands of kilometres
//! ```

use crate::common::round;
use std::f64::consts::PI;

use crate::common::chains::*;
use crate::common::*;
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme};
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use midplane::shape::vector::in_plane;
use serde_json::Value;

const PROJECTED: (JumpScheme, Points) = (JumpScheme::Projected, Points::Gauss);
/// Uniform compression, E = 1e4, ν = 0: σ_yy = −p, nothing else.
const P: f64 = 10.0;
const KN: f64 = 1e6;

/// The scene of blocks of one rock.
fn rock(blocks: &[(&str, Mesh)]) -> Scene {
    Scene::new("strain").subdomains(blocks.iter().map(|(name, _)| *name), "rock").material("rock", 1e4, 0.0)
}

fn bound(scene: Scene, blocks: impl IntoIterator<Item = (&'static str, Mesh)>) -> Problem {
    scene.bind(blocks.into_iter().map(|(_, mesh)| mesh).collect()).unwrap()
}

/// An interface of A's top with one side or several.
fn joined(kn: f64, side_b: impl Into<Value>) -> Interface {
    faces("a.top", side_b).law(elastic(kn, kn))
}

/// Two layers 0..1 wide with the given x of the interface's nodes, meeting at y = 0, in a plane moved by `to`.
fn layers(x: [&[f64]; 2], shape: Shape, to: impl Fn(f64, f64) -> [f64; 2]) -> (Problem, ModelState) {
    layers_joined(x, shape, KN, to)
}

fn layers_joined(
    x: [&[f64]; 2],
    shape: Shape,
    kn: f64,
    to: impl Fn(f64, f64) -> [f64; 2],
) -> (Problem, ModelState) {
    let place = |x: f64, y: f64| to(x, y);
    let a = rectangle(x[0], &even(-0.5, 0.0, 2), shape, place);
    let b = rectangle(x[1], &even(0.0, 0.5, 2), shape, place);
    let blocks = [("a", a), ("b", b)];
    let press = step("press").fix("a.bottom", "y").fix("a.left", "x").fix("b.left", "x").pressure("b.top", P);
    let problem = bound(rock(&blocks).interface("joint", joined(kn, "b.bottom")).step(press), blocks);
    let state = solve(&problem).0.remove(0);
    (problem, state)
}

/// Largest error of tractions, relative to the pressure.
fn error(state: &ModelState) -> f64 {
    let all = state.snapshot.tractions.iter().flatten();
    all.map(|t| (t[0] + P).abs().max(t[1].abs()) / P).fold(0.0, f64::max)
}

fn sum_of_segments(problem: &Problem, interface: usize) -> f64 {
    let segments = &problem.model.interfaces[interface].coupling.midplane.segments;
    assert!(segments.iter().all(|g| g.s[1] > g.s[0]));
    segments.iter().map(|g| g.s[1] - g.s[0]).sum()
}

#[test]
fn b1_one_edge_against_a_thousand() {
    let check = |n: usize, m: usize, c: &Coupling| {
        let common = (0..=n).filter(|i| (i * m).is_multiple_of(n)).count() - 2;
        assert_eq!(c.midplane.segments.len(), n + m - 1 - common, "{n}:{m}");
        assert!(c.midplane.grid_nodes <= n + 1);
    };
    for n in [1, 7] {
        let (problem, state) =
            layers([&even(0.0, 1.0, n), &even(0.0, 1.0, 1000)], Shape::Quadrilateral4, |x, y| [x, y]);
        assert!(error(&state) < 1e-9, "{n}:1000: {:e}", error(&state));
        check(n, 1000, &problem.model.interfaces[0].coupling);
    }
    // quadratic sides: a linearly varying traction reaches the nodes as it should
    let (n, m) = (2, 2000);
    let line = |n: usize, forward: bool| Curve::new(&even(0.0, 1.0, n), false, true, forward, &|t| [t, 0.0]);
    let (a, b) = (line(n, false), line(m, true));
    for kind in [JumpScheme::Projected, JumpScheme::Pointwise] {
        let c = join(&[&a], &[&b], (kind, Points::Gauss)).unwrap();
        check(n, m, &c);
        let t: Vec<[f64; 2]> = c.points.iter().map(|p| [1.0 + p.s, 0.0]).collect();
        let f = forces(&c, &t, a.points.len() + b.points.len());
        // ∫ N (1 + x) dx of a quadratic edge from x to x + h: h/6 (1 + x), h/6 (1 + x + h), 2h/3 (1 + x + h/2)
        let mut exact = vec![0.0; f.len()];
        for (curve, first, sign) in [(&a, 0, -1.0), (&b, a.points.len(), 1.0)] {
            for edge in &curve.edges {
                let x: Vec<f64> = edge.nodes().iter().map(|&node| curve.points[node][0]).collect();
                let h = (x[1] - x[0]).abs();
                for (node, (x, share)) in edge.nodes().iter().zip(x.iter().zip([1.0, 1.0, 4.0])) {
                    exact[first + node] += sign * share * h / 6.0 * (1.0 + x);
                }
            }
        }
        for (f, exact) in f.iter().zip(exact) {
            assert!((f[1] - exact).abs() < 1e-12 && f[0].abs() < 1e-12, "{kind:?}: {f:?} {exact}");
        }
    }
}

#[test]
fn b2_offsets_of_any_size_are_exact_and_continuous() {
    let mut before = None;
    for d in [1e-3, 1e-5, 1e-8, 1e-10, 1e-12, 1.1e-13, 0.9e-13, 1e-14, 1e-15, 1e-16, 0.0] {
        for factor in [1.0, 1.0 + 1e-3] {
            let mut x = even(0.0, 1.0, 8);
            for (i, x) in x[1..8].iter_mut().enumerate() {
                *x += if i % 2 == 0 { d * factor } else { -d * factor };
            }
            for shape in [Shape::Quadrilateral4, Shape::Quadrilateral8] {
                let (problem, state) = layers([&even(0.0, 1.0, 8), &x], shape, |x, y| [x, y]);
                assert!(error(&state) < 1e-11, "d = {d:e} {shape:?}: {:e}", error(&state));
                assert!((sum_of_segments(&problem, 0) - 1.0).abs() < 1e-14, "d = {d:e}");
                let segments = problem.model.interfaces[0].coupling.midplane.segments.len();
                assert!(segments == if d > 1e-13 { 15 } else { 8 } || d == 1e-13, "d = {d:e}: {segments}");
            }
            // a jump that is not uniform follows d without a step
            let line = |x: &[f64], forward: bool| Curve::new(x, false, false, forward, &|t| [t, 0.0]);
            let (a, b) = (line(&even(0.0, 1.0, 8), false), line(&x, true));
            let u: Vec<[f64; 2]> = a
                .points
                .iter()
                .map(|x| [0.0, x[0] * x[0]])
                .chain(b.points.iter().map(|_| [0.0; 2]))
                .collect();
            let f = respond(&join(&[&a], &[&b], PROJECTED).unwrap(), &u, [1.0, 1.0]);
            if let Some((d_before, f_before)) = before.replace((d, f.clone())) {
                let step: f64 = f
                    .iter()
                    .flatten()
                    .zip(f_before.iter().flatten())
                    .map(|(p, q): (&f64, &f64)| (p - q).abs())
                    .fold(0.0, f64::max);
                let change: f64 = (d_before - d * factor).abs() + d * 1e-3;
                assert!(step < 1e-14 + 2.0 * change, "d = {d:e}: {step:e}");
            }
        }
    }
}

#[test]
fn b3_an_edge_of_almost_no_length() {
    for tiny in [1e-10, 1e-12] {
        let mut x = even(0.0, 1.0, 4);
        x.insert(3, 0.5 + tiny);
        for (kind, points) in ALL {
            let line = |x: &[f64], forward: bool| Curve::new(x, false, false, forward, &|t| [t, 0.25 * t]);
            let (a, b) = (line(&x, false), line(&even(0.0, 1.0, 7), true));
            let c = join(&[&a], &[&b], (kind, points)).unwrap();
            let u: Vec<[f64; 2]> =
                a.points.iter().map(|_| [0.0; 2]).chain(b.points.iter().map(|_| [0.3, 0.4])).collect();
            let (cos, sin) = (1.0 / 1.0625f64.sqrt(), 0.25 / 1.0625f64.sqrt());
            for r in jumps(&c, &u) {
                assert!(
                    (r[0] - (0.4 * cos - 0.3 * sin)).abs() < 1e-12
                        && (r[1] - (0.3 * cos + 0.4 * sin)).abs() < 1e-12
                );
            }
            assert!((c.midplane.length - 1.0625f64.sqrt()).abs() < 1e-14);
        }
    }
}

#[test]
fn b4_one_edge_against_one() {
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
        for n in [1, 2] {
            let (_, state) = layers([&even(0.0, 1.0, 1), &even(0.0, 1.0, n)], shape, |x, y| [x, y]);
            assert!(error(&state) < 1e-12, "{shape:?} 1:{n}: {:e}", error(&state));
        }
    }
}

#[test]
fn b5_coordinates_in_micrometres_and_in_thousands_of_kilometres() {
    for size in [1e-6, 1e6] {
        let x = [&even(0.0, 1.0, 5)[..], &even(0.0, 1.0, 8)];
        let (problem, state) =
            layers_joined(x, Shape::Quadrilateral4, KN / size, |x, y| [size * x, size * y]);
        assert!(error(&state) < 1e-11, "{size:e}: {:e}", error(&state));
        assert!((sum_of_segments(&problem, 0) / size - 1.0).abs() < 1e-14);
    }
}

#[test]
fn b6_b7_far_from_the_origin_rounding_of_coordinates_is_all() {
    // ε · offset of the coordinates over h = 1/8, times what the law and the element make of it
    for (offset, limit) in [(1e3, 1e-10), (1e6, 1e-7), (1e9, 1e-4)] {
        let (problem, state) =
            layers([&even(0.0, 1.0, 5), &even(0.0, 1.0, 8)], Shape::Quadrilateral4, |x, y| {
                [offset + x, 5.0 * offset + y]
            });
        assert!(error(&state) < limit, "{offset:e}: {:e}", error(&state));
        assert!((sum_of_segments(&problem, 0) - 1.0).abs() < 4.0 * f64::EPSILON * offset);
    }
}

#[test]
fn b22_sides_that_touch_at_a_point_or_not_at_all() {
    let line = |from: [f64; 2], to: [f64; 2], forward: bool| {
        Curve::through(&[from, [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])], to], forward)
    };
    let a = line([0.0, 0.0], [1.0, 0.0], false);
    for (b, expected) in [
        (line([1.0, 0.0], [2.0, 0.0], true), "no common length, they touch at (1.000000, 0.000000)"),
        (line([1.0, 0.0], [1.0, 1.0], true), "no common length, they touch at (1.000000, 0.000000)"),
        (line([1.5, 0.0], [2.0, 0.0], true), "no common length, they are 5.000e-1 apart"),
    ] {
        let message = join(&[&a], &[&b], PROJECTED).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn b23_partial_overlap_couples_the_common_length_and_says_so() {
    let blocks = [
        ("a", even_block([0.3, 1.7], [-0.5, 0.0], [9, 3], Shape::Quadrilateral4)),
        ("b", even_block([0.0, 1.0], [0.0, 0.5], [7, 3], Shape::Quadrilateral4)),
    ];
    let press = step("press").fix("a.bottom", "xy").fix("b.left", "x").pressure("b.top", P);
    let problem = bound(rock(&blocks).interface("joint", joined(KN, "b.bottom")).step(press), blocks);
    let c = &problem.model.interfaces[0].coupling.midplane;
    assert!((c.length - 0.7).abs() < 1e-15);
    close(c.joined[0], 0.5, 1e-14, 1.0, "share of A");
    close(c.joined[1], 0.7, 1e-14, 1.0, "share of B");
    let said = |text: &str| problem.warnings.iter().any(|warning| warning.what.contains(text));
    assert!(said("50.0000 % of side A is joined (length 0.700000)"), "{:?}", problem.warnings);
    assert!(said("70.0000 % of side B"), "{:?}", problem.warnings);
    // all of the pressure passes through it
    let state = solve(&problem).0.remove(0);
    let points = &problem.model.interfaces[0].coupling.points;
    let sum: f64 = points.iter().zip(&state.snapshot.tractions[0]).map(|(p, t)| p.weight * t[0]).sum();
    close(sum, -P, 1e-10, P, "resultant");
}

#[test]
fn b24_gaps_and_overlaps_are_refused_with_size_and_place() {
    let a = Curve::new(&even(0.0, 1.0, 5), false, false, false, &|t| [t, 0.0]);
    let at = |gap: f64, end: f64| {
        Curve::new(&even(0.0, 1.0, 8), false, false, true, &move |t| [t, gap + (end - gap) * t])
    };
    // normal to the mean direction, where A ends: an isosceles triangle with legs of 1
    let wedge = format!("gap of {:.3e}", 2.0 * (0.5 * 0.05f64.atan()).sin());
    for (gap, end, expected) in [
        (0.1, 0.1, "gap of 1.000e-1 over a length of 1.000e0"),
        (-0.1, -0.1, "overlap of 1.000e-1 over a length of 1.000e0"),
        (0.0, 0.05, wedge.as_str()),
        (0.002, 0.002, "gap of 2.000e-3"),
    ] {
        let message = join(&[&a], &[&at(gap, end)], PROJECTED).unwrap_err().to_string();
        assert!(message.contains(expected) && message.contains("near ("), "{message}");
    }
    // within 1e-3 of the length the sides are taken as one; a gap that is meant may be larger, an overlap may not
    assert!(join(&[&a], &[&at(9e-4, 9e-4)], PROJECTED).is_ok());
    let open = Scheme { kind: JumpScheme::Projected, points: Points::Gauss, gap: Gap::Open };
    let c = join_with(&[&a], &[&at(0.02, 0.04)], open).unwrap();
    assert!(c.points.iter().all(|p| p.gap > 0.0199 && p.gap < 0.0401));
    assert!(join_with(&[&a], &[&at(-0.02, -0.02)], open).is_err());
}

#[test]
fn b25_two_polygons_of_one_arc_carry_nothing_without_load() {
    let ring =
        |n: usize, r: [f64; 2]| round::ring(n, &even(r[0], r[1], 2), Shape::Quadrilateral4, 0.1 * n as f64);
    let blocks = [("a", ring(12, [1.0, 1.5])), ("b", ring(17, [1.5, 2.0]))];
    let rest = step("press").fix("a.bottom", "xy").pressure("b.top", 0);
    let problem = bound(rock(&blocks).interface("joint", joined(KN, "b.bottom")).step(rest), blocks);
    let state = solve(&problem).0.remove(0);
    assert!(state.snapshot.tractions[0].iter().flatten().all(|t| *t == 0.0));
    assert!(state.snapshot.u.iter().all(|u| *u == 0.0));
}

/// One long block below, two on top of it: as one interface with two curves on side B, and as two interfaces.
#[test]
fn b26_t_junction_of_one_side_against_two_blocks() {
    for shape in [Shape::Quadrilateral4, Shape::Triangle6] {
        for split in [false, true] {
            let block =
                |x: [f64; 2], n: usize, y: [f64; 2]| even_block([x[0], x[1]], [y[0], y[1]], [n, 2], shape);
            let blocks = [
                ("a", block([0.0, 1.0], 7, [-0.5, 0.0])),
                ("b", block([0.0, 0.45], 5, [0.0, 0.5])),
                ("c", block([0.45, 1.0], 4, [0.0, 0.5])),
            ];
            let scene = if split {
                let scene = rock(&blocks).interface("joint", joined(KN, "b.bottom"));
                scene.interface("other", joined(KN, "c.bottom"))
            } else {
                rock(&blocks).interface("joint", joined(KN, vec!["b.bottom", "c.bottom"]))
            };
            let held = step("press").fix("a.bottom", "y").fix("a.left", "x");
            let press = held.fix("b.left", "x").fix("c.right", "x");
            let press = press.pressure("b.top", P).pressure("c.top", P);
            let problem = bound(scene.step(press), blocks);
            let state = solve(&problem).0.remove(0);
            assert!(error(&state) < 1e-11, "{shape:?} {split}: {:e}", error(&state));
            let length: f64 = (0..if split { 2 } else { 1 }).map(|j| sum_of_segments(&problem, j)).sum();
            assert!((length - 1.0).abs() < 1e-14, "{length}");
            if !split {
                let c = &problem.model.interfaces[0].coupling.midplane;
                assert!(c.joined.iter().all(|share| (share - 1.0).abs() < 1e-14));
                assert_eq!((c.pieces.len(), c.pieces[1].follows), (2, true));
            }
        }
    }
}

#[test]
fn b29_direction_and_order_of_the_curves_do_not_matter() {
    // the mesh room turns clockwise cells and curves; what is left is numbering: backwards on either side
    let arc = |n: usize, forward: bool| {
        Curve::new(&even(0.0, 1.0, n), false, false, forward, &|t| [(2.0 * t).cos(), (2.0 * t).sin()])
    };
    let (a, b) = (arc(12, true), arc(17, false));
    let u: Vec<[f64; 2]> = a.points.iter().chain(&b.points).map(|x| [x[1] * x[1], x[0].sin()]).collect();
    let f = respond(&join(&[&a], &[&b], PROJECTED).unwrap(), &u, [2.0, 1.0]);
    let n = a.points.len();
    let mut back = u.clone();
    back[..n].reverse();
    back[n..].reverse();
    let mut g = respond(&join(&[&a.renumbered()], &[&b.renumbered()], PROJECTED).unwrap(), &back, [2.0, 1.0]);
    g[..n].reverse();
    g[n..].reverse();
    for (f, g) in f.iter().flatten().zip(g.iter().flatten()) {
        assert!((f - g).abs() < 1e-13, "{f} {g}");
    }
}

/// Mid-nodes on a circle: gaps fall with h⁴, a rigid rotation gives nothing, and mid-nodes off the middle of a straight
/// edge do no harm.
#[test]
fn b37_curved_mid_nodes() {
    let mut gaps = Vec::new();
    for n in [8, 16, 32] {
        let arc = |n: usize, forward: bool| {
            Curve::new(&even(0.0, 1.0, n), false, true, forward, &|t| [(PI * t).cos(), (PI * t).sin()])
        };
        let c = join(&[&arc(n, true)], &[&arc(3 * n / 2, false)], PROJECTED).unwrap();
        gaps.push(c.midplane.gap[1].max(-c.midplane.gap[0]));
        assert!((c.midplane.length / PI - 1.0).abs() < 0.1 / (n as f64).powi(3));
    }
    assert!(gaps[1] < gaps[0] / 12.0 && gaps[2] < gaps[1] / 12.0, "{gaps:?}");
    // off the middle by a quarter of the edge
    let mut a = Curve::new(&even(0.0, 1.0, 4), false, true, false, &|t| [t, 0.0]);
    for (i, p) in a.points.iter_mut().enumerate().skip(5) {
        p[0] += if i % 2 == 0 { 0.03 } else { -0.03 };
    }
    let b = Curve::new(&even(0.0, 1.0, 7), false, true, true, &|t| [t, 0.0]);
    let u: Vec<[f64; 2]> =
        a.points.iter().map(|x| [0.0, x[0]]).chain(b.points.iter().map(|x| [0.0, 3.0 * x[0]])).collect();
    for scheme in ALL {
        let c = join(&[&a], &[&b], scheme).unwrap();
        for (p, r) in c.points.iter().zip(jumps(&c, &u)) {
            assert!((r[0] - 2.0 * p.position[0]).abs() < 1e-13, "{scheme:?}");
        }
    }
}

/// Corners: the normal is one-sided at a kink, the grid splits, forces and moments balance, nothing is lost.
#[test]
fn b42_corners_of_90_and_of_almost_180_degrees() {
    for degrees in [90.0, -90.0, 45.0, 150.0, 179.9f64, -179.9] {
        let turn = (180.0 - degrees.abs()).to_radians() * degrees.signum();
        let at =
            |s: f64| if s <= 1.0 { [s, 0.0] } else { [1.0 + (s - 1.0) * turn.cos(), (s - 1.0) * turn.sin()] };
        let curve = |n: usize, forward: bool| {
            let s = [even(0.0, 1.0, n), even(1.0, 2.0, n + 2)[1..].to_vec()].concat();
            let mut curve = Curve::new(&s, false, false, forward, &at);
            curve.corners = vec![0, n, 2 * n + 2];
            curve
        };
        let (a, b) = (curve(5, false), curve(8, true));
        let x: Vec<[f64; 2]> = a.points.iter().chain(&b.points).map(|&x| in_plane(x)).collect();
        for scheme in ALL {
            let c = join(&[&a], &[&b], scheme).unwrap();
            assert_eq!(c.midplane.pieces.len(), 2, "{degrees}°");
            assert!((c.midplane.kink - turn.abs()).abs() < 1e-14);
            assert!(
                (c.midplane.length - 2.0).abs() < 1e-14
                    && c.midplane.joined.iter().all(|s| (s - 1.0).abs() < 1e-14)
            );
            // a Lobatto point in the corner belongs to one leg or the other
            for p in c.points.iter().filter(|p| (p.s - 1.0).abs() > 1e-9) {
                let exact = if p.s < 1.0 { [0.0, 1.0] } else { [-turn.sin(), turn.cos()] };
                let off = (p.rotation[0][0] - exact[0]).abs() + (p.rotation[0][1] - exact[1]).abs();
                assert!(off < 1e-13, "{degrees}° {scheme:?}: s = {}, {off:e}", p.s);
            }
            let t: Vec<[f64; 2]> = c.points.iter().map(|p| [1.0 + p.s, (3.0 * p.s).cos()]).collect();
            let f = forces(&c, &t, x.len());
            let scale: f64 = f.iter().map(|f| f[0].hypot(f[1])).sum();
            let moment: f64 = f.iter().zip(&x).map(|(f, x)| x[0] * f[1] - x[1] * f[0]).sum();
            let sum = [0, 1].map(|d| f.iter().map(|f| f[d]).sum::<f64>());
            assert!(
                sum[0].hypot(sum[1]) < 1e-13 * scale && moment.abs() < 1e-13 * scale,
                "{degrees}° {scheme:?}"
            );
        }
    }
}

#[test]
fn a_curve_joined_twice_at_one_place_is_refused() {
    let line = |n: usize, forward: bool| Curve::new(&even(0.0, 1.0, n), false, false, forward, &|t| [t, 0.0]);
    let message =
        join(&[&line(3, false)], &[&line(4, true), &line(5, true)], PROJECTED).unwrap_err().to_string();
    assert!(message.contains("faces two curves"), "{message}");
}

/// A side that is split over several curves, and several pieces that do not touch: one interface, nothing dropped.
#[test]
fn sides_in_several_curves_and_pieces() {
    for size in [1e-14, 1.0, 1e14] {
        let line = |from: f64, to: f64, n: usize, forward: bool| {
            Curve::new(&even(from, to, n), false, false, forward, &|t| [size * t, 0.1 * size * t])
        };
        let length = 1.01f64.sqrt();
        let (a, b) = (
            line(0.0, 1.0, 9, false),
            [line(0.0, 0.3, 2, true), line(0.3, 0.6, 5, true), line(0.8, 1.0, 3, true)],
        );
        let c = join(&[&a], &[&b[0], &b[1], &b[2]], PROJECTED).unwrap();
        assert!((c.midplane.length / size - 0.8 * length).abs() < 1e-14);
        let follows = c.midplane.pieces.iter().map(|piece| piece.follows).collect::<Vec<_>>();
        assert_eq!(follows, [false, true, false], "size {size:e}");
        assert!((c.midplane.joined[0] - 0.8).abs() < 1e-14 && (c.midplane.joined[1] - 1.0).abs() < 1e-14);
    }
}

/// 1e5 edges a side are paired, straight and closed; the work of all pairs would not end.
#[test]
fn a_hundred_thousand_edges_a_side_are_paired() {
    let n = 100_000;
    for closed in [false, true] {
        let at = |t: f64| if closed { [(2.0 * PI * t).cos(), -(2.0 * PI * t).sin()] } else { [t, 0.0] };
        let a = Curve::new(&even(0.0, 1.0, n), closed, false, false, &at);
        let b = Curve::new(&even(0.0, 1.0, n - 1), closed, false, true, &at);
        let (side_a, side_b) = ([a.side("a", 0)], [b.side("b", n + 1)]);
        let c = midplane::coupling::join("joint", &side_a, &side_b, Gap::Closed).unwrap();
        assert_eq!(c.segments.len(), 2 * n - 2, "closed {closed}");
    }
}
