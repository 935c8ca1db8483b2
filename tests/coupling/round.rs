//! Claim: on a circular interface, unmatched, the displacement converges with h² (linear) or h³ (quadratic, curved edges)
//! and the traction at least with h^1.5 to the finest mesh, from soft springs to K_N h/E = 1e8: two rings under pressure and torque (case 3)
//! and an inclusion in a plate under tension (case 4).
//!
//! ```text
//!      ╭───────────╮   n_b edges outside
//!    ╭─┤─── B ───╮ │
//!    │ │ ╭─ A ─╮ │ │   C: r = b, n_a edges inside
//!    │ │ ╰─────╯ │ │   held as in the exact solution inside; traction (case 3) or exact displacement (4) outside
//!    ╰─┤─────────╯ │
//!      ╰───────────╯
//! ```

use std::f64::consts::PI;

use crate::common::rings::{Polar, Round, inclusion, rings};
use crate::common::round::{bent, l2_error, quarter, ring};
use crate::common::table::{Table, list, rate};
use crate::common::*;
use midplane::error::Code;
use midplane::history::ModelState;
use midplane::problem::Problem;
use midplane::shape::Shape;

const SHAPES: [Shape; 4] = [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8];

/// A and B joined along A.top and B.bottom.
fn scene(exact: &Round, [kn, kt]: [f64; 2], load: Step) -> Scene {
    Scene::new("strain")
        .subdomain("a", "a")
        .subdomain("b", "b")
        .material("a", exact.e[0], exact.nu[0])
        .material("b", exact.e[1], exact.nu[1])
        .interface("joint", faces("a.top", "b.bottom").coupling("projected").law(elastic(kn, kt)))
        .step(load)
}

/// A step with a group displaced as in an exact solution.
fn displaced(step: Step, group: &str, u: &Polar) -> Step {
    let [x, y] = u.formulas();
    step.displace(group, "x", x).displace(group, "y", y)
}

/// Relative errors in L2: displacement of both bodies, traction at the law points.
fn errors(problem: &Problem, state: &ModelState, exact: &Round) -> [f64; 2] {
    let mut displacement = [0.0; 2];
    for (b, subdomain) in problem.model.subdomains.iter().enumerate() {
        let u = &state.snapshot.u[problem.model.dofs_of(b)];
        let sums = l2_error(&subdomain.mesh, u, |x| exact.u[b].u(x));
        (displacement[0], displacement[1]) = (displacement[0] + sums[0], displacement[1] + sums[1]);
    }
    let mut traction = [0.0; 2];
    for (point, t) in problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.tractions[0]) {
        let [x, y, _] = point.position;
        let r2 = x * x + y * y;
        let (c2, s2) = ((x * x - y * y) / r2, 2.0 * x * y / r2);
        let (n, s) = (exact.normal[0] + exact.normal[1] * c2, -exact.shear[0] - exact.shear[1] * s2);
        traction[0] += point.weight * ((t[0] - n).powi(2) + (t[1] - s).powi(2));
        traction[1] += point.weight * (n * n + s * s);
    }
    [displacement, traction].map(|[error, norm]| (error / norm).sqrt())
}

