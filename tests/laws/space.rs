//! Claim: laws know no direction along the interface but that of the shear: in space they answer as in the plane.
//!
//! A way in the plane of n and t, turned about n, gives the turned answer, derivatives along s included; so does any way in
//! space. Where the shear turns, friction follows the closed form (constant σ, slip rate along s, angle θ of τ to it)
//!
//! ```text
//! tan(θ/2) = tan(θ₀/2) e^{−K_T x/τ_y}
//! ```
//!
//! with first order in the steps (`coulomb`) or within the tolerance (`cracking`); stiffnesses are derivatives.

use crate::common::laws::{EXAMPLE_2, Random, close};
use midplane::law::{
    Coulomb, Cracking, Integration, Law, Local, LocalMatrix, LossOfCohesion, N, PointLaw, Response, State,
    Unloading, WORK,
};
use nalgebra::{Rotation3, Unit};

/// Largest difference of values, and of derivatives.
const VALUE: f64 = 1e-8;
const SLOPE: f64 = 1e-6;
const TOLERANCE: Integration = Integration::Tolerance(1e-4);

/// Ways to ask a law.
const ALL: [&str; 4] = ["own", "Euler", "lagged", "spent, lagged"];

/// The answer; error control takes the sub-steps in `lengths` if they are given, which rounding would change, or notes them.
fn ask(name: &str, law: &Law, jump: Local, old: &State, lengths: &mut Option<Vec<f64>>) -> Response {
    match (name, law) {
        ("own", Law::Cracking(law)) => match lengths {
            Some(lengths) => law.respond_replaying(jump, old, lengths).unwrap(),
            None => law.respond_recording(jump, old, 1e-4, lengths.insert(Vec::new())).unwrap(),
        },
        ("own", law) => law.respond(jump, old, TOLERANCE).unwrap(),
        ("Euler", law) => law.respond(jump, old, Integration::BackwardEuler(2)).unwrap(),
        ("lagged", law) => law.respond_lagged(jump, old, Integration::BackwardEuler(1), true).unwrap(),
        (_, law) => law.respond_lagged(jump, old, Integration::BackwardEuler(1), false).unwrap(),
    }
}

fn own(law: &Law, jump: Local, old: &State) -> Response {
    ask("own", law, jump, old, &mut None)
}

fn coulomb(random: &mut Random) -> Coulomb {
    let friction = random.between(0.1, 1.2);
    Coulomb {
        normal_stiffness: Some(random.power(4.0, 6.0)),
        closure: None,
        tangential_stiffness: random.power(4.0, 6.0),
        friction_coefficient: friction,
        cohesion: if random.coin() { 0.0 } else { random.between(0.1, 3.0) },
        dilatancy: if random.coin() { 0.0 } else { friction * random.between(0.0, 1.0) },
        dilatancy_end: None,
        cohesion_lost: LossOfCohesion::Never,
    }
}

/// A law with the size of a step that changes its state.
fn law(random: &mut Random) -> (Law, f64) {
    if random.coin() {
        let law = coulomb(random);
        return (Law::Coulomb(law), 3.0 / law.elastic_stiffness()[N].min(law.tangential_stiffness));
    }
    let unloading = random.unloading();
    let law = random.cracking(unloading);
    (Law::Cracking(law), random.power(-0.5, 1.5) * law.tensile_strength / law.normal_stiffness)
}

fn turned(rotation: &Rotation3<f64>, state: &State) -> State {
    let (jump, traction) = (rotation * state.jump, rotation * state.traction);
    State { jump, traction, jump_plastic: rotation * state.jump_plastic, ..*state }
}

fn about_n(angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(Local::x()), angle)
}

/// Any direction in space.
fn direction(random: &mut Random) -> Local {
    about_n(random.between(0.0, std::f64::consts::TAU)) * random.direction()
}

