"""Draw concrete at the meso scale: polygons of aggregate in mortar, and the lines along which it may crack.

From a seed, always the same: a honeycomb of `rows` × `columns` cells in a square, its corners moved at random; an aggregate in each cell,
the cell shrunk about its centroid, by a random factor. Joints run through the mortar from corner to corner of the aggregates whose cells
meet there, and straight to the face where the cells meet on a face. So joints and sides of aggregates make one net of possible cracks.

Writes FOLDER/aggregates.geo and FOLDER/mortar.geo, meshed apart. With --scene, a scene of theirs, it says what is known of it instead,
before it is solved:

  modulus    between that of uniform stress (Reuss, with the springs of the interfaces) and that of uniform strain (Voigt)
  forces     at most those that the weakest path of the net resists when all above it moves in one direction: tractions are within the
             hyperbolas of the law, which only shrink, so Fx dx + Fy dy ≤ ∫ max(t · d) ds whatever the equilibrium
"""

import argparse
import heapq
import math
import random
from pathlib import Path

from midplane import scene_file

WALL = 0.25  # shift of the walls of a row, of a cell's width: rows lie in bond
PEAK = 0.12  # of a cell's roof above its mean, of a cell's height
MOVE = 0.12  # corners move by up to this share of a cell
SHRINK = (0.62, 0.78)  # size of an aggregate in its cell
SHORTEST = 0.08  # line of the net, of a cell: with a shorter one, or an aggregate that is not convex, all is drawn again


class Net:
    """Corners of the cells as points, cells as lists of corners counter-clockwise, the corner of aggregate a at a corner of its cell."""

    def __init__(self, rows, columns, size, seed):
        self.size, self.random = size, random.Random(seed)
        self.draw(rows, columns)
        while not self.fits(SHORTEST * size / max(rows, columns)):
            self.draw(rows, columns)

    def draw(self, rows, columns):
        self.corners, self.cells = [], []
        self.honeycomb(rows, columns)
        self.aggregates = [shrink([self.corners[c] for c in cell], self.random.uniform(*SHRINK)) for cell in self.cells]
        self.at = {(a, c): p for a, cell in enumerate(self.cells) for c, p in zip(cell, self.aggregates[a], strict=True)}

    def fits(self, shortest):
        """True if all aggregates are convex and no line is too short."""
        lines = [*self.rims(), *self.joints()]
        return all(map(is_convex, self.aggregates)) and min(math.dist(*ends) for ends in lines) >= shortest

    def honeycomb(self, rows, columns):
        """Levels between the rows, from below; on each the feet of the walls above it and the tops of those below it."""
        width, height = self.size / columns, self.size / rows
        shifts = [WALL if row % 2 else -WALL for row in range(rows)]
        levels = []
        for level in range(rows + 1):
            inner = 0 < level < rows
            above = [(i + shifts[level], PEAK, ("foot", i)) for i in range(1, columns)] if level < rows else []
            below = [(i + shifts[level - 1], -PEAK, ("top", i)) for i in range(1, columns)] if level > 0 else []
            places = {}
            line = [(0, 0, ("end", 0)), *sorted(above + below), (columns, 0, ("end", columns))]
            for order, (x, y, name) in enumerate(line):
                places[name] = order
                across = self.moved() if inner and name[0] != "end" else 0.0
                along = self.moved() if inner else 0.0
                self.corners.append(((x + across) * width, (level + y * inner + along) * height))
            levels.append((len(self.corners) - len(line), places))

        def part(level, name, i):
            """Corners of a level from wall i to the next."""
            first, places = levels[level]
            ends = [places.get((name, wall), places.get(("end", wall))) for wall in (i, i + 1)]
            return list(range(first + ends[0], first + ends[1] + 1))

        for row in range(rows):
            for i in range(columns):
                self.cells.append(part(row, "foot", i) + part(row + 1, "top", i)[::-1])

    def moved(self):
        return self.random.uniform(-MOVE, MOVE)

    def faces(self, corner):
        """Number of faces of the square on which a corner of the cells lies."""
        return sum(value in (0, self.size) for value in self.corners[corner])

    def around(self, corner):
        """The aggregates whose cells meet at a corner."""
        return [a for a, cell in enumerate(self.cells) if corner in cell]

    def foot(self, a, corner):
        """The point of the face that is nearest to an aggregate, where its cell has a corner on the face."""
        return tuple(
            outside if outside in (0, self.size) else inside
            for outside, inside in zip(self.corners[corner], self.at[a, corner], strict=True)
        )

    def sides(self):
        """Sides of the cells, from corner to corner, each with the cell on its left and the one on its right, None at a face."""
        owner = {side: a for a, cell in enumerate(self.cells) for side in pairs(cell)}
        for (start, end), a in owner.items():
            other = owner.get((end, start))
            if other is None or a < other:
                yield start, end, a, other

    def inner(self):
        """Corners of the cells where three meet, with these."""
        return [(c, self.around(c)) for c in range(len(self.corners)) if self.faces(c) == 0]

    def joints(self):
        """Joints in the mortar, as pairs of points."""
        for corner, near in self.inner():
            yield from pairs([self.at[a, corner] for a in near])
        for corner in range(len(self.corners)):
            if self.faces(corner) == 1:
                yield from ((self.at[a, corner], self.foot(a, corner)) for a in self.around(corner))

    def face(self, start, end):
        """The face of the square on which two points lie."""
        for axis, names in enumerate((("left", "right"), ("bottom", "top"))):
            if start[axis] == end[axis] and start[axis] in (0, self.size):
                return names[start[axis] > 0]
        raise ValueError(f"{start} and {end} lie on no face")

    def rims(self):
        """Sides of the aggregates, as pairs of points."""
        for aggregate in self.aggregates:
            yield from pairs(aggregate)


