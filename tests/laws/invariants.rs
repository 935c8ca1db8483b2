//! Claim: whatever is asked of the cracking law, no step leaves the hyperbola, undoes damage or creates energy.
//!
//! A million random steps of random laws, small and enormous: F ≤ 0 to rounding, σ ≤ χ, W and the dissipation never
//! fall, nothing is NaN; the mirrored way gives the mirrored traction; a step repeated is elastic and changes nothing.

use crate::common::laws::Random;
use midplane::law::{Cracking, Integration, Law, Local, Response, State, Unloading, WORK};

/// Tolerance, relative to the strength or the traction.
const ROUNDING: f64 = 1e-12;

/// F(σ, τ; W), written once more, from the definitions.
fn hyperbola(law: &Cracking, state: &State) -> f64 {
    let shape = |xi: f64, alpha: f64| {
        let (e, xi) = ((-alpha).exp(), xi.clamp(0.0, 1.0));
        e * xi / (1.0 + (e - 1.0) * xi)
    };
    let w = state.own[WORK];
    let chi = law.tensile_strength * (1.0 - shape(w / law.fracture_energy_i, law.alpha_tensile_strength));
    let c = law.cohesion * (1.0 - shape(w / law.fracture_energy_iia, law.alpha_cohesion));
    let loss = law.tan_friction - law.tan_friction_residual.unwrap_or(law.tan_friction);
    let t = law.tan_friction - loss * shape(w / law.fracture_energy_iia, law.alpha_tan_friction);
    state.traction.y.hypot(c - chi * t) - (c - state.traction.x * t)
}

fn check(law: &Cracking, old: &State, response: &Response) {
    let Response { state, dissipation, stiffness, dissipation_gradient, .. } = response;
    assert!(
        stiffness.iter().chain(dissipation_gradient.iter()).all(|x| x.is_finite()),
        "{law:?} {old:?} {response:?}"
    );
    let scale = law.cohesion.max(state.traction.amax());
    let outside = hyperbola(law, state);
    assert!(outside <= ROUNDING * scale, "F = {outside:e}: {law:?} {old:?} {response:?}");
    assert!(state.traction.x <= law.tensile_strength * (1.0 + ROUNDING));
    assert!(state.own[WORK] >= old.own[WORK], "W falls: {law:?} {old:?} {response:?}");
    let released = scale * scale / law.normal_stiffness.min(law.tangential_stiffness);
    assert!(*dissipation >= -1e-15 * released, "dissipation {dissipation:e}: {law:?} {old:?} {response:?}");
}

/// Under enormous compression the loss of friction alone takes the shear traction faster than K_T can follow:
/// |σ| |dtanφ/dW| c ≥ K_T. There is no continuous answer then, and the law must say so.
fn may_leap(law: &Cracking, old: &State, jump: Local) -> bool {
    let trial = old.traction.x + law.normal_stiffness * (jump.x - old.jump.x);
    let compression = -trial.min(old.traction.x);
    let loss = law.tan_friction - law.tan_friction_residual.unwrap();
    let steepest = loss / law.fracture_energy_iia * law.alpha_tan_friction.abs().exp();
    compression * steepest * law.cohesion > law.tangential_stiffness
}

#[test]
fn a_million_random_steps_keep_every_promise() {
    let mut random = Random(4);
    let mut steps = 0;
    let (mut by_status, mut leaps) = ([0; 5], 0);
    while steps < 1_000_000 {
        let unloading = Unloading::Plastic;
        let law = random.cracking(unloading);
        let elastic = law.tensile_strength / law.normal_stiffness;
        let softening = law.fracture_energy_i / law.tensile_strength;
        let drift = random.direction() * random.between(0.0, 1.5);
        let mut state = State::default();
        for _ in 0..200 {
            let mut size = random.power((0.01 * elastic).log10(), (0.3 * softening).log10());
            if random.between(0.0, 1.0) < 0.02 {
                size = random.power(0.0, 6.0) / law.normal_stiffness; // trials up to 1e6 MPa
            }
            let jump = state.jump + (drift + random.direction()) * size;
            let integration = match random.coin() {
                true => Integration::BackwardEuler(1),
                false => Integration::Tolerance(1e-3),
            };
            let response = match Law::Cracking(law).respond(jump, &state, integration) {
                Ok(response) => response,
                Err(unresolved) => {
                    assert!(may_leap(&law, &state, jump), "{unresolved}: {law:?} {state:?} {jump:?}");
                    leaps += 1;
                    continue;
                }
            };
            check(&law, &state, &response);
            by_status[usize::from(response.state.status)] += 1;
            state = response.state;
            steps += 1;
        }
    }
    println!("by status {by_status:?}, {leaps} leaps");
    assert!(leaps < steps / 1000, "{leaps} leaps");
    assert!(by_status.iter().all(|&count| count > 1000), "a mode hardly occurs: {by_status:?}");
}

