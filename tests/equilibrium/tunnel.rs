//! Claim: what is dug out of ground under stress moves it as Kirsch says, and a lining that comes half-way carries what
//! convergence and confinement say.
//!
//! ```text
//! dug     u_r = −(1 + ν) a/E [(p_h + p_v)/2 + (3 − 4 ν)(p_h − p_v)/2 cos 2θ]        from the state before
//!         σ_θ = −(p_h + p_v) + 2 (p_h − p_v) cos 2θ                                 at the wall
//! lined   p_s (1/k_l + 1/K) = (p − p_s)/k_g − u₀,  u₀ = p/2k_g, k_g = E/((1 + ν) a)
//!         k_l: thick ring under outer pressure (Lamé)
//! ```

use crate::common::round::quarter;
use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::json;

const A: f64 = 3.0;
const E: f64 = 150.0;
const NU: f64 = 0.3;
const LINING: (f64, f64, f64) = (3e4, 0.2, 2.7);
const K: f64 = 1e5;
const FAR: f64 = 60.0;

/// A quarter of the ground, of a part of the core, and of a lining; the core's inner edge is held by its own stress.
fn quarters(n: usize) -> Vec<Mesh> {
    let rows = 2 * n;
    let radii: Vec<f64> = (0..=rows).map(|k| A * FAR.powf(k as f64 / rows as f64)).collect();
    vec![
        quarter(n, &radii, Shape::Quadrilateral8),
        quarter(n - 3, &even(0.5 * A, A, 4), Shape::Quadrilateral8),
        quarter(n + 5, &even(LINING.2, A, 3), Shape::Quadrilateral8),
    ]
}

/// The ground under its stress, before anything is dug.
fn tunnel(n: usize, [ph, pv]: [f64; 2], steps: impl IntoIterator<Item = Step>) -> Problem {
    let stress = json!({ "xx": -ph, "yy": -pv, "zz": -NU * (ph + pv) });
    let stressed = |name: &str| mesh(name, "ground").with("initial_stress", stress.clone());
    let r = 0.5 * A;
    let ground = step("ground")
        .fix("ground.top", "xy")
        .fix("ground.left", "x")
        .fix("ground.right", "y")
        .fix("core.left", "x")
        .fix("core.right", "y")
        .traction("core.bottom", format!("{ph}*x/{r}"), format!("{pv}*y/{r}"));
    let scene = Scene::new("strain")
        .body("ground", stressed("ground"))
        .body("core", stressed("core"))
        .subdomain("lining", "concrete")
        .material("ground", E, NU)
        .material("concrete", LINING.0, LINING.1)
        .interface("rim", faces("ground.bottom", "core.top").law(elastic(K, K)))
        .interface("back", faces("ground.bottom", "lining.top").law(coulomb(K, K, 0.3)))
        .step(ground)
        .steps(steps);
    scene.bind(quarters(n)).unwrap()
}

/// A step in which the lining comes.
fn lined(name: &str) -> Step {
    step(name).activate(["lining"]).fix("lining.left", "x").fix("lining.right", "y")
}

/// Radial displacement and hoop stress at the wall where it meets an axis.
fn wall(problem: &Problem, state: &ModelState, axis: &str) -> (f64, f64) {
    let mesh = &problem.model.subdomains[0].mesh;
    let d = usize::from(axis == "left");
    let nodes = group(problem, 0, axis);
    let near = |n: &usize| mesh.points[*n][d];
    let node = nodes.into_iter().min_by(|p, q| near(p).total_cmp(&near(q))).unwrap();
    (displacement(problem, state, 0, node)[d], state.snapshot.stresses[0].nodes[node][1 - d])
}

