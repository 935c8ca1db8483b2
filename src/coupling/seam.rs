//! Where a closed loop of C starts: at an A and a B node that lie closest together, on a tie at smaller x, then y, so
//! that neither labels nor the order in a file matter.

use super::Midplane;

/// Distances that differ by less are the same. Of the length of the loop.
const SAME: f64 = 1e-9;

/// Turns every closed piece so that it starts there.
pub(super) fn turn_closed(c: &mut Midplane) {
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

/// Number of the segment in its piece that the loop starts with.
fn start(c: &Midplane, range: std::ops::Range<usize>) -> usize {
    let segments = &c.segments[range.clone()];
    let n = segments.len();
    let length: f64 = segments.iter().map(|g| g.end - g.start).sum();
    let mut best: Option<(f64, [f64; 2], usize)> = None;
    for i in 0..n {
        let (segment, next) = (&segments[i], (i + 1) % n);
        // a node of both sides, or one of A and one of B at the ends of a segment
        let at_start = [segment.xi_a[0] == -1.0, segment.xi_b[0] == -1.0];
        let at_end = [segment.xi_a[1] == 1.0, segment.xi_b[1] == 1.0];
        let distance = if at_start == [true, true] || at_end == [true, true] {
            0.0
        } else if at_start != at_end {
            segment.end - segment.start
        } else {
            continue;
        };
        let ends =
            [(i, c.spot(range.start + i, -1.0).position), (next, c.spot(range.start + i, 1.0).position)];
        for (j, x) in ends {
            let both = if j == i { at_start } else { at_end };
            if distance == 0.0 && both != [true, true] {
                continue;
            }
            let better = best.is_none_or(|(d, y, _)| {
                let (closer, left) = (distance - d, x[0] - y[0]);
                closer < -SAME * length
                    || closer <= SAME * length
                        && (left < -SAME * length || left <= SAME * length && x[1] < y[1] - SAME * length)
            });
            if better {
                best = Some((distance, x, j));
            }
        }
    }
    best.map_or(0, |(_, _, first)| first)
}
