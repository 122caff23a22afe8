#!/usr/bin/env python3
"""The built-in engine beside OpenFOAM on a mesh that follows the cloth: bodies, and canopies as they stand in the wind.

    make judge        (or: judge.py --ripstop build/bin/ripstop --bench build-check/bench/bench_judge --across 24)

`ripstop steady` inflates a flat circular canopy, a ringsail (ADEPT) and Stratos IV, with cloth as specified
and nothing calibrated, at 20 m/s, in runs/judge; finished runs cost nothing. Their shapes, held rigid, and five bodies then
stand in both engines (bench_judge). The table is docs/tables/judge.md; the plots of the cup and of the flat circular canopy
go beside it, the others stay in runs/judge.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "validation"), str(ROOT / "validation/ojf")]
from campaign import SHEET_SPECIFIED  # pylint: disable=wrong-import-position

SHAPES = {"flat-circular": ("flat-circular", []), "ringsail": ("adept", SHEET_SPECIFIED),
          "stratos-iv": ("stratos-iv", SHEET_SPECIFIED)}
BODIES = ["disk", "plate", "cup", "porous-disk", "disk-gap-band"]


def shape(options, name):
    """NAME=FILE.stl:A:B of bench_judge."""
    example, settings = SHAPES[name]
    folder = pathlib.Path("runs/judge") / name
    command = [str(options.ripstop.resolve()), "steady", f"examples/{example}/case.toml", "--speed", "20", "--out", str(folder)]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, cwd=ROOT, check=True)
    cloth = json.loads((ROOT / folder / "run.json").read_text())["case"]["parachute"]["canopy_material"]
    material = tomllib.loads((ROOT / "materials" / f"{cloth}.toml").read_text())
    return f"{name}={folder}/canopy.stl:{material['darcy']:g}:{material['forchheimer']:g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--bench", type=pathlib.Path, default=ROOT / "build-check/bench/bench_judge")
    parser.add_argument("--across", type=int, default=24, help="cells across the body")
    parser.add_argument("names", nargs="*", help="bodies and shapes; all of them, and the table written, without a name")
    options = parser.parse_args()
    names = options.names or [*BODIES, *SHAPES]
    words = [shape(options, name) if name in SHAPES else name for name in names]
    folder = f"runs/judge/{options.across}"
    command = [str(options.bench.resolve().relative_to(ROOT)), folder, str(options.across), *words]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as bench:
        lines = []
        for line in bench.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    if bench.returncode != 0:
        sys.exit(bench.returncode)
    if options.names:
        return
    (ROOT / "docs/tables/judge.md").write_text("".join(lines))
    for body in ("cup", "flat-circular"):
        for what in ("pressure", "wake"):
            shutil.copy(ROOT / folder / f"{body}-{options.across}-{what}.svg", ROOT / f"docs/tables/judge-{body}-{what}.svg")


if __name__ == "__main__":
    main()
