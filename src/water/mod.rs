//! Steady flow of water along lines of interfaces: pressures and rates for given apertures, with their derivatives.
//!
//! ```text
//! q = −w³/(12 μ) dp/ds       w = w₀ + max(r_n, 0), r_n as the law points of an interval of C give it
//! Y(s) = ∫ ds/w³             p = p_u − (p_u − p_v) Y(s)/Y    between two nodes u and v of the network
//! q = (p_u − p_v)/(12 μ Y)   Σ q = 0 at every node without a given pressure
//! ```
//!
//! Nothing leaves a line between its nodes (ends, drains, junctions), so that q is one number there: the network has as many
//! unknowns as free nodes, and pressures and rates are exact for the apertures as they are interpolated. Literature: parallel
//! plates (cubic law), Witherspoon et al. 1980.

mod aperture;
mod branch;
mod interval;
mod line;
mod network;

pub use interval::Interval;
pub use line::{FlowLine, Station};
pub use network::{BranchFlow, FlowNode, Flowing, JumpSlopes, Network};
