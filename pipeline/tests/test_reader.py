"""The reader of results on files made by hand, and the checks that stand on it."""

import json
import struct
import zlib

import numpy as np
import pytest
from midplane.errors import ResultsError
from midplane.stored import Stored
from midplane.vtu import Vtu

from midplane_pipeline.check.__main__ import collection
from midplane_pipeline.check.faults import Faults
from midplane_pipeline.check.history import read_history
from midplane_pipeline.check.readers import read_thrice
from midplane_pipeline.draw import measured
from midplane_pipeline.results.columns import read, read_columns, until
from midplane_pipeline.results.entries import entry_of
from midplane_pipeline.trade.history import read_history as numbers_of

TYPES = {"f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}


def vtu(sections, compressed):
    """A VTU: {section: {name: array}}, in one block of zlib each or as they are."""
    data, parts = b"", []
    for section, arrays in sections.items():
        lines = []
        for name, values in arrays.items():
            count = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
            tuples = f' NumberOfTuples="{len(values)}"' if section == "FieldData" else ""
            kind = TYPES[values.dtype.str[1:]]
            lines.append(f'<DataArray type="{kind}" Name="{name}"{count}{tuples} format="appended" offset="{len(data)}"/>')
            raw = values.tobytes()
            packed = zlib.compress(raw)
            data += struct.pack("<4Q", 1, len(raw), len(raw), len(packed)) + packed if compressed else struct.pack("<Q", len(raw)) + raw
        parts.append((section, f"<{section}>{''.join(lines)}</{section}>"))
    inside = "".join(text for section, text in parts if section != "FieldData")
    outside = "".join(text for section, text in parts if section == "FieldData")
    points, cells = len(sections["Points"]["Points"]), len(sections["Cells"]["types"])
    how = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    head = f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"{how}><UnstructuredGrid>{outside}'
    head += f'<Piece NumberOfPoints="{points}" NumberOfCells="{cells}">{inside}</Piece></UnstructuredGrid>'
    return head.encode() + b'<AppendedData encoding="raw">\n_' + data + b"\n</AppendedData></VTKFile>"


QUAD = {
    "FieldData": {"TimeValue": np.array([3.0])},
    "PointData": {"displacement": np.arange(12.0).reshape(4, 3)},
    "CellData": {"von_mises": np.array([2.5])},
    "Points": {"Points": np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)},
    "Cells": {"connectivity": np.arange(4), "offsets": np.array([4]), "types": np.array([9], "u1")},
}


@pytest.mark.parametrize("compressed", [True, False])
def test_three_readers_find_what_was_written(tmp_path, compressed):
    path = tmp_path / "body_0003.vtu"
    path.write_bytes(vtu(QUAD, compressed))
    ours = Vtu(path)
    assert ours.points.tolist() == QUAD["Points"]["Points"].tolist()
    assert ours.point_data["displacement"].tolist() == QUAD["PointData"]["displacement"].tolist()
    assert ours.cell_data["von_mises"].tolist() == [2.5]
    assert ours.field_data["TimeValue"].tolist() == [3.0]
    assert ours.cells["types"].tolist() == [9]
    faults = Faults()
    grid = read_thrice(path, faults)
    assert faults == []
    assert grid.n_cells == 1


def test_a_number_that_is_none_is_told(tmp_path):
    path = tmp_path / "body_0003.vtu"
    points = QUAD["Points"]["Points"].copy()
    points[2, 1] = np.nan
    path.write_bytes(vtu(QUAD | {"Points": {"Points": points}}, True))
    faults = Faults()
    read_thrice(path, faults)
    assert any("not finite" in fault for fault in faults)


def test_a_file_that_ends_early_is_told(tmp_path):
    path = tmp_path / "body_0003.vtu"
    path.write_bytes(vtu(QUAD, True)[:-150])
    with pytest.raises(ResultsError, match="damaged"):
        Vtu(path).cells["types"]
    with pytest.raises(ResultsError, match="no such file"):
        Vtu(tmp_path / "none.vtu")


