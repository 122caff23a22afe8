#!/usr/bin/env python3
"""Writes the table of Stratos IV's steady runs between the markers of a Markdown file.

Usage: table.py RUNS MARKDOWN. RUNS holds the run folders <engine>-<speed> that `make validate` leaves; those that do
not exist are left out. Every number comes from their result.json and run.json.
"""
import json
import pathlib
import sys

BEGIN, END = "<!-- stratos-iv steady: begin -->", "<!-- stratos-iv steady: end -->"
HEAD = [
    "| engine | nominal m/s | computed N | measured N | error % | printed N | drag area m2 | iterations | converged "
    "| ledger gap % | wall s |",
    "|---|---|---|---|---|---|---|---|---|---|---|",
]


def row(folder):
    result = json.loads((folder / "result.json").read_text())
    run = json.loads((folder / "run.json").read_text())
    measured = result["measured"]
    ledger = result["ledger"]
    gap = max(abs(ledger[k] / ledger["fluid_force_n"] - 1) for k in ("nodal_load_n", "line_tension_n"))
    text = "| {} | {:g} | {:.1f} | {:.1f} | {:+.1f} | {:.1f} | {:.4f} | {} | {} | {:.3f} | {:.0f} |".format(
        run["flow_engine"].split(" (")[0], result["speed_m_s"], result["drag_n"], measured["drag_n"],
        100 * (result["drag_n"] / measured["drag_n"] - 1), measured["printed_nonlinear_n"], result["drag_area_m2"],
        result["coupling_iterations"], "yes" if result["converged"] else "NO", 100 * gap, result["wall_time_s"])
    return text, run


def main():
    runs, markdown = map(pathlib.Path, sys.argv[1:])
    lines, machines = [], set()
    for engine in ("builtin", "openfoam"):
        for speed in (10, 15, 20, 25, 30):
            folder = runs / f"{engine}-{speed}"
            if (folder / "result.json").exists():
                text, run = row(folder)
                lines.append(text)
                machines.add(f"{run['processor']}, {run['threads']} threads, {run['started'][:10]}")
    if not lines:
        sys.exit(f"{runs}: no finished run")
    text = markdown.read_text()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    table = "\n".join([BEGIN, "", *HEAD, *lines, "", "Run on: " + "; ".join(sorted(machines)) + ".", "", END])
    markdown.write_text(before + table + after)


if __name__ == "__main__":
    main()
