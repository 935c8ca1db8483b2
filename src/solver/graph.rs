//! The graph of a symmetric pattern, and the elimination tree of its nodes in a given order.

use crate::assembly::Pattern;

/// No node.
pub(super) const NONE: u32 = u32::MAX;

/// Neighbours of every node, without itself.
#[derive(Debug)]
pub(super) struct Graph {
    offsets: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Graph {
    /// From the upper neighbours that a pattern keeps.
    pub(super) fn new(pattern: &Pattern) -> Graph {
        let n = pattern.nodes();
        let mut offsets = vec![0; n + 1];
        for node in 0..n {
            let above = &pattern.neighbours(node)[1..];
            offsets[node + 1] += above.len();
            above.iter().for_each(|&other| offsets[other as usize + 1] += 1);
        }
        for node in 0..n {
            offsets[node + 1] += offsets[node];
        }
        let mut next = offsets.clone();
        let mut neighbours = vec![0; offsets[n]];
        let mut add = |from: usize, to: usize| {
            neighbours[next[from]] = to as u32;
            next[from] += 1;
        };
        for node in 0..n {
            for &other in &pattern.neighbours(node)[1..] {
                add(node, other as usize);
                add(other as usize, node);
            }
        }
        Graph { offsets, neighbours }
    }

    /// From groups of nodes that are all connected, and further pairs.
    pub(super) fn of_cliques<'a>(
        nodes: usize,
        cliques: impl Iterator<Item = &'a [u32]> + Clone,
        pairs: impl Iterator<Item = (u32, u32)> + Clone,
    ) -> Graph {
        let mut beside: Vec<Vec<u32>> = vec![Vec::new(); nodes];
        for clique in cliques {
            for &node in clique {
                beside[node as usize].extend(clique.iter().filter(|&&other| other != node));
            }
        }
        for (a, b) in pairs.filter(|(a, b)| a != b) {
            beside[a as usize].push(b);
            beside[b as usize].push(a);
        }
        let (mut offsets, mut neighbours) = (vec![0], Vec::new());
        for mut of in beside {
            of.sort_unstable();
            of.dedup();
            neighbours.extend(of);
            offsets.push(neighbours.len());
        }
        Graph { offsets, neighbours }
    }

    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Neighbours of a node.
    pub(super) fn of(&self, node: u32) -> &[u32] {
        &self.neighbours[self.offsets[node as usize]..self.offsets[node as usize + 1]]
    }
}

/// Parent of every column in the elimination tree of the graph in this order, `NONE` at roots (Liu 1986).
pub(super) fn elimination_tree(graph: &Graph, order: &[u32]) -> Vec<u32> {
    let position = inverse(order);
    let mut parents = vec![NONE; order.len()];
    let mut ancestors = parents.clone(); // shortcuts towards the root
    for (j, &node) in (0..).zip(order) {
        for &other in graph.of(node) {
            let mut i = position[other as usize];
            while i < j {
                let next = std::mem::replace(&mut ancestors[i as usize], j);
                if next == NONE {
                    parents[i as usize] = j;
                }
                i = next;
            }
        }
    }
    parents
}

/// The columns with every subtree together and before its root.
pub(super) fn postorder(parents: &[u32]) -> Vec<u32> {
    let n = parents.len();
    let (mut child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
    let mut root = NONE;
    for j in (0..n).rev() {
        let first = if parents[j] == NONE { &mut root } else { &mut child[parents[j] as usize] };
        sibling[j] = std::mem::replace(first, j as u32);
    }
    let (mut post, mut path) = (Vec::with_capacity(n), Vec::new());
    let mut next = root;
    while next != NONE {
        path.push(next);
        next = child[next as usize];
        while next == NONE {
            let Some(done) = path.pop() else { break };
            post.push(done);
            next = sibling[done as usize];
        }
    }
    post
}

/// The permutation back.
pub(super) fn inverse(order: &[u32]) -> Vec<u32> {
    let mut inverse = vec![0; order.len()];
    for (new, &old) in (0..).zip(order) {
        inverse[old as usize] = new;
    }
    inverse
}
