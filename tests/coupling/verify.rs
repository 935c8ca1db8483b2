//! Claim: two layers with an interface at y = 0 converge to their exact solutions: patch with a gradient (case 2), manufactured
//! solution (5a), strip under a harmonic pressure (5b), stiff and soft limits (9).
//!
//! ```text
//!     p₀ cos kx ↓            u_x = P(y) sin kx,  u_y = Q(y) cos kx            `common::strip`
//!   │┌───────────┐│ h_B      linear: u with h², energy norm with h;  quadratic: h³ and h²;  t_n at least with h^1.5
//!   │├───────────┤│ 0        n_b edges above, n_a below
//!   │└───────────┘│ −h_A     planes of symmetry at x = 0 and x = π/k
//!     △  △  △  △
//! ```
//!
//! `make verify` keeps the tables for the documentation.

use crate::common::strip::{Manufactured, Strip};
use crate::common::table::{Table, list, rate};
use crate::common::*;
use midplane::history::ModelState;
use midplane::problem::Problem;
use midplane::shape::Shape;

const SHAPES: [Shape; 4] = [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8];

/// Two elastic layers joined at y = 0, A below.
struct Layers {
    h: [f64; 2],
    plane: &'static str,
    /// E and ν of both.
    e_nu: [(f64, f64); 2],
    /// K_N and K_T.
    k: (f64, f64),
}

impl Layers {
    /// The step solved on meshes with the given x of the interface's nodes and as many rows as edges.
    fn solve(&self, x: [&[f64]; 2], shape: Shape, coupled: Coupled, load: &Step) -> (Problem, ModelState) {
        let flat = |x: f64, y: f64| [x, y];
        let rows = |i: usize| x[i].len() - 1;
        let lower = rectangle(x[0], &even(-self.h[0], 0.0, rows(0)), shape, flat);
        let upper = rectangle(x[1], &even(0.0, self.h[1], rows(1)), shape, flat);
        let [(e1, nu1), (e2, nu2)] = self.e_nu;
        let joint = faces("lower.top", "upper.bottom").coupling(coupled.coupling).with("grid", coupled.grid);
        let scene = Scene::new(self.plane)
            .subdomain("lower", "a")
            .subdomain("upper", "b")
            .material("a", e1, nu1)
            .material("b", e2, nu2)
            .interface("joint", joint.law(elastic(self.k.0, self.k.1)))
            .step(load.clone())
            .probe("top", "upper.top.displacement_y");
        let problem = scene.bind(vec![lower, upper]).unwrap();
        let state = solve(&problem).0.remove(0);
        (problem, state)
    }
}

/// A coupling and the grid of its jumps.
#[derive(Clone, Copy)]
struct Coupled {
    coupling: &'static str,
    grid: &'static str,
}

const PROJECTED: Coupled = Coupled { coupling: "projected", grid: "auto" };
const POINTWISE: Coupled = Coupled { coupling: "pointwise", grid: "auto" };
const LINEAR: Coupled = Coupled { coupling: "projected", grid: "linear" };
const QUADRATIC: Coupled = Coupled { coupling: "projected", grid: "quadratic" };

/// RMS along the interface of the error of one traction component, over the RMS of the exact one.
fn traction_error(
    problem: &Problem,
    state: &ModelState,
    component: usize,
    exact: impl Fn(f64) -> f64,
) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for (point, t) in problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.tractions[0]) {
        let x = exact(point.position[0]);
        error += point.weight * (t[component] - x).powi(2);
        norm += point.weight * x * x;
    }
    (error / norm).sqrt()
}

