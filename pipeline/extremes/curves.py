"""Draws the curves of a row."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy as np

FLOOR = 1e-18  # what is exactly zero is drawn here


def draw(curve, path):
    """One graph, both axes logarithmic unless x is not positive."""
    figure, axes = pyplot.subplots(figsize=(7.2, 4.2), dpi=130)
    for label, x, y in curve.series:
        axes.plot(x, np.maximum(np.abs(np.asarray(y, float)), FLOOR), marker=".", label=label)
    if curve.line is not None:
        axes.axhline(curve.line, color="0.4", linestyle="--", linewidth=1, label=f"limit {curve.line:g}")
    axes.set_yscale("log")
    if all(np.min(x) > 0 for _, x, _ in curve.series):
        axes.set_xscale("log")
    axes.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Software": None})
    pyplot.close(figure)
