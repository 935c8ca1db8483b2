//! Claim: steady flow along joints is exact for the apertures that their grids represent, whatever they are; pipes share it as
//! their cubes say; opened by its own pressure it is found with the jumps, quadratically and to rounding.
//!
//! ```text
//! w = a + b s:     R(s) = (1/a² − 1/(a + b s)²)/(2 b)     p = p₀ + (p₁ − p₀) R(s)/R(L)     q = (p₀ − p₁)/(12 μ R(L))
//! T of pipes:      g = w³/(12 μ L)      p = Σ g p/Σ g      Σ q = 0
//! own pressure:    blocks on springs K under P: K r = p − P, q = −(w₀ + r)³/(12 μ) dp/ds, so (w₀ + r)⁴ is linear in s
//! ```

use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::{Value, json};

const MU: f64 = 1e-3;

/// The scene of parts of one rock.
fn scene(parts: &[(&str, Mesh)]) -> Scene {
    Scene::new("strain").subdomains(parts.iter().map(|(name, _)| *name), "rock").material("rock", 1e4, 0.0)
}

/// Two blocks with a joint of 2 m between them.
fn jointed(parts: &[(&str, Mesh)]) -> Scene {
    scene(parts).interface("joint", faces("a.top", "b.bottom").law(soft()))
}

fn bound(scene: Scene, parts: Vec<(&str, Mesh)>) -> Problem {
    scene.bind(parts.into_iter().map(|(_, mesh)| mesh).collect()).unwrap()
}

fn block(x: [f64; 2], y: [f64; 2], n: usize, shape: Shape, degrees: f64) -> Mesh {
    let turned = rotation(degrees);
    rectangle(&graded(x[0], x[1], n, 3.0), &even(y[0], y[1], 2), shape, turned)
}

/// Two blocks of 2 m × 0.5 m, at an angle.
fn pair(shape: Shape, degrees: f64) -> Vec<(&'static str, Mesh)> {
    vec![
        ("a", block([0.0, 2.0], [-0.5, 0.0], 5, shape, degrees)),
        ("b", block([0.0, 2.0], [0.0, 0.5], 8, shape, degrees)),
    ]
}

fn soft() -> Law {
    elastic(1, 1)
}

/// Two blocks whose jump is given throughout: r_n = a − w₀ + b s along the joint of 2 m.
fn wedge(
    shape: Shape,
    coupling: Option<(&str, &str)>,
    degrees: f64,
    [w0, start, slope]: [f64; 3],
    water: impl Fn(Flow) -> Flow,
) -> (Problem, ModelState) {
    let (sin, cos) = f64::to_radians(degrees).sin_cos();
    let along = format!("(({cos})*x + ({sin})*y)");
    let opening = format!("({} + ({slope})*{along})", start - w0);
    let open = step("open")
        .fix("a", "xy")
        .displace("b", "x", format!("-({sin})*{opening}"))
        .displace("b", "y", format!("({cos})*{opening}"))
        .pressure("joint", water(flow(w0, MU)));
    let joint = faces("a.top", "b.bottom").law(soft());
    let joint = coupling.into_iter().fold(joint, |joint, (key, value)| joint.with(key, value));
    let parts = pair(shape, degrees);
    let scene = scene(&parts).interface("joint", joint).step(open).probes([
        ("q0", "joint.rate@0"),
        ("q1", "joint.rate@1"),
        ("d", "joint.drain_rate"),
        ("w", "joint.hydraulic_aperture@0.5"),
    ]);
    let problem = bound(scene, parts);
    let state = solve(&problem).0.pop().unwrap();
    (problem, state)
}

/// R(s) of a wedge; of parallel plates its limit.
fn resistance(a: f64, b: f64, s: f64) -> f64 {
    if b == 0.0 { s / a.powi(3) } else { (1.0 / (a * a) - 1.0 / (a + b * s).powi(2)) / (2.0 * b) }
}

