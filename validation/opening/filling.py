#!/usr/bin/env python3
"""Filling of one canopy: parameters that change distance and load of its opening.

    make validate-filling             (or: filling.py --ripstop build/bin/ripstop --runs runs/filling)

Coupled openings of the flat circular canopy of 1.76 m (validation/flight/flat-circular.toml) with 2.4 kg at 20 m/s, on
coarse cells. One parameter is changed at a time. Writes docs/tables/filling.md and filling.svg. A finished run is not
computed again, and an interrupted one continues. `--rows base,mass-10` computes these rows only.
"""
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation"))
import openings  # pylint: disable=wrong-import-position
import tables  # pylint: disable=wrong-import-position

CASE = "validation/flight/flat-circular.toml"
DIAMETER, DENSITY = 1.76, 1.2  # [m], [kg/m3]: of the case
COARSE = {"flow.cells": "[48,48,60]", "parachute.mesh.cloth_nodes": "1200", "inflation.cloth_damping_s": "1e-5",
          "inflation.low_pass_hz": "100", "inflation.frames": "100", "inflation.initial_radius_m": "0.16",
          "flow.speed_m_s": "20", "payload.mass_kg": "2.4", "inflation.mass": "payload"}
TRAVEL = 6.0  # of the payload at the speed of deployment, until a run ends [m]
HELD = {"inflation.mass": "infinite"}
# name: (subject, changed keys)
ROWS = {
    "base": ("as stated", {}),
    "radius-0.14": ("radius of the folded skirt 0.14 m", {"inflation.initial_radius_m": "0.14"}),
    "radius-0.25": ("radius of the folded skirt 0.25 m", {"inflation.initial_radius_m": "0.25"}),
    "folds-24": ("24 folds", {"inflation.folds": "24"}),
    "cloth-3": ("cloth of 1.75 CFM", {"parachute.canopy_material": "pia-c-44378-type-iv"}),
    "mass-0.5": ("0.5 kg", {"payload.mass_kg": "0.5"}),
    "mass-10": ("10 kg", {"payload.mass_kg": "10"}),
    "held": ("fixed in the stream", HELD),
    "speed-15": ("15 m/s", {"flow.speed_m_s": "15"}),
    "speed-40": ("40 m/s", {"flow.speed_m_s": "40"}),
    "cells-64": ("64 x 64 x 80 cells", {"flow.cells": "[64,64,80]"}),
}


def run(options, name):
    """The result of one row."""
    keys = {**COARSE, **ROWS[name][1]}
    keys["inflation.duration_s"] = f"{TRAVEL / float(keys['flow.speed_m_s']):g}"
    return openings.run(options, CASE, keys, options.runs.resolve() / name)


def measures(options, name, r):
    folder = options.runs.resolve() / name
    speed = float({**COARSE, **ROWS[name][1]}["flow.speed_m_s"])
    peak, time = r["low_pass_peak_load_n"], r["low_pass_peak_time_s"]
    half = openings.half_area_time(folder)
    pressure = DENSITY / 2 * speed ** 2 * math.pi / 4 * DIAMETER ** 2
    return {"peak": peak, "way": openings.travelled(folder, speed, time) / DIAMETER,
            "half": openings.travelled(folder, speed, half) / DIAMETER, "filled": r.get("filling_distance_diameters"),
            "on_area": peak / pressure, "energy": 100 * r["energy_residual"]}


def row_of(name, m, held):
    factor = f"{m['on_area'] / held['on_area']:.2f}" if held and name != "held" else ""
    filled = f"{m['filled']:.2f}" if m["filled"] else "not settled"
    return [ROWS[name][0], f"{m['peak']:.0f}", f"{m['way']:.2f}", f"{m['half']:.2f}", filled, f"{m['on_area']:.2f}", factor,
            f"{m['energy']:.2f}"]


def plot(options, done):
    """Projected area over the distance, as a small SVG."""
    width, height, left, low = 640, 360, 50, 320
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             'font-size="11">', f'<rect width="{width}" height="{height}" fill="white"/>']
    balances = {name: openings.columns(options.runs.resolve() / name, "balance.csv") for name in done}
    top = math.ceil(max(max(balance["projected_area_m2"]) for balance in balances.values()) / 0.5)  # in 0.5 m2
    for k in range(5):
        parts.append(f'<text x="{left + 100 * k}" y="{low + 16}" text-anchor="middle">{k}</text>')
    for k in range(top + 1):
        parts.append(f'<text x="{left - 6}" y="{low - 300 / top * k + 4:.1f}" text-anchor="end">{0.5 * k:g}</text>')
    parts.append(f'<text x="{left + 200}" y="{low + 34}" text-anchor="middle">distance / nominal diameter</text>')
    parts.append(f'<text x="{left}" y="14">projected area, m2</text>')
    parts.append(f'<path d="M{left} {low - 300}V{low}H{left + 400}" fill="none" stroke="black"/>')
    for i, name in enumerate(done):
        folder = options.runs.resolve() / name
        speed = float({**COARSE, **ROWS[name][1]}["flow.speed_m_s"])
        balance, colour = balances[name], f"hsl({i * 360 // len(done)},70%,40%)"
        points = [(openings.travelled(folder, speed, t) / DIAMETER, a)
                  for t, a in zip(balance["time_s"], balance["projected_area_m2"])]
        line = " ".join(f"{left + 100 * x:.1f},{low - 600 / top * a:.1f}" for x, a in points if x <= 4)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
        parts.append(f'<text x="{left + 410}" y="{30 + 16 * i}" fill="{colour}">{ROWS[name][0]}</text>')
    (ROOT / "docs/tables/filling.svg").write_text("\n".join([*parts, "</svg>"]) + "\n")


def main():
    options = openings.arguments(__doc__, "filling", ROWS).parse_args()
    done = {}
    for name in options.rows.split(","):
        try:
            done[name] = measures(options, name, run(options, name))
        except openings.Failed as failed:
            print(f"{name}: {failed}; the same command continues", file=sys.stderr)
    rows = [row_of(name, m, done.get("held")) for name, m in done.items()]
    table = tables.table(["changed", "peak at 100 Hz N", "distance to the peak / D0", "distance to half of the largest area / D0",
                          "filling distance / D0", "peak over q S0", "X_1", "energy residual %"], rows)
    print("\n".join(table))
    if set(done) != set(ROWS):
        return
    made = [folder for name in done for folder in tables.runs_below(options.runs.resolve() / name)]
    head = [f"Coupled openings of the canopy of {DIAMETER:g} m with a payload of 2.4 kg at 20 m/s on 48 x 48 x 60 cells; one parameter is "
            "changed in each row ([description](../validation/inflation.md#filling)). D0: nominal diameter. Distances are from the "
            "start of the coupled opening.", ""]
    foot = ["Filling distance: until the projected area first reaches its mean over the last fifth. Not settled: the area still grows there, "
            "or is less than twice that of the folded canopy. "
            "Fixed in the stream: constant speed (infinite mass). q S0: dynamic pressure at the start times nominal area. "
            "X_1: peak over q S0, divided by that of the canopy fixed in the stream at 20 m/s.", "",
            "![Projected area over the distance](filling.svg)"]
    tables.write("filling", "Filling of a flat circular canopy", "make validate-filling", made, head + table + foot)
    plot(options, done)


if __name__ == "__main__":
    main()
