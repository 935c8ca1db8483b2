"""VTU files as midplane writes them: arrays appended as raw binary, in blocks compressed by zlib or as they are.

An array is decoded when it is asked for, so that thousands of files are read for a few of their arrays in no time.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .errors import ResultsError

if TYPE_CHECKING:
    import pyvista

Array = NDArray[Any]

TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "UInt8": "u1", "UInt64": "u8", "Int8": "i1", "UInt32": "u4"}
BEGIN = re.compile(rb'<AppendedData encoding="raw">\s*_')
SECTION = re.compile(r"<(FieldData|Points|Cells|PointData|CellData)>(.*?)</\1>", re.DOTALL)
ARRAY = re.compile(r"<DataArray ([^>]*?)/>")
ATTRIBUTE = re.compile(r'(\w+)="([^"]*)"')
ENTITIES = {"&lt;": "<", "&gt;": ">", "&quot;": '"', "&apos;": "'", "&amp;": "&"}
LINE = 3  # VTK's number of a cell of two nodes


class Arrays(Mapping[str, Array]):
    """Arrays by name; (count,) for numbers, (count, components) for what has several."""

    def __init__(self, of: Vtu, headers: dict[str, dict[str, str]]) -> None:
        self.of, self.headers = of, headers

    def __getitem__(self, name: str) -> Array:
        return self.of.array(self.headers[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self.headers)

    def __len__(self) -> int:
        return len(self.headers)

    def components(self, name: str) -> list[str]:
        """The names of an array's components; one empty name for numbers."""
        header = self.headers[name]
        count = int(header.get("NumberOfComponents", 1))
        if count == 1:
            return [""]
        plain = "xyz" if count <= 3 else [str(number) for number in range(count)]
        return [header.get(f"ComponentName{number}", plain[number]) for number in range(count)]


class Vtu:
    """One file: `points` (count, 3), `cells` (connectivity, offsets, types), `point_data`, `cell_data`, `field_data`."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self.content = path.read_bytes()
        except FileNotFoundError:
            raise ResultsError(f"{path}: there is no such file") from None
        begin = BEGIN.search(self.content)
        if begin is None or b'byte_order="LittleEndian"' not in self.content[: begin.start()]:
            raise ResultsError(f"{path}: no VTU file of midplane (raw appended data, little-endian)")
        head = self.content[: begin.start()].decode()
        self.start = begin.end()
        self.size = np.dtype("<u8" if 'header_type="UInt64"' in head else "<u4")
        self.compressed = "vtkZLibDataCompressor" in head
        if "compressor=" in head and not self.compressed:
            raise ResultsError(f"{path}: compressed in another way than by zlib")
        found = {name: text for name, text in SECTION.findall(head)}
        arrays = {name: Arrays(self, {plain(one["Name"]): one for one in headers(text)}) for name, text in found.items()}
        nothing = Arrays(self, {})
        self.point_data, self.cell_data = arrays.get("PointData", nothing), arrays.get("CellData", nothing)
        self.field_data, self.cells = arrays.get("FieldData", nothing), arrays.get("Cells", nothing)
        self.at = arrays.get("Points", nothing)

    @property
    def points(self) -> Array:
        """(count, 3)."""
        return next(iter(self.at.values()))

    def array(self, header: dict[str, str]) -> Array:
        """The values that a header describes. Raises ResultsError where the file is damaged."""
        count = int(header.get("NumberOfComponents", 1))
        try:
            data = self.data(self.start + int(header["offset"]))
            values = np.frombuffer(data, np.dtype(TYPES[header["type"]]).newbyteorder("<"))
            return values.reshape(-1, count) if count > 1 else values
        except (ValueError, KeyError, MemoryError, OverflowError, zlib.error) as error:
            raise ResultsError(f"{self.path}: damaged ({error})") from None

    def data(self, at: int) -> bytes:
        """The bytes of the array whose header is at a place: blocks, size of a block, of the last, of each compressed, or plain."""
        word = self.size.itemsize
        if not self.compressed:
            (length,) = np.frombuffer(self.content, self.size, 1, at).tolist()
            return self.content[at + word : at + word + length]
        (blocks,) = np.frombuffer(self.content, self.size, 1, at).tolist()
        lengths = np.frombuffer(self.content, self.size, blocks, at + 3 * word).tolist()
        begin, out = at + (3 + blocks) * word, []
        for length in lengths:
            out.append(zlib.decompress(self.content[begin : begin + length]))
            begin += length
        return b"".join(out)

    def grid(self) -> pyvista.UnstructuredGrid:
        """The file as PyVista has it."""
        import pyvista

        offsets, connectivity = self.cells["offsets"], self.cells["connectivity"]
        counts = np.diff(offsets, prepend=0)
        # VTK's form: the number of nodes of a cell before its nodes
        cells = np.insert(connectivity, offsets - counts, counts) if len(counts) else np.array([], int)
        grid = pyvista.UnstructuredGrid(cells, self.cells["types"].copy(), self.points.copy())
        for name, values in self.point_data.items():
            grid.point_data[name] = values.copy()
        for name, values in self.cell_data.items():
            grid.cell_data[name] = values.copy()
        for name, values in self.field_data.items():
            grid.field_data[name] = values.copy()
        return grid


def headers(text: str) -> list[dict[str, str]]:
    """The attributes of all arrays of a part of a file."""
    return [dict(ATTRIBUTE.findall(attributes)) for attributes in ARRAY.findall(text)]


def plain(text: str) -> str:
    """A name without the entities of XML."""
    return re.sub("|".join(ENTITIES), lambda found: ENTITIES[found.group()], text) if "&" in text else text
