//! Claim: extreme parameters and ways are answered or refused, never mangled.
//!
//! Friction from none to a great deal, no strength at all, vertex outside, energies too small and too large, energies
//! in the wrong order, no dilatancy at σ = 0, unloading, reversal and closing.

use crate::common::laws::{EXAMPLE_2, Random, close};
use crate::common::scene;
use midplane::law::path::{ComponentControl, Controlled, LawPath, PathError, PathSegment, drive};
use midplane::law::{
    Cracking, Inadmissible, Integration, Law, Local, LocalMatrix, PointLaw, State, Unloading, WORK,
};

fn refused(law: &Cracking, key: &str, parts: &[&str]) {
    let Inadmissible { key: blamed, what, help } = law.check().unwrap_err();
    assert_eq!(blamed, key, "{what}; {help}");
    let message = format!("{what}; {help}");
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is not in: {message}");
    }
}

fn walk(law: &Cracking, ways: &[[f64; 2]], integration: Integration) -> Vec<State> {
    law.check().unwrap();
    let mut state = State::default();
    ways.iter()
        .map(|&[n, t]| {
            let response = Law::Cracking(*law).respond(Local::new(n, t, 0.0), &state, integration).unwrap();
            assert!(response.stiffness.iter().all(|x| x.is_finite()), "{response:?}");
            assert!(response.state.own[WORK] >= state.own[WORK]);
            assert!(response.dissipation >= 0.0);
            state = response.state;
            state
        })
        .collect()
}

const STEPPINGS: [Integration; 2] = [Integration::Tolerance(1e-4), Integration::BackwardEuler(5)];

#[test]
fn b13_friction_from_none_to_ten() {
    refused(&Cracking { tan_friction: 0.0, ..EXAMPLE_2 }, "tan_friction", &["0"]);
    for friction in [1e-12, 1.0, 10.0] {
        let law = Cracking { tan_friction: friction, cohesion: 3.0 * friction.max(1.0), ..EXAMPLE_2 };
        for integration in STEPPINGS {
            for state in walk(&law, &[[-1e-6, 0.0], [-1e-6, 5e-5], [1e-5, 5e-5], [5e-5, 2e-4]], integration) {
                assert!(state.traction.iter().all(|x| x.is_finite()));
            }
        }
        // the peak at σ = −10: √((c−σt)² − (c−χt)²)
        let (c, chi, sigma) = (law.cohesion, law.tensile_strength, -10.0);
        let peak = ((chi - sigma) * friction * (2.0 * c - friction * (chi + sigma))).sqrt();
        let slip = peak / law.tangential_stiffness;
        let last = *walk(&law, &[[-1e-6, 0.0], [-1e-6, slip]], STEPPINGS[0]).last().unwrap();
        close(last.traction.y, peak, 1e-12 * peak, "peak");
        let beyond = *walk(&law, &[[-1e-6, 0.0], [-1e-6, 2.0 * slip]], STEPPINGS[0]).last().unwrap();
        assert_eq!(beyond.status, 2);
    }
}

#[test]
fn b14_without_tensile_strength_tension_is_free_of_stress_from_the_start() {
    let law = Cracking { tensile_strength: 0.0, fracture_energy_i: 0.0, ..EXAMPLE_2 };
    for integration in STEPPINGS {
        for state in walk(&law, &[[1e-5, 0.0], [2e-5, 1e-5], [3e-5, 1e-4]], integration) {
            assert!(state.traction.amax() <= 1e-12 * law.cohesion, "{state:?}");
            assert_eq!(state.status, 4);
        }
        // the vertex is at the origin: in compression τ² = σt (σt − 2c) is still there
        let sigma = -2.0;
        let peak = (sigma * law.tan_friction * (sigma * law.tan_friction - 2.0 * law.cohesion)).sqrt();
        let sheared = walk(&law, &[[-2e-7, 0.0], [-2e-7, peak / 1e7]], integration)[1];
        close(sheared.traction.y, peak, 1e-12 * peak, "peak");
    }
}

#[test]
fn b15_without_any_strength_the_law_is_coulomb_friction() {
    let law = Cracking {
        tensile_strength: 0.0,
        cohesion: 0.0,
        fracture_energy_i: 0.0,
        fracture_energy_iia: 0.0,
        ..EXAMPLE_2
    };
    for integration in STEPPINGS {
        let states =
            walk(&law, &[[0.0, 1e-6], [1e-6, 1e-6], [0.0, 0.0], [-1e-6, 0.0], [-1e-6, 1e-4]], integration);
        assert_eq!(states[1].traction, Local::zeros());
        let limit = 0.8785 * -states[4].traction.x;
        close(states[4].traction.y, limit, 1e-12, "τ = μ |σ|");
        assert_eq!((states[4].own[WORK], states[4].status), (0.0, 2));
    }
}