#[test]
fn a_wedge_is_exact_on_every_grid() {
    let (p0, p1) = (3.0, 0.5);
    let flow = |water: Flow| water.ends(p0, p1);
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Quadrilateral8] {
        for coupling in [None, Some(("coupling", "pointwise")), Some(("quadrature", "lobatto"))] {
            for (degrees, opening) in [
                (0.0, [1e-3, 1e-3, 2e-3]),
                (30.0, [1e-4, 6e-3, -2e-3]),
                (-70.0, [1e-3, 1e-3, 0.0]),
                (0.0, [1e-6, 1e-6, 1e-2]),
            ] {
                let (problem, state) = wedge(shape, coupling, degrees, opening, flow);
                let [_, a, b] = opening;
                let whole = resistance(a, b, 2.0);
                let what = format!("{shape:?} {coupling:?} {degrees} {opening:?}");
                let points = &problem.model.interfaces[0].coupling.points;
                for (point, p) in points.iter().zip(&state.snapshot.water.pressures[0]) {
                    let exact = p0 + (p1 - p0) * resistance(a, b, point.s) / whole;
                    close(*p, exact, 1e-8, p0, &format!("{what}: p at {}", point.s));
                }
                let q = (p0 - p1) / (12.0 * MU * whole);
                let probes = state.probes(&problem);
                close(probes[0], q, 1e-8, q, &format!("{what}: rate@0"));
                close(probes[1], q, 1e-8, q, "rate@1");
                close(probes[2], 0.0, 1e-8, q, "drains");
                close(probes[3], a + b, 1e-8, a + b, "aperture in the middle");
                let rates = &state.snapshot.water.rates[0];
                rates.iter().for_each(|rate| close(*rate, q, 1e-8, q, "rate"));
            }
        }
    }
}

#[test]
fn a_drain_takes_what_comes_from_both_sides_and_a_wall_holds_it() {
    let flow = |water: Flow| water.ends(3, "wall").drain(0.35, "0.2 + s");
    let (a, b) = (1e-3, 2e-3);
    let (problem, state) = wedge(Shape::Quadrilateral4, None, 20.0, [a, a, b], flow);
    let whole = resistance(a, b, 0.7);
    let q = (3.0 - 0.55) / (12.0 * MU * whole);
    let probes = state.probes(&problem);
    for (value, exact) in [(probes[0], q), (probes[1], 0.0), (probes[2], q)] {
        close(value, exact, 1e-8, q, "rates");
    }
    for (point, p) in
        problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.water.pressures[0])
    {
        let exact = if point.s < 0.7 { 3.0 - 2.45 * resistance(a, b, point.s) / whole } else { 0.55 };
        close(*p, exact, 1e-8, 3.0, &format!("p at {}", point.s));
    }
}

/// Three blocks whose joints meet in a T, opened by given amounts.
#[test]
fn joints_that_meet_share_the_flow_as_pipes_do() {
    let (left, right, up) = (1e-3, 2e-3, 1.5e-3);
    let null = || Value::Null;
    let flow = || flow(1e-9, MU);
    for named in [true, false] {
        let first = flow().ends(5, if named { "joined".into() } else { null() });
        // the top block rises by 1e-3 over the left one and by 2e-3 over the right one, which goes down and aside
        let open = step("open")
            .increments(2)
            .displace("left", "x", 0)
            .displace("left", "y", 0)
            .displace("right", "x", up - 1e-9)
            .displace("right", "y", left - right)
            .displace("top", "x", 0)
            .displace("top", "y", left)
            .pressure("j~left~top", first)
            .pressure("j~right~top", flow().ends(null(), 1))
            .pressure("j~left~right", flow().ends(null(), -2));
        let parts = vec![
            ("left", block([-1.0, 0.0], [-1.0, 0.0], 4, Shape::Quadrilateral4, 0.0)),
            ("right", block([0.0, 1.5], [-1.0, 0.0], 5, Shape::Quadrilateral4, 0.0)),
            ("top", block([-1.0, 1.5], [0.0, 1.0], 7, Shape::Quadrilateral4, 0.0)),
        ];
        let scene = scene(&parts).interface("j", between("*", "*").law(soft())).step(open).probes([
            ("a0", "j~left~top.rate@0"),
            ("a1", "j~left~top.rate@1"),
            ("b0", "j~right~top.rate@0"),
            ("b1", "j~right~top.rate@1"),
            ("c0", "j~left~right.rate@0"),
            ("c1", "j~left~right.rate@1"),
        ]);
        let problem = bound(scene, parts);
        let (states, _) = solve(&problem);
        let g = |w: f64, length: f64| w.powi(3) / (12.0 * MU * length);
        for (state, part) in states.iter().zip([0.5, 1.0]) {
            let w = |full: f64| 1e-9 + part * full;
            let pipes = [(g(w(left), 1.0), 5.0), (g(w(right), 1.5), 1.0), (g(w(up - 1e-9), 1.0), -2.0)];
            let middle = pipes.iter().map(|(g, p)| g * p * part).sum::<f64>()
                / pipes.iter().map(|(g, _)| g).sum::<f64>();
            let rates = state.probes(&problem);
            let inwards = pipes.map(|(g, p)| g * (p * part - middle));
            // s of every interface runs where its own chain A does: the signs follow from which end is given
            let largest = inwards.iter().map(|q| q.abs()).fold(0.0, f64::max);
            let towards = [rates[1], -rates[2], -rates[4]];
            for (k, (rate, exact)) in towards.iter().zip(inwards).enumerate() {
                close(*rate, exact, 1e-8, largest, &format!("pipe {k} of {rates:?}"));
            }
            close(towards.iter().sum::<f64>(), 0.0, 1e-12, largest, "sum at the junction");
            close(rates[0], rates[1], 1e-12, largest, "one rate along a pipe");
        }
    }
}

