"""A ring of segments in ground that is let go by a share before it comes and the rest after: the exact elastic solution.

Harmonics 0 and 2 of a ring a < r < b, free inside, joined by springs K_N, K_T to ground b < r < R held on its outer edge.
Radial joints that are stiff and pressed are no more than sections of the ring. Airy terms r², r⁴, r⁻², r⁰ in each; plane strain.

    python -m midplane_pipeline.exact.lining geo/lining/scene.json     N, M, V at every joint, as options for midplane_pipeline.check
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from midplane import scene_file
from midplane.pictures.results import Results
from midplane.pictures.traction import distances
from midplane.vtu import Array

from midplane_pipeline.results.told import told

from .solution import Exact

# tolerances of N [MN/m], M [MN], V [MN/m] and displacements [m]
NEAR = {"N": 1e-4, "M": 2e-5, "V": 2e-5, "u": 1e-6}


class Harmonics:
    """Stress and displacement of a body as rows of matrices over its unknowns, at a radius."""

    def __init__(self, material: dict[str, Any]) -> None:
        young, nu = material["young"], material["poisson"]
        self.mu, self.kappa = young / (2 * (1 + nu)), 3 - 4 * nu
        self.bulk = young / ((1 + nu) * (1 - 2 * nu))  # 2 (λ + μ)

    def even(self, r: float) -> Array:
        """Harmonic 0, unknowns A r + B/r: σ_rr, σ_θθ, u_r."""
        ring = 2 * self.mu / r**2
        return np.array([[self.bulk, -ring], [self.bulk, ring], [r, 1 / r]])

    def second(self, r: float) -> Array:
        """Harmonic 2, unknowns of r², r⁴, r⁻², r⁰: σ_rr, σ_θθ, u_r (cos 2θ), σ_rθ, u_θ (sin 2θ)."""
        q, k, m = r**2, self.kappa, 2 * self.mu
        return np.array(
            [
                [-2, 0, -6 / q**2, -4 / q],
                [2, 12 * q, 6 / q**2, 0],
                [-2 * r / m, (k - 3) * r**3 / m, 2 / (m * r**3), (k + 1) / (m * r)],
                [2, 6 * q, -6 / q**2, -2 / q],
                [2 * r / m, (k + 3) * r**3 / m, 2 / (m * r**3), -(k - 1) / (m * r)],
            ]
        )


def solve(rows: Any, right: Any) -> Array:
    """Rows and columns of very different size are scaled first."""
    rows, right = np.array(rows, float), np.array(right, float)
    size = np.abs(rows).max(axis=0)
    tall = np.abs(rows / size).max(axis=1)
    return np.linalg.solve(rows / size / tall[:, None], right / tall) / size


class Lining:
    """The solution of a scene: `radii` inner, outer and of the far edge, `share` let go before the lining is there."""

    def __init__(self, scene: dict[str, Any], radii: Sequence[float]) -> None:
        self.inner, self.outer, self.far = radii
        materials, stress = scene["materials"], scene["subdomains"]["ground"]["initial_stress"]
        springs = scene["interfaces"]["back"]["law"]
        self.share = next(step["deactivate"]["core"] for step in scene["steps"] if "deactivate" in step)
        mean, half = 0.5 * (stress["xx"] + stress["yy"]), 0.5 * (stress["xx"] - stress["yy"])
        self.ring, self.ground = Harmonics(materials["concrete"]), Harmonics(materials["ground"])
        # dug: the wall loses a share of its traction
        b, far = self.outer, self.far
        here, held = self.ground.even(b), self.ground.even(far)
        self.dug0 = solve([here[0], held[2]], [-self.share * mean, 0])
        here, held = self.ground.second(b), self.ground.second(far)
        self.dug2 = solve([here[0], here[3], held[2], held[4]], [-self.share * half, self.share * half, 0, 0])
        # lined: tractions of ring and ground are one, and as large as their springs make them; the rest of σ₀ goes
        rest = 1 - self.share
        lined: dict[str, tuple[Array, Array]] = {}
        kn, kt = springs["normal_stiffness"], springs["tangential_stiffness"]
        for harmonic, normal, shear in (("even", rest * mean, None), ("second", rest * half, -rest * half)):
            rows: list[Array] = []
            right: list[float] = []
            free, ring = (getattr(self.ring, harmonic)(r) for r in (self.inner, b))
            wall, held = (getattr(self.ground, harmonic)(r) for r in (b, far))
            none = np.zeros(len(free[0]))

            def equation(of_ring: Array, of_ground: Array, value: float, rows: Any = rows, right: Any = right) -> None:
                rows.append(np.concatenate([of_ring, of_ground]))
                right.append(value)

            for stress, move, stiffness, value in ((0, 2, kn, normal), (3, 4, kt, shear)):
                if value is None:
                    continue
                equation(free[stress], none, 0)
                equation(ring[stress], -wall[stress], value)
                equation(ring[stress] + stiffness * ring[move], -stiffness * wall[move], 0)
                equation(none, held[move], 0)
            unknowns = solve(rows, right)
            lined[harmonic] = unknowns[: len(none)], unknowns[len(none) :]
        (self.of_ring_even, self.of_ground_even), (self.of_ring_second, self.of_ground_second) = lined["even"], lined["second"]

    def stress(self, r: float, angle: float) -> tuple[float, float, float]:
        """σ_rr, σ_θθ, σ_rθ in the ring."""
        even = self.ring.even(r) @ self.of_ring_even
        second = self.ring.second(r) @ self.of_ring_second
        c, s = np.cos(2 * angle), np.sin(2 * angle)
        return even[0] + second[0] * c, even[1] + second[1] * c, second[3] * s

    def section(self, angle: float) -> Array:
        """N, M (positive with tension outside) and V over the thickness."""
        points, weights = np.polynomial.legendre.leggauss(12)
        half, middle = 0.5 * (self.outer - self.inner), 0.5 * (self.outer + self.inner)
        total = np.zeros(3)
        for point, weight in zip(points, weights, strict=True):
            _, hoop, shear = self.stress(middle + half * point, angle)
            total += half * weight * np.array([hoop, hoop * half * point, shear])
        return total

    def wall(self, angle: float, lined: bool = True) -> float:
        """Radial displacement of the wall, after it is dug or lined and let go."""
        even, second = self.dug0, self.dug2
        if lined:
            even, second = even + self.of_ground_even, second + self.of_ground_second
        amplitude = self.ground.second(self.outer)[2] @ second
        return self.ground.even(self.outer)[2] @ even + amplitude * np.cos(2 * angle)


def of_scene(path: Path) -> tuple[Lining, dict[str, float]]:
    """The solution, and the angle of every joint by the numbers of its two segments."""
    scene = scene_file.read(path)
    segment, ground = (scene_file.constants(path.parent / name) for name in ("segment.geo", "ground.geo"))
    outer = segment["radius"]
    solution = Lining(scene, (outer - segment["thickness"], outer, outer * ground["extent"]))
    parts = {name[-1]: part["parameters"] for name, part in scene["subdomains"].items() if name.startswith("segment")}
    starts = {part["from"] % 360: number for number, part in parts.items()}
    ends = {number: part["to"] % 360 for number, part in parts.items()}
    joints = {"".join(sorted((first, starts[to]))): np.radians(to) for first, to in ends.items()}
    return solution, joints


def lining(scene: dict[str, Any], results: Results) -> Any:
    """Tractions of every joint of the lining at its law points, keyed INTERFACE.n and INTERFACE.t."""
    points = results.subdomains["segment1"].points[:, :2]
    radii = np.hypot(*points.T)
    far = np.hypot(*results.subdomains["ground"].points[:, :2].T).max()
    solution, traction = Lining(scene, (radii.min(), radii.max(), far)), {}
    for name, field in results.interfaces.items():
        if name.startswith("rim"):
            continue
        (x, y), normal = field.points[:, :2].T, field["normal"][:, :2]
        angle = np.arctan2(y, x)
        radius = np.full_like(x, solution.outer) if name.startswith("back") else np.hypot(x, y)
        radial, hoop, shear = np.transpose([solution.stress(*place) for place in zip(radius, angle, strict=True)])
        outward = np.column_stack([np.cos(angle), np.sin(angle)])
        across = np.column_stack([-outward[:, 1], outward[:, 0]])
        tangent = np.column_stack([normal[:, 1], -normal[:, 0]])  # n is on its left
        (nr, nc), (tr, tc) = ([(direction * other).sum(axis=1) for other in (outward, across)] for direction in (normal, tangent))
        s = distances(results, name)
        traction[f"{name}.n"] = s, nr * nr * radial + 2 * nr * nc * shear + nc * nc * hoop
        traction[f"{name}.t"] = s, nr * tr * radial + (nr * tc + nc * tr) * shear + nc * tc * hoop
    return Exact({}, traction)


def main() -> None:
    """The command."""
    solution, joints = of_scene(Path(sys.argv[1]))
    top, side = np.pi / 2, 0.0
    print(f"--expect=crown@end:dig={solution.wall(top, False):.9g}~{NEAR['u']:g}")
    print(f"--expect=side@end:dig={solution.wall(side, False):.9g}~{NEAR['u']:g}")
    print(f"--expect=crown={solution.wall(top):.9g}~{NEAR['u']:g}")
    print(f"--expect=side={solution.wall(side):.9g}~{NEAR['u']:g}")
    print(f"--expect=pressure at crown={solution.stress(solution.outer, top)[0]:.9g}~5e-5")
    for name, angle in joints.items():
        for force, value in zip("NMV", solution.section(angle), strict=True):
            print(f"--expect={force}{name}={value:.9g}~{NEAR[force]:g}")


if __name__ == "__main__":
    told(main)
