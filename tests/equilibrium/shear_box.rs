//! Claim: a layer sheared over another, with friction or cracking, is found in few iterations, quadratically, equal in
//! both forms of the equations, with the energy in balance.
//!
//! ```text
//!       p = 10 MPa
//!     ┌───────────┐
//!   → │   upper   │ →  u_x = 1 mm on both sides, in 50 increments
//!     ├───────────┤    K_N = K_T = 1e7 MPa/m
//!     │   lower   │    u_x = 0 on both sides
//!     └─△───△───△─┘
//! ```
//!
//! Total shear with friction at 84:56 edges: 7.8877 MN/m, of an independent program with its own Newton.

use crate::common::table::Table;
use crate::common::*;
use midplane::mesh::Mesh;
use midplane::shape::Shape;

fn friction() -> Law {
    coulomb(1e7, 1e7, 0.8785)
}

fn rock() -> Law {
    cracking(1e7, 1e7, [3.0, 4.0, 0.8785], [2e-4, 2e-3])
}

fn scene(law: Law, coupling: &str) -> Scene {
    let compression = step("compression").pressure("upper.top", 10).fix("lower.bottom", "y");
    let sides = ["lower.left", "lower.right", "upper.left", "upper.right"];
    let shear = step("shear").increments(50);
    Scene::new("strain")
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.2)
        .interface("joint", faces("lower.top", "upper.bottom").coupling(coupling).law(law))
        .step(sides.into_iter().fold(compression, |step, side| step.fix(side, "x")))
        .step(shear.displace("upper.left", "x", 1e-3).displace("upper.right", "x", 1e-3))
        .probe("shear", "joint.resultant_t")
}

fn layers(lower: usize, upper: usize) -> Vec<Mesh> {
    let layer = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 0.5], [n, n / 2], Shape::Quadrilateral4);
    vec![layer(lower, -0.5), layer(upper, 0.0)]
}

#[test]
fn iterations_are_few_and_quadratic() {
    let mut table = Table::new(
        "newton_box",
        "Newton's method: the shear box",
        "50 increments of shear, 36:24 edges: mean and largest number of iterations, largest energy imbalance, and the relative residuals of the hardest increment.",
        &["law", "coupling", "form", "mean", "most", "balance", "residuals of the hardest increment"],
    );
    for (name, law) in [("friction", friction()), ("cracking", rock())] {
        for (coupling, strategy) in
            [("projected", "condensed"), ("pointwise", "condensed"), ("projected", "plain")]
        {
            let scene = scene(law.clone(), coupling).solution("strategy", strategy);
            let problem = scene.bind(layers(36, 24)).unwrap();
            let march = try_solve(&problem);
            let totals = march.end.unwrap();
            let what = format!("{name} {coupling} {strategy}");
            let shear = &march.iterations[1..];
            let (mean, most) = (shear.iter().sum::<usize>() as f64 / 50.0, *shear.iter().max().unwrap());
            let hardest = march.states.iter().max_by_key(|state| state.residuals.len()).unwrap();
            let residuals = &hardest.residuals;
            table.row(&[
                name.into(),
                coupling.into(),
                strategy.into(),
                format!("{mean:.2}"),
                most.to_string(),
                format!("{:.0e}", totals.energy_balance),
                residuals.iter().map(|r| format!("{r:.0e}")).collect::<Vec<_>>().join(" "),
            ]);
            assert!(totals.rejected <= 4, "{what}: {}", totals.rejected);
            // the first increment is divided: points begin to slide or crack in it
            assert!(mean <= 4.0 && shear[1..].iter().all(|&n| n <= 8), "{what}: {:?}", march.iterations);
            assert!(totals.energy_balance < 5e-3, "{what}: {:e}", totals.energy_balance);
            // with friction the last step is exact, with cracking each squares the one before, once it is near
            for pair in residuals.windows(2).filter(|pair| pair[0] < 1e-4 && pair[0] > 1e-10) {
                assert!(pair[1] < 1e3 * pair[0] * pair[0] + 1e-13, "{what}: {residuals:?}");
            }
        }
    }
    table.finish();
}

#[test]
fn the_total_shear_is_that_of_an_independent_program() {
    for (coupling, tolerance) in [("pointwise", 1e-4), ("projected", 3e-4)] {
        let problem = scene(friction(), coupling).bind(layers(84, 56)).unwrap();
        let (states, _) = solve(&problem);
        let shear = states[50].probes(&problem)[0];
        close(shear, 7.8877, tolerance, 7.8877, coupling);
    }
}

#[test]
fn both_forms_agree() {
    for law in [friction(), rock()] {
        for coupling in ["projected", "pointwise"] {
            let run = |strategy: &str| {
                let scene = scene(law.clone(), coupling).solution("strategy", strategy);
                solve(&scene.bind(layers(12, 8)).unwrap()).0
            };
            let (condensed, plain) = (run("condensed"), run("plain"));
            for (i, (a, b)) in condensed.iter().zip(&plain).enumerate() {
                let what = format!("{law} {coupling}, increment {i}");
                let largest = b.snapshot.u.iter().map(|u| u.abs()).fold(0.0, f64::max);
                a.snapshot
                    .u
                    .iter()
                    .zip(&b.snapshot.u)
                    .for_each(|(a, b)| close(*a, *b, 1e-10, largest, &what));
                let [a, b] = [a, b].map(|state| state.snapshot.tractions[0].iter().flatten());
                let largest = b.clone().map(|t| t.abs()).fold(0.0, f64::max);
                a.zip(b).for_each(|(a, b)| close(*a, *b, 1e-9, largest, &what));
            }
        }
    }
}
