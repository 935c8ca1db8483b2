//! From two sides to the pieces of C: which parts of them lie on each other, and what is refused.
//!
//! Every smooth line of A meets every smooth line of B: where one of them starts beside the other, both are walked to the
//! first end. A part whose sides are farther apart than polygons of one curve can be does not count as lying on each
//! other; a part that comes apart on its way is refused with its gap.

use super::Piece;
use super::angle::Angles;
use super::link::Orientation;
use super::pair::{Face, starts, walk};
use super::segment::{CommonStretch, FACING, LinePoint, Segment};
use super::{Chain, Gap, LineMidplane, Side, faults, regular, seam};
use crate::error::Result;
use crate::shape::vector::*;

/// Faces with a gap may lie this far apart. Of the shorter line.
const OPEN: f64 = 0.25;
/// A common part shorter than this is a touching point. Of the shorter line.
const POINT: f64 = 3e-7;
/// A common part shorter than this many times its gap is a corner seen from the side.
const CORNER: f64 = 4.0;
/// Sides face each other up to a right angle between their directions: the cosine of half of it.
const TURNED: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Nodes of A and B closer than this are one. Of the shorter line.
const SLIVER: f64 = 1e-13;
/// Nodes closer than this many units in the last place of their coordinates are one.
const ROUNDING: f64 = 4.0;

/// The mid-plane of two sides: orders their edges, finds what faces what, and cuts C. `name` is the interface's, for messages.
pub fn join(name: &str, side_a: &[Side], side_b: &[Side], gap: Gap) -> Result<LineMidplane> {
    let sides = [side_a, side_b];
    let edge = side_a.iter().find_map(|curve| Some(in_plane(curve.points[curve.edges.first()?.nodes()[0]])));
    let origin = edge.unwrap_or_default();
    let order = |side: &[Side], subdomain: Orientation| {
        let chain = Chain::order(name, side, subdomain, origin)?;
        let angles = Angles::new(&chain);
        Ok((chain, angles))
    };
    let (a, b) = rayon::join(|| order(side_a, Orientation::Right), || order(side_b, Orientation::Left));
    let ((a, angles_a), (b, angles_b)): ((Chain, Angles), (Chain, Angles)) = (a?, b?);
    regular::check(name, sides, [&a, &b], origin)?;
    let angles = [angles_a, angles_b];
    let kink = angles[0].sharpest.max(angles[1].sharpest);
    let mut c = LineMidplane {
        a,
        b,
        origin,
        length: 0.0,
        gap: [f64::INFINITY, f64::NEG_INFINITY],
        apart: 0.0,
        joined: [0.0; 2],
        kink,
        segments: Vec::new(),
        pieces: Vec::new(),
        angles,
    };
    let (near, far): (Vec<CommonStretch>, Vec<CommonStretch>) =
        parts(&mut c, gap).into_iter().partition(|part| part.touches);
    if near.is_empty() {
        return Err(match far.iter().max_by(|p, q| p.length.total_cmp(&q.length)) {
            Some(part) => faults::apart(name, sides, part),
            None if bodies_on_one_side(&c) => faults::same_side(name, sides),
            None => faults::nothing_common(name, sides, &c),
        });
    }
    if let Some(part) = near.iter().find(|part| part.worst.0 > 0.0 || part.worst.0.is_nan()) {
        return Err(faults::apart(name, sides, part));
    }
    if let Some(place) = near.iter().find_map(|part| part.turned) {
        return Err(faults::turned(name, sides, place));
    }
    assemble(&mut c, near);
    seam::turn_closed(&mut c);
    for side in 0..2 {
        let share = cover(&c, side);
        if let Some(place) = share.iter().position(|share| *share > 1.0 + FACING) {
            return Err(faults::twice(name, sides, &c, side, place));
        }
        let lengths = |e: usize| if side == 0 { c.a.chord(e) } else { c.b.chord(e) };
        let whole: f64 = (0..share.len()).map(lengths).sum();
        c.joined[side] = share.iter().enumerate().map(|(e, share)| share * lengths(e)).sum::<f64>() / whole;
    }
    Ok(c)
}

/// True if the sides would have common parts if one of them were turned.
fn bodies_on_one_side(c: &LineMidplane) -> bool {
    let mut turned = c.clone();
    turned.b = turned.b.reversed();
    turned.angles[1] = Angles::new(&turned.b);
    parts(&mut turned, Gap::Open).iter().any(|part| part.length > part.gap[1].max(-part.gap[0]))
}

