//! Claim: a history that goes on from a checkpoint, through bytes and with factors made anew, gives what the history that was
//! not interrupted gives, bit for bit.

use crate::common::*;
use midplane::history::{Checkpoint, Clock, Equations, History, Means, ModelState};
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;

/// The upper block goes by half, wholly, and comes again, colder.
fn stages() -> Vec<Step> {
    let cold = vec![-1e-4, -1e-4, -1e-4, 0.0];
    vec![
        step("half").increments(2).deactivate("upper", 0.5),
        step("gone").increments(2).deactivate("upper", 1),
        step("again").increments(2).activate(["upper"]),
        step("cold").increments(2).strain("upper", cold),
    ]
}

/// Water that follows the opening, and flow after it.
fn water() -> Vec<Step> {
    vec![
        step("water").increments(3).pressure("joint", "0.2 + 2*ramp(opening, 0, 1e-4)"),
        step("flow").increments(3).pressure("joint", flow(1e-5, 1).ends(1, 0)),
    ]
}

fn problem(law: &Law, control: &str, strategy: &str, fields: &str, more: &[Step]) -> Problem {
    let scene = Scene::new("strain")
        .subdomains(["lower", "upper"], "m")
        .material("m", 1e4, 0.2)
        .interface("joint", faces("lower.top", "upper.bottom").law(law.clone()))
        .solution("strategy", strategy)
        .step(step("press").fix("lower.bottom", "xy").pressure("upper.top", 2))
        .step(step("shear").increments(6).control(control).displace("upper.top", "x", 4e-4))
        .step(step("let go").increments(3).release("upper.top", "x"))
        .steps(more.to_vec())
        .with_in("output", "fields", fields)
        .probes([("x", "upper.top.displacement_x"), ("t", "joint.traction_t@0.5")]);
    scene.bind(blocks()).unwrap()
}

fn blocks() -> Vec<Mesh> {
    let block = |n: usize, y: f64| even_block([0.0, 0.4], [y, y + 0.2], [n, 2], Shape::Quadrilateral4);
    vec![block(5, -0.2), block(4, 0.0)]
}

/// Everything that an increment shows.
fn shown(problem: &Problem, state: &ModelState, iterations: usize) -> Vec<f64> {
    let energies = [state.stored, state.dissipated, state.work, state.released, state.residual];
    let mut all = [vec![iterations as f64], energies.to_vec(), state.probes(problem)].concat();
    all.extend(&state.snapshot.u);
    for stresses in &state.snapshot.stresses {
        all.extend(stresses.nodes.iter().chain(&stresses.cells).flatten());
    }
    all.extend(&state.reactions);
    all.extend(state.snapshot.tractions.iter().flatten().flatten());
    all.extend(state.snapshot.jumps.iter().flatten().flatten());
    all.extend(state.snapshot.water.pressures.iter().flatten());
    all.extend(state.snapshot.water.rates.iter().flatten());
    all.push(state.water_work);
    all
}

#[test]
fn an_interrupted_history_goes_on_as_if_it_had_not_been() {
    let springs = elastic(1e6, 1e6);
    let friction = coulomb(1e6, 1e6, 0.5);
    let rock = cracking(1e6, 1e6, [3.0, 4.0, 0.8785], [2e-4, 2e-3]);
    let (none, stages, water) = (Vec::new(), stages(), water());
    let cases = [
        (&rock, "load", "condensed", "every", &none),
        (&rock, "load", "blocks", "step", &none),
        (&rock, "auto", "condensed", "every", &none),
        (&rock, "arclength", "plain", "every", &none),
        (&friction, "load", "condensed", "step", &none),
        (&friction, "load", "plain", "last", &none),
        (&springs, "load", "auto", "every", &none),
        (&springs, "load", "condensed", "step", &none),
        (&rock, "auto", "condensed", "step", &stages),
        (&friction, "load", "plain", "every", &stages),
        (&friction, "load", "blocks", "last", &stages),
        (&springs, "load", "auto", "step", &stages),
        (&rock, "auto", "condensed", "every", &water),
        (&friction, "load", "condensed", "step", &water),
        (&springs, "load", "auto", "last", &water),
    ];
    for (law, control, strategy, fields, more) in cases {
        let what = format!("{law} {control} {strategy} {fields} {} more steps", more.len());
        let problem = problem(law, control, strategy, fields, more);
        let mut clock = Clock::new("test");
        let equations = Equations::new(&problem, Means::default(), &mut clock).unwrap();
        let mut history = History::new(&problem, &equations, clock.clone());
        let (mut rows, mut checkpoints) = (Vec::new(), Vec::new());
        while let Some(increment) = history.next().unwrap() {
            rows.push(shown(&problem, history.state(), increment.iterations));
            checkpoints.push(postcard::to_allocvec(&history.checkpoint()).unwrap());
        }
        assert!(rows.len() >= 11, "{what}: {} rows", rows.len());
        for (k, checkpoint) in checkpoints.iter().enumerate() {
            let kept: Checkpoint = postcard::from_bytes(checkpoint).unwrap();
            let equations = Equations::new(&problem, Means::default(), &mut clock).unwrap();
            let mut history = History::resume(&problem, &equations, clock.clone(), kept).unwrap();
            for (i, row) in rows.iter().enumerate().skip(k + 1) {
                let increment = history.next().unwrap().unwrap();
                let again = shown(&problem, history.state(), increment.iterations);
                assert_eq!(row.len(), again.len(), "{what}, row {i} from {k}");
                for (a, b) in row.iter().zip(&again) {
                    assert_eq!(a.to_bits(), b.to_bits(), "{what}, row {i} from {k}: {a:e} and {b:e}");
                }
            }
            assert!(history.next().unwrap().is_none(), "{what} from {k}");
        }
    }
}
