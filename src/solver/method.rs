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
    /// On these and the motions of the bodies, in a system that is sparse by blocks.
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
