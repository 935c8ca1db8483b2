//! Claim: a number of a law may be a formula of the place: a weak zone is what two interfaces are, a wrong value is refused with its
//! place, and cracks that are there at the start carry nothing apart and everything pressed.

use crate::common::*;
use midplane::law::N;
use midplane::mesh::{Group, Mesh};
use midplane::problem::Problem;
use midplane::shape::Shape;

/// Two layers of 2 m × 0.5 m on top of each other, pulled apart by `opening`; `interfaces` joins them, whose halves have groups
/// of their own.
fn layers(n: [usize; 2], interfaces: &str, opening: &str, more: &str) -> midplane::error::Result<Problem> {
    let flat = |x: f64, y: f64| [x, y];
    let mut meshes = Vec::new();
    for (k, n) in n.into_iter().enumerate() {
        let y = 0.5 * k as f64;
        let mut mesh = rectangle(&even(0.0, 2.0, n), &even(y, y + 0.5, 4), Shape::Quadrilateral4, flat);
        let side = if k == 0 { "top" } else { "bottom" };
        let [left, right] = halves(&mesh, side);
        mesh.groups.insert(format!("{side}_left"), left);
        mesh.groups.insert(format!("{side}_right"), right);
        meshes.push(mesh);
    }
    let text = format!(
        r#"{{ "plane": "stress",
          "subdomains": {{ "lower": {{ "msh": "l", "material": "rock" }}, "upper": {{ "msh": "u", "material": "rock" }} }},
          "materials": {{ "rock": {{ "young": 1e4, "poisson": 0.2 }} }},
          "interfaces": {{ {interfaces} }},
          "steps": [ {{ "name": "pull", "increments": 10, "fix": {{ "lower.bottom": ["y"], "lower.left": ["x"], "upper.left": ["x"] }},
            "displace": {{ "upper.top": {{ "y": {opening} }} }} {more} }} ],
          "output": {{ "history": {{ "viscous": "energy.viscous" }} }} }}"#
    );
    bind(&text, meshes)
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

fn law(strength: &str, energy: &str) -> String {
    format!(
        r#"{{ "type": "cohesive", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": {strength},
           "shear_strength": 4.0, "fracture_energy_i": {energy}, "fracture_energy_ii": 4e-4, "softening": "exponential" }}"#
    )
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
    let one = format!(
        r#""joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {} }}"#,
        law(r#""if(x < 1, 1, 2)""#, r#""1e-4*(1 + (s > 0.5))""#)
    );
    let half = |side: &str, strength: &str, energy: &str| {
        let law = law(strength, energy);
        format!(
            r#""{side}": {{ "side_a": "lower.top_{side}", "side_b": "upper.bottom_{side}", "law": {law} }}"#
        )
    };
    let two = [half("left", "1.0", "1e-4"), half("right", "2.0", "2e-4")].join(", ");
    for n in [[16, 24], [32, 40]] {
        let problem = layers(n, &one, "2.5e-4", "").unwrap();
        assert_eq!(problem.interfaces[0].laws.all().len(), 2);
        let (zone, spent) = end(&problem);
        let (halves, of_halves) = end(&layers(n, &two, "2.5e-4", "").unwrap());
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
        let joint = format!(
            r#""joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {} }}"#,
            law(strength, "1e-4")
        );
        layers([8, 8], &joint, "1e-4", "").unwrap_err().to_string()
    };
    let message = refused(r#""1 - x""#);
    assert!(message.contains("interfaces.joint.law.tensile_strength"), "{message}");
    assert!(message.contains("tensile_strength = -") && message.contains(" at (1."), "{message}");
    let message = refused(r#""sqrt(1 - x)""#);
    assert!(message.contains("\"sqrt(1 - x)\" has no value at (1."), "{message}");
    let message = refused(r#""2*load_factor""#);
    assert!(
        message.contains("interfaces.joint.law.tensile_strength") && message.contains("load_factor"),
        "{message}"
    );
    let message = refused(r#""2*phi""#);
    assert!(message.contains("tensile_strength: unknown name \"phi\""), "{message}");
    let message = refused(r#""random(x, 1)""#);
    assert!(message.contains("depends on the place"), "{message}");
}

#[test]
fn what_is_broken_at_the_start_carries_nothing_apart_and_everything_pressed() {
    let cracking = r#"{ "type": "cracking", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 2.0,
        "cohesion": 4.0, "tan_friction": 0.8, "fracture_energy_i": 1e-4, "fracture_energy_iia": 1e-3, "dilatancy_stress": 0 }"#;
    // what is left to be dissipated: a crack of the cracking law that opened with χ = χ₀ exp(−o χ₀/G_I) up to W = G_I/2 and
    // closed has given ½ σ o = ¼ ln 2 G_I back
    for (law, left) in [(law("2.0", "1e-4"), 0.5), (cracking.to_string(), 0.5 + 0.25 * 2.0_f64.ln())] {
        let joint = |damage: &str| {
            format!(
                r#""joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {law}, "initial_damage": {damage} }}"#
            )
        };
        // a notch over the left half: nothing there, the right one holds
        let (notched, _) = end(&layers([16, 24], &joint(r#""x < 1""#), "2e-5", "").unwrap());
        let (whole, _) = end(&layers([16, 24], &joint("0"), "2e-5", "").unwrap());
        assert!(notched.iter().filter(|(x, _)| *x < 0.9).all(|(_, t)| t.abs() < 1e-12), "{notched:?}");
        let most = |points: &[(f64, f64)]| points.iter().map(|(_, t)| *t).fold(0.0, f64::max);
        assert!(most(&notched) > 1.2 * most(&whole), "stress is raised before the notch");
        // pressed, the notch is not there
        let (notched, spent) = end(&layers([16, 24], &joint(r#""x < 1""#), "-2e-5", "").unwrap());
        let (whole, _) = end(&layers([16, 24], &joint("0"), "-2e-5", "").unwrap());
        for ((x, a), (_, b)) in notched.iter().zip(&whole) {
            close(*a, *b, 1e-9, *b, &format!("pressed at {x}"));
        }
        assert_eq!(spent, 0.0);
        let (_, half) = end(&layers([8, 8], &joint("0.5"), "4e-2", "").unwrap());
        let (_, all) = end(&layers([8, 8], &joint("0"), "4e-2", "").unwrap());
        close(half, left * all, 1e-3, all, "energy that is left");
    }
}

#[test]
fn a_random_strength_is_there_and_the_same_on_every_mesh() {
    let joint = format!(
        r#""joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {} }}"#,
        law(r#""2*exp(0.2*random(7, 0.5))""#, "1e-4")
    );
    let strengths = |n: [usize; 2]| {
        let problem = layers(n, &joint, "1e-4", "").unwrap();
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
    let law = law("2.0", "1e-3").replace(" }", r#", "viscosity": 0.01 }"#);
    let joint = format!(r#""joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {law} }}"#);
    let message = layers([8, 8], &joint, "1e-4", r#", "control": "auto""#).unwrap_err().to_string();
    assert!(message.contains("steps.0.control") && message.contains("viscosity"), "{message}");
    // with it the answer comes late, and goes to that without it with rate 1; all that is not stored is dissipated
    let spent = |viscosity: f64| {
        let own = joint.replace("0.01", &viscosity.to_string());
        let problem = layers([8, 8], &own, "4e-4", "").unwrap();
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
