//! Claim: a point can be driven by jump or by traction in either component, and says so when it cannot.

use crate::common::laws::{EXAMPLE_2, Reference, close};
use midplane::law::path::{LawPath, PathError, PathRow, columns, drive, write_csv};
use midplane::law::{Coulomb, Cracking, Elastic, Integration, Law, Local, LossOfCohesion, State, Unloading};

const STEPPING: Integration = Integration::Tolerance(1e-6);

const BLOCK: Law = Law::Coulomb(Coulomb {
    normal_stiffness: Some(1e4),
    closure: None,
    tangential_stiffness: 1e4,
    friction_coefficient: 0.6,
    cohesion: 0.0,
    dilatancy: 0.0,
    dilatancy_end: None,
    cohesion_lost: LossOfCohesion::Never,
});

/// Segments as (control, start, end) of n, the same of t, and points; control "d" or "s".
fn path(segments: &[(&str, f64, f64, &str, f64, f64, usize)]) -> LawPath {
    let word = |control: &str| if control == "d" { "displacement" } else { "stress" };
    let program: Vec<serde_json::Value> = segments
        .iter()
        .map(|(n, n0, n1, t, t0, t1, points)| {
            serde_json::json!({
                "n": { "control": word(n), "start": n0, "end": n1 },
                "t": { "control": word(t), "start": t0, "end": t1 },
                "points": points,
            })
        })
        .collect();
    serde_json::from_value(serde_json::json!({ "program": program })).unwrap()
}

fn end(rows: &[PathRow]) -> State {
    rows.last().unwrap().state
}

#[test]
fn a_row_is_stored_at_the_start_and_at_every_point() {
    let path = path(&[("d", 0.0, -1e-6, "d", 0.0, 0.0, 2), ("d", -1e-6, -1e-6, "d", 0.0, 1e-4, 4)]);
    let rows = drive(&Law::Cracking(EXAMPLE_2), &path, &State::default(), STEPPING).unwrap();
    let s: Vec<f64> = rows.iter().map(|row| row.s).collect();
    assert_eq!(s, [0.0, 0.5, 1.0, 1.25, 1.5, 1.75, 2.0]);
}

#[test]
fn the_csv_has_its_columns_and_the_elastic_law_leaves_the_strength_empty() {
    let springs = Law::Elastic(Elastic::springs(1e3, 2e3));
    let straight = path(&[("d", 0.0, 1.0, "s", 0.0, 4.0, 1)]);
    let csv = |law: &Law, path: &LawPath| {
        let mut out = Vec::new();
        write_csv(law, &drive(law, path, &State::default(), STEPPING).unwrap(), &mut out).unwrap();
        String::from_utf8(out).unwrap()
    };
    let text = csv(&springs, &straight);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "s,jump_n,jump_t,traction_n,traction_t,\
         jump_n_plastic,jump_t_plastic,tensile_strength,cohesion,tan_friction,status,condition"
    );
    assert_eq!(lines[2], "1,1e0,2e-3,1e3,4e0,0e0,0e0,,,,0,0");
    let closing = Cracking { unloading: Unloading::Closing, ..EXAMPLE_2 };
    for (law, own) in
        [(EXAMPLE_2, "fracture_work,"), (closing, "fracture_work,opening,bridge_stiffness,slip_open,")]
    {
        assert!(columns(&Law::Cracking(law)).contains(&format!(",traction_t,{own}jump_n_plastic,")));
    }
    let text = csv(&BLOCK, &path(&[("s", 0.0, -2.0, "d", 0.0, 3e-4, 1)]));
    let last: Vec<&str> = text.lines().last().unwrap().split(',').collect();
    assert_eq!(last.len(), columns(&BLOCK).split(',').count());
    assert_eq!(&last[7..], ["0e0", "0e0", "6e-1", "2", "1"]);
}

#[test]
fn both_tractions_may_be_prescribed_as_long_as_the_interface_can_carry_them() {
    let target = Local::new(-5.0, 8.0, 0.0); // the peak is 8.28
    let rows = drive(
        &Law::Cracking(EXAMPLE_2),
        &path(&[("s", 0.0, -5.0, "s", 0.0, 8.0, 5)]),
        &State::default(),
        STEPPING,
    )
    .unwrap();
    close((end(&rows).traction - target).amax(), 0.0, 1e-11, "t");
    close(end(&rows).jump.y, 8e-7, 1e-15, "elastic below the peak");
}

