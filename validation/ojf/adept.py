"""Sensitivity of ADEPT's drag to details of the ringsail that [NFM] does not give. Nothing is tuned.

Every variation changes one detail of the case that the blind prediction was made with. The steady drag of the
uncalibrated sheet at 20 m/s in free air is compared with that of the unchanged case in the same kind of runs: the cloth
under its mean pressure (cheap), on two grids, or under the load of the flow as in the prediction. Sources of the ranges
are in docs/references.bib; where none is named, the range is assumed.
"""
import csv
import json
import math
import pathlib
import re
import subprocess

import score
import tables  # imported by score

HERE = pathlib.Path(__file__).resolve().parent
CASE = "validation/ojf/adept.toml"
SPEED = 20
SAILS = 9
SETTINGS = ["flow.porosity_model=sheet", "parachute.canopy_material=f-111-physical", "flow.box_m=[4.2,4.2,6.3]",
            "flow.canopy_position_m=2.8"]
# The two variations that change the drag most under a uniform load, repeated with other settings.
LARGEST = {("fullness", "none"), ("slots", "a third one of 5 degrees between the fourth and the fifth ring")}
# Runs -> settings of all of them, and their variations (None: all).
RUNS = {"uniform load, 2.8 cm": (["coupling.load=uniform", "flow.cells=[80,80,98]"], None),
        "uniform load, 4.0 cm": (["coupling.load=uniform", "flow.cells=[60,60,73]"], LARGEST),
        "load of the flow, 2.8 cm": (["coupling.load=of-flow", "flow.cells=[80,80,98]"], LARGEST)}


def rows(fullness=1.0, trailing=0.0, slots=None, top_height=0.5):
    """parachute.rows, from the skirt up: the default layout (K1) with its fullness times a factor, fullness of the
    upper edges as well, other slots {row: degrees}, or another height of the top row."""
    slots = {SAILS - 3: 3, SAILS - 2: 3} if slots is None else slots
    text = []
    for i in range(SAILS):
        leading = 0.11 - 0.06 * (i - 1) / (SAILS - 4) if 1 <= i <= SAILS - 3 else 0
        upper = trailing if leading else 0
        text.append(f"{{height={top_height if i == SAILS - 1 else 1}, slot_deg={slots.get(i, 0)}, "
                    f"leading_fullness={fullness * leading:.5f}, trailing_fullness={upper}}}")
    return f"parachute.rows=[{', '.join(text)}]"


# (detail, unchanged value) -> (variation, settings, source of the range).
VARIATIONS = {
    ("slots", "two of 3 degrees below the top rows"): [
        ("none", [rows(slots={})], "assumed"),
        ("two of 4.5 degrees", [rows(slots={6: 4.5, 7: 4.5})], "assumed"),
        *((f"a third one of {wide} degrees between the fourth and the fifth ring", [rows(slots={4: wide, 6: 3, 7: 3})],
           "Knacke, text to Fig. 6-28: one wide slot there (Apollo); width assumed") for wide in (2.5, 5))],
    ("fullness", "lower edges 11 to 5 %, upper edges 0"): [
        ("none", [rows(fullness=0)], "a ringslot's, lower limit"),
        ("1.5 times", [rows(fullness=1.5)], "assumed"),
        ("upper edges 5 % too", [rows(trailing=0.05)], "Delurgio: fullness added in the crown; amount assumed")],
    ("vent", "0.06 m"): [("0.10 m, 1 % of S0", ["parachute.vent_diameter_m=0.1"], "assumed")],
    ("shape", "60 degrees, top sail half as high"): [
        ("half-angle 50 degrees", ["parachute.half_angle_deg=50"], "assumed"),
        ("half-angle 75 degrees", ["parachute.half_angle_deg=75"], "assumed"),
        ("top sail as high as the others", [rows(top_height=1)], "assumed")],
    ("crown lines", "across the vent, lines sewn on up to it"): [
        ("no lines across the vent", ["parachute.vent_lines=false"], "assumed")],
    ("line length", "1.15 m"): [
        ("1.0 m", ["parachute.lines.length_m=1"], "Knacke, Fig. 6-28: 1.0 nominal diameter"),
        ("1.5 m", ["parachute.lines.length_m=1.5"], "Vu Dinh 2021: 0.6 to 1.5 nominal diameters tested")],
    ("tape", "on all edges"): [("not on the sails' inner edges", ["parachute.tape.inner_hems=false"], "assumed")],
    ("grid alignment", "cells on the axis"): [("a quarter of a cell aside", ["flow.core.off_axis=0.25"], "numerical")],
}
COLUMNS = ["runs", "detail", "unchanged", "variation", "range_from", "geometric_porosity", "drag_area_m2",
           "projected_diameter_m", "coupling_iterations", "converged", "change_percent"]


def commands(runs):
    """(detail, unchanged, variation, source, arguments of `ripstop`, name of its folder), the unchanged case first."""
    common, chosen = RUNS[runs]
    made = [("", "", "unchanged", "", [])]
    made += [(detail, unchanged, label, source, settings) for (detail, unchanged), of in VARIATIONS.items()
             for label, settings, source in of if chosen is None or (detail, label) in chosen]
    for detail, unchanged, label, source, settings in made:
        sets = [word for setting in [*SETTINGS, *common, *settings] for word in ("--set", setting)]
        name = re.sub(r"[^a-z0-9]+", "-", f"{runs} {detail} {label}".lower())
        yield detail, unchanged, label, source, [CASE, "--speed", str(SPEED), *sets], name


