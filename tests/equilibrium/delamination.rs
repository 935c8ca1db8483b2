//! Claim: beams that come apart do so at the fracture energy, in both modes, whatever the softening: J of what loads them.
//!
//! ```text
//! DCB   J = P (θ_upper + θ_lower)                      forces P, rotations θ where they act
//! ENF   J = P/2 (θ_left + θ_right + 2 θ_middle)        three-point bending, rotations towards the crack's end
//! MMB   J = Σ F θ                                       of all forces, reactions too; G of the share that beam theory has
//! ```
//!
//! J is exact for beams of any length of process zone (per width; Paris and Paris 1988, Stigh, Alfredsson and Biel 2009).

use crate::common::*;
use midplane::history::{Clock, Equations, History, Means, ModelState};
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::{Value, json};

const YOUNG: f64 = 70e3;
/// Half of the height, and the length of the beams [mm].
const HEIGHT: f64 = 1.5;
const LENGTH: f64 = 100.0;
const GI: f64 = 0.3;
const GII: f64 = 0.9;

/// The bond: springs of 1e5 MPa/mm, tensile strength 20 MPa.
fn bond(shear_strength: f64, softening: &str, mixed_mode: Value) -> Law {
    cohesive(1e5, 1e5, [20.0, shear_strength], [GI, GII])
        .with("softening", softening)
        .with("mixed_mode", mixed_mode)
}

/// The bond of the two beams in one mode.
fn one_mode(softening: &str) -> Law {
    bond(30.0, softening, json!({ "benzeggagh_kenane": 1.75 }))
}

fn beams(bond: Law, crack: f64, step: Step) -> Problem {
    let arm = |y: f64, n: usize| {
        let mut mesh = even_block([0.0, LENGTH], [y, y + HEIGHT], [n, 2], Shape::Quadrilateral8);
        let near = |x: f64, y: f64| {
            let far = |p: &[f64; 3]| (p[0] - x).hypot(p[1] - y);
            let points = mesh.points.iter().enumerate();
            points.min_by(|a, b| far(a.1).total_cmp(&far(b.1))).unwrap().0
        };
        let places = [("start", 0.0), ("middle", 0.5 * LENGTH), ("end", LENGTH)];
        let mut named = Vec::new();
        for (name, x) in places {
            for (part, at) in [("low", y), ("axis", y + 0.5 * HEIGHT), ("high", y + HEIGHT)] {
                named.push((format!("{name}_{part}"), near(x, at)));
            }
        }
        for (name, node) in named {
            mesh.groups.insert(name, midplane::mesh::Group::Points(vec![node]));
        }
        mesh
    };
    let joint = faces("lower.top", "upper.bottom").law(bond).with("initial_damage", format!("x < {crack}"));
    let scene = Scene::new("stress")
        .subdomains(["lower", "upper"], "ply")
        .material("ply", YOUNG, 0.0)
        .interface("joint", joint)
        .step(step);
    scene.bind(vec![arm(0.0, 80), arm(HEIGHT, 100)]).unwrap()
}

/// Slope of a section: the difference of u_x over the height, clockwise positive.
fn rotation_of(problem: &Problem, state: &ModelState, subdomain: usize, section: &str) -> f64 {
    let at = |part: &str| group(problem, subdomain, &format!("{section}_{part}"))[0];
    let [low, high] = ["low", "high"].map(|part| displacement(problem, state, subdomain, at(part))[0]);
    (high - low) / HEIGHT
}

/// Reaction in y at a point.
fn reaction(problem: &Problem, state: &ModelState, subdomain: usize, point: &str) -> f64 {
    let node = problem.model.subdomains[subdomain].first_node + group(problem, subdomain, point)[0];
    state.reactions[2 * node + 1]
}

