//! Claim: where several parts meet, each pair is joined once and nothing is dropped: a constant stress passes X- and
//! T-junctions to round-off, whatever the meshes of the parts.
//!
//! ```text
//!   ┌──── nw ────┬──── ne ────┐     x- and T-junctions; every block has its own copy of the common point
//!   │            │            │
//!   ├────────────X────────────┤     σ constant; an interface of normal n carries t = σ n and opens by
//!   │            │            │     (σ_nn/K_N) n + (σ_nt/K_T) t, so block by block
//!   └──── sw ────┴──── se ────┘     u = ε x + i d_v + j d_h   (column i, row j)
//! ```

use crate::common::*;
use midplane::mesh::{Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;

const E: f64 = 1e4;
const NU: f64 = 0.3;
const KN: f64 = 3e5;
const KT: f64 = 7e4;

/// A uniform state of plane stress and what the interfaces add to it.
struct Uniform {
    stress: [f64; 3],
}

impl Uniform {
    /// ε_xx, ε_yy, γ_xy in plane stress.
    fn strain(&self) -> [f64; 3] {
        let [xx, yy, xy] = self.stress;
        [(xx - NU * yy) / E, (yy - NU * xx) / E, 2.0 * (1.0 + NU) * xy / E]
    }

    /// Displacement of a block right of `column` vertical and above `row` horizontal interfaces, as formulas.
    fn formulas(&self, column: f64, row: f64) -> [String; 2] {
        let ([xx, yy, xy], [ex, ey, g]) = (self.stress, self.strain());
        let across = [xx / KN, xy / KT]; // over a vertical interface: opening in x, sliding in y
        let up = [xy / KT, yy / KN];
        let shift = [0, 1].map(|d| column * across[d] + row * up[d]);
        [
            format!("({ex:e})*x + ({:e})*y + ({:e})", 0.5 * g, shift[0]),
            format!("({:e})*x + ({ey:e})*y + ({:e})", 0.5 * g, shift[1]),
        ]
    }

    fn u(&self, column: f64, row: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([xx, yy, xy], [ex, ey, g]) = (self.stress, self.strain());
        [
            ex * x + 0.5 * g * y + column * xx / KN + row * xy / KT,
            0.5 * g * x + ey * y + column * xy / KT + row * yy / KN,
        ]
    }
}

/// A block: its name, its place in columns and rows of interfaces, the sides of it that are held, its mesh.
struct Block {
    name: &'static str,
    at: [f64; 2],
    constrained: Vec<&'static str>,
    mesh: Mesh,
}

fn flat(x: f64, y: f64) -> [f64; 2] {
    [x, y]
}

fn block(
    name: &'static str,
    at: [f64; 2],
    constrained: &[&'static str],
    [xs, ys]: [Vec<f64>; 2],
    shape: Shape,
) -> Block {
    Block { name, at, constrained: constrained.to_vec(), mesh: rectangle(&xs, &ys, shape, flat) }
}

/// Interfaces by name.
type Interfaces<'a> = &'a [(&'a str, Interface)];

/// The scene of blocks whose outer sides move as the uniform state says.
fn scene(blocks: &[Block], state: &Uniform, interfaces: Interfaces) -> Scene {
    let mut go = step("go");
    for block in blocks {
        let [x, y] = state.formulas(block.at[0], block.at[1]);
        for side in &block.constrained {
            let side = format!("{}.{side}", block.name);
            go = go.displace(&side, "x", x.as_str()).displace(&side, "y", y.as_str());
        }
    }
    joined(blocks, interfaces).step(go)
}

/// The scene of blocks and interfaces before its step.
fn joined(blocks: &[Block], interfaces: Interfaces) -> Scene {
    let scene = Scene::new("stress")
        .subdomains(blocks.iter().map(|block| block.name), "rock")
        .material("rock", E, NU);
    interfaces.iter().fold(scene, |scene, (name, interface)| scene.interface(name, interface.clone()))
}

fn springs() -> Law {
    elastic(KN, KT)
}

/// An interface wherever blocks of two patterns touch.
fn touching(a: &str, b: &str) -> Interface {
    between(a, b).law(springs())
}

/// An interface of two sides.
fn sides(a: &str, b: &str) -> Interface {
    faces(a, b).law(springs())
}

fn meshes(blocks: Vec<Block>) -> Vec<Mesh> {
    blocks.into_iter().map(|block| block.mesh).collect()
}

/// Solves and compares displacement, stress and traction with the uniform state.
fn passes(blocks: Vec<Block>, state: &Uniform, interfaces: Interfaces, case: &str) -> Problem {
    let scene = scene(&blocks, state, interfaces);
    let at: Vec<[f64; 2]> = blocks.iter().map(|block| block.at).collect();
    let problem = scene.bind(meshes(blocks)).unwrap();
    let (states, _) = solve(&problem);
    let size = state.stress.iter().fold(0.0_f64, |size, s| size.max(s.abs()));
    for (b, subdomain) in problem.model.subdomains.iter().enumerate() {
        for (node, &x) in subdomain.mesh.points.iter().enumerate() {
            let exact = state.u(at[b][0], at[b][1], [x[0], x[1]]);
            let u = displacement(&problem, &states[0], b, node);
            (0..2).for_each(|d| {
                close(u[d], exact[d], 1e-10, size / E, &format!("{case}: u of {}", subdomain.name))
            });
        }
        for &[xx, yy, _, xy] in &states[0].snapshot.stresses[b].cells {
            for (got, exact) in [xx, yy, xy].into_iter().zip(state.stress) {
                close(got, exact, 1e-9, size, &format!("{case}: stress of {}", subdomain.name));
            }
        }
    }
    let [xx, yy, xy] = state.stress;
    for (j, interface) in problem.model.interfaces.iter().enumerate() {
        for (point, t) in interface.coupling.points.iter().zip(&states[0].snapshot.tractions[j]) {
            let [[nx, ny, _], [tx, ty, _], _] = point.rotation;
            let exact = [
                nx * nx * xx + ny * ny * yy + 2.0 * nx * ny * xy,
                nx * tx * xx + ny * ty * yy + (nx * ty + ny * tx) * xy,
            ];
            (0..2).for_each(|c| close(t[c], exact[c], 1e-9, size, &format!("{case}: {}", interface.name)));
        }
    }
    problem
}

fn names(problem: &Problem) -> Vec<&str> {
    problem.model.interfaces.iter().map(|interface| interface.name.as_str()).collect()
}

/// Four blocks at the point (1, 1) of a square 2 × 2, with the given numbers of edges in x and y.
fn four(edges: [[usize; 2]; 4], shape: Shape) -> Vec<Block> {
    let places = [
        ("sw", [0.0, 0.0], ["left", "bottom"]),
        ("se", [1.0, 0.0], ["right", "bottom"]),
        ("nw", [0.0, 1.0], ["left", "top"]),
        ("ne", [1.0, 1.0], ["right", "top"]),
    ];
    let make = |((name, at, constrained), [nx, ny]): ((_, [f64; 2], [_; 2]), [usize; 2])| {
        block(name, at, &constrained, [even(at[0], at[0] + 1.0, nx), even(at[1], at[1] + 1.0, ny)], shape)
    };
    places.into_iter().zip(edges).map(make).collect()
}

const MATCHED: [[usize; 2]; 4] = [[4, 4]; 4];
const UNMATCHED: [[usize; 2]; 4] = [[3, 5], [4, 7], [5, 2], [1, 6]];

#[test]
fn b27_a_constant_stress_passes_an_x_junction() {
    let state = Uniform { stress: [-4.0, -9.0, 2.5] };
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
        for edges in [MATCHED, UNMATCHED] {
            let case = format!("{shape:?} {edges:?}");
            let all = [("joints", touching("*", "*"))];
            let problem = passes(four(edges, shape), &state, &all, &case);
            assert_eq!(names(&problem), ["joints~sw~se", "joints~sw~nw", "joints~se~ne", "joints~nw~ne"]);
            for interface in &problem.model.interfaces {
                close(interface.coupling.midplane.length, 1.0, 1e-14, 1.0, &case);
                let shares = &interface.coupling.midplane.segments;
                let sum: f64 = shares.iter().map(|share| share.s[1] - share.s[0]).sum();
                close(sum, 1.0, 1e-14, 1.0, &case);
            }
        }
    }
}

/// Two pairs whose sides share the end point, named by hand and with either label first.
#[test]
fn b27_pairs_that_share_a_node_have_no_null_modes() {
    let state = Uniform { stress: [0.0, -5.0, 1.0] };
    let by_hand = [
        ("south", sides("sw.right", "se.left")),
        ("north", sides("ne.left", "nw.right")),
        ("west", sides("sw.top", "nw.bottom")),
        ("east", sides("ne.bottom", "se.top")),
    ];
    for edges in [MATCHED, UNMATCHED] {
        let problem = passes(four(edges, Shape::Quadrilateral4), &state, &by_hand, &format!("{edges:?}"));
        let corner = |name: &str| {
            let subdomain =
                problem.model.subdomains.iter().position(|subdomain| subdomain.name == name).unwrap();
            let points = &problem.model.subdomains[subdomain].mesh.points;
            problem.model.subdomains[subdomain].first_node
                + points.iter().position(|p| *p == [1.0, 1.0, 0.0]).unwrap()
        };
        let mut copies = ["sw", "se", "nw", "ne"].map(corner);
        copies.sort_unstable();
        assert!(copies.windows(2).all(|pair| pair[0] < pair[1]), "the point has four copies");
    }
}

#[test]
fn b26_a_constant_stress_passes_a_t_junction() {
    // every part is held all around but at the long interface, so that nothing acts between b and c
    let state = Uniform { stress: [-2.0, -8.0, 1.5] };
    for (n, nb, nc) in [(6, 4, 2), (7, 3, 5), (1, 4, 4), (12, 1, 1), (1000, 7, 3)] {
        for meet in [1.75, 2.0, 0.5 + 1e-9] {
            let side = |name, constrained: [&'static str; 3], x, y| {
                block(name, [0.0, f64::from(name != "a")], &constrained, [x, y], Shape::Quadrilateral4)
            };
            let blocks = vec![
                side("a", ["left", "bottom", "right"], even(0.0, 3.0, n), even(-1.0, 0.0, 3)),
                side("b", ["left", "top", "right"], even(0.0, meet, nb), even(0.0, 1.0, 2)),
                side("c", ["left", "top", "right"], even(meet, 3.0, nc), even(0.0, 1.0, 3)),
            ];
            let case = format!("{n} against {nb} and {nc}, meeting at {meet}");
            let all = [("joints", touching("a", "?"))];
            let problem = passes(blocks, &state, &all, &case);
            assert_eq!(names(&problem), ["joints~a~b", "joints~a~c"]);
            let lengths = problem.model.interfaces.iter().map(|interface| interface.coupling.midplane.length);
            close(lengths.sum(), 3.0, 1e-14, 3.0, &case);
        }
    }
}

#[test]
fn b26_uniform_compression_passes_three_interfaces_at_a_t_junction() {
    let state = Uniform { stress: [0.0, -8.0, 0.0] };
    for (n, nb, nc) in [(6, 4, 2), (7, 3, 5), (1, 4, 4)] {
        let outer = |name, constrained: [&'static str; 2], x, y| {
            block(name, [0.0, f64::from(name != "a")], &constrained, [x, y], Shape::Quadrilateral4)
        };
        let blocks = vec![
            outer("a", ["bottom", "left"], even(0.0, 3.0, n), even(-1.0, 0.0, 3)),
            outer("b", ["top", "left"], even(0.0, 1.75, nb), even(0.0, 1.0, 2)),
            outer("c", ["top", "right"], even(1.75, 3.0, nc), even(0.0, 1.0, 3)),
        ];
        let all = [("joints", touching("*", "*"))];
        let problem = passes(blocks, &state, &all, &format!("{n} against {nb} and {nc}"));
        assert_eq!(names(&problem), ["joints~a~b", "joints~a~c", "joints~b~c"]);
    }
}

/// The same curve in two interfaces, each of which takes its part of it.
#[test]
fn b26_one_named_curve_meets_two_blocks() {
    let state = Uniform { stress: [0.0, -8.0, 0.0] };
    let ends = ["left", "right"];
    let blocks = vec![
        block(
            "a",
            [0.0, 0.0],
            &["bottom", "left", "right"],
            [even(0.0, 3.0, 7), even(-1.0, 0.0, 3)],
            Shape::Quadrilateral4,
        ),
        block(
            "b",
            [0.0, 1.0],
            &[ends[0], "top"],
            [even(0.0, 2.0, 3), even(0.0, 1.0, 2)],
            Shape::Quadrilateral4,
        ),
        block(
            "c",
            [0.0, 1.0],
            &[ends[1], "top"],
            [even(2.0, 3.0, 5), even(0.0, 1.0, 3)],
            Shape::Quadrilateral4,
        ),
    ];
    let by_hand = [("ab", sides("a.top", "b.bottom")), ("ac", sides("a.top", "c.bottom"))];
    // σ_xx = σ_xy = 0: nothing acts between b and c, which touch
    let problem = passes(blocks, &state, &by_hand, "by hand");
    let shares = problem.warnings.iter().filter(|w| w.what.contains("is joined"));
    let shares: Vec<String> = shares.map(ToString::to_string).collect();
    assert!(shares.is_empty(), "the two blocks cover the curve: {shares:?}");
}

#[test]
fn one_place_is_never_joined_twice() {
    let state = Uniform { stress: [0.0, -1.0, 0.0] };
    let refused = |interfaces: Interfaces| {
        let blocks = four(UNMATCHED, Shape::Quadrilateral4);
        scene(&blocks, &state, interfaces).bind(meshes(blocks)).unwrap_err().to_string()
    };
    let both = refused(&[("one", touching("*", "*")), ("two", touching("s?", "n?"))]);
    assert!(both.contains("interfaces.two: one~sw~nw and two~sw~nw both join sw at (0, 1)"), "{both}");
    let by_hand = refused(&[("one", sides("sw.top", "nw.bottom")), ("two", sides("nw.bottom", "sw.top"))]);
    assert!(by_hand.contains("interfaces.two: one and two both join sw at"), "{by_hand}");
    let twice = faces(vec!["sw.top", "sw.top"], "nw.bottom").law(springs());
    let same = refused(&[("one", twice)]);
    assert!(same.contains(r#"one.side_a: "sw.top" and "sw.top" hold the same edge, at ("#), "{same}");
}

/// A pair that the scene joins by name is left out of `between`, which then has a law for all the others.
#[test]
fn a_named_interface_takes_its_pair_out_of_between() {
    let state = Uniform { stress: [-1.0, -2.0, 0.5] };
    let interfaces = [("rest", touching("*", "*")), ("west", sides("nw.bottom", "sw.top"))];
    let problem = passes(four(UNMATCHED, Shape::Quadrilateral4), &state, &interfaces, "west by name");
    assert_eq!(names(&problem), ["rest~sw~se", "rest~se~ne", "rest~nw~ne", "west"]);
}

#[test]
fn patterns_choose_pairs_and_sides() {
    let bound = |j: &Interface| {
        let blocks = four(UNMATCHED, Shape::Quadrilateral4);
        let held = ["sw", "se", "nw", "ne"].into_iter().fold(step("go"), |go, name| go.fix(name, "xy"));
        joined(&blocks, &[("j", j.clone())]).step(held).bind(meshes(blocks))
    };
    for (a, b, expected) in [
        ("n*", "s*", vec!["j~nw~sw", "j~ne~se"]),
        ("?w", "?e", vec!["j~sw~se", "j~nw~ne"]),
        ("ne", "*", vec!["j~ne~se", "j~ne~nw"]),
        ("*", "ne", vec!["j~se~ne", "j~nw~ne"]),
    ] {
        let problem = bound(&touching(a, b));
        let problem = problem.unwrap_or_else(|error| panic!("{a}, {b}: {error}"));
        assert_eq!(names(&problem), expected, "{a}, {b}");
    }
    for (j, expected) in [
        (touching("sw", "ne"), "interfaces.j.between: no subdomain like \"sw\" touches another like \"ne\""),
        (
            touching("sw", "nn*"),
            "interfaces.j.between.1: no subdomain is called like \"nn*\"; there is sw, se, nw, ne",
        ),
        (touching("sw", "").with("between", vec!["sw"]), "interfaces.j.between"),
        (touching("sw", "ne").with("side_a", "sw.top"), "interfaces.j: both \"between\" and a side"),
    ] {
        let message = bound(&j).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
    }
}

/// Two bodies that touch along two lines have two interfaces, in the order of their places.
///
/// ```text
///   ┌───────── a ─────────┐
///   ├─────┐  notch  ┌─────┤
///   └─────┴─── b ───┴─────┘   b is a frame open to the top: three rectangles, made one body by their common nodes
/// ```
#[test]
fn a_pair_that_touches_twice_has_two_interfaces() {
    let a = even_block([0.0, 3.0], [1.0, 2.0], [5, 2], Shape::Quadrilateral4);
    let mut b = even_block([0.0, 3.0], [0.0, 1.0], [6, 2], Shape::Quadrilateral4);
    // without the two upper cells in the middle
    let kept: Vec<usize> = (0..b.cells.len()).filter(|c| ![8, 9].contains(c)).collect();
    b.groups.retain(|name, _| name != "top");
    let b = b.part(&kept).unwrap();
    let scene = |probe: &str| {
        Scene::new("stress")
            .subdomains(["a", "b"], "rock")
            .material("rock", 1e4, 0.0)
            .interface("j", touching("*", "*"))
            .step(step("go").fix("a.top", "xy").fix("b.bottom", "xy"))
            .probe("t", probe)
    };
    let problem = scene("j~a~b~2.traction_n@0.5").bind(vec![a.clone(), b.clone()]).unwrap();
    assert_eq!(names(&problem), ["j~a~b~1", "j~a~b~2"]);
    for (interface, start) in problem.model.interfaces.iter().zip([0.0, 2.0]) {
        close(interface.coupling.midplane.length, 1.0, 1e-14, 1.0, &interface.name);
        let xs = interface.coupling.points.iter().map(|p| p.position[0]);
        assert!(xs.into_iter().all(|x| x > start && x < start + 1.0), "{}", interface.name);
    }
    // probes name one of them; the entry alone or a pair that does not touch is refused
    for (probe, expected) in [
        (
            "j.traction_n@0.5",
            "history.t: \"j\" makes an interface of every pair that touches; name one of them",
        ),
        ("j~b~a.traction_n@0.5", "history.t: no interface \"j~b~a\"; there is j~a~b~1, j~a~b~2"),
    ] {
        let message = scene(probe).bind(vec![a.clone(), b.clone()]).unwrap_err();
        assert!(message.to_string().contains(expected), "{message}");
    }
}

#[test]
fn curved_boundaries_touch_and_slots_do_not() {
    use midplane::mesh::touching;
    // two halves of a ring wall, r = 1 between them, 7 edges against 11, over a quarter of a circle
    let ring = |r0: f64, r1: f64, n: usize| {
        let quarter = std::f64::consts::FRAC_PI_2;
        rectangle(&even(r0, r1, 2), &even(0.0, quarter, n), Shape::Quadrilateral4, |r, p| {
            [r * p.cos(), r * p.sin()]
        })
    };
    let every = |_: [usize; 2], _: [&midplane::mesh::Facet; 2]| true;
    for (na, nb) in [(2, 3), (7, 11), (64, 65), (5, 500)] {
        let (inner, outer) = (ring(0.5, 1.0, na), ring(1.0, 1.5, nb));
        let one_way = |pair: [usize; 2], _: [&midplane::mesh::Facet; 2]| pair[0] < pair[1];
        let found = touching(&[&inner, &outer], &one_way).unwrap();
        assert_eq!(found.len(), 1, "{na} against {nb}");
        assert_eq!([found[0].edges[0].len(), found[0].edges[1].len()], [na, nb]);
        let Group::Edges(right) = &inner.groups["right"] else { panic!("no curve") };
        assert!(found[0].edges[0].iter().all(|edge| right.iter().any(|r| r.nodes() == edge.nodes())));
    }
    // a slot as wide as a hundredth of an edge is no interface, nor is a point
    let square = |x: f64, y: f64| even_block([x, x + 1.0], [y, y + 1.0], [4, 4], Shape::Triangle3);
    for (x, y) in [(1.0025, 0.0), (1.0, 1.0), (-1.0, 1.0), (3.0, 0.0)] {
        assert!(touching(&[&square(0.0, 0.0), &square(x, y)], &every).unwrap().is_empty(), "{x}, {y}");
    }
    // far from the origin as well
    for far in [1e6, -1e6] {
        let found = touching(&[&square(far, far), &square(far + 1.0, far)], &every).unwrap();
        assert_eq!(found.len(), 2, "each way once");
    }
}
