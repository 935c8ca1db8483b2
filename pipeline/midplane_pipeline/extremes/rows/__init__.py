"""The rows of the campaign by what they try; each registers itself in ROWS."""

from ..row import ROWS
from . import ends, facing, geometry, gmsh, junction, law, laws, material, mesh_file, run, scene, stiffness, water

__all__ = ["ROWS", "ends", "facing", "geometry", "gmsh", "junction", "law", "laws", "material", "mesh_file", "run", "scene", "stiffness", "water"]