/// Claim: a normal stress that varies linearly along the interface, σ_yy = s_m + s_g x/a and nothing else, is exact for T6
/// and Q8 on any two meshes with both couplings; T3 and Q4 converge with h².
///
/// With E′ = E, ν′ = ν (plane stress), e = s_m/E, k = s_g/(aE): u_x = −ν e x − k/2 (y² + ν x²), u_y = e y + k x y;
/// side B adds u_x = −w y, u_y = s_m/K_N + w x with w = s_g/(a K_N). The outer boundary is displaced so.
#[test]
fn case_2_bending_patch() {
    let (e, nu, a, h, sm, sg, kn) = (1e4, 0.2, 0.1, [0.1, 0.15], -5.0, 4.0, 1e5);
    let (strain, k, w) = (sm / e, sg / (a * e), sg / (a * kn));
    let u = |side: usize, x: f64, y: f64| {
        let b = side as f64;
        [
            -nu * strain * x - 0.5 * k * (y * y + nu * x * x) - b * w * y,
            strain * y + k * x * y + b * (sm / kn + w * x),
        ]
    };
    // the listed values of the case
    for (got, listed) in [
        (u(1, a, h[1]), [-9.9e-5, -2.5e-5]),
        (u(1, -a, h[1]), [-1.19e-4, -2.25e-4]),
        (u(0, a, -h[0]), [-1.4e-5, 1e-5]),
    ] {
        assert!((got[0] - listed[0]).abs() < 1e-18 && (got[1] - listed[1]).abs() < 1e-18);
    }
    let displaced = |step: Step, side: usize, groups: [&str; 3]| {
        let b = side as f64;
        let x = format!("-({nu})*({strain:e})*x - 0.5*({k:e})*(y^2 + {nu}*x^2) - {:e}*y", b * w);
        let y = format!("({strain:e})*y + ({k:e})*x*y + {:e} + {:e}*x", b * sm / kn, b * w);
        let both =
            |step: Step, group: &str| step.displace(group, "x", x.as_str()).displace(group, "y", y.as_str());
        groups.into_iter().fold(step, both)
    };
    let load = displaced(step("load"), 0, ["lower.left", "lower.right", "lower.bottom"]);
    let load = displaced(load, 1, ["upper.left", "upper.right", "upper.top"]);
    let layers = Layers { h, plane: "stress", e_nu: [(e, nu); 2], k: (kn, kn) };
    let mut table = Table::new(
        "case02",
        "Case 2: linearly varying stress across an unmatched joint",
        "Largest error of displacement and of t_n, relative to the largest value; edges A:B from 5:8 to 1:37, and 5:8, 10:16, 20:32.",
        &["element", "coupling", "displacement", "t_n"],
    );
    for shape in SHAPES {
        for coupled in [PROJECTED, POINTWISE] {
            let coupling = coupled.coupling;
            let pairs: &[(usize, usize)] = if shape.is_quadratic() {
                &[(5, 8), (7, 12), (1, 37), (9, 9)]
            } else {
                &[(5, 8), (10, 16), (20, 32)]
            };
            let (mut errors_u, mut errors_t) = (Vec::new(), Vec::new());
            for &(n_a, n_b) in pairs {
                let x = [even(-a, a, n_a), even(-a, a, n_b)];
                let (problem, state) = layers.solve([&x[0], &x[1]], shape, coupled, &load);
                let mut error_u = 0.0_f64;
                for (b, subdomain) in problem.model.subdomains.iter().enumerate() {
                    for (i, p) in subdomain.mesh.points.iter().enumerate() {
                        let (got, exact) = (displacement(&problem, &state, b, i), u(b, p[0], p[1]));
                        error_u = error_u.max((got[0] - exact[0]).abs()).max((got[1] - exact[1]).abs());
                    }
                }
                let points = problem.model.interfaces[0].coupling.points.iter();
                let error_t = points
                    .zip(&state.snapshot.tractions[0])
                    .map(|(p, t)| (t[0] - (sm + sg * p.position[0] / a)).abs().max(t[1].abs()));
                errors_u.push(error_u / 2.25e-4);
                errors_t.push(error_t.fold(0.0, f64::max) / 9.0);
            }
            table.row(&[shape.label().into(), coupling.into(), list(&errors_u), list(&errors_t)]);
            if shape.is_quadratic() {
                assert!(errors_u.iter().chain(&errors_t).all(|&e| e < 1e-11), "{shape:?} {coupling}");
            } else {
                assert!((rate(&errors_u) - 2.0).abs() < 0.1, "{shape:?} {coupling}: {}", rate(&errors_u));
            }
        }
    }
    table.finish();
}

