//! Claim: fractures under the pressure of a fluid open as theory and an independent code say, whichever way the pressure is given.
//!
//! ```text
//!  Sneddon    ──────╱‾‾‾‾╲──────     w(s) = 4 (1 − ν²) p/E √(L²/4 − s²)     by pressure, by loads on both faces, by flow
//!                   ╲____╱
//!  T          ────────┬────────      a vertical fracture under 100 MPa opens and drives slip on a dry horizontal one:
//!                     │              boundary elements (`common::boundary`), with contact and friction
//! ```

use crate::common::boundary::{Contact, Element, Found, Plane, elements};
use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;

/// A square plate of half width w around fractures between points from number 5 on.
fn plate(w: f64, far: f64, fractures: &str) -> Mesh {
    meshed(&format!(
        "Point(1) = {{-{w}, -{w}, 0, {far}}}; Point(2) = {{{w}, -{w}, 0, {far}}}; Point(3) = {{{w}, {w}, 0, {far}}};
        Point(4) = {{-{w}, {w}, 0, {far}}}; Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
        Curve Loop(1) = {{1:4}}; Plane Surface(1) = {{1}};
        {fractures}
        Physical Curve(\"bottom\") = {{1}}; Physical Curve(\"top\") = {{3}}; Physical Point(\"sw\") = {{1}};
        Physical Point(\"se\") = {{2}}; Physical Surface(\"plate\") = {{1}};
        Mesh.ElementOrder = 2;"
    ))
}

/// A plate of an elastic rock, held at two corners.
fn scene([young, poisson]: [f64; 2]) -> Scene {
    Scene::new("strain").subdomain("plate", "rock").material("rock", young, poisson)
}

fn held() -> Step {
    step("go").fix("plate.sw", "xy").fix("plate.se", "y")
}

/// A fracture with friction.
fn fracture(name: &str) -> Interface {
    within(format!("plate.{name}")).law(coulomb(1e6, 1e6, 30f64.to_radians().tan()))
}

/// K and G as Young's modulus and Poisson's ratio.
fn moduli(k: f64, g: f64) -> [f64; 2] {
    [9.0 * k * g / (3.0 * k + g), (3.0 * k - 2.0 * g) / (2.0 * (3.0 * k + g))]
}

#[test]
fn sneddons_crack_opens_as_in_theory_whichever_way_it_is_pressed() {
    let (half, p) = (1.0, 2.0);
    let [e, nu] = moduli(16.7e3, 10e3);
    let solved = |go: Step| -> (Problem, ModelState) {
        let mesh = plate(
            30.0,
            6.0,
            "Point(5) = {-1, 0, 0, 0.002}; Point(6) = {0, 0, 0, 0.05}; Point(7) = {1, 0, 0, 0.002}; Line(5) = {5, 6};
            Line(6) = {6, 7}; Curve{5, 6} In Surface{1}; Physical Curve(\"crack\") = {5, 6};",
        );
        let scene = scene([e, nu]).interface("crack", fracture("crack")).step(go);
        let problem = scene.bind(vec![mesh]).unwrap();
        let state = solve(&problem).0.pop().unwrap();
        (problem, state)
    };
    let (problem, pressed) = solved(held().pressure("crack", p));
    let most = 4.0 * (1.0 - nu * nu) * p / e * half;
    close(most, 2.998e-4, 1e-3, most, "0.300 mm");
    let points = &problem.model.interfaces[0].coupling.points;
    for (point, jump) in points.iter().zip(&pressed.snapshot.jumps[0]) {
        let s = point.s - half;
        if s.abs() > 0.99 {
            continue; // the last elements
        }
        close(jump[0], most * (1.0 - s * s).sqrt(), 1e-2, most, &format!("opening at {s}"));
    }
    for other in [
        held().pressure("plate.crack", p),
        held().pressure("crack", flow(1e-5, 1e-9).ends(p, p)),
        held().pressure("crack", format!("{p}*ramp(opening, -1, -0.5)")),
    ] {
        let what = other.to_string();
        let (_, state) = solved(other);
        for (a, b) in state.snapshot.jumps[0].iter().zip(&pressed.snapshot.jumps[0]) {
            close(a[0], b[0], 1e-9, most, &what);
        }
    }
}

/// Largest difference of the values at the law points of an interface and those of boundary elements, of the largest; `exact` has
/// none where both are singular.
fn difference(
    problem: &Problem,
    interface: usize,
    value: impl Fn(usize) -> f64,
    exact: impl Fn([f64; 2]) -> Option<f64>,
) -> f64 {
    let points = &problem.model.interfaces[interface].coupling.points;
    let (mut error, mut most) = (0.0_f64, 0.0_f64);
    for (p, point) in points.iter().enumerate() {
        let Some(exact) = exact([point.position[0], point.position[1]]) else { continue };
        error = error.max((value(p) - exact).abs());
        most = most.max(exact.abs());
    }
    error / most
}

/// Value along a fracture of equal elements, on lines between their middles.
fn along(fracture: &[Element], values: &[f64], x: [f64; 2]) -> f64 {
    let [start, end] = [fracture[0].ends[0], fracture[fracture.len() - 1].ends[1]];
    let way = [end[0] - start[0], end[1] - start[1]];
    let share =
        ((x[0] - start[0]) * way[0] + (x[1] - start[1]) * way[1]) / (way[0] * way[0] + way[1] * way[1]);
    let at = share * fracture.len() as f64 - 0.5;
    let k = (at.floor().max(0.0) as usize).min(fracture.len() - 2);
    values[k] + (at - k as f64) * (values[k + 1] - values[k])
}

#[test]
fn a_t_of_two_fractures_is_that_of_boundary_elements() {
    let (e, nu) = (70e3, 0.2);
    let plane =
        Plane { young: e, poisson: nu, remote: [0.0, -100.0, 0.0], friction: 30f64.to_radians().tan() };
    let n = 100; // twice as many change the slip by 0.6 %
    let mut all: Vec<Element> = elements([0.0, -100.0], [0.0, 0.0], 4 * n, Contact::Pressed(100.0));
    all.extend(elements([-25.0, 0.0], [0.0, 0.0], n, Contact::Slides(1.0)));
    all.extend(elements([0.0, 0.0], [25.0, 0.0], n, Contact::Slides(-1.0)));
    let found = plane.solve(&mut all);
    let parts = [0..4 * n, 4 * n..5 * n, 5 * n..6 * n];
    let mesh = plate(
        2000.0,
        300.0,
        "Point(5) = {0, -100, 0, 0.2}; Point(6) = {0, -50, 0, 2}; Point(7) = {0, 0, 0, 0.2}; Point(8) = {-25, 0, 0, 0.2};
        Point(9) = {-12, 0, 0, 1}; Point(10) = {12, 0, 0, 1}; Point(11) = {25, 0, 0, 0.2};
        Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {8, 9}; Line(8) = {9, 7}; Line(9) = {7, 10}; Line(10) = {10, 11};
        Curve{5:10} In Surface{1}; Physical Curve(\"vertical\") = {5, 6}; Physical Curve(\"horizontal\") = {7:10};",
    );
    let go = held().pressure("plate.top", 100).pressure("plate.bottom", 100).pressure("vertical", 100);
    let scene = scene([e, nu])
        .interface("vertical", fracture("vertical"))
        .interface("horizontal", fracture("horizontal"))
        .step(go);
    let problem = scene.bind(vec![mesh]).unwrap();
    let state = solve(&problem).0.pop().unwrap();
    let jump = |k: usize, p: usize, d: usize| state.snapshot.jumps[k][p][d];
    let exact = |k: usize, value: &dyn Fn(&Found) -> f64, x: [f64; 2]| {
        let values: Vec<f64> = found[parts[k].clone()].iter().map(value).collect();
        along(&all[parts[k].clone()], &values, x)
    };
    let opening =
        difference(&problem, 0, |p| jump(0, p, 0), |x| (x[1] > -98.0).then(|| exact(0, &|f| f.opening, x)));
    assert!(opening < 0.02, "opening {opening}");
    for k in [1, 2] {
        let slip = difference(&problem, k, |p| jump(k, p, 1).abs(), |x| Some(exact(k, &|f| f.slip.abs(), x)));
        let normal = difference(
            &problem,
            k,
            |p| state.snapshot.tractions[k][p][0],
            |x| (1.0..24.0).contains(&x[0].abs()).then(|| exact(k, &|f| f.normal, x)),
        );
        assert!(slip < 0.02 && normal < 0.02, "slip {slip} normal traction {normal}");
    }
}
