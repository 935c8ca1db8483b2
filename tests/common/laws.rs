//! Reference curves, parameter sets and a fixed stream of random numbers for tests of laws.

use midplane::law::path::{Controlled, LawPath, PathRow, drive};
use midplane::law::{Cracking, Integration, Law, Local, PointLaw, State, Unloading, WORK};
use serde_json::Value;

/// Parameters of the paper's example 2 (§4.2) with the energies read as N/mm, in MPa and m.
pub const EXAMPLE_2: Cracking = Cracking {
    normal_stiffness: 1e7,
    tangential_stiffness: 1e7,
    tensile_strength: 3.0,
    cohesion: 4.0,
    tan_friction: 0.8785,
    tan_friction_residual: None,
    fracture_energy_i: 2e-4,
    fracture_energy_iia: 2e-3,
    dilatancy_stress: 0.0,
    unloading: Unloading::Plastic,
    alpha_tensile_strength: 0.0,
    alpha_cohesion: 0.0,
    alpha_tan_friction: 0.0,
    alpha_dilatancy_stress: 0.0,
    alpha_dilatancy_cohesion: 0.0,
};

/// Asserts |value − expected| ≤ tolerance.
#[track_caller]
pub fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (value - expected).abs();
    assert!(
        error <= tolerance,
        "{what}: {value:e}, expected {expected:e}, off by {error:.2e} > {tolerance:.0e}"
    );
}

/// An independent implementation's curve, kept beside the tests.
pub struct Reference {
    pub law: Law,
    pub path: LawPath,
    pub file: Value,
}

pub const CURVES: [&str; 10] = [
    "o01_tension_linear",
    "o02_tension_alpha",
    "o03_shear_sig-5_dil0",
    "o04_shear_sig-20_friction_loss",
    "o05_shear_sig-3_dilatant",
    "o06_shear_blocked_dilatant",
    "o07_mixed_prop_dil0",
    "o08_mixed_prop_dilatant",
    "o09_shear_unload_reload",
    "o10_tension_close_shear",
];

/// Curves of cracks that close.
pub const CLOSING: [&str; 6] = [
    "c01_tension_close_reopen",
    "c02_open_close_shear",
    "c03_dilate_then_open",
    "c04_cyclic_shear_const_sigma",
    "c05_mixed_partial",
    "c06_filled_emptied",
];

/// Curves of closing.py.
pub const INTEGRATED: [&str; 2] = ["c07_open_press_shear", "c08_same_with_exponents"];

