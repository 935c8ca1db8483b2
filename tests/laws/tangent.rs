//! Claim: the stiffness is the exact derivative of the traction, the gradients those of the dissipation and of the damage.
//!
//! Central differences of step δ, (t(r + δ) − t(r − δ)) / 2δ, at random states of random laws. Error control would
//! choose its sub-steps anew for every jump, so the lengths found at r are replayed over the stencil. Where the
//! stencil straddles a change of mode, or W passes an energy, there is no derivative: such stencils betray themselves,
//! their quotient changes when δ is halved. They are left out and counted.

use crate::common::laws::Random;
use midplane::law::{
    Cracking, Integration, Law, Local, LocalMatrix, PointLaw, Response, State, Unloading, WORK,
};

/// Largest difference, relative to the elastic stiffness (or the stiffness itself where it is larger).
const EXACT: f64 = 1e-6;

/// Part of G_I that is left where the ties across a crack are about to give way.
const AT_EXTINCTION: f64 = 1e-8;

/// Central differences of traction (3 × 3), dissipation (3) and damage (3), with step δ.
fn quotient(
    law: &Cracking,
    respond: &impl Fn(Local) -> Response,
    jump: Local,
    step: f64,
) -> (LocalMatrix, Local, Local) {
    let (mut stiffness, mut gradient, mut damage) = (LocalMatrix::zeros(), Local::zeros(), Local::zeros());
    let damaged = |response: &Response| law.damage(&response.state).unwrap();
    for i in 0..3 {
        let mut shift = Local::zeros();
        shift[i] = step;
        let (plus, minus) = (respond(jump + shift), respond(jump - shift));
        stiffness.set_column(i, &((plus.traction - minus.traction) / (2.0 * step)));
        gradient[i] = (plus.dissipation - minus.dissipation) / (2.0 * step);
        damage[i] = (damaged(&plus) - damaged(&minus)) / (2.0 * step);
    }
    (stiffness, gradient, damage)
}

/// A state some random steps away from the sound one, and the jump of the next step.
fn random_state(random: &mut Random, law: &Cracking) -> (State, Local) {
    let elastic = law.tensile_strength / law.normal_stiffness;
    let softening = law.fracture_energy_i / law.tensile_strength;
    let size = |random: &mut Random| random.power((0.3 * elastic).log10(), softening.log10());
    let drift = random.direction();
    let mut state = State::default();
    for _ in 0..random.between(0.0, 6.0) as usize {
        let step = (drift + random.direction()) * size(random);
        state = Law::Cracking(*law)
            .respond(state.jump + step, &state, Integration::Tolerance(1e-3))
            .unwrap()
            .state;
    }
    (state, state.jump + (drift + random.direction()) * size(random))
}

/// Stress that gradients count against.
fn strength_of(law: &Cracking, response: &Response) -> f64 {
    law.cohesion.max(response.traction.amax())
}

/// Checks one stencil; `None` if it straddles a kink.
fn check(
    law: &Cracking,
    respond: &impl Fn(Local) -> Response,
    jump: Local,
    old_work: f64,
    what: &str,
) -> Option<u8> {
    let response = respond(jump);
    // τ ~ √(G_I − W) is rounded more coarsely than the stencil resolves
    let left = 1.0 - response.state.own[WORK] / law.fracture_energy_i;
    if law.unloading == Unloading::Closing && old_work < law.fracture_energy_i && left.abs() < AT_EXTINCTION {
        return None;
    }
    let stiffest = law.normal_stiffness.max(law.tangential_stiffness).max(response.stiffness.amax());
    let step = 1e-4 * law.tensile_strength / law.normal_stiffness.max(law.tangential_stiffness);
    let (coarse, coarse_gradient, coarse_damage) = quotient(law, respond, jump, step);
    let (fine, fine_gradient, fine_damage) = quotient(law, respond, jump, 0.5 * step);
    let per_energy = strength_of(law, &response) / law.fracture_energy_i;
    let strength = strength_of(law, &response);
    let smooth = (coarse - fine).amax() <= 0.02 * EXACT * stiffest
        && (coarse_gradient - fine_gradient).amax() <= 0.02 * EXACT * strength
        && (coarse_damage - fine_damage).amax() <= 0.02 * EXACT * per_energy;
    if !smooth {
        return None;
    }
    let error = (response.stiffness - fine).amax() / stiffest;
    assert!(error <= EXACT, "{what}: {error:.1e}\n{:?}\n{fine:?}\n{law:?}", response.stiffness);
    let error = (response.dissipation_gradient - fine_gradient).amax() / strength;
    assert!(
        error <= EXACT,
        "{what}, dissipation: {error:.1e}\n{:?}\n{fine_gradient:?}\n{coarse_gradient:?}\n{response:?}\n{law:?}",
        response.dissipation_gradient
    );
    let error = (response.damage_gradient - fine_damage).amax() / per_energy;
    assert!(error <= EXACT, "{what}, damage: {error:.1e}\n{fine_damage:?}\n{response:?}\n{law:?}");
    Some(response.state.status)
}

