//! A mesh opened along curves inside it: every node on them is doubled, once for each sector of cells around it, but at ends
//! inside the body, where the cells still hang together.
//!
//! ```text
//!   ┌────────┬────────┐        ┌────────┬────────┐
//!   │        │        │        │       ╱ ╲       │      tips stay one node, a crossing becomes four,
//!   │  ●━━━━━●━━━━━●  │   →    │  ●   ◯   ◯   ●  │      a curve that reaches the boundary opens it
//!   │        │        │        │       ╲ ╱       │
//!   └────────┴────────┘        └────────┴────────┘
//! ```

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::edges::{each_edge, facet};
use super::{Facet, Group, Mesh};

/// Coordinates that differ by less are the same to the order of nodes. Of the largest.
const TOGETHER: f64 = 1e-9;
/// Ends of an edge, ascending.
type EdgeEnds = [usize; 2];
/// New numbers by cell and node.
type Numbers = HashMap<(usize, usize), usize>;
/// Copies of doubled nodes.
type Copies = BTreeMap<usize, Vec<usize>>;

/// A branch of the curves along which a mesh was opened: from an end, a crossing, another curve or the boundary to the
/// next.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Number of its curve.
    pub curve: usize,
    /// Its faces, edge by edge from the end with smaller x, then y: that on the right of this way, then that on its left.
    pub faces: [Vec<Facet>; 2],
}

impl Mesh {
    /// Opens the mesh along curves inside it, none of whose edges lies on the boundary or in two of them. Groups keep their
    /// names: an opened curve holds both of its faces, a point on it every copy.
    pub fn open(&mut self, curves: &[Vec<Facet>]) -> Vec<Branch> {
        let mut owner: BTreeMap<EdgeEnds, usize> = BTreeMap::new();
        for (curve, edges) in curves.iter().enumerate() {
            owner.extend(edges.iter().map(|edge| (ends(edge.nodes()), curve)));
        }
        let cells = self.cells_beside(&owner);
        let ways = ways(&owner, &self.ends_outside(&owner), &self.points);
        let (numbers, copies) = self.split(&owner, &cells);
        let mut face_of: HashMap<(usize, EdgeEnds), (EdgeEnds, bool)> = HashMap::new();
        for (&edge, beside) in &cells {
            for &(cell, forward) in beside {
                let number = |node: usize| numbers.get(&(cell, node)).copied().unwrap_or(node);
                face_of.insert((cell, ends(&edge.map(number))), (edge, forward));
            }
        }
        let mut faces: BTreeMap<(EdgeEnds, bool), Facet> = BTreeMap::new();
        each_edge(&self.cells, |cell, nodes| {
            if let Some(face) = face_of.get(&(cell, ends(&nodes[..2]))) {
                faces.insert(*face, facet(nodes, cell, true));
            }
        });
        let renumbered = |edge: &Facet| -> Vec<Facet> {
            let key = ends(edge.nodes());
            match owner.contains_key(&key) {
                true => [true, false].iter().filter_map(|&side| faces.get(&(key, side)).copied()).collect(),
                false => {
                    let number = |node| numbers.get(&(edge.cell, node)).copied().unwrap_or(node);
                    vec![edge.renumbered(number)]
                }
            }
        };
        self.groups.values_mut().for_each(|group| reopen(group, &renumbered, &copies));
        let doubled = self.corners.iter().flat_map(|node| copies.get(node).into_iter().flatten());
        let doubled: Vec<usize> = doubled.copied().collect();
        self.corners.extend(doubled);
        self.corners.sort_unstable();
        let branch = |(curve, way): (usize, Vec<usize>)| {
            let faces = &faces;
            let face = |right: bool| {
                let key = move |step: &[usize]| (ends(step), (step[0] < step[1]) != right);
                way.windows(2).filter_map(move |step| faces.get(&key(step)).copied())
            };
            Branch { curve, faces: [face(true).collect(), face(false).collect()] }
        };
        ways.into_iter().map(branch).collect()
    }

    /// Nodes of the curves that lie on the boundary.
    fn ends_outside(&self, owner: &BTreeMap<EdgeEnds, usize>) -> BTreeSet<usize> {
        let on_curves: BTreeSet<usize> = owner.keys().flatten().copied().collect();
        let mut alone: BTreeSet<EdgeEnds> = BTreeSet::new();
        each_edge(&self.cells, |_, nodes| {
            let edge = ends(&nodes[..2]);
            if edge.iter().any(|node| on_curves.contains(node)) && !alone.remove(&edge) {
                alone.insert(edge);
            }
        });
        alone.into_iter().flatten().filter(|node| on_curves.contains(node)).collect()
    }

    /// Cells beside edges: whether each has the edge from its smaller to its larger node with itself on the left.
    fn cells_beside(&self, owner: &BTreeMap<EdgeEnds, usize>) -> BTreeMap<EdgeEnds, Vec<(usize, bool)>> {
        let mut cells: BTreeMap<EdgeEnds, Vec<(usize, bool)>> = BTreeMap::new();
        each_edge(&self.cells, |cell, nodes| {
            let edge = ends(&nodes[..2]);
            if owner.contains_key(&edge) {
                cells.entry(edge).or_default().push((cell, nodes[0] < nodes[1]));
            }
        });
        cells
    }

