#!/usr/bin/env python3
"""Computes an opening: load over time as NumPy columns, energy balance, and peak tension of every line.

    python3 examples/python/opening.py examples/stratos-iv/case.toml --pressure 300 --out opening.csv
"""
import argparse

import numpy

import ripstop


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", help="case file")
    parser.add_argument("--pressure", type=float, help="difference over the canopy [Pa]; default: the case's")
    parser.add_argument("--cloth-nodes", type=int)
    parser.add_argument("--duration", type=float, help="[s]")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--out", help="a CSV file of the load over time")
    return parser.parse_args()


def main():
    options = arguments()
    keys = {"parachute.mesh.cloth_nodes": options.cloth_nodes, "inflation.duration_s": options.duration}
    case = ripstop.read_case(options.case, set={key: value for key, value in keys.items() if value})
    shown = 0.0

    def show(progress):
        nonlocal shown
        if progress.time_s >= shown:
            print(f"{1000 * progress.time_s:7.1f} of {1000 * progress.duration_s:.0f} ms   load {progress.load_n:8.1f} N")
            shown += progress.duration_s / 10

    opening = ripstop.inflate(case, pressure_pa=options.pressure, threads=options.threads, progress=show)
    load = opening.history["load_mean_n"]
    work = opening.frames["pressure_work_j"]
    steady = f", {opening.overshoot:.2f} times the steady load" if opening.overshoot else ", no steady load yet"
    print(f"peak {opening.peak_load_n:.1f} N at {1000 * opening.peak_time_s:.2f} ms{steady}")
    print(f"half of the rows are above {numpy.median(load):.1f} N; the air did {work[-1]:.2f} J of work")
    print("lines:", " ".join(f"{peak:.1f}" for peak in opening.line_peaks), "N")
    for warning in opening.warnings:
        print("warning:", warning)
    if options.out:
        numpy.savetxt(options.out, numpy.column_stack([opening.history["time_s"], load]), delimiter=",", header="time_s,load_mean_n", comments="")


if __name__ == "__main__":
    main()
