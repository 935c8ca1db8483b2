"""A net of possible cracks in concrete: a honeycomb of cells from a seed, an aggregate in each, joints from corner to corner."""

import math
import random
from collections.abc import Iterator
from typing import TypeVar

Point = tuple[float, float]
T = TypeVar("T")

WALL = 0.25  # shift of the walls of a row, of a cell's width: rows lie in bond
PEAK = 0.12  # of a cell's roof above its mean, of a cell's height
MOVE = 0.12  # corners move by up to this share of a cell
SHRINK = (0.62, 0.78)  # size of an aggregate in its cell
SHORTEST = 0.08  # line of the net, of a cell: with a shorter one, or an aggregate that is not convex, all is drawn again


class Net:
    """Corners of the cells as points, cells as lists of corners counter-clockwise, the corner of aggregate a at a corner of its cell."""

    def __init__(self, rows: int, columns: int, size: float, seed: int) -> None:
        self.size, self.random = size, random.Random(seed)
        self.draw(rows, columns)
        while not self.fits(SHORTEST * size / max(rows, columns)):
            self.draw(rows, columns)

    def draw(self, rows: int, columns: int) -> None:
        """Draws corners, cells and aggregates anew."""
        self.corners: list[Point] = []
        self.cells: list[list[int]] = []
        self.honeycomb(rows, columns)
        self.aggregates = [shrink([self.corners[c] for c in cell], self.random.uniform(*SHRINK)) for cell in self.cells]
        self.at = {(a, c): p for a, cell in enumerate(self.cells) for c, p in zip(cell, self.aggregates[a], strict=True)}

    def fits(self, shortest: float) -> bool:
        """True if all aggregates are convex and no line is too short."""
        lines = [*self.rims(), *self.joints()]
        return all(map(is_convex, self.aggregates)) and min(math.dist(*ends) for ends in lines) >= shortest

    def honeycomb(self, rows: int, columns: int) -> None:
        """Levels between the rows, from below; on each the feet of the walls above it and the tops of those below it."""
        width, height = self.size / columns, self.size / rows
        shifts = [WALL if row % 2 else -WALL for row in range(rows)]
        levels = []
        for level in range(rows + 1):
            inner = 0 < level < rows
            above = [(i + shifts[level], PEAK, ("foot", i)) for i in range(1, columns)] if level < rows else []
            below = [(i + shifts[level - 1], -PEAK, ("top", i)) for i in range(1, columns)] if level > 0 else []
            places: dict[tuple[str, int], int] = {}
            line = [(0, 0, ("end", 0)), *sorted(above + below), (columns, 0, ("end", columns))]
            for order, (x, y, name) in enumerate(line):
                places[name] = order
                across = self.moved() if inner and name[0] != "end" else 0.0
                along = self.moved() if inner else 0.0
                self.corners.append(((x + across) * width, (level + y * inner + along) * height))
            levels.append((len(self.corners) - len(line), places))

        def part(level: int, name: str, i: int) -> list[int]:
            """Corners of a level from wall i to the next."""
            first, places = levels[level]
            ends = [places[name, wall] if (name, wall) in places else places["end", wall] for wall in (i, i + 1)]
            return list(range(first + ends[0], first + ends[1] + 1))

        for row in range(rows):
            for i in range(columns):
                self.cells.append(part(row, "foot", i) + part(row + 1, "top", i)[::-1])

    def moved(self) -> float:
        """A random move, of a cell."""
        return self.random.uniform(-MOVE, MOVE)

    def faces(self, corner: int) -> int:
        """Number of faces of the square on which a corner of the cells lies."""
        return sum(value in (0, self.size) for value in self.corners[corner])

    def around(self, corner: int) -> list[int]:
        """The aggregates whose cells meet at a corner."""
        return [a for a, cell in enumerate(self.cells) if corner in cell]

    def foot(self, a: int, corner: int) -> Point:
        """The point of the face that is nearest to an aggregate, where its cell has a corner on the face."""
        x, y = (outside if outside in (0, self.size) else inside for outside, inside in zip(self.corners[corner], self.at[a, corner], strict=True))
        return x, y

    def sides(self) -> Iterator[tuple[int, int, int, int | None]]:
        """Sides of the cells, from corner to corner, each with the cell on its left and the one on its right, None at a face."""
        owner = {side: a for a, cell in enumerate(self.cells) for side in pairs(cell)}
        for (start, end), a in owner.items():
            other = owner.get((end, start))
            if other is None or a < other:
                yield start, end, a, other

    def inner(self) -> list[tuple[int, list[int]]]:
        """Corners of the cells where three meet, with these."""
        return [(c, self.around(c)) for c in range(len(self.corners)) if self.faces(c) == 0]

    def joints(self) -> Iterator[tuple[Point, Point]]:
        """Joints in the mortar, as pairs of points."""
        for corner, near in self.inner():
            yield from pairs([self.at[a, corner] for a in near])
        for corner in range(len(self.corners)):
            if self.faces(corner) == 1:
                yield from ((self.at[a, corner], self.foot(a, corner)) for a in self.around(corner))

    def face(self, start: Point, end: Point) -> str:
        """The face of the square on which two points lie."""
        for axis, names in enumerate((("left", "right"), ("bottom", "top"))):
            if start[axis] == end[axis] and start[axis] in (0, self.size):
                return names[start[axis] > 0]
        raise ValueError(f"{start} and {end} lie on no face")

    def rims(self) -> Iterator[tuple[Point, Point]]:
        """Sides of the aggregates, as pairs of points."""
        for aggregate in self.aggregates:
            yield from pairs(aggregate)


def pairs(loop: list[T]) -> Iterator[tuple[T, T]]:
    """Neighbours in a loop."""
    return zip(loop, loop[1:] + loop[:1], strict=True)


def is_convex(polygon: list[Point]) -> bool:
    """True if a polygon that runs counter-clockwise turns left at every point."""
    ways = [(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in pairs(polygon)]
    return all(dx0 * dy1 - dy0 * dx1 > 0 for (dx0, dy0), (dx1, dy1) in pairs(ways))


def area_and_centroid(polygon: list[Point]) -> tuple[float, list[float]]:
    """Area of a polygon that runs counter-clockwise, and its centroid."""
    crosses = [(x0 * y1 - x1 * y0, x0 + x1, y0 + y1) for (x0, y0), (x1, y1) in pairs(polygon)]
    area = sum(cross for cross, _, _ in crosses) / 2
    return area, [sum(c * s[axis] for c, *s in crosses) / (6 * area) for axis in (0, 1)]


def shrink(polygon: list[Point], factor: float) -> list[Point]:
    """A polygon about its centroid; points as they are written."""
    _, (x0, y0) = area_and_centroid(polygon)
    return [(round(x0 + factor * (x - x0), 6), round(y0 + factor * (y - y0), 6)) for x, y in polygon]
