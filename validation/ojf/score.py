#!/usr/bin/env python3
"""Scores the blind predictions of WALRUS and ADEPT against the measurements, into docs/tables/ojf-score.md.

The predictions were frozen before a measurement of these two parachutes was known. They are kept unchanged in frozen/,
and this script rejects any other content of these files. Later predictions, in predictions.csv, are scored after them.

Signed error: computed / measured - 1. Every mean is an unweighted mean over the measured points.
"""
import csv
import hashlib
import math
import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import score_plot  # pylint: disable=wrong-import-position
import tables  # pylint: disable=wrong-import-position
from report import largest_of_each_source  # pylint: disable=wrong-import-position
from tables import table  # pylint: disable=wrong-import-position

# Commit that made each file, and SHA-256 of its bytes.
FROZEN = {
    "predictions.csv": ("fb55051f1836e53d43fa936097696a43ef1fe42a",
        "c7af28f0725e64d7fea102e4236e4aee850193db0177ba5300cc89c3bdb52492"),
    "predictions.json": ("9e33702bc84fb848b780bf969e2fd5f9ca172dc7",
        "a319a4059373f36ea2dca28ecae82c9339b2fc75f28d412a1036c3dc17f5771c"),
    "uncertainty.csv": ("740ab8a29442816fbba34dfeb4399f20c5afbe4b",
        "637789ae1bad9b7eb46c4f00da628979c1c886f846bc379c27cd68571bcdc062"),
    "openings.csv": ("47d954285634f8287ae8e42cfe6919d278cecb4c",
        "c867212c45ee50e9fbf77da75e5633eca88b535f6bdd607ee16a30638c6d8623"),
}
FROZEN_DAYS = "26 and 27 November 2026"
NAMES = {"stratos-iv": "Stratos IV", "walrus": "WALRUS", "adept": "ADEPT"}
BLIND = ("walrus", "adept")
BASES = ("nominal", "measured")
MODELS = {"specified-unsteady-jet": "uncalibrated sheet, open jet, unsteady",
          "specified-jet": "uncalibrated sheet, open jet, steady",
          "sheet-specified": "uncalibrated sheet, free air, steady",
          "sheet-calibrated": "calibrated sheet, free air, steady",
          "paper": "`paper`, calibrated"}
AIRS = {"coupled": "coupled inflation, nothing calibrated",
        "damped": "uniform-pressure inflation, damping calibrated on Stratos IV"}


def csv_rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def frozen(name, folder=HERE / "frozen"):
    """The rows of a frozen file. A file with other bytes is an error."""
    data = (folder / name).read_bytes()
    commit, known = FROZEN[name]
    if hashlib.sha256(data).hexdigest() != known:
        raise SystemExit(f"{folder / name} is not the frozen file: its SHA-256 must be {known}. "
                         f"Restore it: git show {commit[:7]}:validation/ojf/{name}")
    return csv_rows(data.decode())


def measured_drags():
    """(parachute, nominal speed) -> true speed, density, measured drag and the two printed ones."""
    known = {}
    for r in csv_rows((HERE / "measured.csv").read_text()):
        known[r["parachute"], float(r["nominal_m_s"])] = {key: float(r[key]) for key in r if key != "parachute"}
    for m in tomllib.loads((HERE / "stratos-iv.toml").read_text())["measured"]:
        known["stratos-iv", float(m["nominal_speed_m_s"])] = {
            "nominal_m_s": m["nominal_speed_m_s"], "measured_m_s": m["measured_speed_m_s"],
            "density_kg_m3": m["density_kg_m3"], "measured_drag_n": m["drag_n"],
            "paper_nonlinear_n": m["printed_nonlinear_n"], "paper_linear_n": m["printed_linear_n"]}
    return known


def drag_area(point, basis, force="measured_drag_n"):
    return point[force] / (0.5 * point["density_kg_m3"] * point[f"{basis}_m_s"] ** 2)


def predicted_uncertainties(rows, varied):
    """Adds "pm_n" to prediction rows: the uncertainty stated with the prediction [N], None where none was stated."""
    together = {key: math.hypot(*of.values()) for key, of in largest_of_each_source(varied).items()}
    for row in rows:
        percent = together.get((row["porosity_model"], row["parachute"]))
        row["pm_n"] = percent and percent / 100 * float(row["drag_n"])
        if row["porosity_model"].endswith("jet"):  # with the standard error of its mean
            row["pm_n"] = float(row["uncertainty_n"]) if row["uncertainty_n"] else None
    return rows


def drag_errors(rows, known):
    """(model, fabric, basis) -> parachute -> list of (nominal speed, signed error, stated uncertainty), the last two
    in % of the measured drag."""
    errors = {}
    for row in rows:
        key = row["porosity_model"], row["fabric_model"], row["speed_basis"]
        measured = known[row["parachute"], float(row["nominal_m_s"])]["measured_drag_n"]
        errors.setdefault(key, {}).setdefault(row["parachute"], []).append(
            (float(row["nominal_m_s"]), 100 * (float(row["drag_n"]) / measured - 1),
             row["pm_n"] and 100 * row["pm_n"] / measured))
    return errors


