//! VTK's XML unstructured grid: raw appended data, zlib in blocks that are compressed in parallel.

use std::io::Write as _;

use flate2::{Compression, write::ZlibEncoder};
use rayon::prelude::*;

/// Bytes of one compressed block.
const BLOCK: usize = 1 << 20;

/// The beginning of every file.
pub(super) const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
    byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n\
    <UnstructuredGrid>\n<FieldData>\n";

/// Values of one array.
#[derive(Debug)]
pub(super) enum Data {
    Float(Vec<f64>),
    Int(Vec<i64>),
    Byte(Vec<u8>),
}

/// A named array with its number of components.
#[derive(Debug)]
pub(super) struct Array {
    pub name: &'static str,
    pub components: usize,
    /// Names of the components; none where x, y, z or the name of the array says it.
    pub labels: &'static [&'static str],
    pub data: Data,
}

/// An unstructured grid.
#[derive(Debug, Default)]
pub(super) struct VtuGrid {
    /// x, y, z of every point.
    pub points: Vec<f64>,
    /// Point numbers of all cells.
    pub connectivity: Vec<i64>,
    /// End of every cell in `connectivity`.
    pub offsets: Vec<i64>,
    /// VTK type of every cell.
    pub types: Vec<u8>,
    pub point_data: Vec<Array>,
    pub cell_data: Vec<Array>,
    /// Scalars of the whole grid.
    pub field_data: Vec<Array>,
}

impl Array {
    /// Floating point values.
    pub(super) fn float(
        name: &'static str,
        components: usize,
        values: impl IntoIterator<Item = f64>,
    ) -> Array {
        Array { name, components, labels: &[], data: Data::Float(values.into_iter().collect()) }
    }

    /// Floating point values with names of their components.
    pub(super) fn labelled(
        name: &'static str,
        labels: &'static [&'static str],
        values: impl IntoIterator<Item = f64>,
    ) -> Array {
        Array { labels, ..Array::float(name, labels.len(), values) }
    }

    /// Integer values.
    pub(super) fn int(name: &'static str, values: impl IntoIterator<Item = i64>) -> Array {
        Array { name, components: 1, labels: &[], data: Data::Int(values.into_iter().collect()) }
    }
}

/// The text of the file, broken off wherever an offset stands, and the blocks whose offsets these are.
struct Draft {
    text: Vec<String>,
    blocks: Vec<Vec<u8>>,
}

impl Draft {
    /// Goes on with the text.
    fn write(&mut self, text: &str) {
        if let Some(last) = self.text.last_mut() {
            last.push_str(text);
        }
    }

    /// Announces an array and keeps its block.
    fn add(&mut self, array: Array, more: &str) {
        let kind = match array.data {
            Data::Float(_) => "Float64",
            Data::Int(_) => "Int64",
            Data::Byte(_) => "UInt8",
        };
        // readers take a scalar without this attribute as a flat list
        let mut components = match array.components {
            1 => String::new(),
            n => format!(" NumberOfComponents=\"{n}\""),
        };
        for (k, label) in array.labels.iter().enumerate() {
            components.push_str(&format!(" ComponentName{k}=\"{label}\""));
        }
        let name = array.name;
        self.write(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\"{components}{more} format=\"appended\" offset=\""
        ));
        self.text.push("\"/>\n".into());
        self.blocks.push(block(array.data));
    }

    /// The bytes of the file, the last array first: meshio replaces offsets one after the other and takes the first
    /// tag that has the one it looks for, which must not be a tag whose offset it has replaced.
    fn finish(self) -> Vec<u8> {
        let mut offset: usize = self.blocks.iter().map(Vec::len).sum();
        let mut bytes = Vec::new();
        for (k, text) in self.text.iter().enumerate() {
            bytes.extend_from_slice(text.as_bytes());
            if let Some(block) = self.blocks.get(k) {
                offset -= block.len();
                bytes.extend_from_slice(offset.to_string().as_bytes());
            }
        }
        bytes.extend_from_slice(b"<AppendedData encoding=\"raw\">\n_");
        self.blocks.iter().rev().for_each(|block| bytes.extend_from_slice(block));
        bytes.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        bytes
    }
}

impl VtuGrid {
    /// The bytes of the file.
    pub(super) fn encode(self) -> Vec<u8> {
        let (n_points, n_cells) = (self.points.len() / 3, self.types.len());
        let mut draft = Draft { text: vec![HEAD.into()], blocks: Vec::new() };
        self.field_data.into_iter().for_each(|array| draft.add(array, " NumberOfTuples=\"1\""));
        draft.write(&format!(
            "</FieldData>\n<Piece NumberOfPoints=\"{n_points}\" NumberOfCells=\"{n_cells}\">\n<Points>\n"
        ));
        draft.add(Array::float("Points", 3, self.points), "");
        draft.write("</Points>\n<Cells>\n");
        draft.add(Array::int("connectivity", self.connectivity), "");
        draft.add(Array::int("offsets", self.offsets), "");
        draft.add(Array { data: Data::Byte(self.types), ..Array::int("types", []) }, "");
        draft.write("</Cells>\n<PointData>\n");
        self.point_data.into_iter().for_each(|array| draft.add(array, ""));
        draft.write("</PointData>\n<CellData>\n");
        self.cell_data.into_iter().for_each(|array| draft.add(array, ""));
        draft.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n");
        draft.finish()
    }
}

/// One array: number of blocks, block size, size of the last, compressed sizes, blocks.
fn block(data: Data) -> Vec<u8> {
    let (blocks, bytes): (Vec<Vec<u8>>, usize) = match &data {
        Data::Float(values) => (compressed(values, f64::to_le_bytes), 8 * values.len()),
        Data::Int(values) => (compressed(values, i64::to_le_bytes), 8 * values.len()),
        Data::Byte(values) => (compressed(values, u8::to_le_bytes), values.len()),
    };
    drop(data); // the bytes below take its place in memory
    let last = bytes % BLOCK; // zero: the last block is full
    let header = [blocks.len(), BLOCK, last].into_iter().chain(blocks.iter().map(Vec::len));
    let mut out: Vec<u8> = header.flat_map(|number| (number as u64).to_le_bytes()).collect();
    blocks.iter().for_each(|block| out.extend_from_slice(block));
    out
}

/// The values block by block.
fn compressed<T: Copy + Sync, const N: usize>(values: &[T], to_bytes: fn(T) -> [u8; N]) -> Vec<Vec<u8>> {
    let encode = |values: &[T]| {
        let mut block = Vec::with_capacity(BLOCK);
        values.iter().for_each(|&value| block.extend_from_slice(&to_bytes(value)));
        compress(&block)
    };
    values.par_chunks(BLOCK / N).map(encode).collect()
}

fn compress(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::with_capacity(block.len() / 2), Compression::fast());
    // writing to memory cannot fail
    let _ = encoder.write_all(block);
    encoder.finish().unwrap_or_default()
}
