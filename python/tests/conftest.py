"""Two blocks on each other, as a user draws them, and results that several tests read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import midplane

BLOCK = """
DefineConstant[ edges = {{{edges}, Name "Edges along the joint"}} ];
Point(1) = {{0, {low}, 0}};
Point(2) = {{0.4, {low}, 0}};
Point(3) = {{0.4, {high}, 0}};
Point(4) = {{0, {high}, 0}};
Line(1) = {{1, 2}};
Line(2) = {{2, 3}};
Line(3) = {{3, 4}};
Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = edges + 1;
Transfinite Curve {{2, 4}} = 3;
Transfinite Surface {{1}};
Physical Curve("bottom") = {{1}};
Physical Curve("right") = {{2}};
Physical Curve("top") = {{3}};
Physical Curve("left") = {{4}};
Physical Surface("body") = {{1}};
"""
PRESSURE = 5.0  # on the top [MPa]


def draw(folder: Path) -> None:
    (folder / "lower.geo").write_text(BLOCK.format(edges=4, low=-0.1, high=0))
    (folder / "upper.geo").write_text(BLOCK.format(edges=7, low=0, high=0.1))


def content() -> dict[str, Any]:
    law = {"type": "coulomb", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "friction_coefficient": 0.6}
    return {
        "title": "Two blocks",
        "plane": "strain",
        "subdomains": {"lower": {"geo": "lower.geo", "material": "rock"}, "upper": {"geo": "upper.geo", "material": "rock"}},
        "materials": {"rock": {"young": 1e4, "poisson": 0.0}},
        "interfaces": {"joint": {"side_a": "lower.top", "side_b": "upper.bottom", "law": law}},
        "steps": [
            {
                "name": "press",
                "fix": {"lower.bottom": ["x", "y"], "upper.left": ["x"], "upper.right": ["x"]},
                "load": {"upper.top": {"pressure": PRESSURE}},
            },
            {"name": "push", "increments": 6, "displace": {"upper.left": {"x": 1e-3}, "upper.right": {"x": 1e-3}}},
        ],
        "output": {"history": {"force": "joint.resultant_t", "slide": "upper.left.displacement_x"}},
    }


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder with the geometries, in which the test works."""
    draw(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def scene(place: Path) -> midplane.Scene:
    return midplane.Scene(content(), name="blocks")


@pytest.fixture(scope="session")
def done(tmp_path_factory: pytest.TempPathFactory) -> midplane.Run:
    """The scene, solved once."""
    folder = tmp_path_factory.mktemp("done")
    draw(folder)
    return midplane.Scene(content(), folder=folder).run(folder / "results", progress=False)
