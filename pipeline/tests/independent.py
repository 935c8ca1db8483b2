"""Routes that closed forms are compared with: an integrator of ODEs, differences of fields, results that are only sizes."""

from types import SimpleNamespace

import numpy as np


def runge_kutta(slope, start, x0, x1, steps=2000):
    """All values of y' = slope(x, y) from x0 to x1, a row per step, by the classical method of order 4."""
    y, h = np.asarray(start, float), (x1 - x0) / steps
    rows = [y]
    for k in range(steps):
        x = x0 + k * h
        a = np.asarray(slope(x, y))
        b = np.asarray(slope(x + h / 2, y + h / 2 * a))
        c = np.asarray(slope(x + h / 2, y + h / 2 * b))
        d = np.asarray(slope(x + h, y + h * c))
        y = y + h / 6 * (a + 2 * b + 2 * c + d)
        rows.append(y)
    return np.array(rows)


def gradient(u, x, y, h):
    """Derivatives of a field of vectors by central differences: rows are components, columns x and y."""
    by_x = (np.asarray(u(x + h, y)) - np.asarray(u(x - h, y))) / (2 * h)
    by_y = (np.asarray(u(x, y + h)) - np.asarray(u(x, y - h))) / (2 * h)
    return np.stack([by_x, by_y], axis=-1)


def stress_of(u, young, nu, h, plane="strain"):
    """The stress (xx, yy, xy) of a displacement field at a place, by differences."""
    lam, mu = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    if plane == "stress":
        lam = young * nu / (1 - nu**2)

    def stress(x, y):
        g = gradient(u, x, y, h)
        mean = lam * (g[0, 0] + g[1, 1])
        return np.array([mean + 2 * mu * g[0, 0], mean + 2 * mu * g[1, 1], mu * (g[0, 1] + g[1, 0])])

    return stress


def out_of_balance(stress, x, y, h):
    """Divergence of a stress (xx, yy, xy) at a place, by differences."""
    g = gradient(stress, x, y, h)
    return np.array([g[0, 0] + g[2, 1], g[2, 0] + g[1, 1]])


def box(width, height, x=0.0, y=0.0):
    """A body of which only the corners are known."""
    return SimpleNamespace(points=np.array([[x, y, 0.0], [x + width, y, 0.0], [x + width, y + height, 0.0], [x, y + height, 0.0]]))


def line(*points):
    """A mid-plane through points."""
    places = np.array(points, float)
    count = len(places) - 1
    segments = np.column_stack([np.arange(count), np.arange(1, count + 1)])
    return SimpleNamespace(points=places, segments=segments, start=tuple(places[0]), end=tuple(places[-1]))


def results(subdomains=None, midplanes=None):
    """Results of which bodies and mid-planes are known."""
    return SimpleNamespace(subdomains=subdomains or {}, midplane=lambda name: (midplanes or {})[name])


def area(x, y):
    """∫ y dx by the trapezoidal rule, with its sign."""
    x, y = np.asarray(x), np.asarray(y)
    return float((0.5 * (y[1:] + y[:-1]) * np.diff(x)).sum())
