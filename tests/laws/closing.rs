//! Claim: a crack closes. The curves of an independent implementation are met, ways that only open are those of the published
//! law, and on random ways nothing is made or undone.
//!
//! ```text
//! σ = σᵉ(g; k, o),  0 ≤ k ≤ K_N,  o, q ≥ 0;  spent and open: σ = τ = 0;  σ < 0: σ = K_N g
//! W and ∫ dissipation never fall;  ψ + ∫ dissipation = work to the first order of the steps
//! ```

use crate::common::laws::{CLOSING, CURVES, EXAMPLE_2, INTEGRATED, Random, Reference, close};
use midplane::law::{Cracking, Integration, Law, Local, Response, State, Unloading, WORK};
use rayon::prelude::*;

const OPENING: usize = 1;
const BRIDGE: usize = 2;
const SLIP: usize = 3;

#[test]
fn under_error_control_the_curves_are_met_to_the_tolerance() {
    for name in CLOSING {
        let reference = Reference::read(name);
        let strength = reference.file["parameters"]["c0"].as_f64().unwrap();
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let errors = reference.errors(&reference.drive(Integration::Tolerance(tolerance)));
            println!(
                "{name} {tolerance:.0e}: {:.1e} MPa, {:.1e} MPa, {:.1e} G_I",
                errors[0], errors[1], errors[2]
            );
            assert!(errors[0].max(errors[1]) <= tolerance * strength, "{name}, {tolerance:e}: {errors:?}");
        }
        let errors = reference.errors(&reference.drive(Integration::Tolerance(1e-7)));
        assert!(errors.iter().all(|error| *error <= 1e-6), "{name}: {errors:?}");
    }
}

/// Opened with shear, closed, pressed, sheared, opened again, closed halfway, slid at that gap, opened on: the curves of
/// closing.py, which integrates the rates with another method and locates every event.
#[test]
fn an_independent_integration_is_met_to_1e_8() {
    for name in INTEGRATED {
        let reference = Reference::read(name);
        let rows = reference.drive(Integration::Tolerance(1e-9));
        let errors = reference.errors(&rows);
        println!("{name}: {:.1e} MPa, {:.1e} MPa, {:.1e} G_I", errors[0], errors[1], errors[2]);
        assert!(errors.iter().all(|error| *error <= 1e-8), "{name}: {errors:?}");
        let points = reference.file["points"].as_array().unwrap();
        for (row, point) in rows.iter().zip(points) {
            let stored = |key: &str| point[key].as_f64().unwrap();
            let at = |what: &str| format!("{name}, s = {}: {what}", row.s);
            close(row.state.jump_plastic.x, stored("dilation"), 1e-15, &at("dilation"));
            close(row.state.own[OPENING], stored("opening"), 1e-13, &at("opening"));
            close(row.state.own[BRIDGE], stored("bridge_stiffness"), 1e-2, &at("bridge_stiffness"));
            close(reference.law.stored(&row.state), stored("stored"), 1e-13, &at("stored energy"));
        }
        let spent = reference.dissipated(Integration::Tolerance(1e-9));
        let expected = points.last().unwrap()["dissipation"].as_f64().unwrap();
        close(spent, expected, 1e-12, &format!("{name}: dissipation"));
    }
}

#[test]
fn plain_backward_euler_makes_the_errors_listed_with_the_curves() {
    for name in CLOSING {
        let reference = Reference::read(name);
        for steps in [10, 100] {
            let errors = reference.errors(&reference.drive(Integration::BackwardEuler(steps)));
            let listed = &reference.file["accuracy"]["backward_euler_max_error_with_n_substeps_per_point"];
            for (i, key) in ["sigma", "tau", "W_over_gf1"].into_iter().enumerate() {
                let allowed = 1.01 * listed[steps.to_string()][key].as_f64().unwrap() + 1e-12;
                assert!(errors[i] <= allowed, "{name}, {steps} steps, {key}: {:e} > {allowed:e}", errors[i]);
            }
        }
    }
}

/// The ways of o01 to o06 and o08 only open, or never close what they opened.
#[test]
fn monotonic_ways_are_those_of_the_published_law() {
    for name in &CURVES[..8] {
        let published = Reference::read(name);
        let mut closing = Reference::read(name);
        let Law::Cracking(law) = closing.law else { unreachable!() };
        closing.law = Law::Cracking(Cracking { unloading: Unloading::Closing, ..law });
        for integration in [Integration::Tolerance(1e-4), Integration::BackwardEuler(10)] {
            for (a, b) in published.drive(integration).iter().zip(closing.drive(integration)) {
                let off = (a.state.traction - b.state.traction).amax();
                assert!(off <= 1e-9, "{name}, s = {}: {off:e} MPa", a.s);
                close(b.state.own[WORK], a.state.own[WORK], 1e-9 * law.fracture_energy_i, name);
            }
        }
    }
}

