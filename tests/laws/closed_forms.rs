//! Claim: the cracking law meets its closed forms.
//!
//! With ξ = W/G_I, S the shape of the loss and u^p the irreversible jump (derived from the law's own definition, paper
//! §3.2; α = 0 unless said):
//!
//! ```text
//! pure tension        u = σ/K_N + (G_I/χ₀) [−e^{−α} ln(1−ξ) + (1−e^{−α}) ξ],   σ = χ(W),   area G_I
//! constant σ < 0      peak √((c₀−σt)² − (c₀−χ₀t)²),  u_t^p = ∫ dW/(τ + σt),    area above friction G_II
//! σ → −∞              τ − |σ| t → c₀ exp(−c₀ u_t^p/G_II)
//! one Euler step      W = (W_n + χ₀u^p)/(1 + χ₀u^p/G_I)
//! σ held at 0         u_t^p = ∫ dW/√(χt(2c−χt)),  τ = 0 at W = G_I
//! ```

use crate::common::laws::{EXAMPLE_2, Reference, close};
use midplane::law::path::{ComponentControl, Controlled, LawPath, PathRow, PathSegment, drive};
use midplane::law::{Cracking, Integration, Law, Local, PointLaw, State, WORK};

fn jump(start: f64, end: f64) -> ComponentControl {
    ComponentControl { control: Controlled::Displacement, start, end }
}

fn stress(start: f64, end: f64) -> ComponentControl {
    ComponentControl { control: Controlled::Stress, start, end }
}

fn along(law: &Cracking, program: Vec<PathSegment>, integration: Integration) -> Vec<PathRow> {
    law.check().unwrap();
    drive(&Law::Cracking(*law), &LawPath { program, initial: None }, &State::default(), integration).unwrap()
}

fn tension(law: &Cracking, opening: f64, points: usize, integration: Integration) -> Vec<PathRow> {
    along(law, vec![PathSegment { n: jump(0.0, opening), t: jump(0.0, 0.0), points }], integration)
}

/// Compression σ first, then slip at that σ.
fn shear(law: &Cracking, sigma: f64, slip: f64, points: usize, integration: Integration) -> Vec<PathRow> {
    let program = vec![
        PathSegment { n: stress(0.0, sigma), t: jump(0.0, 0.0), points: 1 },
        PathSegment { n: stress(sigma, sigma), t: jump(0.0, slip), points },
    ];
    along(law, program, integration)
}

/// ∫ f from a to b by Gauss–Legendre (5 points) in equal parts.
fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    const POINTS: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let parts = 400;
    let half = 0.5 * (b - a) / parts as f64;
    (0..parts)
        .flat_map(|k| POINTS.map(|(x, weight)| weight * half * f(a + half * ((2 * k + 1) as f64 + x))))
        .sum()
}

#[test]
fn pure_tension_follows_its_closed_form() {
    for alpha in [-1.2, 0.0, 0.8] {
        let law = Cracking { alpha_tensile_strength: alpha, ..EXAMPLE_2 };
        let (kn, chi, energy) = (law.normal_stiffness, law.tensile_strength, law.fracture_energy_i);
        let e = (-alpha).exp();
        let sigma_at = |xi: f64| chi * (1.0 - e * xi / (1.0 + (e - 1.0) * xi));
        let opening = |xi: f64| sigma_at(xi) / kn + energy / chi * (-e * (1.0 - xi).ln() + (1.0 - e) * xi);
        for row in &tension(&law, 5e-4, 50, Integration::Tolerance(1e-10))[1..] {
            let (mut lo, mut hi) = (0.0, 1.0); // u(ξ) grows: ξ by halving
            for _ in 0..60 {
                let middle = 0.5 * (lo + hi);
                if opening(middle) < row.state.jump.x { lo = middle } else { hi = middle }
            }
            close(row.state.traction.x, sigma_at(lo), 1e-9, "σ(u)");
            close(row.state.own[WORK] / energy, lo, 1e-9, "W(u)/G_I");
        }
    }
}

#[test]
fn linear_softening_in_work_is_exponential_in_opening() {
    let law = EXAMPLE_2;
    for row in &tension(&law, 3e-4, 30, Integration::Tolerance(1e-10))[1..] {
        let spent = row.state.jump_plastic.x * law.tensile_strength / law.fracture_energy_i;
        close(row.state.traction.x, law.tensile_strength * (-spent).exp(), 1e-9, "σ");
    }
}

