#!/usr/bin/env python3
"""Compares the built-in engine with OpenFOAM on a mesh that follows the cloth: rigid bodies and inflated canopies.

    make judge        (or: judge.py --ripstop build/bin/ripstop --bench build-check/bench/bench_judge --across 24)

`ripstop steady` inflates a flat circular canopy, a ringsail (ADEPT) and Stratos IV at 20 m/s in `runs/judge`, with cloth as
specified and without calibration; finished runs are not repeated. bench_judge then computes their rigid shapes and seven bodies with
both engines. The disk is also computed on coarser cells, for the time to a given accuracy. The tables are `docs/tables/judge.md`;
some plots are in the same folder, the others in `runs/judge`.
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
import tables  # pylint: disable=wrong-import-position
from campaign import SHEET_SPECIFIED  # pylint: disable=wrong-import-position

SHAPES = {"flat-circular": ("flat-circular", []), "ringsail": ("adept", SHEET_SPECIFIED),
          "stratos-iv": ("stratos-iv", SHEET_SPECIFIED)}
BODIES = ["disk", "plate", "cup", "porous-disk-0.5", "porous-disk-1", "porous-disk-2", "disk-gap-band"]
COARSER = [8, 12, 16]  # cells across the disk
PLOTS = [("cup", "pressure"), ("cup", "wake"), ("flat-circular", "pressure"), ("flat-circular", "wake"), ("stratos-iv", "pressure")]


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
    a, b = material["pressure_drop_linear_pa_s_m"], material["pressure_drop_quadratic_pa_s2_m2"]
    return f"{name}={folder}/canopy.stl:{a:g}:{b:g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--bench", type=pathlib.Path, default=ROOT / "build-check/bench/bench_judge")
    parser.add_argument("--across", type=int, default=24, help="cells across the body")
    parser.add_argument("names", nargs="*", help="bodies and shapes; all of them, and the table written, without a name")
    options = parser.parse_args()
    names = options.names or [*BODIES, *SHAPES]
    lines = judged(options, options.across, [shape(options, name) if name in SHAPES else name for name in names])
    if options.names:
        return
    disk = [line for across in COARSER for line in judged(options, across, ["disk"]) if line.startswith("| disk |")]
    disk += [line for line in lines if line.startswith("| disk |")]
    (ROOT / "docs/tables/judge.md").write_text("".join([*lines, *timed(disk)]))
    for body, what in PLOTS:
        shutil.copy(ROOT / f"runs/judge/{options.across}/{body}-{options.across}-{what}.svg", ROOT / f"docs/tables/judge-{body}-{what}.svg")


def judged(options, across, words):
    """Output of bench_judge by lines."""
    command = [str(options.bench.resolve().relative_to(ROOT)), f"runs/judge/{across}", str(across), *words]
    lines = []
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as bench:
        for line in bench.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    if bench.returncode != 0:
        sys.exit(bench.returncode)
    return lines


def timed(rows):
    """Drag of both engines relative to their own finest grid, and minutes, from rows of bench_judge, the finest last."""
    cells = [[word.strip() for word in row.split("|")[1:-1]] for row in rows]
    table = []
    for row in cells:
        minutes = row[9].split(", ")
        one = [row[1]]
        for drag, finest, time in ((row[2], cells[-1][2], minutes[0]), (row[3], cells[-1][3], minutes[1])):
            one += [drag, f"{100 * (float(drag) / float(finest) - 1):+.1f} %", time]
        table.append(one)
    heads = ["cells across the disk"]
    for engine in ("built-in", "OpenFOAM"):
        heads += [f"{engine}, C_D", "compared with its finest grid", "minutes on one core"]
    return ["\n## Time to the same accuracy\n\n", *(line + "\n" for line in tables.table(heads, table))]


if __name__ == "__main__":
    main()
