"""Bond–slip of a bar on a rigid base, linear to the strength and linear down to nothing: the whole range in closed form.

E t d²s/dx² = τ(s) with τ = τ_f s/s_1 up to s_1, τ_f (s_f − s)/(s_f − s_1) up to s_f = 2 G/τ_f, then 0, and no strain at the
free end x = 0 (Yuan, Teng, Seracino, Wu and Yao 2004 for stages of it). The slip of the free end grows all the way, force and
slip of the pulled end rise and fall.
"""

from typing import Any

import numpy as np
from midplane.pictures.results import Results
from midplane.vtu import Array

from .solution import MANY, Curve, Exact, sizes


class Bond:
    """A bar of stiffness E t [force / width] and length L; slips s_1 and s_f, strength τ_f."""

    def __init__(self, rigidity: float, length: float, strength: float, first: float, last: float) -> None:
        self.rigidity, self.length, self.strength = rigidity, length, strength
        self.first, self.last = first, last
        self.rising = np.sqrt(strength / (first * rigidity))  # λ_1
        self.falling = np.sqrt(strength / ((last - first) * rigidity))  # λ_2

    def slip(self, free: float, x: Array) -> tuple[Array, Array]:
        """Slip and strain at x [array] where the free end has slipped by `free`."""
        rise, fall, drop = self.rising, self.falling, self.last - self.first
        if free < self.first:
            reach = np.arccosh(self.first / free) / rise  # x where the strength is met
            slope, start = rise * np.sqrt(self.first**2 - free**2), self.first
        else:
            reach, slope, start = 0.0, 0.0, free
        elastic = np.minimum(x, reach)
        s, strain = free * np.cosh(rise * elastic), free * rise * np.sinh(rise * elastic)
        gone = np.pi / (2 * fall) if slope == 0 else np.arctan(drop * fall / slope) / fall  # length that softens
        y, rest = np.clip(x - reach, 0, gone), np.maximum(x - reach - gone, 0)
        left = self.last - start
        soft = self.last - left * np.cos(fall * y) + slope / fall * np.sin(fall * y)
        steep = left * fall * np.sin(fall * y) + slope * np.cos(fall * y)
        here = x >= reach
        s, strain = np.where(here, soft, s), np.where(here, steep, strain)
        return s + strain * rest, strain

    def shear(self, s: Any) -> Array:
        """Bond stress at a slip."""
        falling = self.strength * (self.last - s) / (self.last - self.first)
        return np.where(s < self.first, self.strength * s / self.first, np.maximum(falling, 0.0))


def of_scene(scene: dict[str, Any], results: Results) -> tuple[Bond, float]:
    """The bond of a scene, and its width."""
    law, step = scene["interfaces"]["bond"]["law"], scene["steps"][-1]
    name = next(group for group in step["displace"]).partition(".")[0]
    length, tall = sizes(results.subdomains[name])
    strength, energy = law["shear_strength"], law["fracture_energy_ii"]
    young = scene["materials"][scene["subdomains"][name]["material"]]["young"]
    bond = Bond(young * tall, length, strength, strength / law["tangential_stiffness"], 2 * energy / strength)
    return bond, scene.get("thickness", 1.0)


def pull_out(scene: dict[str, Any], results: Results) -> Any:
    """Force and slip of both ends from the first pull until nothing is bonded; bond stress at the end of the run."""
    bond, width = of_scene(scene, results)
    # far from the pulled end slips are tiny first
    low = bond.first / np.cosh(bond.rising * bond.length)
    tail = bond.last - bond.last * np.geomspace(0.5, 1e-9, MANY)
    free = np.concatenate([np.geomspace(low / 100, bond.last / 2, MANY), tail])
    pulled, strain = np.transpose([bond.slip(slip, np.array(bond.length)) for slip in free])
    force = width * bond.rigidity * strain
    end = next(iter(scene["steps"][-1]["displace"].values()))["x"]
    curve = {
        "displacement": np.concatenate([[0.0], pulled, [bond.last, max(end, bond.last)]]),
        "displacement_free": np.concatenate([[0.0], free, [bond.last, max(end, bond.last)]]),
        "force": np.concatenate([[0.0], force, [0.0, 0.0]]),
    }
    limit = width * np.sqrt(bond.strength * bond.last * bond.rigidity)
    levels = [(limit, f"$b\\,\\sqrt{{2\\,G\\,E\\,t}}$, {limit:.0f}: no equilibrium above")]
    s = np.linspace(0, bond.length, MANY)
    return Exact(curve, traction_at_the_end(bond, end, s), levels=levels)


def traction_at_the_end(bond: Bond, end: float, s: Array) -> dict[str, Curve]:
    """Bond stress over the length where the pulled end has reached `end` before it turns back; none where the bond is lost."""
    slips = np.geomspace(1e-9 * bond.first, 0.999 * bond.last, MANY)
    pulled = np.array([bond.slip(slip, np.array(bond.length))[0] for slip in slips])
    turn = pulled.argmax()
    if end > pulled[turn]:  # there the path has gone back and on without force
        return {}
    low, high = slips[0], slips[turn]
    for _ in range(200):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if bond.slip(middle, np.array(bond.length))[0] < end else (low, middle)
    slip, _ = bond.slip(low, s)
    return {"n": (s, np.zeros_like(s)), "t": (s, bond.shear(slip))}