#[test]
fn b16_a_vertex_beyond_the_asymptotes_is_refused() {
    let law = Cracking { cohesion: 2.0, ..EXAMPLE_2 };
    refused(&law, "cohesion", &["2", "3", "0.8785", "2.6355"]);
    // on the edge the hyperbola is a cone with its corner at the vertex: answered
    let cone = Cracking { cohesion: 3.0 * 0.8785, ..EXAMPLE_2 };
    for integration in STEPPINGS {
        let states = walk(&cone, &[[1e-6, 1e-7], [1e-5, 1e-6], [5e-5, 5e-6]], integration);
        assert!(states.iter().all(|state| state.traction.iter().all(|x| x.is_finite())));
    }
}

#[test]
fn b17_an_energy_too_small_for_the_stiffness_is_refused_with_the_least_stiffness() {
    // K_N > χ₀² e^|α| / G_I = 9/8e-7 = 1.125e7
    let law = Cracking { fracture_energy_i: 8e-7, ..EXAMPLE_2 };
    refused(&law, "normal_stiffness", &["1.125e7", "1e7", "tensile_strength"]);
    assert!(Cracking { normal_stiffness: 1.126e7, ..law }.check().is_ok());
    let shaped = Cracking { alpha_tensile_strength: -1.0, ..law };
    refused(&shaped, "normal_stiffness", &["3.058"]);

    // in shear the rule is a rule of thumb: c₀²/G_II = 8e3, χ₀ t c₀/G_I = 5.3e4
    assert!(EXAMPLE_2.warnings().is_empty());
    let soft = Cracking { tangential_stiffness: 5e4, ..EXAMPLE_2 };
    assert!(soft.check().is_ok());
    assert!(soft.warnings()[0].what.contains("tangential_stiffness"), "{:?}", soft.warnings());
    // friction loss: |σ| c₀ (t₀ − t_r)/G_II reaches K_T = 2e5 at 2e5·2e-3/(4·0.3785) = 264: far off; at 2e-4, G_I 1e-4: 26.4
    let losing = Cracking { tan_friction_residual: Some(0.5), tangential_stiffness: 2e5, ..EXAMPLE_2 };
    assert!(losing.warnings().is_empty());
    let brittle = Cracking { fracture_energy_i: 2e-4, fracture_energy_iia: 2e-4, ..losing };
    assert!(
        brittle.warnings().iter().any(|warning| warning.what.contains("2.642e1")),
        "{:?}",
        brittle.warnings()
    );
}

#[test]
fn b18_huge_energies_are_perfect_plasticity() {
    let law = Cracking { fracture_energy_i: 1e6, fracture_energy_iia: 1e6, ..EXAMPLE_2 };
    for integration in STEPPINGS {
        let states = walk(&law, &[[1e-4, 0.0], [1e-3, 0.0]], integration);
        close(states[1].traction.x, 3.0, 1e-6, "plateau in tension");
        let peak = ((4.0_f64 + 10.0 * 0.8785).powi(2) - (4.0_f64 - 3.0 * 0.8785).powi(2)).sqrt();
        let states = walk(&law, &[[-1e-6, 0.0], [-1e-6, 1e-4], [-1e-6, 1e-2]], integration);
        close(states[2].traction.y, peak, 1e-6, "plateau in shear");
    }
}

#[test]
fn b19_cohesion_may_go_first_only_as_long_as_the_vertex_stays_inside() {
    let reversed = Cracking { fracture_energy_i: 2e-3, fracture_energy_iia: 2e-4, ..EXAMPLE_2 };
    refused(&reversed, "fracture_energy_iia", &["cohesion", "tensile_strength"]);
    // c = 40 (1 − 1.25 ξ), χ t = 2.6 (1 − ξ): c falls below χ t close to the end
    refused(
        &Cracking { cohesion: 40.0, fracture_energy_iia: 1.6e-4, ..EXAMPLE_2 },
        "fracture_energy_iia",
        &[],
    );
    // the tensile strength is gone early, its energy is only nominally the larger one
    let hastened = Cracking {
        cohesion: 40.0,
        fracture_energy_iia: 1.999e-4,
        alpha_tensile_strength: -2.0,
        alpha_cohesion: 0.0,
        ..EXAMPLE_2
    };
    refused(&hastened, "fracture_energy_iia", &[]);
    assert!(Cracking { fracture_energy_iia: 2e-4, ..EXAMPLE_2 }.check().is_ok());
}