#[test]
fn one_backward_euler_step_in_tension_is_closed() {
    let law = EXAMPLE_2;
    let (chi, energy) = (law.tensile_strength, law.fracture_energy_i);
    let mut old = State::default();
    for opening in [1e-5, 5e-5, 3e-4] {
        let new = Law::Cracking(law)
            .respond(Local::new(opening, 0.0, 0.0), &old, Integration::BackwardEuler(1))
            .unwrap()
            .state;
        let plastic = new.jump_plastic.x - old.jump_plastic.x;
        let work = (old.own[WORK] + chi * plastic) / (1.0 + chi * plastic / energy);
        close(new.own[WORK] / energy, work / energy, 1e-13, "W/G_I");
        old = new;
    }
}

#[test]
fn shear_at_constant_compression_has_its_peak_its_slip_and_its_residual() {
    for (sigma, residual, alpha_c) in [(-1.0, 0.8785, 0.0), (-5.0, 0.8785, 0.0), (-20.0, 0.5, 1.5)] {
        let law = Cracking { tan_friction_residual: Some(residual), alpha_cohesion: alpha_c, ..EXAMPLE_2 };
        let (chi, c, t) = (law.tensile_strength, law.cohesion, law.tan_friction);
        let peak = ((c - sigma * t).powi(2) - (c - chi * t).powi(2)).sqrt();
        let at_peak = peak / law.tangential_stiffness;
        let rows = shear(&law, sigma, at_peak, 4, Integration::Tolerance(1e-8));
        close(rows.last().unwrap().state.traction.y, peak, 1e-12 * peak, "peak");
        assert_eq!(rows.last().unwrap().state.own[WORK], 0.0);

        let tau = |w: f64| {
            let now = law.strength_after(w);
            let (chi, c, t) = (now.tensile_strength, now.cohesion, now.tan_friction);
            ((c - sigma * t).powi(2) - (c - chi * t).powi(2)).sqrt()
        };
        let slip = |from: f64, to: f64| {
            integral(|w| 1.0 / (tau(w) + sigma * law.strength_after(w).tan_friction), from, to)
        };
        for row in &shear(&law, sigma, 4e-4, 10, Integration::Tolerance(1e-10))[2..] {
            let w = row.state.own[WORK];
            let expected = slip(0.0, w.min(law.fracture_energy_i)) + slip(law.fracture_energy_i.min(w), w);
            close(row.state.traction.y, tau(w), 1e-12 * peak, "τ_y(σ; W)");
            close(row.state.jump_plastic.y / expected, 1.0, 1e-9, "slip(W)");
        }

        let last = shear(&law, sigma, 3e-2, 3, Integration::Tolerance(1e-6)).pop().unwrap();
        close(last.state.traction.y, -sigma * residual, 1e-9, "residual friction");
    }
}

#[test]
fn under_very_high_compression_cohesion_is_lost_exponentially() {
    // the hyperbola is left for its asymptote like b²/2τ: 4²/(2·0.88·1e6) ≈ 1e-5
    let sigma = -1e6;
    let law = Cracking { fracture_energy_i: 2e-3, ..EXAMPLE_2 };
    for row in &shear(&law, sigma, 0.1 + 2e-3, 50, Integration::Tolerance(1e-9))[2..] {
        let slip = row.state.jump_plastic.y;
        let above = row.state.traction.y + sigma * law.tan_friction;
        let expected = law.cohesion * (-law.cohesion * slip / law.fracture_energy_iia).exp();
        if slip > 0.0 {
            close(above, expected, 1e-5 * law.cohesion, "τ − |σ| t");
        }
    }
}

/// Area under rows by the trapezium rule.
fn area(rows: &[PathRow], force: impl Fn(&State) -> f64, way: impl Fn(&State) -> f64) -> f64 {
    rows.windows(2)
        .map(|pair| {
            let (a, b) = (&pair[0].state, &pair[1].state);
            0.5 * (force(a) + force(b)) * (way(b) - way(a))
        })
        .sum()
}

