#!/usr/bin/env python3
"""Time of whole runs of two builds, run alternately: bench/runs_side_by_side.py OLD NEW [--rounds 3] [RUN ...]

OLD and NEW are trees with a program in build/bin/ripstop; each runs with its own examples and materials. Prints for each run the
median wall times, the median of their ratios, the results of both, and the largest memory. Use it on an idle machine.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

README = """title = "My canopy at 20 m/s"
[parachute]
type = "flat-circular"
nominal_diameter_m = 1.0
vent_diameter_m = 0.1
gores = 12
lines = { count = 12, length_m = 1.0 }
[flow]
speed_m_s = 20
density_kg_m3 = 1.2
"""
STEADY = ("drag_n", "coupling_iterations")
# Stratos IV with its own cloth in the open jet, as in docs/performance.md.
OPEN_JET = [part for pair in (
    "flow.porosity_model=sheet", "parachute.canopy_material=f-111-physical", "flow.tunnel.kind=open-jet", "flow.tunnel.shape=octagon",
    "flow.tunnel.width_m=2.85", "flow.box_m=[8,8,9]", "flow.tunnel.nozzle_distance_m=3", "flow.tunnel.shear_layer_m=0.1",
    "flow.cells=[110,110,122]", "inflation.line_segment_m=0.06", "inflation.cloth_damping_s=1e-5", "parachute.mesh.cloth_nodes=12800",
    "flow.density_kg_m3=1.2", "inflation.initial_radius_m=0.1", "inflation.frames=1") for part in ("--set", pair)]
# Name: required ratio, arguments, members of result.json. {readme} and {payload} are case files that both builds read.
RUNS = {
    "readme": (2.5, ["steady", "{readme}"], STEADY),
    "payload": (3, ["steady", "{payload}"], STEADY),
    "unsteady": (1.8, ["steady", "{readme}", "--unsteady"], STEADY + ("drag_standard_error_n",)),
    "opening": (2, ["inflate", "validation/ojf/stratos-iv.toml", "--air", "coupled", "--speed", "27.1", *OPEN_JET],
                ("peak_load_n", "filling_time_s", "energy_residual")),
}


def run(tree, arguments, folder):
    """Wall time [s], peak memory [MB] and result.json of one run."""
    command = [str(tree / "build/bin/ripstop"), *arguments, "--out", str(folder)]
    log = folder.with_suffix(".log")
    with log.open("w") as output:
        start = time.monotonic()
        process = subprocess.Popen(command, cwd=tree, stdout=output, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
    code = os.waitstatus_to_exitcode(status)
    if code not in (0, 4):  # 4: not converged
        sys.exit(f"{' '.join(command)}: exit code {code}\n{log.read_text()}")
    return seconds, used.ru_maxrss / 1024, json.loads((folder / "result.json").read_text())


def shown(result, members):
    found = {**result, **(result.get("unsteady") or {})}
    return ", ".join(f"{name} {found[name]:.6g}" for name in members if isinstance(found.get(name), (int, float)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="of every run of both builds")
    parser.add_argument("runs", nargs="*", metavar="RUN", help=", ".join(RUNS) + "; default: all")
    options = parser.parse_intermixed_args()
    if not set(options.runs) <= set(RUNS):
        parser.error(f"RUN is one of {', '.join(RUNS)}")
    trees = [options.old.resolve(), options.new.resolve()]
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        (work / "readme.toml").write_text(README)
        subprocess.run([str(trees[0] / "build/bin/ripstop"), "size", "--mass", "2.4", "--descent-rate", "5", "--family", "flat-circular",
                        "--height", "300", "--out", str(work / "payload.toml")], cwd=trees[0], check=True, stdout=subprocess.DEVNULL)
        files = {"readme": work / "readme.toml", "payload": work / "payload.toml"}
        print("| run | before, s | now, s | ratio | required | memory, MB | before | now |\n|---|---|---|---|---|---|---|---|")
        for label in options.runs or RUNS:
            required, arguments, members = RUNS[label]
            arguments = [part.format(**files) for part in arguments] + [part for pair in options.set for part in ("--set", pair)]
            seconds, memory, results = ([], []), [0, 0], [None, None]
            for number in range(options.rounds):
                for which in (0, 1) if number % 2 == 0 else (1, 0):
                    wall, most, results[which] = run(trees[which], arguments, work / f"{label}-{number}-{which}")
                    seconds[which].append(wall)
                    memory[which] = max(memory[which], most)
                    print(f"{label}, {('before', 'now')[which]}: {wall:.1f} s", file=sys.stderr, flush=True)
            ratio = statistics.median(a / b for a, b in zip(*seconds))
            print(f"| {label} | {statistics.median(seconds[0]):.1f} | {statistics.median(seconds[1]):.1f} | {ratio:.2f} | {required} | "
                  f"{memory[0]:.0f}, {memory[1]:.0f} | "
                  f"{shown(results[0], members)} | {shown(results[1], members)} |", flush=True)


if __name__ == "__main__":
    main()
