//! Claim: a fracture drawn inside a body is an interface once the mesh is opened along it.
//!
//! ```text
//!   ┌──────────────┐     tips inside the body stay closed, crossings and T's make branches, what reaches the boundary opens it;
//!   │   ╱    ╲     │     stiff springs give the uncracked body back, and a line through the whole body what two bodies give
//!   │  ╱  ────╳──  │
//!   └──────────────┘
//! ```

use crate::common::*;
use midplane::mesh::{Facet, Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;

const SHAPES: [Shape; 4] = [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8];

/// A square with a curve `crack` of the edges inside whose ends both fit.
fn square(shape: Shape, n: usize, on: impl Fn([f64; 2]) -> bool) -> Mesh {
    let mut mesh = even_block([0.0, 1.0], [0.0, 1.0], [n, n], shape);
    let mut edges: Vec<Facet> = Vec::new();
    for cell in 0..mesh.cells.len() {
        let (nodes, shape) = (mesh.cells.nodes(cell), mesh.cells.shapes[cell]);
        for e in 0..shape.corners() {
            let [start, end, mid] = shape.edge(e).map(|i| nodes.get(i).copied().unwrap_or(nodes[0]));
            let fits = [start, end].iter().all(|&node| on([mesh.points[node][0], mesh.points[node][1]]));
            let inner = [start, end].map(|node| mesh.points[node]);
            let middle = [0, 1].map(|d| 0.5 * (inner[0][d] + inner[1][d]));
            let known = edges.iter().any(|edge| edge.nodes()[..2] == [end, start]);
            if fits && on(middle) && start != end && !known {
                let all = [start, end, mid];
                edges.push(Facet::edge(&all[..if shape.is_quadratic() { 3 } else { 2 }], cell, false));
            }
        }
    }
    mesh.groups.insert("crack".into(), Group::Edges(edges));
    mesh
}

fn springs() -> Law {
    elastic(2e5, 7e4)
}

/// One body, held at its bottom.
fn rock() -> Scene {
    Scene::new("strain").subdomain("rock", "rock").material("rock", 1e4, 0.3)
}

/// It is pulled at a curve.
fn pulled(curve: &str) -> Step {
    held().traction(curve, "0.5+x", "2-3*x")
}

fn held() -> Step {
    step("go").fix("rock.bottom", "xy")
}

/// The body with a crack.
fn cracked(law: Law) -> Scene {
    rock().interface("crack", within("rock.crack").law(law))
}

fn opened(law: Law, mesh: Mesh) -> Problem {
    cracked(law).step(pulled("rock.top")).bind(vec![mesh]).unwrap()
}

/// Displacements by place, for nodes that are there once.
fn moved(problem: &Problem) -> Vec<([f64; 2], [f64; 2])> {
    let (states, _) = solve(problem);
    let mut all = Vec::new();
    for (b, subdomain) in problem.model.subdomains.iter().enumerate() {
        for (node, x) in subdomain.mesh.points.iter().enumerate() {
            all.push(([x[0], x[1]], displacement(problem, &states[0], b, node)));
        }
    }
    all.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap().then(a.1.partial_cmp(&b.1).unwrap()));
    all
}

#[test]
fn stiff_springs_give_the_uncracked_body_back() {
    let cross = |[x, y]: [f64; 2]| {
        (y - 0.5).abs() < 1e-9 && (0.2..0.9).contains(&x)
            || (x - 0.6).abs() < 1e-9 && (0.25..0.95).contains(&y)
    };
    for shape in SHAPES {
        let whole = even_block([0.0, 1.0], [0.0, 1.0], [10, 10], shape);
        let uncracked = moved(&rock().step(pulled("rock.top")).bind(vec![whole]).unwrap());
        let problem = opened(elastic(1e12, 1e12), square(shape, 10, cross));
        assert_eq!(problem.model.interfaces.len(), 4, "four branches");
        let largest = uncracked.iter().map(|(_, u)| u[0].hypot(u[1])).fold(0.0, f64::max);
        for (x, u) in moved(&problem) {
            let near = uncracked.iter().find(|(y, _)| (x[0] - y[0]).hypot(x[1] - y[1]) < 1e-9).unwrap();
            (0..2).for_each(|d| close(u[d], near.1[d], 1e-6, largest, &format!("{shape:?} {x:?}")));
        }
    }
}