#[test]
fn the_areas_under_the_curves_are_the_fracture_energies() {
    for alpha in [0.0, -1.0, 0.7] {
        let law = Cracking { alpha_tensile_strength: alpha, alpha_cohesion: alpha, ..EXAMPLE_2 };
        let rows = tension(&law, 3e-3, 100_000, Integration::Tolerance(1e-6)); // the peak is one of the rows
        let found = area(&rows, |s| s.traction.x, |s| s.jump.x) / law.fracture_energy_i;
        close(found, 1.0, 1e-6, "area in tension / G_I");

        for sigma in [-0.5, -30.0] {
            let rows = shear(&law, sigma, 2e-2, 100_000, Integration::Tolerance(1e-4));
            let (c, t) = (law.cohesion, law.tan_friction);
            let peak = ((c - sigma * t).powi(2) - (c - law.tensile_strength * t).powi(2)).sqrt();
            let above = |s: &State| match s.own[WORK] {
                0.0 => peak + sigma * t, // no slip before the peak
                _ => s.traction.y + s.traction.x * t,
            };
            let found = area(&rows, above, |s| s.jump_plastic.y) / law.fracture_energy_iia;
            close(found, 1.0, 1e-5, "area above friction / G_II");
        }
    }
}

#[test]
fn with_sigma_constrained_at_zero_the_shear_stress_is_gone_after_a_finite_slip() {
    // o07: opening and sliding in proportion; σ reaches 0 at W_z, then τ(W) = √(χt(2c−χt)) until W = G_I
    let reference = Reference::read("o07_mixed_prop_dil0");
    let Law::Cracking(law) = reference.law else { unreachable!() };
    let mut path = reference.path.clone();
    path.program[0].points = 3000;
    let rows = drive(&reference.law, &path, &State::default(), Integration::Tolerance(1e-10)).unwrap();
    let constrained: Vec<&State> = rows.iter().map(|row| &row.state).filter(|s| s.status == 3).collect();
    let tau = |w: f64| {
        let now = law.strength_after(w);
        let reach = now.tensile_strength * now.tan_friction;
        (reach * (2.0 * now.cohesion - reach)).sqrt()
    };
    let (first, last) = (constrained[0], constrained[constrained.len() - 10]);
    for state in [first, last] {
        assert_eq!(state.traction.x, 0.0);
        close(state.traction.y, tau(state.own[WORK]), 1e-12, "τ(W)");
    }
    // the integrand has a root at W = G_I: substitute W = G_I − v²
    let energy = law.fracture_energy_i;
    let v = |w: f64| (energy - w).sqrt();
    let expected = integral(|v| 2.0 * v / tau(energy - v * v), v(last.own[WORK]), v(first.own[WORK]));
    close((last.jump_plastic.y - first.jump_plastic.y) / expected, 1.0, 1e-9, "slip in Z");
    let end = rows.last().unwrap().state;
    assert_eq!((end.traction, end.status), (Local::zeros(), 4));
}

/// A case of the paper's example 2 (§4.2) at σ = −10 MPa, to ten digits by an independent program (adaptive
/// integration of u^p = ∫ dW/(τ + σt)): slip [m], τ [MPa], W [MPa m].
const LITERAL: [(f64, f64, f64); 7] = [
    (1e-5, 12.71186714, 3.427737047e-05),
    (5e-5, 12.71136257, 0.0001913421634),
    (1e-4, 12.71073161, 0.0003876447669),
    (2.5e-4, 12.70883692, 0.0009763631832),
    (5e-4, 12.70567319, 0.001956928342),
    (7.5e-4, 12.70250209, 0.00293670165),
    (1e-3, 12.69932364, 0.003915681264),
];
const NEWTON_PER_MILLIMETRE: [(f64, f64, f64); 7] = [
    (1e-5, 12.59738527, 3.382827463e-05),
    (5e-5, 11.98507013, 0.0001746867972),
    (1e-4, 11.66395445, 0.000324655421),
    (2.5e-4, 11.06737533, 0.000710569958),
    (5e-4, 10.29612472, 0.001179454774),
    (7.5e-4, 9.759203373, 0.001485889998),
    (1e-3, 9.400468213, 0.001681486123),
];

