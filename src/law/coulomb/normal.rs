//! The normal springs with derivatives.

use super::jet::Jet;
use crate::law::closure::{Closure, Springs, bend};

/// σ at a jump.
pub(super) fn traction(springs: &Springs, u: Jet) -> Jet {
    let (value, slope) = springs.answer(u.value);
    u.map(value, slope)
}

/// Slope of the traction between two jumps.
pub(super) fn secant(springs: &Springs, from: Jet, to: Jet) -> Jet {
    match springs {
        Springs::Closing(Closure { initial_stiffness, maximum }) => {
            let room = |u: Jet| (1.0 / maximum) * u + 1.0;
            Jet::from(*initial_stiffness) / (room(from) * room(to))
        }
        Springs::Linear(k) => (*k).into(),
    }
}

/// Mean of the traction between two jumps.
pub(super) fn mean(springs: &Springs, from: Jet, to: Jet) -> Jet {
    match springs {
        Springs::Closing(Closure { initial_stiffness, maximum }) => {
            let start = (1.0 / maximum) * from;
            let room = start + 1.0;
            let h = (1.0 / maximum) * (to - from) / room;
            let (value, slope) = bend(h.value);
            (initial_stiffness * maximum) * (start + h.map(value, slope)) / room
        }
        Springs::Linear(k) => (0.5 * k) * (from + to),
    }
}
