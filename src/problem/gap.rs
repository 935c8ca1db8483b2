//! Initial gaps at the law points of an interface.

use crate::assembly::InterfaceOperator;
use crate::scene::InitialGap;

/// Initial gap of an interface: the normal jump, with its sign turned, at which the faces meet; negative for faces that overlap
/// and are pressed apart [length].
#[derive(Debug, Clone, PartialEq)]
pub enum Gaps {
    /// The same at all law points.
    Uniform(f64),
    /// One for every law point.
    Varying(Vec<f64>),
}

impl Gaps {
    /// Its value at a law point.
    pub fn at(&self, point: usize) -> f64 {
        match self {
            Gaps::Uniform(gap) => *gap,
            Gaps::Varying(gaps) => gaps[point],
        }
    }

    /// The gap that a scene states, on the geometry of an interface; without one the faces touch.
    pub(super) fn new(gap: Option<InitialGap>, interface: &InterfaceOperator) -> Gaps {
        match gap {
            None => Gaps::Uniform(0.0),
            Some(InitialGap::Uniform(gap)) => Gaps::Uniform(gap),
            Some(InitialGap::Drawn(_)) => {
                Gaps::Varying(interface.coupling.points.iter().map(|point| point.gap).collect())
            }
        }
    }
}
