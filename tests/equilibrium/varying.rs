//! Claim: a number of a law may be a formula of the place: a weak zone is what two interfaces are, a wrong value is refused with its
//! place, and cracks that are there at the start carry nothing apart and everything pressed.

use crate::common::*;
use midplane::law::N;
use midplane::mesh::{Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::Value;

/// Two layers of 2 m × 0.5 m on top of each other, whose halves have groups of their own.
fn layers(n: [usize; 2]) -> Vec<Mesh> {
    let mut meshes = Vec::new();
    for (k, n) in n.into_iter().enumerate() {
        let y = 0.5 * k as f64;
        let mut mesh = even_block([0.0, 2.0], [y, y + 0.5], [n, 4], Shape::Quadrilateral4);
        let side = if k == 0 { "top" } else { "bottom" };
        let [left, right] = halves(&mesh, side);
        mesh.groups.insert(format!("{side}_left"), left);
        mesh.groups.insert(format!("{side}_right"), right);
        meshes.push(mesh);
    }
    meshes
}

/// The scene of both, joined along their whole length or by halves, pulled apart by `opening`.
fn scene(interfaces: &[(&str, Interface)], pull: Step) -> Scene {
    let scene = Scene::new("stress")
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.2)
        .step(pull.increments(10).fix("lower.bottom", "y").fix("lower.left", "x").fix("upper.left", "x"))
        .probe("viscous", "energy.viscous");
    interfaces.iter().fold(scene, |scene, (name, interface)| scene.interface(name, interface.clone()))
}

/// Both layers joined by one interface, pulled apart by `opening`.
fn joined(joint: Interface, opening: f64) -> Scene {
    scene(&[("joint", joint)], pull(opening))
}

fn pull(opening: f64) -> Step {
    step("pull").displace("upper.top", "y", opening)
}

fn joint(law: Law) -> Interface {
    faces("lower.top", "upper.bottom").law(law)
}

/// A side in halves.
fn halves(mesh: &Mesh, side: &str) -> [Group; 2] {
    let Group::Edges(edges) = &mesh.groups[side] else { unreachable!() };
    let middle = |nodes: &[usize]| nodes.iter().map(|&n| mesh.points[n][0]).sum::<f64>() / nodes.len() as f64;
    [true, false].map(|left| {
        let own = edges.iter().filter(|edge| (middle(edge.nodes()) < 1.0) == left);
        Group::Edges(own.cloned().collect())
    })
}

fn law(strength: impl Into<Value>, energy: impl Into<Value>) -> Law {
    cohesive(1e6, 1e6, [0.0, 4.0], [0.0, 4e-4])
        .with("tensile_strength", strength)
        .with("fracture_energy_i", energy)
        .with("softening", "exponential")
}

