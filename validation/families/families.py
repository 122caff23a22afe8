#!/usr/bin/env python3
"""Every family's example and the campaign's three parachutes in steady flow, under the air's own load and a uniform one.

    make validate-families            (or: families.py --ripstop build/bin/ripstop --runs runs/families)

Runs `ripstop steady` on each with the library's cloth as a sheet, its own permeability, nothing calibrated: once with
`coupling.load` "of-flow", the default, and once with "uniform". The drag of the families beside what Knacke's manual gives
for the type goes between the markers of docs/validation.md, both loads side by side into loads.md here; pictures and plots
stay in the run folders, `load.png` and `pressure.png` first. Runs that are finished cost nothing. `--grid 40 40 50 --set KEY=VALUE` pass on to `ripstop`, for a quick look;
tables are then printed only.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "validation/ojf"))
from campaign import SHEET_SPECIFIED  # noqa: E402

FAMILIES = ["flat-circular", "conical", "extended-skirt", "hemispherical", "quarter-spherical", "ringslot", "cross",
            "elliptical"]
CAMPAIGN = ["stratos-iv", "walrus", "adept"]  # their cases have the paper's box and porosity
LOADS = ["of-flow", "uniform"]
BEGIN, END = "<!-- families: begin -->", "<!-- families: end -->"


def run(options, name, load):
    folder = options.runs.resolve() / (name if load == "of-flow" else f"{name}-{load}")
    command = [str(options.ripstop.resolve()), "steady", f"examples/{name}/case.toml", "--out", str(folder)]
    settings = [f"coupling.load={load}", *(SHEET_SPECIFIED if name in CAMPAIGN else []), *options.set]
    for setting in settings:
        command += ["--set", setting]
    if options.grid:
        command += ["--grid", *map(str, options.grid)]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode != 0:
        print(f"{name}, {load}: ripstop failed; the same command again goes on from here", file=sys.stderr)
        return None
    return json.loads((folder / "result.json").read_text())


def families_table(results):
    lines = ["| example | drag coefficient | Knacke, in descent | projected / nominal diameter | drag N | iterations | wall s |",
             "|---|---|---|---|---|---|---|"]
    for name in FAMILIES:
        r = results[name, "of-flow"]
        known = r.get("known_drag_coefficient")
        printed = f"{known[0]:.2f} to {known[1]:.2f}" if known else ""
        nominal = (4 / math.pi * r["reference_area_m2"]) ** 0.5
        lines.append(f"| {name} | {r['drag_coefficient']:.3f} | {printed} | {r['projected_diameter_m'] / nominal:.3f} | "
                     f"{r['drag_n']:.1f} | {r['coupling_iterations']} | {r['wall_time_s']:.0f} |")
    return lines


def loads_table(results):
    lines = ["| example | load | drag N | projected diameter m | skirt m | highest line tension N | highest stress N/m | "
             "remainder % | coupling iterations |", "|---|---|---|---|---|---|---|---|---|"]
    for (name, load), r in results.items():
        if r is None:
            lines.append(f"| {name} | {load} | failed | | | | | | |")
            continue
        count = f"{r['coupling_iterations']}" + ("" if r["converged"] else ", not converged")
        remainder = f"{100 * r['load_remainder']:.2f}" if load == "of-flow" else ""
        lines.append(f"| {name} | {load} | {r['drag_n']:.1f} | {r['projected_diameter_m']:.3f} | {r['skirt_diameter_m']:.3f} | "
                     f"{r['max_line_tension_n']:.1f} | {r['max_von_mises_n_m']:.0f} | {remainder} | {count} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/families")
    parser.add_argument("--grid", type=int, nargs=3)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("names", nargs="*", default=FAMILIES + CAMPAIGN, help="examples; all of them without a name")
    options = parser.parse_args()
    results = {(name, load): run(options, name, load) for name in options.names for load in LOADS}
    loads = loads_table(results)
    print("\n".join(loads))
    if options.grid or options.set or options.names != FAMILIES + CAMPAIGN:
        return
    if None in results.values():
        sys.exit("a run failed: no table is written")
    head = ["# The air's own load beside a uniform one", "",
            "`make validate-families` makes this table; [coupling](../../docs/theory/coupling.md#from-the-flows-force-to-the-cloths-load) says what "
            "the loads are. Each run's `load.png` and `pressure.png` show its pressures.", ""]
    (HERE / "loads.md").write_text("\n".join([*head, *loads, ""]))
    document = ROOT / "docs/validation.md"
    before, rest = document.read_text().split(BEGIN)
    document.write_text(before + "\n".join([BEGIN, "", *families_table(results), "", END]) + rest.split(END)[1])


if __name__ == "__main__":
    main()