/// Claim: rigid blocks on a bed of springs: (w₀ + r)⁴ falls linearly from end to end.
#[test]
fn water_opens_its_own_way() {
    let (k, w0, p0, p1, pressed) = (10.0, 1e-2, 3.0, 1.8, 0.2);
    // bodies of which every column moves by itself: stiff in y, nothing in x
    let mut errors = Vec::new();
    for n in [6, 12, 24] {
        let water = step("water")
            .increments(1)
            .fix("a", "xy")
            .fix("b", "x")
            .pressure("b.bottom", -pressed)
            .pressure("joint", flow(w0, MU).ends(p0, p1));
        // a strip so thin that it bends with the joint
        let part =
            |y: [f64; 2], n: usize| even_block([0.0, 2.0], [y[0], y[1]], [n, 1], Shape::Quadrilateral4);
        let parts = vec![("a", part([-1e-9, 0.0], n)), ("b", part([0.0, 1e-9], n))];
        let scene = scene(&parts)
            .interface("joint", faces("a.top", "b.bottom").law(elastic(k, k)))
            .solution("path_tolerance", 1)
            .step(water)
            .probes([("q0", "joint.rate@0"), ("q1", "joint.rate@1")]);
        let problem = bound(scene, parts);
        let (states, _) = solve(&problem);
        let state = &states[0];
        assert!(*state.residuals.last().unwrap() < 1e-12, "{:?}", state.residuals);
        // later passes take up what rounding has left of so thin a strip
        let first = state.residuals.iter().position(|residual| *residual < 1e-12).unwrap();
        let residuals = &state.residuals[..=first];
        assert!((4..=8).contains(&first), "{residuals:?}");
        for pair in residuals.windows(2).filter(|pair| pair[0] < 2e-2 && pair[1] > 1e-14) {
            assert!(pair[1] < 200.0 * pair[0] * pair[0], "{residuals:?}");
        }
        let probes = state.probes(&problem);
        close(probes[0], probes[1], 1e-12, probes[0], "mass");
        // K r = p − pressed
        let w = |p: f64| w0 + (p - pressed) / k;
        let [start, end] = [w(p0).powi(4), w(p1).powi(4)];
        let q = k * (start - end) / (4.0 * 12.0 * MU * 2.0);
        let mut error = (probes[0] / q - 1.0).abs();
        for (point, jump) in problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.jumps[0])
        {
            let exact = (start + (end - start) * point.s / 2.0).powf(0.25) - w0;
            error = error.max((jump[0] / exact - 1.0).abs());
        }
        errors.push(error);
    }
    assert!(errors[2] < 2e-3 && errors[0] > 3.0 * errors[1] && errors[1] > 3.0 * errors[2], "{errors:?}");
}

/// Claim: flow goes over to other pressures at its ends, from an imposed pressure and to one, as loads do.
#[test]
fn flow_ramps_as_loads_do() {
    let flow = |start: Value, end: f64| flow(1e-3, MU).ends(start, end);
    let held = |name: &str, n: usize| step(name).increments(n).fix("a", "xy").fix("b", "xy");
    let steps = [
        held("imposed", 1).pressure("joint", 1),
        held("flow", 2).pressure("joint", flow(4.into(), 0.0)),
        held("more", 2).pressure("joint", flow(8.into(), 2.0)),
        held("kept", 1),
        held("formula", 2).pressure("joint", flow("8 + 2*load_factor".into(), 2.0)),
        held("off", 2).pressure("joint", 0),
    ];
    let parts = pair(Shape::Quadrilateral4, 0.0);
    let scene = jointed(&parts).steps(steps).probes([("u", "joint.uplift"), ("q", "joint.rate@0")]);
    let problem = bound(scene, parts);
    let (states, _) = solve(&problem);
    // uplift = mean of the ends × 2, q = (p₀ − p₁) g
    let g = 1e-9 / (12.0 * MU * 2.0);
    let expected = [
        (2.0, 0.0),
        (3.0, 2.0),
        (4.0, 4.0),
        (7.0, 5.0),
        (10.0, 6.0),
        (10.0, 6.0),
        (11.0, 7.0),
        (12.0, 8.0),
        (6.0, 4.0),
        (0.0, 0.0),
    ];
    assert_eq!(states.len(), expected.len());
    for (row, (state, (uplift, drop))) in states.iter().zip(expected).enumerate() {
        let probes = state.probes(&problem);
        close(probes[0], uplift, 1e-12, 1.0, &format!("uplift of row {row}"));
        close(probes[1], drop * g, 1e-12, g, &format!("rate of row {row}"));
    }
}

