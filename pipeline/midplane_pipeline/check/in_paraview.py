"""Open the results of a scene in ParaView, look at what is there, play them and save pictures. Run by pvpython.

    pvpython pipeline/midplane_pipeline/check/in_paraview.py results/masonry PICTURES

The .pvd opens as one source: its blocks are the subdomains and the interfaces of summary.json by their names, its times
grow strictly, arrays have the components the README names, and bodies and interfaces warp along by one filter. The last
picture is not empty, and differs from the first.
"""

import itertools
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

COMPONENTS = {
    "stress": ["xx", "yy", "zz", "xy", "yz", "xz"],
    "principal_stress": ["s1", "s2", "szz"],
    "traction": ["n", "t"],
    "jump": ["n", "t"],
}
BODY = {"displacement", "stress", "von_mises"}
INTERFACE = {"displacement", "displacement_a", "displacement_b", "jump", "traction", "status"}
ENLARGED = 0.1  # largest displacement on the picture, of the size of the scene
SIZE = [1200, 800]


def expect(right: Any, fault: Any) -> None:
    """Ends with a message where something is wrong."""
    if not right:
        sys.exit(f"test_paraview: {fault}")


def leaf(block: Any) -> Any:
    """The grid of a block."""
    while block.IsA("vtkMultiBlockDataSet"):
        block = block.GetBlock(0)
    return block


def check_arrays(name: str, data: Any, wanted: Any) -> None:
    """The arrays are there, their components bear their names."""
    there = {data.GetArrayName(k): data.GetArray(k) for k in range(data.GetNumberOfArrays())}
    expect(wanted <= there.keys(), f"{name} lacks {sorted(wanted - there.keys())}")
    for key in COMPONENTS.keys() & there.keys():
        found = [there[key].GetComponentName(k) for k in range(there[key].GetNumberOfComponents())]
        expect(found == COMPONENTS[key], f"components of {key} of {name} are {found}, not {COMPONENTS[key]}")


def check_blocks(source: Any, summary: dict[str, Any]) -> Any:
    """Names of the blocks and what they hold."""
    data = source.GetClientSideObject().GetOutputDataObject(0)
    blocks = {data.GetMetaData(k).Get(data.NAME()): leaf(data.GetBlock(k)) for k in range(data.GetNumberOfBlocks())}
    interfaces = set(summary["sizes"]["interfaces"])
    bodies = {name for own in summary["sizes"]["interfaces"].values() for name in own["subdomains"]}
    expect(bodies | interfaces <= blocks.keys(), f"no block for {sorted((bodies | interfaces) - blocks.keys())}")
    for name, grid in blocks.items():
        check_arrays(name, grid.GetPointData(), INTERFACE if name in interfaces else BODY)
        if name not in interfaces:
            check_arrays(name, grid.GetCellData(), {"stress", "von_mises", "principal_stress"})
    return blocks


def selectors(names: Any) -> list[Any]:
    """Blocks by their names as they are: nodes of the assembly have them without blanks and such."""
    return [f'//*[@label="{name}"]' for name in sorted(names)]


def warped(source: Any, blocks: Any, interfaces: Any) -> Any:
    """The scene, displacements enlarged, coloured by von Mises' stress, with the interfaces on it, in a view."""
    bounds = [grid.GetBounds() for grid in blocks.values()]
    size = max(max(b[1] for b in bounds) - min(b[0] for b in bounds), max(b[3] for b in bounds) - min(b[2] for b in bounds))
    fields = [vtk_to_numpy(grid.GetPointData().GetArray("displacement")) for grid in blocks.values()]
    largest = max((abs(field).max() for field in fields), default=0.0) or 1.0
    factor = ENLARGED * size / largest
    view = simple.CreateRenderView(ViewSize=SIZE, OrientationAxesVisibility=0, InteractionMode="2D")
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    warp = simple.WarpByVector(Input=source, Vectors=["POINTS", "displacement"], ScaleFactor=factor)
    bodies = simple.ExtractBlock(Input=warp, Selectors=selectors(blocks.keys() - set(interfaces)))
    shown = simple.Show(bodies, view)
    simple.ColorBy(shown, ("POINTS", "von_mises"))
    stresses = [vtk_to_numpy(blocks[name].GetPointData().GetArray("von_mises")) for name in blocks.keys() - set(interfaces)]
    simple.GetColorTransferFunction("von_mises").RescaleTransferFunction(0.0, max(map(np.max, stresses)))
    shown.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(simple.GetColorTransferFunction("von_mises"), view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    lines = simple.ExtractBlock(Input=warp, Selectors=selectors(interfaces))
    drawn = simple.Show(lines, view)
    drawn.ColorArrayName = ["POINTS", ""]
    drawn.AmbientColor = drawn.DiffuseColor = [0.8, 0.3, 0.0]
    drawn.LineWidth = 3
    drawn.Position = [0.0, 0.0, 1e-3 * size]  # before the bodies
    simple.ResetCamera(view)
    return view


def pixels(path: Path) -> Any:
    """The values of a picture."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())


def main() -> None:
    """One results folder."""
    results, pictures = Path(sys.argv[1]), Path(sys.argv[2])
    pictures.mkdir(parents=True, exist_ok=True)
    summary = json.loads((results / "summary.json").read_text())
    (collection,) = results.glob("*.pvd")
    source = simple.PVDReader(FileName=str(collection.resolve()))
    times = list(source.TimestepValues)
    expect(len(times) == summary["solution"]["fields"] >= 2, f"{len(times)} times, {summary['solution']['fields']} stored")
    expect(all(a < b for a, b in itertools.pairwise(times)), f"times do not grow: {times}")
    source.UpdatePipeline(times[-1])
    blocks = check_blocks(source, summary)
    view = warped(source, blocks, summary["sizes"]["interfaces"])
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    frames = []
    for time in (times[0], times[-1]):
        scene.AnimationTime = time
        path = pictures / f"{results.name}_{time:g}.png"
        simple.SaveScreenshot(str(path), view)
        frames.append(pixels(path))
    expect((frames[-1] != 255).any(), "the picture is empty")
    expect((frames[0] != frames[-1]).any(), "nothing moves between the first time and the last")
    for stale in pictures.glob(f"{results.name}_animation*.png"):
        stale.unlink()
    simple.SaveAnimation(str(pictures / f"{results.name}_animation.png"), view, ImageResolution=[600, 400])
    played = sorted(pictures.glob(f"{results.name}_animation*.png"))
    expect(len(played) == len(times), f"{len(played)} frames of {len(times)} times")
    print(f"{results}: {len(blocks)} named blocks, {len(times)} times, played; {path}")


main()
