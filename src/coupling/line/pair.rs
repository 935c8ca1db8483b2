//! Which place of side A faces which place of side B.
//!
//! ```text
//!   side B   ●─────────b──────●          a and b face each other if  (x_B(b) − x_A(a)) · (t_A(a) + t_B(b)) = 0:
//!                      ┆ n               the line between them is normal to the mean of both directions
//!   side A   ●──────●──a─────────●
//! ```
//!
//! The condition is the same seen from A and from B, and it orders all pairs along C, so that nodes of either side come
//! in one order. Two lines are walked together from where one of them starts: linear in their edges.

use super::Chain;
use super::angle::{Angles, SmoothLine};
use super::segment::{LinePoint, Segment};
use crate::shape::vector::*;

/// Places are found to within this. Of the distance within which nodes are one, so that rounding is all that is left.
const FINE: f64 = 1e-3;

/// A side with its directions.
#[derive(Debug, Clone, Copy)]
pub(in crate::coupling) struct Face<'a> {
    pub chain: &'a Chain,
    pub angles: &'a Angles,
}

/// Point and unit tangent of a place.
#[derive(Debug, Clone, Copy)]
struct TangentPoint {
    x: [f64; 2],
    t: [f64; 2],
}

impl Face<'_> {
    fn spot(&self, e: usize, xi: f64) -> TangentPoint {
        TangentPoint { x: self.chain.point(e, xi), t: self.angles.tangent(e, xi) }
    }
}

/// Distance by which b lies ahead of the place that faces a [length].
fn ahead(a: TangentPoint, b: TangentPoint) -> f64 {
    dot(minus(b.x, a.x), unit(plus(a.t, b.t)))
}

/// Starts of the common parts of two lines: pairs of places at which one of the lines starts. `merge` is the distance
/// within which nodes are one [length].
pub(in crate::coupling) fn starts(
    a: Face,
    line_a: &SmoothLine,
    b: Face,
    line_b: &SmoothLine,
    merge: f64,
) -> Vec<[LinePoint; 2]> {
    let first = LinePoint { i: 0, xi: -1.0 };
    let mut found = Vec::new();
    if !line_a.closed || line_b.closed {
        let spot = a.spot(line_a.edges[0], -1.0);
        found.extend(facing(b, line_b, spot, 1.0, merge).map(|place| [first, place]));
    }
    if !line_b.closed {
        let spot = b.spot(line_b.edges[0], -1.0);
        let place = facing(a, line_a, spot, -1.0, merge);
        found.extend(place.map(|place| [place, first]).filter(|pair| !found.contains(pair)));
    }
    found
}

/// The place of a line that faces a spot of the other side, the nearest if there are several. `sign` is 1 if the line
/// lies on B, −1 if on A.
fn facing(face: Face, line: &SmoothLine, spot: TangentPoint, sign: f64, merge: f64) -> Option<LinePoint> {
    let n = line.edges.len();
    let node = |i: usize| {
        if i < n { face.spot(line.edges[i], -1.0) } else { face.spot(line.edges[n - 1], 1.0) }
    };
    let beyond = |at: TangentPoint| if sign > 0.0 { ahead(spot, at) } else { -ahead(at, spot) };
    let mut best: Option<(f64, LinePoint)> = None;
    let mut start = node(0);
    let mut f_start = beyond(start);
    for i in 0..n {
        let end = node(i + 1);
        let f_end = beyond(end);
        // strictly before the end, so that there is a part ahead
        if f_start <= merge && f_end > merge && dot(start.t, spot.t) > 0.0 && dot(end.t, spot.t) > 0.0 {
            let e = line.edges[i];
            let xi = if f_start >= -merge {
                -1.0
            } else {
                root(|xi| beyond(face.spot(e, xi)), -1.0, f_start, f_end, FINE * merge)
            };
            let x = face.chain.point(e, xi);
            let distance = minus(x, spot.x)[0].hypot(minus(x, spot.x)[1]);
            if best.is_none_or(|(nearest, _)| distance < nearest) {
                best = Some((distance, LinePoint { i, xi }));
            }
        }
        (start, f_start) = (end, f_end);
    }
    best.map(|(_, place)| place)
}

