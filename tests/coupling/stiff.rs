//! Claim: with `projected` neither displacement nor traction loses digits to the stiffness of an interface, whether the body above
//! is held or floats: patches of constant stress at K h/E from 1e-2 to 1e16, and far beyond.
//!
//! ```text
//!   n ↑   ┌──── B ────┐ 0.7     s_nn, s_nt common; e_tt common
//!     └→t ├───────────┤ 0       side i: e_nn = (s_nn − λ e_tt)/(λ + 2μ), s_tt = (λ + 2μ) e_tt + λ e_nn
//!         └──── A ────┘ −0.5    u_t = e_tt t + (s_nt/μ) n, u_n = e_nn n; B adds (s_nt/K_T, s_nn/K_N)
//! ```
//!
//! A is held at its bottom by the exact displacement, the sides carry the exact tractions. B carries the exact traction on its
//! top (it floats on the interface) or is held there by the exact displacement.

use crate::common::table::Table;
use crate::common::*;
use midplane::shape::Shape;

/// Largest error, relative to the largest value of the field.
const LIMIT: f64 = 1e-11;
const SHAPES: [Shape; 4] = [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8];
const E: [f64; 2] = [1e4, 4e3];
const NU: [f64; 2] = [0.2, 0.35];

/// Two layers at one stiffness: errors of displacement and traction, and the iterations.
fn patch(
    shape: Shape,
    (a, b): (usize, usize),
    degrees: f64,
    floating: bool,
    number: f64,
) -> ([f64; 2], usize) {
    let (snn, snt, ett) = (-6.0, 2.5, 3e-4);
    let kn = number * E[1] * a.min(b) as f64; // the longest edge is 1/min(a, b)
    let kt = kn / 4.0;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turned = |t: f64, n: f64| [cos * t - sin * n, sin * t + cos * n];
    let sides = [0, 1].map(|side| {
        let (e, nu) = (E[side], NU[side]);
        let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
        let enn = (snn - lambda * ett) / (lambda + 2.0 * mu);
        let stt = (lambda + 2.0 * mu) * ett + lambda * enn;
        let jump = if side == 1 { [snt / kt, snn / kn] } else { [0.0; 2] };
        (stt, [ett, snt / mu], enn, jump)
    });
    let exact = |side: usize, [x, y]: [f64; 2]| {
        let (t, n) = (cos * x + sin * y, cos * y - sin * x);
        let (_, [along, across], enn, jump) = sides[side];
        turned(along * t + across * n + jump[0], enn * n + jump[1])
    };
    let formulas = |side: usize| {
        let (t, n) = (format!("({cos}*x + {sin}*y)"), format!("({cos}*y - {sin}*x)"));
        let (_, [along, across], enn, jump) = sides[side];
        let (ut, un) =
            (format!("({along}*{t} + {across}*{n} + {})", jump[0]), format!("({enn}*{n} + {})", jump[1]));
        [format!("{cos}*{ut} - {sin}*{un}"), format!("{sin}*{ut} + {cos}*{un}")]
    };
    let displaced = |step: Step, side: usize, name: &str| {
        let [x, y] = formulas(side);
        step.displace(name, "x", x).displace(name, "y", y)
    };
    let mut go = displaced(step("go"), 0, "a.bottom");
    for (side, name, sign) in
        [(0, "a.left", -1.0), (0, "a.right", 1.0), (1, "b.left", -1.0), (1, "b.right", 1.0)]
    {
        let [x, y] = turned(sign * sides[side].0, sign * snt);
        go = go.traction(name, x, y);
    }
    let [x, y] = turned(snt, snn);
    let go = if floating { go.traction("b.top", x, y) } else { displaced(go, 1, "b.top") };
    let scene = Scene::new("strain")
        .subdomain("a", "hard")
        .subdomain("b", "soft")
        .material("hard", E[0], NU[0])
        .material("soft", E[1], NU[1])
        .interface("joint", faces("a.top", "b.bottom").law(elastic(kn, kt)))
        .step(go);
    let mesh = |n, ys: &[f64]| rectangle(&even(-0.5, 0.5, n), ys, shape, rotation(degrees));
    let problem = scene.bind(vec![mesh(a, &even(-0.5, 0.0, 4)), mesh(b, &even(0.0, 0.7, 6))]).unwrap();
    let (states, totals) = solve(&problem);
    let (mut wrong, mut largest) = ([0.0_f64; 2], 0.0_f64);
    for subdomain in 0..2 {
        for (node, &x) in problem.model.subdomains[subdomain].mesh.points.iter().enumerate() {
            let (u, exact) =
                (displacement(&problem, &states[0], subdomain, node), exact(subdomain, [x[0], x[1]]));
            wrong[0] = wrong[0].max((u[0] - exact[0]).abs()).max((u[1] - exact[1]).abs());
            largest = largest.max(exact[0].abs()).max(exact[1].abs());
        }
    }
    for t in &states[0].snapshot.tractions[0] {
        wrong[1] = wrong[1].max((t[0] - snn).abs()).max((t[1] - snt).abs());
    }
    ([wrong[0] / largest, wrong[1] / 6.0], totals.iterations)
}

#[test]
fn stiffness_costs_no_digits() {
    let mut table = Table::new(
        "stiff",
        "Cases 1 and 1b: constant stress at any stiffness of the joint",
        "Largest relative error over T3, Q4, T6, Q8, the meshes 7:11 and 1:37, level and turned by 30°; `projected`.",
        &["K h/E", "above", "displacement", "traction"],
    );
    for exponent in [-2, 0, 2, 3, 4, 6, 8, 10, 12, 14, 16, 30, 99] {
        for floating in [true, false] {
            let mut worst = [0.0_f64; 2];
            for shape in SHAPES {
                for pair in [(7, 11), (1, 37)] {
                    for degrees in [0.0, 30.0] {
                        let number = 10_f64.powi(exponent);
                        let (errors, iterations) = patch(shape, pair, degrees, floating, number);
                        assert_eq!(iterations, 0, "a linear scene takes one solve");
                        worst = [0, 1].map(|k| worst[k].max(errors[k]));
                    }
                }
            }
            let above = if floating { "floats" } else { "held" };
            table.row(&[
                format!("1e{exponent}"),
                above.into(),
                format!("{:.1e}", worst[0]),
                format!("{:.1e}", worst[1]),
            ]);
            assert!(worst[0] < LIMIT && worst[1] < LIMIT, "1e{exponent}, {above}: {worst:?}");
        }
    }
    table.finish();
}