#[test]
fn a_mirrored_way_gives_the_mirrored_traction_and_a_repeated_step_changes_nothing() {
    let mirror = |v: Local| Local::new(v.x, -v.y, 0.0);
    let mut random = Random(5);
    for _ in 0..4000 {
        let unloading = random.unloading();
        let law = random.cracking(unloading);
        let (mut state, mut mirrored) = (State::default(), State::default());
        for _ in 0..20 {
            let size = random.power(-8.0, -4.5);
            let jump = state.jump + random.direction() * size;
            let go = |jump, old: &State| {
                Law::Cracking(law).respond(jump, old, Integration::Tolerance(1e-3)).unwrap()
            };
            state = go(jump, &state).state;
            mirrored = go(mirror(jump), &mirrored).state;
            assert_eq!(state.traction, mirror(mirrored.traction));
            assert_eq!(state.own[WORK], mirrored.own[WORK]);

            let again = go(jump, &state);
            assert_eq!((again.traction, again.dissipation), (state.traction, 0.0));
            assert_eq!(again.state.jump_plastic, state.jump_plastic);
            assert!([0, 4, 5, 6].contains(&again.state.status), "{again:?}");
        }
    }
}

/// Newton's accepted answers are those of the nested solver, which cannot diverge.
#[test]
fn newton_agrees_with_the_safe_solver() {
    let mut random = Random(6);
    for _ in 0..4000 {
        let unloading = random.unloading();
        let law = random.cracking(unloading);
        let softening = law.fracture_energy_i / law.tensile_strength;
        let mut state = State::default();
        for _ in 0..20 {
            let jump = state.jump + random.direction() * random.power(-8.0, softening.log10());
            let (traction, work) = law.respond_nested(jump, &state);
            let response = Law::Cracking(law).respond(jump, &state, Integration::BackwardEuler(1)).unwrap();
            let off = (response.traction - traction).amax();
            assert!(off <= 1e-7 * law.cohesion, "{off:e}: {law:?} {state:?} {jump:?}");
            assert!((response.state.own[WORK] - work).abs() <= 1e-11 * law.fracture_energy_i);
            state = response.state;
        }
    }
}

/// Claim: a point that is held elastic carries the traction of its springs however far beyond the strength, and answers with their slopes;
/// where nothing is spent that is K r, from whatever state without damage it starts.
#[test]
fn a_point_that_is_held_carries_what_its_springs_do() {
    let mut random = Random(11);
    for unloading in [Unloading::Plastic, Unloading::Closing] {
        for _ in 0..1000 {
            let law = random.cracking(unloading);
            let (kn, kt) = (law.normal_stiffness, law.tangential_stiffness);
            let mut jump =
                |most: f64| Local::new(random.between(-9.0, most) / kn, random.between(-9.0, 9.0) / kt, 0.0);
            let (a, b) = (jump(0.5 * law.tensile_strength), jump(9.0));
            let elastic = |jump: Local| Local::new(kn * jump.x, kt * jump.y, 0.0);
            let start = State { jump: a, traction: elastic(a), ..State::default() };
            let (traction, slopes) = Law::Cracking(law).held(b, &start);
            let off = (traction - elastic(b)).amax() / elastic(b).amax().max(elastic(a).amax());
            assert!(off < 1e-13, "{law:?} from {a:?} to {b:?}: {traction:?}");
            assert_eq!(slopes, [kn, kt, kt]);
        }
    }
}

/// Claim: a viscous step spends the work of its slip, (|τ| + σ tanφ) |Δr_t^p| under pressure with the friction at its start, and none where it
/// stays inside; friction and strength lag, what is lost does not.
#[test]
fn in_a_viscous_step_the_work_of_slip_is_spent() {
    let mut random = Random(12);
    let mut slid = 0;
    for unloading in [Unloading::Plastic, Unloading::Closing] {
        for _ in 0..2000 {
            let law = random.cracking(unloading);
            let (kn, kt) = (law.normal_stiffness, law.tangential_stiffness);
            let pressed = Local::new(-random.between(0.5, 9.0) / kn, 0.0, 0.0);
            let start =
                State { jump: pressed, traction: Local::new(kn * pressed.x, 0.0, 0.0), ..State::default() };
            let jump = Local::new(pressed.x, random.between(-30.0, 30.0) / kt, 0.0);
            let law = Law::Cracking(law);
            let response = law.respond_lagged(jump, &start, Integration::BackwardEuler(1), true).unwrap();
            let Law::Cracking(cracking) = &law else { unreachable!() };
            let (state, traction) = (response.state, response.traction);
            let slip = (state.jump_plastic.y - start.jump_plastic.y).abs();
            // nothing has been spent at the start, so the friction is the parameter
            let exact = (traction.y.abs() + traction.x * cracking.tan_friction) * slip;
            assert!(traction.x <= 0.0, "{cracking:?} {response:?}");
            let off = (state.own[WORK] - exact.max(0.0)).abs();
            assert!(off <= 1e-12 * (traction.amax() * slip), "{cracking:?} {response:?}: {exact:e}");
            slid += usize::from(slip > 0.0 && exact > 0.0);
        }
    }
    assert!(slid > 1000, "{slid}");
}
