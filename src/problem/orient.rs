//! Sides of interfaces whose names do not decide which is A: bodies in a row or a ring follow each other, others go up or to the
//! right. Bodies around a common point, such as the blocks of a crossing, are no ring.
//!
//! ```text
//! ring   ╭─1─2─╮    counter-clockwise        row   1│2│3  along its chord     else   ▭▭▭   A below, or on the left, by
//!        ╰─4─3─╯                                                                    ▭ ▭    the outward normal of A
//! ```

use std::collections::{BTreeMap, BTreeSet};

use crate::shape::vector::{cross, minus, norm};

/// Two bodies that touch, and the area vector of the first body's boundary there, outwards.
pub(super) struct Pair {
    pub(super) bodies: [usize; 2],
    pub(super) outward: [f64; 3],
    /// The places where they cease to touch.
    pub(super) ends: Vec<[f64; 3]>,
}

/// Components of a direction that are equal but for rounding.
const EQUAL: f64 = 1e-9;
/// Ends of two pairs that are so near are one place, of the length of the first.
const NEAR: f64 = 1e-3;

/// For every pair, whether its second body is side A.
pub(super) fn turned(pairs: &[Pair], centre: &dyn Fn(usize) -> [f64; 3]) -> Vec<bool> {
    let mut beside: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for &Pair { bodies: [a, b], .. } in pairs {
        beside.entry(a).or_default().insert(b);
        beside.entry(b).or_default().insert(a);
    }
    let mut place: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for &body in beside.keys() {
        if seen.contains(&body) {
            continue;
        }
        let all = connected(&beside, body);
        seen.extend(all.iter().copied());
        let own = || pairs.iter().filter(|pair| all.binary_search(&pair.bodies[0]).is_ok());
        if all.len() > 2 && all.iter().all(|body| beside[body].len() <= 2) && !meet(own) {
            let row = in_a_row(&beside, &all, centre);
            place.extend(row.iter().enumerate().map(|(k, &body)| (body, (k, row.len()))));
        }
    }
    let is_turned = |Pair { bodies: [a, b], outward, .. }: &Pair| match (place.get(a), place.get(b)) {
        (Some((a, of)), Some((b, _))) => (a + 1) % of != *b,
        _ => backwards(outward),
    };
    pairs.iter().map(is_turned).collect()
}

/// True if all of some pairs end at one place.
fn meet<'a, I: Iterator<Item = &'a Pair>>(pairs: impl Fn() -> I) -> bool {
    let Some(first) = pairs().next() else { return false };
    let near = NEAR * norm(first.outward);
    let ends_at =
        |place: &[f64; 3]| pairs().all(|pair| pair.ends.iter().any(|end| norm(minus(*end, *place)) <= near));
    first.ends.iter().any(ends_at)
}

/// The bodies that hang together with one, in ascending order.
fn connected(beside: &BTreeMap<usize, BTreeSet<usize>>, body: usize) -> Vec<usize> {
    let (mut found, mut next) = (BTreeSet::from([body]), vec![body]);
    while let Some(body) = next.pop() {
        next.extend(beside[&body].iter().filter(|&&other| found.insert(other)));
    }
    found.into_iter().collect()
}

/// Bodies with two neighbours at most, one after the other.
fn in_a_row(
    beside: &BTreeMap<usize, BTreeSet<usize>>,
    all: &[usize],
    centre: &dyn Fn(usize) -> [f64; 3],
) -> Vec<usize> {
    let end = all.iter().copied().find(|body| beside[body].len() == 1);
    let mut row = vec![end.unwrap_or(all[0])];
    while let Some(&next) = beside[&row[row.len() - 1]].iter().find(|body| !row.contains(body)) {
        row.push(next);
    }
    let from = |body: &usize| minus(centre(*body), centre(row[0]));
    let along = match end {
        Some(_) => from(&row[row.len() - 1]),
        None => row.windows(2).fold([0.0; 3], |sum, two| {
            let area = cross(from(&two[0]), from(&two[1]));
            [0, 1, 2].map(|d| sum[d] + area[d])
        }),
    };
    if backwards(&along) {
        row.reverse();
    }
    row
}

/// True for a direction against the axis that it is nearest to; of two equally near ones the later counts.
fn backwards(direction: &[f64; 3]) -> bool {
    let most = direction.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let nearest = direction.iter().rev().find(|x| x.abs() >= (1.0 - EQUAL) * most);
    nearest.is_some_and(|x| *x < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(pairs: &[([usize; 2], [f64; 3])], centres: &[[f64; 3]]) -> Vec<bool> {
        let pairs: Vec<Pair> =
            pairs.iter().map(|&(bodies, outward)| Pair { bodies, outward, ends: Vec::new() }).collect();
        turned(&pairs, &|body| centres[body])
    }

    /// Four blocks around a point: both parts of a line run the same way, which a ring would not do.
    #[test]
    fn blocks_of_a_crossing_are_no_ring() {
        let centres = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
        let pair = |bodies, outward: [f64; 3], end| Pair { bodies, outward, ends: vec![end, [0.0; 3]] };
        let (right, up) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
        let pairs = [
            pair([0, 1], right, [0.0, -2.0, 0.0]),
            pair([1, 2], up, [2.0, 0.0, 0.0]),
            pair([2, 3], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
            pair([0, 3], up, [-2.0, 0.0, 0.0]),
        ];
        assert_eq!(turned(&pairs, &|body| centres[body]), [false, false, true, false]);
        let apart = pairs.map(|pair| Pair { ends: vec![pair.ends[0]], ..pair });
        assert_eq!(turned(&apart, &|body| centres[body]), [false, false, false, true]);
    }

    #[test]
    fn a_ring_runs_counter_clockwise_whatever_the_order_of_its_bodies() {
        let around = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 6.0;
            [angle.cos(), angle.sin(), 0.0]
        };
        // body `order[k]` is the k-th around
        for order in [[0, 1, 2, 3, 4, 5], [5, 4, 3, 2, 1, 0], [3, 0, 5, 1, 4, 2]] {
            let mut centres = [[0.0; 3]; 6];
            (0..6).for_each(|k| centres[order[k]] = around(k));
            let pairs: Vec<_> = (0..6)
                .map(|k| [order[k], order[(k + 1) % 6]])
                .map(|[a, b]| ([a.min(b), a.max(b)], [0.0; 3]))
                .collect();
            let sides = run(&pairs, &centres);
            for k in 0..6 {
                let [a, b] = pairs[k].0;
                let first = if sides[k] { b } else { a };
                assert_eq!(first, order[k], "{order:?}");
            }
        }
    }

    #[test]
    fn a_row_runs_along_its_chord_and_a_wall_up_and_to_the_right() {
        let centres = [[2.0, 0.1, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(run(&[([0, 1], [0.0; 3]), ([1, 2], [0.0; 3])], &centres), [true, true]);
        let wall = [([0, 1], [-1.0, 0.0, 0.0]), ([1, 2], [-1.0, 0.1, 0.0]), ([1, 3], [0.3, 1.0, 0.0])];
        assert_eq!(run(&wall, &centres), [true, true, false]);
        let two = [([1, 3], [1e-17, -1.0, 0.0])];
        assert_eq!(run(&two, &centres), [true]);
        assert_eq!(run(&[([1, 3], [1.0, -1.0 + 1e-12, 0.0])], &centres), [true], "y before x at 45°");
    }
}