HISTORY = """step,increment,load_factor,iterations,residual,u,reaction:a.bottom:y,energy_balance
press,0,0,0,0,0,0,0
press,1,0.5,2,1e-12,0.001,5,1e-15
press,2,1,3,2e-12,0.002,10,2e-15
"""
SCENE = {"steps": [{"name": "press", "fix": {"a.bottom": ["y"]}}], "output": {"history": {"u": "b.top.displacement_y"}}}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "history.csv").write_text(HISTORY)
    (tmp_path / "summary.json").write_text(json.dumps({"sizes": {"subdomains": {"a": {}, "b": {}}, "interfaces": {}}}))
    return tmp_path


def test_columns_of_a_history(folder):
    columns = read(folder)
    assert "step" not in columns
    assert columns["u"].tolist() == [0, 0.001, 0.002]
    assert numbers_of(folder)["u"] == [0, 0.001, 0.002]
    assert numbers_of(folder / "none") == {}
    assert Stored(folder).subdomains() == ["a", "b"]
    assert read_columns(folder, ("u", "increment")).keys() == columns.keys()
    with pytest.raises(SystemExit, match="residul"):
        read_columns(folder, ("residul",))


def test_a_history_ends_between_two_rows(folder):
    part = until(read(folder), "u", 0.0015)
    assert part["u"].tolist() == [0, 0.001, 0.0015]
    assert part["reaction:a.bottom:y"][-1] == pytest.approx(7.5)
    assert until(read(folder), "u", 1.0)["u"].tolist() == [0, 0.001, 0.002]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("press,2,1", "press,3,1", "do not count"),
        ("0.002,10", "0.002,nan", "not a finite number"),
        ("energy_balance", "energy", "no energy_balance"),
        ("iterations,residual", "residual,iterations", "should begin with"),
        ("reaction:a.bottom:y", "reaction:a.bottom:x", "reactions are"),
        ("press,0,0", "press,0,0.1", "unloaded state"),
        ("press,2", "pull,2", "steps are"),
    ],
)
def test_what_a_history_lacks_is_told(folder, old, new, said):
    faults = Faults()
    read_history(folder / "history.csv", SCENE, faults)
    assert faults == []
    (folder / "history.csv").write_text(HISTORY.replace(old, new))
    read_history(folder / "history.csv", SCENE, faults)
    assert any(said in fault for fault in faults)


def pvd(*entries):
    sets = "".join(f'<DataSet timestep="{time}" file="fields/{name}"/>' for time, name in entries)
    return f'<VTKFile type="Collection" version="1.0"><Collection>{sets}</Collection></VTKFile>'


def test_a_collection_names_what_is_there(tmp_path):
    (tmp_path / "fields").mkdir()
    for name in ("a_0000.vtu", "a_0002.vtu"):
        (tmp_path / "fields" / name).write_text("")
    path, faults = tmp_path / "run.pvd", Faults()
    path.write_text(pvd((0, "a_0000.vtu"), (2, "a_0002.vtu")))
    files, times = collection(path, faults)
    assert (faults, [file.name for file in files], times) == ([], ["a_0000.vtu", "a_0002.vtu"], [0, 2])
    path.write_text(pvd((0, "a_0000.vtu"), (1, "a_0002.vtu")))
    collection(path, faults)
    assert any("time 1" in fault for fault in faults)
    faults.clear()
    path.write_text(pvd((0, "a_0000.vtu")))
    collection(path, faults)
    assert any("differ" in fault for fault in faults)


def test_measured_values_come_in_order_of_the_abscissa(tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text("# from somewhere\nx,low,high\n2,5,\n1,3,4\n")
    values = measured.read(path)
    assert values.x.tolist() == [1, 2]
    assert values.high[0] == 4
    assert np.isnan(values.high[1])
    path.write_text("x,y\n1,2\n")
    with pytest.raises(SystemExit, match="x, low, high"):
        measured.read(path)


def test_an_interface_between_two_bodies_is_of_its_entry():
    scene = {"interfaces": {"joint": {"law": 1}, "base": {"law": 2}}}
    assert entry_of(scene, "joint~a~b~1")["law"] == 1
    assert entry_of(scene, "base")["law"] == 2
