//! Warnings: a code, the place and the reason, and help.
//!
//! docs/WARNINGS.md has a section for every code; tests/program/warnings.rs sees to that.

use std::fmt;

/// Codes of warnings, in the order W01, W02, …
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// Springs so stiff that rounding reaches the tractions.
    Rounding,
    /// `pointwise` where it oscillates.
    Oscillation,
    /// Sides that are drawn apart.
    Apart,
    /// Coordinates too far from the origin for the edges.
    FarAway,
    /// Bad cells beside an interface.
    BadCells,
    /// Shear stiffness too low for the fracture energies.
    SnapInShear,
    /// Shear stiffness too low for the loss of friction.
    SnapByFriction,
    /// A side that is joined in part.
    PartlyJoined,
    /// Groups that the scene does not use.
    UnusedGroups,
    /// Cells that belong to no subdomain.
    UnusedCells,
    /// Elements that lock in a nearly incompressible body.
    Locking,
    /// A body that next to nothing holds.
    HardlyHeld,
    /// A snap to another branch of equilibria.
    Snapped,
    /// A load that is zero everywhere.
    NoLoad,
    /// A key that the scene cannot use.
    IdleKey,
    /// Boundaries of one subdomain that lie on each other and share no nodes.
    Unconnected,
    /// Subdomains that touch and that no interface joins.
    Unjoined,
    /// Loads and reactions that do not balance.
    Unbalanced,
    /// Energies that do not balance.
    Energies,
    /// Initial tractions that supports and loads do not hold.
    InitialTraction,
    /// A subdomain that nothing holds any more, and nothing pushes.
    Unheld,
    /// A slip or an opening beyond an edge of either side.
    Beyond,
    /// Points of a softening curve whose area is not the fracture energy.
    Stretched,
    /// Initial stresses that do not agree at an interface.
    InitialStress,
    /// Initial stresses that the first loads do not hold.
    NotAtRest,
    /// Numbers of a softening interface that do not fit each other.
    OutOfScale,
}

impl Code {
    /// All of them.
    pub const ALL: [Code; 26] = [
        Code::Rounding,
        Code::Oscillation,
        Code::Apart,
        Code::FarAway,
        Code::BadCells,
        Code::SnapInShear,
        Code::SnapByFriction,
        Code::PartlyJoined,
        Code::UnusedGroups,
        Code::UnusedCells,
        Code::Locking,
        Code::HardlyHeld,
        Code::Snapped,
        Code::NoLoad,
        Code::IdleKey,
        Code::Unconnected,
        Code::Unjoined,
        Code::Unbalanced,
        Code::Energies,
        Code::InitialTraction,
        Code::Unheld,
        Code::Beyond,
        Code::Stretched,
        Code::InitialStress,
        Code::NotAtRest,
        Code::OutOfScale,
    ];
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "W{:02}", *self as u8 + 1)
    }
}

/// One thing to know. As text: `W04 interface interface: why; help`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Its code.
    pub code: Code,
    /// Place and reason, one line.
    pub what: String,
    /// Help, one line.
    pub help: String,
}

impl Warning {
    /// A warning from its parts.
    pub fn new(code: Code, what: impl Into<String>, help: impl Into<String>) -> Warning {
        Warning { code, what: what.into(), help: help.into() }
    }

    /// The same, told of something: `interface interface: …`.
    pub fn of(self, place: &str) -> Warning {
        Warning { what: format!("{place}: {}", self.what), ..self }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}; {}", self.code, self.what, self.help)
    }
}
