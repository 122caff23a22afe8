#!/usr/bin/env python3
"""Time of OpenFOAM's iterations on 1, 2, 4, ... ranks of this machine, up to its cores: docs/tables/ranks.md."""
import argparse
import pathlib
import os
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import tables  # noqa: E402

ITERATIONS = 25
TIMES = re.compile(r"ExecutionTime = (\S+) s  ClockTime = (\S+) s")


def measure(program, grid, ranks, folder):
    """Seconds of an iteration: processor time of a rank, and wall time."""
    out = folder / f"{grid.replace(',', 'x')}-{ranks}"
    done = subprocess.run([program, "steady", tables.ROOT / "examples/stratos-iv/case.toml", "--speed", "30", "--flow", "openfoam", "--ranks", str(ranks),
                           "--grid", grid, "--set", "parachute.mesh.cloth_nodes=1500", "--set", f"flow.max_iterations={ITERATIONS}", "--set", "coupling.max_iterations=1", "--out", out],
                          capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SystemExit(done.stderr)
    times = [tuple(map(float, pair)) for pair in TIMES.findall((out / "flow/log.rhoPorousSimpleFoam").read_text())]
    first, last = times[4], times[-1]  # the start reads the mesh
    count = len(times) - 5
    return (last[0] - first[0]) / count, (last[1] - first[1]) / count


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ripstop", type=pathlib.Path, required=True)
    parser.add_argument("--grids", nargs="*", default=["50,50,75", "100,100,150"])
    parser.add_argument("--repeat", type=int, default=2, help="the least of so many, as other work only adds")
    options = parser.parse_args()
    cores = len(os.sched_getaffinity(0))
    ranks = [n for n in (2 ** i for i in range(12)) if n <= cores]
    rows, load = [], []
    with tempfile.TemporaryDirectory(prefix="ripstop-ranks-") as work:
        for grid in options.grids:
            nx, ny, nz = map(int, grid.split(","))
            alone = None
            for n in ranks:
                best = None
                for again in range(options.repeat):
                    load.append(os.getloadavg()[0])
                    folder = pathlib.Path(work) / str(again)
                    times = measure(options.ripstop.resolve(), grid, n, folder)
                    best = times if best is None else tuple(map(min, best, times))
                alone = alone or best
                rows.append([f"{nx} x {ny} x {nz}", str(n), f"{nx * ny * nz / n:,.0f}", f"{best[0]:.2f}", f"{alone[0] / best[0]:.2f}",
                             f"{best[1]:.2f}", f"{alone[1] / best[1]:.2f}"])
                print(" | ".join(rows[-1]), flush=True)
        lines = [f"Shortest of {options.repeat} runs of {ITERATIONS} iterations each, on {cores} cores. The load average at the start was {min(load):.1f} to "
                 f"{max(load):.1f}, including these runs. Above {cores}, other work shared the cores; the processor time is then more meaningful than the wall time.", "",
                 *tables.table(["cells", "ranks", "cells per rank", "processor time per iteration and rank, s", "speed-up", "wall time per iteration, s", "speed-up"], rows)]
        tables.write("ranks", "OpenFOAM on several ranks", "make scaling", tables.runs_below(work), lines)


if __name__ == "__main__":
    main()