def pairs(loop):
    """Neighbours in a loop."""
    return zip(loop, loop[1:] + loop[:1], strict=True)


def is_convex(polygon):
    """True if a polygon that runs counter-clockwise turns left at every point."""
    ways = [(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in pairs(polygon)]
    return all(dx0 * dy1 - dy0 * dx1 > 0 for (dx0, dy0), (dx1, dy1) in pairs(ways))


def area_and_centroid(polygon):
    crosses = [(x0 * y1 - x1 * y0, x0 + x1, y0 + y1) for (x0, y0), (x1, y1) in pairs(polygon)]
    area = sum(cross for cross, _, _ in crosses) / 2
    return area, [sum(c * s[axis] for c, *s in crosses) / (6 * area) for axis in (0, 1)]


def shrink(polygon, factor):
    """A polygon about its centroid; points as they are written."""
    _, centre = area_and_centroid(polygon)
    return [tuple(round(c + factor * (v - c), 6) for v, c in zip(point, centre, strict=True)) for point in polygon]


class Geo:
    """A .geo under construction: points and lines once each, surfaces, groups."""

    def __init__(self, head, edge):
        self.text = [head, f'DefineConstant[ edge  = {{{edge}, Name "Length of the edges [m]"}} ];']
        self.text += ['DefineConstant[ order = {1, Name "Order of the elements, 1 or 2"} ];', ""]
        self.points, self.lines, self.surfaces = {}, {}, 0

    def point(self, place):
        if place not in self.points:
            self.points[place] = len(self.points) + 1
            self.text.append(f"Point({self.points[place]}) = {{{place[0]:.6f}, {place[1]:.6f}, 0, edge}};")
        return self.points[place]

    def line(self, start, end):
        """Number of a line, negative the other way."""
        key = self.point(start), self.point(end)
        if key[::-1] in self.lines:
            return -self.lines[key[::-1]]
        if key not in self.lines:
            self.lines[key] = len(self.lines) + 1
            self.text.append(f"Line({self.lines[key]}) = {{{key[0]}, {key[1]}}};")
        return self.lines[key]

    def surface(self, loop):
        lines = [self.line(*ends) for ends in pairs(loop)]
        self.surfaces += 1
        self.text.append(f"Curve Loop({self.surfaces}) = {{{', '.join(map(str, lines))}}};")
        self.text.append(f"Plane Surface({self.surfaces}) = {{{self.surfaces}}};")

    def group(self, kind, name, members):
        self.text.append(f'Physical {kind}("{name}") = {{{", ".join(str(abs(member)) for member in members)}}};')

    def write(self, path):
        self.text.append(f'Physical Surface("body") = {{1:{self.surfaces}}};')
        path.write_text("\n".join([*self.text, "Mesh.ElementOrder = order;", ""]))


HEAD = "// Made by pipeline/aggregate.py with seed {seed}; change that, not this.\n"

AGGREGATES = """// Concrete at the meso scale: the aggregates, {count} polygons.
//
//    +---------------+
//    |  ___     ___  |
//    | |   |   |   | |     every polygon is meshed by itself, and apart from the mortar
//    | |___|   |___| |
//    |    _______    |     the square of the mortar, x = y = 0 in its lower left corner
//    |   |       |   |
//    +---------------+
//
// Physical groups: body (surface).
//
"""

MORTAR = """// Concrete at the meso scale: the mortar between the aggregates, one body that joints cut into pieces.
//
//            top
//    +-----|---|-----+
//    |  ___|   |___  |
//    | | o |   | o | |     o: holes of the aggregates
//    |-|___|___|___|-|     joint: between corners of aggregates that look at each other, three in a triangle,
//    |     \\   /     |            and straight to a face
//    |    __\\_/__    |
//    |   |   o   |   |
//    +---|-------|---+
//  corner  bottom          x = y = 0 in corner
//
// Physical groups: joint, bottom, top (curves), corner (point), body (surface).
//
"""


def write_aggregates(net, seed, path):
    geo = Geo(AGGREGATES.format(count=len(net.aggregates)) + HEAD.format(seed=seed), 0.006)
    for aggregate in net.aggregates:
        geo.surface(aggregate)
    geo.write(path)


def write_mortar(net, seed, path):
    """A piece of mortar along every side of a cell, between two aggregates or one and a face, and a triangle where three cells meet."""
    geo = Geo(MORTAR + HEAD.format(seed=seed), 0.004)
    faces = {"bottom": [], "right": [], "top": [], "left": []}
    for start, end, a, b in net.sides():
        ends = [net.at[a, end], net.at[a, start]]
        if b is None:
            beside = [net.corners[c] if net.faces(c) == 2 else net.foot(a, c) for c in (start, end)]
            geo.surface(ends + beside)
            faces[net.face(*beside)].append(geo.line(*beside))
            continue
        feet = {c: [net.foot(a, c), net.foot(b, c)] if net.faces(c) else [] for c in (start, end)}
        geo.surface([*ends, *feet[start], net.at[b, start], net.at[b, end], *feet[end][::-1]])
        for pair in filter(None, feet.values()):
            faces[net.face(*pair)].append(geo.line(*pair))
    for corner, near in net.inner():
        triangle = [net.at[a, corner] for a in near]
        geo.surface(triangle if area_and_centroid(triangle)[0] > 0 else triangle[::-1])
    geo.group("Curve", "joint", [geo.line(*ends) for ends in net.joints()])
    for name in ("bottom", "top"):
        geo.group("Curve", name, faces[name])
    geo.group("Point", "corner", [geo.point((0.0, 0.0))])
    geo.write(path)


def stiffness(net, scene):
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


def resistance(law, opening, slip):
    """Largest σ·opening + τ·slip within the hyperbola of a law; infinite where friction has no bound."""
    chi, c, tan_phi = law["tensile_strength"], law["cohesion"], law["tan_friction"]
    opening /= tan_phi
    if opening < abs(slip):
        return math.inf
    return c * opening - (c - chi * tan_phi) * math.sqrt(opening**2 - slip**2)


def weakest_path(net, scene, direction):
    """The least resistance, per thickness, to a motion of all above a path from the left to the right (Dijkstra)."""
    dx, dy = direction
    ways = {}
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where to write, such as geo/aggregate")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default: %(default)s)")
    parser.add_argument("--rows", type=int, default=4, help="of aggregates (default: %(default)s)")
    parser.add_argument("--columns", type=int, default=4, help="of aggregates (default: %(default)s)")
    parser.add_argument("--size", type=float, default=0.1, help="of the square [m] (default: %(default)s)")
    parser.add_argument("--scene", type=Path, help="a scene file whose bounds to print, in place of writing")
    parser.add_argument("--pressed", type=float, default=0.05, help="force that presses what is pushed (default: %(default)s)")
    arguments = parser.parse_args()
    net = Net(arguments.rows, arguments.columns, arguments.size, arguments.seed)
    if arguments.scene:
        tell(net, scene_file.read(arguments.scene), arguments.pressed)
    else:
        write_aggregates(net, arguments.seed, arguments.folder / "aggregates.geo")
        write_mortar(net, arguments.seed, arguments.folder / "mortar.geo")


def tell(net, scene, pressed):
    """What is known of a scene before it is solved."""
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


if __name__ == "__main__":
    main()