def printed_errors(known):
    """The same for the models of [NFM]; their speed basis is not stated."""
    errors = {}
    for (parachute, speed), point in known.items():
        for fabric in ("nonlinear", "linear"):
            errors.setdefault(("[NFM]", fabric, "as printed"), {}).setdefault(parachute, []).append(
                (speed, 100 * (point[f"paper_{fabric}_n"] / point["measured_drag_n"] - 1), None))
    return errors


def statistics(points):
    """Mean signed error, mean absolute error, and the error of the largest size, all in %."""
    errors = [error for _, error, _ in points]
    return sum(errors) / len(errors), sum(map(abs, errors)) / len(errors), max(errors, key=abs)


def inside(points):
    stated = [(error, pm) for _, error, pm in points if pm is not None]
    return f"{sum(abs(error) <= pm for error, pm in stated)} of {len(stated)}" if stated else "none stated"


def score_lines(errors):
    """Rows of the table of scores, the largest mean absolute error over the blind points first."""
    lines = []
    for (model, fabric, basis), of in errors.items():
        blind = [point for parachute in BLIND for point in of.get(parachute, [])]
        mean, size, largest = statistics(blind)
        each = ["{:+.1f} / {:.1f} / {:+.1f}".format(*statistics(of[p])) if p in of else "" for p in NAMES]
        lines.append((size, [MODELS.get(model, model), fabric, basis, str(len(blind)), f"{mean:+.1f}", f"{size:.1f}",
                             f"{largest:+.1f}", inside(blind), *each]))
    return [line for _, line in sorted(lines, key=lambda one: -one[0])]


def point_lines(errors, known):
    lines = []
    order = list(NAMES)
    for (parachute, speed), point in sorted(known.items(), key=lambda one: (order.index(one[0][0]), one[0][1])):
        for basis in BASES:
            cells = []
            for model in MODELS:
                of = errors.get((model, "nonlinear", basis), {}).get(parachute, [])
                found = [error for s, error, _ in of if s == speed]
                cells.append(f"{found[0]:+.1f}" if found else "")
            printed = 100 * (point["paper_nonlinear_n"] / point["measured_drag_n"] - 1)
            lines.append([NAMES[parachute], basis, f"{point[f'{basis}_m_s']:g}", f"{point['measured_drag_n']:.1f}",
                          f"{drag_area(point, basis):.3f}", *cells, f"{printed:+.1f}" if basis == "nominal" else ""])
    return lines


def peak_lines(openings):
    known = {r["parachute"]: r for r in csv_rows((HERE / "peaks.csv").read_text())}
    lines = []
    for row in openings:
        of = known[row["parachute"]]
        measured, peak, pm = float(of["measured_peak_n"]), float(row["peak_100hz_n"]), row["peak_100hz_pm_n"]
        calibrated = row["air"] == "damped" and row["parachute"] == "stratos-iv"
        verdict = "" if not pm else "yes" if abs(peak - measured) <= float(pm) else "no"
        lines.append([NAMES[row["parachute"]], AIRS[row["air"]], f"{measured:.0f}",
                      f"{peak:.0f}" + (f" +- {pm}" if pm else ""),
                      f"{100 * (peak / measured - 1):+.1f}" + (" (calibrated)" if calibrated else ""), verdict,
                      f"{100 * (float(of['paper_peak_n']) / measured - 1):+.1f}"])
    return lines


def constant_drag_area(areas):
    """Drag area C that minimises the sum of (C / A_i - 1)^2 over drag areas A_i, and their errors C / A_i - 1 in %."""
    constant = sum(1 / a for a in areas) / sum(1 / a**2 for a in areas)
    return constant, [100 * (constant / a - 1) for a in areas]


def constant_lines(known):
    lines = []
    for force, source in (("measured_drag_n", "measured"), ("paper_nonlinear_n", "[NFM], nonlinear")):
        for parachute in NAMES:
            for basis in BASES:
                areas = [drag_area(known[key], basis, force) for key in sorted(known) if key[0] == parachute]
                constant, errors = constant_drag_area(areas)
                lines.append([source, NAMES[parachute], basis, " ".join(f"{a:.3f}" for a in areas), f"{constant:.4f}",
                              f"{math.sqrt(sum(e * e for e in errors) / len(errors)):.1f}",
                              f"{sum(map(abs, errors)) / len(errors):.1f}", f"{max(errors, key=abs):+.1f}",
                              f"{100 * (areas[-1] / areas[0] - 1):+.1f}", f"{100 * (max(areas) / min(areas) - 1):.1f}"])
    return lines


def bias_lines(rows, known):
    """Mean computed drag area over the constant one fitted to the measurements, and the variation of the computed ones."""
    areas = {}
    for row in rows:
        if row["fabric_model"] == "nonlinear":
            key = row["porosity_model"], row["parachute"], row["speed_basis"]
            areas.setdefault(key, []).append(float(row["drag_area_m2"]))
    lines = []
    for (model, parachute, basis), computed in areas.items():
        constant, _ = constant_drag_area([drag_area(known[key], basis) for key in sorted(known) if key[0] == parachute])
        lines.append([MODELS[model], NAMES[parachute], basis, f"{sum(computed) / len(computed):.4f}",
                      f"{100 * (sum(computed) / len(computed) / constant - 1):+.1f}",
                      f"{100 * (computed[-1] / computed[0] - 1):+.1f}",
                      f"{100 * (max(computed) / min(computed) - 1):.1f}"])
    return lines


