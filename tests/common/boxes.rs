//! Two layers sheared over each other under pressure, joined by a cracking interface.
//!
//! ```text
//!          P
//!     ┌─────────┐  0.5
//!   → │  upper  │ →   u_x = U on both sides
//!     ├─────────┤
//!     │  lower  │     u_x = 0 on both sides
//!     └─△──△──△─┘
//! ```

use midplane::mesh::Mesh;
use midplane::shape::Shape;

use super::{even, rectangle};

/// The rock of the gallery and a masonry interface [MPa, m].
pub const ROCK: Cracking = Cracking {
    stiffness: 1e7,
    tensile_strength: 3.0,
    cohesion: 4.0,
    tan_friction: 0.8785,
    energies: [2e-4, 2e-3],
    dilatancy_stress: 0.0,
    unloading: "plastic",
};
pub const MASONRY: Cracking = Cracking {
    stiffness: 1e6,
    tensile_strength: 0.2,
    cohesion: 0.3,
    tan_friction: 0.75,
    energies: [2e-5, 1e-4],
    dilatancy_stress: 0.0,
    unloading: "plastic",
};

/// Parameters of a cracking law.
#[derive(Debug, Clone, Copy)]
pub struct Cracking {
    pub stiffness: f64,
    pub tensile_strength: f64,
    pub cohesion: f64,
    pub tan_friction: f64,
    pub energies: [f64; 2],
    pub dilatancy_stress: f64,
    pub unloading: &'static str,
}

impl Cracking {
    /// The law as a scene has it.
    pub fn text(&self) -> String {
        let Cracking {
            stiffness: k,
            tensile_strength,
            cohesion,
            tan_friction,
            energies: [g1, g2],
            dilatancy_stress,
            unloading,
        } = self;
        format!(
            r#""type": "cracking", "normal_stiffness": {k:e}, "tangential_stiffness": {k:e}, "tensile_strength": {tensile_strength:e},
            "cohesion": {cohesion:e}, "tan_friction": {tan_friction:e}, "fracture_energy_i": {g1:e},
            "fracture_energy_iia": {g2:e}, "dilatancy_stress": {dilatancy_stress:e}, "unloading": "{unloading}""#
        )
    }
}

/// The scene of a box whose law is written as in a scene, under pressure, sheared by `slide` in so many increments.
pub fn scene(
    law: &str,
    pressure: f64,
    slide: f64,
    increments: usize,
    solution: &str,
    control: &str,
) -> String {
    format!(
        r#"{{"plane": "strain",
        "subdomains": {{"lower": {{"msh": "a", "material": "rock"}}, "upper": {{"msh": "b", "material": "rock"}}}},
        "materials": {{"rock": {{"young": 1e4, "poisson": 0.2}}}},
        "interfaces": {{"joint": {{"side_a": "lower.top", "side_b": "upper.bottom", "law": {{{law}}}}}}},
        "solution": {{{solution}}},
        "steps": [
            {{"name": "compression", "load": {{"upper.top": {{"pressure": {pressure:e}}}}}, "fix": {{"lower.bottom": ["y"],
              "lower.left": ["x"], "lower.right": ["x"], "upper.left": ["x"], "upper.right": ["x"]}}}},
            {{"name": "shear", "increments": {increments}, "control": "{control}",
              "displace": {{"upper.left": {{"x": {slide:e}}}, "upper.right": {{"x": {slide:e}}}}}}}],
        "output": {{"history": {{"shear": "joint.resultant_t"}}}}}}"#
    )
}

/// Both layers with so many edges along the interface.
pub fn layers(lower: usize, upper: usize) -> Vec<Mesh> {
    let layer = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 0.5, (n / 2).max(1)), Shape::Quadrilateral4, |x, y| [x, y])
    };
    vec![layer(lower, -0.5), layer(upper, 0.0)]
}