#[test]
fn example_2_of_the_paper_in_both_readings_of_its_energies() {
    let literal = Cracking { fracture_energy_i: 0.2, fracture_energy_iia: 2.0, ..EXAMPLE_2 };
    for (law, table) in [(literal, LITERAL), (EXAMPLE_2, NEWTON_PER_MILLIMETRE)] {
        let rows = shear(&law, -10.0, 1e-3, 400, Integration::Tolerance(1e-6));
        for (slip, tau, work) in table {
            let row = rows.iter().find(|row| (row.state.jump.y - slip).abs() < 1e-12).unwrap();
            close(row.state.traction.y, tau, 1e-6 * tau, "τ");
            close(row.state.own[WORK], work, 1e-6 * law.fracture_energy_iia, "W");
        }
    }
}

/// Opening and sliding in proportion, from the same independent program: fraction of the way, σ, τ [MPa], W [MPa m].
const MOSTLY_OPENING: [(f64, f64, f64, f64); 8] = [
    (0.005, 1.0, 0.2, 0.0),
    (0.01, 2.0, 0.4, 0.0),
    (0.02, 2.887782721, 0.3920627021, 3.402589641e-06),
    (0.05, 2.657789976, 0.2682714883, 2.112225208e-05),
    (0.1, 2.261678806, 0.3175666989, 4.721384089e-05),
    (0.2, 1.634328212, 0.3991391349, 8.848039721e-05),
    (0.5, 0.5882432612, 0.5355679209, 0.0001572503944),
    (1.0, 0.03577965819, 0.6077148522, 0.0001935497892),
];
const AT_45_DEGREES: [(f64, f64, f64, f64); 10] = [
    (0.005, 0.5, 0.5, 0.0),
    (0.01, 1.0, 1.0, 0.0),
    (0.02, 1.888938611, 1.897440938, 4.046056866e-07),
    (0.05, 1.701636011, 1.979765946, 1.178195842e-05),
    (0.1, 1.356334578, 2.159424383, 2.992609613e-05),
    (0.2, 0.6367454859, 2.579310358, 6.327590709e-05),
    (0.4, 0.0, 2.562452155, 0.0001218643286),
    (0.5, 0.0, 2.153330201, 0.0001464313558),
    (0.7, 0.0, 1.264514196, 0.0001822609858),
    (0.9, 0.0, 0.3182020031, 0.0001988965916),
];

#[test]
fn mixed_ways_meet_the_independent_values() {
    let law = Cracking {
        normal_stiffness: 1e6,
        tangential_stiffness: 1e6,
        tan_friction_residual: Some(0.6),
        ..EXAMPLE_2
    };
    for (opening, slip, table) in [(2e-4, 4e-5, &MOSTLY_OPENING[..]), (1e-4, 1e-4, &AT_45_DEGREES[..])] {
        let program = vec![PathSegment { n: jump(0.0, opening), t: jump(0.0, slip), points: 400 }];
        let rows = along(&law, program, Integration::Tolerance(1e-7));
        for &(fraction, sigma, tau, work) in table {
            let state = &rows[(400.0 * fraction).round() as usize].state;
            close(state.traction.x, sigma, 1e-6, "σ");
            close(state.traction.y, tau, 1e-6, "τ");
            close(state.own[WORK], work, 1e-6 * law.fracture_energy_i, "W");
        }
    }
}

/// Opening and sliding by the same amount, no dilatancy in compression: σ falls to 0 and must stay there while τ
/// softens; one-sided flow rules chatter here.
#[test]
fn at_45_degrees_sigma_falls_to_zero_and_stays() {
    let law = Cracking {
        normal_stiffness: 1e6,
        tangential_stiffness: 1e6,
        tan_friction_residual: Some(0.6),
        ..EXAMPLE_2
    };
    for integration in
        [Integration::BackwardEuler(1), Integration::BackwardEuler(7), Integration::Tolerance(1e-4)]
    {
        let program = vec![PathSegment { n: jump(0.0, 2e-4), t: jump(0.0, 2e-4), points: 400 }];
        let rows = along(&law, program, integration);
        let reached = rows.iter().position(|row| row.state.status == 3).unwrap();
        let statuses: Vec<u8> = rows[reached..].iter().map(|row| row.state.status).collect();
        assert!(statuses.is_sorted(), "the mode cycles: {statuses:?}");
        assert_eq!(*statuses.last().unwrap(), 4);
        for pair in rows[reached..].windows(2) {
            let (a, b) = (&pair[0].state, &pair[1].state);
            assert_eq!(b.traction.x, 0.0);
            assert!(b.traction.y <= a.traction.y, "τ rises");
        }
    }
}