def scores(rows, known):
    columns = "mean / mean absolute / largest"
    head = ["model", "cloth", "speed basis", "blind points", "mean error %", "mean absolute error %", "largest error %",
            "within stated uncertainty", *(f"{name}: {columns}, %" for name in NAMES.values())]
    return table(head, score_lines({**drag_errors(rows, known), **printed_errors(known)}))


def frozen_lines():
    text = ["# Blind predictions of WALRUS and ADEPT compared with the measurements", "",
            f"`make validate-ojf STAGES=score`, from predictions frozen on {FROZEN_DAYS}, "
            "before any measurement of the two parachutes was known:", ""]
    folder = "../../validation/ojf"
    text += table(["frozen file", "made by commit", "SHA-256"],
                  [[f"[{name}]({folder}/frozen/{name})", commit[:7], digest]
                   for name, (commit, digest) in FROZEN.items()])
    return [*text, f"Errors are computed / measured - 1. Measured: [measured.csv]({folder}/measured.csv), "
            f"[peaks.csv]({folder}/peaks.csv).", ""]


def later_lines(known):
    """The scores of the predictions of predictions.csv where they are no longer the frozen ones."""
    later = csv_rows((HERE / "predictions.csv").read_text())
    if later == frozen("predictions.csv"):
        return []
    rows = predicted_uncertainties(later, csv_rows((HERE / "uncertainty.csv").read_text()))
    return ["## The same for later predictions, made with the measurements known", "", *scores(rows, known)]


def plotted_loads(rows, known):
    """Loads of the picture: the uncalibrated unsteady drags on both speed bases, the peaks of the coupled openings."""
    loads = []
    for row in rows:
        if row["porosity_model"] == "specified-unsteady-jet":
            nominal = row["speed_basis"] == "nominal"
            loads.append({"parachute": row["parachute"], "kind": row["speed_basis"], "computed": float(row["drag_n"]),
                          "measured": known[row["parachute"], float(row["nominal_m_s"])]["measured_drag_n"],
                          "pm": row["pm_n"] if nominal else None})
    peaks = {r["parachute"]: float(r["measured_peak_n"]) for r in csv_rows((HERE / "peaks.csv").read_text())}
    return loads + [{"parachute": row["parachute"], "kind": "peak", "computed": float(row["peak_100hz_n"]),
                     "measured": peaks[row["parachute"]], "pm": float(row["peak_100hz_pm_n"])}
                    for row in frozen("openings.csv") if row["air"] == "coupled"]


def report():
    known = measured_drags()
    rows = predicted_uncertainties(frozen("predictions.csv"), frozen("uncertainty.csv"))
    text = [*frozen_lines(), "## Drag, by model and speed basis, largest mean absolute error first", "",
            "The mean, the mean absolute and the largest error are over the blind points (five of WALRUS, three of "
            "ADEPT). The drag of Stratos IV was known to all models, and [NFM] fitted its porosity to it.", "",
            *scores(rows, known), *later_lines(known)]
    head = ["parachute", "speed basis", "m/s", "measured N", "measured drag area m2"]
    text += ["## Drag, point by point", "",
             *table([*head, *(f"{name}, %" for name in MODELS.values()), "[NFM], nonlinear, %"],
                    point_lines(drag_errors(rows, known), known))]
    head = ["parachute", "model", "measured N", "computed N", "error %", "within stated uncertainty", "[NFM], error %"]
    text += ["## Peak loads at nominal 30 m/s, low-passed at 100 Hz", "",
             *table(head, peak_lines(frozen("openings.csv")))]
    head = ["drag", "parachute", "speed basis", "drag areas A by rising speed, m2", "C, m2", "rms error %",
            "mean absolute error %", "largest error %", "A, first to last speed, %", "A, largest over smallest, %"]
    text += ["## One constant drag area per parachute", "",
             "A = F / (rho v^2 / 2). C minimises the sum of (C / A - 1)^2 over the points of the parachute; the errors "
             "are C / A - 1. No model whose drag area is constant can have a smaller rms error than that of the "
             "measured drag areas.", "", *table(head, constant_lines(known))]
    head = ["model", "parachute", "speed basis", "mean computed A, m2", "mean computed A / C - 1, %",
            "first to last speed, %", "largest over smallest, %"]
    text += ["The computed drag areas compared with C:", "", *table(head, bias_lines(rows, known))]
    (tables.ROOT / "docs/tables/ojf-score.md").write_text("\n".join(text).rstrip("\n") + "\n")
    picture = tables.ROOT / "docs/validation/blind-test.svg"
    picture.parent.mkdir(exist_ok=True)
    score_plot.draw(picture, plotted_loads(rows, known), NAMES)


if __name__ == "__main__":
    report()