/// All common parts of all lines, whatever their gap.
fn parts(c: &mut LineMidplane, gap: Gap) -> Vec<CommonStretch> {
    let lines = [0, 1].map(|side| c.angles[side].lines.clone());
    let length = |chain: &Chain, edges: &[usize]| edges.iter().map(|&e| chain.chord(e)).sum::<f64>();
    let lengths_b: Vec<f64> = lines[1].iter().map(|line| length(&c.b, &line.edges)).collect();
    let largest = c.origin[0].abs().max(c.origin[1].abs());
    let mut found = Vec::new();
    for (l, line_a) in lines[0].iter().enumerate() {
        let length_a = length(&c.a, &line_a.edges);
        for (line_b, &length_b) in lines[1].iter().zip(&lengths_b) {
            let shorter = length_a.min(length_b);
            let merge = (SLIVER * shorter).max(ROUNDING * f64::EPSILON * largest);
            let a = Face { chain: &c.a, angles: &c.angles[0] };
            let b = Face { chain: &c.b, angles: &c.angles[1] };
            let walks: Vec<_> = starts(a, line_a, b, line_b, merge)
                .into_iter()
                .map(|from| (from[0], walk(a, line_a, b, line_b, from, merge)))
                .collect();
            for (place, segments) in walks {
                let closed = line_a.closed && line_b.closed;
                let part = measure(c, segments, (l, place), closed, gap, shorter, merge);
                let corner = CORNER * part.gap[1].max(-part.gap[0]);
                if part.length > POINT * shorter && (part.length > corner || !part.touches) {
                    found.push(part);
                }
            }
        }
    }
    found
}

/// Lengths and gaps of the segments of a part; drops those that are no longer than nodes that are one.
fn measure(
    c: &mut LineMidplane,
    segments: Vec<Segment>,
    order: (usize, LinePoint),
    closed: bool,
    gap: Gap,
    shorter: f64,
    merge: f64,
) -> CommonStretch {
    c.segments = segments;
    let mut part = CommonStretch {
        segments: Vec::with_capacity(c.segments.len()),
        order,
        closed,
        length: 0.0,
        gap: [f64::INFINITY, f64::NEG_INFINITY],
        apart: 0.0,
        worst: (f64::NEG_INFINITY, 0.0, [0.0; 2]),
        turned: None,
        touches: false,
    };
    for i in 0..c.segments.len() {
        let length = c.measure(i);
        let mut segment = c.segments[i];
        if length <= 0.5 * merge {
            continue;
        }
        (segment.start, segment.end) = (part.length, part.length + length);
        part.length = segment.end;
        let curved = c.angles[0].slack[segment.edge_a].max(c.angles[1].slack[segment.edge_b]);
        // where a segment ends the next one starts
        for &eta in if part.segments.is_empty() { &[-1.0, 1.0][..] } else { &[1.0] } {
            let spot = c.spot(i, eta);
            part.gap = [part.gap[0].min(spot.gap), part.gap[1].max(spot.gap)];
            let share = if gap == Gap::Open && spot.gap > 0.0 { OPEN } else { FACING };
            let beyond = spot.gap.abs() - share * shorter - curved;
            part.apart = part.apart.max(spot.gap.abs() - curved);
            part.touches |= beyond <= 0.0;
            if spot.facing.is_nan() || spot.facing < TURNED {
                part.turned = Some(spot.position);
            }
            if beyond > part.worst.0 || beyond.is_nan() {
                part.worst = (beyond, spot.gap, spot.position);
            }
        }
        part.segments.push(segment);
    }
    part
}

/// Puts the parts one after the other, in the order of chain A.
fn assemble(c: &mut LineMidplane, mut parts: Vec<CommonStretch>) {
    parts.sort_by(|p, q| {
        let key = |part: &CommonStretch| (part.order.0, part.order.1.i);
        key(p).cmp(&key(q)).then(p.order.1.xi.total_cmp(&q.order.1.xi))
    });
    c.segments.clear();
    for part in parts {
        let first = c.segments.len();
        for segment in part.segments {
            let (start, end) = (c.length + segment.start, c.length + segment.end);
            c.segments.push(Segment { start, end, ..segment });
        }
        c.gap = [c.gap[0].min(part.gap[0]), c.gap[1].max(part.gap[1])];
        c.apart = c.apart.max(part.apart);
        let segments = first..c.segments.len();
        let follows = first > 0 && {
            let (end, start) = (c.spot(first - 1, 1.0).position, c.spot(first, -1.0).position);
            norm(minus(start, end)) <= FACING * part.length
        };
        c.length += part.length;
        c.pieces.push(Piece { segments, closed: part.closed, follows });
    }
}

/// Joined share of every edge of a side: 0 to 1, more if it faces two curves at one place.
fn cover(c: &LineMidplane, side: usize) -> Vec<f64> {
    let mut cover = vec![0.0; if side == 0 { c.a.edges() } else { c.b.edges() }];
    for segment in &c.segments {
        let (e, xi) = if side == 0 { (segment.edge_a, segment.xi_a) } else { (segment.edge_b, segment.xi_b) };
        cover[e] += 0.5 * (xi[1] - xi[0]);
    }
    cover
}
