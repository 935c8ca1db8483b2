"""Bounds of a net of possible cracks, known before it is solved: modulus and force."""

import heapq
import math
from typing import Any

from .net import Net, Point, area_and_centroid


def stiffness(net: Net, scene: dict[str, Any]) -> tuple[float, float, float]:
    """Young's moduli of uniform stress along y and of uniform strain, plane stress and one Poisson's ratio."""
    whole = net.size**2
    share = sum(area_and_centroid(aggregate)[0] for aggregate in net.aggregates) / whole
    moduli = {name: scene["materials"][part["material"]]["young"] for name, part in scene["subdomains"].items()}
    shares = {"aggregates": share, "mortar": 1 - share}
    springs = 0.0
    for name, lines in (("rim", net.rims()), ("joint", net.joints())):
        law = scene["interfaces"][name]["law"]
        kn, kt = law["normal_stiffness"], law["tangential_stiffness"]
        for (x0, y0), (x1, y1) in lines:
            length = math.dist((x0, y0), (x1, y1))
            normal = (x1 - x0) / length
            springs += length * normal**2 * (normal**2 / kn + (1 - normal**2) / kt) / whole
    soft = 1 / (sum(shares[name] / moduli[name] for name in shares) + springs)
    return share, soft, sum(shares[name] * moduli[name] for name in shares)


def resistance(law: dict[str, Any], opening: float, slip: float) -> float:
    """Largest σ·opening + τ·slip within the hyperbola of a law; infinite where friction has no bound."""
    chi, c, tan_phi = law["tensile_strength"], law["cohesion"], law["tan_friction"]
    opening /= tan_phi
    if opening < abs(slip):
        return math.inf
    return c * opening - (c - chi * tan_phi) * math.sqrt(opening**2 - slip**2)


def weakest_path(net: Net, scene: dict[str, Any], direction: tuple[float, float]) -> float:
    """The least resistance, per thickness, to a motion of all above a path from the left to the right (Dijkstra)."""
    dx, dy = direction
    ways: dict[Point, list[tuple[Point, float]]] = {}
    for name, lines in (("rim", net.rims()), ("joint", net.joints())):
        for ends in lines:
            for start, end in (ends, ends[::-1]):
                along = end[0] - start[0], end[1] - start[1]  # what moves lies on the left of it
                opening, slip = dy * along[0] - dx * along[1], dx * along[0] + dy * along[1]
                ways.setdefault(start, []).append((end, resistance(scene["interfaces"][name]["law"], opening, slip)))
    queue = [(0.0, point) for point in ways if point[0] == 0]
    done = set()
    while queue:
        paid, point = heapq.heappop(queue)
        if point[0] == net.size:
            return paid
        if point in done:
            continue
        done.add(point)
        for end, price in ways[point]:
            if math.isfinite(price) and end not in done:
                heapq.heappush(queue, (paid + price, end))
    return math.inf


def tell(net: Net, scene: dict[str, Any], pressed: float) -> None:
    """Prints the bounds of a scene before it is solved."""
    share, soft, stiff = stiffness(net, scene)
    print(f"aggregates {100 * share:.1f} % of the area; modulus between {soft:.0f} and {stiff:.0f}")
    pull, push = (math.inf, 0), (math.inf, 0)
    for angle in range(1, 180):
        dx, dy = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        bound = weakest_path(net, scene, (dx, dy)) * scene.get("thickness", 1.0)
        pull = min(pull, (bound / dy, angle))
        push = min(push, ((bound + pressed * dy) / dx, angle)) if dx > 1e-9 else push
    print(f"pulled: force at most {pull[0]:.5g}, motion at {pull[1]}°")
    print(f"pushed under {pressed:g}: force at most {push[0]:.5g}, motion at {push[1]}°")
