//! A part of a mesh as a mesh of its own: some of its cells, with their own copies of the nodes.
//!
//! ```text
//!   ┌─────┬─────┐        ┌─────┐ ┌─────┐     the nodes on a common curve are doubled, and the curve
//!   │  a  │  b  │   ▸    │  a  │ │  b  │     bounds each part, with that part's cell on its left
//!   └─────┴─────┘        └─────┘ └─────┘
//! ```

use std::collections::BTreeMap;

use indexmap::IndexMap;
use rayon::prelude::*;

use super::edges::EdgeTable;
use super::{Cells, Facet, Group, Mesh};
use crate::error::{Error, Result};

/// Parts that have a point or a cell: those of number i are `parts[rows[i]..rows[i + 1]]`, ascending.
struct Owners {
    rows: Vec<u32>,
    parts: Vec<u32>,
}

/// Members of a group in every part, by number of the part.
type Dealt = BTreeMap<u32, Group>;

impl Mesh {
    /// The part that consists of these cells. Of every group it has what belongs to them; a group of which nothing
    /// does is absent.
    pub fn part(&self, kept: &[usize]) -> Result<Mesh> {
        Ok(self.parts(&[kept])?.remove(0))
    }

    /// Several parts, in time that grows with the mesh and not with the mesh times their number.
    pub fn parts(&self, kept: &[&[usize]]) -> Result<Vec<Mesh>> {
        let cells = Owners::new(self.cells.len(), kept, |cell| std::slice::from_ref(cell));
        let points = Owners::new(self.points.len(), kept, |&cell| self.cells.nodes(cell));
        let mut groups: Vec<Vec<(&str, Group)>> = kept.iter().map(|_| Vec::new()).collect();
        for (name, group) in &self.groups {
            for (part, dealt) in deal(group, &points, &cells, kept.len()) {
                groups[part as usize].push((name, dealt));
            }
        }
        let mut corners: Vec<Vec<usize>> = vec![Vec::new(); kept.len()];
        for &corner in &self.corners {
            points.of(corner).iter().for_each(|&part| corners[part as usize].push(corner));
        }
        let parts = kept.par_iter().zip(groups).zip(corners);
        let made: Vec<Result<Mesh>> =
            parts.map(|((kept, groups), corners)| self.part_with(kept, groups, &corners)).collect();
        made.into_iter().collect()
    }

