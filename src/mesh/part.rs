//! A part of a mesh as a mesh of its own: some of its cells, with their own copies of the nodes.
//!
//! ```text
//!   ┌─────┬─────┐        ┌─────┐ ┌─────┐     the nodes on a common curve are doubled, and the curve
//!   │  a  │  b  │   ▸    │  a  │ │  b  │     bounds each part, with that part's cell on its left
//!   └─────┴─────┘        └─────┘ └─────┘
//! ```

use super::edges::EdgeTable;
use super::{Cells, Facet, Group, Mesh};
use crate::error::{Error, Result};

/// Number of a point or cell that is not in the part.
const ABSENT: usize = usize::MAX;

impl Mesh {
    /// The part that consists of these cells. Of every group it has what belongs to them; a group of which nothing
    /// does is absent.
    pub fn part(&self, kept: &[usize]) -> Result<Mesh> {
        let mut point = vec![ABSENT; self.points.len()];
        let mut cell = vec![ABSENT; self.cells.len()];
        for (new, &old) in kept.iter().enumerate() {
            cell[old] = new;
            self.cells.nodes(old).iter().for_each(|&node| point[node] = 0);
        }
        let mut points = Vec::new();
        for (old, new) in point.iter_mut().enumerate().filter(|(_, new)| **new != ABSENT) {
            *new = points.len();
            points.push(self.points[old]);
        }
        let mut cells = Cells::default();
        for &old in kept {
            let nodes: Vec<usize> = self.cells.nodes(old).iter().map(|&node| point[node]).collect();
            cells.push(self.cells.shapes[old], &nodes);
        }
        let edges = table(self, &cells, points.len())?;
        let restrict = |group: &Group| restrict(group, &point, &cell, &cells, &edges);
        let groups = self.groups.iter().map(|(name, group)| (name.clone(), restrict(group)));
        let groups = groups.filter(|(_, group)| !group.is_empty()).collect();
        let corners = present(&self.corners, &point);
        Ok(Mesh { file: self.file.clone(), points, cells, corners, groups })
    }

    /// The edges that have a cell on one side only, each with its cell on the left.
    pub fn boundary(&self) -> Result<Vec<Facet>> {
        Ok(table(self, &self.cells, self.points.len())?.boundary(&self.cells))
    }
}

/// The edges of the cells; an intact mesh has no faults, but a file is no place to rely on that.
pub(super) fn table(mesh: &Mesh, cells: &Cells, points: usize) -> Result<EdgeTable> {
    let tags: Vec<u64> = (1..=cells.len() as u64).collect();
    EdgeTable::new(cells, points, &tags).map_err(|fault| Error::mesh(&mesh.file, fault.what, fault.help))
}

/// The members that are in the part, with their new numbers, ascending.
fn present(members: &[usize], number: &[usize]) -> Vec<usize> {
    let mut found: Vec<usize> = members.iter().map(|&old| number[old]).filter(|&new| new != ABSENT).collect();
    found.sort_unstable();
    found
}

/// The members of a group that are in the part.
fn restrict(group: &Group, point: &[usize], cell: &[usize], cells: &Cells, edges: &EdgeTable) -> Group {
    match group {
        Group::Points(all) => Group::Points(present(all, point)),
        Group::Cells(all) => Group::Cells(present(all, cell)),
        Group::Edges(all) => Group::Edges(all.iter().filter_map(|e| own(e, point, cells, edges)).collect()),
        Group::Namesakes(all) => {
            let parts = all.iter().map(|group| restrict(group, point, cell, cells, edges));
            let mut parts: Vec<Group> = parts.filter(|group| !group.is_empty()).collect();
            if parts.len() == 1 { parts.remove(0) } else { Group::Namesakes(parts) }
        }
        fault @ Group::Unusable { .. } => fault.clone(),
    }
}

/// An edge as the part has it: beside one of its own cells.
fn own(edge: &Facet, point: &[usize], cells: &Cells, edges: &EdgeTable) -> Option<Facet> {
    let [start, end] = [edge.nodes()[0], edge.nodes()[1]].map(|node| point[node]);
    if start == ABSENT || end == ABSENT { None } else { edges.find(cells, start, end) }
}
