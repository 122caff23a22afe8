#!/usr/bin/env python3
"""Calibrates the damping C_a of an opening on a measured peak load.

    python3 examples/python/calibration.py --cloth-nodes 3000

Stratos IV at 30 m/s is the reference (examples/stratos-iv). After the search, the script computes the opening again with the
calibrated C_a and prints its peak next to the measured one.
"""
import argparse
import pathlib

import ripstop


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--case", default=pathlib.Path(ripstop.data_directory(), "examples/stratos-iv/case.toml"))
    parser.add_argument("--pressure", type=float, help="difference over the canopy [Pa]; default: that of the case's drag")
    parser.add_argument("--cloth-nodes", type=int, default=3000)
    parser.add_argument("--duration", type=float, default=0.3, help="of every opening [s]")
    parser.add_argument("--smallest", type=float, default=4, help="C_a [N s/m3]")
    parser.add_argument("--largest", type=float, default=16, help="C_a [N s/m3]")
    parser.add_argument("--points", type=int, default=7, help="openings over the range of C_a")
    parser.add_argument("--refinements", type=int, default=4, help="openings about the best of them")
    parser.add_argument("--threads", type=int, default=0)
    return parser.parse_args()


def main():
    options = arguments()
    case = ripstop.read_case(options.case, set={"parachute.mesh.cloth_nodes": options.cloth_nodes,
                                                "inflation.duration_s": options.duration})
    found = ripstop.calibrate_damping(
        case, pressure_pa=options.pressure, smallest=options.smallest, largest=options.largest, points=options.points, refinements=options.refinements,
        threads=options.threads,
        progress=lambda t: print(f"C_a {t.damping_n_s_m3:8.4f}   peak {t.peak_n:8.1f} N   misfit {100 * t.misfit:6.2f} %"))
    if found.best_is_at_the_edge:
        print("the best C_a lies at the edge of the range: it is none")
    case.set("inflation.damping_n_s_m3", found.damping_n_s_m3)
    opening = ripstop.inflate(case, pressure_pa=options.pressure, threads=options.threads)
    peak = opening.low_pass_peak_load_n or opening.peak_load_n
    print(f"C_a = {found.damping_n_s_m3:.4f} N s/m3: peak {peak:.1f} N, measured {found.measured_peak_n:.1f} N")


if __name__ == "__main__":
    main()
