//! Start of a closed loop of C: at an A and a B node that lie closest together, on a tie at smaller x, then y, so
//! that neither labels nor the order in a file matter.

use super::LineMidplane;

/// Distances that differ by less are the same. Of the length of the loop.
const SAME: f64 = 1e-9;

/// Turns every closed piece so that it starts there.
pub(in crate::coupling) fn turn_closed(c: &mut LineMidplane) {
    for piece in c.pieces.clone() {
        if piece.closed {
            let first = start(c, piece.segments.clone());
            let segments = &mut c.segments[piece.segments];
            let mut s = segments[0].start;
            segments.rotate_left(first);
            for segment in segments {
                let length = segment.end - segment.start;
                (segment.start, segment.end) = (s, s + length);
                s += length;
            }
        }
    }
}

/// Number of the segment in its piece that the loop starts with: of the two nodes the one with longer edges beside it.
fn start(c: &LineMidplane, range: std::ops::Range<usize>) -> usize {
    let segments = &c.segments[range.clone()];
    let n = segments.len();
    let length: f64 = segments.iter().map(|g| g.end - g.start).sum();
    // the start of segment i: its place; of which sides it is a node, its edges there
    let place = |i: usize| c.spot(range.start + i, -1.0).position;
    let node = |i: usize| {
        let (before, after) = (&segments[(i + n - 1) % n], &segments[i]);
        let of = [after.xi_a[0] == -1.0, after.xi_b[0] == -1.0];
        let a = if of[0] { c.a.chord(before.edge_a) + c.a.chord(after.edge_a) } else { 0.0 };
        let b = if of[1] { c.b.chord(before.edge_b) + c.b.chord(after.edge_b) } else { 0.0 };
        (of, a.max(b))
    };
    // smaller x, then y
    let first = |i: usize, j: usize| {
        let (x, y) = (place(i), place(j));
        let left = x[0] - y[0];
        left < -SAME * length || left <= SAME * length && x[1] < y[1] - SAME * length
    };
    let mut best: Option<(f64, usize)> = None;
    let (mut of, mut edges) = node(0);
    for i in 0..n {
        let next = (i + 1) % n;
        let (of_next, edges_next) = node(next);
        let candidate = if of == [true; 2] {
            Some((0.0, i))
        } else if of_next != [true; 2] && of != of_next {
            let (longer, distance) = (edges - edges_next, segments[i].end - segments[i].start);
            let here = longer > SAME * length || longer >= -SAME * length && first(i, next);
            Some((distance, if here { i } else { next }))
        } else {
            None
        };
        let better = |(d, i): &(f64, usize)| {
            best.is_none_or(|(least, j)| {
                *d < least - SAME * length || *d <= least + SAME * length && first(*i, j)
            })
        };
        best = candidate.filter(better).or(best);
        (of, edges) = (of_next, edges_next);
    }
    best.map_or(0, |(_, first)| first)
}
