"""midplane in notebooks: scenes, their runs and studies, results as pandas and PyVista have them.

    import midplane

    scene = midplane.Scene("geo/dam")
    scene["interfaces.base.law.cohesion"] = 2.0
    run = scene.run()
    run.history, run.interface("base"), run.fields[-1], run.crack_map()

A thin layer over the program `midplane`, which does all the work: beside the package, in PATH, or named by MIDPLANE.
"""

from .binary import program
from .checked import Check, Warned
from .errors import EquilibriumError, InputError, Interrupted, MachineError, MidplaneError, ResultsError, VersionError
from .laws import law
from .run import Fields, Run
from .running import MidplaneWarning
from .scene import Scene
from .version import __version__

__all__ = [
    "Check",
    "EquilibriumError",
    "Fields",
    "InputError",
    "Interrupted",
    "MachineError",
    "MidplaneError",
    "MidplaneWarning",
    "ResultsError",
    "Run",
    "Scene",
    "VersionError",
    "Warned",
    "__version__",
    "law",
    "program",
]
