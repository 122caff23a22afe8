#!/usr/bin/env python3
"""Writes the SYNTHETIC records of this example: no bench measured them.

The warp and weft curve is that of F-111 in [NFM] Table 3; the 45 deg curve is a virtual coupon of that cloth
with xi = 0.2 and eps = 0.01. Every sample has its own stiffness (3 %), failure strain, slack and noise, and
a drop at failure; two samples have points out of order, one bench writes pounds and inches.

    ripstop coupon f-111 --orientation 45 --strain 0.36 --points 36 --out bias
    make_records.py bias/coupon.csv
"""
import csv
import random
import sys
from pathlib import Path

K1, K2 = 30006.0, -18936.0
LENGTH, WIDTH = 0.2, 0.05  # m


def yarn(strain):
    return K1 * strain + K2 * strain**2


def table(path):
    rows = [(0.0, 0.0)]
    with open(path, newline="") as file:
        rows += [(float(r["strain"]), float(r["load_n_per_m"])) for r in csv.DictReader(file)]

    def load(strain):
        for (a, fa), (b, fb) in zip(rows, rows[1:]):
            if strain <= b:
                return fa + (fb - fa) * (strain - a) / (b - a)
        return rows[-1][1]

    return load


def sample(name, angle, curve, failure, chance, inch_pounds=False, shuffle=False):
    stiffness = chance.gauss(1, 0.03)
    fails = min(0.35, chance.gauss(failure, 0.01))
    slack = chance.uniform(0.0005, 0.003)
    peak = stiffness * curve(fails) * WIDTH
    points = chance.randint(110, 150)
    travel = slack + 1.04 * fails * LENGTH
    error, rows = 0.0, []
    for i in range(points + 1):
        x = travel * i / points
        strain = (x - slack) / LENGTH
        force = stiffness * curve(strain) * WIDTH if 0 < strain <= fails else 0.0
        if strain > fails:
            force = 0.15 * peak
        error = 0.7 * error + 0.714 * chance.gauss(0, 1)
        rows.append((x, force + 0.004 * peak * error))
    if shuffle:
        rows[40], rows[47] = rows[47], rows[40]
    length, force = (0.0254, 4.4482216152605) if inch_pounds else (1e-3, 1.0)
    head = "load [lbf],crosshead travel [in]" if inch_pounds else "extension [mm],force [N]"
    lines = ["# SYNTHETIC record, see make_records.py: not a measurement", f"# length: {1e3 * LENGTH:g} mm",
             f"# width: {1e3 * WIDTH:g} mm", f"# orientation: {angle} deg", head]
    for x, f in rows:
        a, b = f"{x / length:.5f}", f"{f / force:.4f}"
        lines.append(f"{b},{a}" if inch_pounds else f"{a},{b}")
    Path(name).write_text("\n".join(lines) + "\n")


def main():
    chance = random.Random(1960)
    folder = Path(__file__).parent / "records"
    folder.mkdir(exist_ok=True)
    bias = table(sys.argv[1])
    for i in range(1, 6):
        sample(folder / f"warp-{i}.csv", 0, yarn, 0.33, chance, shuffle=i == 2)
        sample(folder / f"weft-{i}.csv", 90, yarn, 0.33, chance, inch_pounds=True)
        sample(folder / f"bias-{i}.csv", 45, bias, 0.33, chance, shuffle=i == 4)


main()
