#!/usr/bin/env python3
"""Writes the campaign's tables, docs/tables/ojf-*.md.

Usage: report.py RUNS. RUNS is the folder that campaign.py fills. Every number comes from the result.json,
run.json and sweep.csv in it, or from predictions.csv and uncertainty.csv. Rows without a run are left out.
"""
import csv
import json
import math
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import tables  # pylint: disable=wrong-import-position
from tables import table  # pylint: disable=wrong-import-position

HERE = pathlib.Path(__file__).resolve().parent


def load(path):
    return json.loads(path.read_text()) if path.exists() else None


def rows(path):
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def permeability(result):
    if "darcy_1_m2" in result:
        return f"Darcy {result['darcy_1_m2']:.2f}, Forchheimer {result['forchheimer_1_m']:.3f}"
    return (f"a = {result['pressure_drop_linear_pa_s_m']:.2f} Pa s/m, "
            f"b = {result['pressure_drop_quadratic_pa_s2_m2']:.3f} Pa s2/m2")


def calibration(runs, folder="paper/calibration"):
    result = load(runs / folder / "result.json")
    if not result:
        return []
    fit, knob, digits = result["drag_coefficient_fit"], result["knob"], 4 if result["knob"] == "gamma" else 1
    low, high = result["interval_95"]
    text = [f"{knob} = {result['value']:.{digits}f} +- {result['standard_error']:.{digits}f} (standard error; "
            f"{result['standard_error_measured']:.{digits}f} from the measured points, "
            f"{result['standard_error_computed']:.{digits}f} from the trials), 95 % interval {low:.{digits}f} to {high:.{digits}f}; "
            f"{permeability(result)}. C_D = {fit['intercept']:.4f} {fit['slope']:+.4g} "
            f"{knob} over {fit['points']} trials, R2 = {fit['r2']:.4f}. Scatter over the shifts "
            f"{100 * result['shift_scatter']:.2f} % rms; misfit of the measured points {100 * result['root_mean_square_misfit']:.1f} % rms.", ""]
    return text + table(["nominal m/s", "measured N", "measured m2", "computed m2", "error %"],
                        [[f"{p['nominal_speed_m_s']:g}", f"{p['measured_drag_n']:.1f}", f"{p['measured_drag_area_m2']:.4f}",
                          f"{p['computed_drag_area_m2']:.4f}",
                          f"{100 * (p['computed_drag_area_m2'] / p['measured_drag_area_m2'] - 1):+.1f}"]
                         for p in result["points"]])


def sheet(runs):
    """Stratos IV with the specified permeability."""
    folder = runs / "sheet-specified/stratos-iv-nominal"
    lines = []
    for row in rows(folder / "sweep.csv"):
        result = load(folder / row["folder"] / "result.json")
        known = result["measured"]
        lines.append([f"{known['nominal_speed_m_s']:g}", f"{result['drag_n']:.1f}", f"{result['drag_area_m2']:.4f}",
                      f"{known['drag_n']:.1f}", f"{100 * (result['drag_n'] / known['drag_n'] - 1):+.1f}",
                      str(result["coupling_iterations"]), f"{result['wall_time_s']:.0f}"])
    return table(["nominal m/s", "computed N", "computed m2", "measured N", "error %", "iterations", "wall s"], lines) if lines else []


def jet(runs):
    """Stratos IV with the specified permeability in the open jet, steady and in time, compared with the measurement."""
    case = tomllib.loads((HERE / "stratos-iv.toml").read_text())
    known = {float(m["nominal_speed_m_s"]): m["drag_n"] for m in case["measured"]}
    free = {float(r["speed_m_s"]): float(r["drag_n"]) for r in rows(runs / "specified-free/stratos-iv-nominal/sweep.csv")}
    models = {m: {(r["speed_basis"], float(r["nominal_m_s"])): r for r in rows(HERE / "predictions.csv")
                  if r["parachute"] == "stratos-iv" and r["porosity_model"] == m}
              for m in ("specified-jet", "specified-unsteady-jet")}
    steady, in_time = models.values()
    lines, errors = [], []
    for basis, speed in sorted(set(steady) | set(in_time), key=lambda key: (key[0] != "nominal", key[1])):
        measured = known[speed]
        off = lambda drag: f"{100 * (drag / measured - 1):+.1f}"
        line = [basis, f"{speed:g}", f"{measured:.1f}"]
        if free:
            line += [f"{free[speed]:.1f}", off(free[speed])] if basis == "nominal" and speed in free else ["", ""]
        for model in (steady, in_time):
            row = model.get((basis, speed))
            if not row:
                line += ["", ""]
                continue
            error = f" +- {row['standard_error_n']}" if row["standard_error_n"] else ""
            line += [f"{float(row['drag_n']):.1f}{error}", off(float(row["drag_n"]))]
            if model is in_time and basis == "nominal":
                errors.append(float(row["drag_n"]) / measured - 1)
        lines.append(line)
    head = ["speed basis", "nominal m/s", "measured N", *(["free air, steady N", "error %"] if free else []), "jet, steady N",
            "error %", "jet, unsteady N, standard error", "error %"]
    text = table(head, lines) if lines else []
    if errors:
        text += [f"Unsteady, on the nominal speeds: mean error {100 * sum(errors) / len(errors):+.1f} %, mean absolute error "
                     f"{100 * sum(map(abs, errors)) / len(errors):.1f} %."]
    return text


