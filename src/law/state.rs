//! State of a law point and the response of a law.

use serde::{Deserialize, Serialize};

use super::local::{Local, LocalMatrix, S};
use super::variable::OWN;

/// Integration of a law that depends on the way from the old jump to the new one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Integration {
    /// Second order with sub-steps chosen so that the traction is within this tolerance, relative to the larger of
    /// tensile strength and cohesion.
    Tolerance(f64),
    /// Plain backward Euler in this many equal steps (0 counts as 1): first order.
    BackwardEuler(usize),
}

/// State of a law point from one increment to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct State {
    /// Jump at the last accepted increment [length].
    pub jump: Local,
    /// Traction at that jump [stress].
    pub traction: Local,
    /// Irreversible jump [length]: the jump at which the point carries nothing.
    pub jump_plastic: Local,
    /// Variables of the law itself, each at its place (`Law::variables`); zero where the law has none.
    pub own: [f64; OWN],
    /// 0 elastic or stick, 1 T, 2 C or slip, 3 Z, 4 A or open; where cracks close, elastic once cracked: 5 closed, 6 open and tied.
    pub status: u8,
}

/// Strength of a law point at some state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// Tensile strength χ [stress].
    pub tensile_strength: f64,
    /// Cohesion c [stress].
    pub cohesion: f64,
    /// Tangent of the friction angle [-].
    pub tan_friction: f64,
}

/// Response of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Traction [stress].
    pub traction: Local,
    /// ∂traction/∂jump, rows and columns (n, t, s) [stress / length]; unsymmetric in general.
    pub stiffness: LocalMatrix,
    /// State at the end of the increment.
    pub state: State,
    /// Energy dissipated in the increment per area, ∫ t·dr^p, friction included [stress × length].
    pub dissipation: f64,
    /// ∂dissipation/∂jump [stress].
    pub dissipation_gradient: Local,
    /// ∂damage/∂jump of a law that has a damage (`PointLaw::damage`) [1 / length].
    pub damage_gradient: Local,
    /// Energy per area lost at once by a drop of the traction within the increment, not part of the dissipation
    /// [stress × length]; the cohesion of `coulomb` faces that part, zero for the other laws.
    pub released: f64,
}

/// Why a law has no answer at this jump.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unresolved {
    /// The jump is not a number.
    #[error("the jump ({}) is not finite", listed(jump))]
    NotFinite {
        /// The jump that was asked for.
        jump: Local,
    },
    /// The faces are nearer than their closure lets them be.
    #[error("the jump ({}) closes the joint by its maximum of {:e} or more", listed(jump), -narrowest)]
    Closed {
        /// The jump that was asked for.
        jump: Local,
        /// Least normal jump less the irreversible one.
        narrowest: f64,
    },
    /// The traction snaps at a point of the way: the stiffnesses are too low for the energies (local snap-back).
    #[error(
        "the traction snaps near jump ({}): the interface stiffness is too low for its fracture energies",
        listed(jump)
    )]
    SnapBack {
        /// Fraction of the way at which the traction snaps.
        jump: Local,
    },
}

impl State {
    /// True if the way to a jump lies in the plane of n and t.
    #[inline]
    pub(super) fn is_plane(&self, jump: &Local) -> bool {
        jump[S] == 0.0 && self.jump[S] == 0.0 && self.traction[S] == 0.0 && self.jump_plastic[S] == 0.0
    }
}

/// The components of a local vector for a message: two in the plane.
pub(super) fn listed(v: &Local) -> String {
    let shown = if v[S] == 0.0 { &v.as_slice()[..S] } else { v.as_slice() };
    shown.iter().map(|component| format!("{component:?}")).collect::<Vec<_>>().join(", ")
}
