"""The exact solutions that pictures and checks may be asked for, by name."""

from exact import dcb, friction_block, inclusion, pull_bar, tension
from exact_bond import pull_out
from exact_fractures import hertz, inclined_crack, sneddon
from exact_lining import lining

ALL = [dcb, friction_block, hertz, inclined_crack, inclusion, lining, pull_bar, pull_out, sneddon, tension]
SOLUTIONS = {solution.__name__: solution for solution in ALL}