/// Runs one case over elements, ratios and stiffnesses, a row of meshes each, and asserts the rates between the two
/// finest: of the displacement 2 (3 if quadratic), of the traction 2 (3, and 2 in the end, if quadratic).
fn converges(
    name: &'static str,
    heading: &str,
    radii: [f64; 3],
    fine: usize,
    outside: bool,
    exact: impl Fn(f64, f64) -> Round,
) {
    let mut table = Table::new(
        name,
        heading,
        "Relative L2 errors of displacement and traction on meshes each half as fine as the next; K_T = K_N/2; `projected`. Rates: of the displacement between the two finest meshes; of the traction on average / between the two finest.",
        &["element", "A:B", "K_N h/E", "displacement", "rate", "traction", "rate"],
    );
    let mut failures = Vec::new();
    for shape in SHAPES {
        let quadratic = shape.is_quadratic();
        for (a, b) in [(2, 3), (3, 7)] {
            let numbers: &[f64] = match (quadratic, a) {
                (false, 2) => &[0.1, 1e4, 1e8],
                (true, 3) => &[1e8],
                _ => &[0.1, 1e8],
            };
            for &number in numbers {
                let kn = number * 1e4 / 0.2;
                let exact = exact(kn, 0.5 * kn);
                let mut all = [Vec::new(), Vec::new()];
                for load_factor in 0..if quadratic { 3 } else { 5 } {
                    let n = if quadratic { fine } else { 8 } << load_factor;
                    let rows = n / 4;
                    let mesh = |edges: usize, rows: usize, r: [f64; 2], from: f64| {
                        ring(edges, &even(r[0], r[1], rows), shape, from)
                    };
                    let meshes = vec![
                        mesh(a * n / if a == 3 { 2 } else { 1 }, rows, [radii[0], radii[1]], 0.0),
                        mesh(b * n / if a == 3 { 2 } else { 1 }, rows, [radii[1], radii[2]], 0.0),
                    ];
                    let inside = displaced(step("load"), "a.bottom", &exact.u[0]);
                    let load = if outside {
                        displaced(inside, "b.top", &exact.u[1])
                    } else {
                        let tau = exact.shear[0] * (radii[1] / radii[2]).powi(2);
                        let r = "hypot(x,y)";
                        inside.traction("b.top", format!("-{tau}*y/{r}"), format!("{tau}*x/{r}"))
                    };
                    let problem = scene(&exact, [kn, 0.5 * kn], load).bind(meshes).unwrap();
                    let state = solve(&problem).0.remove(0);
                    for (all, error) in all.iter_mut().zip(errors(&problem, &state, &exact)) {
                        all.push(error);
                    }
                }
                let finest = all[0].len() - 2;
                let rates = [rate(&all[0][finest..]), rate(&all[1]), rate(&all[1][finest..])];
                table.row(&[
                    shape.label().into(),
                    format!("{a}:{b}"),
                    format!("{number:.0e}"),
                    list(&all[0]),
                    format!("{:.2}", rates[0]),
                    list(&all[1]),
                    format!("{:.2} / {:.2}", rates[1], rates[2]),
                ]);
                let u = if quadratic { 3.0 } else { 2.0 };
                // a linear grid shows h² on a stiff curve in the end, whatever the sides
                let t = match (quadratic, number > 1.0) {
                    (false, _) => 1.85..=2.15,
                    (true, false) => 2.9..=3.5,
                    (true, true) => 1.95..=3.1,
                };
                if (rates[0] - u).abs() > 0.15 || !t.contains(&rates[2]) {
                    failures.push(format!("{shape:?} {a}:{b} {number:e}: {rates:?}"));
                }
            }
        }
    }
    table.finish();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn case_3_rings_under_pressure_and_torque() {
    // the listed values of the case
    let exact = rings(2e4, 1e4, 10.0, 20.0);
    close(exact.normal[0], -1.0835214446952612, 1e-12, 1.0, "srr_b");
    close(exact.shear[0], 1.4147106052612919, 1e-12, 1.0, "srt_b");
    close(exact.u[1].u([0.0, 2.0])[1], 0.0005070880361173815, 1e-12, 1e-3, "ur_c");
    close(exact.u[1].u([0.0, 2.0])[0], -0.0004910224725761067, 1e-12, 1e-3, "ut_c");
    converges(
        "case03",
        "Case 3: two rings under pressure and torque",
        [1.0, 1.5, 2.0],
        8,
        false,
        |kn, kt| rings(kn, kt, 10.0, 20.0),
    );
}

#[test]
fn case_4_inclusion_in_a_plate() {
    let exact = inclusion(1.5e4, 8e3);
    close(exact.normal[0] + exact.normal[1], 0.9976729346147841, 1e-12, 1.0, "tn_0");
    close(exact.shear[1], -0.41256263602773696, 1e-12, 1.0, "tt_45");
    close(exact.u[1].u([2.0, 2.0])[0], 0.0001849967146, 1e-9, 1e-4, "u_matrix_2a_2a x");
    close(exact.u[1].u([0.0, 2.0])[1], -7.201561831234393e-05, 1e-12, 1e-4, "u_matrix_0_2a y");
    converges("case04", "Case 4: inclusion in a plate under tension", [0.3, 1.0, 2.0], 16, true, inclusion);
}

/// Claim: the tractions between coarse, straight-sided rings stay as good at any stiffness: Q4, quarter model, pressure
/// alone, so that t_t = 0 exactly. t_n reaches 3e-3, 1e-3, 4e-4 and t_t 4e-3, 7e-4, 1.3e-4, both fall like h².
#[test]
fn stiff_rings_transmit_the_pressure() {
    let mut table = Table::new(
        "case03_stiff",
        "Case 3 without torque: stiff springs on straight-sided Q4",
        "Quarter model; RMS error of t_n / of t_t (exactly 0) over |t_n|.",
        &["K_N", "12:17", "24:34", "48:68"],
    );
    let mut before: Option<Vec<[f64; 2]>> = None;
    for kn in [1e8, 1e10] {
        let exact = rings(kn, kn, 10.0, 0.0);
        let mut errors = Vec::new();
        for load_factor in 0..3 {
            let [a, b] = [12 << load_factor, 17 << load_factor];
            let mesh = |n: usize, r: [f64; 2]| {
                quarter(n, &even(r[0], r[1], 6 << load_factor), Shape::Quadrilateral4)
            };
            let held =
                step("load").fix("a.left", "x").fix("b.left", "x").fix("a.right", "y").fix("b.right", "y");
            let scene = scene(&exact, [kn, kn], held.pressure("a.bottom", 10));
            let problem = scene.bind(vec![mesh(a, [1.0, 1.5]), mesh(b, [1.5, 2.0])]).unwrap();
            let state = solve(&problem).0.remove(0);
            let (mut error, mut length) = ([0.0; 2], 0.0);
            for (point, t) in
                problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.tractions[0])
            {
                error[0] += point.weight * (t[0] / exact.normal[0] - 1.0).powi(2);
                error[1] += point.weight * (t[1] / exact.normal[0]).powi(2);
                length += point.weight;
            }
            errors.push(error.map(|e| (e / length).sqrt()));
        }
        let cells = errors.iter().map(|e| format!("{:.1e} / {:.1e}", e[0], e[1]));
        table.row(&std::iter::once(format!("{kn:.0e}")).chain(cells).collect::<Vec<_>>());
        for (e, limit) in errors.iter().zip([[3e-3, 4e-3], [1e-3, 7e-4], [4e-4, 1.3e-4]]) {
            assert!(e[0] < limit[0] && e[1] < limit[1], "{kn:e}: {errors:?}");
        }
        for k in 0..2 {
            let of: Vec<f64> = errors.iter().map(|e| e[k]).collect();
            assert!((rate(&of) - 2.0).abs() < 0.1, "{kn:e}: {errors:?}");
        }
        if let Some(before) = &before {
            for (e, soft) in errors.iter().zip(before) {
                assert!(
                    e[0] < 1.05 * soft[0] && e[1] < 1.05 * soft[1],
                    "stiffer is worse: {errors:?}, {before:?}"
                );
            }
        }
        before = Some(errors);
    }
    table.finish();
}

/// Claim: a half ring on a frictionless half ring may turn about the centre; what resists it is the mesh alone, and is warned of.
#[test]
fn a_half_ring_on_a_frictionless_half_ring_is_hardly_constrained() {
    let half = |n: usize, r: [f64; 2]| {
        bent(&even(0.0, 1.0, n), &even(r[0], r[1], 3), Shape::Quadrilateral4, |x, r| {
            [r * (PI * (1.0 - x)).cos(), r * (PI * (1.0 - x)).sin()]
        })
    };
    let exact = rings(2e4, 0.0, 10.0, 0.0);
    let bound = |held: Step| {
        let scene = scene(&exact, [2e4, 0.0], held.fix("a.bottom", "xy").pressure("b.top", 10));
        scene.bind(vec![half(14, [1.0, 1.5]), half(20, [1.5, 2.0])]).unwrap().warnings
    };
    let told = bound(step("load"));
    assert!(told.len() == 1 && told[0].code == Code::HardlyHeld, "{told:?}");
    assert!(told[0].what.contains("subdomain b is hardly held against a rotation about"), "{told:?}");
    assert!(bound(step("load").fix("b.left", "y")).is_empty());
}