/// Asserts that two answers are one but for a rotation; relative to the scale of tractions and stiffnesses.
fn same(rotation: &Rotation3<f64>, a: &Response, b: &Response, law: &Law, what: &str) {
    let size = a.traction.amax().max(1.0);
    let stiffest = law.elastic_stiffness().into_iter().fold(a.stiffness.amax(), f64::max);
    let along = |v: Local| rotation * v;
    let slope = size.max(a.dissipation_gradient.amax());
    // where a step ends the strength, the derivative of what it dissipates grows like 1/√rounding on the way
    let spent = matches!(law, Law::Cracking(_)) && a.state.status == 4;
    let parts = [
        ("traction", (along(a.traction) - b.traction).amax() / size, VALUE),
        (
            "irreversible",
            (along(a.state.jump_plastic) - b.state.jump_plastic).amax() * stiffest / size,
            VALUE,
        ),
        ("work", (a.state.own[WORK] - b.state.own[WORK]).abs() * stiffest / (size * size), VALUE),
        ("dissipation", (a.dissipation - b.dissipation).abs() * stiffest / (size * size), VALUE),
        ("released", (a.released - b.released).abs() * stiffest / (size * size), VALUE),
        (
            "gradient",
            (along(a.dissipation_gradient) - b.dissipation_gradient).amax() / slope,
            if spent { f64::INFINITY } else { SLOPE },
        ),
        ("stiffness", (rotation * a.stiffness * rotation.transpose() - b.stiffness).amax() / stiffest, SLOPE),
    ];
    for (name, off, limit) in parts {
        assert!(off <= limit, "{what}, {name}: {off:.1e}\n{a:?}\n{b:?}\n{law:?}");
    }
}

/// Turns the ways of random laws about n, steps of every kind; in the plane s stays exactly zero.
fn turned_ways(seed: u64, direction: fn(&mut Random) -> Local, in_plane: bool) {
    let mut random = Random(seed);
    for name in ALL {
        for case in 0..1500 {
            let (law, size) = law(&mut random);
            let rotation = about_n(random.between(0.0, std::f64::consts::TAU));
            let mut old = State::default();
            for step in 0..12 {
                let jump = old.jump + direction(&mut random) * size;
                let mut lengths = None;
                let one = ask(name, &law, jump, &old, &mut lengths);
                assert!(!in_plane || one.traction.z == 0.0 && one.state.jump_plastic.z == 0.0);
                let other = ask(name, &law, rotation * jump, &turned(&rotation, &old), &mut lengths);
                same(&rotation, &one, &other, &law, &format!("{name} {case} step {step}"));
                old = one.state;
            }
        }
    }
}

#[test]
fn a_way_in_the_plane_turned_about_n_gives_the_turned_answer() {
    turned_ways(31, Random::direction, true);
}

#[test]
fn a_way_in_space_turned_about_n_gives_the_turned_answer() {
    turned_ways(32, direction, false);
}

/// Steps in space keep what steps in the plane keep: |τ| on or inside the surface, W and dissipation never fall.
#[test]
fn random_ways_in_space_keep_every_promise() {
    let mut random = Random(33);
    for _ in 0..1500 {
        let unloading = random.unloading();
        let law = random.cracking(unloading);
        let size = random.power(-1.0, 2.0) * law.tensile_strength / law.normal_stiffness;
        let drift = direction(&mut random) * random.between(0.0, 1.5);
        let mut old = State::default();
        for _ in 0..60 {
            let jump = old.jump + (drift + direction(&mut random)) * size;
            // the loss of friction alone may make the traction snap under enormous compression
            let Ok(new) = Law::Cracking(law).respond(jump, &old, TOLERANCE) else { continue };
            let scale = law.cohesion.max(new.traction.amax());
            let now = law.strength_after(new.state.own[WORK]);
            let b = now.cohesion - now.tensile_strength * now.tan_friction;
            let shear = new.traction.y.hypot(new.traction.z);
            let outside = shear.hypot(b) - (now.cohesion - new.traction.x * now.tan_friction);
            assert!(outside <= 1e-12 * scale, "{outside:e} {law:?}");
            assert!(new.state.own[WORK] >= old.own[WORK] && new.dissipation >= -1e-20);
            // t = K (r − r^p)
            let k = Local::from(Law::Cracking(law).elastic_stiffness());
            let elastic = k.component_mul(&(new.state.jump - new.state.jump_plastic));
            if unloading == Unloading::Plastic {
                assert!((elastic - new.traction).amax() <= 1e-9 * (scale + k.component_mul(&jump).amax()));
            }
            old = new.state;
        }
    }
}

/// Angle of the shear to the slip rate after slip by x, from a right angle.
fn angle(kt: f64, limit: f64, x: f64) -> f64 {
    2.0 * ((-kt * x / limit).exp()).atan()
}