def rows_of(campaign, runs):
    found = []
    for detail, unchanged, label, source, arguments, name in commands(runs):
        folder = campaign.runs / "adept-details" / name
        campaign.call("steady", *arguments, "--out", folder, also=(4,))  # 4: not converged, as the table reports
        result = json.loads((folder / "result.json").read_text())
        check = subprocess.run([str(campaign.ripstop), "check", *arguments, "--json"], cwd=tables.ROOT, check=True,
                               capture_output=True, text=True)
        found.append({"runs": runs, "detail": detail, "unchanged": unchanged, "variation": label, "range_from": source,
                      "geometric_porosity": f"{json.loads(check.stdout)['geometric_porosity']:.4f}",
                      "drag_area_m2": f"{result['drag_area_m2']:.5f}",
                      "projected_diameter_m": f"{result['projected_diameter_m']:.4f}",
                      "coupling_iterations": result["coupling_iterations"],
                      "converged": str(result["converged"]).lower()})
        found[-1]["change_percent"] = f"{change(found[0], found[-1]):.2f}"
    return found


def change(base, row):
    return 100 * (float(row["drag_area_m2"]) / float(base["drag_area_m2"]) - 1)


def allowed(found):
    """Smallest and largest change of drag [%] that the details allow: per detail the lowest and the highest change, all
    details together as the root of the sum of squares (details independent), and as their sum (all at their limit)."""
    low, high = {}, {}
    for row in found:
        if row["detail"] not in ("", "grid alignment"):
            value = float(row["change_percent"])
            low[row["detail"]] = min(low.get(row["detail"], 0), value)
            high[row["detail"]] = max(high.get(row["detail"], 0), value)
    return {"root": (-math.hypot(*low.values()), math.hypot(*high.values())),
            "sum": (sum(low.values()), sum(high.values()))}


def smallest(by_runs):
    """The rows of the first runs, with the change of each variation that is smallest in size over all kinds of runs."""
    changes = {}
    for row in (row for found in by_runs for row in found):
        changes.setdefault((row["detail"], row["variation"]), []).append(row["change_percent"])
    return [{**row, "change_percent": min(changes[row["detail"], row["variation"]], key=lambda one: abs(float(one)))}
            for row in by_runs[0]]


def interval_lines(found, changes):
    """The mean error of the frozen unsteady predictions of ADEPT with the drag at both ends of the allowed range."""
    known = score.measured_drags()
    predicted = score.predicted_uncertainties(score.frozen("predictions.csv"), score.frozen("uncertainty.csv"))
    errors = score.drag_errors(predicted, known)
    lines = []
    for kind, name in (("root", "root of the sum of squares"), ("sum", "sum, all details at their limit")):
        low, high = allowed(found)[kind]
        ends = []
        for basis in score.BASES:
            mean = score.statistics(errors["specified-unsteady-jet", "nonlinear", basis]["adept"])[0]
            both = [100 * ((1 + mean / 100) * (1 + of / 100) - 1) for of in (low, high)]
            ends += [f"{mean:+.1f}", "{:+.1f} to {:+.1f}".format(*both)]
        lines.append([changes, name, f"{low:+.1f} to {high:+.1f}", *ends])
    return lines


def report(campaign, by_runs):
    lines = [[r["runs"], r["detail"], r["unchanged"], r["variation"], r["range_from"],
              f"{100 * float(r['geometric_porosity']):.1f}", f"{float(r['drag_area_m2']):.4f}",
              f"{float(r['projected_diameter_m']):.3f}",
              str(r["coupling_iterations"]) + ("" if r["converged"] == "true" else ", not converged"),
              f"{float(r['change_percent']):+.1f}" if r["detail"] else ""] for found in by_runs for r in found]
    text = tables.table(["runs", "detail", "unchanged case", "variation", "source of the range", "geometric porosity %",
                         "drag area m2", "projected diameter m", "coupling iterations", "change of drag area %"], lines)
    text += ["Range of the drag due to all details together (without grid alignment), and the mean error of the frozen unsteady "
             "predictions of ADEPT with the drag changed by this range:", ""]
    text += tables.table(["changes of", "details combined as", "change of drag %", "error, nominal speeds %",
                          "error with the changed drag, nominal %", "error, measured speeds %", "error with the changed drag, measured %"],
                         [*interval_lines(by_runs[0], by_runs[0][0]["runs"]),
                          *interval_lines(smallest(by_runs), "the runs with the smallest change")])
    tables.write("ojf-adept", "Effect of undocumented details on the drag of ADEPT", "make validate-ojf STAGES=adept",
                 tables.runs_below(campaign.runs / "adept-details"), text)


def stage(campaign):
    by_runs = [rows_of(campaign, runs) for runs in RUNS]
    with open(HERE / "adept-details.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(row for found in by_runs for row in found)
    report(campaign, by_runs)
