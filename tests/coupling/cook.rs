//! Claim (case 10): Cook's membrane with a vertical cut at x = 24, joined by springs K_N = K_T = K, deflects at (48, 52) by
//! 24.33974, 27.58830, 56.31659 for K = 1, 0.1, 0.01; Q8 on unmatched 24:40 meshes is within 0.1 %.
//!
//! ```text
//!                    ╱│ 60     E = 1, ν = 1/3, plane stress, clamped on the left,
//!           ╱  │╱     │ ↑      upward shear F/16 on x = 48 (F = 1);
//!    44 ╱     ╱│      │ ↑      24 edges of A and 40 of B on the cut; reference: graded Q8 meshes 24, 48, 96,
//!     ║│   A   │  B  ╱ 44      Richardson, uncertain by 5e-6, 3e-5 and 8e-4
//!     ║│      ╱│╱
//!    0 ╱
//!     0        24     48
//! ```

use crate::common::*;
use midplane::shape::Shape;

#[test]
fn cook_with_a_cut() {
    for (k, exact) in [(1.0, 24.33974197146705), (0.1, 27.588303311771824), (0.01, 56.316590106106034)] {
        let at = |x: f64, y: f64| [x, 44.0 * x / 48.0 + y * (44.0 - 28.0 * x / 48.0)];
        let mesh = |x: [f64; 2], n: usize| {
            rectangle(&even(x[0], x[1], n / 2), &even(0.0, 1.0, n), Shape::Quadrilateral8, at)
        };
        let scene = Scene::new("stress")
            .subdomains(["a", "b"], "m")
            .material("m", 1.0, 1.0 / 3.0)
            .interface("cut", faces("a.right", "b.left").law(elastic(k, k)))
            .step(step("shear").fix("a.left", "xy").traction("b.right", 0, 0.0625));
        let problem = scene.bind(vec![mesh([0.0, 24.0], 24), mesh([24.0, 48.0], 40)]).unwrap();
        let state = solve(&problem).0.remove(0);
        let points = &problem.model.subdomains[1].mesh.points;
        let node = points.iter().position(|p| (p[0] - 48.0).hypot(p[1] - 52.0) < 1e-9).unwrap();
        let got = displacement(&problem, &state, 1, node)[1];
        println!("K = {k}: {got:.5}, exact {exact:.5}, {:+.1e}", got / exact - 1.0);
        close(got, exact, 1e-3, exact, "deflection");
    }
}
