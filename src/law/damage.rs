//! Damage with linear springs, the smallest law with a variable of its own: t = (1 − D) K r, D = min(max(D, |r|/r_f), 1).
//! It is here to show what a new law touches: this file and its line in the list of laws.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, positive};
use super::bounds::bounded;
use super::local::{Local, LocalMatrix};
use super::variable::{LawVariable, OWN};
use super::{Integration, PointLaw, Response, State, Unresolved};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Damage {
    /// Stiffness K in all directions [stress / length].
    pub stiffness: f64,
    /// Jump r_f at which nothing is left [length].
    pub failure_jump: f64,
}

const VARIABLES: [LawVariable; 1] = [LawVariable {
    name: "stiffness_lost",
    unit: "-",
    meaning: "share D of the stiffness that is lost",
    place: 0,
}];

impl PointLaw for Damage {
    fn all_variables() -> &'static [LawVariable] {
        &VARIABLES
    }

    fn variables(&self) -> &'static [LawVariable] {
        &VARIABLES
    }

    fn check(&self) -> Result<(), Inadmissible> {
        positive("stiffness", self.stiffness)?;
        positive("failure_jump", self.failure_jump)
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.stiffness; 3]
    }

    /// ½ (1 − D) K r².
    fn stored(&self, state: &State) -> f64 {
        0.5 * (1.0 - state.own[0]) * self.stiffness * state.jump.norm_squared()
    }

    fn at_rest(&self, jump: Local, _: Local, own: &[f64; OWN]) -> Local {
        jump * ((1.0 - own[0]) * self.stiffness)
    }

    /// ∫ ½ K r² dD = K r_f² (D³ − D₀³)/6, for r = D r_f as D grows.
    fn respond(&self, jump: Local, old: &State, _: Integration) -> Result<Response, Unresolved> {
        let (k, size, d0) = (self.stiffness, jump.norm(), old.own[0]);
        let d = bounded(size / self.failure_jump, d0, 1.0);
        let grows = d > d0 && d < 1.0;
        let slope = if grows { jump / (size * self.failure_jump) } else { Local::zeros() };
        let traction = jump * ((1.0 - d) * k);
        let mut own = old.own;
        own[0] = d;
        Ok(Response {
            traction,
            stiffness: LocalMatrix::identity() * ((1.0 - d) * k) - jump * slope.transpose() * k,
            state: State { jump, traction, own, status: u8::from(d > 0.0), ..*old },
            dissipation: k * self.failure_jump.powi(2) * (d.powi(3) - d0.powi(3)) / 6.0,
            dissipation_gradient: slope * (0.5 * k * size * size),
            damage_gradient: Local::zeros(),
            released: 0.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use crate::law::path;
    use crate::law::{Integration, Law, Local};
    use crate::run::{self, Options};

    const LAW: &str = r#"{ "type": "damage", "stiffness": 8.0, "failure_jump": 0.5 }"#;

    /// Two unit squares that are pulled apart by 0.3 in one step, pushed back to 0.1 in the next; the joint opens alike, for the
    /// bodies are stiff.
    fn write_scene(folder: &Path) {
        let part = |y: i32, edges: i32| {
            format!(
                "Point(1) = {{0, {y}, 0}};\nPoint(2) = {{1, {y}, 0}};\nPoint(3) = {{1, {y} + 1, 0}};\nPoint(4) = {{0, {y} + 1, 0}};\n\
                 Line(1) = {{1, 2}};\nLine(2) = {{2, 3}};\nLine(3) = {{3, 4}};\nLine(4) = {{4, 1}};\n\
                 Curve Loop(1) = {{1, 2, 3, 4}};\nPlane Surface(1) = {{1}};\n\
                 Transfinite Curve {{1, 2, 3, 4}} = {edges} + 1;\n\
                 Physical Curve(\"bottom\") = {{1}};\nPhysical Curve(\"top\") = {{3}};\nPhysical Surface(\"body\") = {{1}};\n"
            )
        };
        fs::write(folder.join("lower.geo"), part(0, 2)).unwrap();
        fs::write(folder.join("upper.geo"), part(1, 3)).unwrap();
        let text = format!(
            r#"{{
  "title": "A law of its own",
  "plane": "stress",
  "subdomains": {{
    "lower": {{ "geo": "lower.geo", "material": "steel" }},
    "upper": {{ "geo": "upper.geo", "material": "steel" }}
  }},
  "materials": {{ "steel": {{ "young": 1e9, "poisson": 0.0 }} }},
  "interfaces": {{ "joint": {{ "side_a": "lower.top", "side_b": "upper.bottom", "law": {LAW} }} }},
  "steps": [
    {{ "name": "open", "increments": 3, "fix": {{ "lower": ["x"], "lower.bottom": ["y"], "upper": ["x"] }},
       "displace": {{ "upper.top": {{ "y": 0.3 }} }} }},
    {{ "name": "close", "increments": 2, "displace": {{ "upper.top": {{ "y": 0.1 }} }} }}
  ],
  "output": {{ "history": {{
    "t": "joint.traction_n@0.5", "d": "joint.stiffness_lost@0.5", "stored": "energy.stored", "spent": "energy.dissipated"
  }} }}
}}"#
        );
        fs::write(folder.join("scene.json"), text).unwrap();
    }

    /// Claim: the stiffness is the derivative of the traction, while damage grows, where the point unloads, and when all is lost.
    #[test]
    fn the_stiffness_is_the_derivative() {
        let law: Law = serde_json::from_str(LAW).unwrap();
        let damaged = law
            .respond(Local::new(0.2, 0.0, 0.0), &Default::default(), Integration::BackwardEuler(1))
            .unwrap()
            .state;
        for jump in [Local::new(0.2, 0.15, -0.1), Local::new(0.05, 0.08, 0.02), Local::new(0.4, -0.4, 0.3)] {
            let traction = |jump: Local| law.respond(jump, &damaged, Integration::BackwardEuler(1)).unwrap();
            let stiffness = traction(jump).stiffness;
            for column in 0..3 {
                let mut step = Local::zeros();
                step[column] = 1e-6;
                let slope = (traction(jump + step).traction - traction(jump - step).traction) / 2e-6;
                let off = (slope - stiffness.column(column)).norm();
                assert!(off < 1e-8, "{jump:?}, {column}: {slope:?}, {:?}", stiffness.column(column));
            }
        }
    }

    /// Claim: a law's own variable reaches arrays, probes, the table of `midplane law` and the energies without a word elsewhere.
    #[test]
    fn a_new_law_is_a_file_and_a_line() {
        let folder = tempfile::tempdir().unwrap();
        write_scene(folder.path());
        let out = folder.path().join("results");
        let options = Options { out: Some(out.clone()), ..Options::of(folder.path()) };
        run::run(&options, &mut |_| {}).unwrap();
        let history = fs::read_to_string(out.join("history.csv")).unwrap();
        let mut lines = history.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = lines.next().unwrap();
        let rows: Vec<Vec<&str>> = lines.collect();
        let value = |row: &[&str], name: &str| {
            row[names.iter().position(|column| *column == name).unwrap()].parse::<f64>().unwrap()
        };
        for (k, r) in [0.1, 0.2, 0.3, 0.2, 0.1].into_iter().enumerate() {
            let row = &rows[rows.len() - 5 + k];
            let d = if k < 3 { r / 0.5 } else { 0.6 };
            let expected = [
                ("t", 8.0 * (1.0 - d) * r),
                ("d", d),
                ("stored", 4.0 * (1.0 - d) * r * r),
                ("spent", d * d * d / 3.0),
            ];
            for (name, exact) in expected {
                let got = value(row, name);
                assert!((got - exact).abs() < 1e-6, "{name} at {r}: {got}, exact {exact}");
            }
            assert!(value(row, "energy_balance").abs() < 0.02);
        }
        let vtu = fs::read(out.join("fields/joint_0001.vtu")).unwrap();
        let text = String::from_utf8_lossy(&vtu);
        assert!(text.contains("stiffness_lost") && !text.contains("fracture_work"));
        let law: Law = serde_json::from_str(LAW).unwrap();
        assert!(path::columns(&law).contains(",stiffness_lost,"));
        let start = law.initial_state(Local::zeros(), 0.0).unwrap();
        let answer = law.respond(Local::new(0.3, 0.0, 0.4), &start, Integration::Tolerance(1e-4)).unwrap();
        assert_eq!((answer.state.own[0], law.stored(&answer.state)), (1.0, 0.0));
        assert!((answer.dissipation - 8.0 * 0.25 / 6.0).abs() < 1e-15);
    }
}
