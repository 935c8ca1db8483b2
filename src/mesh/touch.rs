//! Contacts of bodies: pairs of boundary edges that lie on each other, gathered into connected lines.
//!
//! ```text
//!   b   ●──────●────────●──●        two edges touch if they run against each other, share some length, and are as
//!   a   ●───●──────●───────●        close there as their sizes and the curvature of the boundary explain
//! ```
//!
//! All lengths are relative to the edges concerned. An R-tree finds the neighbours: O(n log n) for n boundary edges.

use std::collections::HashMap;

use rayon::prelude::*;
use rstar::{AABB, Envelope, RTree, RTreeObject};

use super::{Facet, Mesh};
use crate::error::Result;
use crate::shape::vector::{dot, in_plane, in_space, minus};

/// Touching edges may be this far apart, and more where the boundary turns. Of their length.
const NEAR: f64 = 1e-3;
/// Distance that a turn by one radian adds: two chords of a circle are up to 1/8 of their turn and length apart.
const BEND: f64 = 0.25;
/// A turn above this is a corner, not a bend [rad].
const CORNER: f64 = 0.9;
/// Touching edges run against each other: the cosine between them is below this.
const AGAINST: f64 = -0.5;
/// A shared length below this is a point. Of the shorter edge.
const POINT: f64 = 1e-10;
/// Nodes of both bodies closer than this end at one place. Of the shorter edge.
const TOGETHER: f64 = 1e-6;

/// A connected line along which two bodies touch.
#[derive(Debug, Clone)]
pub struct Touch {
    /// The two bodies.
    pub subdomains: [usize; 2],
    /// Their edges there, each once.
    pub edges: [Vec<Facet>; 2],
    /// The length that they share [length].
    pub length: f64,
    /// A place in its middle.
    pub middle: [f64; 3],
}

/// A boundary edge as a straight line.
#[derive(Debug, Clone, Copy)]
struct BoundaryLine {
    subdomain: usize,
    edge: Facet,
    ends: [[f64; 2]; 2],
    tangent: [f64; 2],
    length: f64,
    /// Largest distance of another body that still touches.
    reach: f64,
}

/// The length that two lines share, and where it starts and ends along the first.
struct SharedLength {
    lines: [usize; 2],
    part: Stretch,
}

/// The part of a line that another line shares.
struct Stretch {
    /// Nodes that end it.
    ends: EndNodes,
    /// Its corner with the smallest x and y.
    corner: [f64; 2],
    /// Its length.
    length: f64,
    /// Its middle.
    middle: [f64; 2],
}

/// At start and end of a shared length: the node of either body that ends it.
type EndNodes = [[Option<usize>; 2]; 2];

/// An end of a shared length, sorted so that what ends at one node stands together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct LengthEnd {
    subdomains: [usize; 2],
    side: usize,
    node: usize,
    shared: usize,
    /// The node of the other side that ends it as well.
    other: Option<usize>,
}

/// The lines along which bodies touch. `wanted` is asked with two bodies and an edge of each whether the first is to
/// be side A and the second side B. By pair of bodies; several lines of one pair by their corner with smallest x and y.
pub fn touching(
    meshes: &[&Mesh],
    wanted: &(dyn Fn([usize; 2], [&Facet; 2]) -> bool + Sync),
) -> Result<Vec<Touch>> {
    let different = |pair: [usize; 2], edges: [&Facet; 2]| pair[0] != pair[1] && wanted(pair, edges);
    let lines = within_reach(all_lines(meshes)?);
    let shared = shared(&lines, &|[a, b]| {
        different([lines[a].subdomain, lines[b].subdomain], [&lines[a].edge, &lines[b].edge])
    });
    Ok(gather(&lines, &shared))
}

/// The lines along which boundaries lie on each other, those of one body among them, wherever `wanted` says so of two
/// bodies, the first no later than the second, and an edge of each.
pub fn coinciding(
    meshes: &[&Mesh],
    wanted: &(dyn Fn([usize; 2], [&Facet; 2]) -> bool + Sync),
) -> Result<Vec<Touch>> {
    let lines = all_lines(meshes)?.concat(); // by body, so that the first of two is of the first body
    let shared = shared(&lines, &|[a, b]| {
        a < b && wanted([lines[a].subdomain, lines[b].subdomain], [&lines[a].edge, &lines[b].edge])
    });
    Ok(gather(&lines, &shared))
}

/// The boundaries of all bodies.
fn all_lines(meshes: &[&Mesh]) -> Result<Vec<Vec<BoundaryLine>>> {
    let lines: Vec<Result<Vec<BoundaryLine>>> =
        meshes.par_iter().enumerate().map(|(b, mesh)| lines(b, mesh)).collect();
    lines.into_iter().collect()
}

