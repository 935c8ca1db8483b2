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

const COULOMB: &str = r#""type": "coulomb", "friction_coefficient": 0.8785"#;
const CRACKING: &str = r#""type": "cracking", "tensile_strength": 3, "cohesion": 4, "tan_friction": 0.8785,
    "fracture_energy_i": 2e-4, "fracture_energy_iia": 2e-3, "dilatancy_stress": 0"#;

fn scene(law: &str, coupling: &str, solution: &str) -> String {
    format!(
        r#"{{"plane": "strain",
        "subdomains": {{"lower": {{"msh": "a", "material": "rock"}}, "upper": {{"msh": "b", "material": "rock"}}}},
        "materials": {{"rock": {{"young": 1e4, "poisson": 0.2}}}},
        "interfaces": {{"joint": {{"side_a": "lower.top", "side_b": "upper.bottom", "coupling": "{coupling}",
            "law": {{"normal_stiffness": 1e7, "tangential_stiffness": 1e7, {law}}}}}}},
        "solution": {{{solution}}},
        "steps": [
            {{"name": "compression", "load": {{"upper.top": {{"pressure": 10}}}}, "fix": {{"lower.bottom": ["y"],
              "lower.left": ["x"], "lower.right": ["x"], "upper.left": ["x"], "upper.right": ["x"]}}}},
            {{"name": "shear", "increments": 50,
              "displace": {{"upper.left": {{"x": 1e-3}}, "upper.right": {{"x": 1e-3}}}}}}],
        "output": {{"history": {{"shear": "joint.resultant_t"}}}}}}"#
    )
}

fn layers(lower: usize, upper: usize) -> Vec<Mesh> {
    let layer = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 0.5, n / 2), Shape::Quadrilateral4, |x, y| [x, y])
    };
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
    for (name, law) in [("friction", COULOMB), ("cracking", CRACKING)] {
        for (coupling, strategy) in
            [("projected", "condensed"), ("pointwise", "condensed"), ("projected", "plain")]
        {
            let text = scene(law, coupling, &format!(r#""strategy": "{strategy}""#));
            let problem = bind(&text, layers(36, 24)).unwrap();
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
        let problem = bind(&scene(COULOMB, coupling, ""), layers(84, 56)).unwrap();
        let (states, _) = solve(&problem);
        let shear = states[50].probes(&problem)[0];
        close(shear, 7.8877, tolerance, 7.8877, coupling);
    }
}

#[test]
fn both_forms_agree() {
    for law in [COULOMB, CRACKING] {
        for coupling in ["projected", "pointwise"] {
            let run = |strategy: &str| {
                let text = scene(law, coupling, &format!(r#""strategy": "{strategy}""#));
                solve(&bind(&text, layers(12, 8)).unwrap()).0
            };
            let (condensed, plain) = (run("condensed"), run("plain"));
            for (i, (a, b)) in condensed.iter().zip(&plain).enumerate() {
                let what = format!("{law:.25} {coupling}, increment {i}");
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