#[test]
fn a_double_cantilever_costs_the_energy_of_mode_i() {
    let open = step("open")
        .increments(20)
        .fix("lower.start_axis", "y")
        .fix("lower.end_axis", "x")
        .fix("upper.end_axis", "x")
        .displace("upper.start_axis", "y", 5);
    for softening in ["linear", "exponential"] {
        let problem = beams(one_mode(softening), 30.0, open.clone());
        let (states, _) = solve(&problem);
        let last = states.last().unwrap();
        let force = reaction(&problem, last, 1, "start_axis");
        let turned = rotation_of(&problem, last, 1, "start") - rotation_of(&problem, last, 0, "start");
        println!("{softening}: P {force:.4}, J {:.5} of {GI}", force * turned);
        close(force * turned, GI, 0.01, GI, softening);
        let balance = last.energy_balance();
        assert!(balance.abs() < 2e-3, "{balance}");
    }
}

#[test]
fn an_end_notched_beam_costs_the_energy_of_mode_ii() {
    let bend = step("bend").increments(20).fix("lower.start_low", "y").fix("lower.end_low", "yx");
    let bend = bend.displace("upper.middle_high", "y", -6);
    for softening in ["linear", "bilinear"] {
        let problem = beams(one_mode(softening), 36.0, bend.clone());
        let (states, _) = solve(&problem);
        let force = |state: &ModelState| -reaction(&problem, state, 1, "middle_high");
        let j = |state: &ModelState| {
            let turn = |section: &str| {
                0.5 * (rotation_of(&problem, state, 0, section) + rotation_of(&problem, state, 1, section))
            };
            0.5 * force(state) * (turn("start") - 2.0 * turn("middle") + turn("end")).abs()
        };
        for state in &states {
            println!(
                "{softening}: P {:.3}, J {:.5} of {GII}, dissipated {:.4}",
                force(state),
                j(state),
                state.dissipated
            );
        }
        let most = states.iter().map(j).fold(0.0, f64::max);
        close(most, GII, 0.01, GII, softening);
    }
}

/// Mixed-mode bending: a lever of length c, as a multiple of half the span, presses the middle down by P (c + 1) and pulls the upper
/// arm up by P c. Beam theory has G_I/G_II = 4/3 ((3 c − 1)/(c + 1))²; strengths that are as the roots of the energies make
/// what a point costs depend on the end of its way alone (Turon et al. 2010).
#[test]
fn mixed_mode_bending_costs_the_energy_of_its_mixity() {
    let bond = bond(20.0 * (GII / GI).sqrt(), "linear", json!({ "power": 1 }));
    for lever in [0.45, 0.6, 1.2] {
        let (pull, push) = (20.0 * lever, -20.0 * (lever + 1.0));
        let bend = step("bend")
            .increments(40)
            .control("auto")
            .fix("lower.start_low", "y")
            .fix("lower.end_low", "yx")
            .force("upper.start_axis", 0, pull)
            .force("upper.middle_high", 0, push);
        let problem = beams(bond.clone(), 28.0, bend);
        let mut clock = Clock::new("test");
        let equations = Equations::new(&problem, Means::default(), &mut clock).unwrap();
        let mut history = History::new(&problem, &equations, clock);
        let mut all = Vec::new();
        while let Some(increment) = history.next().unwrap() {
            let state = history.state();
            if state.dissipated > 5.0 {
                break;
            }
            let turned = |subdomain, section| rotation_of(&problem, state, subdomain, section);
            let held = |point| reaction(&problem, state, 0, point);
            let j = increment.load_factor * (pull * turned(1, "start") + push * turned(1, "middle"))
                + held("start_low") * turned(0, "start")
                + held("end_low") * turned(0, "end");
            // the crack grows by some ten edges, with the process zone behind it
            if state.dissipated > 2.0 {
                all.push(j);
            }
        }
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let first = 4.0 / 3.0 * ((3.0 * lever - 1.0) / (lever + 1.0)).powi(2);
        let share = 1.0 / (1.0 + first);
        let exact = 1.0 / ((1.0 - share) / GI + share / GII);
        println!("lever {lever}: G_II/G {share:.4}, J {mean:.5} of {exact:.5}, {} rows", all.len());
        close(mean, exact, 0.01, exact, &format!("lever {lever}"));
        assert!(all.len() > 10);
    }
}
