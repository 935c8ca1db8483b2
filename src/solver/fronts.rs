//! The plan of an unsymmetric multifrontal factorisation: which unknowns are eliminated together, and where what they leave goes.
//!
//! ```text
//!          ┌ pivots  ┐        A front is the dense matrix of unknowns that are eliminated together, its pivots, and of all that
//!          │  ┌──────┤ ←──    are left then and touch them, its border. What elimination leaves on the border is added to the
//!          └──┤border│        front of the parent, the tree's next, where these unknowns are pivots or border again.
//!             └──────┘
//! ```
//!
//! The matrix comes as dense elements (a body's block) and as single entries, each of which belongs to the front that eliminates
//! the first of its unknowns. Nodes are groups of unknowns that stay together; their order is that of nested dissection. A front
//! is merged with its parent where the zeros this brings cost less than a front of its own.

use super::graph::{Graph, NONE, elimination_tree, inverse};
use super::ordering::dissected;

/// Work of a front beside its elimination [multiplications and additions]: per entry that is moved, and for being one.
const MOVED: f64 = 50.0;
const FRONT: f64 = 4e4;

/// Work of a factorisation by fronts.
#[derive(Debug, Clone, Copy)]
pub struct FrontWork {
    /// Multiplications and additions.
    pub operations: f64,
    /// Numbers that all fronts hold.
    pub entries: usize,
    /// Number of unknowns.
    pub unknowns: usize,
}

/// A matrix of dense elements and single entries.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// Node of every unknown; `NONE`: with the node of its element that comes last.
    pub(super) node_of: Vec<u32>,
    /// Coordinates of every node, one after the other.
    pub(super) coordinates: Vec<f64>,
    /// Number of nodes.
    pub(super) nodes: usize,
    /// Unknowns of every element.
    pub(super) elements: Vec<Vec<u32>>,
    /// Row and column of every single entry.
    pub(super) entries: Vec<(u32, u32)>,
}

/// Adjacent rows of a matrix that are adjacent rows of a front too: the first in either, and how many they are.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct PlaceRun {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) length: usize,
}

/// One front.
#[derive(Debug, Default)]
pub(super) struct Front {
    /// Its unknowns, the pivots first.
    pub(super) rows: Vec<u32>,
    pub(super) pivots: usize,
    /// Fronts that leave something to this one, and the places of the unknowns of their borders.
    pub(super) children: Vec<(u32, Vec<PlaceRun>)>,
    /// Elements that it takes, and the places of their unknowns.
    pub(super) elements: Vec<(u32, Vec<PlaceRun>)>,
    /// Single entries that it takes: number, row and column.
    pub(super) entries: Vec<(u32, u32, u32)>,
}

/// All fronts, those below before those above.
#[derive(Debug, Default)]
pub(super) struct Fronts {
    pub(super) fronts: Vec<Front>,
    /// First front of every level; those of one level know nothing of each other.
    pub(super) levels: Vec<usize>,
}

/// A front of nodes while the tree is built.
#[derive(Debug, Default, Clone)]
struct Supernode {
    pivots: Vec<u32>,
    border: Vec<u32>,
    /// Numbers of unknowns.
    sizes: (f64, f64),
    children: Vec<u32>,
    level: usize,
}

/// Multiplications and additions of a front with so many pivots and rows in its border.
fn operations(pivots: f64, border: f64) -> f64 {
    pivots * (2.0 / 3.0 * pivots * pivots + 2.0 * border * (pivots + border))
}

/// The same with all that comes beside them.
fn work(pivots: f64, border: f64) -> f64 {
    operations(pivots, border) + MOVED * (pivots + border).powi(2) + FRONT
}