/// The stiffness under error control at 10 000 random states; the statuses that must occur.
fn under_error_control(unloading: Unloading, statuses: &[usize]) {
    let mut random = Random(1);
    let (mut checked, mut left_out, mut by_status) = (0, 0, [0; 7]);
    while checked < 10_000 {
        let law = random.cracking(unloading);
        let (old, jump) = random_state(&mut random, &law);
        let mut lengths = Vec::new();
        law.respond_recording(jump, &old, 1e-4, &mut lengths).unwrap();
        let replay = |jump| law.respond_replaying(jump, &old, &lengths).unwrap();
        match check(&law, &replay, jump, old.own[WORK], "replayed") {
            Some(status) => {
                checked += 1;
                by_status[usize::from(status)] += 1;
            }
            None => left_out += 1,
        }
    }
    println!("checked {checked} by status {by_status:?}, left out {left_out}");
    // around an event the sub-steps are shorter than the stencil, which then straddles their ends
    assert!(left_out < 15 * checked / 100, "{left_out} stencils left out");
    assert!(statuses.iter().all(|&s| by_status[s] > 50), "a status is hardly tested: {by_status:?}");
}

#[test]
fn under_error_control_the_stiffness_is_the_derivative_at_10000_random_states() {
    under_error_control(Unloading::Plastic, &[0, 1, 2, 3, 4]);
}

#[test]
fn under_error_control_the_stiffness_of_a_crack_that_closes_is_the_derivative() {
    under_error_control(Unloading::Closing, &[0, 1, 2, 3, 4, 5, 6]);
}

#[test]
fn with_backward_euler_the_stiffness_is_the_derivative() {
    let mut random = Random(2);
    for steps in [1, 4] {
        let (mut checked, mut left_out) = (0, 0);
        while checked < 5_000 {
            let unloading = random.unloading();
            let law = random.cracking(unloading);
            let (old, jump) = random_state(&mut random, &law);
            let respond =
                |jump| Law::Cracking(law).respond(jump, &old, Integration::BackwardEuler(steps)).unwrap();
            match check(&law, &respond, jump, old.own[WORK], "backward Euler") {
                Some(_) => checked += 1,
                None => left_out += 1,
            }
        }
        println!("{steps} steps: left out {left_out}");
        assert!(left_out < checked / 20, "{left_out} stencils left out");
    }
}

/// Replaying the lengths at the jump they were found for gives the answer of error control.
#[test]
fn a_replay_at_the_same_jump_changes_nothing() {
    let mut random = Random(3);
    for _ in 0..1000 {
        let unloading = random.unloading();
        let law = random.cracking(unloading);
        let (old, jump) = random_state(&mut random, &law);
        let mut lengths = Vec::new();
        let recorded = law.respond_recording(jump, &old, 1e-4, &mut lengths).unwrap();
        assert_eq!(recorded, Law::Cracking(law).respond(jump, &old, Integration::Tolerance(1e-4)).unwrap());
        assert_eq!(recorded, law.respond_replaying(jump, &old, &lengths).unwrap());
    }
}