/// Opened by 1 mm, W is G_I but for rounding; closed to 0.99, 0.5, 0 mm the published law gives −10, −500, −1000 MPa.
#[test]
fn an_opened_crack_closes_freely_and_touches_where_it_was() {
    let law = Law::Cracking(Cracking { normal_stiffness: 1e6, unloading: Unloading::Closing, ..EXAMPLE_2 });
    let mut state = State::default();
    for (opening, least) in [(1e-3, -1e-5), (0.99e-3, -1e-5), (0.5e-3, -1e-5), (0.0, -1e-5)] {
        let jump = Local::new(opening, 0.0, 0.0);
        state = law.respond(jump, &state, Integration::Tolerance(1e-4)).unwrap().state;
        assert!(
            state.traction.x >= least && state.traction.x < 1e-5,
            "{opening}: {:e} MPa",
            state.traction.x
        );
    }
    let pressed = law.respond(Local::new(-1e-6, 0.0, 0.0), &state, Integration::Tolerance(1e-4)).unwrap();
    close(pressed.traction.x, -1.0, 1e-9, "K_N g");
}

/// Claim: the slip of open faces counts from the last touch: halfway back on the secant it is what it was, and after a touch nothing.
#[test]
fn slip_of_open_faces_counts_from_the_last_touch() {
    let law = Law::Cracking(Cracking { normal_stiffness: 1e6, unloading: Unloading::Closing, ..EXAMPLE_2 });
    let follow = |jump: [f64; 2], old: &State| {
        law.respond(Local::new(jump[0], jump[1], 0.0), old, Integration::Tolerance(1e-4)).unwrap().state
    };
    let opened = follow([2e-5, 2e-5], &State::default());
    assert!(opened.own[SLIP] > 1e-6, "{opened:?}");
    let gap = opened.jump[0] - opened.jump_plastic[0];
    let halfway = follow([opened.jump[0] - 0.5 * gap, 2e-5], &opened);
    assert!(halfway.own[BRIDGE] > 0.0 && halfway.traction[0] > 0.0, "{halfway:?}");
    assert_eq!(halfway.own[SLIP], opened.own[SLIP]);
    let touching = follow([opened.jump[0] - gap - 1e-6, 2e-5], &halfway);
    assert_eq!((touching.own[SLIP], touching.traction[0] < 0.0), (0.0, true), "{touching:?}");
}

/// σᵉ(g; k, o), from its definition.
fn elastic(kn: f64, state: &State) -> f64 {
    let gap = state.jump.x - state.jump_plastic.x;
    if gap < 0.0 { kn * gap } else { (state.own[BRIDGE] * gap).max(kn * (gap - state.own[OPENING])) }
}

fn check(law: &Cracking, old: &State, response: &Response) {
    let Response { state, dissipation, .. } = response;
    let said = || format!("{law:?}\n{old:?}\n{response:?}");
    let kn = law.normal_stiffness;
    let [_, opening, bridge, slip] = state.own;
    assert!((0.0..=kn).contains(&bridge) && opening >= 0.0 && slip >= 0.0, "{}", said());
    let gap = state.jump.x - state.jump_plastic.x;
    let rounding =
        1e-11 * (law.cohesion + state.traction.amax()) + 1e-14 * kn * (state.jump.x.abs() + gap.abs());
    let spent = state.own[WORK] >= law.fracture_energy_i;
    let expected = if spent && gap > 0.0 { 0.0 } else { elastic(kn, state) };
    assert!((state.traction.x - expected).abs() <= rounding, "σ is not {expected:e}: {}", said());
    if spent && gap > 0.0 && state.traction.x == 0.0 {
        assert_eq!(state.traction, Local::zeros());
        assert_eq!((state.status, bridge), (4, 0.0), "{}", said());
    }
    assert!(state.own[WORK] >= old.own[WORK], "W falls: {}", said());
    let least = 1e-14 * law.cohesion.powi(2).max(state.traction.norm_squared()) / kn;
    assert!(*dissipation >= -least, "dissipation {dissipation:e}: {}", said());
    assert!(response.stiffness.iter().all(|x| x.is_finite()), "{}", said());
    if state.status == 1 {
        assert!(state.traction.x >= 0.0 && state.own[SLIP] >= old.own[SLIP].min(slip));
    }
}

/// A way of some legs; each is one step.
fn random_way(random: &mut Random, law: &Cracking, steps: usize, integration: Integration) -> [u64; 7] {
    let elastic = law.tensile_strength / law.normal_stiffness;
    let softening = law.fracture_energy_i / law.tensile_strength;
    let mut by_status = [0; 7];
    let mut state = State::default();
    for _ in 0..steps {
        let size = random.power((0.1 * elastic).log10(), softening.log10());
        // often back to where the faces meet
        let towards = if random.coin() { 1.0 } else { 0.0 };
        let back = Local::new(-state.jump.x * towards * random.between(0.0, 1.5), 0.0, 0.0);
        let jump = state.jump + back + random.direction() * size;
        let Ok(response) = Law::Cracking(*law).respond(jump, &state, integration) else { break };
        check(law, &state, &response);
        by_status[usize::from(response.state.status)] += 1;
        state = response.state;
    }
    by_status
}

