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

/// The scene of blocks whose outer sides move as the uniform state says, joined by `interfaces`.
fn scene(blocks: &[Block], state: &Uniform, interfaces: &str) -> String {
    let subdomains: Vec<String> = blocks
        .iter()
        .map(|block| format!(r#""{0}": {{ "msh": "{0}.msh", "material": "rock" }}"#, block.name))
        .collect();
    let mut displace = Vec::new();
    for block in blocks {
        let [x, y] = state.formulas(block.at[0], block.at[1]);
        for side in &block.constrained {
            displace.push(format!(r#""{}.{side}": {{ "x": "{x}", "y": "{y}" }}"#, block.name));
        }
    }
    format!(
        r#"{{ "plane": "stress", "subdomains": {{ {} }},
        "materials": {{ "rock": {{ "young": {E}, "poisson": {NU} }} }},
        "interfaces": {{ {interfaces} }},
        "steps": [ {{ "name": "go", "displace": {{ {} }} }} ] }}"#,
        subdomains.join(", "),
        displace.join(", ")
    )
}

const LAW: &str = r#""law": { "type": "elastic", "normal_stiffness": 3e5, "tangential_stiffness": 7e4 }"#;

/// Solves and compares displacement, stress and traction with the uniform state.
fn passes(blocks: Vec<Block>, state: &Uniform, interfaces: &str, case: &str) -> Problem {
    let text = scene(&blocks, state, interfaces);
    let at: Vec<[f64; 2]> = blocks.iter().map(|block| block.at).collect();
    let problem = bind(&text, blocks.into_iter().map(|block| block.mesh).collect()).unwrap();
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
            let all = format!(r#""joints": {{ "between": ["*", "*"], {LAW} }}"#);
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
    let by_hand = format!(
        r#""south": {{ "side_a": "sw.right", "side_b": "se.left", {LAW} }},
        "north": {{ "side_a": "ne.left", "side_b": "nw.right", {LAW} }},
        "west": {{ "side_a": "sw.top", "side_b": "nw.bottom", {LAW} }},
        "east": {{ "side_a": "ne.bottom", "side_b": "se.top", {LAW} }}"#
    );
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
            let all = format!(r#""joints": {{ "between": ["a", "?"], {LAW} }}"#);
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
        let all = format!(r#""joints": {{ "between": ["*", "*"], {LAW} }}"#);
        let problem = passes(blocks, &state, &all, &format!("{n} against {nb} and {nc}"));
        assert_eq!(names(&problem), ["joints~a~b", "joints~a~c", "joints~b~c"]);
    }
}

/// The same curve in two interfaces, each of which takes its part of it.
#[test]
fn b26_one_named_curve_meets_two_blocks() {
    let state = Uniform { stress: [0.0, -8.0, 0.0] };
    let sides = ["left", "right"];
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
            &[sides[0], "top"],
            [even(0.0, 2.0, 3), even(0.0, 1.0, 2)],
            Shape::Quadrilateral4,
        ),
        block(
            "c",
            [0.0, 1.0],
            &[sides[1], "top"],
            [even(2.0, 3.0, 5), even(0.0, 1.0, 3)],
            Shape::Quadrilateral4,
        ),
    ];
    let by_hand = format!(
        r#""ab": {{ "side_a": "a.top", "side_b": "b.bottom", {LAW} }},
        "ac": {{ "side_a": "a.top", "side_b": "c.bottom", {LAW} }}"#
    );
    // σ_xx = σ_xy = 0: nothing acts between b and c, which touch
    let problem = passes(blocks, &state, &by_hand, "by hand");
    let shares = problem.warnings.iter().filter(|w| w.what.contains("is joined"));
    let shares: Vec<String> = shares.map(ToString::to_string).collect();
    assert!(shares.is_empty(), "the two blocks cover the curve: {shares:?}");
}

#[test]
fn one_place_is_never_joined_twice() {
    let state = Uniform { stress: [0.0, -1.0, 0.0] };
    let refused = |interfaces: String| {
        let blocks = four(UNMATCHED, Shape::Quadrilateral4);
        let text = scene(&blocks, &state, &interfaces);
        bind(&text, blocks.into_iter().map(|block| block.mesh).collect()).unwrap_err().to_string()
    };
    let both = refused(format!(
        r#""one": {{ "between": ["*", "*"], {LAW} }}, "two": {{ "between": ["s?", "n?"], {LAW} }}"#
    ));
    assert!(both.contains("interfaces.two: one~sw~nw and two~sw~nw both join sw at (0, 1)"), "{both}");
    let by_hand = refused(format!(
        r#""one": {{ "side_a": "sw.top", "side_b": "nw.bottom", {LAW} }},
        "two": {{ "side_a": "nw.bottom", "side_b": "sw.top", {LAW} }}"#
    ));
    assert!(by_hand.contains("interfaces.two: one and two both join sw at"), "{by_hand}");
    let same =
        refused(format!(r#""one": {{ "side_a": ["sw.top", "sw.top"], "side_b": "nw.bottom", {LAW} }}"#));
    assert!(same.contains(r#"one.side_a: "sw.top" and "sw.top" hold the same edge, at ("#), "{same}");
}

/// What the scene joins by name is left out of `between`, which then has a law for all the others.
#[test]
fn a_named_interface_takes_its_pair_out_of_between() {
    let state = Uniform { stress: [-1.0, -2.0, 0.5] };
    let interfaces = format!(
        r#""rest": {{ "between": ["*", "*"], {LAW} }},
        "west": {{ "side_a": "nw.bottom", "side_b": "sw.top", {LAW} }}"#
    );
    let problem = passes(four(UNMATCHED, Shape::Quadrilateral4), &state, &interfaces, "west by name");
    assert_eq!(names(&problem), ["rest~sw~se", "rest~se~ne", "rest~nw~ne", "west"]);
}

#[test]
fn patterns_choose_pairs_and_sides() {
    let state = Uniform { stress: [0.0, -1.0, 0.0] };
    let bound = |patterns: &str| {
        let mut blocks = four(UNMATCHED, Shape::Quadrilateral4);
        blocks.iter_mut().for_each(|block| block.constrained.clear());
        let constrained = ["sw", "se", "nw", "ne"].map(|name| format!(r#""{name}": ["x", "y"]"#)).join(", ");
        let text = scene(&blocks, &state, &format!(r#""j": {{ "between": {patterns}, {LAW} }}"#))
            .replace(r#""displace": {  }"#, &format!(r#""fix": {{ {constrained} }}"#));
        bind(&text, blocks.into_iter().map(|block| block.mesh).collect())
    };
    for (patterns, expected) in [
        (r#"["n*", "s*"]"#, vec!["j~nw~sw", "j~ne~se"]),
        (r#"["?w", "?e"]"#, vec!["j~sw~se", "j~nw~ne"]),
        (r#"["ne", "*"]"#, vec!["j~ne~se", "j~ne~nw"]),
        (r#"["*", "ne"]"#, vec!["j~se~ne", "j~nw~ne"]),
    ] {
        let problem = bound(patterns);
        let problem = problem.unwrap_or_else(|error| panic!("{patterns}: {error}"));
        assert_eq!(names(&problem), expected, "{patterns}");
    }
    for (patterns, expected) in [
        (r#"["sw", "ne"]"#, "interfaces.j.between: no subdomain like \"sw\" touches another like \"ne\""),
        (
            r#"["sw", "nn*"]"#,
            "interfaces.j.between.1: no subdomain is called like \"nn*\"; there is sw, se, nw, ne",
        ),
        (r#"["sw"]"#, "interfaces.j.between"),
        (r#"["sw", "ne"], "side_a": "sw.top""#, "interfaces.j: both \"between\" and a side"),
    ] {
        let message = bound(patterns).unwrap_err().to_string();
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
    let a = rectangle(&even(0.0, 3.0, 5), &even(1.0, 2.0, 2), Shape::Quadrilateral4, flat);
    let mut b = rectangle(&even(0.0, 3.0, 6), &even(0.0, 1.0, 2), Shape::Quadrilateral4, flat);
    // without the two upper cells in the middle
    let kept: Vec<usize> = (0..b.cells.len()).filter(|c| ![8, 9].contains(c)).collect();
    b.groups.retain(|name, _| name != "top");
    let b = b.part(&kept).unwrap();
    let text = format!(
        r#"{{ "plane": "stress", "subdomains": {{ "a": {{ "msh": "a", "material": "rock" }}, "b": {{ "msh": "b", "material": "rock" }} }},
        "materials": {{ "rock": {{ "young": 1e4, "poisson": 0 }} }},
        "interfaces": {{ "j": {{ "between": ["*", "*"], {LAW} }} }},
        "steps": [ {{ "name": "go", "fix": {{ "a.top": ["x", "y"], "b.bottom": ["x", "y"] }} }} ],
        "output": {{ "history": {{ "t": "j~a~b~2.traction_n@0.5" }} }} }}"#
    );
    let problem = bind(&text, vec![a.clone(), b.clone()]).unwrap();
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
        let message =
            bind(&text.replace("j~a~b~2.traction_n@0.5", probe), vec![a.clone(), b.clone()]).unwrap_err();
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
    let square =
        |x: f64, y: f64| rectangle(&even(x, x + 1.0, 4), &even(y, y + 1.0, 4), Shape::Triangle3, flat);
    for (x, y) in [(1.0025, 0.0), (1.0, 1.0), (-1.0, 1.0), (3.0, 0.0)] {
        assert!(touching(&[&square(0.0, 0.0), &square(x, y)], &every).unwrap().is_empty(), "{x}, {y}");
    }
    // far from the origin as well
    for far in [1e6, -1e6] {
        let found = touching(&[&square(far, far), &square(far + 1.0, far)], &every).unwrap();
        assert_eq!(found.len(), 2, "each way once");
    }
}
