//! Lines of flow: intervals one after the other, with the nodes of the network on them.

use super::interval::Interval;

/// A place of a line that is a node of the network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Arc length along the line [length].
    pub s: f64,
    /// Number of the node.
    pub node: usize,
}

/// An interface with flow.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowLine {
    /// Number of the interface.
    pub interface: usize,
    /// Aperture where the faces touch [length].
    pub aperture: f64,
    /// Viscosity μ [stress × time].
    pub viscosity: f64,
    /// Its intervals from s = 0 to s = 1, without a break.
    pub intervals: Vec<Interval>,
    /// Its nodes in order: both ends, and drains and junctions between.
    pub stations: Vec<Station>,
}
