//! The mid-plane's own grid: as fine as the locally coarser side, piece by piece.
//!
//! From the current node the next is max(next A node, next B node). Every cell takes in at least one further node of
//! each side, so there are at most min(edges A, edges B) cells. The walk starts where the first edges are longer, so
//! that neither labels nor file order matter; on a tie at the end with smaller x, then y.

use super::LineMidplane;
use super::Piece;
use crate::shape::vector::*;

/// "After" means farther than this. Of the length of the piece.
const AFTER: f64 = 1e-9;

/// A node of A, of B or of both, at its arc length.
#[derive(Debug, Clone, Copy)]
struct SideNode {
    s: f64,
    of: [bool; 2],
}

/// Arc lengths of the grid's nodes on a piece, ascending, from its start to its end.
pub(in crate::coupling) fn nodes(c: &LineMidplane, piece: &Piece) -> Vec<f64> {
    let segments = &c.segments[piece.segments.clone()];
    let [start, end] = c.span(piece);
    let length = end - start;
    // the ends of the common length count as nodes of both sides
    let mut cuts = vec![SideNode { s: start, of: [true; 2] }];
    cuts.extend(segments.iter().map(|g| SideNode { s: g.end, of: [g.xi_a[1] == 1.0, g.xi_b[1] == 1.0] }));
    let last = cuts.len() - 1;
    if piece.closed {
        replace_partner(&mut cuts, length);
    }
    cuts[last].of = [true; 2];
    if starts_at_the_far_end(c, piece, &cuts, length) {
        let mirrored: Vec<SideNode> =
            cuts.iter().rev().map(|cut| SideNode { s: end - cut.s, of: cut.of }).collect();
        walk(&mirrored, length).into_iter().rev().map(|i| cuts[last - i].s).collect()
    } else {
        let from_start: Vec<SideNode> =
            cuts.iter().map(|cut| SideNode { s: cut.s - start, of: cut.of }).collect();
        walk(&from_start, length).into_iter().map(|i| cuts[i].s).collect()
    }
}

/// A loop starts at a node of one side, which stands for the nearest node of the other side as well.
fn replace_partner(cuts: &mut [SideNode], length: f64) {
    let (start, last) = (cuts[0].s, cuts.len() - 1);
    for side in 0..2 {
        let node = |i: &usize| cuts[*i].of[side];
        if !cuts[last].of[side]
            && let (Some(next), Some(before)) = ((1..last).find(node), (1..last).rev().find(node))
        {
            let nearer = cuts[next].s - start <= start + length - cuts[before].s;
            cuts[if nearer { next } else { before }].of[side] = false;
        }
    }
}

/// Numbers of the cuts that become nodes of the grid; s counts from the first cut.
fn walk(cuts: &[SideNode], length: f64) -> Vec<usize> {
    let last = cuts.len() - 1;
    // the next node of a side behind a place; searched from where the last search ended
    let after = |side: usize, from: usize, s: f64| {
        let behind = |i: &usize| cuts[*i].of[side] && cuts[*i].s > s + AFTER * length;
        (from..last).find(behind).unwrap_or(last)
    };
    let mut nodes = vec![0];
    let (mut next, mut at) = ([0; 2], 0);
    while cuts[at].s < length * (1.0 - AFTER) {
        next = [0, 1].map(|side| after(side, next[side], cuts[at].s));
        at = next[0].max(next[1]);
        nodes.push(at);
    }
    nodes.pop();
    nodes.push(last);
    // a short last cell joins its neighbour, unless it is a whole edge of both sides
    if let [.., before, start, end] = nodes[..] {
        let [s_before, s_start, s_end] = [before, start, end].map(|i| cuts[i].s);
        let before_last = |side: usize| (0..last).rev().find(|&i| cuts[i].of[side]).unwrap_or(0);
        let is_edge = |side: usize| (cuts[before_last(side)].s - s_start).abs() <= AFTER * length;
        if s_end - s_start < 0.5 * (s_start - s_before) && !(is_edge(0) && is_edge(1)) {
            nodes.remove(nodes.len() - 2);
        }
    }
    nodes
}

/// True if the walk starts at the end of the piece: compares the edges from both ends inwards, the larger of A and B
/// first.
fn starts_at_the_far_end(c: &LineMidplane, piece: &Piece, cuts: &[SideNode], length: f64) -> bool {
    let places = |side: usize| -> Vec<f64> {
        // cuts that are one node to the walk are one here
        let mut s: Vec<f64> = cuts.iter().filter(|cut| cut.of[side]).map(|cut| cut.s).collect();
        s.dedup_by(|later, earlier| *later - *earlier <= AFTER * length);
        s
    };
    let sides = [places(0), places(1)];
    let edge = |s: &[f64], i: usize, far: bool| {
        let n = s.len() - 1;
        if i >= n {
            0.0
        } else if far {
            s[n - i] - s[n - i - 1]
        } else {
            s[i + 1] - s[i]
        }
    };
    for i in 0..sides[0].len().max(sides[1].len()) {
        let [near, far] = [false, true].map(|far| edge(&sides[0], i, far).max(edge(&sides[1], i, far)));
        if (near - far).abs() > AFTER * length {
            return far > near;
        }
    }
    // a closed piece starts and ends at one point: compare the next ones
    let segments = &piece.segments;
    let [near, far] = if piece.closed {
        [c.spot(segments.start, 1.0).position, c.spot(segments.end - 1, -1.0).position]
    } else {
        [c.spot(segments.start, -1.0).position, c.spot(segments.end - 1, 1.0).position]
    };
    let [dx, dy] = minus(far, near);
    if dx.abs() > AFTER * length { dx < 0.0 } else { dy < 0.0 }
}
