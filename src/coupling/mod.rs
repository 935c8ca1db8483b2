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

mod jump;
mod line;
mod place;
mod pointwise;
mod projected;
mod slaves;
mod view;

pub use line::{LineMidplane, Side, join};
pub use place::{
    CellView, Facets, Midplane, Nodes, OnFacet, Piece, Place, SegmentView, Sides, Slaved, Table,
};

use crate::error::Result;
use crate::sparse::Csr;

/// Scheme of the jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JumpScheme {
    /// Jump projected on the mid-plane's own grid, quadratic where both sides are.
    Projected,
    /// The same on a linear grid, whatever the sides.
    ProjectedLinear,
    /// Jump at quadrature points of every segment.
    Pointwise,
}

/// Support of a degree of freedom over all steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Support {
    /// Free throughout.
    #[default]
    Free,
    /// Fixed, driven or held where it is in some step.
    Held,
}

/// Surroundings of an interface, which decide the ends of the grid that carry no jump of their own.
#[derive(Debug, Clone, Copy, Default)]
pub struct Surroundings<'a> {
    /// Support of every dof of the model; none if nothing is held.
    pub supports: &'a [Support],
    /// True for nodes of the model at which interfaces of more than two bodies meet; none if there are none.
    pub junctions: &'a [bool],
}

impl Surroundings<'_> {
    /// True if nothing is held and nothing meets.
    pub(crate) fn is_empty(&self) -> bool {
        self.supports.iter().all(|support| *support == Support::Free) && !self.junctions.contains(&true)
    }
}

/// Points of an interval at which the law acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Points {
    /// Gauss points.
    Gauss,
    /// Lobatto points.
    Lobatto,
}

/// Admission of a distance between the sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gap {
    /// They lie on each other, up to what chords of one curve differ by.
    Closed,
    /// The distance between them is meant: the law sees it.
    Open,
}

/// Scheme of a coupling.
#[derive(Debug, Clone, Copy)]
pub struct Scheme {
    /// Scheme of the jump.
    pub kind: JumpScheme,
    /// Points of an interval at which the law acts.
    pub points: Points,
    /// Admission of a distance between the sides.
    pub gap: Gap,
}

/// The interface as the solver sees it.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// Displacement components per node.
    pub components: usize,
    /// Facets of side A and side B; nodes of A are the first columns of `jump`, those of B the columns after them.
    pub sides: [Facets; 2],
    /// G: row `components · coefficient + component`, column `components · node + component`.
    pub jump: Csr,
    /// Law points, in order along C.
    pub points: Vec<LawPoint>,
    /// C in numbers.
    pub midplane: Midplane,
}

/// A place where the law acts.
#[derive(Debug, Clone)]
pub struct LawPoint {
    /// Length of C that it stands for [length].
    pub weight: f64,
    /// Arc length along C [length].
    pub s: f64,
    /// Its place.
    pub position: [f64; 3],
    /// R: rows n, t and s.
    pub rotation: [[f64; 3]; 3],
    /// Drawn distance from A to B along n, without what chords of one curve differ by and projected as the jump is;
    /// negative where they overlap [length].
    pub gap: f64,
    /// N: (coefficient, value).
    pub interpolation: Vec<(usize, f64)>,
    /// Its points on the facets of side A and side B that face each other there.
    pub on: Sides<OnFacet>,
}

impl LawPoint {
    fn new(place: &Place, gap: f64) -> LawPoint {
        LawPoint {
            weight: place.weight,
            s: place.s,
            position: place.position,
            rotation: place.frame,
            gap,
            interpolation: place.functions.clone(),
            on: place.on,
        }
    }
}

impl Coupling {
    /// Joins two sides, each a list of curves. `name` is the interface's, for messages.
    ///
    /// Refuses sides that branch, that do not face each other, that are too far apart or have no common length.
    pub fn build(
        name: &str,
        a: &[Side],
        b: &[Side],
        scheme: Scheme,
        around: Surroundings,
    ) -> Result<Coupling> {
        let table = line::table(name, a, b, scheme, around)?;
        let facet = table.sides[0].shapes[0];
        let components = facet.dimension() + 1; // facets bound what moves
        Ok(match scheme.kind {
            JumpScheme::Projected | JumpScheme::ProjectedLinear => projected::build(table, components),
            JumpScheme::Pointwise => pointwise::build(table, components),
        })
    }

    fn new(table: Table, components: usize, jump: Csr, points: Vec<LawPoint>) -> Coupling {
        let Table { sides, midplane, .. } = table;
        Coupling { components, sides, jump, points, midplane }
    }

    /// Number of jump coefficients, each of `components` values.
    pub fn coefficients(&self) -> usize {
        self.jump.rows() / self.components
    }
}