/// L2 norm of the displacement error and energy norm of the strain error, squared.
fn errors(problem: &Problem, state: &ModelState, exact: &Manufactured) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (layer, subdomain) in problem.model.subdomains.iter().enumerate() {
        for c in 0..subdomain.mesh.cells.len() {
            let shape = subdomain.mesh.cells.shapes[c];
            let nodes = subdomain.mesh.cells.nodes(c);
            for &[xi, eta, weight] in shape.load_rule() {
                let values = shape.values(xi, eta);
                let (mut x, mut u, mut jacobian) = ([0.0; 2], [0.0; 2], nalgebra::Matrix2::<f64>::zeros());
                for (i, &node) in nodes.iter().enumerate() {
                    let nodal = displacement(problem, state, layer, node);
                    for d in 0..2 {
                        x[d] += values.n[i] * subdomain.mesh.points[node][d];
                        u[d] += values.n[i] * nodal[d];
                        for a in 0..2 {
                            jacobian[(a, d)] += values.dn[i][a] * subdomain.mesh.points[node][d];
                        }
                    }
                }
                let inverse = jacobian.try_inverse().unwrap();
                let mut strain = exact.strain(layer, x[0], x[1]).map(|e| -e);
                for (i, &node) in nodes.iter().enumerate() {
                    let g = inverse * nalgebra::Vector2::from(values.dn[i]);
                    let nodal = displacement(problem, state, layer, node);
                    strain[0] += g[0] * nodal[0];
                    strain[1] += g[1] * nodal[1];
                    strain[2] += g[1] * nodal[0] + g[0] * nodal[1];
                }
                let area = weight * jacobian.determinant();
                let u_exact = exact.u(layer, x[0], x[1]);
                let stress = subdomain.elasticity.stress(strain);
                sums[0] += area * ((u[0] - u_exact[0]).powi(2) + (u[1] - u_exact[1]).powi(2));
                sums[1] += area * (0..3).map(|i| strain[i] * stress[i]).sum::<f64>();
            }
        }
    }
    sums.map(f64::sqrt)
}

/// Claim: on 2:3 unmatched meshes the displacement converges with h² (linear) and h³ (quadratic) in L2, with h and h² in
/// the energy norm, against a manufactured solution with body force.
#[test]
fn case_5a_manufactured_solution() {
    let exact = Manufactured::open();
    // the listed values of the case
    close(exact.traction[0], -14.6662966, 1e-9, 14.6662966, "traction x");
    close(exact.traction[1], 28.84709887, 1e-9, 28.84709887, "traction y");
    close(exact.u(1, 0.3, 0.36)[1], 0.002819398622, 1e-9, 0.0028, "u at a sample");
    let [ax, ay] = exact.body_force(0);
    let [bx, by] = exact.body_force(1);
    let [tx, ty] = exact.top();
    let load = between_planes_of_symmetry().body_force("lower", ax, ay).body_force("upper", bx, by).traction(
        "upper.top",
        tx,
        ty,
    );
    let e_nu = [0, 1].map(|i| (exact.e[i], exact.nu[i]));
    let layers = Layers { h: exact.h, plane: "strain", e_nu, k: (exact.kn, exact.kt) };
    let mut table = Table::new(
        "case05a",
        "Case 5a: manufactured solution with body force, 2n:3n edges",
        "Errors over four halvings and the rate of the last two (L2 norm in m, energy norm in √(MN·m)).",
        &["element", "L2", "rate", "energy norm", "rate"],
    );
    for shape in SHAPES {
        let first = if shape.is_quadratic() { 1 } else { 2 };
        let refinements = [first, 2 * first, 4 * first, 8 * first, 16 * first];
        let all: Vec<[f64; 2]> = refinements
            .iter()
            .map(|n| {
                let x = [even(0.0, 1.0, 2 * n), even(0.0, 1.0, 3 * n)];
                let (problem, state) = layers.solve([&x[0], &x[1]], shape, PROJECTED, &load);
                errors(&problem, &state, &exact)
            })
            .collect();
        let [l2, energy] = [0, 1].map(|i| all.iter().map(|e| e[i]).collect::<Vec<f64>>());
        let rates = [rate(&l2[2..]), rate(&energy[2..])];
        let label = shape.label().to_string();
        table.row(&[label, list(&l2), format!("{:.2}", rates[0]), list(&energy), format!("{:.2}", rates[1])]);
        let (order, band) = if shape.is_quadratic() { (2.0, 0.15) } else { (1.0, 0.1) };
        assert!((rates[0] - order - 1.0).abs() <= band, "{shape:?} L2 rate {}", rates[0]);
        assert!((rates[1] - order).abs() <= 0.1, "{shape:?} energy rate {}", rates[1]);
    }
    table.finish();
}

