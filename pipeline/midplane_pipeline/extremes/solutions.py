"""Exact solutions the rows are measured against, each with the scene that has it.

Side A lies below or inside, side B above or outside; n points from A to B; tension and opening are positive.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from midplane.vtu import Array

from .msh import Mesh, even, rectangle
from .program import Run
from .scenes import elastic, number, scene


def lame(e: float, nu: float, plane: str = "strain") -> tuple[float, float]:
    """λ of the plane state and μ."""
    return (e * nu / ((1 + nu) * (1 - 2 * nu)) if plane == "strain" else e * nu / (1 - nu * nu)), e / (2 * (1 + nu))


@dataclass
class Patch:
    """Constant stress of two materials along a straight joint, turned by θ, anywhere, of any size.

    n ↑  ┌──── B ────┐ 0.7     s_nn, s_nt and e_tt are common; on side i
      └→ ├───────────┤ 0       e_nn = (s_nn − λ e_tt) / (λ + 2μ),  u = (e_tt t + s_nt/μ n, e_nn n) in (t, n),
         └──── A ────┘ −0.5    and B adds (s_nt/K_T, s_nn/K_N)
    """

    e: tuple[float, float] = (1e4, 4e3)
    nu: tuple[float, float] = (0.2, 0.35)
    snn: float = -6.0
    snt: float = 2.5
    ett: float = 3e-4
    kn: float = 2e5
    kt: float = 5e4
    theta: float = 30.0
    size: float = 1.0
    origin: tuple[float, float] = (0.0, 0.0)
    heights: tuple[float, float] = (0.5, 0.7)
    plane: str = "strain"

    def parts(self, side: int) -> tuple[float, float, float, float, float]:
        """e_tt, shear strain, slip, e_nn and opening of a side."""
        (lam, mu), b = lame(self.e[side], self.nu[side], self.plane), float(side)
        shear = self.snt / mu
        opening = self.snn / self.kn if self.kn else 0.0
        slip = self.snt / self.kt if self.kt else 0.0
        return self.ett, shear, b * slip, (self.snn - lam * self.ett) / (lam + 2 * mu), b * opening

    def turn(self) -> tuple[float, float]:
        """Cosine and sine of θ."""
        return np.cos(np.radians(self.theta)), np.sin(np.radians(self.theta))

    def u(self, side: int, points: Array) -> Array:
        """Displacements of a side at points."""
        (cos, sin), (ett, shear, jt, enn, jn) = self.turn(), self.parts(side)
        x, y = (points - np.array(self.origin)).T
        t, n = cos * x + sin * y, cos * y - sin * x
        ut, un = ett * t + shear * n + jt, enn * n + jn
        return np.stack([cos * ut - sin * un, sin * ut + cos * un], -1)

    def formulas(self, side: int) -> list[str]:
        """The same as formulas of x and y."""
        (cos, sin), (ett, shear, jt, enn, jn) = self.turn(), self.parts(side)
        x, y = (f"({name} - {number(at)})" for name, at in zip("xy", self.origin, strict=True))
        # u = constant + gradient · (x, y)
        c = [cos * jt - sin * jn, sin * jt + cos * jn]
        rotation = np.array([[cos, -sin], [sin, cos]])
        gradient = rotation @ np.array([[ett, shear], [0.0, enn]]) @ rotation.T
        return [f"{number(c[d])} + {number(gradient[d, 0])}*{x} + {number(gradient[d, 1])}*{y}" for d in (0, 1)]

    def meshes(self, s_a: Any, s_b: Any, shape: str, rows: tuple[int, int] = (3, 4)) -> dict[str, Mesh]:
        """Bodies a and b; s: places along the joint from −0.5 to 0.5, or their number."""
        places = [even(-0.5, 0.5, s) if isinstance(s, int) else np.asarray(s) for s in (s_a, s_b)]
        cos, sin = self.turn()

        def to(s: Any, r: Any) -> tuple[Any, Any]:
            s, r = self.size * s, self.size * r
            return self.origin[0] + (cos * s - sin * r), self.origin[1] + (sin * s + cos * r)

        low, high = self.heights
        a = rectangle(places[0], even(-low, 0, rows[0]), shape, to)
        return {"a": a, "b": rectangle(places[1], even(0, high, rows[1]), shape, to)}

    def scene(self, **joint: Any) -> dict[str, Any]:
        """The exact displacement on the outer boundary."""
        groups = {0: ("left", "bottom", "right"), 1: ("left", "top", "right")}
        displace: dict[str, Any] = {}
        for side, body in enumerate("ab"):
            x, y = self.formulas(side)
            displace |= {f"{body}.{group}": {"x": x, "y": y} for group in groups[side]}
        return scene(
            {"a": (self.e[0], self.nu[0]), "b": (self.e[1], self.nu[1])},
            {"joint": ("a.top", "b.bottom", elastic(self.kn, self.kt), joint)},
            [{"displace": displace}],
            self.plane,
        )

    def sigma(self, side: int) -> Array:
        """Stress as a matrix in x, y."""
        (lam, mu), (cos, sin) = lame(self.e[side], self.nu[side], self.plane), self.turn()
        enn = self.parts(side)[3]
        stt = (lam + 2 * mu) * self.ett + lam * enn
        rotation = np.array([[cos, -sin], [sin, cos]])
        return rotation @ np.array([[stt, self.snt], [self.snt, self.snn]]) @ rotation.T

    def loaded(self, **joint: Any) -> dict[str, Any]:
        """The same under exact tractions, only the bottom held at its exact displacement. Where the joint is stiff, this is
        the scene that has an answer: displacements prescribed on both sides of a joint's end are known to ε u, hence the
        traction there to ε K u."""
        text = self.scene(**joint)
        step, normals = text["steps"][0], {"left": (-1, 0), "right": (1, 0), "top": (0, 1)}
        cos, sin = self.turn()
        load = {}
        for group in [group for group in step["displace"] if group != "a.bottom"]:
            nt, nn = normals[group[2:]]
            normal = np.array([cos * nt - sin * nn, sin * nt + cos * nn])
            load[group] = {"traction": (self.sigma("ab".index(group[0])) @ normal).tolist()}
            del step["displace"][group]
        step["load"] = load
        return text

    def errors(self, run: Run) -> tuple[float, float]:
        """Relative errors of displacement and traction."""
        bodies = [(side, run.points(body), run.displacement(body)) for side, body in enumerate("ab")]
        exact = [self.u(side, points) for side, points, _ in bodies]
        scale = max(np.abs(u).max() for u in exact)
        u = max(np.abs(got - u).max() for (_, _, got), u in zip(bodies, exact, strict=True)) / scale
        t = run.traction()
        return u, np.abs(t - [self.snn, self.snt]).max() / max(abs(self.snn), abs(self.snt))


@dataclass
class Bending:
    """Linear traction s_m + s_g x/a along y = 0, −a < x < a, quadratic displacement (plane stress, one material)."""

    e: float = 1e4
    nu: float = 0.2
    a: float = 0.1
    heights: tuple[float, float] = (0.1, 0.15)
    sm: float = -5.0
    sg: float = 4.0
    kn: float = 1e5

    def coefficients(self, side: int) -> tuple[float, float, float, float]:
        """Axial strain, curvature, and the joint's rotation and opening of a side."""
        e, k, w = self.sm / self.e, self.sg / (self.a * self.e), side * self.sg / (self.a * self.kn)
        return e, k, w, side * self.sm / self.kn

    def u(self, side: int, points: Array) -> Array:
        """Displacements of a side at points."""
        (e, k, w, jump), (x, y) = self.coefficients(side), points.T
        return np.stack(
            [
                -self.nu * e * x - 0.5 * k * (y * y + self.nu * x * x) - w * y,
                e * y + k * x * y + jump + w * x,
            ],
            -1,
        )

    def meshes(self, n_a: int, n_b: int, shape: str, rows: tuple[int, int] = (2, 3)) -> dict[str, Mesh]:
        """Bodies a and b."""
        low, high = self.heights
        a = rectangle(even(-self.a, self.a, n_a), even(-low, 0, rows[0]), shape)
        return {"a": a, "b": rectangle(even(-self.a, self.a, n_b), even(0, high, rows[1]), shape)}

    def scene(self, **joint: Any) -> dict[str, Any]:
        """The exact displacement on the outer boundary."""
        displace: dict[str, Any] = {}
        for side, (body, groups) in enumerate({"a": ("left", "bottom", "right"), "b": ("left", "top", "right")}.items()):
            e, k, w, jump = map(number, self.coefficients(side))
            nu = number(self.nu)
            x = f"-{nu}*{e}*x - 0.5*{k}*(y*y + {nu}*x*x) - {w}*y"
            y = f"{e}*y + {k}*x*y + {jump} + {w}*x"
            displace |= {f"{body}.{group}": {"x": x, "y": y} for group in groups}
        law = elastic(self.kn)
        materials = {"a": (self.e, self.nu), "b": (self.e, self.nu)}
        joints = {"joint": ("a.top", "b.bottom", law, joint)}
        return scene(materials, joints, [{"displace": displace}], "stress")

    def errors(self, run: Run) -> tuple[float, float]:
        """Relative errors of displacement and traction."""
        exact = [self.u(side, run.points(body)) for side, body in enumerate("ab")]
        scale = max(np.abs(u).max() for u in exact)
        u = max(np.abs(run.displacement(body) - exact[side]).max() for side, body in enumerate("ab")) / scale
        joint = run.joint()
        normal = self.sm + self.sg * joint["place"][:, 0] / self.a
        t = max(np.abs(joint["traction"][:, 0] - normal).max(), np.abs(joint["traction"][:, 1]).max())
        return u, t / (abs(self.sm) + abs(self.sg))


