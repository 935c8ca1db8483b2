//! The order of elimination: geometric nested dissection of the nodes, then the postorder of the elimination tree.
//!
//! ```text
//!   ┌────────┬─┬────────┐    The nodes are cut in two along one direction. Those of one part that touch the other are
//!   │ first  │s│ second │    the separator s and come last; then each part again, down to small leaves. Of all cuts the
//!   └────────┴─┴────────┘    one with the least |s| / (|first| |second|) is taken: it runs along an interface where one is near.
//! ```
//!
//! Separators are taken from the graph of the matrix, so that any coordinates give a valid order and good ones a sparse
//! factor. The result does not depend on the number of threads: every half works on its own nodes only. Supernodes are
//! adjacent columns, so the nodes are renumbered at the end in postorder, which changes neither fill nor tree.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::graph::{Graph, NONE, elimination_tree, inverse, postorder};
use crate::assembly::Pattern;

/// Sets of at most this many nodes are ordered by minimum degree: half the bits of the mask of neighbours.
const LEAF: usize = 64;
/// Larger sets are cut side by side.
const PARALLEL: usize = 4096;
/// A separator whose square is at most this many times its set is as small as those of squares: no other is sought.
const COMPACT: usize = 2;
/// Either side of a cut has at least this part of the nodes: bounds the depth whatever the graph.
const LEAST: usize = 8;

/// A permutation of the dofs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Order {
    /// Old number of every new one.
    pub forward: Vec<u32>,
    /// New number of every old one.
    pub inverse: Vec<u32>,
}

/// Orders the dofs of a pattern. `coordinates` are those of its nodes, one node after the other.
pub fn nested_dissection(pattern: &Pattern, coordinates: &[f64]) -> Order {
    let order = dissected(&Graph::new(pattern), coordinates, &vec![1; pattern.nodes()]);
    let components = pattern.components() as u32;
    let dofs = |node: u32| components * node..components * (node + 1);
    let forward: Vec<u32> = order.into_iter().flat_map(dofs).collect();
    let inverse = inverse(&forward);
    Order { forward, inverse }
}

/// Orders the nodes of a graph, every subtree of the elimination tree together. `coordinates`: one node after the other;
/// `weights`: unknowns of every node.
pub(super) fn dissected(graph: &Graph, coordinates: &[f64], weights: &[u32]) -> Vec<u32> {
    let n = graph.nodes();
    let dimensions = coordinates.len() / n.max(1);
    let ranks: Vec<Vec<u32>> = (0..dimensions)
        .into_par_iter()
        .map(|d| {
            let x = |node: u32| coordinates[dimensions * node as usize + d];
            let mut sorted: Vec<u32> = (0..n as u32).collect();
            sorted.sort_unstable_by(|&a, &b| x(a).total_cmp(&x(b)).then(a.cmp(&b)));
            inverse(&sorted)
        })
        .collect();
    let mut order: Vec<u32> = (0..n as u32).collect();
    let place = (0..n).map(|_| AtomicU32::new(0)).collect();
    Dissection { graph, ranks: &ranks, weights, place }.cut(&mut order, 0);
    let post = postorder(&elimination_tree(graph, &order));
    post.iter().map(|&new| order[new as usize]).collect()
}

struct Dissection<'a> {
    graph: &'a Graph,
    /// Place of every node in the whole model sorted along each direction.
    ranks: &'a [Vec<u32>],
    weights: &'a [u32],
    /// Place of every node in the set at hand, `NONE` in a separator. Read and written by whoever cuts that set.
    place: Vec<AtomicU32>,
}

/// A cut of a sorted set: the nodes before `at`, the others, and which of them touch the other part.
#[derive(Clone, Copy)]
struct Bisection {
    /// Unknowns of the separator.
    size: usize,
    /// Unknowns of the separator over the product of those of both parts.
    ratio: f64,
    axis: usize,
    at: usize,
    /// The separator is the boundary of the part before.
    before: bool,
}

