//! The geometry of an interface in numbers, as `midplane check` and summary.json have it.

use super::PointLaws;
use super::flow_lines::line_ends;
use super::stiffness::stiffness_number;
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::Coupling;
use crate::shape::Ends;

/// An interface in numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Edges of A and of B that are joined.
    pub edges: [usize; 2],
    /// Edges of A and of B, those that are not joined among them.
    pub facets: [usize; 2],
    /// Segments of the mid-plane.
    pub segments: usize,
    /// Nodes of the grid; none for `pointwise`.
    pub grid_nodes: usize,
    /// Points at which the law acts.
    pub law_points: usize,
    /// Length of the mid-plane [length].
    pub length: f64,
    /// Smallest and largest gap; negative where the sides overlap [length].
    pub gap: Ends,
    /// Largest turn between successive edges of a side [degrees].
    pub kink: f64,
    /// K_N h/E.
    pub stiffness_number: f64,
    /// Places of its start and end, `@0` and `@1`.
    pub ends: [[f64; 3]; 2],
}

impl Survey {
    /// Measures an interface.
    pub fn of(model: &Model, interface: &InterfaceOperator, laws: &PointLaws) -> Survey {
        let coupling = &interface.coupling;
        let shares = &coupling.midplane.segments;
        let joined = [0, 1].map(|side| {
            let mut edges: Vec<usize> = shares.iter().map(|share| share.facets[side]).collect();
            edges.sort_unstable();
            edges.dedup();
            edges
        });
        let kink = [0, 1].map(|side| largest_turn(coupling, side, &joined[side]));
        Survey {
            edges: [joined[0].len(), joined[1].len()],
            facets: [coupling.facets(0), coupling.facets(1)],
            segments: shares.len(),
            grid_nodes: coupling.midplane.grid_nodes,
            law_points: coupling.points.len(),
            length: coupling.midplane.length,
            gap: coupling.midplane.gap,
            kink: kink[0].max(kink[1]).to_degrees(),
            stiffness_number: stiffness_number(model, interface, laws),
            ends: line_ends(interface).map(|end| end.place),
        }
    }

    /// Edges of A for one of B.
    pub fn ratio(&self) -> f64 {
        self.edges[0] as f64 / self.edges[1] as f64
    }
}

/// The largest angle between the end of a joined edge and the start of the next [rad].
fn largest_turn(coupling: &Coupling, side: usize, joined: &[usize]) -> f64 {
    let follows = |pair: &&[usize]| coupling.nodes(side, pair[0])[1] == coupling.nodes(side, pair[1])[0];
    let turns = joined.windows(2).filter(follows).map(|pair| {
        let [t, u] = [(pair[0], 1.0), (pair[1], -1.0)].map(|(e, xi)| coupling.derivative(side, e, xi));
        (t[0] * u[1] - t[1] * u[0]).atan2(t[0] * u[0] + t[1] * u[1]).abs()
    });
    turns.fold(0.0, f64::max)
}
