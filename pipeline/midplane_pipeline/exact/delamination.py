"""Delamination by beam theory: what a double cantilever and an end-notched beam carry where a brittle bond lets the crack grow.

Arms of stiffness E along, E_2 across, G in shear; the crack is longer by χ h for what they give at its tip (Williams 1989, χ as in
ISO 15024 and ASTM D5528), by 0.42 χ h in mode II. A strength that is finite lowers and rounds the peak.

    DCB   C = 2 (a + χ h)³/(3 E I)                                    P = √(G_I b E I)/(a + χ h)
    ENF   C = (3 (a + 0.42 χ h)³ + 2 L³)/(8 E b h³) + 3 L/(10 G b h)   P = 4/3 √(G_II E b² h³)/(a + 0.42 χ h)

    python -m midplane_pipeline.exact.delamination geo/delamination     forces, as options for midplane_pipeline.check
"""

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from midplane import scene_file
from midplane.vtu import Array

from midplane_pipeline.results.told import told

MANY = 4000

# file, mode, relative slack of peak, stiffness and force, displacements at which forces are known
FILES = (("scene", "I", (0.02, 0.03, 0.01), (6.5, 6.9)), ("enf", "II", (0.05, 0.03, 0.03), (3.45, 3.6)))


def smeared(scene: dict[str, Any], layer: float) -> tuple[float, float, float]:
    """Stiffness along, across and in shear of layers and the springs between them."""
    young, law = scene["materials"]["layer"]["young"], scene["interfaces"]["lower"]["law"]
    across = 1 / (1 / young + 1 / (layer * law["normal_stiffness"]))
    return young, across, 1 / (2 / young + 1 / (layer * law["tangential_stiffness"]))


def correction(along: float, across: float, shear: float) -> float:
    """χ: by how many heights of an arm the crack is longer."""
    gamma = 1.18 * np.sqrt(along * across) / shear
    return np.sqrt(along / (11 * shear) * (3 - 2 * (gamma / (1 + gamma)) ** 2))


def curve(scene: dict[str, Any], sizes: dict[str, float], mode: str) -> tuple[Array, Array]:
    """Displacement and force as the crack grows; the first is where it begins."""
    height, width = sizes["height"], scene["thickness"]
    along, across, shear = smeared(scene, height / 3)
    law, longer = scene["interfaces"]["joint"]["law"], correction(along, across, shear) * height
    start, span = sizes["crack"], sizes["length"]
    if mode == "I":
        a = np.linspace(start, start + 15, MANY) + longer
        bending = along * width * height**3 / 12
        force = np.sqrt(law["fracture_energy_i"] * width * bending) / a
        return 2 * force * a**3 / (3 * bending), force
    half = span / 2
    a = np.linspace(start, half - 5, MANY) + 0.42 * longer
    force = 4 / 3 * np.sqrt(law["fracture_energy_ii"] * along * width**2 * height**3) / a
    compliance = (3 * a**3 + 2 * half**3) / (8 * along * width * height**3) + 0.3 * half / (shear * width * height)
    return compliance * force, force


def options(scene: dict[str, Any], sizes: dict[str, float], mode: str, slack: Sequence[float], places: Sequence[float]) -> Iterator[str]:
    """Options for midplane_pipeline.check: the peak, the first stiffness and forces once the crack grows; `slack` is relative."""
    x, force = curve(scene, sizes, mode)
    yield f"--expect=max:force={(1 - slack[0]) * force[0]:.6g}:{force[0]:.6g}"
    yield f"--expect=force@displacement=2={2 * force[0] / x[0]:.6g}~{slack[1] * 2 * force[0] / x[0]:.2g}"
    for place in places:
        value = np.interp(place, x, force)
        yield f"--expect=force@displacement={place:g}={value:.6g}~{slack[2] * value:.2g}"
        yield f"--expect=J_over_G@displacement={place:g}=1~0.005"


def main() -> None:
    """The command."""
    folder = Path(sys.argv[1])
    for name, mode, slack, places in FILES:
        scene = scene_file.read(folder / f"{name}.json")
        sizes = scene_file.constants(folder / "arm.geo") | scene["subdomains"]["lower1"]["parameters"]
        print(f"{folder / name}.json", *options(scene, sizes, mode, slack, places), sep="\n")


if __name__ == "__main__":
    told(main)