/// A step in which the bottom is held, and the sides against displacements in x.
fn between_planes_of_symmetry() -> Step {
    let sides = ["lower.left", "lower.right", "upper.left", "upper.right"];
    sides.into_iter().fold(step("load").fix("lower.bottom", "xy"), |step, side| step.fix(side, "x"))
}

/// Relative errors of the energy and of the normal traction of the strip at K_N = K_T = k.
fn strip_errors(x: [&[f64]; 2], shape: Shape, k: f64, coupled: Coupled) -> [f64; 2] {
    let strip = Strip::open(k, k);
    let exact = strip.solve();
    let e_nu = [0, 1].map(|i| (strip.e[i], strip.nu[i]));
    let layers = Layers { h: strip.h, plane: "strain", e_nu, k: (k, k) };
    let load = between_planes_of_symmetry().traction("upper.top", 0.0, "-5*cos(pi*x)");
    let (problem, state) = layers.solve(x, shape, coupled, &load);
    let normal = |x: f64| exact.normal * (strip.k * x).cos();
    [(state.stored / exact.energy - 1.0).abs(), traction_error(&problem, &state, 0, normal)]
}

/// The closed form itself, against the published values of the case.
#[test]
fn the_strip_has_its_published_values() {
    let answer = Strip::open(2e4, 1e4).solve();
    close(answer.q_top, -0.000713658366, 1e-9, 7e-4, "Q_top");
    close(answer.shear, 1.170396232, 1e-9, 1.17, "shear");
    close(answer.normal, -2.406874455, 1e-9, 2.4, "normal");
    close(answer.energy, 0.0008920729575, 1e-9, 8.9e-4, "energy");
}

/// Edges of A and B at a level of refinement.
fn mesh(name: &str, n: usize) -> [Vec<f64>; 2] {
    match name {
        "matched" => [even(0.0, 1.0, 2 * n), even(0.0, 1.0, 2 * n)],
        "2:3" => [even(0.0, 1.0, 2 * n), even(0.0, 1.0, 3 * n)],
        "3:2" => [even(0.0, 1.0, 3 * n), even(0.0, 1.0, 2 * n)],
        "graded 2:3" => [graded(0.0, 1.0, 2 * n, 4.0), graded(0.0, 1.0, 3 * n, 4.0)],
        "cross-graded" => [graded(0.0, 1.0, 2 * n, 4.0), graded(0.0, 1.0, 2 * n, 0.25)],
        other => unreachable!("{other}"),
    }
}

/// Energy and traction errors over three halvings.
fn halvings(shape: Shape, name: &str, k: f64, coupled: Coupled) -> [Vec<f64>; 2] {
    let first = if shape.is_quadratic() { 2 } else { 4 };
    let all: Vec<[f64; 2]> = (0..4)
        .map(|load_factor| {
            let x = mesh(name, first << load_factor);
            strip_errors([&x[0], &x[1]], shape, k, coupled)
        })
        .collect();
    [0, 1].map(|i| all.iter().map(|e| e[i]).collect())
}

