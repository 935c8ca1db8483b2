"""Write the scene of a wall of bricks in running bond, each brick a mesh of its own, that a beam presses and pushes sideways.

    python -m midplane_pipeline.scenes.wall > geo/masonry_wall/scene.json
    python -m midplane_pipeline.scenes.wall --courses 24 --bricks 12 --edges 1 2 --rows 1 --push 4.5e-3 --fields last \\
        --geo ../../geo/masonry_wall/brick.geo > results/wall300/scene.json

The wall stands on a rigid base, under a rigid beam: they are the courses that the test clamps in steel. Half bricks fill the ends
of the courses. Sizes and numbers that are no option are those of the walls of Raijmakers and Vermeltfoort (TU Eindhoven, 1992).

--top says what the beam does while it is pushed:

  load     it stays level, under the pressure that it has brought
  height   it stays level, and at the height where the pressure has brought it: the pressure grows
  free     it turns as it likes, under the pressure that it has brought
"""

import argparse
import itertools
import math
import os
from collections.abc import Iterator

LENGTH, HEIGHT = 0.22, 0.062  # of a brick, with half a joint on every side [m]
THICKNESS, BEAM = 0.1, 0.1  # of the wall; height of the beam and of the base [m]

TITLES = {
    "load": "Masonry shear wall, its top kept level under a constant load",
    "height": "Masonry shear wall, its top kept level at a constant height",
    "free": "Masonry shear wall, its top free to turn under a constant load",
}

SCENE = """\
// Written by midplane_pipeline.scenes.wall from these options: {options}
//
// Given (Lourenco 1994, for the walls J4D of Raijmakers and Vermeltfoort, TU Eindhoven 1992): a wall of 990 x 1000 mm, bricks of
// 210 x 52 x 100 mm, joints of 10 mm, which have no thickness here, so that the bricks are 220 x 62 mm; Poisson's ratio of the
// bricks; all numbers of the joints but one; 0.3 MPa on top.
// Chosen: {courses} courses of {bricks:g} bricks (J4D: 16 of 4.5); bricks of 16 700 MPa that do not crack{unless};
// no dilatancy under pressure; base and beam rigid, a hundred times stiffer than the bricks.
{{
  "$schema": "{schema}",
  "title": "{title}",
  "plane": "stress",
  "thickness": {thickness},
  "subdomains": {{
{subdomains}
  }},
  "materials": {{
    "brick": {{ "young": 1.67e4, "poisson": 0.15 }},
    "rigid": {{ "young": 1.67e6, "poisson": 0.0 }}
  }},
  "interfaces": {{
    // bed and head joints, those on the base and below the beam too
    "joint": {{
      "between": ["*", "*"],
      "law": {law}
    }}{split}
  }},
  "steps": [
    {{
      "name": "compression",
      "fix": {{ "base": ["x", "y"], "{pushed}": ["x"] }},
      "load": {{ "beam.top": {{ "pressure": {pressure:g} }} }}
    }},
    {{
      "name": "push",
      "increments": {increments},
{more}      "displace": {{ "{pushed}": {{ "x": {push:g} }} }}
    }}
  ],
  "output": {{
    "fields": "{fields}",
    "history": {{
      "push": "beam.bottom.displacement_x",
      "rise": "beam.bottom.displacement_y",
      "force": "reaction:{pushed}:x",
      "bed": "joint~base*.resultant_n",
      "normal": {{ "formula": "-bed" }},
      "shear": "joint~base*.resultant_t",
      "cracked": "joint~*.cracked_length",
      "open": "joint~*.open_length",
{split_length}      "opening": "joint~*.max_jump_n",
      "work": "work.external",
      "stored": "energy.stored",
      "dissipated": "energy.dissipated",
      "released": "energy.released"
    }}
  }}
}}"""

SPLIT = """,
    // where bricks may crack
    "middle": {{
      "within": [
{middles}
      ],
      "law": {law}
    }}"""

LAW = """{{
        "type": "cracking",
        "normal_stiffness": {normal_stiffness:g},
        "tangential_stiffness": {tangential_stiffness:g},
        "tensile_strength": {tensile_strength:g},
        "cohesion": {cohesion:g},
        "tan_friction": {tan_friction:g},
        "fracture_energy_i": {fracture_energy_i:g},
        "fracture_energy_iia": {fracture_energy_iia:g},
        "dilatancy_stress": 0
      }}"""
JOINT = {
    "normal_stiffness": 82000,
    "tangential_stiffness": 36000,
    "tensile_strength": 0.25,
    "cohesion": 0.35,
    "tan_friction": 0.75,
    "fracture_energy_i": 1.8e-5,
    "fracture_energy_iia": 1.25e-4,
}
MIDDLE = {  # strength and energy in tension as in other computations of these walls, the rest chosen
    "normal_stiffness": 1e7,
    "tangential_stiffness": 1e7,
    "tensile_strength": 2,
    "cohesion": 2.8,
    "tan_friction": 0.75,
    "fracture_energy_i": 8e-5,
    "fracture_energy_iia": 8e-4,
}


