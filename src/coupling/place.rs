//! The waist between the geometry of an interface and everything else: a table of places of C.
//!
//! ```text
//! Place   weight, position, frame, way between the sides, on which facet of either side at which ξ, functions of the grid
//! ```
//!
//! `line` fills it from two chains of edges; `pointwise`, `projected` and `jump` know nothing else of geometry.

use crate::shape::vector::{minus, norm};
use crate::shape::{Ends, FacetPoint, LineValues, Shape};

/// One for side A and one for side B.
pub type Sides<T> = [T; 2];

/// The facets of one side.
#[derive(Debug, Clone, Default)]
pub struct Facets {
    /// Shape of every facet.
    pub shapes: Vec<Shape>,
    /// Numbers in `nodes` of the nodes of every facet, ends before mid-nodes.
    pub corners: Vec<Vec<usize>>,
    /// Nodes of the model.
    pub nodes: Vec<usize>,
    /// Their coordinates from the origin of the table [length].
    pub points: Vec<[f64; 3]>,
}

/// A point on a facet.
#[derive(Debug, Clone, Copy)]
pub struct OnFacet {
    /// Number of the facet.
    pub facet: usize,
    /// Reference coordinates on it.
    pub xi: FacetPoint,
    /// Way from the facet to the curve that its nodes and their directions draw [length].
    pub off: [f64; 3],
}

/// A place of C.
#[derive(Debug, Clone)]
pub struct Place {
    /// Length or area of C that it stands for.
    pub weight: f64,
    /// Arc length along C [length].
    pub s: f64,
    /// Half-way between the sides.
    pub position: [f64; 3],
    /// R: rows n, t, s; n points from A to B.
    pub frame: [[f64; 3]; 3],
    /// Way from the curve of A to that of B [length].
    pub apart: [f64; 3],
    /// Its points on side A and on side B.
    pub on: [OnFacet; 2],
    /// Functions of the grid that are not zero on its cell: (node, value).
    pub functions: Vec<(usize, f64)>,
}

/// The grid on C that carries the projected jump.
#[derive(Debug, Clone, Default)]
pub struct Nodes {
    /// Number of its nodes.
    pub count: usize,
    /// Place of every node in the mass matrix.
    pub row: Vec<usize>,
    /// Half band width of the mass matrix.
    pub band: usize,
    /// Components that are no unknowns.
    pub slaved: Vec<Slaved>,
}

/// A component of a grid node that is no unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Slaved {
    /// The node.
    pub node: usize,
    /// Its component, in x, y.
    pub component: usize,
    /// Nodes that it follows, with their weights.
    pub from: Vec<(usize, f64)>,
}

/// The table: everything of the geometry that a coupling is made of.
#[derive(Debug, Clone)]
pub struct Table {
    /// Facets of side A and side B.
    pub sides: [Facets; 2],
    /// Places over which the jump is projected, in runs over one pair of facets; none for `pointwise`.
    pub projection: Vec<Vec<Place>>,
    /// Places where the law acts, in order along C.
    pub points: Vec<Place>,
    /// The grid; empty for `pointwise`.
    pub nodes: Nodes,
    /// C in numbers, for checks, reports and pictures.
    pub midplane: Midplane,
}

/// C in numbers.
#[derive(Debug, Clone)]
pub struct Midplane {
    /// Origin of the coordinates of the facets.
    pub origin: [f64; 3],
    /// Length of C [length].
    pub length: f64,
    /// Smallest and largest distance from A to B along n; negative where they overlap [length].
    pub gap: Ends,
    /// Largest distance of the sides, either way, beyond what chords of one curve differ by [length].
    pub apart: f64,
    /// Shares of A's and of B's length that are joined.
    pub joined: Sides<f64>,
    /// The largest turn at a kink of either side [rad].
    pub kink: f64,
    /// The segments of C, piece after piece, in order within each.
    pub segments: Vec<SegmentView>,
    /// The smooth pieces of C.
    pub pieces: Vec<Piece>,
    /// The cells of the grid, in order; none for `pointwise`.
    pub cells: Vec<CellView>,
    /// Number of the grid's nodes between cells, those at which it splits twice; none for `pointwise`.
    pub grid_nodes: usize,
}

/// A segment of C: the common part of two facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentView {
    /// Arc lengths of its start and end along C [length].
    pub s: Ends,
    /// Its start and end.
    pub places: [[f64; 3]; 2],
    /// Facets of side A and side B.
    pub facets: [usize; 2],
    /// Its projections on them, as fractions from the facet's start to its end.
    pub projections: Sides<Ends>,
}

/// A cell of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellView {
    /// Arc lengths of its start and end along C [length].
    pub s: Ends,
    /// Its start and end.
    pub places: [[f64; 3]; 2],
}

/// Segments that follow each other without a kink of C or a gap in either side.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// Numbers of its segments.
    pub segments: std::ops::Range<usize>,
    /// True if it ends where it starts.
    pub closed: bool,
    /// True if it starts where the piece before it ends.
    pub follows: bool,
}

impl Facets {
    /// Number of facets.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// True if there is none.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Functions of a facet and their derivatives at ξ, node by node.
    pub(super) fn functions(&self, on: &OnFacet) -> (LineValues, LineValues) {
        self.shapes[on.facet].line_functions(on.xi[0])
    }

    /// The point of a facet for the values of its functions.
    pub(super) fn point(&self, facet: usize, n: LineValues) -> [f64; 3] {
        self.combine(facet, n)
    }

    /// dx/dξ of a facet for the derivatives of its functions.
    pub(super) fn derivative(&self, facet: usize, dn: LineValues) -> [f64; 3] {
        self.combine(facet, dn)
    }

    fn combine(&self, facet: usize, factors: LineValues) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (&node, factor) in self.corners[facet].iter().zip(factors) {
            (0..3).for_each(|d| sum[d] += factor * self.points[node][d]);
        }
        sum
    }

    /// Distance of the ends of a facet [length].
    pub fn chord(&self, facet: usize) -> f64 {
        let [p, q] = [0, 1].map(|end| self.points[self.corners[facet][end]]);
        norm(minus(q, p))
    }
}
