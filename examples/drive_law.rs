//! Drive one point of a law and measure the area under its curve: in pure tension it is the fracture energy.
//!
//! `cargo run --release --example drive_law`

use midplane::law::{Integration, Law, Local, State};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let law: Law = serde_json::from_str(
        r#"{ "type": "cracking", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 3.0,
             "cohesion": 4.0, "tan_friction": 0.8, "fracture_energy_i": 1e-4, "fracture_energy_iia": 1e-3, "dilatancy_stress": 0.0 }"#,
    )?;
    let (mut state, mut work) = (State::default(), 0.0);
    for k in 1..=2000 {
        let jump = Local::new(5e-4 * f64::from(k) / 2000.0, 0.0, 0.0);
        let now = law.respond(jump, &state, Integration::Tolerance(1e-6))?;
        work += 0.5 * (state.traction.x + now.traction.x) * (jump.x - state.jump.x);
        state = now.state;
    }
    println!(
        "{:.4} of G_I after an opening of {} m, {:.1e} MPa left",
        work / 1e-4,
        state.jump.x,
        state.traction.x
    );
    assert!((work / 1e-4 - 1.0).abs() < 1e-3);
    Ok(())
}
