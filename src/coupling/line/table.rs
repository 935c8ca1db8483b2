//! The table of places of two lines.

use super::super::place::{CellView, Facets, Midplane, Nodes, OnFacet, Place, SegmentView, Table};
use super::super::{JumpScheme, Points, Scheme, Surroundings};
use super::angle::Angles;
use super::cells::MidplaneGrid;
use super::slaved::slaved;
use super::{Chain, LineMidplane, Side, join};
use crate::error::Result;
use crate::shape::vector::{in_space, minus, plus};
use crate::shape::{GAUSS_2, GAUSS_3, LOBATTO_2, LOBATTO_3, LineRule};

/// The places of two sides, each a list of curves, for a scheme. `name` is the interface's, for messages.
///
/// Refuses sides that branch, that do not face each other, that are too far apart or have no common length.
pub fn table(name: &str, a: &[Side], b: &[Side], scheme: Scheme, around: Surroundings) -> Result<Table> {
    let c = join(name, a, b, scheme.gap)?;
    let grid = match scheme.kind {
        JumpScheme::Pointwise => None,
        kind => {
            let quadratic = kind == JumpScheme::Projected && c.a.is_quadratic() && c.b.is_quadratic();
            Some((MidplaneGrid::new(&c, quadratic), quadratic))
        }
    };
    let (projection, points) = match &grid {
        None => (Vec::new(), on_segments(&c, scheme.points)),
        Some((grid, quadratic)) => (projection(&c, grid), on_cells(&c, grid, scheme.points, *quadratic)),
    };
    let ends = grid.as_ref().map_or_else(Vec::new, |(grid, _)| grid.ends());
    let nodes = grid.map_or_else(Nodes::default, |(grid, _)| grid.nodes(slaved(&c, &grid, around)));
    let sides = [facets(&c.a), facets(&c.b)];
    Ok(Table { sides, projection, points, nodes, midplane: in_numbers(&c, &ends) })
}

fn facets(chain: &Chain) -> Facets {
    Facets {
        shapes: chain.shapes.clone(),
        corners: (0..chain.edges()).map(|e| chain.edge(e).collect()).collect(),
        nodes: chain.nodes.clone(),
        points: chain.points.iter().map(|&x| in_space(x)).collect(),
    }
}

/// The place η of a segment at arc length `s`, without weight and functions of the grid; and the length of C per η there.
fn place(c: &LineMidplane, segment: usize, eta: f64, s: f64) -> (Place, f64) {
    let (spot, g) = (c.spot(segment, eta), &c.segments[segment]);
    let on = |chain: &Chain, angles: &Angles, facet: usize, xi: f64| {
        let on = OnFacet { facet, xi: [xi, 0.0], off: in_space(angles.to_curve(chain, facet, xi)) };
        (on, in_space(chain.point(facet, xi)))
    };
    let (on_a, x_a) = on(&c.a, &c.angles[0], g.edge_a, spot.xi_a);
    let (on_b, x_b) = on(&c.b, &c.angles[1], g.edge_b, spot.xi_b);
    let [n, t] = spot.rotation;
    let place = Place {
        weight: 0.0,
        s,
        position: in_space(spot.position),
        frame: [in_space(n), in_space(t), [0.0, 0.0, 1.0]],
        apart: plus(minus(x_b, x_a), minus(on_b.off, on_a.off)),
        on: [on_a, on_b],
        functions: Vec::new(),
    };
    (place, spot.speed)
}

