//! Claim: water in a joint pushes its sides apart and leaves the law the effective traction; imposed, it may follow the opening and
//! the damage, and goes over from step to step like any load, in every form and along every path.
//!
//! ```text
//!     ↓ P   ┌───────┐          effective t = p − P,  total −P,  r_n = (p − P)/K
//!           │   b   │          p(r) = p₁ ramp(r, 0, w):   r = −P/(K − p₁/w),  pulled
//!     p ↕   └───────┘          p(r) = c r²:               K r − c r² = −P,    pulled
//!           ┌───────┐          p = p₁ D, damage D of the law itself
//!           └───a───┘          work.water = ∫ p dr
//! ```

use crate::common::*;
use midplane::history::{ModelState, Totals};
use midplane::problem::Problem;
use midplane::shape::Shape;

const E: f64 = 1e4;
const K: f64 = 1e4;
const ELASTIC: &str = r#"{ "type": "elastic", "normal_stiffness": 1e4, "tangential_stiffness": 5e3 }"#;
const COULOMB: &str = r#"{ "type": "coulomb", "normal_stiffness": 1e4, "tangential_stiffness": 5e3, "friction_coefficient": 0.5 }"#;
const COHESIVE: &str = r#"{ "type": "cohesive", "normal_stiffness": 1e4, "tangential_stiffness": 5e3,
    "tensile_strength": 2, "shear_strength": 3, "fracture_energy_i": 2e-3, "fracture_energy_ii": 4e-3 }"#;
const CRACKING: &str = r#"{ "type": "cracking", "normal_stiffness": 1e4, "tangential_stiffness": 5e3,
    "tensile_strength": 2, "cohesion": 3, "tan_friction": 0.7, "fracture_energy_i": 2e-3, "fracture_energy_iia": 4e-3,
    "dilatancy_stress": 0 }"#;
const PROBES: &str = r#""n": "joint.resultant_n", "total": "joint.total_resultant_n", "uplift": "joint.uplift",
    "work": "work.water", "p": "joint.pressure@0.3", "t": "joint.traction_n@0.3", "both": "joint.traction_total_n@0.3",
    "shear": "joint.traction_total_t@0.3", "r": "joint.jump_n@0.3", "external": "work.external""#;

/// Two blocks of 1 m × 0.5 m on top of each other, held at the bottom and sideways, with a joint between.
fn blocks(law: &str, solution: &str, steps: &[String]) -> midplane::error::Result<Problem> {
    let text = format!(
        r#"{{ "plane": "strain",
          "subdomains": {{ "a": {{ "msh": "a", "material": "rock" }}, "b": {{ "msh": "b", "material": "rock" }} }},
          "materials": {{ "rock": {{ "young": {E}, "poisson": 0 }} }},
          "interfaces": {{ "joint": {{ "side_a": "a.top", "side_b": "b.bottom", "law": {law} }} }},
          "solution": {{ {solution} }},
          "steps": [ {} ],
          "output": {{ "history": {{ {PROBES} }} }} }}"#,
        steps.join(", ")
    );
    let block = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 0.5, 3), Shape::Quadrilateral4, |x, y| [x, y])
    };
    bind(&text, vec![block(4, -0.5), block(7, 0.0)])
}

fn step(name: &str, increments: usize, loads: &str) -> String {
    format!(
        r#"{{ "name": "{name}", "increments": {increments}, "fix": {{ "a.bottom": ["x", "y"], "a": ["x"], "b": ["x"] }},
            "load": {{ {loads} }} }}"#
    )
}

