//! Claim: general constant-stress patch, two materials, turned by 30°: the exact displacement on the outer boundary, as linear
//! formulas, gives the exact stress, traction and jump on any two meshes.
//!
//! ```text
//!   n ↑   ┌──── B ────┐ 0.7     s_nn, s_nt common; e_tt common
//!     └→t ├───────────┤ 0       side i: e_nn = (s_nn − λ e_tt)/(λ + 2μ), s_tt = (λ + 2μ) e_tt + λ e_nn
//!         └──── A ────┘ −0.5    u_t = e_tt t + (s_nt/μ) n, u_n = e_nn n; B adds (s_nt/K_T, s_nn/K_N)
//! ```

use crate::common::table::Table;
use crate::common::*;
use midplane::shape::Shape;

#[test]
fn a_constant_stress_passes_any_two_meshes() {
    let mut table = Table::new(
        "case01b",
        "Case 1b: constant stress of two materials, turned by 30°",
        "Largest relative error over the meshes 7:11 and 1:37.",
        &["element", "coupling", "displacement", "stress", "traction"],
    );
    let (snn, snt, ett, kn, kt) = (-6.0, 2.5, 3e-4, 2e5, 5e4);
    let (sin, cos) = f64::to_radians(30.0).sin_cos();
    let sides = [(1e4, 0.2, 0.0), (4e3, 0.35, 1.0)].map(|(e, nu, jump)| {
        let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
        let enn = (snn - lambda * ett) / (lambda + 2.0 * mu);
        let stt = (lambda + 2.0 * mu) * ett + lambda * enn;
        let stress = [
            cos * cos * stt - 2.0 * sin * cos * snt + sin * sin * snn,
            sin * sin * stt + 2.0 * sin * cos * snt + cos * cos * snn,
            sin * cos * (stt - snn) + (cos * cos - sin * sin) * snt,
        ];
        let (t, n) = (format!("({cos}*x + {sin}*y)"), format!("({cos}*y - {sin}*x)"));
        let ut = format!("({ett}*{t} + {snt}/{mu}*{n} + {})", jump * snt / kt);
        let un = format!("({enn}*{n} + {})", jump * snn / kn);
        let formulas = [format!("{cos}*{ut} - {sin}*{un}"), format!("{sin}*{ut} + {cos}*{un}")];
        let exact = move |[x, y]: [f64; 2]| {
            let (t, n) = (cos * x + sin * y, cos * y - sin * x);
            let (ut, un) = (ett * t + snt / mu * n + jump * snt / kt, enn * n + jump * snn / kn);
            [cos * ut - sin * un, sin * ut + cos * un]
        };
        (stress, formulas, exact)
    });
    // the values of an independent reference
    close(sides[0].0[0], -2.446313509461096, 1e-13, 1.0, "A.sxx");
    close(sides[1].0[2], 3.041266219793455, 1e-13, 1.0, "B.sxy");
    close((sides[0].2)([0.3, -0.2])[0], -0.0002258086107868756, 1e-13, 1e-3, "A.u_x");
    close((sides[1].2)([-0.1, 0.4])[1], -2.5811077100468087e-05, 1e-13, 1e-3, "B.u_y");

    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
        for coupling in ["projected", "pointwise"] {
            let mut worst = [0.0_f64; 3];
            for (a, b) in [(7, 11), (1, 37)] {
                let displace = |go: Step, side: usize, groups: [&str; 3]| {
                    let [x, y] = &sides[side].1;
                    groups.into_iter().fold(go, |go, group| {
                        go.displace(group, "x", x.as_str()).displace(group, "y", y.as_str())
                    })
                };
                let go = displace(step("go"), 0, ["a.left", "a.bottom", "a.right"]);
                let scene = Scene::new("strain")
                    .subdomain("a", "hard")
                    .subdomain("b", "soft")
                    .material("hard", 1e4, 0.2)
                    .material("soft", 4e3, 0.35)
                    .interface("joint", faces("a.top", "b.bottom").coupling(coupling).law(elastic(kn, kt)))
                    .step(displace(go, 1, ["b.left", "b.top", "b.right"]));
                let mesh = |n, ys: &[f64]| rectangle(&even(-0.5, 0.5, n), ys, shape, rotation(30.0));
                let meshes = vec![mesh(a, &even(-0.5, 0.0, 4)), mesh(b, &even(0.0, 0.7, 6))];
                let problem = scene.bind(meshes).unwrap();
                let (states, _) = solve(&problem);
                let snapshot = &states[0].snapshot;
                let case = format!("{shape:?} {a}:{b} {coupling}");
                for (subdomain, (stress, _, exact)) in sides.iter().enumerate() {
                    for (node, &[x, y, _]) in
                        problem.model.subdomains[subdomain].mesh.points.iter().enumerate()
                    {
                        let x = [x, y];
                        let u = displacement(&problem, &states[0], subdomain, node);
                        for d in 0..2 {
                            close(u[d], exact(x)[d], 1e-10, 1e-3, &case);
                            worst[0] = worst[0].max((u[d] - exact(x)[d]).abs() / 1e-3);
                        }
                    }
                    for cell in &snapshot.stresses[subdomain].cells {
                        let [xx, yy, _, xy] = *cell;
                        for (got, exact) in [xx, yy, xy].into_iter().zip(*stress) {
                            close(got, exact, 1e-10, 6.0, &case);
                            worst[1] = worst[1].max((got - exact).abs() / 6.0);
                        }
                    }
                }
                for (r, t) in snapshot.jumps[0].iter().zip(&snapshot.tractions[0]) {
                    close(r[0], -3e-5, 1e-10, 5e-5, &case);
                    close(r[1], 5e-5, 1e-10, 5e-5, &case);
                    close(t[0], snn, 1e-10, 6.0, &case);
                    close(t[1], snt, 1e-10, 6.0, &case);
                    worst[2] = worst[2].max((t[0] - snn).abs() / 6.0).max((t[1] - snt).abs() / 6.0);
                }
            }
            let cells = [shape.label(), coupling].map(String::from).into_iter();
            table.row(&cells.chain(worst.map(|e| format!("{e:.1e}"))).collect::<Vec<_>>());
        }
    }
    table.finish();
}
