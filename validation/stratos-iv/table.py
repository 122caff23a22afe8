#!/usr/bin/env python3
"""Writes the table of Stratos IV's steady runs, docs/tables/stratos-iv.md.

Usage: table.py RUNS. RUNS contains the run folders <engine>-<speed> of `make validate`; missing ones are
left out. Every number comes from their result.json and run.json.
"""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import tables  # pylint: disable=wrong-import-position

HEAD = ["engine", "nominal m/s", "computed N", "measured N", "error %", "printed N", "drag area m2", "iterations", "converged",
        "force imbalance %", "wall s"]
FOOT = "Force imbalance: the larger deviation of cloth load and line load from the air load."


def row(folder):
    result = json.loads((folder / "result.json").read_text())
    run = json.loads((folder / "run.json").read_text())
    measured = result["measured"]
    ledger = result["ledger"]
    gap = max(abs(ledger[k] / ledger["fluid_force_n"] - 1) for k in ("nodal_load_n", "line_tension_n"))
    return [run["flow_engine"].split(" (")[0], f"{result['speed_m_s']:g}", f"{result['drag_n']:.1f}", f"{measured['drag_n']:.1f}",
            f"{100 * (result['drag_n'] / measured['drag_n'] - 1):+.1f}", f"{measured['printed_nonlinear_n']:.1f}",
            f"{result['drag_area_m2']:.4f}", str(result["coupling_iterations"]), "yes" if result["converged"] else "NO",
            f"{100 * gap:.3f}", f"{result['wall_time_s']:.0f}"], run


def main():
    runs = pathlib.Path(sys.argv[1])
    folders = [runs / f"{engine}-{speed}" for engine in ("builtin", "openfoam") for speed in (10, 15, 20, 25, 30)]
    done = [row(folder) for folder in folders if (folder / "result.json").exists()]
    if not done:
        sys.exit(f"{runs}: no finished run")
    rows, started = zip(*done)
    tables.write("stratos-iv", "Steady drag of Stratos IV on the printed grid", "make validate", started, tables.table(HEAD, rows) + [FOOT])


if __name__ == "__main__":
    main()
