//! Claim: what opens and closes again carries its load through faces that touch, and only through those.
//!
//! ```text
//!   ┌┐                      dam on rock: filled to 64 m, 4 m above its crest, and emptied. At the ends of the steps
//!   │ \        water        T = γ (60 h − 1800),  N = −(weight − ½ γ h 45)    h = 64, then 0
//!   │   \
//! ──┴─────┴──               a panel of 3 × 3 bricks under pressure: pushed there and back three times
//! ```

use std::path::Path;
use std::time::Duration;

use midplane::history::{Clock, Equations, History, Means, ModelState};
use midplane::law::Law;
use midplane::problem::Problem;
use midplane::run::{Options, prepare};

/// Weight of a volume of water [MN/m³] and of the dam [MN/m].
const WATER: f64 = 9.81e-3;
const WEIGHT: f64 = 0.0024 * 9.81 * (0.5 * (45.0 + 5.0) * 160.0 / 3.0 + 5.0 * 20.0 / 3.0);
/// A gap below this is rounding [m].
const GAP: f64 = 1e-12;

/// Rows of a scene, and the last energy balance.
fn run(name: &str) -> (Problem, Vec<ModelState>, f64) {
    let folder = tempfile::tempdir().unwrap();
    let options = Options {
        out: Some(folder.path().join("out")),
        settings: vec!["output.fields=every".into()],
        gmsh_limit: Duration::from_secs(60),
        ..Options::of(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cycles").join(name))
    };
    let problem = prepare(&options, &mut |_| ()).unwrap().problem;
    let mut states = Vec::new();
    let balance = {
        let mut clock = Clock::new("test");
        let equations = Equations::new(&problem, Means::default(), &mut clock).unwrap();
        let mut history = History::new(&problem, &equations, clock);
        while history.next().unwrap().is_some() {
            states.push(history.state().clone());
        }
        history.totals().energy_balance
    };
    (problem, states, balance)
}

/// Law points that are apart, of all that have a gap to close; none of them is pressed.
fn apart(problem: &Problem, state: &ModelState) -> usize {
    let mut apart = 0;
    for (interface, states) in problem.interfaces.iter().zip(&state.snapshot.states) {
        assert!(matches!(interface.laws.kind(), Law::Cracking(_)));
        for point in states {
            if point.jump.x - point.jump_plastic.x > GAP {
                assert!(point.traction.x >= 0.0, "pressed across a gap: {point:?}");
                apart += usize::from(point.traction.x == 0.0);
            }
        }
    }
    apart
}

fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((value - expected).abs() <= tolerance, "{what}: {value}, expected {expected}");
}

#[test]
fn an_emptied_dam_stands_on_its_whole_base() {
    let (problem, states, balance) = run("dam.json");
    assert!(balance < 5e-3, "energies are out of balance by {balance}");
    let open: Vec<usize> = states.iter().map(|state| apart(&problem, state)).collect();
    // rows: unloaded, weight 2, filling 30, overtopping 8, emptying 16
    for (row, depth) in [(40, 64.0), (56, 0.0_f64)] {
        let probes = states[row].probes(&problem);
        let [heel, n, t] = [probes[5], probes[6], probes[7]]; // in the order of the scene
        let shear = WATER * (60.0 * depth - 1800.0).max(0.0);
        close(n, 0.5 * WATER * depth * 45.0 - WEIGHT, 1e-9 * WEIGHT, "N");
        close(t, shear, 1e-9 * WEIGHT, "T");
        println!("{depth} m: heel {heel:e} m, {} of the points apart", open[row]);
        match depth > 0.0 {
            true => assert!(heel > 1e-3 && open[row] > 0, "the heel is closed: {heel:e}"),
            false => assert!(heel < 0.0 && open[row] == 0, "the heel is open: {heel:e}, {}", open[row]),
        }
    }
}

#[test]
fn a_panel_pushed_there_and_back_three_times_is_pressed_through_no_gap() {
    let (problem, states, balance) = run("panel.json");
    println!("energies balance to {balance:.1e}");
    assert!(balance < 5e-3, "energies are out of balance by {balance}");
    let open: Vec<usize> = states.iter().map(|state| apart(&problem, state)).collect();
    println!("points apart {open:?}");
    assert!(open.iter().any(|&count| count > 0), "nothing opens");
}
