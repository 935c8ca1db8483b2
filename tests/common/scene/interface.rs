//! Interfaces of a scene and their laws.

use serde_json::Value;

use super::{Interface, Law, pair};

/// The interface of two sides: one curve or a list of curves each.
pub fn faces(side_a: impl Into<Value>, side_b: impl Into<Value>) -> Interface {
    Interface::default().with("side_a", side_a).with("side_b", side_b)
}

/// The interfaces of all pairs of subdomains that touch, by two patterns of names.
pub fn between(side_a: &str, side_b: &str) -> Interface {
    Interface::default().with("between", pair(side_a, side_b))
}

/// The interfaces along curves inside a body.
pub fn within(curves: impl Into<Value>) -> Interface {
    Interface::default().with("within", curves)
}

impl Interface {
    /// Its law.
    pub fn law(self, law: Law) -> Interface {
        self.with("law", law)
    }

    /// Its coupling: "projected" or "pointwise".
    pub fn coupling(self, coupling: &str) -> Interface {
        self.with("coupling", coupling)
    }

    /// Initial traction (n, t).
    pub fn initial_traction(self, n: impl Into<Value>, t: impl Into<Value>) -> Interface {
        self.with("initial_traction", pair(n, t))
    }
}

/// A law of any type, without its parameters.
pub fn law(kind: &str) -> Law {
    Law::default().with("type", kind)
}

/// Springs K_N and K_T.
pub fn elastic(kn: impl Into<Value>, kt: impl Into<Value>) -> Law {
    law("elastic").with("normal_stiffness", kn).with("tangential_stiffness", kt)
}

/// Friction μ on springs K_N and K_T.
pub fn coulomb(kn: impl Into<Value>, kt: impl Into<Value>, friction: impl Into<Value>) -> Law {
    Law(elastic(kn, kt).0).with("type", "coulomb").with("friction_coefficient", friction)
}

/// Cracking on springs K_N and K_T: strengths χ₀ and c₀, tan φ₀, energies G_I and G_IIa, no dilatancy.
pub fn cracking(
    kn: impl Into<Value>,
    kt: impl Into<Value>,
    [chi, c, tan_phi]: [f64; 3],
    [gf_i, gf_iia]: [f64; 2],
) -> Law {
    Law(elastic(kn, kt).0)
        .with("type", "cracking")
        .with("tensile_strength", chi)
        .with("cohesion", c)
        .with("tan_friction", tan_phi)
        .with("fracture_energy_i", gf_i)
        .with("fracture_energy_iia", gf_iia)
        .with("dilatancy_stress", 0)
}

/// Cohesion on springs K_N and K_T: strengths in tension and shear, energies G_I and G_II.
pub fn cohesive(kn: impl Into<Value>, kt: impl Into<Value>, strengths: [f64; 2], energies: [f64; 2]) -> Law {
    Law(elastic(kn, kt).0)
        .with("type", "cohesive")
        .with("tensile_strength", strengths[0])
        .with("shear_strength", strengths[1])
        .with("fracture_energy_i", energies[0])
        .with("fracture_energy_ii", energies[1])
}