#[test]
fn a_line_through_the_body_is_the_same_as_two_bodies() {
    for shape in SHAPES {
        let mut cut = square(shape, 8, |[_, y]| (y - 0.5).abs() < 1e-9);
        // the halves of the two bodies as they stand
        let half = |y: [f64; 2]| even_block([0.0, 1.0], [y[0], y[1]], [8, 4], shape);
        cut.groups.sort_keys();
        let one = opened(springs(), cut);
        // triangles: a linear grid between two bodies, unless it is asked for
        let joint = faces("rock.top", "upper.bottom").law(springs());
        let joint = joint.with("grid", if shape.is_quadratic() { "quadratic" } else { "auto" });
        let two = rock().subdomain("upper", "rock").interface("crack", joint).step(pulled("upper.top"));
        let two = two.bind(vec![half([0.0, 0.5]), half([0.5, 1.0])]).unwrap();
        assert_eq!(one.model.nodes(), two.model.nodes(), "{shape:?}");
        let [a, b] = [&one, &two].map(moved);
        let largest = b.iter().map(|(_, u)| u[0].hypot(u[1])).fold(0.0, f64::max);
        for ((x, u), (y, v)) in a.iter().zip(&b) {
            assert!((x[0] - y[0]).hypot(x[1] - y[1]) < 1e-12);
            (0..2).for_each(|d| close(u[d], v[d], 1e-12, largest, &format!("{shape:?} {x:?}")));
        }
        let tractions = |problem: &Problem| solve(problem).0.remove(0).snapshot.tractions.remove(0);
        for (t, exact) in tractions(&one).iter().zip(&tractions(&two)) {
            (0..2).for_each(|d| close(t[d], exact[d], 1e-12, 3.0, "traction"));
        }
    }
}

#[test]
fn ends_crossings_and_the_boundary_open_as_they_should() {
    let count = |on: &dyn Fn([f64; 2]) -> bool| {
        let problem = opened(springs(), square(Shape::Quadrilateral8, 10, on));
        let extra = problem.model.nodes() - (11 * 11 + 2 * 10 * 11);
        let branches: Vec<usize> =
            problem.model.interfaces.iter().map(|interface| interface.coupling.facets(0)).collect();
        (extra, branches)
    };
    let h = |y: f64| (y - 0.5).abs() < 1e-9;
    // 4 edges inside: 3 inner ends and 4 mid-nodes are doubled
    assert_eq!(count(&|[x, y]| h(y) && (0.29..0.71).contains(&x)), (7, vec![4]));
    // from the boundary: its node too
    assert_eq!(count(&|[x, y]| h(y) && x < 0.41), (8, vec![4]));
    // a crossing becomes four
    let v = |x: f64| (x - 0.5).abs() < 1e-9;
    let cross = count(&|[x, y]| h(y) && (0.29..0.71).contains(&x) || v(x) && (0.29..0.71).contains(&y));
    assert_eq!(cross, (2 * 4 + 4 + 3, vec![2, 2, 2, 2]));
    // a T becomes three
    let t = count(&|[x, y]| h(y) && (0.29..0.71).contains(&x) || v(x) && (0.49..0.71).contains(&y));
    assert_eq!(t, (2 + 1 + 4 + 2 + 2, vec![2, 2, 2]));
}

#[test]
fn what_cannot_be_opened_is_refused() {
    let mesh = || square(Shape::Quadrilateral4, 4, |[_, y]| (y - 0.5).abs() < 1e-9);
    for (crack, expected) in [
        (within("rock.left"), "\"rock.left\" lies on the boundary of its body at (0, "),
        (within(vec!["rock.crack", "rock.crack"]), "hold the same edge"),
        (within("rock"), "\"rock\" is a whole body"),
        (within("rock.crack").with("side_a", "rock.left"), "both \"within\" and a side"),
        (faces("rock.crack", "rock.crack"), "\"within\" opens a curve inside a body"),
        (within("rock.crak"), "Did you mean"),
    ] {
        let scene = rock().interface("crack", crack.law(springs())).step(pulled("rock.top"));
        let message = scene.bind(vec![mesh()]).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
    }
}

