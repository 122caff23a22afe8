#!/usr/bin/env python3
"""Computes the drag area of a parachute by a coupled run, and with it the descent of a payload.

    python3 examples/python/flight.py examples/flat-circular/case.toml --mass 0.5 --apogee 800 --out flight.csv

The flight has line stretch, filling and descent of a point mass in the standard atmosphere. For a complete rocket, `--rocketpy FILE`
writes the same parachute as the arguments of RocketPy's Rocket.add_parachute.
"""
import argparse
import pathlib

import numpy

import ripstop


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", help="case file, or the folder of a finished run of ripstop steady")
    parser.add_argument("--mass", type=float, default=0.5, help="of the payload [kg]")
    parser.add_argument("--apogee", type=float, default=800, help="above sea level [m]")
    parser.add_argument("--speed", type=float, default=15, help="through the air at line stretch [m/s]")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--out", help="a CSV file of the way")
    parser.add_argument("--rocketpy", help="a file for RocketPy's lines; default: the terminal")
    return parser.parse_args()


def parachute(options):
    """A coupled run, or the folder of one, and its case."""
    if pathlib.Path(options.case).is_dir():
        return options.case, ripstop.read_case(pathlib.Path(options.case, "case.toml"))
    case = ripstop.read_case(options.case)
    print(f"{case.title}: one line a coupling iteration")
    run = ripstop.steady(case, threads=options.threads, progress=lambda i: print(f"  {i.iteration:3d}  drag {i.drag_n:8.2f} N"))
    print(f"drag area {run.drag_area_m2:.4f} m2, {'converged' if run.converged else 'NOT converged'}")
    return run, case


def main():
    options = arguments()
    run, case = parachute(options)
    flight = ripstop.load(case, options.mass, options.speed, height_m=options.apogee, path_angle_deg=0, steady=run)
    way = flight.flight
    print(f"peak load {flight.peak_load_n:.1f} N after {flight.peak_time_s:.2f} s; steady from {flight.steady_time_s:.1f} s on")
    for row in ripstop.descent(run, options.mass, heights_m=[0, options.apogee]).heights:
        print(f"at {row.height_m:6.0f} m: {row.speed_m_s:.2f} +- {row.speed_uncertainty_m_s:.2f} m/s")
    if options.out:
        numpy.savetxt(options.out, numpy.array(way.tolist()), delimiter=",", header=",".join(way.dtype.names), comments="")
    lines = ripstop.export(run, deployment_speed_m_s=options.speed).rocketpy("apogee")
    if options.rocketpy:
        pathlib.Path(options.rocketpy).write_text(lines)
    else:
        print(lines)


if __name__ == "__main__":
    main()
