//! Claim: `between` finds the closed curve along which two parts of one mesh touch, and joins it: held as a plate in a
//! linear displacement field, inclusion and plate follow it as if they were one, up to what the stiff interface gives.

use std::f64::consts::PI;

use crate::common::round::ring;
use crate::common::*;
use midplane::shape::Shape;

#[test]
fn two_surfaces_of_one_mesh_are_joined_along_a_circle() {
    let n = 24;
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
        let whole = ring(n, &even(0.5, 2.0, 6), shape, 0.2);
        let inside = |c: &usize| {
            let nodes = whole.cells.nodes(*c);
            let r = |i: &usize| whole.points[*i][0].hypot(whole.points[*i][1]);
            nodes.iter().map(r).sum::<f64>() / (nodes.len() as f64) < 1.0
        };
        let (one, two): (Vec<usize>, Vec<usize>) = (0..whole.cells.len()).partition(inside);
        let (k, e) = (1e10, 1e4);
        // a linear grid would let mid-nodes part
        let [x, y] = ["2e-3*x + 1e-3*y", "3e-4*x - 1e-3*y"];
        let held = |step: Step, group: &str| step.displace(group, "x", x).displace(group, "y", y);
        let scene = Scene::new("strain")
            .subdomains(["core", "plate"], "rock")
            .material("rock", e, 0.2)
            .interface("rim", between("core", "plate").with("grid", "quadratic").law(elastic(k, k)))
            .step(held(held(step("stretch"), "core.bottom"), "plate.top"));
        let problem = scene.bind(vec![whole.part(&one).unwrap(), whole.part(&two).unwrap()]).unwrap();
        let interface = &problem.model.interfaces[0];
        assert_eq!((problem.model.interfaces.len(), interface.name.as_str()), (1, "rim~core~plate"));
        let c = &interface.coupling.midplane;
        assert!(c.pieces.len() == 1 && c.pieces[0].closed && c.segments.len() == n);
        if !shape.is_quadratic() {
            close(c.length, 2.0 * n as f64 * (PI / n as f64).sin(), 1e-14, 1.0, "perimeter");
        }
        let state = solve(&problem).0.remove(0);
        let (limit, scale) = (10.0 * e / (k * PI / n as f64), 2e-3);
        for (b, subdomain) in problem.model.subdomains.iter().enumerate() {
            for (i, [x, y, _]) in subdomain.mesh.points.iter().enumerate() {
                let u = displacement(&problem, &state, b, i);
                close(u[0], 2e-3 * x + 1e-3 * y, limit, scale, &format!("{shape:?} u_x"));
                close(u[1], 3e-4 * x - 1e-3 * y, limit, scale, &format!("{shape:?} u_y"));
            }
        }
    }
}