#[test]
fn friction_whose_slip_turns_converges_to_the_closed_form_with_first_order() {
    let law = Coulomb {
        normal_stiffness: Some(1e5),
        closure: None,
        tangential_stiffness: 5e4,
        friction_coefficient: 0.6,
        cohesion: 0.5,
        dilatancy: 0.0,
        dilatancy_end: None,
        cohesion_lost: LossOfCohesion::Never,
    };
    let (sigma, kt) = (-4.0, law.tangential_stiffness);
    let limit = law.cohesion - law.friction_coefficient * sigma;
    let pressed = Local::new(sigma / law.elastic_stiffness()[N], 0.0, 0.0);
    let (slip, turn) = (3.0 * limit / kt, 1.3 * limit / kt);
    let errors: Vec<f64> = [20, 40, 80, 160]
        .into_iter()
        .map(|steps| {
            let ask = |jump: Local, old: &State| own(&Law::Coulomb(law), pressed + jump, old).state;
            let mut state = ask(Local::new(0.0, slip, 0.0), &ask(Local::zeros(), &State::default()));
            for step in 1..=steps {
                state = ask(Local::new(0.0, slip, turn * f64::from(step) / f64::from(steps)), &state);
            }
            close(state.traction.y.hypot(state.traction.z), limit, 1e-12 * limit, "|τ|");
            let found = state.traction.y.atan2(state.traction.z);
            (found - angle(kt, limit, turn)).abs()
        })
        .collect();
    println!("errors of the angle {errors:.3?}");
    for pair in errors.windows(2) {
        assert!((1.8..2.2).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

#[test]
fn cracking_whose_slip_turns_keeps_the_tolerance() {
    // nothing is lost: energies far beyond what is spent
    let law = Cracking { fracture_energy_i: 1e6, fracture_energy_iia: 1e6, ..EXAMPLE_2 };
    let (sigma, kt) = (-5.0, law.tangential_stiffness);
    let now = law.strength_after(0.0);
    let b = now.cohesion - now.tensile_strength * now.tan_friction;
    let limit = ((now.cohesion - sigma * now.tan_friction).powi(2) - b * b).sqrt();
    let pressed = Local::new(sigma / law.elastic_stiffness()[N], 0.0, 0.0);
    let (slip, turn) = (3.0 * limit / kt, 1.3 * limit / kt);
    for parts in [1, 3] {
        for tolerance in [1e-3, 1e-5] {
            let ask = |jump: Local, old: &State| {
                let integration = Integration::Tolerance(tolerance);
                Law::Cracking(law).respond(pressed + jump, old, integration).unwrap().state
            };
            let mut state = ask(Local::new(0.0, slip, 0.0), &ask(Local::zeros(), &State::default()));
            for part in 1..=parts {
                state = ask(Local::new(0.0, slip, turn * f64::from(part) / f64::from(parts)), &state);
            }
            let exact = angle(kt, limit, turn);
            let expected = Local::new(sigma, limit * exact.sin(), limit * exact.cos());
            let error = (state.traction - expected).amax();
            println!("{parts} parts, tolerance {tolerance:.0e}: {error:.1e}");
            assert!(error <= tolerance * limit, "{parts} parts, tolerance {tolerance:.0e}: {error:.1e}");
        }
    }
}

/// Central differences of the traction.
fn quotient(respond: &impl Fn(Local) -> Local, jump: Local, step: f64) -> LocalMatrix {
    let columns = [Local::x(), Local::y(), Local::z()]
        .map(|axis| (respond(jump + axis * step) - respond(jump - axis * step)) / (2.0 * step));
    LocalMatrix::from_columns(&columns)
}

#[test]
fn stiffnesses_in_space_are_derivatives() {
    let mut random = Random(34);
    let (mut checked, mut kinks) = (0, 0);
    for name in ALL {
        for _ in 0..1500 {
            let (law, size) = law(&mut random);
            let mut old = State::default();
            for _ in 0..random.between(0.0, 5.0) as usize {
                old = own(&law, old.jump + direction(&mut random) * size, &old).state;
            }
            let jump = old.jump + direction(&mut random) * size;
            let mut lengths = None;
            ask(name, &law, jump, &old, &mut lengths);
            let respond = |jump: Local| ask(name, &law, jump, &old, &mut lengths.clone());
            let exact = respond(jump).stiffness;
            let [kn, kt, _] = law.elastic_stiffness();
            let stiffest = kn.max(kt).max(exact.amax());
            let traction = |jump: Local| respond(jump).traction;
            let step = 1e-4 / kn.max(kt); // a tiny part of the jump at any strength
            let (coarse, fine) = (quotient(&traction, jump, step), quotient(&traction, jump, 0.5 * step));
            if (coarse - fine).amax() > 2e-8 * stiffest {
                kinks += 1;
                continue;
            }
            checked += 1;
            let off = (exact - fine).amax() / stiffest;
            assert!(off <= 1e-6, "{name}: {off:.1e}\n{exact}{fine}\n{law:?}\n{old:?}\n{jump:?}");
        }
    }
    println!("{checked} checked, {kinks} at kinks or too bent");
    assert!(checked > 4000, "{checked} checked, {kinks} left out");
}
