//! Components of grid nodes that carry nothing of their own: ends at which the sides leave less than the grid asks for.
//!
//! ```text
//!   ▐●──────●──────●──     end nodes held on both sides: two first edges of different length have two hats that no jump
//!   ▐●────●────●────●      of the grid can make equal; a stiff interface would press for it
//! ```
//!
//! The same holds where more than two bodies meet: the jumps around the point sum to zero. Such a component is no unknown. It
//! follows the two nearest nodes that are kept, linearly, so that a constant jump and the resultant of the traction stay exact.
//!
//! ```text
//! kept      ends held along C only, as at a plane of symmetry (zero there is nearer to the shear of the field, but tractions
//!           no longer sum to the forces); ends whose first edges match (the classical element) or are much shorter on one
//!           side; runs of held nodes; all nodes where fewer than two remain, and of a linear grid on quadratic sides
//! ```
//!
//! Supports of all steps count, so that the grid is one for the whole history.

use super::super::place::Slaved;
use super::super::{Support, Surroundings};
use super::cells::MidplaneGrid;
use super::segment::Segment;
use super::{Chain, LineMidplane};
use crate::shape::vector::dot;

/// C runs along an axis within this.
const ALONG: f64 = 1e-6;
/// Edges so many times shorter than those that face them can follow them.
const ROOM: f64 = 4.0;
/// A grid node lies on a node of a side within this, of ξ.
const ON_NODE: f64 = 1e-9;
const AXES: [[f64; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

/// A node of the grid on its way along a piece.
struct GridNode {
    node: usize,
    s: f64,
    /// Support that both sides have there, by direction.
    held: [Support; 2],
    /// More than two bodies meet there.
    junction: bool,
}

/// The slaved components of a grid.
pub(super) fn slaved(c: &LineMidplane, grid: &MidplaneGrid, around: Surroundings) -> Vec<Slaved> {
    let mut found = Vec::new();
    let roomy = !grid.is_quadratic() && c.a.is_quadratic() && c.b.is_quadratic();
    if around.is_empty() || roomy {
        return found;
    }
    for (p, piece) in c.pieces.iter().enumerate() {
        let mut segment = piece.segments.start;
        let mut grid_node = |(node, s): (usize, f64)| {
            while segment + 1 < piece.segments.end && c.segments[segment + 1].start <= s {
                segment += 1;
            }
            GridNode::new(c, p, segment, node, s, around)
        };
        let nodes: Vec<GridNode> = grid.along(p).into_iter().map(&mut grid_node).collect();
        if nodes.iter().all(|node| !node.junction && node.held == [Support::Free; 2]) {
            continue;
        }
        for (d, axis) in AXES.into_iter().enumerate() {
            let held = |i: usize| nodes.get(i).is_some_and(|node| node.held[d] != Support::Free);
            let alone = |i: usize| held(i) && !held(i + 1) && !(i > 0 && held(i - 1));
            let ends = |i: usize| i == 0 || i + 1 == nodes.len();
            // only the direction along C is held: the jump is known there
            let along = |i: usize| {
                let (segment, eta) = c.locate(piece, nodes[i].s);
                let [_, tangent] = c.spot(segment, eta).rotation;
                nodes[i].held[1 - d] == Support::Free && dot(tangent, axis).abs() >= 1.0 - ALONG
            };
            let follows = |i: usize| ends(i) && nodes[i].junction || alone(i) && !along(i);
            let slaves: Vec<usize> = (0..nodes.len()).filter(|&i| follows(i)).collect();
            if piece.closed || nodes.len() < slaves.len() + 2 {
                continue;
            }
            found.extend(slaves.iter().map(|&i| {
                let from = line_through(&nodes, &slaves, nodes[i].s);
                Slaved { node: nodes[i].node, component: d, from }
            }));
        }
    }
    found
}

/// Weights of the two nearest nodes that are kept: the line through them at s.
fn line_through(nodes: &[GridNode], slaves: &[usize], s: f64) -> Vec<(usize, f64)> {
    let mut kept: Vec<&GridNode> =
        nodes.iter().enumerate().filter(|(i, _)| !slaves.contains(i)).map(|(_, node)| node).collect();
    kept.sort_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()));
    let [a, b, ..] = kept[..] else { return Vec::new() };
    let share = (s - a.s) / (b.s - a.s);
    vec![(a.node, 1.0 - share), (b.node, share)]
}

