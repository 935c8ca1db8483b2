"""The cost of a law that is there and not needed: the shear box with springs, and with the cracking law kept below its
surface by a load of a hundredth. Runs take turns; of each the fastest counts."""

import argparse
import json
from pathlib import Path

from .scenes import SIZES, SPRINGS, folder, kept_below, run


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench-below"))
    parser.add_argument("--size", choices=SIZES, default="10k")
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    here = folder(options.program.resolve(), options.size, options.out)
    scene = json.loads((here / "cracking.json").read_text())
    scene["steps"] = kept_below(scene["steps"])
    for fields in ("every", "last"):
        scene["output"]["fields"] = fields
        seconds: dict[str, list[float]] = {}
        for name, law in (("springs", SPRINGS), ("cracking", scene["interfaces"]["joint"]["law"])):
            joint = scene["interfaces"]["joint"] | {"law": law}
            text = json.dumps(scene | {"interfaces": {"joint": joint}})
            (here / f"below_{name}.json").write_text(text)
            seconds[name] = []
        for _ in range(options.repeat):
            for name, measured in seconds.items():
                measured.append(run(options.program.resolve(), here / f"below_{name}.json")["seconds"])
        springs, cracking = (min(measured) for measured in seconds.values())
        print(f"{options.size}, fields of {fields}: springs {springs:.3f} s, cracking law below its surface {cracking:.3f} s, ratio {cracking / springs:.2f}")


if __name__ == "__main__":
    main()