/// The lengths that pairs of lines share; `wanted` is asked with the numbers of both.
fn shared(lines: &[BoundaryLine], wanted: &(dyn Fn([usize; 2]) -> bool + Sync)) -> Vec<SharedLength> {
    let numbered = lines.iter().enumerate().map(|(i, line)| Numbered(i, line.surroundings()));
    let tree = RTree::bulk_load(numbered.collect());
    let of_line = |a: usize| {
        let near = tree.locate_in_envelope_intersecting(lines[a].surroundings()).map(|found| found.0);
        near.filter(|&b| b != a && wanted([a, b]))
            .filter_map(|b| lines[a].share(&lines[b]).map(|part| SharedLength { lines: [a, b], part }))
            .collect::<Vec<_>>()
    };
    (0..lines.len()).into_par_iter().flat_map_iter(of_line).collect()
}

/// A line with its number, as the tree keeps it.
struct Numbered(usize, AABB<[f64; 2]>);

impl RTreeObject for Numbered {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> AABB<[f64; 2]> {
        self.1
    }
}

/// The lines of all bodies that reach into the box around another body.
fn within_reach(subdomains: Vec<Vec<BoundaryLine>>) -> Vec<BoundaryLine> {
    let around = |lines: &Vec<BoundaryLine>| {
        let boxes = lines.iter().map(BoundaryLine::surroundings);
        boxes.fold(AABB::new_empty(), |all: AABB<[f64; 2]>, one| all.merged(&one))
    };
    let boxes: Vec<AABB<[f64; 2]>> = subdomains.iter().map(around).collect();
    let mut near = subdomains.concat();
    near.retain(|line| {
        let own = line.surroundings();
        (0..boxes.len()).any(|subdomain| subdomain != line.subdomain && boxes[subdomain].intersects(&own))
    });
    near
}

/// The boundary of a body, with the reach of every edge.
fn lines(subdomain: usize, mesh: &Mesh) -> Result<Vec<BoundaryLine>> {
    let mut lines: Vec<BoundaryLine> =
        mesh.boundary()?.into_iter().map(|edge| BoundaryLine::new(subdomain, mesh, edge)).collect();
    let mut starting: HashMap<usize, usize> = HashMap::new();
    for (i, line) in lines.iter().enumerate() {
        starting.insert(line.edge.nodes()[0], i);
    }
    for i in 0..lines.len() {
        let Some(&next) = starting.get(&lines[i].edge.nodes()[1]) else { continue };
        let (t, u) = (lines[i].tangent, lines[next].tangent);
        let turn = (t[0] * u[1] - t[1] * u[0]).atan2(dot(t, u)).abs();
        if turn < CORNER {
            for line in [i, next] {
                let length = lines[line].length;
                lines[line].reach = lines[line].reach.max((NEAR + BEND * turn) * length);
            }
        }
    }
    Ok(lines)
}

impl BoundaryLine {
    fn new(subdomain: usize, mesh: &Mesh, edge: Facet) -> BoundaryLine {
        let ends = [0, 1].map(|i| in_plane(mesh.points[edge.nodes()[i]]));
        let along = minus(ends[1], ends[0]);
        let length = along[0].hypot(along[1]);
        BoundaryLine {
            subdomain,
            edge,
            ends,
            tangent: along.map(|x| x / length),
            length,
            reach: NEAR * length,
        }
    }

    /// The box around it that its reach fills.
    fn surroundings(&self) -> AABB<[f64; 2]> {
        let [p, q] = self.ends;
        let low = [0, 1].map(|d| p[d].min(q[d]) - self.reach);
        AABB::from_corners(low, [0, 1].map(|d| p[d].max(q[d]) + self.reach))
    }

    /// The part that another line shares.
    fn share(&self, other: &BoundaryLine) -> Option<Stretch> {
        if dot(self.tangent, other.tangent) > AGAINST {
            return None;
        }
        // along this line the other one runs backwards: its end comes first
        let relative = [1, 0].map(|i| minus(other.ends[i], self.ends[0]));
        let s = relative.map(|x| dot(x, self.tangent));
        let off = relative.map(|x| x[1] * self.tangent[0] - x[0] * self.tangent[1]);
        let (low, high) = (s[0].max(0.0), s[1].min(self.length));
        let size = self.ends.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let shorter = self.length.min(other.length);
        if high - low <= POINT * shorter + 8.0 * f64::EPSILON * size {
            return None;
        }
        let gap = |at: f64| (off[0] + (off[1] - off[0]) * (at - s[0]) / (s[1] - s[0])).abs();
        if gap(low).max(gap(high)) > self.reach.max(other.reach) {
            return None;
        }
        let together = TOGETHER * shorter + 16.0 * f64::EPSILON * size;
        let node = |at: f64, own: f64, line: &BoundaryLine, i: usize| {
            ((at - own).abs() <= together).then_some(line.edge.nodes()[i])
        };
        let ends = [
            [node(low, 0.0, self, 0), node(low, s[0], other, 1)],
            [node(high, self.length, self, 1), node(high, s[1], other, 0)],
        ];
        let place = |at: f64| [0, 1].map(|d| self.ends[0][d] + at * self.tangent[d]);
        let (p, q) = (place(low), place(high));
        Some(Stretch {
            ends,
            corner: [p[0].min(q[0]), p[1].min(q[1])],
            length: high - low,
            middle: [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])],
        })
    }
}

