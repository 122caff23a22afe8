#!/usr/bin/env python3
"""Computes clusters of flat circular canopies in steady flow: the force angle over the spread angle, and the cluster factor over the
size of the domain.

    make validate-clusters            (or: clusters.py --ripstop build/bin/ripstop --runs runs/clusters)

All runs are those of examples/cluster-of-three with 1500 nodes of cloth and a quarter of the flow. The spread angle of two canopies is
varied in one domain, on 0.7 of the default cells along each axis. Four canopies and a single one are computed in the same domains and
cells: the default of four canopies, and 1.5 times as wide or as long, with the same cells at the canopies. They have 0.6 of the default
cells along each axis. Their flow does not come to rest: the values are means over the coupling iterations 4 to 8, with the standard
deviation. The table is docs/tables/clusters.md. Finished runs are not repeated, and `--threads` sets the threads of a run.
"""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation"))
import tables  # pylint: disable=wrong-import-position

CASE = ROOT / "examples/cluster-of-three/case.toml"
ALL = ["parachute.mesh.cloth_nodes=1500", "flow.symmetry=quarter"]
ANGLES = [14, 18, 24, 30, 34, 38]  # [deg]
WIDEST = 40  # of the domain in which they are computed [deg]
COARSER, COARSEST = 0.7, 0.6  # cells along each axis relative to the default
FIRST, LAST = 4, 8  # iterations of the means
LARGER = 1.5
# Cells that are added outside the core of fine cells for a domain LARGER times as wide or as long, for the same cells in the core.
MORE_ACROSS, MORE_ALONG = 8, 8


def overridden(values):
    """Options of `ripstop`; None removes a table."""
    return [word for value in values for word in (("--unset", value[1:]) if value.startswith("!") else ("--set", value))]


def domain_of(options, values):
    """Keys of [flow] that give the default domain."""
    command = [options.ripstop, "check", CASE, "--resolved", *overridden(ALL + values)]
    flow = tomllib.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["flow"]
    return {"box_m": flow["box_m"], "cells": flow["cells"], "canopy_position_m": flow["canopy_position_m"],
            "core.size_m": flow["core"]["size_m"], "core.start_m": flow["core"]["start_m"]}


def wider(domain):
    """Farther sides."""
    (x, y, z), (nx, ny, nz) = domain["box_m"], domain["cells"]
    return domain | {"box_m": [LARGER * x, LARGER * y, z], "cells": [nx + MORE_ACROSS, ny + MORE_ACROSS, nz]}


def longer(domain):
    """Inlet and outlet farther away."""
    (x, y, z), (nx, ny, nz) = domain["box_m"], domain["cells"]
    skirts = LARGER * domain["canopy_position_m"]
    return domain | {"box_m": [x, y, LARGER * z], "cells": [nx, ny, nz + MORE_ALONG], "canopy_position_m": skirts,
                     "core.start_m": domain["core.start_m"] + skirts - domain["canopy_position_m"]}


def run(options, name, domain, values):
    """Result of the run."""
    folder = options.runs.resolve() / name
    keys = [f"flow.{key}={json.dumps(value)}" for key, value in domain.items()]
    command = [options.ripstop, "steady", CASE, "--out", folder,
               *overridden(ALL + keys + values + [f"coupling.threads={options.threads}"])]
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    return json.loads((folder / "result.json").read_text())


def coarse(domain, share):
    """Fewer cells, even numbers of them."""
    return domain | {"cells": [2 * round(0.5 * share * n) for n in domain["cells"]]}


def deficit(result):
    """Momentum deficit relative to the drag, in percent."""
    return f"{100 * (result['ledger']['momentum_deficit_n'] / result['drag_n'] - 1):+.1f}"


def means(options, name, domain, values):
    """Drag coefficient, its standard deviation, and momentum deficit as a coefficient, over the last iterations."""
    result = run(options, name, domain, values + [f"coupling.max_iterations={LAST}", "coupling.drag_tolerance=1e-6"])
    rows = list(csv.DictReader(open(options.runs.resolve() / name / "iterations.csv", encoding="utf-8")))[FIRST - 1:]
    scale = result["drag_coefficient"] / result["drag_n"]
    drag, momentum = ([scale * float(row[key]) for row in rows] for key in ("drag_n", "momentum_deficit_n"))
    return statistics.mean(drag), statistics.stdev(drag), statistics.mean(momentum)


def of_angles(options):
    """Two canopies at each spread angle."""
    domain = domain_of(options, ["cluster.canopies=2", f"cluster.spread_angle_deg={WIDEST}"])
    domain = coarse(domain, COARSER)
    rows = []
    for angle in ANGLES:
        result = run(options, f"two-{angle}", domain, ["cluster.canopies=2", f"cluster.spread_angle_deg={angle}"])
        cluster = result["cluster"]
        rows.append([f"{angle}", f"{result['drag_coefficient']:.3f}", f"{cluster['force_angle_deg']:.1f}", f"{cluster['gap_m']:.2f}",
                     "yes" if result["converged"] else "no", deficit(result)])
    return rows


def of_domains(options):
    """Four canopies, and one in the same domain."""
    default = domain_of(options, ["cluster.canopies=4"])
    rows = []
    for name, domain in {"default of four canopies": default, f"{LARGER} times as wide": wider(default),
                         f"{LARGER} times as long": longer(default)}.items():
        folder, domain = name.replace(" ", "-"), coarse(domain, COARSEST)
        four, one = (means(options, f"{who}-{folder}", domain, values)
                     for who, values in (("four", ["cluster.canopies=4"]), ("one", ["!cluster"])))
        rows.append([name, f"{four[0]:.3f} +- {four[1]:.3f}", f"{four[2]:.3f}", f"{one[0]:.3f} +- {one[1]:.3f}", f"{one[2]:.3f}",
                     f"{four[0] / one[0]:.3f}", f"{four[2] / one[2]:.3f}"])
    return rows


def main():
    """Runs and table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/clusters")
    parser.add_argument("--threads", type=int, default=0)
    options = parser.parse_args()
    options.ripstop = options.ripstop.resolve()
    lines = [f"## Force angle of two canopies over the spread angle, {COARSER} of the default cells along each axis", "",
             *tables.table(["spread angle deg", "drag coefficient", "force angle deg", "gap m", "converged", "momentum deficit - drag %"],
                           of_angles(options)),
             f"## Four canopies at 18 degrees and one canopy in the same domain, {COARSEST} of the default cells along each axis", "",
             *tables.table(["domain", "C_D of four", "from the momentum deficit", "C_D of one", "from the momentum deficit", "ratio of C_D",
                            "ratio from the momentum deficit"], of_domains(options))]
    tables.write("clusters", "Clusters of flat circular canopies in steady flow", "make validate-clusters",
                 tables.runs_below(options.runs), lines)


if __name__ == "__main__":
    main()