/// Claim: with `projected` the energy converges with h² (T3, Q4) and h⁴ (T6, Q8) and the interface traction at a mean
/// rate of at least 1.4 and 2.5, on 2:3 and graded meshes, at every stiffness; on 2:3 the errors are at most 1.5 times
/// the published ones.
#[test]
fn case_5b_strip_under_harmonic_pressure() {
    let mut table = Table::new(
        "case05b",
        "Case 5b: two-layer strip under a harmonic pressure, `projected`",
        "Relative error of the energy and of t_n at the law points (L2) over three halvings, rate of the energy over the last two, mean rate of t_n. Edges A:B 8:12 … 64:96 \
         (T3, Q4) and 4:6 … 32:48 (T6, Q8), as many rows; graded: the last edge is 4 times the first.",
        &["element", "edges A:B", "K_N H/E", "energy", "rate", "t_n", "rate"],
    );
    // energy / t_n of the prototypes at 1e4, four meshes
    let published = |shape: Shape| match shape {
        Shape::Triangle3 => Some(([1.5e-2, 4e-3, 1e-3, 2.4e-4], [6e-3, 2e-3, 5e-4, 2e-4])),
        Shape::Quadrilateral8 => Some(([1e-4, 7e-6, 4e-7, 3e-8], [3e-3, 4e-4, 4e-5, 7e-6])),
        _ => None,
    };
    for shape in SHAPES {
        for mesh in ["2:3", "graded 2:3"] {
            for stiffness in [1.0, 1e4, 1e8] {
                let [energy, traction] = halvings(shape, mesh, stiffness * 1e4 / 0.8, PROJECTED);
                let rates = [rate(&energy[1..]), rate(&traction)];
                table.row(&[
                    shape.label().into(),
                    mesh.into(),
                    format!("{stiffness:.0e}"),
                    list(&energy),
                    format!("{:.2}", rates[0]),
                    list(&traction),
                    format!("{:.2}", rates[1]),
                ]);
                let name = format!("{shape:?} {mesh} {stiffness:e}");
                // one cell at either end of a stiff interface is off by h, which is h^1.5 in L2
                let (order, band) = match (shape.is_quadratic(), stiffness > 1.0) {
                    (true, _) => (4.0, 2.8..=3.1),
                    (false, false) => (2.0, 1.95..=2.1),
                    (false, true) => (2.0, 1.5..=2.1),
                };
                assert!((rates[0] - order).abs() < 0.15, "{name}: energy rate {}", rates[0]);
                assert!(band.contains(&rates[1]), "{name}: traction rate {}", rates[1]);
                if mesh == "2:3"
                    && stiffness > 1.0
                    && let Some((e, t)) = published(shape)
                {
                    for i in 0..4 {
                        assert!(
                            energy[i] <= 1.5 * e[i] && traction[i] <= 1.5 * t[i],
                            "{name}: {energy:?} {traction:?}"
                        );
                    }
                }
            }
        }
    }
    table.finish();
}