#[test]
fn on_a_million_random_ways_nothing_is_made_or_undone() {
    let thousand = |seed: u64| {
        let mut random = Random(61_000 + seed);
        let mut total = [0; 7];
        for way in 0..1000 {
            let law = random.cracking(Unloading::Closing);
            let integration = match way % 50 {
                0 => Integration::Tolerance(1e-3),
                _ => Integration::BackwardEuler(1),
            };
            let by_status = random_way(&mut random, &law, 8, integration);
            total.iter_mut().zip(by_status).for_each(|(sum, n)| *sum += n);
        }
        total
    };
    let sum = |a: [u64; 7], b: [u64; 7]| std::array::from_fn(|i| a[i] + b[i]);
    let total = (0..1000).into_par_iter().map(thousand).reduce(|| [0; 7], sum);
    println!("by status {total:?}");
    assert!(total.iter().all(|&count| count > 10_000), "a status hardly occurs: {total:?}");
}

/// Work of the tractions over one leg in n steps, by the trapezoidal rule, less what is stored and dissipated at its end.
fn imbalance(law: &Law, start: &State, end: Local, n: usize) -> Option<f64> {
    let integration = Integration::Tolerance(1e-6);
    let mut state = *start;
    let (mut work, mut spent) = (0.0, 0.0);
    for i in 1..=n {
        let jump = start.jump + (end - start.jump) * (i as f64 / n as f64);
        let response = law.respond(jump, &state, integration).ok()?;
        work += 0.5 * (state.traction + response.traction).dot(&(jump - state.jump));
        spent += response.dissipation;
        state = response.state;
    }
    Some(work - (law.stored(&state) - law.stored(start)) - spent)
}

/// Energy is kept on every leg: what is left is that of the trapezoidal rule and falls with the square of its step.
#[test]
fn work_is_stored_or_dissipated() {
    let mut random = Random(62);
    let (mut checked, mut sums, mut worst) = (0, [0.0; 2], 0.0_f64);
    for _ in 0..300 {
        let law = random.cracking(Unloading::Closing);
        let softening = law.fracture_energy_i / law.tensile_strength;
        let law = Law::Cracking(law);
        let mut state = State::default();
        for _ in 0..6 {
            let back = Local::new(-state.jump.x * random.between(0.0, 1.2), 0.0, 0.0);
            let end = state.jump + back + random.direction() * random.power(-1.5, 0.3) * softening;
            let Ok(response) = law.respond(end, &state, Integration::Tolerance(1e-6)) else { break };
            // the loss of friction alone may make the traction snap under enormous compression
            let [Some(coarse), Some(fine)] = [200, 800].map(|n| imbalance(&law, &state, end, n)) else {
                break;
            };
            let Law::Cracking(Cracking { fracture_energy_i, .. }) = law else { unreachable!() };
            let of = |left: f64| left.abs() / fracture_energy_i;
            (sums[0], sums[1]) = (sums[0] + of(coarse), sums[1] + of(fine));
            worst = worst.max(of(fine));
            checked += 1;
            state = response.state;
        }
    }
    println!(
        "{checked} legs, mean misfit of W_I {:.1e}, {:.1e}, worst {worst:.1e}",
        sums[0] / checked as f64,
        sums[1] / checked as f64
    );
    assert!(checked > 1500, "{checked}");
    assert!(sums[1] <= 0.1 * sums[0], "{sums:?}");
}

/// Loops that stay below the anchor or in contact give back what they took.
#[test]
fn an_elastic_loop_through_contact_makes_no_energy() {
    let law = Law::Cracking(Cracking { unloading: Unloading::Closing, ..EXAMPLE_2 });
    let go = |state: &State, n: f64, t: f64| {
        law.respond(Local::new(n, t, 0.0), state, Integration::Tolerance(1e-8)).unwrap()
    };
    let start = go(&State::default(), 5e-5, 1e-6).state;
    let mut state = start;
    for (n, t) in
        [(2e-5, 1e-6), (0.0, 1.02e-6), (-1e-7, 1.02e-6), (-1e-7, 1e-6), (1e-5, 1e-6), (4.9e-5, 1e-6)]
    {
        let response = go(&state, n, t);
        assert_eq!(response.dissipation, 0.0, "{n} {t}");
        state = response.state;
    }
    let again = go(&state, 5e-5, 1e-6).state;
    close(again.traction.x, start.traction.x, 1e-12, "σ");
    close(again.traction.y, start.traction.y, 1e-9, "τ");
    close(law.stored(&again), law.stored(&start), 1e-15, "ψ");
}