/// Normal tractions and places of all law points at the end, and the energy dissipated.
fn end(problem: &Problem) -> (Vec<(f64, f64)>, f64) {
    let (states, _) = solve(problem);
    let last = states.last().unwrap();
    let mut all = Vec::new();
    for (interface, states) in problem.model.interfaces.iter().zip(&last.snapshot.states) {
        all.extend(interface.coupling.points.iter().zip(states).map(|(p, s)| (p.position[0], s.traction[N])));
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    (all, last.dissipated)
}

#[test]
fn a_weak_zone_is_what_two_interfaces_are() {
    let one = joint(law("if(x < 1, 1, 2)", "1e-4*(1 + (s > 0.5))"));
    let half = |side: &str, strength: f64, energy: f64| {
        let faces = faces(format!("lower.top_{side}"), format!("upper.bottom_{side}"));
        faces.law(law(strength, energy))
    };
    let two = [("left", half("left", 1.0, 1e-4)), ("right", half("right", 2.0, 2e-4))];
    for n in [[16, 24], [32, 40]] {
        let problem = joined(one.clone(), 2.5e-4).bind(layers(n)).unwrap();
        assert_eq!(problem.interfaces[0].laws.all().len(), 2);
        let (zone, spent) = end(&problem);
        let (halves, of_halves) = end(&scene(&two, pull(2.5e-4)).bind(layers(n)).unwrap());
        close(spent, of_halves, 0.02 * 16.0 / n[0] as f64, of_halves, "dissipated energy");
        // beside the place where both meet, where the grid of one goes through
        let mut beside = 0;
        for ((x, a), (_, b)) in zone.iter().zip(&halves).filter(|((x, _), _)| (x - 1.0).abs() > 0.2) {
            close(*a, *b, 0.02, 2.0, &format!("traction at {x}"));
            beside += 1;
        }
        assert!(beside > 20 && spent > 0.0);
    }
}

#[test]
fn a_value_that_no_law_point_can_have_is_refused_with_its_place() {
    let refused = |strength: &str| {
        let joint = joint(law(strength, 1e-4));
        joined(joint, 1e-4).bind(layers([8, 8])).unwrap_err().to_string()
    };
    let message = refused("1 - x");
    assert!(message.contains("interfaces.joint.law.tensile_strength"), "{message}");
    assert!(message.contains("tensile_strength = -") && message.contains(" at (1."), "{message}");
    let message = refused("sqrt(1 - x)");
    assert!(message.contains("\"sqrt(1 - x)\" has no value at (1."), "{message}");
    let message = refused("2*load_factor");
    assert!(
        message.contains("interfaces.joint.law.tensile_strength") && message.contains("load_factor"),
        "{message}"
    );
    let message = refused("2*phi");
    assert!(message.contains("tensile_strength: unknown name \"phi\""), "{message}");
    let message = refused("random(x, 1)");
    assert!(message.contains("depends on the place"), "{message}");
}

#[test]
fn what_is_broken_at_the_start_carries_nothing_apart_and_everything_pressed() {
    let cracking = cracking(1e6, 1e6, [2.0, 4.0, 0.8], [1e-4, 1e-3]);
    // what is left to be dissipated: a crack of the cracking law that opened with χ = χ₀ exp(−o χ₀/G_I) up to W = G_I/2 and
    // closed has given ½ σ o = ¼ ln 2 G_I back
    for (law, left) in [(law(2.0, 1e-4), 0.5), (cracking, 0.5 + 0.25 * 2.0_f64.ln())] {
        let end = |n: [usize; 2], damage: Value, opening: f64| {
            let joint = joint(law.clone()).with("initial_damage", damage);
            end(&joined(joint, opening).bind(layers(n)).unwrap())
        };
        // a notch over the left half: nothing there, the right one holds
        let (notched, _) = end([16, 24], "x < 1".into(), 2e-5);
        let (whole, _) = end([16, 24], 0.into(), 2e-5);
        assert!(notched.iter().filter(|(x, _)| *x < 0.9).all(|(_, t)| t.abs() < 1e-12), "{notched:?}");
        let most = |points: &[(f64, f64)]| points.iter().map(|(_, t)| *t).fold(0.0, f64::max);
        assert!(most(&notched) > 1.2 * most(&whole), "stress is raised before the notch");
        // pressed, the notch is not there
        let (notched, spent) = end([16, 24], "x < 1".into(), -2e-5);
        let (whole, _) = end([16, 24], 0.into(), -2e-5);
        for ((x, a), (_, b)) in notched.iter().zip(&whole) {
            close(*a, *b, 1e-9, *b, &format!("pressed at {x}"));
        }
        assert_eq!(spent, 0.0);
        let (_, half) = end([8, 8], 0.5.into(), 4e-2);
        let (_, all) = end([8, 8], 0.into(), 4e-2);
        close(half, left * all, 1e-3, all, "energy that is left");
    }
}

#[test]
fn a_random_strength_is_there_and_the_same_on_every_mesh() {
    let joint = joint(law("2*exp(0.2*random(7, 0.5))", 1e-4));
    let strengths = |n: [usize; 2]| {
        let problem = joined(joint.clone(), 1e-4).bind(layers(n)).unwrap();
        let interface = &problem.model.interfaces[0].coupling;
        let strength = |p: usize| {
            let law = problem.interfaces[0].laws.at(p);
            law.strength(&Default::default()).unwrap().tensile_strength
        };
        let places = interface.points.iter().enumerate().map(|(p, point)| (point.position[0], strength(p)));
        places.collect::<Vec<_>>()
    };
    let (coarse, fine) = (strengths([80, 120]), strengths([400, 400]));
    let spread = |s: &[(f64, f64)]| {
        s.iter().map(|p| p.1).fold(0.0, f64::max) / s.iter().map(|p| p.1).fold(9.0, f64::min)
    };
    assert!(spread(&fine) > 1.2);
    for (x, strength) in coarse {
        let after = fine.partition_point(|place| place.0 < x).clamp(1, fine.len() - 1);
        let [(x0, a), (x1, b)] = [fine[after - 1], fine[after]];
        let between = a + (b - a) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0);
        close(strength, between, 1e-3, between, &format!("strength at {x}"));
    }
}

#[test]
fn a_viscosity_needs_a_load_factor_that_grows() {
    let late = |viscosity: f64| joint(law(2.0, 1e-3).with("viscosity", viscosity));
    let auto = scene(&[("joint", late(0.01))], pull(1e-4).control("auto"));
    let message = auto.bind(layers([8, 8])).unwrap_err().to_string();
    assert!(message.contains("steps.0.control") && message.contains("viscosity"), "{message}");
    // with it the answer comes late, and goes to that without it with rate 1; all that is not stored is dissipated
    let spent = |viscosity: f64| {
        let problem = joined(late(viscosity), 4e-4).bind(layers([8, 8])).unwrap();
        let (states, _) = solve(&problem);
        let last = states.last().unwrap();
        assert!(last.energy_balance().abs() < 5e-3, "{}", last.energy_balance());
        let told = last.probes(&problem)[0];
        if viscosity > 0.0 {
            // the work of the law points, added up over the length: thickness 1
            let points = problem.model.interfaces[0].coupling.points.iter().zip(&last.snapshot.states[0]);
            let laws = &problem.interfaces[0].laws;
            let variable = laws.kind().variables().iter().find(|own| own.name == "viscous_work").unwrap();
            let sum: f64 = points.map(|(point, state)| point.weight * state.own[variable.place]).sum();
            close(told, sum, 1e-12, sum, "viscous work");
        }
        (last.dissipated, told)
    };
    let (exact, none) = spent(0.0);
    let all = [4e-3, 2e-3, 1e-3].map(spent);
    let late = all.map(|(spent, _)| (spent - exact).abs() / exact);
    assert!(late[0] > 1.4 * late[1] && late[1] > 1.4 * late[2] && late[2] < 0.05, "{late:?}");
    // what the viscosity takes is told, and goes with it
    let taken = all.map(|(_, viscous)| viscous / exact);
    assert_eq!(none, 0.0);
    assert!(taken[0] > 1.4 * taken[1] && taken[1] > 1.4 * taken[2], "{taken:?}");
    assert!(taken[0] < 0.5 && taken[2] > 1e-3, "{taken:?}");
}
