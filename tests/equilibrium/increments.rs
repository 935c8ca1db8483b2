//! Claim: the answer does not depend on the increments. In a chain of blocks only the weakest interface cracks, whatever the
//! increments, the control, the form of the equations and the meshes.
//!
//! ```text
//! ├──┤ab├──┤bc├──┤cd├──┤ → u       C = Σ L/E + Σ 1/K_N         u(σ) = σ C + (G_I/χ) ln(χ/σ),  χ the least strength
//! ```

use crate::common::*;
use midplane::problem::Problem;
use midplane::shape::Shape;

const E: f64 = 1e4;
const KN: f64 = 1e6;
const GI: f64 = 2e-4;
const LENGTH: f64 = 0.02;

/// A chain with interfaces of these strengths; 0 is an elastic one.
/// A chain with interfaces of these strengths; 0 is an elastic one.
fn chain(strengths: &[f64], edges: &[usize], pull: Step, end: f64, strategy: &str) -> Problem {
    let names = ["a", "b", "c", "d", "e", "f"];
    let n = strengths.len() + 1;
    let mut scene = Scene::new("stress")
        .subdomains(names[..n].iter().copied(), "m")
        .material("m", E, 0.0)
        .solution("strategy", strategy);
    for (pair, chi) in names.windows(2).zip(strengths) {
        let law = match *chi {
            0.0 => elastic(KN, KN),
            chi => cracking(KN, KN, [chi, 4.0, 0.8785], [GI, 2e-3]),
        };
        let faces = faces(format!("{}.top", pair[0]), format!("{}.bottom", pair[1]));
        scene = scene.interface(&pair.concat(), faces.law(law).with("law_tolerance", 1e-6));
    }
    let pull = names[..n].iter().fold(pull.fix("a.bottom", "y"), |pull, name| pull.fix(name, "x"));
    let pull = pull.displace(&format!("{}.top", names[n - 1]), "y", end);
    let block = |i: usize| {
        let y = LENGTH * i as f64;
        let xs = even(0.0, 0.05, edges[i % edges.len()]);
        rectangle(&xs, &even(y, y + LENGTH, 2), Shape::Quadrilateral4, |x, y| [x, y])
    };
    scene.step(pull).bind((0..n).map(block).collect()).unwrap()
}

/// Stress on the softening branch at u.
fn stress(u: f64, compliance: f64, chi: f64) -> f64 {
    if u <= compliance * chi {
        return u / compliance;
    }
    let (mut low, mut high) = (0.0, chi);
    while high - low > 1e-14 * chi {
        let s = 0.5 * (low + high);
        *(if s * compliance + GI / chi * (chi / s).ln() > u { &mut low } else { &mut high }) = s;
    }
    low
}

#[test]
fn only_the_weakest_interface_of_a_chain_cracks() {
    let chains: [(&str, &[f64]); 6] = [
        ("3.0 : 2.0", &[3.0, 2.0]),
        ("3.0 : 2.9", &[3.0, 2.9]),
        ("3.0 : 2.7 : 3.0", &[3.0, 2.7, 3.0]),
        ("2.9 : 3.1 : 3.0 : 2.8", &[2.9, 3.1, 3.0, 2.8]),
        ("elastic : 2.9 : 3.0", &[0.0, 2.9, 3.0]),
        ("2.9 : elastic : 3.1 : 3.0 : 2.8", &[2.9, 0.0, 3.1, 3.0, 2.8]),
    ];
    let mut worst = 0.0_f64;
    for (name, strengths) in chains {
        let chi = strengths.iter().copied().filter(|chi| *chi > 0.0).fold(f64::INFINITY, f64::min);
        let weakest = strengths.iter().position(|s| *s == chi).unwrap();
        let blocks = strengths.len() as f64 + 1.0;
        let compliance = blocks * LENGTH / E + strengths.len() as f64 / KN;
        assert!(compliance * chi * chi / GI < 0.9, "snaps back");
        let end = 4.0 * GI / chi;
        for (edges, strategy) in
            [(&[2][..], "condensed"), (&[2, 3], "condensed"), (&[3, 2], "plain"), (&[2, 3], "blocks")]
        {
            for control in ["load", "auto"] {
                for increments in [1, 2, 3, 5, 10, 20, 50, 200] {
                    if std::env::var("ONLY").is_ok_and(|only| {
                        !format!("{name} {edges:?} {strategy} {control} {increments} ").contains(&only)
                    }) {
                        continue;
                    }
                    if increments > 20 && strategy != "condensed" {
                        continue;
                    }
                    let what = format!("{name}, {edges:?}, {strategy}, {control}, {increments} increments");
                    let pull = step("pull").increments(increments).control(control);
                    let problem = chain(strengths, edges, pull, end, strategy);
                    let march = try_solve(&problem);
                    let totals = march.end.unwrap_or_else(|error| panic!("{what}: {error}"));
                    let mut most = 0.0_f64;
                    for (state, load_factor) in march.states.iter().zip(&march.load_factors) {
                        let u = load_factor * end;
                        let s = stress(u, compliance, chi);
                        for (k, tractions) in state.snapshot.tractions.iter().enumerate() {
                            for traction in tractions.iter().map(|v| &v[0]) {
                                most = most.max((traction - s).abs() / chi);
                            }
                            for opening in state.snapshot.jumps[k].iter().map(|v| &v[0]) {
                                if k != weakest {
                                    most = most.max((opening - s / KN).abs() / (GI / chi));
                                }
                            }
                        }
                    }
                    println!(
                        "{what}: {most:.1e}, {} iterations, {} parts, snaps {}, balance {:.1e}",
                        totals.iterations,
                        totals.parts,
                        totals.snaps.len(),
                        totals.energy_balance
                    );
                    worst = worst.max(most);
                }
            }
        }
    }
    println!("worst {worst:e}");
    assert!(worst <= 2e-3);
}
