#!/usr/bin/env python3
"""Static coefficients over the angle of attack of three families: docs/tables/stability.md and its plots.

    make validate-stability          (or: static.py --ripstop build/bin/ripstop --runs runs/static)

Runs `ripstop stability` on cases of this folder. The canopy is rigid, with the shape of its steady run on the axis. Finished
angles are not repeated. `--tables` runs nothing: the page has the curves that are finished.
"""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation"))
import tables  # pylint: disable=wrong-import-position

FAMILIES = ("flat-circular", "cross", "disk-gap-band")
ANGLES, CELLS_ACROSS = "0:40:10", 12


def compute(options, family):
    folder = options.runs.resolve() / family
    command = [str(options.ripstop.resolve()), "stability", f"validation/flight/{family}.toml", "--angles", ANGLES,
               "--cells-across", str(CELLS_ACROSS), "--out", str(folder)]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    subprocess.run(command, cwd=ROOT, check=True)


def with_error(row, key):
    return f"{float(row[key]):.3f} +- {float(row[key + '_standard_error']):.3f}"


def trims_of(folder):
    trims = json.loads((folder / "result.json").read_text())["trims"]
    return "; ".join(f"{trim['angle_deg']:.0f} ({'stable' if trim['stable'] else 'unstable'}{'' if trim['certain'] else ', not certain'})"
                     for trim in trims) or "none"


def write_page(options):
    rows, trims, made = [], [], []
    for family in FAMILIES:
        folder = options.runs / family
        if not (folder / "result.json").exists():
            continue
        with open(folder / "stability.csv", encoding="utf-8") as file:
            rows += [[family, f"{float(row['angle_deg']):.0f}", *(with_error(row, key) for key in ("c_t", "c_n", "c_m"))]
                     for row in csv.DictReader(file)]
        trims.append([family, trims_of(folder)])
        made += tables.runs_below(folder)[:1]
        shutil.copy(folder / "stability.svg", ROOT / "docs/tables" / f"stability-{family}.svg")
    if not rows:
        sys.exit("no curve is finished: no page is written")
    lines = [f"Cases of validation/flight at 5 m/s, with cloth of 100 CFM and {CELLS_ACROSS} cells across the projected diameter. The shape is rigid and that of "
             "the steady run on the axis. +-: standard error of the mean over time.", "",
             *tables.table(["family", "angle of attack deg", "C_T", "C_N", "C_m"], rows), "## Trim angles", "",
             *tables.table(["family", "trim angles deg"], trims)]
    tables.write("stability", "Static coefficients over the angle of attack", "make validate-stability", made, lines)
    print("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/static")
    parser.add_argument("--tables", action="store_true", help="only the page, of the curves that are finished")
    parser.add_argument("families", nargs="*", help="families; all of them without a name: " + ", ".join(FAMILIES))
    options = parser.parse_args()
    if not options.tables:
        for family in options.families or FAMILIES:
            compute(options, family)
    write_page(options)


if __name__ == "__main__":
    main()
