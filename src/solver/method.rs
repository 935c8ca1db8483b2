//! Ways in which the equations are solved.

use serde::{Deserialize, Serialize};

/// Way in which the equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Method {
    /// Linear, with one factor of the whole.
    #[default]
    Joined,
    /// Linear, with factors of two parts side by side.
    InParts,
    /// On the jumps of the interfaces.
    Condensed,
    /// On the displacements of condensed bodies, or on jumps and rigid motions, in a system that is sparse by bodies.
    Blocks,
    /// On all displacements.
    Plain,
}

impl Method {
    /// Its name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Joined => "joined",
            Method::InParts => "in parts",
            Method::Condensed => "condensed",
            Method::Blocks => "blocks",
            Method::Plain => "plain",
        }
    }
}
