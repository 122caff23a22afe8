#!/usr/bin/env python3
"""Writes the campaign's tables between the markers of a Markdown file.

Usage: report.py RUNS MARKDOWN. RUNS is the folder that campaign.py fills. Every number comes from the result.json,
run.json and sweep.csv in it, or from predictions.csv and uncertainty.csv; what has not been run is left out.
"""
import csv
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent


def load(path):
    return json.loads(path.read_text()) if path.exists() else None


def rows(path):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def table(head, lines):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(line) + " |" for line in lines), ""]


def calibration(runs):
    result = load(runs / "paper/calibration/result.json")
    if not result:
        return []
    fit = result["drag_coefficient_fit"]
    low, high = result["interval_95"]
    text = [f"{result['knob']} = {result['value']:.4f} +- {result['standard_error']:.4f} (standard error; "
            f"{result['standard_error_measured']:.4f} from the measured points, {result['standard_error_computed']:.4f} from "
            f"the trials), 95 % interval {low:.4f} to {high:.4f}; Darcy {result['darcy']:.2f}, Forchheimer "
            f"{result['forchheimer']:.3f}. C_D = {fit['intercept']:.4f} {fit['slope']:+.4f} gamma over {fit['points']} trials, "
            f"R2 = {fit['r2']:.4f}. Scatter over the shifts {100 * result['shift_scatter']:.2f} % rms.", ""]
    return text + table(["nominal m/s", "measured N", "measured m2", "computed m2", "error %"],
                        [[f"{p['nominal_speed_m_s']:g}", f"{p['measured_drag_n']:.1f}", f"{p['measured_drag_area_m2']:.4f}",
                          f"{p['computed_drag_area_m2']:.4f}",
                          f"{100 * (p['computed_drag_area_m2'] / p['measured_drag_area_m2'] - 1):+.1f}"]
                         for p in result["points"]])


def reproduction(runs):
    lines = []
    for basis in ("nominal", "measured"):
        done = rows(runs / f"paper/stratos-iv-{basis}/sweep.csv")
        for row in done:
            result = load(runs / f"paper/stratos-iv-{basis}" / row["folder"] / "result.json")
            if not result:
                continue
            known, linear = result["measured"], row["coupling.linear"] == "true"
            printed = known["printed_linear_n" if linear else "printed_nonlinear_n"]
            lines.append([basis, "linear" if linear else "nonlinear", f"{known['nominal_speed_m_s']:g}",
                          f"{result['drag_n']:.1f}", f"{known['drag_n']:.1f}",
                          f"{100 * (result['drag_n'] / known['drag_n'] - 1):+.1f}", f"{printed:.1f}",
                          f"{100 * (printed / known['drag_n'] - 1):+.1f}", str(result["coupling_iterations"]),
                          f"{result['wall_time_s']:.0f}"])
    foam = load(runs / "openfoam-30/result.json")
    if foam:
        known = foam["measured"]
        lines.append(["nominal, OpenFOAM", "nonlinear", "30", f"{foam['drag_n']:.1f}", f"{known['drag_n']:.1f}",
                      f"{100 * (foam['drag_n'] / known['drag_n'] - 1):+.1f}", f"{known['printed_nonlinear_n']:.1f}",
                      f"{100 * (known['printed_nonlinear_n'] / known['drag_n'] - 1):+.1f}", str(foam["coupling_iterations"]),
                      f"{foam['wall_time_s']:.0f}"])
    return table(["basis", "fabric", "nominal m/s", "computed N", "measured N", "error %", "[NFM] N", "its error %",
                  "iterations", "wall s"], lines) if lines else []


def predictions(runs):
    lines = [[r["parachute"], r["speed_basis"], r["nominal_m_s"], r["porosity_model"], r["fabric_model"],
              f"{float(r['drag_n']):.1f}", f"{float(r['drag_area_m2']):.4f}", r["coupling_iterations"],
              f"{float(r['wall_time_s']):.0f}"] for r in rows(HERE / "predictions.csv")]
    return table(["parachute", "basis", "nominal m/s", "porosity", "fabric", "drag N", "drag area m2", "iterations",
                  "wall s"], lines) if lines else []


def uncertainty(runs):
    done = rows(HERE / "uncertainty.csv")
    if not done:
        return []
    text = table(["parachute", "source", "variation", "frozen %", "Stratos IV %", "ratio %"], [list(r.values()) for r in done])
    lines = []
    for parachute in sorted({r["parachute"] for r in done}, reverse=True):
        own = [r for r in done if r["parachute"] == parachute]
        largest = {}
        for r in own:
            # The calibration's error is of the cloth itself: Stratos IV cannot take it away.
            value = abs(float(r["frozen_percent" if r["source"] == "porosity" else "ratio_percent"]))
            largest[r["source"]] = max(largest.get(r["source"], 0), value)
        total = math.sqrt(sum(v * v for v in largest.values()))
        first = max(largest, key=largest.get)
        lines.append([parachute, *(f"{largest[s]:.1f}" for s in largest), f"{total:.1f}", first])
        names = list(largest)
    text += ["Largest of each source (porosity: frozen; all others: ratio), and their root of sum of squares, %:", ""]
    return text + table(["parachute", *names, "together", "dominates"], lines)


def comparison(runs):
    result = load(runs / "compare/result.json")
    if not result:
        return []
    lines = []
    for m in result["models"]:
        strain = m["strain"]
        lines.append([m["model"], f"{m['drag_n']:.2f}", f"{100 * m['drag_difference']:+.3f}", f"{m['projected_diameter_m']:.4f}",
                      f"{1000 * m['largest_profile_change_m']:.2f}",
                      *(f"{100 * strain[p]['mean']:.4f}" for p in ("lines", "tape", "cloth"))])
    return table(["model", "drag N", "change %", "projected diameter m", "largest change of profile mm", "mean strain of lines %",
                  "of tape %", "of cloth %"], lines)


def images(runs):
    result = load(runs / "images/result.json")
    if not result:
        return []
    text = [f"Camera at {result['camera_distance_m']:.3f} m from the three diameters, which it meets within "
            f"{1000 * result['root_mean_square_m']:.1f} mm rms.", ""]
    lines = [[s["name"], f"{s['apparent_m']:.4f}", f"{s['corrected_m']:.4f}", f"{s['known_m']:.4f}", f"{s['computed_m']:.4f}",
              f"{100 * (s['computed_m'] / s['known_m'] - 1):+.1f}"] for s in result["diameters"] + result["lengths"]]
    return text + table(["m", "apparent", "corrected", "printed", "computed", "computed / printed - 1, %"], lines)


SECTIONS = {"calibration": calibration, "reproduction": reproduction, "predictions": predictions, "uncertainty": uncertainty,
            "comparison": comparison, "images": images}


def main():
    runs, markdown = map(pathlib.Path, sys.argv[1:])
    text = markdown.read_text()
    for name, section in SECTIONS.items():
        begin, end = f"<!-- ojf {name}: begin -->", f"<!-- ojf {name}: end -->"
        lines = section(runs)
        if begin not in text or not lines:
            continue
        before, rest = text.split(begin)
        text = before + "\n".join([begin, "", *lines, end]) + rest.split(end)[1]
    markdown.write_text(text)


if __name__ == "__main__":
    main()