impl Dissection<'_> {
    /// Brings a set of nodes that only separators connect to others into the order of its elimination.
    fn cut(&self, nodes: &mut [u32], first_axis: usize) {
        if nodes.len() <= 1 || self.ranks.is_empty() || nodes.len() <= LEAF && self.minimum_degree(nodes) {
            return;
        }
        let mut sorted = first_axis;
        let all: usize = nodes.iter().map(|&node| self.weights[node as usize] as usize).sum();
        self.sort(nodes, sorted);
        let mut cut = self.best(nodes, sorted);
        for axis in (0..self.ranks.len()).filter(|&axis| axis != first_axis) {
            if cut.size * cut.size <= COMPACT * all {
                break;
            }
            self.sort(nodes, axis);
            sorted = axis;
            let other = self.best(nodes, axis);
            if other.ratio < cut.ratio {
                cut = other;
            }
        }
        let Bisection { axis, at, before, .. } = cut;
        if sorted != axis {
            self.sort(nodes, axis);
        }
        // the separator goes last
        let (part, across) = if before { (0..at, at..nodes.len()) } else { (at..nodes.len(), 0..at) };
        let touches = |node: u32| self.places(node).any(|place| across.contains(&place));
        let (separator, inner): (Vec<u32>, Vec<u32>) =
            nodes[part.clone()].iter().partition(|&&node| touches(node));
        let first = if before { inner.len() } else { at };
        if before {
            nodes.copy_within(at.., inner.len());
            nodes[..inner.len()].copy_from_slice(&inner);
        } else {
            nodes[at..at + inner.len()].copy_from_slice(&inner);
        }
        let rest = nodes.len() - separator.len();
        nodes[rest..].copy_from_slice(&separator);
        separator.iter().for_each(|&node| self.place[node as usize].store(NONE, Relaxed));
        let (first, second) = nodes[..rest].split_at_mut(first);
        let next = (axis + 1) % self.ranks.len();
        if rest > PARALLEL {
            rayon::join(|| self.cut(first, next), || self.cut(second, next));
        } else {
            self.cut(first, next);
            self.cut(second, next);
        }
    }

    /// Orders a small set by exact minimum degree, its neighbours in separators counted; false if these are too many.
    fn minimum_degree(&self, nodes: &mut [u32]) -> bool {
        for (place, &node) in (0..).zip(nodes.iter()) {
            self.place[node as usize].store(place, Relaxed);
        }
        // bits below LEAF are the set's own nodes, those above its neighbours
        let mut around: Vec<u32> = Vec::with_capacity(LEAF);
        let mut adjacent = [0_u128; LEAF];
        for (i, &node) in nodes.iter().enumerate() {
            for &other in self.graph.of(node) {
                let mut bit = self.place[other as usize].load(Relaxed) as usize;
                if bit == NONE as usize {
                    let known = around.iter().position(|&known| known == other);
                    bit = LEAF + known.unwrap_or(around.len());
                    if known.is_none() {
                        if around.len() == LEAF {
                            return false;
                        }
                        around.push(other);
                    }
                }
                adjacent[i] |= 1 << bit;
            }
        }
        let mut left: Vec<usize> = (0..nodes.len()).collect();
        let mut order = Vec::with_capacity(nodes.len());
        while let Some(k) = (0..left.len()).min_by_key(|&k| adjacent[left[k]].count_ones()) {
            let i = left.remove(k);
            order.push(nodes[i]);
            let clique = adjacent[i];
            for &j in left.iter().filter(|&&j| clique & 1 << j != 0) {
                adjacent[j] = (adjacent[j] | clique) & !(1 << i | 1 << j);
            }
        }
        nodes.copy_from_slice(&order);
        true
    }

    /// Sorts a set along a direction and notes the place of every node.
    fn sort(&self, nodes: &mut [u32], axis: usize) {
        nodes.sort_unstable_by_key(|&node| self.ranks[axis][node as usize]);
        for (place, &node) in (0..).zip(nodes.iter()) {
            self.place[node as usize].store(place, Relaxed);
        }
    }

    /// Places of a node's neighbours in the set at hand.
    fn places(&self, node: u32) -> impl Iterator<Item = usize> {
        let places = self.graph.of(node).iter().map(|&other| self.place[other as usize].load(Relaxed));
        places.filter(|&place| place != NONE).map(|place| place as usize)
    }

    /// The cut of a sorted set with the least ratio.
    fn best(&self, nodes: &[u32], axis: usize) -> Bisection {
        // a node at place i with neighbours from `low` to `high` is in the boundary of the part before for the cuts at
        // i + 1 ..= high, of the part behind for those at low + 1 ..= i
        let mut changes = vec![[0_i32; 2]; nodes.len() + 1];
        for (i, &node) in nodes.iter().enumerate() {
            let (low, high) = self.places(node).fold((i, i), |(low, high), j| (low.min(j), high.max(j)));
            let weight = self.weights[node as usize] as i32;
            if high > i {
                changes[i + 1][0] += weight;
                changes[(high + 1).min(nodes.len())][0] -= weight;
            }
            if low < i {
                changes[low + 1][1] += weight;
                changes[i + 1][1] -= weight;
            }
        }
        let mut best = Bisection { size: 0, ratio: f64::INFINITY, axis, at: nodes.len() / 2, before: true };
        let mut sizes = [0_i32; 2];
        let least = nodes.len().div_ceil(LEAST);
        let weight = |node: &u32| f64::from(self.weights[*node as usize]);
        let (mut first, mut second) = (0.0, nodes.iter().map(weight).sum::<f64>());
        for at in 1..nodes.len() {
            first += weight(&nodes[at - 1]);
            second -= weight(&nodes[at - 1]);
            for k in 0..2 {
                sizes[k] += changes[at][k];
            }
            if at < least || at > nodes.len() - least {
                continue;
            }
            let size = sizes[0].min(sizes[1]) as usize;
            let ratio = (size as f64).max(0.5) / (first * second); // without separator the middle is best
            if ratio < best.ratio {
                best = Bisection { size, ratio, axis, at, before: sizes[0] < sizes[1] };
            }
        }
        best
    }
}
