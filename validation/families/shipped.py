#!/usr/bin/env python3
"""Writes the computed drag of every family for `ripstop size` into examples/families.json.

    /usr/bin/python3 validation/families/shipped.py        (the last step of make validate-families)

The drag is that of docs/tables/families.md, the table of the same command. Speed and density are those of the case files of the
examples. tests/run/sizing/size_test.cpp compares table and data.
"""
import json
import pathlib
import re
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def rows_of(table):
    lines = [line.strip("|").split("|") for line in table.splitlines() if line.startswith("|")]
    head = [cell.strip() for cell in lines[0]]
    return [dict(zip(head, (cell.strip() for cell in line))) for line in lines[2:]]


def machines(table):
    """Machine and day of the rows for which a line below the table states them."""
    lines = re.findall(r"^Rows? (.*?): ([^,]*, \d+ \w+ \d+)\b.*\.$", table, re.MULTILINE)
    return {name: made for names, made in lines for name in re.split(r", | and ", names)}


def family(row, made):
    case = tomllib.loads((ROOT / "examples" / row["example"] / "case.toml").read_text())
    known = re.fullmatch(r"([\d.]+) to ([\d.]+)", row["Knacke, in descent"])
    return {
        "family": row["example"],
        "type": case["parachute"]["type"],
        "drag_coefficient": float(row["drag coefficient"]),
        "handbook_drag_coefficient": [float(x) for x in known.groups()] if known else None,
        "projected_over_nominal_diameter": float(row["projected / nominal diameter"]),
        "speed_m_s": case["flow"]["speed_m_s"],
        "density_kg_m3": case["flow"]["density_kg_m3"],
        "canopy_material": case["parachute"].get("canopy_material", "f-111-physical"),
        **({"made_on": made[row["example"]]} if row["example"] in made else {}),
    }


def write():
    text = (ROOT / "docs/tables/families.md").read_text()
    made = re.search(r"^`([^`]+)`: (.*)\.$", text, re.MULTILINE)
    data = {
        "what": "Steady drag coefficient on the nominal area of every family's example, computed by Ripstop with the air's own load",
        "made_by": made.group(1),
        "made_on": made.group(2),
        "table": "docs/tables/families.md",
        "families": [family(row, machines(text)) for row in rows_of(text)],
    }
    (ROOT / "examples/families.json").write_text(json.dumps(data, indent=2) + "\n")


if __name__ == "__main__":
    write()