impl GridNode {
    /// A node on a segment with what is around it; nothing where the edges next to it match or leave room.
    fn new(
        c: &LineMidplane,
        p: usize,
        segment: usize,
        node: usize,
        s: f64,
        around: Surroundings,
    ) -> GridNode {
        let g = &c.segments[segment];
        let near =
            |chain: &Chain, edge: usize| chain.edge(edge).any(|place| acts_at(around, chain.nodes[place]));
        if !near(&c.a, g.edge_a) && !near(&c.b, g.edge_b) {
            return GridNode { node, s, held: [Support::Free; 2], junction: false };
        }
        let spot = c.spot(segment, 2.0 * (s - g.start) / (g.end - g.start) - 1.0);
        let sides = [(&c.a, g.edge_a, spot.xi_a), (&c.b, g.edge_b, spot.xi_b)];
        let held = [0, 1].map(|d| {
            let [a, b] = sides.map(|(chain, edge, xi)| on_side(chain, edge, xi, d, around.supports));
            if a == b { a } else { Support::Free }
        });
        let meets = |place: usize, chain: &Chain| around.junctions.get(chain.nodes[place]) == Some(&true);
        let junction = sides.iter().any(|(chain, edge, xi)| {
            let [start, end] = chain.ends[*edge];
            on_node(*xi, -1.0) && meets(start, chain) || on_node(*xi, 1.0) && meets(end, chain)
        });
        if (junction || held != [Support::Free; 2]) && fits(c, p, segment, s) {
            return GridNode { node, s, held: [Support::Free; 2], junction: false };
        }
        GridNode { node, s, held, junction }
    }
}

/// True if a node is held in some direction or is a junction.
fn acts_at(around: Surroundings, node: usize) -> bool {
    let held = |dof: usize| around.supports.get(dof).is_some_and(|support| *support != Support::Free);
    around.junctions.get(node) == Some(&true) || held(2 * node) || held(2 * node + 1)
}

fn on_node(xi: f64, end: f64) -> bool {
    (xi - end).abs() <= ON_NODE
}

/// Support of a side at a place: that of the node there, or what all nodes of the edge have in common.
fn on_side(chain: &Chain, edge: usize, xi: f64, d: usize, supports: &[Support]) -> Support {
    let of = |place: usize| supports.get(2 * chain.nodes[place] + d).copied().unwrap_or_default();
    let [start, end] = chain.ends[edge].map(of);
    if on_node(xi, -1.0) {
        return start;
    }
    if on_node(xi, 1.0) {
        return end;
    }
    let free = chain.edge(edge).map(of).any(|support| support == Support::Free);
    if free { Support::Free } else { Support::Held }
}

/// True if the edges of both sides next to a place are the same, or those of one side so short that they can follow the other.
fn fits(c: &LineMidplane, p: usize, segment: usize, s: f64) -> bool {
    let whole = |xi: [f64; 2]| xi == [-1.0, 1.0];
    let piece = &c.pieces[p].segments;
    let range = segment.saturating_sub(1).max(piece.start)..(segment + 2).min(piece.end);
    let near = || c.segments[range.clone()].iter().filter(|g| g.start == s || g.end == s);
    let roomy = |g: &Segment| {
        let (a, b) = (c.a.chord(g.edge_a), c.b.chord(g.edge_b));
        a.max(b) >= ROOM * a.min(b)
    };
    near().next().is_some() && (near().all(|g| whole(g.xi_a) && whole(g.xi_b)) || near().all(roomy))
}