def exponential(matrix: Array) -> Array:
    """exp of a small matrix: Taylor's series after halving, then squares."""
    halvings = max(0, int(np.ceil(np.log2(np.abs(matrix).sum(1).max()))) + 1)
    term = total = np.eye(len(matrix))
    for i in range(1, 25):
        term = term @ matrix / (i * 2.0**halvings)
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


@dataclass
class Strip:
    """Two layers, the lower clamped below, under σ_yy = −p₀ cos kx on top; x from 0 to π/k between symmetry planes.

    u_x = P(y) sin kx, u_y = Q(y) cos kx; (P, Q, P′, Q′) obeys a constant linear system in every layer. The strain energy
    of bodies and joint per thickness is p₀ |Q_top| L/4.
    """

    e: tuple[float, float] = (1e4, 4e3)
    nu: tuple[float, float] = (0.2, 0.3)
    h: tuple[float, float] = (0.8, 0.6)
    k: float = np.pi
    kn: float = 2e4
    kt: float = 1e4
    p0: float = 5.0
    plane: str = "strain"

    @property
    def length(self) -> float:
        """Half a wave."""
        return np.pi / self.k

    def solve(self) -> dict[str, float]:
        """Amplitudes: Q on the top, normal and shear traction of the joint."""
        k, layers = self.k, [lame(e, nu, self.plane) for e, nu in zip(self.e, self.nu, strict=True)]

        def system(layer: int) -> Array:
            lam, mu = layers[layer]
            c = lam + 2 * mu
            return np.array(
                [
                    [0, 0, 1, 0],
                    [0, 0, 0, 1],
                    [c * k * k / mu, 0, 0, k * (lam + mu) / mu],
                    [0, mu * k * k / c, -k * (lam + mu) / c, 0],
                ]
            )

        def traction(layer: int) -> Array:
            lam, mu = layers[layer]
            return np.array([[0, -k * mu, mu, 0], [lam * k, 0, 0, lam + 2 * mu]])

        below = exponential(system(0) * self.h[0])[:, 2:]
        t = traction(0) @ below
        compliance = np.diag([0 if np.isinf(s) else 1 / s for s in (self.kt, self.kn)])
        u = below[:2] + compliance @ t
        lam, mu = layers[1]
        above = np.vstack([u, t[0] / mu + k * u[1], (t[1] - lam * k * u[0]) / (lam + 2 * mu)])
        top = exponential(system(1) * self.h[1]) @ above
        scale = max(self.e)
        slopes = np.linalg.solve(traction(1) @ top / scale, np.array([0.0, -self.p0]) / scale)
        shear, normal = t @ slopes
        return {"q_top": (top @ slopes)[1], "normal": normal, "shear": shear}

    def energy(self) -> float:
        """Strain energy of bodies and joint."""
        return self.p0 * abs(self.solve()["q_top"]) * self.length / 4

    def meshes(self, s_a: Any, s_b: Any, shape: str, rows: tuple[int, int]) -> dict[str, Mesh]:
        """Bodies a and b; s: places along the joint as fractions of the length, or their number."""
        s = [even(0, 1, n) if isinstance(n, int) else np.asarray(n) for n in (s_a, s_b)]
        s = [np.where(x == 1, self.length, x * self.length) for x in s]
        a = rectangle(s[0], even(-self.h[0], 0, rows[0]), shape)
        return {"a": a, "b": rectangle(s[1], even(0, self.h[1], rows[1]), shape)}

    def scene(self, **joint: Any) -> dict[str, Any]:
        """The strip between its symmetry planes, under the pressure."""
        sides = {f"{body}.{side}": ["x"] for body in "ab" for side in ("left", "right")}
        step = {
            "fix": {**sides, "a.bottom": ["x", "y"]},
            "load": {"b.top": {"pressure": f"{number(self.p0)}*cos({number(self.k)}*x)"}},
        }
        return scene(
            {"a": (self.e[0], self.nu[0]), "b": (self.e[1], self.nu[1])},
            {"joint": ("a.top", "b.bottom", elastic(self.kn, self.kt), joint)},
            [step],
            self.plane,
            output={"history": {"stored": "energy.stored"}},
        )

    def errors(self, run: Run) -> tuple[float, float]:
        """Relative errors of the stored energy, and of the normal traction in L2."""
        joint, exact = run.joint(), self.solve()
        got, w = joint["traction"][:, 0], joint["length"].ravel()
        normal = exact["normal"] * np.cos(self.k * joint["place"][:, 0])
        t = np.sqrt((w * (got - normal) ** 2).sum() / (w * normal**2).sum())
        return run.history()["stored"][-1] / self.energy() - 1, t