/// A block pushed by H < μN stays; H = 1.001 μN has no equilibrium and must not come back as a far slide.
#[test]
fn a_push_beyond_friction_has_no_equilibrium() {
    let pushed = |tau: f64| {
        let path = path(&[("s", 0.0, -2.0, "d", 0.0, 0.0, 1), ("s", -2.0, -2.0, "s", 0.0, tau, 10)]);
        drive(&BLOCK, &path, &State::default(), STEPPING)
    };
    close(end(&pushed(1.2 * 0.999).unwrap()).traction.y, 1.1988, 1e-11, "τ");
    match pushed(1.2 * 1.001) {
        Err(PathError::NoEquilibrium { s, rows, .. }) => {
            assert!(s > 1.9 && rows.len() == 11, "s = {s}, {} rows kept", rows.len());
        }
        other => panic!("{other:?}"),
    }
    // one component, beyond the tensile strength
    let torn = drive(
        &Law::Cracking(EXAMPLE_2),
        &path(&[("s", 0.0, 4.0, "d", 0.0, 0.0, 4)]),
        &State::default(),
        STEPPING,
    );
    let message = torn.unwrap_err().to_string();
    assert!(message.contains("traction_n"), "{message}");
}

#[test]
fn a_program_that_does_not_begin_where_the_point_is_is_refused() {
    let gap = path(&[("d", 0.0, 1e-6, "d", 0.0, 0.0, 1), ("d", 2e-6, 3e-6, "d", 0.0, 0.0, 1)]);
    let refused =
        drive(&Law::Cracking(EXAMPLE_2), &gap, &State::default(), STEPPING).unwrap_err().to_string();
    assert!(refused.contains("program[1].n.start") && refused.contains("2e-6"), "{refused}");
    let none = path(&[("d", 0.0, 1e-6, "d", 0.0, 0.0, 0)]);
    let refused =
        drive(&Law::Cracking(EXAMPLE_2), &none, &State::default(), STEPPING).unwrap_err().to_string();
    assert!(refused.contains("program[0].points"), "{refused}");
}

/// Cut o10 in two at s = 2: the second half, begun from the stored state, ends where the whole ends.
#[test]
fn a_program_may_begin_at_a_given_state() {
    let reference = Reference::read("o10_tension_close_shear");
    let point = &reference.file["points"][16];
    let value = |key: &str| point[key].as_f64().unwrap();
    assert_eq!(value("s"), 2.0);
    let initial = serde_json::json!({
        "u_n": value("u_n"), "u_t": value("u_t"), "up_n": value("up_n"), "up_t": value("up_t"), "W": value("W"),
    });
    let second = serde_json::json!({ "initial": initial, "program": [reference.file["program"][2]] });
    let path: LawPath = serde_json::from_value(second).unwrap();
    let rows = drive(&reference.law, &path, &State::default(), STEPPING).unwrap();
    let last = reference.file["points"].as_array().unwrap().last().unwrap();
    close(end(&rows).traction.y, last["tau"].as_f64().unwrap(), 1e-5, "τ");

    let outside = serde_json::json!({ "initial": { "u_n": 1.0 }, "program": [reference.file["program"][2]] });
    let path: LawPath = serde_json::from_value(outside).unwrap();
    let refused = drive(&reference.law, &path, &State::default(), STEPPING).unwrap_err().to_string();
    assert!(refused.starts_with("initial: "), "{refused}");
}

#[test]
fn a_law_is_read_from_the_keys_of_a_scene_and_unknown_keys_are_refused() {
    let text = r#"{ "type": "cracking", "normal_stiffness": 1.0e7, "tangential_stiffness": 1.0e7,
        "tensile_strength": 3.0, "cohesion": 4.0, "tan_friction": 0.8785,
        "fracture_energy_i": 2.0e-4, "fracture_energy_iia": 2.0e-3, "dilatancy_stress": 0.0, "unloading": "plastic" }"#;
    assert_eq!(serde_json::from_str::<Law>(text).unwrap(), Law::Cracking(EXAMPLE_2));
    let again = serde_json::to_string(&Law::Cracking(EXAMPLE_2)).unwrap();
    assert_eq!(serde_json::from_str::<Law>(&again).unwrap(), Law::Cracking(EXAMPLE_2));
    let misspelt = text.replace("\"cohesion\"", "\"cohesoin\"");
    assert!(serde_json::from_str::<Law>(&misspelt).unwrap_err().to_string().contains("cohesoin"));
    let contact = r#"{ "type": "coulomb", "normal_stiffness": 1e4, "tangential_stiffness": 1e4,
        "friction_coefficient": 0.6 }"#;
    assert_eq!(serde_json::from_str::<Law>(contact).unwrap(), BLOCK);
}
