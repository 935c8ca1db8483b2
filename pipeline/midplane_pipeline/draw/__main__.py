"""Draw the results of one scene: pictures for a reader, one idea each, into RESULTS/pictures/.

  displacement.png         the deformed mesh, enlarged by the factor it states, coloured by displacement
  principal_stress.png     principal stresses as crosses in their directions, coloured by sign
  interfaces.png           all interfaces: opening as thickness, status as colour
  traction_INTERFACE.png   both components of the traction along the interface
  coupling_INTERFACE.png   the two meshes face to face, and between them how they are joined

The last two are made of every interface of a scene with few of them, else of those named by --interface. All show
the last increment stored. Meshes are rendered off-screen by VTK (through pyvista); without a library for that
(libosmesa6 or libegl1) only graphs and lines are drawn, and a line says so. Other pictures: draw.compare, draw.animate.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from midplane import scene_file
from midplane.names import chosen
from midplane.pictures import page, plane
from midplane.pictures.displacement import draw_displacement
from midplane.pictures.interfaces import draw_interfaces
from midplane.pictures.principal import draw_principal_stress
from midplane.pictures.results import Results, View
from midplane.pictures.traction import draw_along

from midplane_pipeline.exact.solutions import SOLUTIONS
from midplane_pipeline.results.entries import entry_of
from midplane_pipeline.results.told import told

from . import view_options
from .coupling import draw_coupling
from .deviation import deviation

FEW = 4  # interfaces that have pictures of their own without being asked for


def parse_exact(text: str) -> tuple[str, str, list[float] | None, list[float]]:
    """[INTERFACE.]COMPONENT=VALUE[@FROM:TO], such as t=-1.5@0.6:1.4: interface, component, both ends or None, values."""
    try:
        component, _, rest = text.partition("=")
        interface, _, component = component.rpartition(".")
        value, _, part = rest.partition("@")
        if component not in ("n", "t") or part.count(":") != bool(part):
            raise ValueError
        places = [float(end) for end in part.split(":")] if part else None
        return interface, component, places, [float(value)] * 2
    except ValueError:
        message = f"{text} is not n=VALUE or t=VALUE, perhaps with INTERFACE. before or @FROM:TO behind it"
        raise argparse.ArgumentTypeError(message) from None


def parse_arguments() -> argparse.Namespace:
    """The options."""
    parser = argparse.ArgumentParser(
        prog="python -m midplane_pipeline.draw",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        fromfile_prefix_chars="@",
        epilog="An argument @FILE stands for the arguments in that file, one a line.",
    )
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/compression/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/compression")
    view_options.add_arguments(parser)
    many: dict[str, Any] = {"action": "append", "default": []}
    own = f"traction and coupling of this interface, or of those that fit a pattern; default: all if they are at most {FEW}"
    parser.add_argument("--interface", help=own, metavar="NAME", action="append")
    parser.add_argument("--compare", help="another run, for the tractions", metavar="LABEL=RESULTS", **many)
    exact = "an exact traction (n or t), on part of the interface if FROM and TO are given"
    parser.add_argument("--exact", help=exact, metavar="[INTERFACE.]n=VALUE[@FROM:TO]", type=parse_exact, **many)
    solution = "the exact solution of this scene, for its tractions"
    parser.add_argument("--solution", help=solution, choices=SOLUTIONS)
    within = "what tractions may be off the exact ones, of the largest of these"
    parser.add_argument("--within", type=float, help=within)
    parser.add_argument("--label", help="name of this run beside others, default: its coupling")
    return parser.parse_args()


def exact_tractions(arguments: argparse.Namespace, scene: dict[str, Any], results: Results) -> dict[str, list[Any]]:
    """Exact tractions by interface, those that all of them share in every one: (component, places or None, values)."""
    known = arguments.exact
    if arguments.solution:
        solution = SOLUTIONS[arguments.solution](scene, results)
        # "n" of all interfaces, "joint.n" of one
        known += [(*name.rpartition(".")[::2], *curve) for name, curve in solution.traction.items()]
    for interface in {interface for interface, *_ in known if interface}:
        chosen(arguments.results, "interface", [interface], results.interfaces)
    return {name: [values for interface, *values in known if interface in ("", name)] for name in results.interfaces}


def main() -> None:
    """The command."""
    arguments = parse_arguments()
    view = view_options.view_of(arguments)
    scene = scene_file.read(arguments.scene)
    title = scene.get("title") or arguments.results.name
    plt.rcParams.update(page.STYLE)

    results = Results(arguments.results, scene)
    if not results.subdomains:
        print(f"{arguments.results}: no fields stored, nothing to draw")
        return
    others = []
    for other in arguments.compare:
        label, _, folder = other.partition("=")
        others.append((label, Results(Path(folder), scene, beside=True)))
    joined = results.joined(View())
    own = joined if len(results.interfaces) <= FEW else []
    if arguments.interface:
        own = [name for name in chosen(arguments.results, "interface", arguments.interface, results.interfaces) if name in joined]
    exact = exact_tractions(arguments, scene, results)
    if arguments.within is not None and not any(exact[name] for name in joined):
        print(f"{arguments.results}: no exact tractions here, nothing to compare")
    for name in joined:
        if name in own:
            entry = entry_of(scene, name)
            label = arguments.label or entry.get("coupling", "projected")
            figure = draw_along(results, name, entry["law"], label, others, exact[name], title, view)
            page.save(figure, results.pictures / f"traction_{name}.png")
        if exact[name]:
            largest = deviation(results, name, exact[name])
            print(f"{arguments.results}: tractions of {name} are off the exact ones by {largest:.1e}")
            if arguments.within is not None and largest > arguments.within:
                sys.exit(f"{arguments.results}: that is more than {arguments.within:g}")
    runs = [("", results)]
    joints = draw_interfaces(runs, title, view)
    if joints is not None:
        page.save(joints, results.pictures / "interfaces.png")
    if not plane.can_render():
        print("no library for off-screen rendering (libosmesa6 or libegl1): pictures of meshes skipped")
        return
    page.save(draw_displacement(runs, title, view), results.pictures / "displacement.png")
    page.save(draw_principal_stress(runs, title, view), results.pictures / "principal_stress.png")
    for name in own:
        draw_coupling(results, name, title, view)


if __name__ == "__main__":
    told(main)
