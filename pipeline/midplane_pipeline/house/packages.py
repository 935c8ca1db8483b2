"""Try the packages as a stranger does: the .deb unpacked into an empty root, the wheel in an environment of its own, the first scene run from there.

    python -m midplane_pipeline.house.packages target/debian/midplane_0.1.0-1_amd64.deb target/deb/midplane-0.1.0-py3-none-any.whl -o results/packages
    … --root DIR      installed with apt in a Debian root made by debootstrap, which takes minutes and needs to be root

What must be there: program, manual pages, completions, schema and gallery; one version in the program, Cargo.toml, the wheel, the .deb and the changelog; a
program below 15 MB."""

import argparse
import re
import shutil
import subprocess
import sys
import tomllib
import venv
from pathlib import Path

LARGEST = 15e6
FILES = (
    "usr/bin/midplane",
    "usr/share/man/man1/midplane.1.gz",
    "usr/share/man/man1/midplane-run.1.gz",
    "usr/share/bash-completion/completions/midplane",
    "usr/share/zsh/vendor-completions/_midplane",
    "usr/share/fish/vendor_completions.d/midplane.fish",
    "usr/share/doc/midplane/html/index.html",
    "usr/share/midplane/geo/scene.schema.json",
    "usr/share/midplane/geo/compression/scene.json",
)
NOTEBOOK = """
import midplane
run = midplane.Run("results")
traction = run.history["traction_n"].iloc[-1]
assert abs(traction + 10) < 1e-9, traction
run.plot("principal_stress").save("stress.png")
print(midplane.__version__)
"""


def said(command: list[str | Path], **how: object) -> str:
    """Output of a command that must succeed."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **how)  # type: ignore[call-overload]
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return str(done.stdout)


def unpacked(deb: Path, root: Path, install: bool) -> list[str]:
    """Puts the package into a root, and how to call what is there."""
    if not install:
        said(["dpkg-deb", "-x", deb, root])
        return []
    if not (root / "usr/bin/apt-get").exists():
        said(["debootstrap", "--variant=minbase", "bookworm", root])
    shutil.copy(deb, root / "tmp" / deb.name)
    said(["chroot", root, "apt-get", "install", "-qy", "--no-install-recommends", f"/tmp/{deb.name}"])
    return ["chroot", str(root)]


def main() -> None:
    """Unpack, look, run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("deb", type=Path)
    parser.add_argument("wheel", type=Path)
    parser.add_argument("--root", type=Path, help="a Debian root to install into")
    parser.add_argument("-o", "--out", type=Path, required=True)
    options = parser.parse_args()
    version = tomllib.loads(Path("Cargo.toml").read_text(encoding="utf-8"))["package"]["version"]
    shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True)
    root = options.root or options.out / "root"
    call = unpacked(options.deb.resolve(), root.resolve(), options.root is not None)
    missing = [name for name in FILES if not (root / name).exists()]
    program = root / FILES[0]
    size = program.stat().st_size
    if missing or size > LARGEST:
        sys.exit(f"missing in the package: {missing}; the program has {size / 1e6:.1f} MB")
    inside = "/usr/bin/midplane" if call else program.resolve()
    told = re.search(r"^## \[(Unreleased|" + re.escape(version) + r")\]", Path("CHANGELOG.md").read_text(encoding="utf-8"), re.M)
    versions = {
        "program": said([*call, inside, "--version"]).split()[-1],
        "deb": said(["dpkg-deb", "-f", options.deb, "Version"]).strip().split("-")[0],
        "wheel": options.wheel.name.split("-")[1],
        "changelog": version if told else "none",
    }
    if set(versions.values()) != {version}:
        sys.exit(f"versions do not agree with Cargo.toml's {version}: {versions}")
    here = (root / "srv/first" if call else options.out / "first").resolve()
    shutil.copytree(root / "usr/share/midplane/geo/compression", here)
    place = "/srv/first" if call else str(here)
    said([*call, inside, "run", place, "-o", f"{place}/results"])
    venv.create(options.out / "venv", with_pip=True)
    python = (options.out / "venv/bin/python").absolute()
    said([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", options.wheel.resolve()])
    path = {"PATH": f"{program.resolve().parent}:/usr/bin:/bin", "MPLBACKEND": "agg", "PYVISTA_OFF_SCREEN": "true", "HOME": str(here)}
    shown = said([python, "-c", NOTEBOOK], cwd=here, env=path).strip()
    if shown != version:
        sys.exit(f"the wheel says {shown}, Cargo.toml {version}")
    where = f" in {root}" if call else ""
    print(f"{options.deb.name}: {size / 1e6:.1f} MB program, {len(FILES)} files, first scene run{where}; {options.wheel.name}: read and drawn")


if __name__ == "__main__":
    main()
