//! Claim: the scenes of the gallery whose answer is known by hand give it.

use std::path::Path;
use std::process::Command;

/// The last row of history.csv: the columns after the fixed ones.
fn history(scene: &str) -> Vec<(String, f64)> {
    history_with(scene, &[])
}

/// The same with values of the scene replaced.
fn history_with(scene: &str, set: &[&str]) -> Vec<(String, f64)> {
    let folder = tempfile::tempdir().unwrap();
    let geo = Path::new(env!("CARGO_MANIFEST_DIR")).join("geo").join(scene);
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.arg("run").arg(geo).arg("-o").arg(folder.path().join("out"));
    for pair in set {
        command.args(["--set", pair]);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let (head, row) = (text.lines().next().unwrap(), text.lines().last().unwrap());
    head.split(',')
        .zip(row.split(','))
        .skip(5)
        .map(|(name, value)| (name.into(), value.parse().unwrap()))
        .collect()
}

fn close(rows: &[(String, f64)], name: &str, exact: f64, scale: f64) {
    let value = rows.iter().find(|(column, _)| column == name).unwrap_or_else(|| panic!("no {name}")).1;
    assert!((value - exact).abs() <= 1e-10 * scale.abs(), "{name}: {value}, exact {exact}");
}

/// σ = diag(−5, −10) MPa in plane strain. Across an interface of normal n the displacement jumps by (σ_n/K_N) n + (τ/K_T) t;
/// the upper right block is beyond one interface of either kind.
#[test]
fn four_blocks_carry_a_constant_stress() {
    let (xx, yy, e, nu, kn, kt, slope) = (-5.0, -10.0, 1e4, 0.2, 1e5, 5e4, 0.2_f64);
    let interface = |n: [f64; 2]| {
        let t = [n[1], -n[0]];
        let (normal, shear) = (n[0] * n[0] * xx + n[1] * n[1] * yy, n[0] * t[0] * xx + n[1] * t[1] * yy);
        let jump = [0, 1].map(|d| normal / kn * n[d] + shear / kt * t[d]);
        (normal, shear, jump)
    };
    let r = slope.hypot(1.0);
    let (normal, shear, up) = interface([-slope / r, 1.0 / r]);
    let (.., across) = interface([1.0 / r, slope / r]);
    let strain = ((1.0 - nu * nu) * yy - nu * (1.0 + nu) * xx) / e;
    let rows = history("four_blocks");
    close(&rows, "traction_n", normal, 10.0);
    close(&rows, "traction_t", shear, 10.0);
    close(&rows, "shortening", 2.0 * strain + up[1] + across[1], 2.0 * strain);
    for constrained in ["reaction:sw.corner:x", "reaction:sw.corner:y", "reaction:sw.foot:y"] {
        close(&rows, constrained, 0.0, 20.0);
    }
}

/// 10 MPa on 1.2 m, all through the part of the bottom that is joined.
#[test]
fn the_step_block_hands_down_its_whole_load() {
    let rows = history("step_block");
    close(&rows, "resultant_n", -12.0, 12.0);
    close(&rows, "resultant_t", 0.0, 12.0);
    close(&rows, "reaction:lower.bottom:y", 12.0, 12.0);
}

/// 2 MPa on 1.2 m and then 3 MPa on 0.4 m: what the parts hand down to the support, kinks or not.
#[test]
fn the_shear_key_is_in_equilibrium() {
    let rows = history("shear_key");
    close(&rows, "reaction:lower.bottom:y", 2.4, 2.4);
    close(&rows, "reaction:lower.bottom:x", -1.2, 2.4);
}

/// Petersson's beam: until it is broken it costs G_F on the ligament, 124 N/m × 50 mm × 100 mm. At 40 mm the last half per cent is a
/// hinge.
#[test]
fn the_notched_beam_costs_its_ligament() {
    let down = ["left", "right"].map(|half| format!("/steps/0/displace/{half}.load/y=-0.04"));
    let rows = history_with("notched_beam", &down.each_ref().map(|pair| pair.as_str()));
    let value = |name: &str| rows.iter().find(|(column, _)| column == name).unwrap().1;
    let exact = 1.24e-4 * 0.05 * 0.1;
    for name in ["work", "dissipated"] {
        assert!((value(name) / exact - 1.0).abs() < 0.01, "{name}: {:e}, exact {exact:e}", value(name));
    }
    assert!(value("stored") < 0.01 * exact);
}
