//! Claim: a history that goes on from a checkpoint, through bytes and with factors made anew, gives what the history that was
//! not interrupted gives, bit for bit.

use crate::common::*;
use midplane::history::{Checkpoint, Clock, Equations, History, Means, ModelState};
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;

const CRACKING: &str = r#""type": "cracking", "tensile_strength": 3, "cohesion": 4, "tan_friction": 0.8785,
    "fracture_energy_i": 2e-4, "fracture_energy_iia": 2e-3, "dilatancy_stress": 0"#;

/// The upper block goes by half, wholly, and comes again, colder.
const STAGES: &str = r#",
            {"name": "half", "increments": 2, "deactivate": {"upper": 0.5}},
            {"name": "gone", "increments": 2, "deactivate": {"upper": 1}},
            {"name": "again", "increments": 2, "activate": ["upper"]},
            {"name": "cold", "increments": 2, "strain": {"upper": [-1e-4, -1e-4, -1e-4, 0]}}"#;

/// Water that follows the opening, and flow after it.
const WATER: &str = r#",
            {"name": "water", "increments": 3, "load": {"joint": {"pressure": "0.2 + 2*ramp(opening, 0, 1e-4)"}}},
            {"name": "flow", "increments": 3, "load": {
                "joint": {"pressure": {"flow": {"aperture": 1e-5, "viscosity": 1, "ends": [1, 0]}}}}}"#;

fn problem(law: &str, control: &str, strategy: &str, fields: &str, more: &str) -> Problem {
    let text = format!(
        r#"{{"plane": "strain",
        "subdomains": {{"lower": {{"msh": "a", "material": "m"}}, "upper": {{"msh": "b", "material": "m"}}}},
        "materials": {{"m": {{"young": 1e4, "poisson": 0.2}}}},
        "interfaces": {{"joint": {{"side_a": "lower.top", "side_b": "upper.bottom",
            "law": {{"normal_stiffness": 1e6, "tangential_stiffness": 1e6, {law}}}}}}},
        "solution": {{"strategy": "{strategy}"}},
        "steps": [
            {{"name": "press", "fix": {{"lower.bottom": ["x", "y"]}}, "load": {{"upper.top": {{"pressure": 2}}}}}},
            {{"name": "shear", "increments": 6, "control": "{control}", "displace": {{"upper.top": {{"x": 4e-4}}}}}},
            {{"name": "let go", "increments": 3, "release": {{"upper.top": ["x"]}}}}{more}],
        "output": {{"fields": "{fields}", "history": {{"x": "upper.top.displacement_x", "t": "joint.traction_t@0.5"}}}}}}"#
    );
    bind(&text, blocks()).unwrap()
}

fn blocks() -> Vec<Mesh> {
    let block = |n: usize, y: f64| {
        rectangle(&even(0.0, 0.4, n), &even(y, y + 0.2, 2), Shape::Quadrilateral4, |x, y| [x, y])
    };
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
    let elastic = r#""type": "elastic""#;
    let coulomb = r#""type": "coulomb", "friction_coefficient": 0.5"#;
    let cases = [
        (CRACKING, "load", "condensed", "every", ""),
        (CRACKING, "load", "blocks", "step", ""),
        (CRACKING, "auto", "condensed", "every", ""),
        (CRACKING, "arclength", "plain", "every", ""),
        (coulomb, "load", "condensed", "step", ""),
        (coulomb, "load", "plain", "last", ""),
        (elastic, "load", "auto", "every", ""),
        (elastic, "load", "condensed", "step", ""),
        (CRACKING, "auto", "condensed", "step", STAGES),
        (coulomb, "load", "plain", "every", STAGES),
        (coulomb, "load", "blocks", "last", STAGES),
        (elastic, "load", "auto", "step", STAGES),
        (CRACKING, "auto", "condensed", "every", WATER),
        (coulomb, "load", "condensed", "step", WATER),
        (elastic, "load", "auto", "last", WATER),
    ];
    for (law, control, strategy, fields, more) in cases {
        let what = format!("{law} {control} {strategy} {fields}{more}");
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
