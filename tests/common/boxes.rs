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

use super::{Law, Scene, Step, cracking, even, faces, rectangle, step};

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
    /// The law of a scene.
    pub fn law(&self) -> Law {
        let Cracking { stiffness: k, tensile_strength, cohesion, tan_friction, energies, .. } = *self;
        cracking(k, k, [tensile_strength, cohesion, tan_friction], energies)
            .with("dilatancy_stress", self.dilatancy_stress)
            .with("unloading", self.unloading)
    }

    /// The scene of a box with this law, compressed by a pressure and then sheared.
    pub fn sheared(&self, pressure: f64, shear: Step) -> Scene {
        let compression = step("compression").pressure("upper.top", pressure).fix("lower.bottom", "y");
        let sides = ["lower.left", "lower.right", "upper.left", "upper.right"];
        Scene::new("strain")
            .subdomains(["lower", "upper"], "rock")
            .material("rock", 1e4, 0.2)
            .interface("joint", faces("lower.top", "upper.bottom").law(self.law()))
            .step(sides.into_iter().fold(compression, |step, side| step.fix(side, "x")))
            .step(shear)
            .probe("shear", "joint.resultant_t")
    }
}

/// The shear of a box by a slide.
pub fn shear(slide: f64, increments: usize) -> Step {
    step("shear").increments(increments).displace("upper.left", "x", slide).displace(
        "upper.right",
        "x",
        slide,
    )
}

/// Both layers with so many edges along the interface.
pub fn layers(lower: usize, upper: usize) -> Vec<Mesh> {
    let layer = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 0.5, (n / 2).max(1)), Shape::Quadrilateral4, |x, y| [x, y])
    };
    vec![layer(lower, -0.5), layer(upper, 0.0)]
}