/// Claim: a joint that ends on the middle of another is joined with it there.
#[test]
fn a_joint_that_ends_on_another_feeds_it() {
    let (over, aside) = (1e-3, 1.5e-3);
    let flow = || flow(1e-9, MU);
    let open = step("open")
        .displace("left", "x", 0)
        .displace("left", "y", 0)
        .displace("right", "x", aside - 1e-9)
        .displace("right", "y", 0)
        .displace("top", "x", 0)
        .displace("top", "y", over - 1e-9)
        .pressure("over", flow().ends(5, 1))
        .pressure("between", flow().ends(Value::Null, -2));
    let parts = vec![
        ("left", block([-1.0, 0.0], [-1.0, 0.0], 4, Shape::Quadrilateral4, 0.0)),
        ("right", block([0.0, 1.5], [-1.0, 0.0], 5, Shape::Quadrilateral4, 0.0)),
        ("top", block([-1.0, 1.5], [0.0, 1.0], 7, Shape::Quadrilateral4, 0.0)),
    ];
    let scene = scene(&parts)
        .interface("over", faces(json!(["left.top", "right.top"]), "top.bottom").law(soft()))
        .interface("between", faces("left.right", "right.left").law(soft()))
        .step(open)
        .probes([
            ("a", "over.rate@0"),
            ("b", "over.rate@1"),
            ("c", "between.rate@0"),
            ("d", "over.drain_rate"),
        ]);
    let problem = bound(scene, parts);
    let state = solve(&problem).0.pop().unwrap();
    let g = |w: f64, length: f64| w.powi(3) / (12.0 * MU * length);
    let pipes = [(g(over, 1.0), 5.0), (g(over, 1.5), 1.0), (g(aside, 1.0), -2.0)];
    let middle = pipes.iter().map(|(g, p)| g * p).sum::<f64>() / pipes.iter().map(|(g, _)| g).sum::<f64>();
    let rates = state.probes(&problem);
    let exact = [pipes[0].0 * (5.0 - middle), pipes[1].0 * (middle - 1.0), pipes[2].0 * (middle + 2.0), 0.0];
    for (rate, exact) in rates.iter().zip(exact) {
        close(*rate, exact, 1e-8, exact.abs().max(g(over, 1.0)), &format!("{rates:?}"));
    }
    close(rates[0] - rates[1] - rates[2], 0.0, 1e-12, rates[0], "mass");
}

/// Claim: a part that goes lets go what it pressed on its neighbour with, water included.
#[test]
fn water_goes_with_its_part() {
    for pressure in [json!(2), json!("2 + 0*opening"), flow(1e-3, MU).ends(2, 2).into()] {
        let load = step("load").fix("a.bottom", "xy").fix("b", "x");
        let parts = pair(Shape::Quadrilateral4, 0.0);
        let scene = jointed(&parts)
            .step(load.pressure("joint", pressure.clone()).pressure("b.top", 3))
            .step(step("gone").increments(4).deactivate("b", 1))
            .probes([("y", "a.top.displacement_y"), ("n", "joint.total_resultant_n")]);
        let problem = bound(scene, parts);
        let (states, _) = solve(&problem);
        for (state, left) in states.iter().zip([1.0, 0.75, 0.5, 0.25, 0.0]) {
            close(
                state.probes(&problem)[0],
                -3.0 * 0.5 / 1e4 * left,
                1e-9,
                1.5e-4,
                &format!("{pressure} top"),
            );
            close(state.energy_balance(), 0.0, 1e-9, 1.0, "energy");
        }
    }
}

/// Claim: where a part is not there no water is; it comes with the part.
#[test]
fn water_comes_with_its_part() {
    for pressure in [json!(2), json!("2 + 0*opening"), flow(1e-3, MU).ends(4, 0).into()] {
        let parts = pair(Shape::Quadrilateral4, 0.0);
        let dam = step("dam").increments(2).activate(["b"]).fix("b", "x").pressure("b.top", 3);
        let scene = jointed(&parts)
            .step(step("rock").fix("a", "xy").pressure("joint", pressure.clone()))
            .step(dam)
            .step(step("gone").deactivate("b", 1))
            .probes([("u", "joint.uplift"), ("n", "joint.total_resultant_n")]);
        let problem = bound(scene, parts);
        let (states, _) = solve(&problem);
        for (state, [uplift, total]) in states.iter().zip([[0.0, 0.0], [2.0, -3.0], [4.0, -6.0], [0.0, 0.0]])
        {
            let probes = state.probes(&problem);
            close(probes[0], uplift, 1e-9, 1.0, &format!("{pressure} uplift"));
            close(probes[1], total, 1e-9, 1.0, &format!("{pressure} total"));
        }
    }
}