impl Reference {
    pub fn read(name: &str) -> Reference {
        let file = format!("{}/tests/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(file).unwrap();
        let file: Value = serde_json::from_str(&text).unwrap();
        let given = |key: &str| file["parameters"][key].as_f64().unwrap();
        let law = Law::Cracking(Cracking {
            normal_stiffness: given("kn"),
            tangential_stiffness: given("kt"),
            tensile_strength: given("chi0"),
            cohesion: given("c0"),
            tan_friction: given("tanphi0"),
            tan_friction_residual: Some(given("tanphi_res")),
            fracture_energy_i: given("gf1"),
            fracture_energy_iia: given("gf2a"),
            dilatancy_stress: given("sigma_dil"),
            unloading: match file["unloading"].as_str() {
                Some("closing") => Unloading::Closing,
                _ => Unloading::Plastic,
            },
            alpha_tensile_strength: given("alpha_chi"),
            alpha_cohesion: given("alpha_c"),
            alpha_tan_friction: given("alpha_phi"),
            alpha_dilatancy_stress: given("alpha_sdil"),
            alpha_dilatancy_cohesion: given("alpha_cdil"),
        });
        law.check().unwrap();
        Reference { law, path: serde_json::from_str(&text).unwrap(), file }
    }

    pub fn drive(&self, integration: Integration) -> Vec<PathRow> {
        let mut rows: Vec<PathRow> = Vec::new();
        let mut initial = self.path.initial.clone();
        for (k, segment) in self.path.program.iter().enumerate() {
            let mut segment = *segment;
            let start = rows.last().map_or(State::default(), |row| row.state);
            if k > 0 && segment.n.control == Controlled::Displacement {
                segment.n.start = start.jump.x; // after a stress it is ours, near the one in the file
            }
            let path = LawPath { program: vec![segment], initial: initial.take() };
            let own = drive(&self.law, &path, &start, integration).unwrap();
            let shifted = |row: PathRow| PathRow { s: row.s + k as f64, ..row };
            rows.extend(own.into_iter().skip(usize::from(k > 0)).map(shifted));
        }
        rows
    }

    /// ∫ dissipation along a program of jumps.
    pub fn dissipated(&self, integration: Integration) -> f64 {
        let mut state = State::default();
        let mut spent = 0.0;
        for segment in &self.path.program {
            let response =
                self.law.respond(Local::new(segment.n.end, segment.t.end, 0.0), &state, integration);
            let response = response.unwrap();
            spent += response.dissipation;
            state = response.state;
        }
        spent
    }

    /// Largest errors of σ [MPa], τ [MPa] and W/G_I over the stored points.
    pub fn errors(&self, rows: &[PathRow]) -> [f64; 3] {
        let points = self.file["points"].as_array().unwrap();
        assert_eq!(rows.len(), points.len());
        let energy = self.file["parameters"]["gf1"].as_f64().unwrap();
        let mut errors = [0.0_f64; 3];
        for (row, point) in rows.iter().zip(points) {
            let stored = |key: &str| point[key].as_f64().unwrap();
            close(row.s, stored("s"), 1e-12, "s");
            let off = [
                row.state.traction.x - stored("sigma"),
                row.state.traction.y - stored("tau"),
                (row.state.own[WORK] - stored("W")) / energy,
            ];
            errors = std::array::from_fn(|i| errors[i].max(off[i].abs()));
        }
        errors
    }
}

/// Splitmix64 from a fixed seed: the same numbers every day.
pub struct Random(pub u64);

impl Random {
    /// Evenly between two bounds.
    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        lo + (hi - lo) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly between two powers of ten.
    pub fn power(&mut self, lo: f64, hi: f64) -> f64 {
        10f64.powf(self.between(lo, hi))
    }

    pub fn coin(&mut self) -> bool {
        self.between(0.0, 1.0) < 0.5
    }

    pub fn direction(&mut self) -> Local {
        let angle = self.between(0.0, std::f64::consts::TAU);
        Local::new(angle.cos(), angle.sin(), 0.0)
    }

    /// One or the other law of unloading; the stream does not move on.
    pub fn unloading(&self) -> Unloading {
        if (self.0 >> 17) & 1 == 0 { Unloading::Closing } else { Unloading::Plastic }
    }

    /// A cracking law without inadmissible or doubtful parameters, of the size of rock and concrete (MPa, m).
    pub fn cracking(&mut self, unloading: Unloading) -> Cracking {
        loop {
            let chi = self.between(0.3, 4.0);
            let t = self.between(0.3, 1.2);
            let energy = self.power(-4.5, -3.0);
            let kn = self.power(4.5, 7.5);
            let law = Cracking {
                normal_stiffness: kn,
                tangential_stiffness: kn * self.between(0.2, 1.5),
                tensile_strength: chi,
                cohesion: chi * t * self.between(1.02, 5.0),
                tan_friction: t,
                tan_friction_residual: Some(t * self.between(0.3, 1.0)),
                fracture_energy_i: energy,
                fracture_energy_iia: energy * self.between(1.0, 20.0),
                dilatancy_stress: if self.coin() { 0.0 } else { self.between(1.0, 40.0) },
                unloading,
                alpha_tensile_strength: self.between(-1.5, 1.5),
                alpha_cohesion: self.between(-1.5, 1.5),
                alpha_tan_friction: self.between(-1.5, 1.5),
                alpha_dilatancy_stress: self.between(-2.0, 2.0),
                alpha_dilatancy_cohesion: self.between(-2.0, 2.0),
            };
            if law.check().is_ok() && law.warnings().is_empty() {
                return law;
            }
        }
    }
}
