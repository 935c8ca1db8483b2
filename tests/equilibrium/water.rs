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
use midplane::error::Result;
use midplane::history::{ModelState, Totals};
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::{Value, json};

const E: f64 = 1e4;
const K: f64 = 1e4;
const PROBES: [(&str, &str); 10] = [
    ("n", "joint.resultant_n"),
    ("total", "joint.total_resultant_n"),
    ("uplift", "joint.uplift"),
    ("work", "work.water"),
    ("p", "joint.pressure@0.3"),
    ("t", "joint.traction_n@0.3"),
    ("both", "joint.traction_total_n@0.3"),
    ("shear", "joint.traction_total_t@0.3"),
    ("r", "joint.jump_n@0.3"),
    ("external", "work.external"),
];

fn springs() -> Law {
    elastic(1e4, 5e3)
}

fn friction() -> Law {
    coulomb(1e4, 5e3, 0.5)
}

fn cohesion() -> Law {
    cohesive(1e4, 5e3, [2.0, 3.0], [2e-3, 4e-3])
}

fn rock() -> Law {
    cracking(1e4, 5e3, [2.0, 3.0, 0.7], [2e-3, 4e-3])
}

/// Two blocks of 1 m × 0.5 m on top of each other, with a joint between.
fn scene(law: Law, steps: &[Step]) -> Scene {
    Scene::new("strain")
        .subdomains(["a", "b"], "rock")
        .material("rock", E, 0.0)
        .interface("joint", faces("a.top", "b.bottom").law(law))
        .steps(steps.to_vec())
        .probes(PROBES)
}

fn blocks(scene: Scene) -> Result<Problem> {
    let block = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 0.5], [n, 3], Shape::Quadrilateral4);
    scene.bind(vec![block(4, -0.5), block(7, 0.0)])
}

