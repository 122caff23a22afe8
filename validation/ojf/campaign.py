#!/usr/bin/env python3
"""Calibrates on Stratos IV, predicts WALRUS and ADEPT, varies the inputs of the predictions, and scores the frozen predictions.

    make validate-ojf            (or: campaign.py --ripstop build/bin/ripstop --runs runs/ojf STAGE ...)

Stages, each with the results of the earlier ones; without a name all of them run:
    calibrate  porosity on Stratos IV, nominal basis, least squares over five speeds     -> calibration.csv
    predict    WALRUS and ADEPT, both speed bases, nonlinear and linear                  -> predictions.csv
    reproduce  Stratos IV itself with the calibrated cloth, and its shape against images
    sheet      the cloth as a sheet of its specified permeability, nothing calibrated    -> predictions.csv
    sheet-calibrated  the same of a permeability that is calibrated on Stratos IV        -> predictions.csv
    uncertain-jet  unknown details of the jet: end of the nozzle, place of the speed measurement  -> uncertainty.csv
    jet        the specified cloth, nothing calibrated, in the open jet of the tunnel; Stratos IV also in free air
                                                                                         -> predictions.csv
    unsteady-jet  the same with an unsteady wake: means over time                        -> predictions.csv
    uncertain  varied inputs of each prediction of the paper model                       -> uncertainty.csv
    uncertain-sheet  the same for the calibrated sheet                                   -> uncertainty.csv
    openings   coupled inflation of the three parachutes in the open jet, nothing calibrated; varied inputs for Stratos IV
                                                                               -> openings.csv, openings-varied.csv
    compare    nonlinear and linear cloth of Stratos IV at 30 m/s
    openfoam   Stratos IV at 30 m/s with OpenFOAM
    report     tables in docs/tables, plots
    adept      drag of ADEPT against details of its sewing that are not published        -> adept-details.csv
    score      frozen predictions of WALRUS and ADEPT against their measurements         -> docs/tables/ojf-score.md
A stage consists of `ripstop` commands, which continue after a kill; finished ones are not repeated. Only the stage `score` reads
measurements of WALRUS and ADEPT. The predictions made before these were known are in frozen/, which no stage changes (score.py).
"""
import argparse
import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import time

import adept
import score
from openings import DAMPED, OPENING, OPENING_OF, OPENING_VARIATIONS, OPENINGS
from tunnel import FREE_FLOW, JET_BASE, JET_DISTANCE, JET_SPECIFIED, JET_VARIATIONS, SPECIFIED

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SPEEDS = {"stratos-iv": "10,15,20,25,30", "walrus": "10,15,20,25,30", "adept": "10,20,30"}
BLIND = ("walrus", "adept")
PARACHUTES = ("stratos-iv", *BLIND)
BASES = ("nominal", "measured")
MODELS = ("paper", "sheet-calibrated", "sheet-specified", "specified-jet", "specified-unsteady-jet")
# The runs of `uncertain` are made at one speed, nominal basis, nonlinear, on a grid of an eighth of the printed cells:
# the relative changes apply to all speeds and to the printed grid, which is one of the grids.
UNCERTAIN_SPEED = "20"
COLUMNS = ["parachute", "speed_basis", "nominal_m_s", "speed_m_s", "density_kg_m3", "porosity_model", "fabric_model",
           "drag_n", "drag_area_m2", "coupling_iterations", "wall_time_s", "standard_error_n", "uncertainty_n"]

# The cloth as a sheet, far entraining sides, second order, cells of 4 cm about the canopy. The wake of tight cloth converges
# slowly, so the mean of the last iterations of each flow is used.
SHEET_FLOW = ["flow.porosity_model=sheet", "flow.box_m=[6,6,9]", "flow.cells=[80,80,98]", "flow.canopy_position_m=4",
              "flow.core.size_m=[1.8,1.8,2.2]", "flow.core.growth=1.125", "flow.sides=entraining",
              "flow.convection=second-order", "flow.residual=3e-4", "flow.max_iterations=300", "flow.average_over=60",
              "coupling.drag_tolerance=5e-3", "coupling.load=uniform"]
