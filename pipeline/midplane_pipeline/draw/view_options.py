"""The options of pictures of meshes: units, a part of the plane, some of the parts."""

import argparse
from typing import Any

from midplane.pictures.results import View


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The options that make a View."""
    units: dict[str, Any] = {"nargs": 2, "metavar": ("STRESS", "LENGTH"), "default": ("MPa", "m")}
    parser.add_argument("--units", help="what the numbers mean, default: MPa m", **units)
    zoom = "the part of the plane that the pictures of meshes show"
    parser.add_argument("--zoom", help=zoom, metavar="X0:X1:Y0:Y1", type=parse_zoom)
    only = "draw only this subdomain, or those that fit a pattern (* any text, ? any character); may be repeated"
    parser.add_argument("--subdomain", help=only, metavar="NAME", action="append", dest="subdomains")


def parse_zoom(text: str) -> tuple[tuple[float, float], tuple[float, float]]:
    """X0:X1:Y0:Y1 as ((x0, x1), (y0, y1))."""
    try:
        x0, x1, y0, y1 = map(float, text.split(":"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not X0:X1:Y0:Y1") from None
    if not (x0 < x1 and y0 < y1):
        raise argparse.ArgumentTypeError(f"{text}: X0 is not below X1, or Y0 not below Y1")
    return (x0, x1), (y0, y1)


def view_of(arguments: argparse.Namespace) -> View:
    """The View that the options ask for."""
    stress, length = arguments.units
    return View(stress, length, arguments.zoom, arguments.subdomains or ["*"])
