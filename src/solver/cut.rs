//! Division of a matrix into parts: the top of its elimination tree is their separator, the subtrees below it are the parts.
//!
//! ```text
//!            ●         separator: roots of subtrees with more than LARGEST of all nodes
//!            ●
//!        ╱───┴───╲
//!       △         △    parts: unions of subtrees; no entry of the matrix or of its factor connects two subtrees
//! ```

use std::collections::BinaryHeap;

use super::Order;
use super::graph::{Graph, NONE, elimination_tree, postorder};
use crate::assembly::Pattern;

/// Number of parts. On two threads four take a quarter longer: their separator is more than twice as large.
const PARTS: usize = 2;
/// Subtrees are opened down to this part of all nodes.
const LARGEST: f64 = 0.6;
/// A separator of at most this many times the root of the dofs costs little beside the parts.
const BORDER: f64 = 2.0;

/// Nodes of every part and of the separator.
#[derive(Debug)]
pub struct Cut {
    pub(super) graph: Graph,
    components: usize,
    /// Nodes of every part in the order of elimination.
    pub(super) parts: Vec<Vec<u32>>,
    /// Nodes of the separator in the order of elimination.
    pub(super) separator: Vec<u32>,
}

impl Cut {
    /// Opens the elimination tree from its roots and deals the subtrees out, the largest first.
    pub fn new(pattern: &Pattern, order: &Order) -> Cut {
        let (graph, components) = (Graph::new(pattern), pattern.components());
        let order: Vec<u32> =
            order.forward.iter().step_by(components).map(|dof| dof / components as u32).collect();
        let n = order.len();
        let (mut size, mut child, mut sibling) = (vec![1_u32; n], vec![NONE; n], vec![NONE; n]);
        let mut subtrees = BinaryHeap::new();
        for (j, &parent) in elimination_tree(&graph, &order).iter().enumerate() {
            if parent == NONE {
                subtrees.push((size[j], j as u32));
            } else {
                size[parent as usize] += size[j];
                sibling[j] = std::mem::replace(&mut child[parent as usize], j as u32);
            }
        }
        let mut separator = Vec::new();
        while let Some((_, root)) =
            subtrees.peek().copied().filter(|(size, _)| f64::from(*size) > LARGEST * n as f64)
        {
            subtrees.pop();
            separator.push(root);
            let mut next = child[root as usize];
            while next != NONE {
                subtrees.push((size[next as usize], next));
                next = sibling[next as usize];
            }
        }
        separator.sort_unstable();
        let mut parts = vec![Vec::new(); PARTS];
        while let Some((size, root)) = subtrees.pop() {
            // a subtree in postorder ends with its root
            if let Some(part) = parts.iter_mut().min_by_key(|part| part.len()) {
                part.extend(root + 1 - size..=root);
            }
        }
        parts.iter_mut().for_each(|part| part.sort_unstable());
        let nodes = |places: Vec<u32>| places.into_iter().map(|place| order[place as usize]).collect();
        Cut { graph, components, parts: parts.into_iter().map(nodes).collect(), separator: nodes(separator) }
    }

    /// All nodes on interfaces as separator, the rest of the body as one part: what is left is its condensation on the interfaces.
    pub fn along_interfaces(pattern: &Pattern, order: &Order, joined: &[bool]) -> Cut {
        let (graph, components) = (Graph::new(pattern), pattern.components());
        let order = order.forward.iter().step_by(components).map(|dof| dof / components as u32);
        let (separator, mut nodes): (Vec<u32>, Vec<u32>) = order.partition(|&node| joined[node as usize]);
        let inner = nodes.len();
        nodes.extend(&separator);
        let mut parents = elimination_tree(&graph, &nodes);
        parents.truncate(inner);
        parents.iter_mut().filter(|parent| **parent as usize >= inner).for_each(|parent| *parent = NONE);
        let part: Vec<u32> = postorder(&parents).into_iter().map(|place| nodes[place as usize]).collect();
        let parts = if part.is_empty() { Vec::new() } else { vec![part] };
        Cut { graph, components, parts, separator }
    }

    /// True if the separator is small beside the parts, and no part is empty.
    pub fn pays(&self) -> bool {
        let c = self.components;
        let dofs = c * (self.separator.len() + self.parts.iter().map(Vec::len).sum::<usize>());
        let separator = (c * self.separator.len()) as f64;
        self.parts.iter().all(|part| !part.is_empty()) && separator <= BORDER * (dofs as f64).sqrt()
    }
}