/// Quadrature points of the segments, with the functions of the grid; a quadratic side needs three also on a linear grid.
fn projection(c: &LineMidplane, grid: &MidplaneGrid) -> Vec<Vec<Place>> {
    let any = c.a.shapes.iter().chain(&c.b.shapes).any(|shape| shape.is_quadratic());
    let mut cell = 0;
    let places = c.segments.iter().enumerate().map(|(g, segment)| {
        while 0.5 * (segment.start + segment.end) > grid.cells[cell].end && cell + 1 < grid.cells.len() {
            cell += 1;
        }
        let points = if any { GAUSS_3 } else { GAUSS_2 }.iter().map(|&[eta, weight]| {
            let s = segment.start + 0.5 * (segment.end - segment.start) * (1.0 + eta);
            let (place, speed) = place(c, g, eta, s);
            Place { weight: speed * weight, functions: grid.functions(cell, s), ..place }
        });
        points.collect()
    });
    places.collect()
}

/// Quadrature points of the cells.
fn on_cells(c: &LineMidplane, grid: &MidplaneGrid, points: Points, quadratic: bool) -> Vec<Place> {
    let mut places = Vec::new();
    for (i, cell) in grid.cells.iter().enumerate() {
        let half = 0.5 * (cell.end - cell.start);
        let first = places.len();
        for &[xi, weight] in rule(points, quadratic) {
            let s = cell.start + half * (1.0 + xi);
            let (g, eta) = c.locate(&c.pieces[cell.piece], s);
            let ((place, speed), segment) = (place(c, g, eta, s), &c.segments[g]);
            let weight = half * weight * speed / (0.5 * (segment.end - segment.start));
            places.push(Place { weight, functions: grid.functions(i, s), ..place });
        }
        share_out(&mut places[first..], 2.0 * half);
    }
    places
}

/// Quadrature points of the segments, each with a jump of its own.
fn on_segments(c: &LineMidplane, points: Points) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::new();
    for (g, segment) in c.segments.iter().enumerate() {
        let quadratic = !(c.a.is_straight(segment.edge_a) && c.b.is_straight(segment.edge_b));
        let first = places.len();
        for &[eta, weight] in rule(points, quadratic) {
            let s = segment.start + 0.5 * (segment.end - segment.start) * (1.0 + eta);
            let (place, speed) = place(c, g, eta, s);
            places.push(Place { weight: speed * weight, functions: vec![(places.len(), 1.0)], ..place });
        }
        share_out(&mut places[first..], segment.end - segment.start);
    }
    places
}

/// Two points where the jump is linear, three where it is quadratic.
fn rule(points: Points, quadratic: bool) -> LineRule {
    match (points, quadratic) {
        (Points::Gauss, false) => GAUSS_2,
        (Points::Gauss, true) => GAUSS_3,
        (Points::Lobatto, false) => LOBATTO_2,
        (Points::Lobatto, true) => LOBATTO_3,
    }
}

/// Makes the weights of an interval sum to its length, whatever its curvature and the rule.
fn share_out(places: &mut [Place], length: f64) {
    let sum: f64 = places.iter().map(|place| place.weight).sum();
    places.iter_mut().for_each(|place| place.weight *= length / sum);
}

fn in_numbers(c: &LineMidplane, ends: &[f64]) -> Midplane {
    let at = |s: [f64; 2]| s.map(|end| in_space(c.position(end, 0.5 * (s[0] + s[1]))));
    let segments = c.segments.iter().map(|g| SegmentView {
        s: [g.start, g.end],
        places: at([g.start, g.end]),
        facets: [g.edge_a, g.edge_b],
        projections: [g.xi_a, g.xi_b].map(|xi| xi.map(|xi| 0.5 * (1.0 + xi))),
    });
    // where one piece of C ends and the next begins the same arc length stands twice
    let cells = ends.windows(2).filter(|pair| pair[1] > pair[0]);
    let cells = cells.map(|pair| CellView { s: [pair[0], pair[1]], places: at([pair[0], pair[1]]) });
    Midplane {
        origin: in_space(c.origin),
        length: c.length,
        gap: c.gap,
        apart: c.apart,
        joined: c.joined,
        kink: c.kink,
        segments: segments.collect(),
        pieces: c.pieces.clone(),
        cells: cells.collect(),
        grid_nodes: ends.len(),
    }
}
