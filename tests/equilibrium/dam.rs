//! Claim: a gravity dam on a joint that cracks is filled until it slides, and emptied, with uplift that follows the crack, imposed or
//! by flow, and no number set by hand: force and moment of the joint are those of statics at every row.
//!
//! ```text
//!    │╲             N = −W                    h: water level, γ: its weight
//!  γh│ ╲            T = γ h²/2                W at x_w, the water pushes at h/3
//!    │  ╲           M = W x_w + γ h³/6        about the heel, of traction and uplift
//!    ┴───┴──────    linear uplift ≤ U ≤ full uplift; water above the crest pushes on the face alone
//!      base
//! ```

use crate::common::*;
use midplane::history::ModelState;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::Value;

const BASE: f64 = 60.0;
const CREST: f64 = 5.0;
const HEIGHT: f64 = 80.0;
const WATER: f64 = 9.81e-3;
const CONCRETE: f64 = 2.4e-3 * 9.81;

/// The dam on its rock, with steps after that of its weight.
fn dam(tensile_strength: f64, steps: impl IntoIterator<Item = Step>) -> Problem {
    let joint = cracking(1e6, 1e6, [tensile_strength, 2.8, 0.577], [1e-4, 3.5e-4]);
    let scene = Scene::new("strain")
        .subdomain("dam", "concrete")
        .subdomain("rock", "rock")
        .material("concrete", 24e3, 0.15)
        .density("concrete", 2.4e-3)
        .material("rock", 41e3, 0.1)
        .interface("base", faces("rock.top", "dam.bottom").law(joint))
        .step(step("weight").fix("rock.bottom", "xy").gravity(0, -9.81))
        .steps(steps)
        .probes([
            ("N", "base.total_resultant_n"),
            ("T", "base.resultant_t"),
            ("U", "base.uplift"),
            ("work", "work.water"),
            ("heel", "base.jump_n@0"),
        ]);
    let trapezoid = |x: f64, y: f64| [x * (1.0 - (1.0 - CREST / BASE) * y / HEIGHT), y];
    let dam =
        rectangle(&even(0.0, BASE, 24), &graded(0.0, HEIGHT, 12, 3.0), Shape::Quadrilateral4, trapezoid);
    let rock =
        rectangle(&even(0.0, BASE, 17), &graded(-40.0, 0.0, 8, 0.3), Shape::Quadrilateral4, |x, y| [x, y]);
    scene.bind(vec![dam, rock]).unwrap()
}

/// A step in which the level follows a formula of the load factor, with the pressure in the joint.
fn water(name: &str, increments: usize, level: &str, joint: Value) -> Step {
    let face = format!("{WATER}*max(0, {level} - y)");
    step(name).increments(increments).pressure("dam.left", face).pressure("base", joint)
}

/// Uplift that is full where the joint is open by more than 1 to 2 µm and falls linearly to the toe elsewhere.
fn follows_the_crack(level: &str) -> Value {
    format!("{WATER}*{level}*(1 - x/{BASE}*(1 - ramp(opening, 1e-6, 2e-6)))").into()
}

fn flows(level: &str) -> Value {
    flow(2e-5, 1e-9).ends(format!("{WATER}*{level}"), 0).into()
}

/// Normal force, shear force and moment about the heel of what the joint carries, water included.
fn carried(problem: &Problem, state: &ModelState) -> [f64; 3] {
    let points = &problem.model.interfaces[0].coupling.points;
    let none = Vec::new();
    let water = state.snapshot.water.pressures.first().unwrap_or(&none);
    let mut sums = [0.0; 3];
    for (p, (point, t)) in points.iter().zip(&state.snapshot.tractions[0]).enumerate() {
        let normal = t[0] - water.get(p).copied().unwrap_or(0.0);
        sums[0] += point.weight * normal;
        sums[1] += point.weight * t[1];
        sums[2] += point.weight * normal * point.position[0];
    }
    sums
}