    /// Doubles nodes. Returns new numbers by cell and node, and the copies of every node that has some.
    fn split(
        &mut self,
        owner: &BTreeMap<EdgeEnds, usize>,
        beside: &BTreeMap<EdgeEnds, Vec<(usize, bool)>>,
    ) -> (Numbers, Copies) {
        // (cell, the other end of an edge of the cell there) around every node of the curves
        let mut around: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        around.extend(owner.keys().flatten().map(|&node| (node, Vec::new())));
        let mut inner: BTreeMap<usize, usize> = BTreeMap::new(); // inner nodes of edges and their second cell
        each_edge(&self.cells, |cell, nodes| {
            for (node, other) in [(nodes[0], nodes[1]), (nodes[1], nodes[0])] {
                if let Some(around) = around.get_mut(&node) {
                    around.push((cell, other));
                }
            }
            let second = beside.get(&ends(&nodes[..2])).and_then(|beside| beside.get(1));
            if nodes[2] != nodes[1] && second.is_some_and(|&(second, _)| second == cell) {
                inner.insert(nodes[2], cell);
            }
        });
        let (mut numbers, mut copies) = (Numbers::new(), Copies::new());
        for (&node, around) in &around {
            let mut sectors = sectors(node, around, owner);
            sectors.sort_unstable();
            for sector in &sectors[1..] {
                let copy = self.points.len();
                self.points.push(self.points[node]);
                copies.entry(node).or_default().push(copy);
                numbers.extend(sector.iter().map(|&cell| ((cell, node), copy)));
            }
        }
        for (node, cell) in inner {
            let copy = self.points.len();
            self.points.push(self.points[node]);
            copies.entry(node).or_default().push(copy);
            numbers.insert((cell, node), copy);
        }
        for cell in 0..self.cells.len() {
            let range = self.cells.offsets[cell]..self.cells.offsets[cell + 1];
            for node in &mut self.cells.nodes[range] {
                *node = numbers.get(&(cell, *node)).copied().unwrap_or(*node);
            }
        }
        (numbers, copies)
    }
}

/// Groups of cells around a node that share edges there which are not opened.
fn sectors(node: usize, around: &[(usize, usize)], owner: &BTreeMap<EdgeEnds, usize>) -> Vec<Vec<usize>> {
    let mut sectors: Vec<(Vec<usize>, Vec<usize>)> = Vec::new(); // cells, and ends of the edges by which they hang together
    for &(cell, other) in around {
        let shared = !owner.contains_key(&ends(&[node, other]));
        let meets = |(cells, others): &(Vec<usize>, Vec<usize>)| {
            cells.contains(&cell) || shared && others.contains(&other)
        };
        let (joined, mut apart): (Vec<_>, Vec<_>) = sectors.into_iter().partition(meets);
        let mut own = (vec![cell], if shared { vec![other] } else { Vec::new() });
        for (cells, others) in joined {
            own.0.extend(cells);
            own.1.extend(others);
        }
        own.0.sort_unstable();
        own.0.dedup();
        apart.push(own);
        sectors = apart;
    }
    sectors.into_iter().map(|(cells, _)| cells).collect()
}

/// Every branch as the nodes along it, with the number of its curve.
fn ways(
    owner: &BTreeMap<EdgeEnds, usize>,
    boundary: &BTreeSet<usize>,
    points: &[[f64; 3]],
) -> Vec<(usize, Vec<usize>)> {
    let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &[a, b] in owner.keys() {
        at.entry(a).or_default().push(b);
        at.entry(b).or_default().push(a);
    }
    // places equal but for rounding are ordered by their next coordinate, then by number
    let size = at.keys().flat_map(|&node| points[node]).fold(f64::MIN_POSITIVE, |size, x| size.max(x.abs()));
    let rounded = |node: usize| points[node].map(|x| (x / (TOGETHER * size)).round() as i64);
    let order = |a: &usize, b: &usize| rounded(*a).cmp(&rounded(*b)).then(a.cmp(b));
    let curve = |a: usize, b: usize| owner[&ends(&[a, b])];
    let same = |node: usize| matches!(at[&node][..], [a, b] if curve(node, a) == curve(node, b));
    let goes_on = |node: usize| same(node) && !boundary.contains(&node);
    let mut nodes: Vec<usize> = at.keys().copied().collect();
    nodes.sort_by(order);
    let mut used: BTreeSet<EdgeEnds> = BTreeSet::new();
    let mut found = Vec::new();
    // from ends, crossings, other curves and the boundary first, then loops
    let starts = nodes.iter().filter(|&&node| !goes_on(node)).chain(&nodes);
    for &start in starts {
        let mut next: Vec<usize> = at[&start].clone();
        next.sort_by(order);
        for second in next {
            let mut way = vec![start];
            let mut step = second;
            while used.insert(ends(&[way[way.len() - 1], step])) {
                way.push(step);
                let before = way[way.len() - 2];
                match at[&step].iter().find(|&&other| other != before) {
                    Some(&other) if goes_on(step) => step = other,
                    _ => break,
                }
            }
            if way.len() > 1 {
                found.push((curve(way[0], way[1]), way));
            }
        }
    }
    found.sort_by_key(|(curve, _)| *curve);
    found
}

/// The groups as they are after opening.
fn reopen(group: &mut Group, edges: &dyn Fn(&Facet) -> Vec<Facet>, copies: &Copies) {
    match group {
        Group::Points(points) => {
            let more: Vec<usize> =
                points.iter().filter_map(|node| copies.get(node)).flatten().copied().collect();
            points.extend(more);
            points.sort_unstable();
        }
        Group::Edges(all) => *all = all.iter().flat_map(edges).collect(),
        Group::Namesakes(groups) => groups.iter_mut().for_each(|group| reopen(group, edges, copies)),
        Group::Cells(_) | Group::Unusable { .. } => {}
    }
}

fn ends(nodes: &[usize]) -> EdgeEnds {
    [nodes[0].min(nodes[1]), nodes[0].max(nodes[1])]
}
