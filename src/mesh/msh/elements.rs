//! `$Elements`: which nodes make a point, an edge or a cell, block by block.
//!
//! ```text
//! blocks elements least most                counts, and the range of the tags
//! dimension entity type elements            of each block, followed by
//! tag node node ...                         its elements
//! ```

use super::content::{Content, EntityBlock, MeshFault, damaged};
use super::cursor::Cursor;
use super::element::ElementKind;
use super::entities::Entities;
use super::pieces::{Decoder, pieces};
use super::tags::Tags;
use crate::shape::LINE_NODES;

/// Reads the elements that belong to the mesh into `content`.
pub(super) fn read(
    cursor: &mut Cursor,
    decoder: &mut Decoder,
    entities: &Entities,
    numbers: &Tags,
    content: &mut Content,
) -> Result<(), MeshFault> {
    let cut = || damaged("$Elements ends early or holds something that is not a number");
    let (Some(blocks), Some(total), Some(least), Some(most)) =
        (cursor.size(), cursor.size(), cursor.size(), cursor.size())
    else {
        return Err(cut());
    };
    if !cursor.holds(total.saturating_mul(2)) {
        return Err(damaged(format!("claims {total} elements, more than the file can hold")));
    }
    let (mut held, mut tags) = (0, TagRuns::default());
    for _ in 0..blocks {
        let (Some(dim), Some(entity), Some(gmsh_type)) = (cursor.int(), cursor.int(), cursor.int()) else {
            return Err(cut());
        };
        let kind = ElementKind::of(gmsh_type)?;
        if kind.dim() != dim {
            return Err(damaged(format!(
                "has elements of gmsh type {gmsh_type} on an entity of dimension {dim}"
            )));
        }
        let groups = entities.groups(dim, entity)?;
        let count = cursor.size().ok_or_else(cut)?;
        if !cursor.holds(count.saturating_mul(1 + kind.nodes() as u64)) {
            return Err(damaged(format!("claims {count} elements in a block, more than the file can hold")));
        }
        held += count;
        let first = content.tags[dim as usize].len();
        content.reserve(kind, if groups.is_some() { count as usize } else { 0 });
        for size in pieces(count as usize) {
            let bytes = cursor.skip(size * (1 + kind.nodes())).ok_or_else(cut)?;
            for element in decoder.elements(size, gmsh_type, bytes).ok_or_else(cut)? {
                let tag = element.element_tag;
                if tag < least.max(1) || tag > most {
                    return Err(damaged(format!("has element {tag}, but claims tags {least} to {most}")));
                }
                tags.add(tag);
                if groups.is_some() {
                    content.add(kind, tag, &element.nodes, numbers)?;
                }
            }
        }
        if let Some(groups) = groups {
            let members = first..content.tags[dim as usize].len();
            content.blocks.push(EntityBlock { dim: dim as usize, members, groups: groups.to_vec() });
        }
    }
    if held != total {
        return Err(damaged(format!("claims {total} elements and holds {held}")));
    }
    tags.unique()
}

impl Content {
    fn reserve(&mut self, kind: ElementKind, count: usize) {
        self.tags[kind.dim() as usize].reserve(count);
        match kind {
            ElementKind::Point => self.vertices.reserve(count),
            ElementKind::Edge(_) => {
                self.edge_shapes.reserve(count);
                self.edges.reserve(count);
            }
            ElementKind::Cell(shape) => {
                self.shapes.reserve(count);
                self.cell_nodes.reserve(count * shape.nodes());
            }
        }
    }

    fn add(&mut self, kind: ElementKind, tag: u64, nodes: &[u64], numbers: &Tags) -> Result<(), MeshFault> {
        let number = |node: u64| {
            numbers
                .number(node)
                .ok_or_else(|| damaged(format!("element {tag} has node {node}, which does not exist")))
        };
        self.tags[kind.dim() as usize].push(tag);
        match (kind, nodes) {
            (ElementKind::Point, &[node]) => self.vertices.push(number(node)?),
            (ElementKind::Edge(shape), nodes) if nodes.len() == shape.nodes() => {
                let mut edge = [0; LINE_NODES];
                for (place, &node) in edge.iter_mut().zip(nodes) {
                    *place = number(node)?;
                }
                self.edge_shapes.push(shape);
                self.edges.push(edge);
            }
            (ElementKind::Cell(shape), nodes) if nodes.len() == shape.nodes() => {
                self.shapes.push(shape);
                for &node in nodes {
                    self.cell_nodes.push(number(node)?);
                }
            }
            _ => return Err(damaged(format!("element {tag} has {} nodes", nodes.len()))),
        }
        Ok(())
    }
}

/// Element tags as runs of consecutive numbers: one run for what gmsh writes.
#[derive(Default)]
struct TagRuns {
    /// First and last tag of every run.
    runs: Vec<[u64; 2]>,
}

impl TagRuns {
    fn add(&mut self, tag: u64) {
        match self.runs.last_mut() {
            Some([_, last]) if last.checked_add(1) == Some(tag) => *last = tag,
            _ => self.runs.push([tag, tag]),
        }
    }

    fn unique(mut self) -> Result<(), MeshFault> {
        self.runs.sort_unstable();
        match self.runs.windows(2).find(|pair| pair[1][0] <= pair[0][1]) {
            Some(pair) => Err(damaged(format!("has element {} twice", pair[1][0]))),
            None => Ok(()),
        }
    }
}
