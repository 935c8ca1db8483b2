//! Claim: faces with an initial gap carry nothing until they meet, then the pressure of springs in series; what they
//! slid while apart is no slip of the interface.
//!
//! ```text
//!     ┌───────┐ ↓ d, → 1e-4      t_n = 0                               d ≤ g
//!     │   b   │                  t_n = −(d − g) / (1/K_N + H/E)        d > g,  H = 1 the height of both blocks
//!     └───────┘  g = 1e-3        t_t = 0
//!     ┌───────┐
//!     └───a───┘
//! ```

use crate::common::*;
use midplane::shape::Shape;
use serde_json::Value;

const E: f64 = 1e4;
const KN: f64 = 1e6;
const G: f64 = 1e-3;

/// Lower block below y = 0, upper one from `y` on.
fn check(gap: impl Into<Value>, y: f64) {
    let to = |step: Step, y: f64| step.increments(4).displace("b.top", "x", 1e-4).displace("b.top", "y", y);
    let scene = Scene::new("strain")
        .subdomains(["a", "b"], "rock")
        .material("rock", E, 0.0)
        .interface("joint", faces("a.top", "b.bottom").with("initial_gap", gap).law(coulomb(KN, KN, 0.5)))
        .step(to(step("near").fix("a.bottom", "xy"), -8e-4))
        .step(to(step("close"), -2e-3));
    let block = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 0.5], [n, 3], Shape::Quadrilateral4);
    let problem = scene.bind(vec![block(4, -0.5), block(6, y)]).unwrap();
    let (states, _) = solve(&problem);
    assert_eq!(states.len(), 8);
    let mut closed = 0;
    for (i, state) in states.iter().enumerate() {
        let d = if i < 4 { 8e-4 * (i + 1) as f64 / 4.0 } else { 8e-4 + 1.2e-3 * (i - 3) as f64 / 4.0 };
        let exact = -(d - G).max(0.0) / (1.0 / KN + 1.0 / E);
        closed += usize::from(exact < 0.0);
        for t in &state.snapshot.tractions[0] {
            close(t[0], exact, 1e-9, 10.0, &format!("t_n at d = {d}"));
            close(t[1], 0.0, 1e-9, 10.0, &format!("t_t at d = {d}"));
        }
    }
    assert_eq!(closed, 4);
}

#[test]
fn a_gap_that_the_scene_gives() {
    check(1e-3, 0.0);
}

#[test]
fn a_gap_that_is_drawn() {
    check("geometry", G);
}
