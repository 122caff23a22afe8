#!/usr/bin/env python3
"""Writes the coefficients in descent of free flights for `ripstop size` and `ripstop recovery` into examples/flown.json.

    /usr/bin/python3 validation/flight/shipped.py

Reads the table of families in docs/tables/flights.md, which `make validate-flights` writes. A row is for a family and a cloth.
Failed flights and flights with fewer than four half-swings are left out.
"""
import json
import pathlib
import tomllib

import campaign

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CLOTHS = {"100": "mil-c-7020-type-i", "3": "f-111-physical"}
LEAST_HALF_SWINGS = 4


def rows():
    for cells in campaign.earlier_rows("Families"):
        row = dict(zip(campaign.FAMILIES_HEAD, cells))
        if not row["C_D0 in descent"] or int(row["half-swings"]) < LEAST_HALF_SWINGS:
            continue
        value, error = campaign.parsed(row["C_D0 in descent"])
        yield {
            "family": row["family"],
            "type": tomllib.loads((ROOT / f"validation/flight/{row['family']}.toml").read_text())["parachute"]["type"],
            "canopy_material": CLOTHS[row["cloth CFM"]],
            "drag_coefficient": value,
            "standard_error": error or 0.0,
            "axial_drag_coefficient": float(row["C_D0 on the axis"]),
            "mean_oscillation_deg": campaign.parsed(row["mean oscillation deg"])[0],
            "half_swings": int(row["half-swings"]),
            "duration_s": float(row["flight s"]),
        }


def main():
    page = (ROOT / "docs/tables/flights.md").read_text().splitlines()
    processor = page[2].partition("`: ")[2].rpartition(", ")[0]
    days = [line.removeprefix("Flown on ").partition(": ")[0] for line in page if line.startswith("Flown on ")]
    data = {
        "what": "Drag coefficient in descent on the nominal area, of free flights by Ripstop, with its standard error",
        "made_by": "make validate-flights",
        "made_on": f"{processor}, {', '.join(days)}",
        "table": "docs/tables/flights.md",
        "flights": list(rows()),
    }
    (ROOT / "examples/flown.json").write_text(json.dumps(data, indent=2, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
