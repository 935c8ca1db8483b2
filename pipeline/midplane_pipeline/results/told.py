"""Errors of the reader of results, told in one line."""

import sys
from collections.abc import Callable

from midplane.errors import MidplaneError


def told(main: Callable[[], None]) -> None:
    """Runs the program; an error that the reader of results finds is its last line, with exit code 1."""
    try:
        main()
    except MidplaneError as error:
        sys.exit(str(error))