impl Fronts {
    /// Orders the nodes and groups them.
    pub(super) fn new(layout: &Layout) -> Fronts {
        let node_of = |unknown: &u32| layout.node_of[*unknown as usize];
        let cliques: Vec<Vec<u32>> = (layout.elements.iter())
            .map(|element| {
                let mut nodes: Vec<u32> = element.iter().map(node_of).filter(|node| *node != NONE).collect();
                nodes.sort_unstable();
                nodes.dedup();
                nodes
            })
            .collect();
        let pairs = layout.entries.iter().map(|(i, j)| (node_of(i), node_of(j)));
        let pairs = pairs.filter(|(a, b)| *a != NONE && *b != NONE);
        let graph = Graph::of_cliques(layout.nodes, cliques.iter().map(|clique| &clique[..]), pairs);
        let mut weights = vec![0; layout.nodes];
        let own = layout.node_of.iter().filter(|node| **node != NONE);
        own.for_each(|&node| weights[node as usize] += 1);
        let order = dissected(&graph, &layout.coordinates, &weights);
        let position = inverse(&order);
        // unknowns of every node, by its place in the order
        let mut unknowns: Vec<Vec<u32>> = vec![Vec::new(); layout.nodes];
        for (unknown, &node) in (0..).zip(&layout.node_of) {
            if node != NONE {
                unknowns[position[node as usize] as usize].push(unknown);
            }
        }
        for (element, clique) in layout.elements.iter().zip(&cliques) {
            let Some(last) = clique.iter().map(|&node| position[node as usize]).max() else { continue };
            let late = element.iter().filter(|&unknown| node_of(unknown) == NONE);
            unknowns[last as usize].extend(late);
        }
        let supernodes = merged(&graph, &order, &position, &unknowns);
        Fronts::placed(layout, &supernodes, &unknowns)
    }

    /// Sorts the fronts by level and places what they take.
    fn placed(layout: &Layout, supernodes: &[Supernode], unknowns: &[Vec<u32>]) -> Fronts {
        let mut by_level: Vec<u32> = (0..supernodes.len() as u32).collect();
        by_level.sort_by_key(|&supernode| supernodes[supernode as usize].level);
        let new = inverse(&by_level);
        let mut levels = vec![0];
        for (at, pair) in (1..).zip(by_level.windows(2)) {
            if supernodes[pair[0] as usize].level != supernodes[pair[1] as usize].level {
                levels.push(at);
            }
        }
        levels.push(by_level.len());
        let size = layout.node_of.len();
        let (mut front_of, mut place) = (vec![NONE; size], vec![NONE; size]);
        let mut fronts: Vec<Front> = Vec::with_capacity(supernodes.len());
        for &supernode in &by_level {
            let supernode = &supernodes[supernode as usize];
            let all = |nodes: &[u32]| -> Vec<u32> {
                nodes.iter().flat_map(|&node| &unknowns[node as usize]).copied().collect()
            };
            let mut rows = all(&supernode.pivots);
            let pivots = rows.len();
            rows.iter().for_each(|&unknown| front_of[unknown as usize] = fronts.len() as u32);
            rows.extend(all(&supernode.border));
            (0..).zip(&rows).for_each(|(at, &unknown)| place[unknown as usize] = at);
            let places = |rows: &[u32]| runs(rows.iter().map(|&unknown| place[unknown as usize] as usize));
            let children = supernode.children.iter().map(|&child| {
                let child = new[child as usize];
                let below = &fronts[child as usize];
                (child, places(&below.rows[below.pivots..]))
            });
            let children = children.collect();
            fronts.push(Front { rows, pivots, children, ..Front::default() });
        }
        // levels of a tree path ascend: the first front that eliminates one of some connected unknowns has the least number
        let mut of_elements: Vec<Vec<u32>> = vec![Vec::new(); fronts.len()];
        for (e, element) in (0..).zip(&layout.elements) {
            if let Some(first) = element.iter().map(|&unknown| front_of[unknown as usize]).min() {
                of_elements[first as usize].push(e);
            }
        }
        let mut of_entries: Vec<Vec<u32>> = vec![Vec::new(); fronts.len()];
        for (e, &(i, j)) in (0..).zip(&layout.entries) {
            of_entries[front_of[i as usize].min(front_of[j as usize]) as usize].push(e);
        }
        for ((front, elements), entries) in fronts.iter_mut().zip(of_elements).zip(of_entries) {
            (0..).zip(&front.rows).for_each(|(at, &unknown)| place[unknown as usize] = at);
            let places = |rows: &[u32]| runs(rows.iter().map(|&unknown| place[unknown as usize] as usize));
            front.elements =
                elements.into_iter().map(|e| (e, places(&layout.elements[e as usize]))).collect();
            let entry = |e: u32| {
                let (i, j) = layout.entries[e as usize];
                (e, place[i as usize], place[j as usize])
            };
            front.entries = entries.into_iter().map(entry).collect();
        }
        Fronts { fronts, levels }
    }