def sheet_calibration(runs):
    return calibration(runs, "sheet-calibrated/permeabilities") + calibration(runs, "sheet-calibrated/gammas")


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
    return table(["speed basis", "cloth", "nominal m/s", "computed N", "measured N", "error %", "[NFM] N", "error of [NFM] %",
                  "iterations", "wall s"], lines) if lines else []


def predictions(runs):
    lines = [[r["parachute"], r["speed_basis"], r["nominal_m_s"], r["porosity_model"], r["fabric_model"],
              f"{float(r['drag_n']):.1f}", r["standard_error_n"], r["uncertainty_n"], f"{float(r['drag_area_m2']):.4f}",
              r["coupling_iterations"], f"{float(r['wall_time_s']):.0f}"] for r in rows(HERE / "predictions.csv") if r["parachute"] != "stratos-iv"]
    return table(["parachute", "speed basis", "nominal m/s", "model", "cloth", "drag N", "standard error N", "stated uncertainty N",
                  "drag area m2", "iterations", "wall s"], lines) if lines else []


def largest_of_each_source(done):
    """(porosity model, parachute) -> source -> largest change of drag [%] among its variations in rows of uncertainty.csv.

    The change is that of the ratio to Stratos IV where the cloth is calibrated on it. The error of the calibration itself is
    a property of the cloth, so it does not cancel in that ratio; where nothing is calibrated, nothing cancels."""
    largest = {}
    for r in done:
        own = r["source"] == "porosity" or r["porosity_model"] == "specified-jet"
        of = largest.setdefault((r["porosity_model"], r["parachute"]), {})
        of[r["source"]] = max(of.get(r["source"], 0), abs(float(r["frozen_percent" if own else "ratio_percent"])))
    return largest


def uncertainty(runs):
    done = rows(HERE / "uncertainty.csv")
    if not done:
        return []
    text = table(["model", "parachute", "source", "variation", "frozen %", "Stratos IV %", "ratio %"],
                 [list(r.values()) for r in done])
    text += ["Largest change of each source in %: of the column *frozen* for the source porosity and for all of specified-jet, else of the column "
             "*ratio*. *Together* is the root of the sum of their squares:", ""]
    sources = list(dict.fromkeys(r["source"] for r in done))
    lines = []
    for (model, parachute), largest in largest_of_each_source(done).items():
        lines.append([model, parachute, *(f"{largest[s]:.1f}" if s in largest else "" for s in sources),
                      f"{math.hypot(*largest.values()):.1f}", max(largest, key=largest.get)])
    return text + table(["model", "parachute", *sources, "together", "largest source"], lines)


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
    text = [f"Camera distance {result['camera_distance_m']:.3f} m, fitted to the three diameters; rms residual "
            f"{1000 * result['root_mean_square_m']:.1f} mm.", ""]
    lines = [[s["name"], f"{s['apparent_m']:.4f}", f"{s['corrected_m']:.4f}", f"{s['known_m']:.4f}", f"{s['computed_m']:.4f}",
              f"{100 * (s['computed_m'] / s['known_m'] - 1):+.1f}"] for s in result["diameters"] + result["lengths"]]
    return text + table(["length, m", "apparent", "corrected", "printed", "computed", "computed / printed - 1, %"], lines)


# File in docs/tables, its title, stage of the campaign that makes it, and the folders of its runs.
SECTIONS = [
    (calibration, "calibration", "Porosity calibrated on Stratos IV", "calibrate", ["paper/calibration"]),
    (reproduction, "reproduction", "Stratos IV with the calibrated cloth", "reproduce openfoam",
     ["paper/stratos-iv-nominal", "paper/stratos-iv-measured", "openfoam-30"]),
    (predictions, "predictions", "Predicted drag of WALRUS and ADEPT", "predict sheet sheet-calibrated jet unsteady-jet",
     [f"{model}/{parachute}-{basis}"
      for model in ("paper", "sheet-calibrated", "sheet-specified", "specified-jet", "specified-unsteady-jet")
      for parachute in ("walrus", "adept") for basis in ("nominal", "measured")]),
    (uncertainty, "uncertainty", "Sensitivity of the predictions", "uncertain uncertain-sheet uncertain-jet",
     [f"{model}/uncertain-{parachute}" for model in ("paper", "sheet-calibrated", "specified-jet") for parachute in ("stratos-iv", "walrus", "adept")]),
    (sheet, "sheet", "Stratos IV with the specified permeability", "sheet", ["sheet-specified/stratos-iv-nominal"]),
    (jet, "jet", "Stratos IV with the specified permeability in the open jet", "jet unsteady-jet",
     [f"{model}/stratos-iv-{basis}" for model in ("specified-free", "specified-jet", "specified-unsteady-jet")
      for basis in ("nominal", "measured")]),
    (sheet_calibration, "sheet-calibration", "Pressure drop of the porous sheet calibrated on Stratos IV", "sheet-calibrated",
     ["sheet-calibrated/permeabilities", "sheet-calibrated/gammas"]),
    (comparison, "comparison", "Nonlinear and linear model at 30 m/s", "compare", ["compare"]),
    (images, "images", "Shape of Stratos IV compared with photogrammetry", "reproduce", ["paper/stratos-iv-nominal"]),
]


def main():
    runs = pathlib.Path(sys.argv[1])
    for section, name, title, stages, folders in SECTIONS:
        made = [run for folder in folders for run in tables.runs_below(runs / folder)]
        lines = section(runs) if made else []
        if lines:
            tables.write(f"ojf-{name}", title, f'make validate-ojf STAGES="{stages} report"', made, lines)


if __name__ == "__main__":
    main()
