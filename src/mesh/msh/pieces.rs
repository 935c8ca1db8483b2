//! Numbers in bulk, decoded by mshio piece by piece.
//!
//! mshio reads whole files into one `Vec` per element. Handing it the entities, the coordinates and the elements in
//! small files of their own keeps what it needs small, whatever the size of the mesh or the counts a damaged file
//! claims, and leaves the node tags, which it drops, to us.

use mshio::{Element, Entities, MshData, Node, parse_msh_bytes};

use super::cursor::Encoding;

/// Elements or nodes decoded at a time.
const PIECE: usize = 1 << 12;

/// Sizes of the pieces that `count` elements or nodes are decoded in.
pub(super) fn pieces(count: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(PIECE).map(move |start| PIECE.min(count - start))
}

/// Wraps pieces of a file into small MSH files and has mshio read them.
pub(super) struct Decoder {
    encoding: Encoding,
    file: Vec<u8>,
}

impl Decoder {
    /// A decoder for numbers in this encoding.
    pub(super) fn new(encoding: Encoding) -> Decoder {
        Decoder { encoding, file: Vec::new() }
    }

    /// The geometric entities, from the content of `$Entities`.
    pub(super) fn entities(&mut self, content: &[u8]) -> Option<Entities<i32, f64>> {
        self.open("$Entities\n");
        self.close(content, "\n$EndEntities\n")?.entities
    }

    /// `count` nodes, from their coordinates.
    pub(super) fn nodes(&mut self, count: usize, coordinates: &[u8]) -> Option<Vec<Node<f64>>> {
        self.open("$Nodes\n");
        self.block(count, [2, 1, 0]);
        for tag in 1..=count {
            self.put_size(tag);
        }
        let mut blocks = self.close(coordinates, "\n$EndNodes\n")?.nodes?.node_blocks;
        blocks.pop().map(|block| block.nodes).filter(|nodes| nodes.len() == count)
    }

    /// `count` elements of a gmsh type, from their tags and nodes.
    pub(super) fn elements(
        &mut self,
        count: usize,
        gmsh_type: i32,
        content: &[u8],
    ) -> Option<Vec<Element<u64>>> {
        self.open("$Elements\n");
        self.block(count, [2, 1, gmsh_type]);
        let mut blocks = self.close(content, "\n$EndElements\n")?.elements?.element_blocks;
        blocks.pop().map(|block| block.elements).filter(|elements| elements.len() == count)
    }

    fn open(&mut self, section: &str) {
        self.file.clear();
        self.file.extend_from_slice(b"$MeshFormat\n4.1 ");
        self.file.extend_from_slice(if self.encoding == Encoding::Text { b"0 8\n" } else { b"1 8\n" });
        if self.encoding != Encoding::Text {
            self.put_int(1);
        }
        self.file.extend_from_slice(b"\n$EndMeshFormat\n");
        self.file.extend_from_slice(section.as_bytes());
    }

    /// The heads of a section with one block of `count` members.
    fn block(&mut self, count: usize, head: [i32; 3]) {
        for value in [1, count, 1, count] {
            self.put_size(value);
        }
        for value in head {
            self.put_int(value);
        }
        self.put_size(count);
    }

    fn close(&mut self, content: &[u8], end: &str) -> Option<MshData<u64, i32, f64>> {
        self.file.extend_from_slice(content);
        self.file.extend_from_slice(end.as_bytes());
        parse_msh_bytes(&self.file).ok().map(|file| file.data)
    }

    fn put_size(&mut self, value: usize) {
        match self.encoding {
            Encoding::Text => self.file.extend_from_slice(format!("{value} ").as_bytes()),
            Encoding::Little => self.file.extend_from_slice(&(value as u64).to_le_bytes()),
            Encoding::Big => self.file.extend_from_slice(&(value as u64).to_be_bytes()),
        }
    }

    fn put_int(&mut self, value: i32) {
        match self.encoding {
            Encoding::Text => self.file.extend_from_slice(format!("{value} ").as_bytes()),
            Encoding::Little => self.file.extend_from_slice(&value.to_le_bytes()),
            Encoding::Big => self.file.extend_from_slice(&value.to_be_bytes()),
        }
    }
}
