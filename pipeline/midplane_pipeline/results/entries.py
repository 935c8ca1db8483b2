"""The entry of the scene behind an interface of the results.

An interface with two named sides has the name of its entry in the scene; those that "between" finds are called
ENTRY~A~B, with their subdomains, and ENTRY~A~B~1, ~2 where these touch along several lines.
"""

from typing import Any


def entry_of(scene: dict[str, Any], name: str) -> dict[str, Any]:
    """The scene's entry that an interface comes from."""
    return scene["interfaces"][name.partition("~")[0]]
