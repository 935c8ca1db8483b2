//! Claim: Coulomb friction with constant cohesion and dilatancy is returned in closed form, the elastic law is D r + t₀.
//!
//! ```text
//! |τ| ≤ c − μσ;  first slip at μ|σ|/K_T;  a cycle ±A dissipates 4 μ|σ| (A − μ|σ|/K_T)
//! with dilatancy at fixed opening  |Δr_t^p| = (|τ_trial| + μ σ_trial − c)/(K_T + μ K_N tanψ)
//! ```
#![allow(missing_docs, clippy::unwrap_used)]

mod law_help;

use law_help::{Random, close};
use midplane::law::{Coulomb, Elastic, Law, Response, State, Stepping};
use nalgebra::{Matrix2, Vector2};

const STEPPING: Stepping = Stepping::Tolerance(1e-4);

const BLOCK: Coulomb = Coulomb {
    normal_stiffness: 1e4,
    tangential_stiffness: 1e4,
    friction_coefficient: 0.6,
    cohesion: 0.0,
    dilatancy: 0.0,
};

fn respond(law: &Coulomb, jump: [f64; 2], old: &State) -> Response {
    law.check().unwrap();
    Law::Coulomb(*law).respond(Vector2::from(jump), old, STEPPING).unwrap()
}

/// A block under pressure 2 driven to and fro by ±3e-4; between the third and fourth row the pressure drops to 1 and
/// τ follows its limit down, ∫ τ dτ/K_T: first order in the step, so exact in the limit of many.
#[test]
fn a_driven_block_follows_its_friction_loop() {
    let steps = 20_000;
    let rows = [
        // jump_t, σ, τ, slip, dissipated so far
        (3e-4, -2.0, 1.2, 1.8e-4, 2.16e-4),
        (-3e-4, -2.0, -1.2, -1.8e-4, 6.48e-4),
        (3e-4, -2.0, 1.2, 1.8e-4, 1.08e-3),
        (3e-4, -1.0, 0.6, 2.4e-4, 1.134e-3),
        (-1e-4, -1.0, -0.6, -4e-5, 1.302e-3),
    ];
    let mut state = respond(&BLOCK, [-2e-4, 0.0], &State::default()).state;
    let mut dissipated = 0.0;
    for (row, &(slide, sigma, tau, slip, energy)) in rows.iter().enumerate() {
        let parts = if row == 3 { steps } else { 1 };
        let (from, to) = (state.jump, Vector2::new(sigma / BLOCK.normal_stiffness, slide));
        for part in 1..=parts {
            let jump = from + (to - from) * (part as f64 / parts as f64);
            let response = respond(&BLOCK, jump.into(), &state);
            dissipated += response.dissipation;
            state = response.state;
        }
        close(state.traction.y, tau, 1e-10, "τ");
        close(state.jump_plastic.y, slip, 1e-10 * 3e-4, "slip");
        let order = if row < 3 { 1e-9 } else { 1.0 / steps as f64 };
        close(dissipated, energy, order * energy, "dissipated");
    }
}

#[test]
fn slip_starts_at_the_threshold_and_not_before() {
    let pressed = respond(&BLOCK, [-2e-4, 0.0], &State::default()).state;
    let threshold = 1.2 / 1e4;
    assert_eq!(respond(&BLOCK, [-2e-4, threshold * (1.0 - 1e-12)], &pressed).state.status, 0);
    assert_eq!(respond(&BLOCK, [-2e-4, threshold * (1.0 + 1e-12)], &pressed).state.status, 2);
}

#[test]
fn without_friction_there_is_no_shear_stress_and_with_much_there_is_no_slip() {
    let smooth = Coulomb { friction_coefficient: 0.0, ..BLOCK };
    assert_eq!(respond(&smooth, [-1e-3, 5e-4], &State::default()).traction.y, 0.0);
    for mu in [1e-12, 1.0, 10.0] {
        let law = Coulomb { friction_coefficient: mu, ..BLOCK };
        let response = respond(&law, [-1e-3, 5e-4], &State::default());
        close(response.traction.y, f64::min(5.0, mu * 10.0), 1e-14, "τ");
    }
}

#[test]
fn an_open_joint_carries_nothing_and_closes_where_it_is() {
    let law = Coulomb { cohesion: 0.3, ..BLOCK };
    let state = Law::Coulomb(law).initial_state(Vector2::zeros(), 1e-4).unwrap();
    let open = respond(&law, [-0.9e-4, 2e-4], &state);
    assert_eq!((open.traction, open.stiffness, open.state.status), (Vector2::zeros(), Matrix2::zeros(), 4));
    let closed = respond(&law, [-2e-4, 2.1e-4], &open.state);
    close(closed.traction.x, -1.0, 1e-12, "σ = K_N (r_n + g)");
    close(closed.traction.y, 0.1, 1e-12, "τ from where it closed");
}

