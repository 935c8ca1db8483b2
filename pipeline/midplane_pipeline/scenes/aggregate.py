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
from pathlib import Path

from midplane import scene_file

from .bounds import tell
from .net import Net, Point, area_and_centroid, pairs

HEAD = "// Made by midplane_pipeline.scenes.aggregate with seed {seed}; change that, not this.\n"

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


class Geo:
    """A .geo under construction: points and lines once each, surfaces, groups."""

    def __init__(self, head: str, edge: float) -> None:
        self.text = [head, f'DefineConstant[ edge  = {{{edge}, Name "Length of the edges [m]"}} ];']
        self.text += ['DefineConstant[ order = {1, Name "Order of the elements, 1 or 2"} ];', ""]
        self.points: dict[Point, int] = {}
        self.lines: dict[tuple[int, int], int] = {}
        self.surfaces = 0

    def point(self, place: Point) -> int:
        """Number of a point."""
        if place not in self.points:
            self.points[place] = len(self.points) + 1
            self.text.append(f"Point({self.points[place]}) = {{{place[0]:.6f}, {place[1]:.6f}, 0, edge}};")
        return self.points[place]

    def line(self, start: Point, end: Point) -> int:
        """Number of a line, negative the other way."""
        key = self.point(start), self.point(end)
        if key[::-1] in self.lines:
            return -self.lines[key[::-1]]
        if key not in self.lines:
            self.lines[key] = len(self.lines) + 1
            self.text.append(f"Line({self.lines[key]}) = {{{key[0]}, {key[1]}}};")
        return self.lines[key]

    def surface(self, loop: list[Point]) -> None:
        """A surface within a loop of points."""
        lines = [self.line(*ends) for ends in pairs(loop)]
        self.surfaces += 1
        self.text.append(f"Curve Loop({self.surfaces}) = {{{', '.join(map(str, lines))}}};")
        self.text.append(f"Plane Surface({self.surfaces}) = {{{self.surfaces}}};")

    def group(self, kind: str, name: str, members: list[int]) -> None:
        """A physical group."""
        self.text.append(f'Physical {kind}("{name}") = {{{", ".join(str(abs(member)) for member in members)}}};')

    def write(self, path: Path) -> None:
        """Ends the text and writes it."""
        self.text.append(f'Physical Surface("body") = {{1:{self.surfaces}}};')
        path.write_text("\n".join([*self.text, "Mesh.ElementOrder = order;", ""]))


def write_aggregates(net: Net, seed: int, path: Path) -> None:
    """The aggregates, each a surface of its own."""
    geo = Geo(AGGREGATES.format(count=len(net.aggregates)) + HEAD.format(seed=seed), 0.006)
    for aggregate in net.aggregates:
        geo.surface(aggregate)
    geo.write(path)


def write_mortar(net: Net, seed: int, path: Path) -> None:
    """A piece of mortar along every side of a cell, between two aggregates or one and a face, and a triangle where three cells meet."""
    geo = Geo(MORTAR + HEAD.format(seed=seed), 0.004)
    faces: dict[str, list[int]] = {"bottom": [], "right": [], "top": [], "left": []}
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


def main() -> None:
    """The command."""
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


if __name__ == "__main__":
    main()