/// Goes through the steps and compares every row with statics for its level; the levels and states of the rows.
fn check(problem: &Problem, level: impl Fn(usize, f64) -> f64) -> (Vec<(f64, ModelState)>, bool) {
    let area = 0.5 * (BASE + CREST) * HEIGHT;
    // a rectangle of the crest's width and a triangle beside it
    let (strip, rest) = (CREST * HEIGHT, 0.5 * (BASE - CREST) * HEIGHT);
    let middle = (strip * 0.5 * CREST + rest * (CREST + (BASE - CREST) / 3.0)) / area;
    let weight = CONCRETE * area;
    let mut rows = Vec::new();
    let end = each_increment(problem, |increment, history| {
        if increment.number == 0 || increment.ended {
            return;
        }
        let state = history.state();
        let h = level(increment.step_number, increment.load_factor);
        let [n, t, m] = carried(problem, state);
        close(n, -weight, 1e-8, weight, &format!("N at {h} m"));
        // ∫ γ (h − y) dy and ∫ γ (h − y) y dy on the face, above the crest too
        let top = h.min(HEIGHT);
        close(-t, -WATER * top * (h - 0.5 * top), 1e-8, weight, &format!("T at {h} m"));
        let turned = weight * middle + WATER * top * top * (0.5 * h - top / 3.0);
        close(-m, turned, 1e-8, weight * middle, &format!("M at {h} m"));
        let probes = state.probes(problem);
        close(probes[0], n, 1e-12, weight, "probe N");
        close(probes[1], t, 1e-12, weight, "probe T");
        let full = WATER * h * BASE;
        assert!(
            (0.5 * full * (1.0 - 1e-3)..=full * (1.0 + 1e-9)).contains(&probes[2]),
            "U {} of {full} at {h} m",
            probes[2]
        );
        rows.push((h, state.clone()));
    });
    (rows, end.is_ok())
}

/// Claim: where friction alone holds and the whole joint is open to water it slides at h with ½ γ h² = tanφ (W − γ h B); an intact joint
/// stands longer.
#[test]
fn a_dam_is_filled_until_it_slides_and_statics_hold_at_every_row() {
    let mut failed = Vec::new();
    for joint in [follows_the_crack, flows] {
        let steps = [water("filling", 30, "100*load_factor", joint("100*load_factor"))];
        let problem = dam(0.3, steps);
        let (rows, done) =
            check(&problem, |step, load_factor| if step == 0 { 0.0 } else { 100.0 * load_factor });
        assert!(!done, "the dam stands at 100 m");
        let (level, last) = rows.last().unwrap();
        let [uplift, heel] = [2, 4].map(|k| last.probes(&problem)[k]);
        // the crack has taken water in
        assert!(heel > 1e-5 && uplift > 0.505 * WATER * level * BASE, "{level}: {heel} {uplift}");
        failed.push(*level);
    }
    let weight = CONCRETE * 0.5 * (BASE + CREST) * HEIGHT;
    let slides = |h: f64| 0.5 * WATER * h * h - 0.577 * (weight - WATER * h * BASE) > 0.0;
    for level in &failed {
        assert!(slides(*level) && *level < 90.0, "{failed:?}");
    }
    assert!((failed[0] / failed[1] - 1.0).abs() < 0.02, "{failed:?}");
}

/// Claim: emptied again the crack closes on its faces, and the joint carries what it carried before but for friction.
#[test]
fn a_dam_that_is_emptied_closes_its_crack() {
    for joint in [follows_the_crack, flows] {
        let steps = [
            water("filling", 12, "76*load_factor", joint("76*load_factor")),
            water("emptying", 8, "76*(1 - load_factor)", joint("76*(1 - load_factor)")),
        ];
        let problem = dam(0.3, steps);
        let level =
            |step: usize, load_factor: f64| [0.0, 76.0 * load_factor, 76.0 * (1.0 - load_factor)][step];
        let (rows, done) = check(&problem, level);
        assert!(done);
        let heel = |k: usize| rows[k].1.snapshot.jumps[0][0][0];
        let traction = |k: usize| rows[k].1.snapshot.tractions[0][0][0];
        assert!(heel(12) > 1e-5 && heel(20) < 0.0, "{} {}", heel(12), heel(20));
        close(traction(20), traction(0), 1e-2, traction(0), "traction at the heel");
        let probes = rows[20].1.probes(&problem);
        close(probes[2], 0.0, 1e-12, 1.0, "uplift");
        // water has done work on the opening crack
        assert!(rows[12].1.water_work > 0.0);
        assert!(rows[20].1.energy_balance().abs() < 1e-3);
    }
}