#[test]
fn dilatancy_presses_a_confined_joint() {
    let law = Coulomb { dilatancy: 0.2, cohesion: 0.5, ..BLOCK };
    let response = respond(&law, [-2e-4, 1e-3], &State::default());
    let slip = (10.0 + 0.6 * -2.0 - 0.5) / (1e4 + 0.6 * 1e4 * 0.2);
    close(response.state.jump_plastic.y, slip, 1e-15, "slip");
    close(response.state.jump_plastic.x, 0.2 * slip, 1e-15, "opening");
    close(response.traction.x, -2.0 - 1e4 * 0.2 * slip, 1e-12, "σ");
    close(response.traction.y, 0.5 - 0.6 * response.traction.x, 1e-12, "τ on the limit");
    assert!(Coulomb { dilatancy: 0.7, ..BLOCK }.check().unwrap_err().what.contains("0.7 > "));
}

#[test]
fn stiffness_and_gradient_are_derivatives_and_no_step_creates_energy() {
    let mut random = Random(8);
    for _ in 0..20_000 {
        let mu = random.between(0.0, 2.0);
        let law = Coulomb {
            normal_stiffness: random.power(3.0, 6.0),
            tangential_stiffness: random.power(3.0, 6.0),
            friction_coefficient: mu,
            cohesion: if random.coin() { 0.0 } else { random.between(0.0, 3.0) },
            dilatancy: if random.coin() { 0.0 } else { random.between(0.0, mu) },
        };
        let size = random.power(-6.0, -3.0);
        let old = respond(&law, (random.direction() * size).into(), &State::default()).state;
        let jump = old.jump + random.direction() * random.power(-6.0, -3.0);
        let response = respond(&law, jump.into(), &old);
        assert!(response.dissipation >= 0.0);
        let excess = response.traction.y.abs() + mu * response.traction.x - law.cohesion;
        assert!(excess.min(response.traction.amax()) <= 1e-12 * (1.0 + response.traction.amax()), "{excess}");

        let step = 1e-5 * size;
        let stiffest = law.normal_stiffness.max(law.tangential_stiffness) * (1.0 + mu);
        for i in 0..2 {
            let mut shift = Vector2::zeros();
            shift[i] = step;
            let (plus, minus) =
                (respond(&law, (jump + shift).into(), &old), respond(&law, (jump - shift).into(), &old));
            if plus.state.status != minus.state.status {
                continue; // a kink has no derivative
            }
            let slope = (plus.traction - minus.traction) / (2.0 * step);
            assert!((slope - response.stiffness.column(i)).amax() <= 1e-6 * stiffest);
            let slope = (plus.dissipation - minus.dissipation) / (2.0 * step);
            let scale = stiffest * (jump - old.jump).norm() + response.traction.amax();
            close(response.dissipation_gradient[i], slope, 1e-6 * scale, "dissipation gradient");
        }
    }
}

#[test]
fn the_elastic_law_adds_its_initial_traction() {
    let springs = Elastic { normal_stiffness: 1e3, tangential_stiffness: 0.0 };
    let initial = Vector2::new(-2.0, 0.5); // a direction without stiffness still carries it
    let law = Law::Elastic(springs);
    let state = law.initial_state(initial, 0.0).unwrap();
    let mut way = state;
    for jump in [Vector2::new(1e-3, 1.0), Vector2::new(-1e-3, 2.0)] {
        let response = law.respond(jump, &way, STEPPING).unwrap();
        assert_eq!(response.traction, springs.traction(jump, initial));
        way = response.state;
    }
}

#[test]
fn an_initial_traction_must_be_one_the_interface_can_carry() {
    let law = Law::Coulomb(BLOCK);
    let state = law.initial_state(Vector2::new(-2.0, 1.0), 0.0).unwrap();
    close(state.jump_plastic.x, 2e-4, 1e-18, "−K⁻¹ t₀");
    assert_eq!(law.respond(Vector2::zeros(), &state, STEPPING).unwrap().traction, Vector2::new(-2.0, 1.0));
    assert_eq!(law.initial_state(Vector2::new(-2.0, 1.3), 0.0).unwrap_err().key, "initial_traction");
    assert_eq!(law.initial_state(Vector2::new(1.0, 0.0), 0.0).unwrap_err().key, "initial_traction");
    assert_eq!(law.initial_state(Vector2::zeros(), -1.0).unwrap_err().key, "initial_gap");
}
