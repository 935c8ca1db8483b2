//! Claim: Coulomb friction with constant cohesion and dilatancy is returned in closed form along a straight way, the
//! elastic law is D r + t₀.
//!
//! ```text
//! |τ| ≤ c − μσ;  first slip at μ|σ|/K_T;  a cycle ±A dissipates 4 μ|σ| (A − μ|σ|/K_T)
//! with dilatancy at fixed opening  |Δr_t^p| = (|τ_trial| + μ σ_trial − c)/(K_T + μ K_N tanψ)
//! a slip dissipates |Δr_t^p| (c − (μ − tanψ) (σ_a + σ_b)/2), faces that part under τ release τ²/(2 K_T)
//! ```

use crate::common::laws::close;
use midplane::law::{
    Coulomb, Elastic, Integration, Law, Local, LocalMatrix, LossOfCohesion, N, PointLaw, Response, State,
    local,
};

const STEPPING: Integration = Integration::Tolerance(1e-4);

const BLOCK: Coulomb = Coulomb {
    normal_stiffness: Some(1e4),
    closure: None,
    tangential_stiffness: 1e4,
    friction_coefficient: 0.6,
    cohesion: 0.0,
    dilatancy: 0.0,
    dilatancy_end: None,
    cohesion_lost: LossOfCohesion::Never,
};

fn respond(law: &Coulomb, jump: [f64; 2], old: &State) -> Response {
    law.check().unwrap();
    Law::Coulomb(*law).respond(local(&jump), old, STEPPING).unwrap()
}

/// The end of a straight way in equal parts, with all that was dissipated and released on it.
fn walk(law: &Coulomb, old: &State, jump: [f64; 2], parts: usize) -> (State, f64, f64) {
    let (from, to) = (old.jump, local(&jump));
    (1..=parts).fold((*old, 0.0, 0.0), |(state, dissipated, released), part| {
        let jump = from + (to - from) * (part as f64 / parts as f64);
        let response = respond(law, [jump[0], jump[1]], &state);
        (response.state, dissipated + response.dissipation, released + response.released)
    })
}

/// A block under pressure 2 driven to and fro by ±3e-4; between the third and fourth row the pressure drops to 1 and
/// τ follows its limit down, ∫ τ dτ/K_T.
#[test]
fn a_driven_block_follows_its_friction_loop() {
    let rows = [
        // jump_t, σ, τ, slip, dissipated so far
        (3e-4, -2.0, 1.2, 1.8e-4, 2.16e-4),
        (-3e-4, -2.0, -1.2, -1.8e-4, 6.48e-4),
        (3e-4, -2.0, 1.2, 1.8e-4, 1.08e-3),
        (3e-4, -1.0, 0.6, 2.4e-4, 1.134e-3),
        (-1e-4, -1.0, -0.6, -4e-5, 1.302e-3),
    ];
    for parts in [1, 2, 7, 100] {
        let mut state = respond(&BLOCK, [-2e-4, 0.0], &State::default()).state;
        let mut dissipated = 0.0;
        for &(slide, sigma, tau, slip, energy) in &rows {
            let (end, spent, released) =
                walk(&BLOCK, &state, [sigma / BLOCK.elastic_stiffness()[N], slide], parts);
            state = end;
            dissipated += spent;
            close(state.traction.y, tau, 1e-12, "τ");
            close(state.jump_plastic.y, slip, 1e-12 * 3e-4, "slip");
            close(dissipated, energy, 1e-12 * energy, "dissipated");
            assert_eq!(released, 0.0);
        }
    }
}

