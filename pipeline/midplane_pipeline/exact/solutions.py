"""The exact solutions that pictures and checks may be asked for, by name."""

from .bars import dcb, friction_block, pull_bar, tension
from .bond import pull_out
from .fractures import hertz, inclined_crack, sneddon
from .inclusion import inclusion
from .lining import lining

ALL = [dcb, friction_block, hertz, inclined_crack, inclusion, lining, pull_bar, pull_out, sneddon, tension]
SOLUTIONS = {solution.__name__: solution for solution in ALL}