fn strategy(name: &str) -> String {
    format!(r#""strategy": "{name}""#)
}

/// Normal jumps, effective tractions and pressures at the law points.
fn values(state: &ModelState) -> Vec<[f64; 3]> {
    let snapshot = &state.snapshot;
    let points = snapshot.jumps[0].iter().zip(&snapshot.tractions[0]).zip(&snapshot.water.pressures[0]);
    points.map(|((jump, traction), pressure)| [jump[0], traction[0], *pressure]).collect()
}

#[test]
fn a_pressure_is_what_the_effective_traction_lacks_to_the_total() {
    let steps = [
        step("both", 2, r#""b.top": { "pressure": 3 }, "joint": { "pressure": 1.2 }"#),
        step("more water", 2, r#""joint": { "pressure": "2*(1 + s)/1.5 - 0*x" }"#),
        step("none", 1, r#""joint": { "pressure": 0 }"#),
    ];
    for law in [ELASTIC, COULOMB] {
        for name in ["condensed", "blocks", "plain"] {
            let problem = blocks(law, &strategy(name), &steps[..1]).unwrap();
            let (states, totals) = solve(&problem);
            assert_eq!(totals.iterations, if law == ELASTIC { 0 } else { 2 }, "{name}");
            for (state, part) in states.iter().zip([0.5, 1.0]) {
                for [jump, traction, pressure] in values(state) {
                    close(pressure, 1.2 * part, 1e-14, 1.0, "p");
                    close(traction, -1.8 * part, 1e-11, 1.0, "effective");
                    close(jump, -1.8 * part / K, 1e-11, 1e-4, "jump");
                }
                let [n, total, uplift, work, p, t, both, shear, _, external] = probes(&problem, state);
                close(n, -1.8 * part, 1e-11, 1.0, "resultant_n");
                close(total, -3.0 * part, 1e-11, 1.0, "total_resultant_n");
                close(uplift, 1.2 * part, 1e-14, 1.0, "uplift");
                close(work, -0.5 * 1.2 * 1.8 / K * part * part, 1e-11, 1e-4, "work.water");
                close(t - both, 1.2 * part, 1e-11, 1.0, "total at a place");
                close(p, 1.2 * part, 1e-14, 1.0, "p at a place");
                close(shear, 0.0, 1e-11, 1.0, "shear");
                // P over both blocks, and the joint
                let way = 3.0 / E + 1.8 / K;
                let exact = part * part * (0.5 * 3.0 * way - 0.5 * 1.2 * 1.8 / K);
                close(external, exact, 1e-11, 1e-4, "work.external");
            }
            assert!(totals.energy_balance < 1e-10 && totals.imbalance < 1e-10, "{totals:?}");
        }
    }
    // the second step ramps from 1.2 to a formula of the place, the third to nothing: totals stay
    let problem = blocks(ELASTIC, "", &steps).unwrap();
    let (states, _) = solve(&problem);
    for (row, uplift) in [(2, 0.5 * (1.2 + 2.0)), (3, 2.0), (4, 0.0)] {
        let [n, total, found, ..] = probes(&problem, &states[row]);
        close(found, uplift, 1e-12, 1.0, "uplift");
        close(total, -3.0, 1e-11, 1.0, "total");
        close(n, uplift - 3.0, 1e-11, 1.0, "effective");
    }
}

fn probes(problem: &Problem, state: &ModelState) -> [f64; 10] {
    state.probes(problem).first_chunk().copied().unwrap()
}

/// Iterations are few and the residual falls as its square in the last but one.
fn converges_quadratically(state: &ModelState, totals: &Totals) {
    let residuals = &state.residuals;
    assert!(residuals.len() <= 8, "{residuals:?}");
    assert!(totals.rejected == 0, "{totals:?}");
    let near: Vec<&[f64]> = residuals.windows(2).filter(|pair| pair[0] < 1e-2 && pair[1] > 1e-13).collect();
    for pair in near {
        assert!(pair[1] < 20.0 * pair[0] * pair[0], "{residuals:?}");
    }
}

#[test]
fn a_pressure_that_follows_the_opening_has_its_own_stiffness() {
    let (pull, p1, w) = (0.8, 2.0, 4e-4);
    for law in [ELASTIC, COHESIVE, CRACKING] {
        for name in ["condensed", "blocks", "plain"] {
            // linear: K − p₁/w
            let formula = format!(
                r#""b.top": {{ "pressure": -{pull} }}, "joint": {{ "pressure": "{p1}*ramp(opening, 0, {w})" }}"#
            );
            let problem = blocks(law, &strategy(name), &[step("pull", 3, &formula)]).unwrap();
            let (states, totals) = solve(&problem);
            let before = totals.clone();
            // the load and the pressure ramp alike: K r = λ (P + p₁ r/w)
            for (state, part) in states.iter().zip([1.0 / 3.0, 2.0 / 3.0, 1.0]) {
                let exact = part * pull / (K - part * p1 / w);
                for [jump, traction, pressure] in values(state) {
                    close(jump, exact, 1e-9, 1e-4, &format!("{name} jump"));
                    close(traction, K * exact, 1e-9, 1.0, "effective");
                    close(pressure, part * p1 * exact / w, 1e-9, 1.0, "pressure");
                }
            }
            assert!(totals.energy_balance < 2e-4, "{totals:?}");
            // kept while the load grows it is linear: no part is divided
            let more = format!(r#""b.top": {{ "pressure": -{} }}"#, 1.1 * pull);
            let steps = [step("pull", 3, &formula), step("more", 1, &more)];
            let (states, totals) = solve(&blocks(law, &strategy(name), &steps).unwrap());
            assert!(states.len() == 4 && totals.parts - before.parts == 1, "{totals:?}");
            // a parabola
            let c = 1.5e7;
            let formula =
                format!(r#""b.top": {{ "pressure": -{pull} }}, "joint": {{ "pressure": "{c}*opening^2" }}"#);
            let problem = blocks(
                law,
                &format!(r#""strategy": "{name}", "path_tolerance": 1"#),
                &[step("pull", 1, &formula)],
            );
            let problem = problem.unwrap();
            let (states, totals) = solve(&problem);
            let exact = (K - (K * K - 4.0 * c * pull).sqrt()) / (2.0 * c);
            values(&states[0]).iter().for_each(|[jump, ..]| close(*jump, exact, 1e-9, 1e-4, name));
            converges_quadratically(&states[0], &totals);
        }
    }
}

#[test]
fn formulas_of_the_load_factor_and_steps_go_over_as_loads_do() {
    let steps = [
        step("a", 2, r#""b.top": { "pressure": 3 }, "joint": { "pressure": "load_factor*(1 + 0*opening)" }"#),
        step("b", 2, r#""joint": { "pressure": 2 }"#),
        step("c", 2, r#""b.top": { "pressure": 4 }"#),
        step("d", 2, r#""joint": { "pressure": "0.5 + 2*damage + 0*load_factor" }"#),
        step("e", 2, r#""jo*": { "pressure": "if(opening > 0, 9, 1)" }"#),
    ];
    let problem = blocks(COHESIVE, "", &steps).unwrap();
    let (states, totals) = solve(&problem);
    for (k, (p, total)) in [
        (0.5, 1.5),
        (1.0, 3.0),
        (1.5, 3.0),
        (2.0, 3.0),
        (2.0, 3.5),
        (2.0, 4.0),
        (0.5, 4.0),
        (0.5, 4.0),
        (0.75, 4.0),
        (1.0, 4.0),
    ]
    .into_iter()
    .enumerate()
    {
        let [n, all, uplift, ..] = probes(&problem, &states[k]);
        close(uplift, p, 1e-11, 1.0, &format!("uplift of row {k}"));
        close(all, -total, 1e-10, 1.0, "total");
        close(n, p - total, 1e-10, 1.0, "effective");
    }
    assert!(totals.energy_balance < 1e-9 && totals.imbalance < 1e-9, "{totals:?}");
}

/// Claim: pulled by its end, a joint that loses its strength carries f_t (1 − W/G) and the water follows the damage.
#[test]
fn a_pressure_follows_the_damage_of_the_law() {
    for law in [COHESIVE, CRACKING] {
        for control in ["load", "auto", "arclength"] {
            let steps = [format!(
                r#"{{ "name": "pull", "increments": 20, "control": "{control}",
                    "fix": {{ "a.bottom": ["x", "y"], "a": ["x"], "b": ["x"] }},
                    "displace": {{ "b.top": {{ "y": 4e-3 }} }}, "load": {{ "joint": {{ "pressure": "0.9*damage" }} }} }}"#
            )];
            let problem = blocks(law, r#""path_tolerance": 1e-4"#, &steps).unwrap();
            let march = try_solve(&problem);
            let totals = march.end.unwrap();
            for (state, load_factor) in march.states.iter().zip(&march.load_factors) {
                for (p, [_, traction, pressure]) in values(state).into_iter().enumerate() {
                    let own = &state.snapshot.states[0][p];
                    let damage = problem.interfaces[0].laws.at(p).damage(own).unwrap();
                    close(pressure, 0.9 * damage * load_factor, 1e-12, 1.0, "pressure");
                    // both bodies stretch under the total traction
                    let stretch = load_factor * 4e-3 - state.snapshot.jumps[0][p][0];
                    close(traction - pressure, E * stretch, 1e-8, 1.0, "total traction");
                }
            }
            let last = march.states.last().unwrap();
            let damage = problem.interfaces[0].laws.at(0).damage(&last.snapshot.states[0][0]).unwrap();
            assert!(damage > 0.9, "{damage}");
            if law == COHESIVE {
                close(last.dissipated, 2e-3 * damage, 1e-3, 2e-3, &format!("{control}: dissipated"));
            }
            assert!(totals.energy_balance < 1e-3, "{control} {totals:?}");
        }
    }
}

/// Claim: the slope of the damage is in the tangent too.
#[test]
fn a_pressure_of_the_damage_converges_quadratically() {
    for law in [COHESIVE, CRACKING] {
        let steps = [
            r#"{ "name": "pull", "increments": 1, "fix": { "a.bottom": ["x", "y"], "a": ["x"], "b": ["x"] },
                "displace": { "b.top": { "y": 1e-3 } }, "load": { "joint": { "pressure": "0.9*damage" } } }"#
                .to_string(),
        ];
        let problem = blocks(law, r#""path_tolerance": 1"#, &steps).unwrap();
        let (states, totals) = solve(&problem);
        converges_quadratically(&states[0], &totals);
        let state = &states[0];
        let damage = problem.interfaces[0].laws.at(0).damage(&state.snapshot.states[0][0]).unwrap();
        assert!((0.3..0.95).contains(&damage), "{damage}");
    }
}

/// Claim: a cohesive joint under a growing load and water that grows with its opening: λ = t(r)/(P + p(r)) along the whole path,
/// also where it falls, and as much with the uniform pressure of flow.
#[test]
fn a_path_goes_on_where_the_load_must_fall() {
    let (kn, ft, g, pull) = (1e4, 2.0, 2e-3, 3.0);
    let (onset, last) = (ft / kn, 2.0 * g / ft);
    // linear softening
    let law = |r: f64| if r < onset { kn * r } else { (ft * (last - r) / (last - onset)).max(0.0) };
    let wet = |r: f64| 1.5 * (r / 1e-3).clamp(0.0, 1.0) + 0.2;
    let flow = r#"{ "flow": { "aperture": 1e-6, "viscosity": 1, "ends": [0.7, 0.7] } }"#;
    let cases: [(&str, &dyn Fn(f64) -> f64); 2] =
        [(r#""1.5*ramp(opening, 0, 1e-3) + 0.2""#, &wet), (flow, &|_| 0.7)];
    for (pressure, p) in cases {
        for control in ["auto", "arclength"] {
            let loads =
                format!(r#""b.top": {{ "pressure": -{pull} }}, "joint": {{ "pressure": {pressure} }}"#);
            let control = format!("\"control\": \"{control}\", \"increments\"");
            let steps = [step("pull", 30, &loads).replace("\"increments\"", &control)];
            let problem = blocks(COHESIVE, r#""path_tolerance": 1e-4"#, &steps).unwrap();
            let march = try_solve(&problem);
            let (mut most, mut fell) = (0.0_f64, false);
            for (state, load_factor) in march.states.iter().zip(&march.load_factors) {
                for [jump, traction, pressure] in values(state) {
                    close(pressure, load_factor * p(jump), 1e-10, 1.0, "pressure");
                    close(traction, law(jump), 1e-8, ft, "law");
                    close(*load_factor * (pull + p(jump)), law(jump), 1e-8, ft, &format!("{control}: load"));
                }
                fell |= *load_factor < most;
                most = most.max(*load_factor);
            }
            let deepest = values(march.states.last().unwrap())[0][0];
            assert!(fell && deepest > 0.9 * last, "{control}: {deepest} of {last}, most {most}");
        }
    }
}

#[test]
fn what_a_pressure_cannot_be_is_refused() {
    for (law, loads, words) in [
        (ELASTIC, r#""joint": { "traction": [1, 0] }"#, "\"joint\" is an interface; give it a \"pressure\""),
        (
            ELASTIC,
            r#""joints": { "pressure": 1 }"#,
            "no subdomain or interface \"joints\"; there is a, b, joint. Did you mean \"joint\"?",
        ),
        (ELASTIC, r#""j?": { "pressure": 1 }"#, "no interface is called like \"j?\"; there is joint"),
        (
            ELASTIC,
            r#""joint": { "pressure": "damage" }"#,
            "damage in \"damage\", but the law of joint has none",
        ),
        (COHESIVE, r#""joint": { "pressure": 1 }, "j*": { "pressure": 2 }"#, "both give joint a pressure"),
        (
            ELASTIC,
            r#""b.top": { "pressure": "opening" }"#,
            "only the pressure in an interface knows its opening and damage",
        ),
        (ELASTIC, r#""joint": { "pressure": "1/opening" }"#, "\"1/opening\" is inf at x = "),
        (
            ELASTIC,
            r#""b.top": { "pressure": { "flow": { "aperture": 1, "viscosity": 1 } } }"#,
            "water flows along interfaces",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 0, "viscosity": 1 } } }"#,
            "pressure.flow.aperture: 0 is no aperture",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosty": 1 } } }"#,
            "unknown key \"viscosty\"",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosity": 1 } } }"#,
            "no other interface with flow meets the end at s = 0",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosity": 1, "ends": ["wall", "wall"] } } }"#,
            "no pressure is given along \"joint\"",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosity": 1, "ends": [1, "opening"] } } }"#,
            "flow.ends.1: opening in \"opening\"",
        ),
        (
            ELASTIC,
            r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosity": 1, "ends": [1, 2],
                "drains": [{ "at": 1, "pressure": 0 }] } } }"#,
            "drains.0.at: 1 is no place between the ends",
        ),
    ] {
        let refused = blocks(law, "", &[step("s", 2, loads)]);
        let message = refused.err().unwrap_or_else(|| panic!("accepted: {loads}")).to_string();
        assert!(message.contains(words), "{message}\n  should contain\n{words}");
    }
    let flow = r#""joint": { "pressure": { "flow": { "aperture": 1, "viscosity": 1, "ends": [1, 2] } } }"#;
    let message = blocks(ELASTIC, &strategy("blocks"), &[step("s", 1, flow)]).unwrap_err().to_string();
    assert!(message.contains("solution.strategy: flow is solved with the jumps"), "{message}");
    let path = step("s", 2, r#""joint": { "pressure": "load_factor" }"#)
        .replace("\"increments\"", "\"control\": \"auto\", \"increments\"");
    let message = blocks(COULOMB, "", &[path]).unwrap_err().to_string();
    assert!(message.contains("while a pressure in an interface holds load_factor"), "{message}");
}
