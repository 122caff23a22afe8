#!/usr/bin/env python3
"""Writes the coefficients in descent of free flights for `ripstop size` into examples/flown.json.

    /usr/bin/python3 validation/flight/shipped.py runs/flights/flat-circular-f-111 runs/flights/cross-f-111 ...
    /usr/bin/python3 validation/flight/shipped.py runs/flights/*

Each folder is a finished run of `ripstop fly`. A row is for a family and a cloth, with the longest flight of both. Flights with
another vent, other cells or other steps, and failed flights, are left out.
"""
import json
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CELLS_ACROSS, COURANT = 20, 0.7  # the defaults of [flight]


def family_of(type_name):
    rows = json.loads((ROOT / "examples/families.json").read_text())["families"]
    return next((row["family"] for row in rows if row["type"] == type_name), None)


def vent_share(parachute):
    nominal = parachute.get("nominal_diameter_m")
    return round(parachute["vent_diameter_m"] / nominal, 3) if nominal and "vent_diameter_m" in parachute else None


def row_of(folder):
    """None unless the flight is that of the family's example by the default method."""
    result = json.loads((folder / "result.json").read_text())
    run = json.loads((folder / "run.json").read_text())
    case, flight = run["case"], run["case"].get("flight", {})
    family = family_of(case["parachute"]["type"])
    if family is None or result.get("descent_drag_coefficient") is None or not result["usable"]:
        return None
    if flight.get("cells_across", CELLS_ACROSS) != CELLS_ACROSS or flight.get("courant", COURANT) != COURANT:
        return None
    own = ROOT / "validation/flight" / f"{family}.toml"
    if own.exists() and vent_share(tomllib.loads(own.read_text())["parachute"]) != vent_share(case["parachute"]):
        return None
    return {
        "family": family,
        "canopy_material": case["parachute"]["canopy_material"],
        "drag_coefficient": round(result["descent_drag_coefficient"], 3),
        "standard_error": round(result["descent_drag_coefficient_standard_error"] or 0, 3),
        "axial_drag_coefficient": round(result["axial_drag_coefficient"], 3),
        "mean_oscillation_deg": result["mean_oscillation_deg"] and round(result["mean_oscillation_deg"], 1),
        "half_swings": result["half_swings"],
        "duration_s": round(result["duration_s"], 1),
    }, run["processor"], run["started"][:10]


def write(folders):
    best, made = {}, set()
    for folder in map(pathlib.Path, folders):
        found = row_of(folder) if (folder / "result.json").exists() else None
        if found is None:
            print(f"{folder}: left out", file=sys.stderr)
            continue
        row, processor, day = found
        key = row["family"], row["canopy_material"]
        if key not in best or row["duration_s"] > best[key]["duration_s"]:
            best[key] = row
            made.add(f"{processor}, {day}")
    if not best:
        sys.exit("no flight to take")
    data = {
        "what": "Drag coefficient in descent on the nominal area, of free flights by Ripstop, with its standard error",
        "made_by": "make validate-flights",
        "made_on": "; ".join(sorted(made)),
        "flights": [best[key] for key in sorted(best)],
    }
    (ROOT / "examples/flown.json").write_text(json.dumps(data, indent=2) + "\n")


if __name__ == "__main__":
    write(sys.argv[1:])
