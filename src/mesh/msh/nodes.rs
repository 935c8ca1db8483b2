//! `$Nodes`: tags and coordinates, block by block.
//!
//! ```text
//! blocks nodes least most                   counts, and the range of the tags
//! dimension entity parametric nodes         of each block, followed by
//! tag tag ...  x y z  x y z ...             all its tags, then all its coordinates
//! ```

use super::content::{Content, MeshFault, damaged};
use super::cursor::Cursor;
use super::pieces::{Decoder, pieces};
use super::tags::Tags;

/// Numbers per node: its tag and three coordinates.
const PER_NODE: u64 = 4;

/// Reads the nodes into `content`; returns the way from their tags to their numbers.
pub(super) fn read(
    cursor: &mut Cursor,
    decoder: &mut Decoder,
    content: &mut Content,
) -> Result<Tags, MeshFault> {
    let cut = || damaged("$Nodes ends early or holds something that is not a number");
    let (Some(blocks), Some(total), Some(least), Some(most)) =
        (cursor.size(), cursor.size(), cursor.size(), cursor.size())
    else {
        return Err(cut());
    };
    if !cursor.holds(total.saturating_mul(PER_NODE)) {
        return Err(damaged(format!("claims {total} nodes, more than the file can hold")));
    }
    content.node_tags.reserve_exact(total as usize);
    content.points.reserve_exact(total as usize);
    for _ in 0..blocks {
        let (Some(dim), Some(_), Some(parametric)) = (cursor.int(), cursor.int(), cursor.int()) else {
            return Err(cut());
        };
        if parametric != 0 {
            return Err(MeshFault {
                what: "has nodes with parametric coordinates".into(),
                help: "set Mesh.SaveParametric = 0".into(),
            });
        }
        let count = cursor.size().ok_or_else(cut)?;
        if !cursor.holds(count.saturating_mul(PER_NODE)) {
            return Err(damaged(format!("claims {count} nodes in a block, more than the file can hold")));
        }
        if dim == 0 {
            let first = content.node_tags.len() as u32;
            content.corners.extend((0..count as u32).map(|i| first + i));
        }
        for _ in 0..count {
            let tag = cursor.size().ok_or_else(cut)?;
            if tag < least.max(1) || tag > most {
                return Err(damaged(format!("has node {tag}, but claims tags {least} to {most}")));
            }
            content.node_tags.push(tag);
        }
        for size in pieces(count as usize) {
            let numbers = cursor.skip(3 * size).ok_or_else(cut)?;
            for node in decoder.nodes(size, numbers).ok_or_else(cut)? {
                let tag = content.node_tags[content.points.len()];
                if !(node.x.is_finite() && node.y.is_finite() && node.z.is_finite()) {
                    return Err(damaged(format!("node {tag} is at {}, {}, {}", node.x, node.y, node.z)));
                }
                if node.z.abs() > content.off_plane.0 {
                    content.off_plane = (node.z.abs(), tag);
                }
                content.points.push([node.x, node.y]);
            }
        }
    }
    if content.points.len() as u64 != total {
        return Err(damaged(format!("claims {total} nodes and holds {}", content.points.len())));
    }
    Tags::new(&content.node_tags)
}
