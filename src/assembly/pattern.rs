//! Pattern of the lower triangle of the stiffness, in compressed columns.
//!
//! Nodes that share an element are neighbours; every pair of neighbours is a block of components × components.

/// Pattern of a symmetric matrix: its lower triangle by columns, rows ascending.
#[derive(Debug, Clone)]
pub struct Pattern {
    components: usize,
    /// Start of every node's neighbours in `neighbours`.
    node_offsets: Vec<usize>,
    /// Neighbours not smaller than the node itself, ascending; the node comes first.
    neighbours: Vec<u32>,
    /// Start of every column, one more entry than columns.
    pub offsets: Vec<u32>,
    /// Row of every entry.
    pub rows: Vec<u32>,
}

impl Pattern {
    /// From elements as (first node, local nodes). `elements` is walked three times.
    pub fn new<'a, I>(components: usize, nodes: usize, elements: impl Fn() -> I) -> Pattern
    where
        I: Iterator<Item = (usize, &'a [usize])>,
    {
        // elements around every node
        let mut starts = vec![0usize; nodes + 1];
        let mut table: Vec<(usize, &[usize])> = Vec::new();
        for (first, members) in elements() {
            for &node in members {
                starts[first + node + 1] += 1;
            }
            table.push((first, members));
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut around = vec![0u32; starts[nodes]];
        let mut next = starts.clone();
        for (e, (first, members)) in table.iter().enumerate() {
            for &node in *members {
                around[next[first + node]] = e as u32;
                next[first + node] += 1;
            }
        }
        // neighbours of every node
        let mut node_offsets = Vec::with_capacity(nodes + 1);
        node_offsets.push(0);
        let mut neighbours: Vec<u32> = Vec::new();
        let mut seen = vec![u32::MAX; nodes];
        for node in 0..nodes {
            let start = neighbours.len();
            neighbours.push(node as u32);
            seen[node] = node as u32;
            for &e in &around[starts[node]..starts[node + 1]] {
                let (first, members) = table[e as usize];
                for &member in members {
                    let other = first + member;
                    if other > node && seen[other] != node as u32 {
                        seen[other] = node as u32;
                        neighbours.push(other as u32);
                    }
                }
            }
            neighbours[start..].sort_unstable();
            node_offsets.push(neighbours.len());
        }
        // columns of dofs
        let mut offsets = Vec::with_capacity(components * nodes + 1);
        offsets.push(0);
        let blocks = neighbours.len();
        let mut rows =
            Vec::with_capacity(components * components * blocks - nodes * components * (components - 1) / 2);
        for node in 0..nodes {
            let others = &neighbours[node_offsets[node]..node_offsets[node + 1]];
            for c in 0..components {
                let column = others.iter().flat_map(|&o| components as u32 * o..components as u32 * (o + 1));
                rows.extend(column.skip(c));
                offsets.push(rows.len() as u32);
            }
        }
        Pattern { components, node_offsets, neighbours, offsets, rows }
    }

    /// Number of columns.
    pub fn size(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.node_offsets.len() - 1
    }

    /// Columns per node.
    pub fn components(&self) -> usize {
        self.components
    }

    /// The node itself, then its neighbours of larger number, ascending.
    pub fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.node_offsets[node]..self.node_offsets[node + 1]]
    }

    /// Places of a column in `rows`.
    #[inline]
    pub fn column(&self, j: usize) -> std::ops::Range<usize> {
        self.offsets[j] as usize..self.offsets[j + 1] as usize
    }

    /// Places in the values of the block of nodes (i, j), i ≥ j: for every column component b, the place of row
    /// component 0 (on the diagonal block, only rows a ≥ b exist); 0 beyond the components.
    #[inline]
    pub fn block(&self, i: usize, j: usize) -> [usize; 3] {
        let others = self.neighbours(j);
        // the neighbour exists by construction of the pattern
        let index = others.binary_search(&(i as u32)).unwrap_or(0);
        let mut at = [0; 3];
        for (b, at) in at.iter_mut().enumerate().take(self.components) {
            *at = self.offsets[self.components * j + b] as usize + self.components * index - b;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_point_at_the_rows_they_name() {
        let elements: [(usize, &[usize]); 2] = [(0, &[0, 1, 2]), (1, &[1, 2])];
        let pattern = Pattern::new(2, 4, || elements.into_iter());
        for (i, j) in [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (3, 2), (3, 3)] {
            let at = pattern.block(i, j);
            for b in 0..2 {
                for a in if i == j { b } else { 0 }..2 {
                    assert_eq!(pattern.rows[at[b] + a] as usize, 2 * i + a, "block {i} {j}");
                    assert!(pattern.column(2 * j + b).contains(&(at[b] + a)));
                }
            }
        }
        assert_eq!(pattern.size(), 8);
    }
}