#[test]
fn b20_without_dilatancy_sigma_sticks_to_zero() {
    // W ≥ G_I and opening with slip: nothing is divided by σ_dil = 0, σ is 0 and not −0.0…1
    for integration in
        [Integration::Tolerance(1e-6), Integration::BackwardEuler(1), Integration::BackwardEuler(50)]
    {
        let ways: Vec<[f64; 2]> = (1..=100).map(|k| [2e-6 * k as f64, 2e-6 * k as f64]).collect();
        let states = walk(&EXAMPLE_2, &ways, integration);
        let first = states.iter().position(|state| state.traction.x == 0.0).unwrap();
        assert!(states[first..].iter().all(|state| state.traction.x == 0.0 && state.status >= 3));
    }
}

#[test]
fn b21_unloading_is_elastic_reversal_yields_on_the_other_side_and_closing_carries_at_once() {
    let law = EXAMPLE_2;
    let elastic = LocalMatrix::identity() * 1e7;
    for integration in STEPPINGS {
        // shear at σ = −5, back, and beyond
        let mut state = walk(&law, &[[-5e-7, 0.0], [-5e-7, 1e-4]], integration)[1];
        let (tau, work) = (state.traction.y, state.own[WORK]);
        let back =
            Law::Cracking(law).respond(Local::new(-5e-7, 1e-4 - 5e-7, 0.0), &state, integration).unwrap();
        assert_eq!((back.stiffness, back.dissipation, back.state.own[WORK]), (elastic, 0.0, work));
        close(back.traction.y, tau - 5.0, 1e-9, "unloading");
        state =
            Law::Cracking(law).respond(Local::new(-5e-7, 9e-5, 0.0), &back.state, integration).unwrap().state;
        assert!(state.traction.y < 0.0 && state.own[WORK] > work && state.status == 2);

        // open, close: compression from the irreversible opening on
        let open = walk(&law, &[[8e-5, 0.0]], integration)[0];
        let closed = Local::new(open.jump_plastic.x - 1e-6, 0.0, 0.0);
        let response = Law::Cracking(law).respond(closed, &open, integration).unwrap();
        close(response.traction.x, -10.0, 1e-9, "closing");
        assert_eq!((response.stiffness, response.state.own[WORK]), (elastic, open.own[WORK]));
    }
    // and never a negative dissipation on any zigzag
    let mut random = Random(21);
    let mut state = State::default();
    for _ in 0..20_000 {
        let jump = Local::new(random.between(-2e-6, 4e-6), random.between(-2e-5, 2e-5), 0.0);
        let response = Law::Cracking(law).respond(jump, &state, STEPPINGS[0]).unwrap();
        assert!(response.dissipation >= 0.0 && response.state.own[WORK] >= state.own[WORK]);
        state = response.state;
    }
}

/// Stiffness from soft to nearly rigid changes the opening by σ/K_N and nothing else.
#[test]
fn a_nearly_rigid_interface_cracks_like_a_stiff_one() {
    for stiffness in [1e7, 1e10, 1e13, 1e16] {
        let law = Cracking { normal_stiffness: stiffness, tangential_stiffness: stiffness, ..EXAMPLE_2 };
        let state = walk(&law, &[[1e-4, 0.0]], Integration::Tolerance(1e-6))[0];
        let plastic = 1e-4 - state.traction.x / stiffness;
        close(state.traction.x, 3.0 * (-3.0 * plastic / 2e-4).exp(), 1e-5, "σ");
    }
}

#[test]
fn stiffnesses_of_which_one_is_lost_beside_the_other_are_refused() {
    for factor in [1e13, 1e-13] {
        let law = Cracking { tangential_stiffness: factor * EXAMPLE_2.normal_stiffness, ..EXAMPLE_2 };
        refused(&law, "tangential_stiffness", &["normal_stiffness", "1e12"]);
    }
}

