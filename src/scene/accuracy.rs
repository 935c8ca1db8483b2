//! Presets by name, and what each of them sets.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::CouplingKind;

/// A preset of the knobs that trade speed for accuracy; docs/TRADE.md has its measured errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Accuracy {
    /// A first look: within 10 % on all scenes measured.
    Draft,
    /// The fastest within 1 % on all of them.
    Normal,
    /// One digit more: the refinement of the scene's own files.
    Fine,
}

/// Values of a preset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// Factor on the parameters that the scene lists.
    pub refinement: f64,
    /// Order of the elements.
    pub order: u8,
    /// Coupling of unmatched sides.
    pub coupling: CouplingKind,
    /// Largest out-of-balance force.
    pub tolerance: f64,
    /// Error control of the laws.
    pub law_tolerance: f64,
    /// Error control of the increments.
    pub path_tolerance: f64,
    /// Factor on the increments.
    pub increments: f64,
}

impl Accuracy {
    /// All presets with their names.
    pub const ALL: [(&str, Accuracy); 3] =
        [("draft", Accuracy::Draft), ("normal", Accuracy::Normal), ("fine", Accuracy::Fine)];

    /// Its values.
    pub fn preset(self) -> Preset {
        let coupling = CouplingKind::Projected;
        let preset = |refinement, order, tolerance, law_tolerance, path_tolerance, increments| Preset {
            refinement,
            order,
            coupling,
            tolerance,
            law_tolerance,
            path_tolerance,
            increments,
        };
        match self {
            Accuracy::Draft => preset(0.25, 2, 1e-4, 1e-2, 1e-2, 0.25),
            Accuracy::Normal => preset(0.5, 2, 1e-6, 1e-3, 1e-3, 0.5),
            Accuracy::Fine => preset(1.0, 2, 1e-8, 1e-4, 1e-4, 1.0),
        }
    }
}
