"""What results say, as pandas and PyVista have it."""

from __future__ import annotations

import base64
import csv
import json
from pathlib import Path

import numpy as np
import pytest
import pyvista
from conftest import PRESSURE

import midplane
from midplane.pictures import page
from midplane.stored import Midplane
from midplane.vtu import Vtu


def test_the_history_is_that_of_the_file_to_the_last_bit(done: midplane.Run) -> None:
    with open(done.folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    frame = done.history
    assert list(frame) == list(rows[0])
    assert frame["step"].tolist() == [row["step"] for row in rows]
    for name in frame.columns.drop("step"):
        assert frame[name].tolist() == [float(row[name]) for row in rows]


def test_friction_holds_what_it_can(done: midplane.Run) -> None:
    """Sides that cannot turn slip all along: the force is the coefficient times the weight."""
    assert done.history["force"].iloc[-1] == pytest.approx(0.6 * PRESSURE * 0.4, rel=1e-6)


def test_along_an_interface(done: midplane.Run) -> None:
    frame = done.interface("joint")
    assert frame.attrs["side_a"] == "lower"
    assert frame.attrs["side_b"] == "upper"
    assert frame.attrs["start"] == pytest.approx((0, 0), abs=1e-12)
    assert frame.attrs["end"] == pytest.approx((0.4, 0), abs=1e-12)
    assert frame["s"].to_numpy() * 0.4 == pytest.approx(frame["x"].to_numpy(), rel=1e-12)
    assert frame["traction_n"] @ frame["length"] == pytest.approx(-PRESSURE * 0.4, rel=1e-9)


def test_all_rows_of_an_interface_are_those_of_each(done: midplane.Run) -> None:
    every = done.interface("joint", row="all")
    assert every.index.names == ["row", "point"]
    for row in done.fields.rows:
        assert every.loc[[row]].equals(done.interface("joint", row=row))
    assert every.loc[0, "traction_t"].eq(0).all()


def test_fields_are_what_vtk_reads(done: midplane.Run) -> None:
    for number, row in enumerate(done.fields.rows):
        blocks = done.fields[number]
        assert blocks.keys() == ["lower", "upper", "joint"]
        for name in blocks.keys():
            read = pyvista.read(done.folder / "fields" / f"{name}_{row:04}.vtu")
            grid = blocks[name]
            assert np.array_equal(grid.points, read.points)
            assert np.array_equal(grid.cells, read.cells)
            assert np.array_equal(grid.celltypes, read.celltypes)
            assert sorted(grid.array_names) == sorted(read.array_names)
            for array in read.array_names:
                assert np.array_equal(np.ravel(grid[array]), np.ravel(read[array])), array


def test_components_have_the_names_of_the_file(done: midplane.Run) -> None:
    vtu = Vtu(done.folder / "fields" / "lower_0001.vtu")
    assert vtu.cell_data.components("stress") == ["xx", "yy", "zz", "xy", "yz", "xz"]
    assert vtu.cell_data.components("von_mises") == [""]


def test_a_damaged_file_is_told(done: midplane.Run, tmp_path_factory: pytest.TempPathFactory) -> None:
    content = bytearray((done.folder / "fields" / "lower_0001.vtu").read_bytes())
    start = content.index(b"_", content.index(b"<AppendedData")) + 1
    content[start + 40 :: 7] = bytes(len(content[start + 40 :: 7]))
    other = tmp_path_factory.mktemp("damaged") / "lower_0001.vtu"
    other.write_bytes(content)
    vtu = Vtu(other)
    with pytest.raises(midplane.ResultsError, match="damaged"):
        list(vtu.point_data.values())
    other.write_bytes(b"no VTU at all")
    with pytest.raises(midplane.ResultsError, match="no VTU file"):
        Vtu(other)


def test_a_sequence_of_fields(done: midplane.Run) -> None:
    fields = done.fields
    assert len(fields) == 8
    assert len(fields[1:3]) == 2
    with pytest.raises(IndexError):
        fields[8]


def test_summary_and_names(done: midplane.Run) -> None:
    assert done.summary == json.loads((done.folder / "summary.json").read_text())
    assert done.interfaces == ["joint"]
    assert done.subdomains == ["lower", "upper"]
    assert "Two blocks" in repr(done)


def test_warnings_have_codes(scene: midplane.Scene) -> None:
    scene["interfaces.joint.coupling"] = "pointwise"
    scene["interfaces.joint.law.normal_stiffness"] = 1e9
    with pytest.warns(midplane.MidplaneWarning, match=r"^W\d\d "):
        run = scene.run(progress=False)
    assert run.warnings and all(warned.code.startswith("W") for warned in run.warnings)
    assert {"W02"} <= {warned.code for warned in run.warnings} & {warned.code for warned in scene.check().warnings}


def test_pictures(done: midplane.Run) -> None:
    pictures = [done.plot(), done.plot("principal_stress"), done.crack_map(), done.plot_interface("joint"), done.plot(zoom=((0, 0.2), (-0.1, 0.1)))]
    for picture in pictures:
        data, shown = picture._repr_mimebundle_()
        assert base64.b64decode(data["image/png"]).startswith(b"\x89PNG")
        assert 300 < shown["image/png"]["width"] < 900


def test_a_crack_map_tells_what_slides(done: midplane.Run) -> None:
    (legend,) = done.crack_map().figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["cracks or slides, pressed"]


def test_the_style_of_others_is_left_alone(done: midplane.Run) -> None:
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    done.plot()
    assert dict(mpl.rcParams) == before


def test_distances_are_counted_along_kinks(tmp_path: Path) -> None:
    """Places on a corner of 90 degrees, and what chords between them would make of it."""
    midplane_ = object.__new__(Midplane)
    midplane_.points = np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [2, 2]])
    midplane_.segments = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
    s = np.array([0.2, 0.8, 1.7, 2.3, 3.1, 3.9])
    places = np.array([[t, 0.0, 0] if t <= 2 else [2, t - 2, 0] for t in s])
    assert midplane_.distance(places) == pytest.approx(s, abs=1e-14)


def test_pictures_show_something(done: midplane.Run) -> None:
    for picture in (done.plot(), done.plot("principal_stress"), done.crack_map(), done.plot_interface("joint")):
        image = page.picture(picture.figure)
        colours = image.getcolors(1 << 24)
        assert colours is not None and len(colours) > 50
        # most of a picture is paper, not all of it
        white = next((count for count, colour in colours if colour == (255, 255, 255)), 0)
        assert 0.02 < 1 - white / (image.width * image.height) < 0.95