/// Faces that meet: slip is counted from there. K_N = K_T = 1e4, gap 1e-3.
#[test]
fn faces_that_meet_slide_from_there() {
    let rough = Coulomb { friction_coefficient: 0.5, ..BLOCK };
    let rows = [
        // law, end, σ, τ, r_t^p, dissipated
        // half-way, then stick: τ = K_T 2e-4
        ("stick", rough, [-2e-3, 4e-4], -10.0, 2.0, 2e-4, 0.0),
        // half-way, then slip at once: elastic 1e-3, 4e-3; slip = 4e-3 − 0.5 · 1e-3, mean limit 2.5
        ("slip", rough, [-2e-3, 8e-3], -10.0, 5.0, 7.5e-3, 8.75e-3),
        // c = 1: stick while 40 s ≤ 1 + 5 s of the second half, so from σ = −10/35; slip = (40 − 6)/1e4
        (
            "stick, then slip",
            Coulomb { cohesion: 1.0, ..rough },
            [-2e-3, 8e-3],
            -10.0,
            6.0,
            7.4e-3,
            3.4e-3 * (1.0 + 0.25 * (10.0 + 10.0 / 35.0)),
        ),
        // tanψ = 0.2: slip = (40 − 5)/(K_T + 0.5 · 0.2 K_N), σ = −10 − 0.2 K_N slip, from 0 on
        (
            "dilatancy",
            Coulomb { dilatancy: 0.2, ..rough },
            [-2e-3, 8e-3],
            -10.0 - 70.0 / 11.0,
            5.0 + 35.0 / 11.0,
            4e-3 + 3.5e-2 / 11.0,
            3.5e-2 / 11.0 * 0.15 * (10.0 + 70.0 / 11.0),
        ),
        // no friction
        ("smooth", Coulomb { friction_coefficient: 0.0, ..BLOCK }, [-2e-3, 8e-3], -10.0, 0.0, 8e-3, 0.0),
        // met at the very end
        ("touch", rough, [-1e-3, 4e-4], 0.0, 0.0, 4e-4, 0.0),
    ];
    for (what, law, end, sigma, tau, slip, energy) in rows {
        let start = Law::Coulomb(law).initial_state(Local::zeros(), 1e-3).unwrap();
        for parts in [1, 2, 4, 40] {
            let (state, dissipated, released) = walk(&law, &start, end, parts);
            let what = format!("{what} in {parts} parts");
            close(state.traction.x, sigma, 1e-12, &what);
            close(state.traction.y, tau, 1e-12, &what);
            close(state.jump_plastic.y, slip, 1e-15, &what);
            close(dissipated, energy, 1e-14, &what);
            assert_eq!(released, 0.0, "{what}");
        }
    }
}

/// Faces that part at fixed r_t: τ₀ follows its limit down to c, slip (τ₀ − c)/K_T, and drops from there. K_N = K_T = 1e4.
#[test]
fn faces_that_part_dissipate_by_slip_and_release_the_rest() {
    let kt = BLOCK.tangential_stiffness;
    let rough = Coulomb { friction_coefficient: 0.5, ..BLOCK };
    let rows = [
        // law, σ₀, τ₀, dissipated, released, opening r_n^p
        ("no cohesion", rough, -10.0, 4.0, 8e-4, 0.0, 0.0),
        ("on the limit", rough, -10.0, 5.0, 25.0 / (2.0 * kt), 0.0, 0.0),
        (
            "less than cohesion",
            Coulomb { cohesion: 5.0, ..rough },
            -10.0,
            -3.55,
            0.0,
            3.55 * 3.55 / (2.0 * kt),
            0.0,
        ),
        ("cohesion", Coulomb { cohesion: 5.0, ..rough }, -10.0, 5.0, 0.0, 25.0 / (2.0 * kt), 0.0),
        (
            "more than cohesion",
            Coulomb { cohesion: 1.0, ..rough },
            -10.0,
            -4.0,
            15.0 / (2.0 * kt),
            1.0 / (2.0 * kt),
            0.0,
        ),
        (
            "no friction",
            Coulomb { friction_coefficient: 0.0, cohesion: 1.0, ..rough },
            -10.0,
            0.5,
            0.0,
            0.25 / (2.0 * kt),
            0.0,
        ),
        // slip starts at |σ_a| = (τ₀ − c)/μ = 6; mean power 1 + 0.3 · 6/2
        (
            "dilatancy",
            Coulomb { cohesion: 1.0, dilatancy: 0.2, ..rough },
            -10.0,
            4.0,
            3.0 / kt * 1.9,
            1.0 / (2.0 * kt),
            0.2 * 3.0 / kt,
        ),
    ];
    for (what, law, sigma, tau, energy, drop, opening) in rows {
        let start = Law::Coulomb(law).initial_state(Local::new(sigma, tau, 0.0), 0.0).unwrap();
        for parts in [1, 10, 100] {
            let (state, dissipated, released) = walk(&law, &start, [2e-3, 0.0], parts);
            let what = format!("{what} in {parts} parts");
            assert_eq!(
                (state.traction, state.status, state.jump_plastic.y),
                (Local::zeros(), 4, 0.0),
                "{what}"
            );
            close(dissipated, energy, 1e-12 * energy, &what);
            close(released, drop, 1e-12 * drop, &what);
            close(state.jump_plastic.x - start.jump_plastic.x, opening, 1e-15, &what);
        }
    }
}

