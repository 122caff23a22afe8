#!/usr/bin/env python3
"""Steady drag of every family's example beside what Knacke's manual gives for the type.

    make validate-families            (or: families.py --ripstop build/bin/ripstop --runs runs/families)

Runs `ripstop steady` on all examples but those of the wind tunnel, whose cloth is calibrated on Stratos IV: the library's
cloth with its own permeability. Writes docs/tables/families.md. Runs that are finished cost nothing.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import tables  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CALIBRATED = "f-111"


def examples():
    for case in sorted((ROOT / "examples").glob("*/case.toml")):
        if tomllib.loads(case.read_text())["parachute"].get("canopy_material") != CALIBRATED:
            yield case.parent.name


def run(ripstop, runs, name):
    folder = runs / name
    command = [str(ripstop), "steady", f"examples/{name}/case.toml", "--out", str(folder)]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode != 0:
        sys.exit(f"{name}: ripstop failed; the same command again goes on from here")
    return json.loads((folder / "result.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/families")
    options = parser.parse_args()
    head = ["example", "drag coefficient", "Knacke, in descent", "projected / nominal diameter", "drag N", "iterations", "wall s"]
    rows, runs = [], []
    for name in examples():
        r = run(options.ripstop.resolve(), options.runs.resolve(), name)
        known = r.get("known_drag_coefficient")
        printed = f"{known[0]:.2f} to {known[1]:.2f}" if known else ""
        nominal = (4 / math.pi * r["reference_area_m2"]) ** 0.5
        rows.append([name, f"{r['drag_coefficient']:.3f}", printed, f"{r['projected_diameter_m'] / nominal:.3f}",
                     f"{r['drag_n']:.1f}", str(r["coupling_iterations"]), f"{r['wall_time_s']:.0f}"])
        runs += tables.runs_below(options.runs / name)
    tables.write("families", "Steady drag of every family's example", "make validate-families", runs, tables.table(head, rows))


if __name__ == "__main__":
    main()