/// A step in which they are held at the bottom and sideways.
fn held(name: &str, increments: usize) -> Step {
    step(name).increments(increments).fix("a.bottom", "xy").fix("a", "x").fix("b", "x")
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
        held("both", 2).pressure("b.top", 3).pressure("joint", 1.2),
        held("more water", 2).pressure("joint", "2*(1 + s)/1.5 - 0*x"),
        held("none", 1).pressure("joint", 0),
    ];
    for law in [springs(), friction()] {
        for name in ["condensed", "blocks", "plain"] {
            let scene = scene(law.clone(), &steps[..1]).solution("strategy", name);
            let problem = blocks(scene).unwrap();
            let (states, totals) = solve(&problem);
            assert_eq!(totals.iterations, if law == springs() { 0 } else { 2 }, "{name}");
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
    let problem = blocks(scene(springs(), &steps)).unwrap();
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
    for law in [springs(), cohesion(), rock()] {
        for name in ["condensed", "blocks", "plain"] {
            let scene = |steps: &[Step]| scene(law.clone(), steps).solution("strategy", name);
            // linear: K − p₁/w
            let formula = format!("{p1}*ramp(opening, 0, {w})");
            let pulled = held("pull", 3).pressure("b.top", -pull).pressure("joint", formula);
            let problem = blocks(scene(std::slice::from_ref(&pulled))).unwrap();
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
            let more = held("more", 1).pressure("b.top", -1.1 * pull);
            let (states, totals) = solve(&blocks(scene(&[pulled, more])).unwrap());
            assert!(states.len() == 4 && totals.parts - before.parts == 1, "{totals:?}");
            // a parabola
            let c = 1.5e7;
            let formula = format!("{c}*opening^2");
            let pulled = held("pull", 1).pressure("b.top", -pull).pressure("joint", formula);
            let problem = blocks(scene(&[pulled]).solution("path_tolerance", 1)).unwrap();
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
        held("a", 2).pressure("b.top", 3).pressure("joint", "load_factor*(1 + 0*opening)"),
        held("b", 2).pressure("joint", 2),
        held("c", 2).pressure("b.top", 4),
        held("d", 2).pressure("joint", "0.5 + 2*damage + 0*load_factor"),
        held("e", 2).pressure("jo*", "if(opening > 0, 9, 1)"),
    ];
    let problem = blocks(scene(cohesion(), &steps)).unwrap();
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
    for law in [cohesion(), rock()] {
        for control in ["load", "auto", "arclength"] {
            let pull = held("pull", 20).control(control).displace("b.top", "y", 4e-3);
            let steps = [pull.pressure("joint", "0.9*damage")];
            let problem = blocks(scene(law.clone(), &steps).solution("path_tolerance", 1e-4)).unwrap();
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
            if law == cohesion() {
                close(last.dissipated, 2e-3 * damage, 1e-3, 2e-3, &format!("{control}: dissipated"));
            }
            assert!(totals.energy_balance < 1e-3, "{control} {totals:?}");
        }
    }
}

/// Claim: the slope of the damage is in the tangent too.
#[test]
fn a_pressure_of_the_damage_converges_quadratically() {
    for law in [cohesion(), rock()] {
        let steps = [held("pull", 1).displace("b.top", "y", 1e-3).pressure("joint", "0.9*damage")];
        let problem = blocks(scene(law, &steps).solution("path_tolerance", 1)).unwrap();
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
    let cases: [(Value, &dyn Fn(f64) -> f64); 2] =
        [("1.5*ramp(opening, 0, 1e-3) + 0.2".into(), &wet), (flow(1e-6, 1).ends(0.7, 0.7).into(), &|_| 0.7)];
    for (pressure, p) in cases {
        for control in ["auto", "arclength"] {
            let loaded = held("pull", 30).control(control).pressure("b.top", -pull);
            let steps = [loaded.pressure("joint", pressure.clone())];
            let problem = blocks(scene(cohesion(), &steps).solution("path_tolerance", 1e-4)).unwrap();
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
    let s = || held("s", 2);
    let one = || flow(1, 1);
    for (law, step, words) in [
        (springs(), s().traction("joint", 1, 0), "\"joint\" is an interface; give it a \"pressure\""),
        (
            springs(),
            s().pressure("joints", 1),
            "no subdomain or interface \"joints\"; there is a, b, joint. Did you mean \"joint\"?",
        ),
        (springs(), s().pressure("j?", 1), "no interface is called like \"j?\"; there is joint"),
        (springs(), s().pressure("joint", "damage"), "damage in \"damage\", but the law of joint has none"),
        (cohesion(), s().pressure("joint", 1).pressure("j*", 2), "both give joint a pressure"),
        (
            springs(),
            s().pressure("b.top", "opening"),
            "only the pressure in an interface knows its opening and damage",
        ),
        (springs(), s().pressure("joint", "1/opening"), "\"1/opening\" is inf at x = "),
        (springs(), s().pressure("b.top", one()), "water flows along interfaces"),
        (springs(), s().pressure("joint", flow(0, 1)), "pressure.flow.aperture: 0 is no aperture"),
        (
            springs(),
            s().pressure("joint", json!({ "flow": { "aperture": 1, "viscosty": 1 } })),
            "unknown key \"viscosty\"",
        ),
        (springs(), s().pressure("joint", one()), "no other interface with flow meets the end at s = 0"),
        (
            springs(),
            s().pressure("joint", one().ends("wall", "wall")),
            "no pressure is given along \"joint\"",
        ),
        (springs(), s().pressure("joint", one().ends(1, "opening")), "flow.ends.1: opening in \"opening\""),
        (
            springs(),
            s().pressure("joint", one().ends(1, 2).drain(1, 0)),
            "drains.0.at: 1 is no place between the ends",
        ),
    ] {
        let what = step.to_string();
        let refused = blocks(scene(law, &[step]));
        let message = refused.err().unwrap_or_else(|| panic!("accepted: {what}")).to_string();
        assert!(message.contains(words), "{message}\n  should contain\n{words}");
    }
    let steps = [held("s", 1).pressure("joint", one().ends(1, 2))];
    let message = blocks(scene(springs(), &steps).solution("strategy", "blocks")).unwrap_err().to_string();
    assert!(message.contains("solution.strategy: flow is solved with the jumps"), "{message}");
    let path = s().control("auto").pressure("joint", "load_factor");
    let message = blocks(scene(friction(), &[path])).unwrap_err().to_string();
    assert!(message.contains("while a pressure in an interface holds load_factor"), "{message}");
}