#[test]
fn parameters_that_are_no_numbers_are_refused_by_name() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        refused(&Cracking { normal_stiffness: bad, ..EXAMPLE_2 }, "normal_stiffness", &[]);
        refused(&Cracking { tangential_stiffness: bad, ..EXAMPLE_2 }, "tangential_stiffness", &[]);
        refused(&Cracking { tensile_strength: bad, ..EXAMPLE_2 }, "tensile_strength", &[]);
        refused(&Cracking { cohesion: bad, ..EXAMPLE_2 }, "cohesion", &[]);
        refused(&Cracking { tan_friction: bad, ..EXAMPLE_2 }, "tan_friction", &[]);
        refused(&Cracking { tan_friction_residual: Some(bad), ..EXAMPLE_2 }, "tan_friction_residual", &[]);
        refused(&Cracking { fracture_energy_i: bad, ..EXAMPLE_2 }, "fracture_energy_i", &[]);
        refused(&Cracking { fracture_energy_iia: bad, ..EXAMPLE_2 }, "fracture_energy_iia", &[]);
        refused(&Cracking { dilatancy_stress: bad, ..EXAMPLE_2 }, "dilatancy_stress", &[]);
    }
    refused(&Cracking { fracture_energy_i: 0.0, ..EXAMPLE_2 }, "fracture_energy_i", &["0"]);
    refused(
        &Cracking { tan_friction_residual: Some(0.9), ..EXAMPLE_2 },
        "tan_friction_residual",
        &["0.8785"],
    );
    refused(&Cracking { alpha_cohesion: f64::NAN, ..EXAMPLE_2 }, "alpha_cohesion", &[]);
}

#[test]
fn work_of_many_times_g_i_is_resolved_at_a_tight_tolerance() {
    // the rounding of W counts c/G_I times: below it no sub-step is short enough
    let law = Cracking { fracture_energy_i: 2e-4, fracture_energy_iia: 1.002, ..EXAMPLE_2 };
    let (n, mut state) = (-5.0 / law.normal_stiffness, State::default());
    for t in [0.0, 0.1, 8.0] {
        let law = Law::Cracking(law);
        state = law.respond(Local::new(n, t, 0.0), &state, Integration::Tolerance(1e-9)).unwrap().state;
    }
    close(state.traction.y, law.tan_friction * 5.0, 1e-7, "friction");
    close(state.own[WORK], law.fracture_energy_iia, 1e-9, "work");
}

#[test]
fn a_way_that_cannot_be_resolved_ends_and_says_so() {
    // so brittle under shear that it snaps, and so dilatant that the jump along n runs away
    let law = Cracking {
        tangential_stiffness: 9e7,
        normal_stiffness: 1.7e5,
        tensile_strength: 3.0,
        cohesion: 4400.0,
        tan_friction: 1.36,
        tan_friction_residual: Some(0.68),
        fracture_energy_i: 2.6e-4,
        fracture_energy_iia: 3e-3,
        dilatancy_stress: 10.0,
        unloading: Unloading::Plastic,
        ..EXAMPLE_2
    };
    let way = |control, end| ComponentControl { control, start: 0.0, end };
    let (n, t) = (way(Controlled::Stress, -7.5), way(Controlled::Displacement, -2.0));
    let path = LawPath { program: vec![PathSegment { n, t, points: 4 }], initial: None };
    let driven = drive(&Law::Cracking(law), &path, &State::default(), Integration::Tolerance(1e-4));
    let Err(PathError::NoEquilibrium { reason, .. }) = driven else { panic!("{driven:?}") };
    assert!(reason.contains("more points"), "{reason}");
}

#[test]
fn a_traction_that_is_no_number_carries_nothing() {
    let stated = scene::law("coulomb")
        .with("tangential_stiffness", 9e4)
        .with("friction_coefficient", 1.0)
        .with("cohesion", 0.1)
        .with("dilatancy", 0.03)
        .with_in("closure", "initial_stiffness", 2e3)
        .with_in("closure", "maximum", 2e-5);
    let law: Law = serde_json::from_value(stated.into()).unwrap();
    let way = |start, end| ComponentControl { control: Controlled::Stress, start, end };
    let program = vec![
        PathSegment { n: way(0.0, -6.0), t: way(0.0, -0.0095), points: 6 },
        PathSegment { n: way(-6.0, -6.0), t: way(-0.0095, -7.5e20), points: 2 },
    ];
    let driven =
        drive(&law, &LawPath { program, initial: None }, &State::default(), Integration::Tolerance(1e-4));
    let Err(PathError::NoEquilibrium { reason, rows, .. }) = driven else { panic!("{driven:?}") };
    assert!(reason.contains("cannot carry"), "{reason}");
    assert!(rows.iter().all(|row| row.state.traction.iter().all(|t| t.is_finite())));
}
