"""Distance of tractions from exact ones."""

import numpy as np
from midplane.pictures.results import Results
from midplane.pictures.traction import Exact, distances


def deviation(results: Results, name: str, exact: Exact) -> float:
    """Largest difference from exact tractions at the law points of an interface, over the largest of these."""
    field, largest, size = results.interfaces[name], 0.0, 0.0
    s = distances(results, name)
    for component, places, values in exact:
        there = (s >= places[0]) & (s <= places[-1]) if places is not None else np.full(len(s), True)
        wanted = np.interp(s, places, values) if places is not None else np.full(len(s), values[0])
        off = np.abs(field["traction"][:, "nt".index(component)] - wanted)
        largest, size = max(largest, off[there].max()), max(size, np.abs(values).max())
    return largest / size
