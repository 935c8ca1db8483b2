"""A disc in an infinite plate under tension, plane strain, joined to it by springs: the exact solution.

Airy terms r², r⁴ inside, ln r, r², r⁰, r⁻² outside; traction and jump on the rim give their factors.
"""

from typing import Any

import numpy as np
from midplane.pictures.results import Results
from midplane.pictures.traction import distances

from .solution import Exact, sizes


def disc(a: float, ei: float, nui: float, em: float, num: float, kn: float, kt: float, s: float = 0.5, d: float = 0.5) -> dict[str, Any]:
    """Harmonics 0 and 2 under σ_x = s + d, σ_y = s − d far away: amplitudes of the traction on the rim, and `u`."""
    mi, mm = ei / (2 * (1 + nui)), em / (2 * (1 + num))
    ki, km = 3 - 4 * nui, 3 - 4 * num
    fi, fm = (ki - 1) * a / (4 * mi), (km - 1) * a / (4 * mm)
    a0 = s * (fm + a / (2 * mm)) / (1 / kn + fi + a / (2 * mm))
    b0 = (s - a0) * a * a
    srr_i, srt_i = np.array([-2, 0.0]), np.array([2.0, 6.0])
    ur_i, ut_i = np.array([-2, ki - 3]) * a / (2 * mi), np.array([2, ki + 3]) * a / (2 * mi)
    srr_m, srt_m = np.array([-4, -6.0]), np.array([-2, -6.0])
    ur_m, ut_m = np.array([km + 1, 2]) * a / (2 * mm), np.array([-(km - 1), 2]) * a / (2 * mm)
    matrix, right = np.zeros((4, 4)), np.array([d, -d, d * a / (2 * mm), -d * a / (2 * mm)])
    matrix[0, :2], matrix[0, 2:] = srr_i, -srr_m
    matrix[1, :2], matrix[1, 2:] = srt_i, -srt_m
    matrix[2, :2], matrix[2, 2:] = srr_i / kn + ur_i, -ur_m
    matrix[3, :2], matrix[3, 2:] = srt_i / kt + ut_i, -ut_m
    size = np.abs(matrix).max(1)
    al, be, ga, de = np.linalg.solve(matrix / size[:, None], right / size)

    def u(r: float, body: str) -> tuple[float, float, float]:
        """Amplitudes: u_r = u0 + u2 cos 2θ, u_θ = v2 sin 2θ."""
        if body == "a":
            q = (r / a) ** 2
            return (
                a0 * (ki - 1) * r / (4 * mi),
                (-2 * al + (ki - 3) * be * q) * r / (2 * mi),
                (2 * al + (ki + 3) * be * q) * r / (2 * mi),
            )
        q = (a / r) ** 2
        radial = (d * r + ((km + 1) * ga * q + 2 * de * q * q) * r) / (2 * mm)
        return (
            (s * (km - 1) * r / 2 + b0 / r) / (2 * mm),
            radial,
            (-d * r + (-(km - 1) * ga * q + 2 * de * q * q) * r) / (2 * mm),
        )

    return {"n0": a0, "n2": -2 * al, "t2": 2 * al + 6 * be, "u": u}


def inclusion(scene: dict[str, Any], results: Results) -> Any:
    """A disc in an infinite plate under tension along x: `disc`, with θ from the x axis."""
    entry = scene["interfaces"]["rim"]
    law, (stiff, soft) = entry["law"], (scene["materials"][name] for name in ("stiff", "soft"))
    radius = 0.5 * sizes(results.subdomains["inclusion"])[0]
    springs = law["normal_stiffness"], law["tangential_stiffness"]
    amplitudes = disc(radius, stiff["young"], stiff["poisson"], soft["young"], soft["poisson"], *springs)
    pull = scene["steps"][0]["load"]["plate.right"]["traction"][0]
    places = results.interfaces["rim"].points[:, :2]
    s, angle = distances(results, "rim"), np.arctan2(places[:, 1], places[:, 0])
    normal = amplitudes["n0"] + amplitudes["n2"] * np.cos(2 * angle)
    shear = -amplitudes["t2"] * np.sin(2 * angle)
    return Exact({}, {"n": (s, pull * normal), "t": (s, pull * shear)})