# The pressure drop of the calibrated sheet is linear, or Ergun's; the one that fits Stratos IV better is taken.
SHEET_KNOBS = {"permeabilities": "300,600,1200", "gammas": "0.3,0.4,0.5"}
SHEET_SPECIFIED = [*SHEET_FLOW, "parachute.canopy_material=f-111-physical"]
# Inputs of a prediction: source -> (label, settings) of each variation, compared with the unchanged run.
VARIATIONS = {
    "position": [("-1/3 cell", ["flow.canopy_position_m=1.982222"]), ("+1/3 cell", ["flow.canopy_position_m=2.017778"])],
    "box": [("3 x 3 m", ["flow.box_m=[3,3,4]", "flow.cells=[75,75,75]"])],
    "sides": [("slip", ["flow.sides=slip"]), ("entraining", ["flow.sides=entraining"])],
    "turbulence": [("intensity 5 %", ["flow.turbulence_intensity=0.05"]),
                   ("viscosity ratio 100", ["flow.viscosity_ratio=100"])],
    "shape": [("tolerances a fifth", ["coupling.shape_tolerance_m=2e-4", "coupling.drag_tolerance=2e-4",
                                      "coupling.cloth_tolerance=1e-4"])],
}
# The same for the sheet of calibrated permeability, on its own grid.
SHEET_VARIATIONS = {
    "grid": [("5 cm", ["flow.cells=[66,66,80]"]), ("3.2 cm", ["flow.cells=[92,92,112]"])],
    "position": [("half a cell", ["flow.canopy_position_m=4.02", "flow.core.start_m=3.45"])],  # else the core moves with the canopy
    "sides": [("slip", ["flow.sides=slip"])],
    "turbulence": [("intensity 5 %", ["flow.turbulence_intensity=0.05"])],
}
OPENING_COLUMNS = ["parachute", "air", "speed_m_s", "density_kg_m3", "initial_radius_m", "peak_100hz_n", "peak_n",
                   "peak_time_s", "filling_time_s", "steady_n", "wall_time_s", "peak_100hz_pm_n"]
# Cells, and the size of the printed ones over theirs. The `paper` model resists for the length of a cell: its
# coefficients are multiplied by this ratio, which keeps the resistance of the cloth's area.
GRIDS = [("40,40,60", 0.4), ("50,50,75", 0.5), ("64,64,96", 0.64)]
BASE = GRIDS[1]