#[test]
fn a_circle_is_dug_as_kirsch_says() {
    let [ph, pv] = [0.6, 1.0];
    for n in [8, 24] {
        // the lining comes too late
        let dig = step("dig").increments(2).deactivate("core", 1);
        let problem = tunnel(n, [ph, pv], [dig, lined("late")]);
        let (states, _) = solve(&problem);
        let (before, dug) = (&states[0], &states[2]);
        // arcs of different chords leave a rest
        assert!(wall(&problem, before, "left").0.abs() < 1e-5 * A, "it stays as it is");
        for (axis, cos) in [("right", 1.0), ("left", -1.0)] {
            let (u, hoop) = wall(&problem, dug, axis);
            let mean = 0.5 * (ph + pv) + (3.0 - 4.0 * NU) * 0.5 * (ph - pv) * cos;
            let exact = -(1.0 + NU) * A / E * mean;
            let exact_hoop = -(ph + pv) + 2.0 * (ph - pv) * cos;
            println!("n {n} {axis}: u {u:.6} of {exact:.6}, σ_θ {hoop:.4} of {exact_hoop:.4}");
            if n == 24 {
                close(u, exact, 5e-3, exact, "displacement of the wall");
                close(hoop, exact_hoop, 5e-3, exact_hoop, "hoop stress at the wall");
            }
        }
        assert!(dug.energy_balance().abs() < 1e-9, "{}", dug.energy_balance());
    }
}

#[test]
fn a_lining_that_comes_half_way_carries_what_is_left() {
    let p = 0.8;
    let steps = [
        step("dig").deactivate("core", 0.5),
        lined("line"),
        step("let go").increments(4).deactivate("core", 1.0),
    ];
    let problem = tunnel(12, [p, p], steps);
    let (states, _) = solve(&problem);
    let (young, nu, inner) = LINING;
    let soft = (1.0 + nu) / young * A * ((1.0 - 2.0 * nu) * A * A + inner * inner) / (A * A - inner * inner);
    let ground = (1.0 + NU) * A / E;
    let exact = 0.5 * p * ground / (ground + soft + 1.0 / K);
    let half = &states[1];
    close(wall(&problem, half, "left").0, -0.5 * p * ground, 5e-3, p * ground, "half is dug");
    let lined = &states[2];
    assert!(lined.snapshot.tractions[1].iter().all(|t| t.norm() < 1e-9), "it comes free of stress");
    let last = states.last().unwrap();
    for t in &last.snapshot.tractions[1] {
        close(t[0], -exact, 1e-2, exact, "pressure on the lining");
    }
    close(
        wall(&problem, last, "right").0,
        -(p - exact) * ground,
        5e-3,
        p * ground,
        "the ground has come to rest",
    );
    println!("pressure on the lining {:.5} of {exact:.5}", -last.snapshot.tractions[1][3][0]);
}

/// Claim: joints of a ring that patterns make run the same way, whatever the order of its parts: side A before B counter-clockwise, and all
/// from the outside inwards or all the other way round.
#[test]
fn sisters_of_a_ring_run_the_same_way() {
    let folder = tempfile::tempdir().unwrap();
    let scene = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/tunnel");
    let mut options = midplane::run::Options::of(&scene);
    options.out = Some(folder.path().join("out"));
    let problem = midplane::run::prepare(&options, &mut |_| ()).unwrap().problem;
    let centre = |b: usize| -> [f64; 2] {
        let points = &problem.model.subdomains[b].mesh.points;
        [0, 1].map(|d| points.iter().map(|x| x[d]).sum::<f64>() / points.len() as f64)
    };
    let radial = problem.model.interfaces.iter().filter(|interface| interface.name.starts_with("radial~"));
    let inwards: Vec<bool> = radial
        .map(|interface| {
            let [a, b] = interface.subdomains.map(centre);
            assert!(a[0] * b[1] - a[1] * b[0] > 0.0, "{}", interface.name);
            let points = &interface.coupling.points;
            let radius = |k: usize| points[k].position[0].hypot(points[k].position[1]);
            radius(points.len() - 1) < radius(0)
        })
        .collect();
    assert_eq!(inwards.len(), 6);
    assert!(inwards.iter().all(|way| *way == inwards[0]), "{inwards:?}");
}
