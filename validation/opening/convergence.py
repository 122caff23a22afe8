#!/usr/bin/env python3
"""Convergence of the mean peak of openings of Stratos IV in the open jet with the nodes of the cloth and the cells of the air.

    make validate-convergence        (or: convergence.py --ripstop build/bin/ripstop --runs runs/convergence --threads 2)

Writes docs/tables/convergence.md. The openings of a row differ in a perturbation of the folds. Finished openings are not computed again.
"""
import math
import sys

import openings

sys.path.insert(0, str(openings.ROOT / "validation"))
import tables  # pylint: disable=wrong-import-position

CASE = "validation/ojf/stratos-iv.toml"
KEYS = {"flow.porosity_model": "sheet", "parachute.canopy_material": "f-111-physical", "flow.speed_m_s": "27.1", "flow.density_kg_m3": "1.2",
        "flow.tunnel.kind": "open-jet", "flow.tunnel.shape": "octagon", "flow.tunnel.width_m": "2.85", "flow.box_m": "[8,8,9]",
        "flow.tunnel.nozzle_distance_m": "3", "flow.tunnel.shear_layer_m": "0.1", "flow.cells": "[110,110,122]",
        "inflation.line_segment_m": "0.06", "inflation.initial_radius_m": "0.1", "inflation.low_pass_hz": "100",
        "inflation.duration_s": "0.125", "inflation.frames": "25", "parachute.mesh.cloth_nodes": "9000"}
ROWS = {"base": {}, "nodes": {"parachute.mesh.cloth_nodes": "18000"}, "cells": {"flow.cells": "[152,152,168]"}}
OPENINGS = {"base": 8, "nodes": 8, "cells": 4}  # one on the finer cells takes about three times as long


def keys_of(row):
    return {**KEYS, **ROWS[row]}


def compute(options, row):
    """Result of the samples of a row."""
    return openings.run(options, CASE, keys_of(row), options.runs.resolve() / row, "--samples", str(OPENINGS[row]))


HEAD = ["cloth nodes", "cells", "openings", "mean peak N", "standard deviation N", "lowest to highest N", "change of the mean %", "standard error of the change %"]


def row_of(row, result, base):
    peak, keys = result["low_pass_peak_load_n"], keys_of(row)
    first = base["low_pass_peak_load_n"]
    error = math.sqrt(sum((one["standard_deviation"] / one["mean"]) ** 2 / one["openings"] for one in (peak, first)))
    changed = ["", ""] if result is base else [f"{100 * (peak['mean'] / first['mean'] - 1):+.1f}", f"{100 * error:.1f}"]
    return [keys["parachute.mesh.cloth_nodes"], keys["flow.cells"].strip("[]").replace(",", " x "), str(peak["openings"]), f"{peak['mean']:.0f}",
            f"{peak['standard_deviation']:.0f}", f"{peak['lowest']:.0f} to {peak['highest']:.0f}", *changed]


def main():
    parser = openings.arguments(__doc__, "convergence", ROWS)
    options = parser.parse_args()
    try:
        done = {row: compute(options, row) for row in options.rows.split(",")}
    except openings.Failed as failed:
        sys.exit(f"{failed}; the same command again continues")
    if "base" not in done:
        sys.exit("the row base is missing: no table is written")
    lines = [
        "100 Hz peak of coupled openings of Stratos IV in the open jet at 27.1 m/s. The openings of a row differ in a perturbation of the folds "
        "(`inflation.imperfection_seed` 1 to 8). The changes are relative to the first row.", "",
        *tables.table(HEAD, [row_of(row, result, done["base"]) for row, result in done.items()])]
    tables.write("convergence", "Convergence of the opening load", "make validate-convergence",
                 [run for row in done for run in tables.runs_below(options.runs.resolve() / row)], lines)
    print("\n".join(lines))


if __name__ == "__main__":
    main()
