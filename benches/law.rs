//! Cost of one evaluation of each law: elastic, plastic by Newton, plastic by the safe fallback, under error control.
#![allow(missing_docs)]

use divan::{Bencher, black_box};
use midplane::law::{Cracking, Elastic, Integration, Law, Local, Response, State, Unloading, local};

fn main() {
    divan::main();
}

/// The paper's example 2 (§4.2), energies read as N/mm, with dilatancy.
const LAW: Cracking = Cracking {
    normal_stiffness: 1e7,
    tangential_stiffness: 1e7,
    tensile_strength: 3.0,
    cohesion: 4.0,
    tan_friction: 0.8785,
    tan_friction_residual: None,
    fracture_energy_i: 2e-4,
    fracture_energy_iia: 2e-3,
    dilatancy_stress: 500.0,
    unloading: Unloading::Plastic,
    alpha_tensile_strength: 0.0,
    alpha_cohesion: 0.0,
    alpha_tan_friction: 0.0,
    alpha_dilatancy_stress: 0.0,
    alpha_dilatancy_cohesion: 0.0,
};

fn respond(law: Cracking, jump: [f64; 2], old: &State, integration: Integration) -> Response {
    let answer = Law::Cracking(law).respond(local(&black_box(jump)), black_box(old), integration);
    answer.unwrap_or_else(|unresolved| unreachable!("{unresolved}"))
}

fn opened() -> State {
    respond(LAW, [2e-5, 1e-5], &State::default(), Integration::Tolerance(1e-6)).state
}

#[divan::bench]
fn elastic_law(bencher: Bencher) {
    let springs = Elastic::springs(1e7, 1e7);
    bencher
        .bench_local(|| black_box(springs).traction(black_box(Local::new(1e-6, 2e-6, 0.0)), Local::zeros()));
}

#[divan::bench]
fn elastic_law_full_answer(bencher: Bencher) {
    let springs = Law::Elastic(Elastic::springs(1e7, 1e7));
    let old = State::default();
    let jump = Local::new(1e-6, 2e-6, 0.0);
    bencher.bench_local(|| springs.respond(black_box(jump), black_box(&old), Integration::Tolerance(1e-4)));
}

#[divan::bench]
fn cracking_elastic(bencher: Bencher) {
    let old = opened();
    bencher.bench_local(|| respond(LAW, [1.99e-5, 1e-5], &old, Integration::Tolerance(1e-4)));
}

#[divan::bench]
fn cracking_tension_newton(bencher: Bencher) {
    let old = opened();
    bencher.bench_local(|| respond(LAW, [2.1e-5, 1.05e-5], &old, Integration::BackwardEuler(1)));
}

#[divan::bench]
fn cracking_compression_newton(bencher: Bencher) {
    let old = respond(LAW, [-5e-7, 2e-5], &State::default(), Integration::Tolerance(1e-6)).state;
    bencher.bench_local(|| respond(LAW, [-5e-7, 2.1e-5], &old, Integration::BackwardEuler(1)));
}

#[divan::bench]
fn cracking_tension_fallback(bencher: Bencher) {
    let old = opened();
    bencher.bench_local(|| LAW.respond_nested(black_box(Local::new(2.1e-5, 1.05e-5, 0.0)), black_box(&old)));
}

#[divan::bench]
fn cracking_compression_fallback(bencher: Bencher) {
    let old = respond(LAW, [-5e-7, 2e-5], &State::default(), Integration::Tolerance(1e-6)).state;
    bencher.bench_local(|| LAW.respond_nested(black_box(Local::new(-5e-7, 2.1e-5, 0.0)), black_box(&old)));
}

#[divan::bench]
fn cracking_under_error_control(bencher: Bencher) {
    let old = opened();
    bencher.bench_local(|| respond(LAW, [2.1e-5, 1.05e-5], &old, Integration::Tolerance(1e-4)));
}

/// The same law where cracks close; the lines below repeat those above.
const CLOSING: Cracking = Cracking { unloading: Unloading::Closing, ..LAW };

fn opened_to_close() -> State {
    respond(CLOSING, [2e-5, 1e-5], &State::default(), Integration::Tolerance(1e-6)).state
}

#[divan::bench]
fn closing_elastic(bencher: Bencher) {
    let old = opened_to_close();
    bencher.bench_local(|| respond(CLOSING, [1.99e-5, 1e-5], &old, Integration::Tolerance(1e-4)));
}

#[divan::bench]
fn closing_tension_newton(bencher: Bencher) {
    let old = opened_to_close();
    bencher.bench_local(|| respond(CLOSING, [2.1e-5, 1.05e-5], &old, Integration::BackwardEuler(1)));
}

#[divan::bench]
fn closing_compression_newton(bencher: Bencher) {
    let old = respond(CLOSING, [-5e-7, 2e-5], &State::default(), Integration::Tolerance(1e-6)).state;
    bencher.bench_local(|| respond(CLOSING, [-5e-7, 2.1e-5], &old, Integration::BackwardEuler(1)));
}

#[divan::bench]
fn closing_under_error_control(bencher: Bencher) {
    let old = opened_to_close();
    bencher.bench_local(|| respond(CLOSING, [2.1e-5, 1.05e-5], &old, Integration::Tolerance(1e-4)));
}
