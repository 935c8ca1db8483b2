//! Shared lengths connected to lines of contact.

use std::collections::HashMap;

use super::line::{BoundaryLine, SharedLength, Stretch, TOGETHER};
use crate::mesh::Facet;
use crate::shape::vector::in_space;

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

/// Connects shared lengths that follow each other on both bodies, and sorts what comes out.
pub(super) fn gather(lines: &[BoundaryLine], shared: &[SharedLength]) -> Vec<Touch> {
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