    /// A part, given what its groups may have of it.
    fn part_with(&self, kept: &[usize], groups: Vec<(&str, Group)>, corners: &[usize]) -> Result<Mesh> {
        let mut old: Vec<usize> = kept.iter().flat_map(|&cell| self.cells.nodes(cell)).copied().collect();
        old.sort_unstable();
        old.dedup();
        let point = |node: usize| old.binary_search(&node).ok();
        let mut cell: Vec<(usize, usize)> = kept.iter().copied().zip(0..).collect();
        cell.sort_unstable();
        let cell = |number: usize| Some(cell[cell.binary_search_by_key(&number, |pair| pair.0).ok()?].1);
        let mut cells = Cells::default();
        for &number in kept {
            let nodes: Vec<usize> = self.cells.nodes(number).iter().filter_map(|&node| point(node)).collect();
            cells.push(self.cells.shapes[number], &nodes);
        }
        let points: Vec<[f64; 3]> = old.iter().map(|&node| self.points[node]).collect();
        let edges = table(self, &cells, points.len())?;
        let restrict = |group: &Group| restrict(group, &point, &cell, &cells, &edges);
        let groups = groups.into_iter().map(|(name, group)| (name.to_string(), restrict(&group)));
        let groups: IndexMap<String, Group> = groups.filter(|(_, group)| !group.is_empty()).collect();
        let corners = present(corners, &point);
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

impl Owners {
    /// For `count` things, of which every cell of a part has some.
    fn new<'a>(count: usize, kept: &'a [&'a [usize]], of: impl Fn(&'a usize) -> &'a [usize]) -> Owners {
        let mut last = vec![u32::MAX; count];
        let mut rows = vec![0; count + 1];
        let mut each = |visit: &mut dyn FnMut(usize, u32)| {
            last.fill(u32::MAX);
            for (part, cells) in (0..).zip(kept) {
                for &thing in cells.iter().flat_map(&of) {
                    if std::mem::replace(&mut last[thing], part) != part {
                        visit(thing, part);
                    }
                }
            }
        };
        each(&mut |thing, _| rows[thing + 1] += 1);
        for i in 0..count {
            rows[i + 1] += rows[i];
        }
        let mut next: Vec<u32> = rows.clone();
        let mut parts = vec![0; rows[count] as usize];
        each(&mut |thing, part| {
            parts[next[thing] as usize] = part;
            next[thing] += 1;
        });
        Owners { rows, parts }
    }

    fn of(&self, thing: usize) -> &[u32] {
        &self.parts[self.rows[thing] as usize..self.rows[thing + 1] as usize]
    }
}

/// The members of a group dealt out to the parts that may have them; one with a fault goes to all.
fn deal(group: &Group, points: &Owners, cells: &Owners, count: usize) -> Dealt {
    let mut dealt = Dealt::new();
    match group {
        Group::Points(all) => {
            for &node in all {
                for &part in points.of(node) {
                    if let Group::Points(of) = dealt.entry(part).or_insert(Group::Points(Vec::new())) {
                        of.push(node);
                    }
                }
            }
        }
        Group::Cells(all) => {
            for &cell in all {
                for &part in cells.of(cell) {
                    if let Group::Cells(of) = dealt.entry(part).or_insert(Group::Cells(Vec::new())) {
                        of.push(cell);
                    }
                }
            }
        }
        Group::Edges(all) => {
            for edge in all {
                let there = |part: &&u32| edge.nodes().iter().all(|&node| points.of(node).contains(part));
                for &part in points.of(edge.nodes()[0]).iter().filter(there) {
                    if let Group::Edges(of) = dealt.entry(part).or_insert(Group::Edges(Vec::new())) {
                        of.push(*edge);
                    }
                }
            }
        }
        Group::Namesakes(all) => {
            for group in all {
                for (part, of) in deal(group, points, cells, count) {
                    if let Group::Namesakes(all) = dealt.entry(part).or_insert(Group::Namesakes(Vec::new())) {
                        all.push(of);
                    }
                }
            }
        }
        Group::Unusable { .. } => dealt.extend((0..count as u32).map(|part| (part, group.clone()))),
    }
    dealt
}

/// The members that are in the part, with their new numbers, ascending.
fn present(members: &[usize], number: &impl Fn(usize) -> Option<usize>) -> Vec<usize> {
    let mut found: Vec<usize> = members.iter().filter_map(|&old| number(old)).collect();
    found.sort_unstable();
    found
}

/// The members of a group that are in the part.
fn restrict(
    group: &Group,
    point: &impl Fn(usize) -> Option<usize>,
    cell: &impl Fn(usize) -> Option<usize>,
    cells: &Cells,
    edges: &EdgeTable,
) -> Group {
    match group {
        Group::Points(all) => Group::Points(present(all, point)),
        Group::Cells(all) => Group::Cells(present(all, cell)),
        Group::Edges(all) => {
            let own = |edge: &Facet| {
                let [start, end] = [edge.nodes()[0], edge.nodes()[1]].map(point);
                edges.find(cells, start?, end?) // as the part has it: beside one of its own cells
            };
            Group::Edges(all.iter().filter_map(own).collect())
        }
        Group::Namesakes(all) => {
            let parts = all.iter().map(|group| restrict(group, point, cell, cells, edges));
            let mut parts: Vec<Group> = parts.filter(|group| !group.is_empty()).collect();
            if parts.len() == 1 { parts.remove(0) } else { Group::Namesakes(parts) }
        }
        fault @ Group::Unusable { .. } => fault.clone(),
    }
}