def ends(number: int, bricks: float) -> list[float]:
    """Places of the head joints of a course and of its two ends, in lengths of a brick: even courses are shifted by half a brick."""
    shift = 0.5 * (number % 2 == 0)
    inner = [place + shift for place in range(int(bricks) + 1) if 0 < place + shift < bricks]
    return [0.0, *inner, bricks]


def subdomain(name: str, geo: str, material: str, **parameters: float) -> tuple[str, str]:
    """One line of `subdomains`."""
    values = ", ".join(f'"{key}": {value:.12g}' for key, value in parameters.items())
    return name, f'    "{name}": {{ "geo": "{geo}", "material": "{material}", "parameters": {{ {values} }} }}'


def courses(wall: argparse.Namespace) -> Iterator[list[tuple[str, str]]]:
    """The bricks of every course, from the lowest on, as names and lines."""
    for number in range(1, wall.courses + 1):
        edges, places = wall.edges[(number - 1) % 2], ends(number, wall.bricks)
        rest = {"height": HEIGHT, "rows": wall.rows}
        yield [
            subdomain(
                f"course{number:02} {'brick' if right - left == 1 else 'half'}{order:02}",
                wall.geo,
                "brick",
                x=LENGTH * left,
                y=HEIGHT * (number - 1),
                width=LENGTH * (right - left),
                edges=math.ceil(edges * (right - left)),
                **rest,
            )
            for order, (left, right) in enumerate(itertools.pairwise(places), 1)
        ]


def scene(wall: argparse.Namespace) -> str:
    """The text of the scene."""
    width, walling = LENGTH * wall.bricks, list(courses(wall))
    line = {"width": width, "height": BEAM, "edges": round(wall.bricks * sum(wall.edges) / 2), "rows": 1}
    base = subdomain("base", wall.geo, "rigid", y=-BEAM, **line)
    beam = subdomain("beam", wall.geo, "rigid", y=HEIGHT * wall.courses, **line)
    bodies = [base, *(brick for course in walling for brick in course), beam]
    middles = [f'        "{name}.middle"' for course in walling for name, _ in course if "brick" in name]
    split = SPLIT.format(middles=",\n".join(middles), law=LAW.format(**MIDDLE)) if wall.split else ""
    more = {"height": '"hold": { "beam": ["y"] }', "auto": '"control": "auto"'}
    return SCENE.format(
        options=wall.asked,
        courses=wall.courses,
        bricks=wall.bricks,
        schema=os.path.join(os.path.dirname(wall.geo), "../scene.schema.json"),
        title=TITLES[wall.top],
        thickness=THICKNESS,
        subdomains=",\n".join(text for _, text in bodies),
        law=LAW.format(**JOINT),
        split=split,
        split_length='      "split": "middle~*.cracked_length",\n' if wall.split else "",
        unless=" but in the middle, at 2 MPa and 80 N/m" if wall.split else "",
        # moved as a whole the beam cannot turn, moved along its lower face it can
        pushed="beam.bottom" if wall.top == "free" else "beam",
        pressure=wall.pressure,
        increments=wall.increments,
        more="".join(f"      {more[key]},\n" for key in (wall.top, wall.control) if key in more),
        push=wall.push,
        fields=wall.fields,
    )


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--courses", type=int, default=16, help="courses that are not clamped (default: %(default)s)")
    parser.add_argument("--bricks", type=float, default=4.5, help="bricks in a course, whole or and a half (default: %(default)s)")
    parser.add_argument("--top", choices=TITLES, default="load", help="what the beam does (default: %(default)s)")
    parser.add_argument("--pressure", type=float, default=0.3, help="pressure on the beam [MPa] (default: %(default)s)")
    parser.add_argument("--push", type=float, default=3e-3, help="displacement of the beam [m] (default: %(default)s)")
    parser.add_argument("--increments", type=int, default=30, help="increments of the push (default: %(default)s)")
    parser.add_argument("--control", choices=["load", "auto"], default="load", help="control of the push (default: %(default)s)")
    parser.add_argument("--split", action="store_true", help="bricks may crack in the middle")
    edges = "edges along half a brick of an odd and of an even course (default: 2 3)"
    parser.add_argument("--edges", type=int, nargs=2, default=[2, 3], metavar=("ODD", "EVEN"), help=edges)
    parser.add_argument("--rows", type=int, default=2, help="edges along the height of a brick (default: %(default)s)")
    choices = ["every", "step", "last", "none"]
    parser.add_argument("--fields", choices=choices, default="step", help="fields that are stored (default: %(default)s)")
    parser.add_argument("--geo", default="brick.geo", help="the brick, relative to the scene (default: %(default)s)")
    wall = parser.parse_args()
    if wall.courses < 1 or wall.bricks < 1 or wall.bricks % 0.5:
        parser.error("a wall has courses of whole bricks, or and a half")
    given = {key: value for key, value in vars(wall).items() if value != parser.get_default(key)}
    words = [f"--{key} {' '.join(map(str, value)) if isinstance(value, list) else value}" for key, value in given.items()]
    wall.asked = " ".join(words).replace(" True", "") or "none"
    print(scene(wall))


if __name__ == "__main__":
    main()
