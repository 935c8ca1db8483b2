//! Joining two unmatched sides: from chains of edges to one linear operator (paper §3.1, eq. 14).
//!
//! ```text
//!   side B   ●───────●─────●─────────●        nodes of B
//!   C        ┼────┼──┼─────┼──┼──────┼        segments: cut at the projections of all nodes
//!   side A   ●────●────────●──●──────●        nodes of A
//! ```
//!
//! A coupling turns nodal displacements u into jump coefficients a and these into jumps at law points:
//!
//! ```text
//! a = G u,  G = M⁻¹ B        r_p = R_p N_p a        F = Gᵀ Σ_p w_p N_pᵀ R_pᵀ t(r_p)
//! ```
//!
//! Everything geometric ends in G, N, R, w. `pointwise` takes the jumps at the quadrature points of every segment as
//! coefficients (M = I, N = I). `projected` carries the jump on a grid of the mid-plane, as fine as the locally coarser
//! side, and projects in L2; a matched interface is the classical zero-thickness element in both.

mod banded;
mod chain;
mod csr;
mod grid;
mod jump;
mod midplane;
mod pointwise;
mod projected;

pub use chain::{Chain, Side};
pub use csr::Csr;
pub use midplane::{Midplane, Segment};

use crate::error::Result;

/// How the sides are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Jump projected on the mid-plane's own grid, quadratic where both sides are.
    Projected,
    /// The same on a linear grid, whatever the sides.
    ProjectedLinear,
    /// Jump at quadrature points of every segment.
    Pointwise,
}

/// Where the law acts within its interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Points {
    /// Gauss points.
    Gauss,
    /// Lobatto points.
    Lobatto,
}

/// The joint as the solver sees it, with the geometry it came from.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// Displacement components per node.
    pub components: usize,
    /// Points of A's mesh that the coupling touches; the first columns of `jump`.
    pub nodes_a: Vec<usize>,
    /// Points of B's mesh; the columns after those of A.
    pub nodes_b: Vec<usize>,
    /// G: row `components · coefficient + component`, column `components · node + component`.
    pub jump: Csr,
    /// Where the law acts, in order along C.
    pub points: Vec<LawPoint>,
    /// Arc lengths of the grid's nodes from the start of the common length; empty for `pointwise`.
    pub grid: Vec<f64>,
    /// The geometry.
    pub midplane: Midplane,
}

/// A place where the law acts.
#[derive(Debug, Clone)]
pub struct LawPoint {
    /// Length of C that it stands for [length].
    pub weight: f64,
    /// Arc length along C from the start of the common length [length].
    pub s: f64,
    /// Its place in the plane.
    pub position: [f64; 2],
    /// R: rows n and t in x, y.
    pub rotation: [[f64; 2]; 2],
    /// N: (coefficient, value); unused entries have the value zero.
    pub interpolation: [(usize, f64); 3],
}

impl Coupling {
    /// Joins two sides. `name` is the interface's, for messages.
    pub fn build(name: &str, a: Side, b: Side, kind: Kind, points: Points) -> Result<Coupling> {
        let midplane = Midplane::build(name, a, b)?;
        Ok(match kind {
            Kind::Projected => projected::build(midplane, points, true),
            Kind::ProjectedLinear => projected::build(midplane, points, false),
            Kind::Pointwise => pointwise::build(midplane, points),
        })
    }

    /// Number of jump coefficients, each of `components` values.
    pub fn coefficients(&self) -> usize {
        self.jump.rows() / self.components
    }
}