/// Crack of half-length b = 1 m at ψ = 20° to a pressure of 100 MPa, friction angle 30°, in a plate of 60 b:
///
/// ```text
/// t_n = −σ sin²ψ,   slip = 4 (1 − ν²)/E σ sinψ (cosψ − sinψ tanθ) √(b² − s²)
/// ```
#[test]
fn an_inclined_crack_slips_as_in_theory() {
    let geo = "psi = 20 * Pi / 180; L = 30;
        Point(1) = {-L, -L, 0, 6}; Point(2) = {L, -L, 0, 6}; Point(3) = {L, L, 0, 6}; Point(4) = {-L, L, 0, 6};
        Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
        Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
        Point(5) = {-Sin(psi), -Cos(psi), 0, 0.006}; Point(6) = {Sin(psi), Cos(psi), 0, 0.006};
        Line(5) = {5, 6}; Curve{5} In Surface{1};
        Physical Curve(\"crack\") = {5}; Physical Curve(\"bottom\") = {1}; Physical Curve(\"top\") = {3};
        Physical Point(\"sw\") = {1}; Physical Surface(\"rock\") = {1};
        Mesh.ElementOrder = 2;";
    let (e, nu, sigma, psi, theta) = (25e3, 0.25, 100.0, 20f64.to_radians(), 30f64.to_radians());
    let scene = Scene::new("strain")
        .subdomain("rock", "rock")
        .material("rock", e, nu)
        .interface("crack", within("rock.crack").law(coulomb(1e9, 1e9, theta.tan())))
        .step(step("go").fix("rock.bottom", "y").fix("rock.sw", "x").pressure("rock.top", sigma));
    let problem = scene.bind(vec![meshed(geo)]).unwrap();
    let (states, _) = solve(&problem);
    let normal = -sigma * psi.sin().powi(2);
    let slip = 4.0 * (1.0 - nu * nu) / e * sigma * psi.sin() * (psi.cos() - psi.sin() * theta.tan());
    close(slip, 3.81e-3, 1e-3, 3.81e-3, "largest slip");
    let snapshot = &states[0].snapshot;
    let (mut worst, mut count) = ([0.0_f64; 2], 0);
    for (i, point) in problem.model.interfaces[0].coupling.points.iter().enumerate() {
        let s = point.position[0] * psi.sin() + point.position[1] * psi.cos();
        if s.abs() > 0.8 {
            continue;
        }
        count += 1;
        let exact = slip * (1.0 - s * s).sqrt();
        worst[0] = worst[0].max((snapshot.tractions[0][i].x / normal - 1.0).abs());
        worst[1] = worst[1].max((snapshot.jumps[0][i].y.abs() / exact - 1.0).abs());
    }
    println!("{count} points up to 0.8 b: t_n off by {:.1e}, slip by {:.1e}", worst[0], worst[1]);
    assert!(count > 300 && worst.iter().all(|off| *off < 0.01), "{worst:?}");
}

/// Thirty random fractures in a square, with crossings, T's and some that reach the boundary, drawn with OpenCASCADE.
#[test]
fn a_network_of_thirty_fractures_slides() {
    let mut seed = 7_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut geo = "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 10, 10};\n".to_string();
    for i in 0..30 {
        let (x, y, angle, half) =
            (10.0 * random(), 10.0 * random(), std::f64::consts::PI * random(), 0.6 + random());
        let [dx, dy] = [half * angle.cos(), half * angle.sin()];
        let inside = |x: f64| x.clamp(0.0, 10.0);
        geo += &format!(
            "Point({}) = {{{}, {}, 0}}; Point({}) = {{{}, {}, 0}}; Line({}) = {{{}, {}}};\n",
            100 + 2 * i,
            inside(x - dx),
            inside(y - dy),
            101 + 2 * i,
            inside(x + dx),
            inside(y + dy),
            100 + i,
            100 + 2 * i,
            101 + 2 * i
        );
    }
    geo += "BooleanFragments{ Surface{1}; Delete; }{ Curve{100:129}; Delete; }
        outer() = Abs(CombinedBoundary{ Surface{:}; }); all() = Curve{:}; all() -= outer();
        Physical Curve(\"crack\") = all();
        bottom() = Curve In BoundingBox{-0.01, -0.01, -1, 10.01, 0.01, 1}; Physical Curve(\"bottom\") = bottom();
        top() = Curve In BoundingBox{-0.01, 9.99, -1, 10.01, 10.01, 1}; Physical Curve(\"top\") = top();
        Physical Surface(\"rock\") = Surface{:};
        Mesh.MeshSizeMax = 0.25;";
    let mesh = meshed(&geo);
    let go = held().increments(5).traction("rock.top", -2, -10);
    let problem = cracked(coulomb(1e6, 1e6, 0.4)).step(go).bind(vec![mesh]).unwrap();
    let (states, totals) = solve(&problem);
    let last = &states[4].snapshot;
    let (mut slides, mut open) = (0, 0);
    for tractions in &last.tractions {
        for t in tractions {
            assert!(t.y.abs() <= -0.4 * t.x + 1e-9, "{t:?}");
            slides += usize::from(t.x < 0.0 && t.y.abs() >= -0.4 * t.x * (1.0 - 1e-9));
            open += usize::from(t.x == 0.0);
        }
    }
    println!(
        "{} branches, {} nodes, {slides} points slide, {open} open; {} iterations, balance {:.1e}",
        problem.model.interfaces.len(),
        problem.model.nodes(),
        totals.iterations,
        totals.energy_balance
    );
    assert!(problem.model.interfaces.len() > 40 && slides > 50 && totals.energy_balance < 1e-2);
    assert!(totals.imbalance < 1e-8, "{}", totals.imbalance);
}

#[test]
fn a_fracture_of_one_edge_inside_is_refused_and_a_point_on_one_shares_its_force() {
    for shape in [Shape::Triangle3, Shape::Quadrilateral8] {
        let one = square(shape, 4, |[x, y]| (y - 0.5).abs() < 1e-9 && (0.2..0.8).contains(&x) && x < 0.6);
        let scene = cracked(springs()).step(pulled("rock.top"));
        let message = scene.bind(vec![one]).unwrap_err().to_string();
        assert!(message.contains("is one edge long and ends inside its body"), "{message}");
    }
    // a force of 6 at the mouth of a fracture, which is two nodes then: reactions carry 6
    let mut mesh = square(Shape::Quadrilateral4, 4, |[x, y]| (y - 0.5).abs() < 1e-9 && x < 0.6);
    let mouth = mesh.points.iter().position(|x| x[0] == 0.0 && (x[1] - 0.5).abs() < 1e-9).unwrap();
    mesh.groups.insert("mouth".into(), Group::Points(vec![mouth]));
    let scene = cracked(springs()).step(held().force("rock.mouth", 6, 0));
    let problem = scene.bind(vec![mesh]).unwrap();
    let (states, _) = solve(&problem);
    let reaction: f64 = states[0].reactions.iter().step_by(2).sum();
    close(reaction, -6.0, 1e-12, 6.0, "reaction");
    // s would run along one face and back along the other
    let pulled = held().traction("rock.crack", "s", "2-3*x");
    let mesh = square(Shape::Quadrilateral4, 4, |[x, y]| (y - 0.5).abs() < 1e-9 && x < 0.6);
    let message = cracked(springs()).step(pulled).bind(vec![mesh]);
    assert!(message.unwrap_err().to_string().contains("its two faces meet at (0, 0.5)"));
}

/// Claim: two fractures that meet where the body has a corner of its boundary are two interfaces, though nothing else meets there.
#[test]
fn fractures_that_meet_at_a_corner_of_a_hole_are_two() {
    // a hole 0.4 < x, y < 0.6; lines from its corner (0.4, 0.4) to the left and down
    let mesh = |fractures: &str| {
        meshed(&format!(
            "Point(1) = {{0, 0, 0, 0.2}}; Point(2) = {{1, 0, 0, 0.2}}; Point(3) = {{1, 1, 0, 0.2}}; Point(4) = {{0, 1, 0, 0.2}};
            Point(5) = {{0.4, 0.4, 0, 0.1}}; Point(6) = {{0.6, 0.4, 0, 0.1}}; Point(7) = {{0.6, 0.6, 0, 0.1}};
            Point(8) = {{0.4, 0.6, 0, 0.1}}; Point(9) = {{0, 0.4, 0, 0.1}}; Point(10) = {{0.4, 0, 0, 0.1}};
            Line(1) = {{1, 10}}; Line(2) = {{10, 2}}; Line(3) = {{2, 3}}; Line(4) = {{3, 4}}; Line(5) = {{4, 9}}; Line(6) = {{9, 1}};
            Line(7) = {{5, 6}}; Line(8) = {{6, 7}}; Line(9) = {{7, 8}}; Line(10) = {{8, 5}}; Line(11) = {{9, 5}}; Line(12) = {{10, 5}};
            Curve Loop(1) = {{1:6}}; Curve Loop(2) = {{7:10}}; Plane Surface(1) = {{1, 2}}; Curve{{{fractures}}} In Surface{{1}};
            Physical Curve(\"crack\") = {{{fractures}}}; Physical Curve(\"bottom\") = {{1, 2}}; Physical Curve(\"top\") = {{4}};
            Physical Surface(\"body\") = {{1}};"
        ))
    };
    let problem = opened(springs(), mesh("11, 12"));
    let lengths: Vec<f64> =
        problem.model.interfaces.iter().map(|interface| interface.coupling.midplane.length).collect();
    assert_eq!(lengths.len(), 2, "{lengths:?}");
    lengths.iter().for_each(|length| close(*length, 0.4, 1e-12, 0.4, "length"));
    // the body is cut up all the way
    let nodes = opened(springs(), mesh("11")).model.nodes();
    assert!(problem.model.nodes() > nodes);
}