/// Slip one way to the apex and the other way behind it, held together by dilatancy: from σ = −4, τ = −3 by (4, 10)e-4,
///
/// ```text
/// slip d = −1 from s = 1/6, σ = −4/3, to s = 5/18, σ = 0:  (6 s − 1)/h,  h = K_T + μ K_N tanψ = 3e4
/// slip d = +1 over the other 13/18:  (26 · 13/18)/h,  σ = K_N K_T/h (4 − 0.5 · 10)e-4 · 13/18
/// ```
#[test]
fn dilatancy_holds_faces_together_past_the_apex() {
    let law = Coulomb { normal_stiffness: Some(4e4), friction_coefficient: 1.0, dilatancy: 0.5, ..BLOCK };
    let start = Law::Coulomb(law).initial_state(Local::new(-4.0, -3.0, 0.0), 0.0).unwrap();
    let (before, after) = (2.0 / 3.0 / 3e4, 26.0 * 13.0 / 18.0 / 3e4);
    let sigma = -4e4 / 3.0 * 1e-4 * 13.0 / 18.0;
    for parts in [1, 2, 3, 17] {
        let (state, dissipated, released) = walk(&law, &start, [4e-4, 1e-3], parts);
        close(state.traction.x, sigma, 1e-12, "σ");
        close(state.traction.y, -sigma, 1e-12, "τ");
        close(state.jump_plastic.x - start.jump_plastic.x, 0.5 * (before + after), 1e-15, "opening");
        close(state.jump_plastic.y - start.jump_plastic.y, after - before, 1e-15, "slip");
        close(dissipated, before * 0.25 * 4.0 / 3.0 - after * 0.25 * sigma, 1e-15, "dissipated");
        assert_eq!(released, 0.0);
    }
    // ways through the apex and on either side of it end close to each other
    let end = Local::new(1e-4, 2.5e-4, 0.0);
    for part in 1..100 {
        for aside in [-1e-9, 0.0, 1e-9] {
            let jump = -end * part as f64 / 70.0 + Local::new(0.0, aside, 0.0);
            let old = State { jump, jump_plastic: Local::zeros(), ..start };
            let sigma = respond(&law, [end[0], end[1]], &old).traction.x;
            close(sigma, -4e4 / 3.0 * 0.25e-4, if aside == 0.0 { 1e-12 } else { 1e-4 }, "σ");
        }
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
fn an_open_interface_carries_nothing_and_closes_where_it_is() {
    let law = Coulomb { cohesion: 0.3, ..BLOCK };
    let state = Law::Coulomb(law).initial_state(Local::zeros(), 1e-4).unwrap();
    let open = respond(&law, [-0.9e-4, 2e-4], &state);
    assert_eq!((open.traction, open.stiffness, open.state.status), (Local::zeros(), LocalMatrix::zeros(), 4));
    let closed = respond(&law, [-2e-4, 2.11e-4], &open.state);
    close(closed.traction.x, -1.0, 1e-12, "σ = K_N (r_n + g)");
    close(closed.traction.y, 0.1, 1e-12, "τ from where it closed, a part 1/11 of the way");
}

#[test]
fn dilatancy_presses_a_confined_interface() {
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
fn the_elastic_law_adds_its_initial_traction() {
    let springs = Elastic::springs(1e3, 0.0);
    let initial = Local::new(-2.0, 0.5, 0.0); // a direction without stiffness still carries it
    let law = Law::Elastic(springs);
    let state = law.initial_state(initial, 0.0).unwrap();
    let mut way = state;
    for jump in [Local::new(1e-3, 1.0, 0.0), Local::new(-1e-3, 2.0, 0.0)] {
        let response = law.respond(jump, &way, STEPPING).unwrap();
        assert_eq!(response.traction, springs.traction(jump, initial));
        way = response.state;
    }
}

#[test]
fn an_initial_traction_must_be_one_the_interface_can_carry() {
    let law = Law::Coulomb(BLOCK);
    let state = law.initial_state(Local::new(-2.0, 1.0, 0.0), 0.0).unwrap();
    close(state.jump_plastic.x, 2e-4, 1e-18, "−K⁻¹ t₀");
    assert_eq!(law.respond(Local::zeros(), &state, STEPPING).unwrap().traction, Local::new(-2.0, 1.0, 0.0));
    assert_eq!(law.initial_state(Local::new(-2.0, 1.3, 0.0), 0.0).unwrap_err().key, "initial_traction");
    assert_eq!(law.initial_state(Local::new(1.0, 0.0, 0.0), 0.0).unwrap_err().key, "initial_traction");
    // faces that overlap press on each other
    let pressed = law.initial_state(Local::zeros(), -1e-3).unwrap();
    close(pressed.traction.x, -1e-3 * BLOCK.elastic_stiffness()[N], 1e-12, "−K_N times the overlap");
    assert_eq!(law.respond(Local::zeros(), &pressed, STEPPING).unwrap().traction, pressed.traction);
    assert_eq!(law.initial_state(Local::zeros(), f64::NAN).unwrap_err().key, "initial_gap");
}

#[test]
fn dilatancy_ends_at_its_slip_whatever_the_steps() {
    let law = Coulomb { dilatancy: 0.2, dilatancy_end: Some(1e-3), ..BLOCK };
    let [kn, kt, _] = law.elastic_stiffness();
    // pressed to -2 at a constant normal jump: dilatancy presses harder until it ends
    let start = respond(&law, [-2.0 / kn, 0.0], &State::default()).state;
    for parts in [1, 2, 7, 100] {
        let (mut state, mut spent) = (start, 0.0);
        for k in 1..=parts {
            let response = respond(&law, [-2.0 / kn, 4e-3 * k as f64 / parts as f64], &state);
            spent += response.dissipation;
            state = response.state;
        }
        // r_n^p = tanψ · 1e-3 and not more
        close(state.jump_plastic.x, 0.2e-3, 1e-15, "normal jump");
        close(state.traction.x, -2.0 - 0.2e-3 * kn, 1e-11, "normal traction");
        close(state.traction.y, 0.6 * 4.0, 1e-11, "friction");
        let slip = 4e-3 - 2.4 / kt;
        close(state.own[0], slip, 1e-15, "total slip");
        // (μ − tanψ) |σ| over the first mm, where σ goes from -2 to -4, then μ |σ|
        close(spent, 0.4 * 3.0 * 1e-3 + 2.4 * (slip - 1e-3), 1e-13, "dissipation");
        // back: no more dilation, and the slip goes on to count
        let back = respond(&law, [-2.0 / kn, 0.0], &state).state;
        close(back.jump_plastic.x, 0.2e-3, 1e-15, "normal jump after the way back");
        close(back.own[0], slip + 4e-3 - 4.8 / kt, 1e-14, "total slip after the way back");
    }
    assert_eq!(Coulomb { dilatancy_end: Some(0.0), ..law }.check().unwrap_err().key, "dilatancy_end");
}

/// Claim: in a viscous step friction lags: the shear is bounded by the normal traction of the state before, the normal one is the step's own, and
/// faces that were apart take no shear.
#[test]
fn in_a_viscous_step_the_limit_of_friction_is_that_of_the_state_before() {
    let law = Coulomb { cohesion: 0.5, ..BLOCK };
    let [kn, kt, _] = law.elastic_stiffness();
    let lagged =
        |jump: [f64; 2], old: &State| law.respond_lagged(local(&jump), old, STEPPING, false).unwrap();
    let pressed = respond(&law, [-4.0 / kn, 0.0], &State::default()).state;
    // pressed by 4 before, by 1 now: τ = 0.5 + 0.6 · 4
    let slides = lagged([-1.0 / kn, 1e-3], &pressed);
    close(slides.traction.x, -1.0, 1e-12, "normal traction");
    close(slides.traction.y, 0.5 + 0.6 * 4.0, 1e-12, "limit of the state before");
    close(respond(&law, [-1.0 / kn, 1e-3], &pressed).traction.y, 0.5 + 0.6, 1e-12, "the law's own limit");
    let sticks = lagged([-1.0 / kn, 2.0 / kt], &pressed);
    close(sticks.traction.y, 2.0, 1e-12, "stick");
    let apart = respond(&law, [1e-3, 0.0], &State::default()).state;
    let meets = lagged([-1.0 / kn, 1e-3], &apart);
    close(meets.traction.x, -1.0, 1e-12, "faces that meet");
    assert_eq!(meets.traction.y, 0.0, "faces that were apart take no shear");
    // with dilatancy, and where cohesion is lost, the law answers as always
    for law in [Coulomb { dilatancy: 0.1, ..law }, Coulomb { cohesion_lost: LossOfCohesion::AtSlip, ..law }] {
        let jump = local(&[-1.0 / kn, 1e-3]);
        let (lagged, own) =
            (law.respond_lagged(jump, &pressed, STEPPING, false), respond(&law, [-1.0 / kn, 1e-3], &pressed));
        assert_eq!(lagged.unwrap().traction, own.traction);
    }
}

/// Claim: at rest faces that are apart, by however little, carry nothing; those that touch carry what their springs do.
#[test]
fn faces_that_are_apart_at_rest_carry_nothing() {
    let [kn, kt, _] = BLOCK.elastic_stiffness();
    let rest = |jump: [f64; 2]| BLOCK.at_rest(local(&jump), Local::zeros(), &State::default().own);
    assert_eq!(rest([1e-12, 3e-4]), Local::zeros());
    assert_eq!(rest([0.5, 0.0]), Local::zeros());
    assert_eq!(rest([-1e-4, 3e-4]), Local::new(-1e-4 * kn, 3e-4 * kt, 0.0));
}

#[test]
fn cohesion_that_is_lost_at_slip_is_gone_for_good_and_its_energy_told() {
    let law = Coulomb { cohesion: 1.5, cohesion_lost: LossOfCohesion::AtSlip, ..BLOCK };
    let [kn, kt, _] = law.elastic_stiffness();
    let pressed = respond(&law, [-2.0 / kn, 0.0], &State::default()).state;
    let limit = 1.5 + 0.6 * 2.0;
    let stuck = respond(&law, [-2.0 / kn, 0.999_999 * limit / kt], &pressed);
    assert_eq!((stuck.state.status, stuck.state.own[1]), (0, 0.0));
    // at the first slip the traction falls by c at once: c²/(2 K_T) is released, friction on c/K_T dissipated
    let slipped = respond(&law, [-2.0 / kn, 5e-4], &pressed);
    close(slipped.traction.y, 1.2, 1e-12, "friction alone");
    close(slipped.released, 1.5 * 1.5 / (2.0 * kt), 1e-15, "released");
    close(slipped.dissipation, 1.2 * (5e-4 - 1.2 / kt), 1e-15, "dissipated");
    assert_eq!(slipped.state.own[1], 1.0);
    let stored = |state: &State| Law::Coulomb(law).stored(state);
    // work on the way: elastic up to the limit, then friction
    let work = 0.5 * limit * limit / kt + 1.2 * (5e-4 - limit / kt);
    close(
        stored(&slipped.state) - stored(&pressed) + slipped.dissipation + slipped.released,
        work,
        1e-15,
        "energy",
    );
    let again = respond(&law, [-2.0 / kn, 1e-3], &slipped.state);
    assert_eq!((again.released, again.traction.y), (0.0, slipped.traction.y));
    // faces that were apart have none either
    let apart = respond(&law, [1e-3, 0.0], &pressed);
    assert_eq!((apart.state.own[1], apart.state.status), (1.0, 4));
    let met = respond(&law, [-2.0 / kn, 1e-3], &apart.state);
    close(met.traction.y, 1.2, 1e-12, "friction of faces that were apart");
    // by default they have it again
    let apart = respond(&Coulomb { cohesion_lost: LossOfCohesion::Never, ..law }, [1e-3, 0.0], &pressed);
    assert_eq!(apart.state.own[1], 0.0);
}