/// Claim: on a linear grid the traction at the law points of quadratic sides converges with at least h^2.5 on every mesh
/// tried, matched ones included; a quadratic grid, the classical element where the sides match, does so only where the
/// coarser side is Q8 and evenly divided. Hence the default: quadratic between quadrilaterals, linear with triangles.
#[test]
fn case_5b_linear_and_quadratic_grids() {
    let mut table = Table::new(
        "case05b_grids",
        "Case 5b: which grid quadratic sides bear",
        "Relative error of the energy and of t_n at the law points at K_N H/E = 1e4, meshes as above.",
        &["element", "edges A:B", "grid", "energy", "t_n", "rate"],
    );
    for shape in [Shape::Triangle6, Shape::Quadrilateral8] {
        for mesh in ["matched", "2:3", "3:2", "graded 2:3", "cross-graded"] {
            for coupled in [QUADRATIC, LINEAR] {
                let [energy, traction] = halvings(shape, mesh, 1e4 * 1e4 / 0.8, coupled);
                let grid = coupled.grid;
                let of_traction = rate(&traction);
                let label = shape.label().to_string();
                let mut row = vec![label, mesh.into(), grid.into(), list(&energy), list(&traction)];
                row.push(format!("{of_traction:.2}"));
                table.row(&row);
                // a quadratic multiplier is sure of h^1.5 in L2
                let least = if grid == "linear" { 2.5 } else { 1.5 };
                assert!(of_traction >= least, "{shape:?} {mesh} {grid}: {of_traction}");
            }
        }
    }
    table.finish();
}

/// Claim: the discretisation error does not grow with the stiffness of the interface: with `projected` the traction error at
/// K h/E = 800 is below 3 % (5 % at 4:40, 8 % at 40:4) and the same to 1 % from 1e3 to 1e8; `pointwise` is shown beside.
/// The model error against a perfect bond falls with slope −1.
#[test]
fn case_9_stiff_and_soft_limits() {
    let bond = Strip::open(1e30, 1e30).solve().q_top;
    let model: Vec<f64> = (1..=6)
        .map(|i| Strip::open(1e4 / 0.8 * 10f64.powi(i), 1e4 / 0.8 * 10f64.powi(i)).solve().q_top / bond - 1.0)
        .collect();
    for pair in model.windows(2) {
        assert!(((pair[0] / pair[1]).log10() - 1.0).abs() < 0.05, "slope of the model error");
    }
    let mut table = Table::new(
        "case09",
        "Case 9: error of the interface traction against the stiffness of the joint (T3)",
        "Relative L2 error of t_n; h is the largest edge along the joint, E that of the lower layer (as the case has it).",
        &["edges A:B", "coupling", "K h/E = 0.1", "10", "100", "800", "1e3", "1e6", "1e8", "1e10"],
    );
    let cross = [graded(0.0, 1.0, 16, 8.0), graded(0.0, 1.0, 16, 0.125)];
    let meshes: [(&str, [Vec<f64>; 2], f64); 6] = [
        ("16:24", [even(0.0, 1.0, 16), even(0.0, 1.0, 24)], 0.03),
        ("16:17", [even(0.0, 1.0, 16), even(0.0, 1.0, 17)], 0.03),
        ("17:16", [even(0.0, 1.0, 17), even(0.0, 1.0, 16)], 0.03),
        ("16:16 graded 1:8 and 8:1", cross, 0.03),
        ("4:40", [even(0.0, 1.0, 4), even(0.0, 1.0, 40)], 0.05),
        ("40:4", [even(0.0, 1.0, 40), even(0.0, 1.0, 4)], 0.08),
    ];
    for (name, x, limit) in &meshes {
        for coupled in [PROJECTED, POINTWISE] {
            let coupling = coupled.coupling;
            let edges = x.iter().flat_map(|x| x.windows(2).map(|w| w[1] - w[0]));
            let k = 1e4 / edges.fold(0.0, f64::max);
            let error = |number: f64| strip_errors([&x[0], &x[1]], Shape::Triangle3, number * k, coupled)[1];
            let errors = [0.1, 10.0, 100.0, 800.0, 1e3, 1e6, 1e8, 1e10].map(error);
            let mut row = vec![name.to_string(), coupling.into()];
            row.extend(errors.iter().map(|e| format!("{:.2} %", 100.0 * e)));
            table.row(&row);
            if coupling == "projected" {
                assert!(errors[3] <= *limit, "{name}: {}", errors[3]);
                for e in &errors[4..7] {
                    assert!((e / errors[3] - 1.0).abs() < 0.01, "{name}: {errors:?}");
                }
            }
        }
    }
    table.finish();
}
