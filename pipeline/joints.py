"""What an interface of the results is in its scene.

An interface with two named sides has the name of its entry in the scene; those that "between" finds are called
ENTRY~A~B, with the subdomains of sides A and B, and ENTRY~A~B~1, ~2 where these touch along several lines.
"""


def entry_of(scene, name):
    """The scene's entry that an interface comes from."""
    return scene["interfaces"][name.partition("~")[0]]


def subdomains_of(scene, name):
    """The subdomains of side A and of side B, each as a sorted list."""
    parts = name.split("~")
    if len(parts) > 1:
        return [parts[1]], [parts[2]]
    names = []
    for side in ("side_a", "side_b"):
        groups = entry_of(scene, name)[side]
        groups = [groups] if isinstance(groups, str) else groups
        names.append(sorted({group.partition(".")[0] for group in groups}))
    return tuple(names)
