#!/usr/bin/env python3
"""A descent trade study: canopy families x nominal diameters under one payload.

    python3 examples/python/trade_study.py --mass 2.4 --diameters 1.2 1.5 1.8 --out trade.csv

Mass and packed volume are those of the parachute as cut. The drag coefficient is that of the family (examples/families.json).
With --fly it is that of a coupled run of each parachute, which takes minutes. Design with highest_design_load_n, the design load
plus its uncertainty. finite_mass_load_n is the highest load of the applicable methods that compute the deceleration of the payload
while the canopy fills, and trajectory_peak_n is that of the trajectory; a canopy that fills faster has larger loads. Every size has
the tape of the example; for small sizes use --set 'parachute.tape.material="none"'.
"""
import argparse
import csv
import json
import math
import pathlib
import sys

import ripstop


def parachute(family, diameter, keys):
    """The family's example in this nominal diameter [m]."""
    example = ripstop.read_case(pathlib.Path(ripstop.data_directory(), "examples", family, "case.toml"), set=keys)
    own = math.sqrt(4 / math.pi * ripstop.check(example).nominal_area_m2)
    return example.scaled(diameter / own)


def row_of(family, diameter, drag_coefficient, options):
    case = parachute(family, diameter, options.set)
    if options.fly:
        drag_coefficient = ripstop.steady(case).drag_coefficient
    cut = ripstop.pattern(case)
    load = ripstop.load(case, options.mass, options.speed, height_m=options.height, drag_coefficient=drag_coefficient)
    finite_mass = [method.load_n for method in load.stages[-1].methods if method.applies and method.method != "infinite mass"]
    return {"family": family, "nominal_diameter_m": diameter, "drag_coefficient": drag_coefficient, "parachute_mass_kg": cut.mass_kg,
            "packed_volume_l": 1000 * cut.packed_volume_m3, "descent_rate_m_s": load.flight["speed_m_s"][-1],
            "design_load_n": load.design_load_n, "highest_design_load_n": load.highest_design_load_n,
            "margin_of_safety": load.smallest_margin_of_safety, "weakest_member": load.smallest_margin_member,
            "finite_mass_load_n": max(finite_mass, default=None), "trajectory_peak_n": load.peak_load_n}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mass", type=float, default=2.4, help="of the payload [kg]")
    parser.add_argument("--speed", type=float, default=25, help="through the air at line stretch [m/s]")
    parser.add_argument("--height", type=float, default=300, help="above sea level there [m]")
    parser.add_argument("--families", nargs="+", default=["flat-circular", "conical", "cross", "ringslot"])
    parser.add_argument("--diameters", nargs="+", type=float, default=[1.2, 1.5, 1.8], help="nominal [m]")
    parser.add_argument("--fly", action="store_true", help="compute every drag by a coupled run")
    parser.add_argument("--set", nargs="*", default=[], metavar="KEY=VALUE", help="of every case; values as in JSON")
    parser.add_argument("--out", help="a CSV file; default: the terminal")
    options = parser.parse_args()
    options.set = {key: json.loads(value) for key, value in (text.split("=", 1) for text in options.set)}
    return options


def main():
    options = arguments()
    drag = {row.family: row.drag_coefficient for row in ripstop.families()}
    rows = [row_of(family, diameter, drag[family], options) for family in options.families for diameter in options.diameters]
    file = open(options.out, "w", newline="") if options.out else sys.stdout
    table = csv.DictWriter(file, rows[0].keys())
    table.writeheader()
    table.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows)


if __name__ == "__main__":
    main()