class Campaign:
    def __init__(self, options):
        self.ripstop, self.runs, self.jobs = options.ripstop, options.runs, options.jobs
        self.parachutes, self.bases = options.parachutes, options.bases

    def call(self, *arguments, also=()):
        """Runs ripstop. A failure ends the stage, and the same command continues it."""
        command = [str(self.ripstop), *map(str, arguments)]
        print("$ ripstop " + " ".join(command[1:]), flush=True)
        code = subprocess.run(command, cwd=ROOT, check=False).returncode
        if code != 0 and code not in also:
            sys.exit(f"ripstop ended with exit code {code}; `campaign.py` again goes on from here")

    def sweep(self, parachute, out, settings, *axes):
        folder = self.runs / out
        arguments = ["sweep", f"validation/ojf/{parachute}.toml", "--out", folder, *axes]
        for setting in settings:
            arguments += ["--set", setting]
        arguments += ["--jobs", self.jobs] if self.jobs else []
        self.call(*arguments)
        with open(folder / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def calibrate(self, out, settings, *arguments):
        command = ["calibrate", "porosity", "validation/ojf/stratos-iv.toml", "--out", self.runs / out, *arguments]
        for setting in settings:
            command += ["--set", setting]
        command += ["--jobs", self.jobs] if self.jobs else []
        self.call(*command)
        return self.calibration(out)

    def calibration(self, out):
        file = self.runs / out / "result.json"
        return json.loads(file.read_text()) if file.exists() else None


LAW_KEYS = ("darcy_1_m2", "forchheimer_1_m", "pressure_drop_linear_pa_s_m", "pressure_drop_quadratic_pa_s2_m2")


def law(result, factor=1):
    return [f"materials.{result['material']}.{key}={factor * result[key]!r}" for key in LAW_KEYS if key in result]


def calibrated(campaign):
    """The frozen cloth."""
    result = campaign.calibration("paper/calibration")
    if not result:
        sys.exit("nothing is calibrated yet: run the stage calibrate first")
    return result


def frozen_sheet(campaign):
    """The law of a sheet that fits Stratos IV best."""
    results = [campaign.calibration(f"sheet-calibrated/{knob}") for knob in SHEET_KNOBS]
    if None in results:
        sys.exit("the sheet is not calibrated yet: run the stage sheet-calibrated first")
    return min(results, key=lambda result: result["root_mean_square_misfit"])


def write_predictions(model, parachute, basis, rows):
    """Replaces the rows of this model, parachute and basis."""
    path = HERE / "predictions.csv"
    kept = []
    if path.exists():
        with open(path, newline="") as file:
            kept = [r for r in csv.DictReader(file)
                    if (r["porosity_model"], r["parachute"], r["speed_basis"]) != (model, parachute, basis)]
    for row in rows:
        drag, error = float(row["drag_n"]), row.get("drag_standard_error_n")
        kept.append({
            "parachute": parachute, "speed_basis": basis, "nominal_m_s": row["flow.speed_m_s"],
            "speed_m_s": row["speed_m_s"], "density_kg_m3": row["density_kg_m3"], "porosity_model": model,
            "fabric_model": "linear" if row["coupling.linear"] == "true" else "nonlinear",
            "drag_n": f"{drag:.3f}", "drag_area_m2": f"{float(row['drag_area_m2']):.5f}",
            "coupling_iterations": row["coupling_iterations"], "wall_time_s": f"{float(row['wall_time_s']):.1f}",
            "standard_error_n": f"{error:.2f}" if error is not None else "",
            "uncertainty_n": ""})
    kept.sort(key=lambda r: (MODELS.index(r["porosity_model"]), PARACHUTES.index(r["parachute"]), BASES.index(r["speed_basis"]),
                             r["fabric_model"] != "nonlinear", float(r["nominal_m_s"])))
    write_table(path, COLUMNS, kept)


def write_table(path, columns, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def provenance(campaign, model, calibration=None):
    """Program and calibration of the rows of a model."""
    path = HERE / "predictions.json"
    known = json.loads(path.read_text()) if path.exists() else {}
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"], capture_output=True, text=True,
                            check=False).stdout.strip()
    run = json.loads(next((campaign.runs / model).glob("*-nominal/*/run.json")).read_text())
    entry = {"commit": commit, "started": run["started"], "processor": run["processor"], "version": run["version"],
             "flow_engine": run["flow_engine"], "cells": run["case"]["flow"]["cells"], "box_m": run["case"]["flow"]["box_m"]}
    if calibration:
        entry["calibration"] = {key: calibration[key] for key in
                                ("knob", "value", "standard_error", *LAW_KEYS, "root_mean_square_misfit") if key in calibration}
    known[model] = entry
    path.write_text(json.dumps(known, indent=2) + "\n")


def stage_calibrate(campaign):
    campaign.calibrate("paper/calibration", [], "--gammas", "0.19,0.21,0.23", "--shifts", "2")


def stage_predict(campaign):
    for basis in BASES:
        for parachute in BLIND:
            rows = campaign.sweep(parachute, f"paper/{parachute}-{basis}",
                                  law(calibrated(campaign)) + [f"flow.speed_basis={basis}"], "--speeds", SPEEDS[parachute],
                                  "--vary", "coupling.linear=false,true")
            write_predictions("paper", parachute, basis, rows)
    provenance(campaign, "paper", calibrated(campaign))


def stage_reproduce(campaign):
    for basis in BASES:
        campaign.sweep("stratos-iv", f"paper/stratos-iv-{basis}",
                       law(calibrated(campaign)) + [f"flow.speed_basis={basis}"], "--speeds", SPEEDS["stratos-iv"],
                       "--vary", "coupling.linear=false,true")
        if basis == "nominal":
            campaign.call("photogrammetry", "validation/ojf/stratos-iv-images.toml", "--run",
                          campaign.runs / "paper/stratos-iv-nominal/speed_m_s=30_linear=false", "--out", campaign.runs / "images")


def stage_sheet(campaign):
    """Computes all three parachutes, including Stratos IV, whose drag is known."""
    campaign.sweep("stratos-iv", "sheet-specified/stratos-iv-nominal", [*SHEET_SPECIFIED, "flow.speed_basis=nominal"],
                   "--speeds", SPEEDS["stratos-iv"], "--vary", "coupling.linear=false")
    predict_sheet(campaign, "sheet-specified", [])


def stage_sheet_calibrated(campaign):
    """Computes WALRUS and ADEPT with the cloth that fits the five drag areas of Stratos IV (nominal basis, least squares)."""
    for knob, values in SHEET_KNOBS.items():
        campaign.calibrate(f"sheet-calibrated/{knob}", SHEET_SPECIFIED, f"--{knob}", values, "--shifts", "1")
    result = frozen_sheet(campaign)
    predict_sheet(campaign, "sheet-calibrated", law(result), result)


def predict_sheet(campaign, model, cloth, calibration=None):
    for basis in BASES:
        for parachute in BLIND:
            rows = campaign.sweep(parachute, f"{model}/{parachute}-{basis}",
                                  [*SHEET_SPECIFIED, f"flow.speed_basis={basis}", *cloth], "--speeds", SPEEDS[parachute],
                                  "--vary", "coupling.linear=false")
            write_predictions(model, parachute, basis, rows)
    provenance(campaign, model, calibration)


def predict_in_jet(campaign, model, settings):
    """Computes all three parachutes. The known drag of Stratos IV is not used."""
    for basis in campaign.bases:
        for parachute in campaign.parachutes:
            folder = f"{model}/{parachute}-{basis}"
            rows = campaign.sweep(parachute, folder, [*JET_SPECIFIED, *settings, f"flow.speed_basis={basis}"], "--speeds",
                                  SPEEDS[parachute], "--vary", "coupling.linear=false")
            for row in rows:
                result = json.loads((campaign.runs / folder / row["folder"] / "result.json").read_text())
                row["drag_standard_error_n"] = (result.get("unsteady") or {}).get("drag_standard_error_n")
            write_predictions(model, parachute, basis, rows)
    provenance(campaign, model)
    write_unknowns_of_jet()


def write_unknowns_of_jet():
    """Combined uncertainty of the rows in the jet: the largest of each source in uncertain-jet, and the standard error of the mean.
    Empty before that stage."""
    largest = {parachute: {} for parachute in PARACHUTES}  # by source, as a share of the drag
    with open(HERE / "uncertainty.csv", newline="") as file:
        for row in csv.DictReader(file):
            if row["porosity_model"] == "specified-jet":
                for parachute, column in ((row["parachute"], "frozen_percent"), ("stratos-iv", "stratos_iv_percent")):
                    of = largest[parachute]
                    of[row["source"]] = max(of.get(row["source"], 0), abs(float(row[column])) / 100)
    with open(HERE / "predictions.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        if row["porosity_model"] in ("specified-jet", "specified-unsteady-jet") and largest[row["parachute"]]:
            shares = [share * float(row["drag_n"]) for share in largest[row["parachute"]].values()]
            row["uncertainty_n"] = f"{math.hypot(*shares, float(row['standard_error_n'] or 0)):.1f}"
    write_table(HERE / "predictions.csv", COLUMNS, rows)


def stage_jet(campaign):
    predict_in_jet(campaign, "specified-jet", [])
    campaign.sweep("stratos-iv", "specified-free/stratos-iv-nominal", [*SPECIFIED, *FREE_FLOW, "flow.speed_basis=nominal"],
                   "--speeds", SPEEDS["stratos-iv"], "--vary", "coupling.linear=false")


def stage_uncertain_jet(campaign):
    """In addition to the variations: a speed measured one diameter upstream of the canopy instead of in the empty jet or the nozzle."""
    rows = [("base", "", [f"flow.speed_m_s={UNCERTAIN_SPEED}", JET_DISTANCE])]
    rows += [(source, label, extra if any("nozzle_distance" in key for key in extra) else [*extra, JET_DISTANCE])
             for source, all_of in JET_VARIATIONS.items() for label, extra in all_of]
    drags = varied_drags(campaign, "specified-jet", JET_BASE, rows,
                         [p for p in PARACHUTES if p == "stratos-iv" or p in campaign.parachutes])
    for parachute in drags:
        folder = campaign.runs / f"specified-jet/uncertain-{parachute}"
        with open(folder / "sweep.csv", newline="") as file:
            base = next(csv.DictReader(file))
        ratio = float(base["speed_m_s"]) / float(base["approach_speed_m_s"])
        drags[parachute].append(("speed", "read one diameter before the canopy", float(base["drag_n"]) * ratio**2))
    write_uncertainty("specified-jet", drags)
    write_unknowns_of_jet()


def stage_uncertain(campaign):
    result = calibrated(campaign)
    varied = {source: [(source, label, extra) for label, extra in all_of] for source, all_of in VARIATIONS.items()}
    grids = [("grid", cells.replace(",", "x"), [f"flow.cells=[{cells}]", *law(result, ratio)])
             for cells, ratio in GRIDS if cells != BASE[0]]
    porosity = porosity_rows(result, BASE[1])
    # A row starts from its neighbour towards the middle, where the unchanged run is, if its flow field can be
    # continued.
    rows = [*grids, *varied["box"], *varied["sides"], varied["position"][0], porosity[0], ("base", "", [f"flow.speed_m_s={UNCERTAIN_SPEED}"]),
            porosity[1], varied["position"][1], *varied["shape"], *varied["turbulence"]]
    drags = varied_drags(campaign, "paper", [f"flow.cells=[{BASE[0]}]", *law(result, BASE[1])], rows)
    for parachute in drags:
        drags[parachute].append(("grid", "100x100x150, printed", printed_drag(campaign, parachute)))
    write_uncertainty("paper", drags)


def stage_uncertain_sheet(campaign):
    result = frozen_sheet(campaign)
    rows = [("base", "", [f"flow.speed_m_s={UNCERTAIN_SPEED}"]), *porosity_rows(result, 1)]
    rows += [(source, label, extra) for source, all_of in SHEET_VARIATIONS.items() for label, extra in all_of]
    write_uncertainty("sheet-calibrated", varied_drags(campaign, "sheet-calibrated", [*SHEET_SPECIFIED, *law(result)], rows))


def porosity_rows(result, factor):
    """The calibrated coefficients times a factor: one standard error less and more."""
    rows = []
    for sign, name in ((-1, "- 1 s"), (1, "+ 1 s")):
        knob = result["value"] + sign * result["standard_error"]
        if result["knob"] == "gamma":
            settings = ergun(knob, result, factor)
        else:
            settings = law(result, factor * result["value"] / knob)
        rows.append(("porosity", f"{result['knob']} {name}", settings))
    return rows


def varied_drags(campaign, model, settings, rows, parachutes=PARACHUTES):
    """Parachute -> (source, label, drag) of every row."""
    arguments = []
    for _, _, extra in rows:
        arguments += ["--row", ",".join(extra)]
    drags = {}
    for parachute in parachutes:
        done = campaign.sweep(parachute, f"{model}/uncertain-{parachute}", [f"flow.speed_m_s={UNCERTAIN_SPEED}", *settings],
                              *arguments)
        drags[parachute] = [(source, label, float(r["drag_n"])) for (source, label, _), r in zip(rows, done)]
    return drags


def printed_drag(campaign, parachute):
    """On the printed grid, as predicted (Stratos IV: as reproduced)."""
    folder = campaign.runs / f"paper/{parachute}-nominal/speed_m_s={UNCERTAIN_SPEED}_linear=false"
    return json.loads((folder / "result.json").read_text())["drag_n"]


def ergun(gamma, result, factor):
    """[NFM] Eq. 16 with V/S = t, at the air of its table, times a factor."""
    a, b = 150 * 1.81e-5 / (36 * result["thickness_m"] * gamma**3), 1.75 * 1.225 / (6 * gamma**3)
    return law({"material": result["material"], **dict(zip([key for key in LAW_KEYS if key in result], (a, b)))}, factor)


def write_uncertainty(model, drags):
    """Change of drag of each variation with the frozen cloth, and as a ratio to Stratos IV under the same variation. To first
    order, the ratio is the change with a new calibration under that variation. Replaces the rows of this model and these
    parachutes in uncertainty.csv."""
    path = HERE / "uncertainty.csv"
    table = []
    if path.exists():
        with open(path, newline="") as file:
            table = [row for row in csv.DictReader(file) if row["porosity_model"] != model or row["parachute"] not in drags]
    base = {p: next(drag for source, _, drag in rows if source == "base") for p, rows in drags.items()}
    for parachute in (p for p in BLIND if p in drags):
        for i, (source, label, drag) in enumerate(drags[parachute]):
            if source == "base":
                continue
            frozen = drag / base[parachute] - 1
            reference = drags["stratos-iv"][i][2] / base["stratos-iv"] - 1
            table.append({"porosity_model": model, "parachute": parachute, "source": source, "variation": label,
                          "frozen_percent": f"{100 * frozen:.2f}", "stratos_iv_percent": f"{100 * reference:.2f}",
                          "ratio_percent": f"{100 * ((1 + frozen) / (1 + reference) - 1):.2f}"})
    table.sort(key=lambda row: (row["porosity_model"], BLIND.index(row["parachute"])))
    write_table(path, list(table[0]), table)


def stage_compare(campaign):
    calibrated_at_30(campaign, "compare", "compare", "--linear")


def stage_openfoam(campaign):
    calibrated_at_30(campaign, "openfoam-30", "steady", "--flow", "openfoam", "--ranks", "2")


def calibrated_at_30(campaign, out, command, *options):
    cloth = [word for setting in law(calibrated(campaign)) for word in ("--set", setting)]
    campaign.call(command, "validation/ojf/stratos-iv.toml", *options, "--speed", "30", "--out", campaign.runs / out, *cloth)


def opening(campaign, parachute, name, air, command):
    """A row of openings.csv."""
    speed, density, radius = OPENINGS[parachute]
    folder = campaign.runs / "openings" / name
    began = time.monotonic()
    campaign.call(*command, "--out", folder, also=(4,))  # the load is not yet steady, but the peak is complete
    result = json.loads((folder / "result.json").read_text())
    wall = folder.parent / f"{name}.seconds"
    if not wall.exists():
        wall.write_text(f"{time.monotonic() - began:.0f}")
    return {"parachute": parachute, "air": air, "speed_m_s": speed, "density_kg_m3": density, "initial_radius_m": radius,
            "peak_100hz_n": f"{result['low_pass_peak_load_n']:.1f}", "peak_n": f"{result['peak_load_n']:.1f}",
            "peak_time_s": f"{result['low_pass_peak_time_s']:.4f}", "filling_time_s": f"{result['filling_time_s']:.4f}",
            "steady_n": f"{result['last_load_n']:.1f}", "wall_time_s": wall.read_text()}


def open_in_air(campaign, parachute, name, settings):
    speed, density, radius = OPENINGS[parachute]
    command = ["inflate", f"validation/ojf/{parachute}.toml", "--air", "coupled", "--speed", speed]
    for setting in [*JET_SPECIFIED, *OPENING, f"flow.density_kg_m3={density}", f"inflation.initial_radius_m={radius}",
                    *settings]:
        command += ["--set", setting]
    return opening(campaign, parachute, name, "coupled", command)


def stage_openings(campaign):
    rows = [open_in_air(campaign, parachute, parachute, OPENING_OF[parachute]) for parachute in PARACHUTES]
    base = {row["parachute"]: float(row["peak_100hz_n"]) for row in rows}
    changes, varied = {parachute: {} for parachute in PARACHUTES}, []
    for parachute, label, settings in OPENING_VARIATIONS:
        row = open_in_air(campaign, parachute, f"{parachute} {label}", [*OPENING_OF[parachute], *settings])
        changes[parachute][label] = float(row["peak_100hz_n"]) / base[parachute] - 1
        varied.append({"parachute": parachute, "variation": label, **{c: row[c] for c in OPENING_COLUMNS[5:8]},
                       "peak_percent": f"{100 * changes[parachute][label]:.1f}"})
    for row in rows:
        own = sorted({**changes["stratos-iv"], **changes[row["parachute"]]}.items(), key=lambda one: abs(one[1]))
        kinds = {label.split()[-1]: change for label, change in own}  # by the last word: the largest of each
        row["peak_100hz_pm_n"] = f"{math.hypot(*kinds.values()) * float(row['peak_100hz_n']):.0f}"
    write_table(HERE / "openings-varied.csv", list(varied[0]), varied)
    for parachute, settings in DAMPED.items():
        speed, density, _ = OPENINGS[parachute]
        command = ["inflate", f"examples/{parachute}/case.toml", *settings, "--duration", "0.2"]
        if parachute == "adept":
            command += ["--speed", speed, "--set", f"flow.density_kg_m3={density}"]
        rows.append(opening(campaign, parachute, parachute + " damped", "damped", command))
    write_table(HERE / "openings.csv", OPENING_COLUMNS, rows)


def stage_report(campaign):
    plots = HERE / "plots"
    plots.mkdir(exist_ok=True)
    sources = {"porosity.svg": "paper/calibration/porosity.svg",
               "stratos-iv-drag.svg": "paper/stratos-iv-nominal/drag.svg",
               "stratos-iv-profile.svg": "images/profile.svg", "compare-profile.svg": "compare/profile.svg"}
    for parachute in BLIND:
        sources[f"{parachute}-drag.svg"] = f"paper/{parachute}-nominal/drag.svg"
    for name, source in sources.items():
        if (campaign.runs / source).exists():
            shutil.copy(campaign.runs / source, plots / name)
    subprocess.run([sys.executable, str(HERE / "report.py"), str(campaign.runs)], check=True)


STAGES = {"calibrate": stage_calibrate, "predict": stage_predict, "reproduce": stage_reproduce,
          "sheet": stage_sheet, "sheet-calibrated": stage_sheet_calibrated, "uncertain-jet": stage_uncertain_jet, "jet": stage_jet,
          "unsteady-jet": lambda campaign: predict_in_jet(campaign, "specified-unsteady-jet", ["flow.unsteady=true"]),
          "uncertain": stage_uncertain, "uncertain-sheet": stage_uncertain_sheet, "openings": stage_openings,
          "compare": stage_compare, "openfoam": stage_openfoam, "report": stage_report,
          "adept": adept.stage, "score": lambda campaign: score.report()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stages", nargs="*", metavar="STAGE", help=", ".join(STAGES))
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("runs/ojf"))
    parser.add_argument("--jobs", type=int, help="runs side by side (default: ripstop's)")
    for name, all_of in (("--parachutes", PARACHUTES), ("--bases", BASES)):
        parser.add_argument(name, nargs="+", choices=all_of, default=all_of,
                            help="of jet and unsteady-jet; parachutes of uncertain-jet too, beside Stratos IV")
    options = parser.parse_args()
    for stage in options.stages or STAGES:
        if stage not in STAGES:
            parser.error(f"unknown stage {stage}; there are {', '.join(STAGES)}")
    options.ripstop, options.runs = options.ripstop.resolve(), (ROOT / options.runs).resolve()
    campaign = Campaign(options)
    for stage in options.stages or STAGES:
        print(f"== {stage}", flush=True)
        began = time.monotonic()
        STAGES[stage](campaign)
        print(f"== {stage}: {(time.monotonic() - began) / 60:.1f} minutes", flush=True)


if __name__ == "__main__":
    main()