    /// Work of a factorisation.
    pub(super) fn work(&self) -> FrontWork {
        let of = |front: &Front| operations(front.pivots as f64, (front.rows.len() - front.pivots) as f64);
        FrontWork {
            operations: self.fronts.iter().map(of).sum(),
            entries: self.fronts.iter().map(|front| front.rows.len().pow(2)).sum(),
            unknowns: self.fronts.iter().map(|front| front.pivots).sum(),
        }
    }
}

/// Rows 0, 1, … of a matrix by their places in a front.
fn runs(places: impl Iterator<Item = usize>) -> Vec<PlaceRun> {
    let mut runs: Vec<PlaceRun> = Vec::new();
    for (from, to) in places.enumerate() {
        match runs.last_mut() {
            Some(run) if run.to + run.length == to => run.length += 1,
            _ => runs.push(PlaceRun { from, to, length: 1 }),
        }
    }
    runs
}

/// The fronts by nodes, numbered by their place in the order: the elimination tree with children merged into their parents where
/// that is less work.
fn merged(graph: &Graph, order: &[u32], position: &[u32], unknowns: &[Vec<u32>]) -> Vec<Supernode> {
    let parents = elimination_tree(graph, order);
    let size = |nodes: &[u32]| nodes.iter().map(|&node| unknowns[node as usize].len()).sum::<usize>() as f64;
    let mut supernodes: Vec<Supernode> = vec![Supernode::default(); order.len()];
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); order.len()];
    for (j, &node) in (0..).zip(order) {
        let above = graph.of(node).iter().map(|&other| position[other as usize]).filter(|&other| other > j);
        let mut border: Vec<u32> = above.collect();
        let mut below = std::mem::take(&mut children[j as usize]);
        for &child in &below {
            border.extend(supernodes[child as usize].border.iter().filter(|&&other| other > j));
        }
        border.sort_unstable();
        border.dedup();
        // those that bring the fewest zeros first
        below.sort_by_key(|&child| border.len() + 1 - supernodes[child as usize].border.len());
        let (mut pivots, mut own, rest) = (Vec::new(), size(&[j]), size(&border));
        let mut kept = Vec::new();
        for child in below {
            let (inner, outer) = supernodes[child as usize].sizes;
            if work(inner + own, rest) <= work(inner, outer) + work(own, rest) {
                own += inner;
                let supernode = std::mem::take(&mut supernodes[child as usize]);
                pivots.extend(supernode.pivots);
                kept.extend(supernode.children);
            } else {
                kept.push(child);
            }
        }
        pivots.push(j);
        let level = kept.iter().map(|&child| supernodes[child as usize].level + 1).max().unwrap_or(0);
        supernodes[j as usize] = Supernode { pivots, border, sizes: (own, rest), children: kept, level };
        if parents[j as usize] != NONE {
            children[parents[j as usize] as usize].push(j);
        }
    }
    compact(supernodes)
}

/// Without the places of those that were merged.
fn compact(supernodes: Vec<Supernode>) -> Vec<Supernode> {
    let mut new = vec![NONE; supernodes.len()];
    let there = (0..supernodes.len()).filter(|&at| !supernodes[at].pivots.is_empty());
    (0..).zip(there).for_each(|(count, at)| new[at] = count);
    let kept = supernodes.into_iter().filter(|supernode| !supernode.pivots.is_empty());
    kept.map(|mut supernode| {
        supernode.children.iter_mut().for_each(|child| *child = new[*child as usize]);
        supernode
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_follow_each_other_are_one_run() {
        let expected =
            [(0, 4, 2), (2, 7, 1), (3, 0, 3)].map(|(from, to, length)| PlaceRun { from, to, length });
        assert_eq!(runs([4, 5, 7, 0, 1, 2].into_iter()), expected);
        assert_eq!(runs(std::iter::empty()), []);
    }
}
