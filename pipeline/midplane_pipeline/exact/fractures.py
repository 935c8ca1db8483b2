"""Exact solutions of cracks in an infinite plane and of Hertz's contact, from the numbers of the scene."""

from typing import Any

import numpy as np
from midplane.pictures.interfaces import course
from midplane.pictures.results import Results

from .solution import MANY, Exact, sizes

ENDS = 0.05  # of a crack's length at each end: tractions of the elements at its tips, where stresses are singular, are no values


def plane_modulus(material: dict[str, Any]) -> float:
    """E/(1 − ν²)."""
    return material["young"] / (1 - material["poisson"] ** 2)


def chord(results: Results, name: str) -> tuple[float, float, float]:
    """Length of a straight interface, and the cosine and sine of its angle to the x axis."""
    midplane = results.midplane(name)
    along = np.subtract(midplane.end, midplane.start)
    length = np.hypot(*along)
    return length, *(along / length)


def inclined_crack(scene: dict[str, Any], results: Results) -> Any:
    """A closed crack under a compression along x: t_n = −σ sin²ψ, t_t = −μ t_n, on all of it but its ends (`ENDS`).

    It slips by 4 (1 − ν²)/E σ sinψ (cosψ − μ sinψ) √(b² − s²).
    """
    law, load = scene["interfaces"]["crack"]["law"], scene["steps"][-1]["load"]
    length, _, sine = chord(results, "crack")
    normal = -load["plate.right"]["pressure"] * sine**2
    places = [ENDS * length, (1 - ENDS) * length]
    shear = -law["friction_coefficient"] * normal
    return Exact({}, {"n": (places, [normal] * 2), "t": (places, [shear] * 2)})


def sneddon(scene: dict[str, Any], results: Results) -> Any:
    """A crack under a pressure p inside: it opens by 4 (1 − ν²) p/E √(b² − s²), in its middle by 4 (1 − ν²) p b/E."""
    pressure = scene["steps"][-1]["load"]["crack"]["pressure"]
    half = chord(results, "crack")[0] / 2
    opening = 4 * pressure * half / plane_modulus(scene["materials"]["rock"])
    return Exact({"opening": np.array([0.0, opening]), "pressure": np.array([0.0, pressure])}, {})


def hertz(scene: dict[str, Any], results: Results) -> Any:
    """A disc on a half plane under F per length: p = p₀ √(1 − x²/a²), a² = 4 F R/(π E*), p₀ = 2 F/(π a).

    1/E* = (1 − ν²)/E of the disc + (1 − ν²)/E of the block; half of both is in the scene.
    """
    entries = scene["subdomains"]
    moduli = [plane_modulus(scene["materials"][entries[name]["material"]]) for name in ("disc", "block")]
    together = 1 / sum(1 / modulus for modulus in moduli)
    radius = sizes(results.subdomains["disc"])[0]
    end = 2 * scene["steps"][-1]["load"]["disc.top"]["pressure"] * radius

    force = np.linspace(0.0, end, MANY)
    curve = {"force": force, "pressure": np.sqrt(force * together / (np.pi * radius))}
    half, peak = np.sqrt(4 * end * radius / (np.pi * together)), curve["pressure"][-1]

    line = course(results.midplane("joint"))
    s = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    x = half * np.sin(np.linspace(0, np.pi / 2, MANY))
    normal = -peak * np.sqrt(np.maximum(1 - (x / half) ** 2, 0.0))
    places, normal = np.append(np.interp(x, line[:, 0], s), s[-1]), np.append(normal, 0.0)
    return Exact(curve, {"n": (places, normal), "t": ([0.0, s[-1]], [0.0, 0.0])})