/// Walks both lines from a pair of places to the first end, node by node. Arc lengths are left at zero.
pub(in crate::coupling) fn walk(
    a: Face,
    line_a: &SmoothLine,
    b: Face,
    line_b: &SmoothLine,
    from: [LinePoint; 2],
    merge: f64,
) -> Vec<Segment> {
    let (n_a, n_b) = (line_a.edges.len(), line_b.edges.len());
    let (mut at_a, mut at_b) = (from[0], from[1]);
    let (end_a, end_b) = (stop(line_a, from[0]), stop(line_b, from[1]));
    let mut segments = Vec::with_capacity(end_a + end_b - at_a.i - at_b.i);
    let edges = |a: LinePoint, b: LinePoint| (line_a.edges[a.i % n_a], line_b.edges[b.i % n_b]);
    let (first_a, first_b) = edges(at_a, at_b);
    let (mut node_a, mut node_b) = (a.spot(first_a, 1.0), b.spot(first_b, 1.0));
    while at_a.i < end_a && at_b.i < end_b {
        let (edge_a, edge_b) = edges(at_a, at_b);
        let f = ahead(node_a, node_b);
        let (mut xi_a, mut xi_b) = (1.0, 1.0);
        if f > merge {
            let beyond = |xi: f64| ahead(node_a, b.spot(edge_b, xi));
            xi_b = root(beyond, at_b.xi, beyond(at_b.xi), f, FINE * merge);
        } else if f < -merge {
            let beyond = |xi: f64| -ahead(a.spot(edge_a, xi), node_b);
            xi_a = root(beyond, at_a.xi, beyond(at_a.xi), -f, FINE * merge);
        }
        let segment =
            Segment { start: 0.0, end: 0.0, edge_a, edge_b, xi_a: [at_a.xi, xi_a], xi_b: [at_b.xi, xi_b] };
        segments.push(segment);
        for (at, xi) in [(&mut at_a, xi_a), (&mut at_b, xi_b)] {
            *at = if xi == 1.0 { LinePoint { i: at.i + 1, xi: -1.0 } } else { LinePoint { xi, ..*at } };
        }
        let (next_a, next_b) = edges(at_a, at_b);
        if xi_a == 1.0 {
            node_a = a.spot(next_a, 1.0);
        }
        if xi_b == 1.0 {
            node_b = b.spot(next_b, 1.0);
        }
    }
    segments
}

/// Number of the edge behind the last one to walk.
fn stop(line: &SmoothLine, from: LinePoint) -> usize {
    let n = line.edges.len();
    match (line.closed, from.xi > -1.0) {
        (false, _) => n,
        (true, false) => from.i + n,
        (true, true) => from.i + n + 1, // the other line ends first
    }
}

/// The root of an ascending function between `low` and 1, where it has the values `f_low` and `f_high` > 0, up to a value
/// of `small`: the
/// Illinois form of false position, exact at once where the function is linear.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut f_low: f64, mut f_high: f64, small: f64) -> f64 {
    let mut high = 1.0;
    if f_low >= 0.0 {
        return low;
    }
    let small = small.max(f64::EPSILON * (f_high - f_low));
    let mut last = 0;
    for _ in 0..60 {
        let xi = (low * f_high - high * f_low) / (f_high - f_low);
        let value = f(xi);
        if value.abs() <= small || high - low <= 2.0 * f64::EPSILON {
            return xi;
        }
        if value > 0.0 {
            (high, f_high) = (xi, value);
            if last == 1 {
                f_low *= 0.5;
            }
            last = 1;
        } else {
            (low, f_low) = (xi, value);
            if last == -1 {
                f_high *= 0.5;
            }
            last = -1;
        }
    }
    0.5 * (low + high)
}