/// Connects shared lengths that follow each other on both bodies, and sorts what comes out.
fn gather(lines: &[BoundaryLine], shared: &[SharedLength]) -> Vec<Touch> {
    let pair = |i: usize| shared[i].lines.map(|line| lines[line].subdomain);
    // every end under the node of either side that ends it: whatever follows ends there as well
    let mut ends: Vec<LengthEnd> = Vec::new();
    for i in 0..shared.len() {
        for end in shared[i].part.ends {
            for side in 0..2 {
                if let Some(node) = end[side] {
                    ends.push(LengthEnd { subdomains: pair(i), side, node, shared: i, other: end[1 - side] });
                }
            }
        }
    }
    ends.sort_unstable();
    let mut root: Vec<usize> = (0..shared.len()).collect();
    for run in ends.chunk_by(|p, q| (p.subdomains, p.side, p.node) == (q.subdomains, q.side, q.node)) {
        for (k, one) in run.iter().enumerate() {
            for two in &run[k + 1..] {
                let across = |end: &LengthEnd| shared[end.shared].lines[1 - end.side];
                if across(one) == across(two) || one.other.is_some() && one.other == two.other {
                    let (p, q) = (find(&mut root, one.shared), find(&mut root, two.shared));
                    root[p.max(q)] = p.min(q);
                }
            }
        }
    }
    let mut pieces: HashMap<usize, Vec<usize>> = HashMap::new();
    for i in 0..shared.len() {
        pieces.entry(find(&mut root, i)).or_default().push(i);
    }
    let mut found: Vec<([usize; 2], [f64; 2], Vec<usize>)> = pieces
        .into_values()
        .map(|piece| {
            let corners = piece.iter().map(|&i| shared[i].part.corner);
            let low = corners.fold([f64::INFINITY; 2], |low, p| [low[0].min(p[0]), low[1].min(p[1])]);
            (pair(piece[0]), low, piece)
        })
        .collect();
    let size = extent(lines);
    let rounded = |x: [f64; 2]| x.map(|x| (x / (TOGETHER * size)).round() as i64); // the order of equal places is no accident
    found.sort_by_key(|(pair, low, piece)| (*pair, rounded(*low), piece[0]));
    let touch = |(subdomains, _, piece): ([usize; 2], [f64; 2], Vec<usize>)| {
        let edges = [0, 1].map(|side| {
            let mut of_side: Vec<usize> = piece.iter().map(|&i| shared[i].lines[side]).collect();
            of_side.sort_unstable();
            of_side.dedup();
            of_side.into_iter().map(|line| lines[line].edge).collect()
        });
        let (length, middle) = middle(piece.iter().map(|&i| &shared[i].part));
        Touch { subdomains, edges, length, middle: in_space(middle) }
    };
    found.into_iter().map(touch).collect()
}

/// The length of parts of a line, and their centre, or the middle of the part nearest to it if it is off the line.
fn middle<'a>(parts: impl Iterator<Item = &'a Stretch> + Clone) -> (f64, [f64; 2]) {
    let length: f64 = parts.clone().map(|part| part.length).sum();
    let centre = [0, 1].map(|d| parts.clone().map(|part| part.length * part.middle[d]).sum::<f64>() / length);
    let off = |part: &Stretch| (part.middle[0] - centre[0]).hypot(part.middle[1] - centre[1]);
    let nearest = parts.min_by(|one, two| off(one).total_cmp(&off(two)));
    match nearest.filter(|part| off(part) > 0.51 * part.length) {
        Some(part) => (length, part.middle),
        None => (length, centre),
    }
}

/// The larger side of the box around all lines.
fn extent(lines: &[BoundaryLine]) -> f64 {
    let range = |d: usize| {
        let values = lines.iter().flat_map(|line| line.ends).map(|p| p[d]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let (x, y) = (range(0), range(1));
    (x.1 - x.0).max(y.1 - y.0)
}

fn find(root: &mut [usize], mut i: usize) -> usize {
    while root[i] != i {
        root[i] = root[root[i]];
        i = root[i];
    }
    i
}
