#!/usr/bin/env python3
"""One table of all comparisons with measurements, handbooks, other codes and published computations: docs/validation/scoreboard.md.
The numbers are read from the tables of docs/tables, which their own commands make. Only errors and means are computed here."""
import math
import pathlib
import re
import statistics
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/validation/scoreboard.md"

KINDS = {
    "blind prediction": "The measurement was not known when the prediction was made, and nothing was calibrated on it.",
    "comparison": "The reference was known. Nothing was calibrated on it.",
    "comparison with a range": "The reference is a range of a handbook. The error is relative to its nearest limit, and 0 within the range.",
    "oscillation": "The reference is the handbook's range of the mean oscillation angle. Computed in free flight; error as in the row above.",
    "cross-validation": "The reference is a computation with another code or another equation.",
    "reproduction": "The coefficients were calibrated on this measurement by its authors.",
    "calibration": "The result was calibrated on the reference, so the error is no measure of accuracy.",
}

ABOUT = """This page lists comparisons of Ripstop with measurements, handbooks, other codes and published computations. The command
writes it from the linked tables, and each table states its own command, machine and day. The error is computed / reference - 1. For a
tunnel correction, computed and reference are the drag in the tunnel over that in free air. The largest error of a kind comes first. A
measured point appears once for each model and speed basis, so the comparisons of a kind are not independent. A mean combines all
quantities of its kind, for example drag, drag coefficients and peak loads. [Validation](../validation.md) explains the runs and their
limits, and [the campaign](ojf.md) has further models. Comparisons with exact solutions are on the pages on [cloth](cloth.md),
[flow](flow.md) and [openings](inflation.md)."""

TERMS = """"Uncalibrated" is the porous sheet with the specified permeability of the cloth, in unsteady flow in the open jet. "`paper`" is the
porosity model of [NFM] in steady flow. "+-" is the standard error of a mean; for peak loads it is the stated uncertainty. $C_D$ is the
drag coefficient on the nominal area of a canopy or the frontal area of a body. $C_N$ is the coefficient of the force normal to the
plate. $q S_0$ is the dynamic pressure times the nominal area. CFM (ft3/min per ft2) is the permeability of the cloth. A half-swing is half a period of the oscillation; the mean
oscillation angle is the mean of the largest angles from the vertical in the half-swings."""

REFERENCES = """The measurements in the Open Jet Facility are those of [NFM] ([references](../references.bib)). The ranges are those of Knacke's
manual. They were not checked against the print. The references of rigid bodies and porous disks are on [bodies of known
drag](flow.md#bodies-of-known-drag), and that of an inclined plate on [plates at an angle](flow-in-time.md#plates-at-an-angle). Tunnel corrections are compared with [theory](../theory/tunnel.md). OpenFOAM uses a [body-fitted
mesh](../theory/flow-openfoam.md#body-fitted-mesh)."""


def tables(name):
    """The tables of docs/tables/<name>.md as lists of rows; a row maps heading to cell."""
    found, heading = [], None
    for line in [*(ROOT / f"docs/tables/{name}.md").read_text().splitlines(), ""]:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else None
        if cells is None:
            heading = None
        elif heading is None:
            heading = cells
            found.append([])
        elif not re.fullmatch(r"[-: |]+", line):
            found[-1].append(dict(zip(heading, cells)))
    return found


def number(text):
    return float(re.match(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)[0])


def beyond(value, bounds):
    """Error in % of a value against a range "a to b" or "a"."""
    low, high = (lambda ends: (ends[0], ends[-1]))([float(end) for end in bounds.split(" to ")])
    return 0.0 if low <= value <= high else 100 * (value / (low if value < low else high) - 1)


class Board:
    def __init__(self):
        self.rows = []

    def add(self, kind, what, reference, computed, error, command, table):
        self.rows.append((kind, what, reference, computed, error, command, table))

    def against(self, kind, what, reference, computed, command, table, unit="", error=None):
        """A row with the error of its table, else with that of the two rounded numbers."""
        self.add(kind, what, f"{reference}{unit}", f"{computed}{unit}",
                 number(error) if error else 100 * (number(computed) / number(reference) - 1), command, table)


def predicted_drags():
    """Drag with its standard error by parachute, speed basis, nominal speed and model, as the tables of the predictions have it."""
    drags = {}
    for row in tables("ojf-predictions")[0]:
        if row["cloth"] == "nonlinear":
            error = f" +- {row['standard error N']}" if row["standard error N"] else ""
            drags[row["parachute"].upper(), row["speed basis"], row["nominal m/s"], row["model"]] = row["drag N"] + error
    for row in tables("ojf-jet")[0]:
        drags["Stratos IV", row["speed basis"], row["nominal m/s"], "specified-unsteady-jet"] = row["jet, unsteady N, standard error"]
    return drags


def campaign(board):
    """Drag and peaks of the Open Jet Facility. The drag of the predictions must agree with the error of the score."""
    _, _, points, peaks, *_ = tables("ojf-score")
    drags = predicted_drags()
    command = "make validate-ojf STAGES=score"
    nominal = ""
    for point in points:  # the point at a measured speed follows that at its nominal speed
        nominal = point["m/s"] if point["speed basis"] == "nominal" else nominal
        for heading, porosity, model in (("uncalibrated sheet, open jet, unsteady, %", "specified-unsteady-jet", "uncalibrated"),
                                         ("`paper`, calibrated, %", "paper", "`paper`, calibrated on Stratos IV")):
            if not point[heading]:
                continue
            known = point["parachute"] == "Stratos IV"
            measured, error = number(point["measured N"]), number(point[heading])
            kind = ("calibration" if model != "uncalibrated" else "comparison") if known else "blind prediction"
            drag = drags[point["parachute"], point["speed basis"], nominal, porosity]
            if abs(number(drag) - measured * (1 + error / 100)) > 0.05 + measured * 0.0005:
                raise SystemExit(f"{point['parachute']} at {nominal} m/s: the drag {drag} N has not the error of {error} % of the table ojf-score")
            board.add(kind, f"drag of {point['parachute']} at {point['speed basis']} {point['m/s']} m/s, {model}", f"{measured:g} N",
                      f"{drag} N", error, command, "ojf-score")
    for peak in peaks:
        known, calibrated = peak["parachute"] == "Stratos IV", "calibrated on" in peak["model"]
        kind = ("calibration" if calibrated else "comparison") if known else "blind prediction"
        board.against(kind, f"peak load of {peak['parachute']}, {peak['model']}", peak["measured N"], peak["computed N"], command, "ojf-score", " N",
                      peak["error %"])


def families(board):
    """Drag and openings of the canopy families against Knacke's manual."""
    for row in tables("families")[0]:
        if reference := row["Knacke, in descent"]:
            board.add("comparison with a range", f"$C_D$, {row['example']}, steady", reference, row["drag coefficient"],
                      beyond(number(row["drag coefficient"]), reference), "make validate-families", "families")
    for row in tables("families-in-time")[0]:
        value = row["drag coefficient, unsteady, standard error"]
        board.add("comparison with a range", f"$C_D$, {row['example']}, unsteady", row["Knacke, in descent"], value,
                  beyond(number(value), row["Knacke, in descent"]), "make validate-families-in-time", "families-in-time")
    for row in tables("flights")[0]:
        if reference := row["Knacke C_D0"]:
            board.add("comparison with a range", f"$C_D$ in free flight, {row['family']}, {row['cloth CFM']} CFM", reference, row["C_D0 in descent"],
                      beyond(number(row["C_D0 in descent"]), reference), "make validate-flights", "flights")
        if reference := row["Knacke deg"]:
            board.add("oscillation", f"{row['family']}, {row['cloth CFM']} CFM, half-swings: {row['half-swings']}", f"{reference} deg",
                      f"{row['mean oscillation deg']} deg", beyond(number(row["mean oscillation deg"]), reference), "make validate-flights", "flights")
    for row in tables("families-openings")[0]:
        board.add("comparison with a range", f"peak load over $q S_0$, {row['example'].split(',')[0]}", row["Knacke C_x C_D"], row["peak over q S0"],
                  beyond(number(row["peak over q S0"]), row["Knacke C_x C_D"]), "make validate-openings", "families-openings")


def bodies(board):
    """Rigid bodies, and the canopies that OpenFOAM computes on a fitted mesh."""
    for row in tables("bodies-in-time")[0]:
        if row["subgrid-scale model"] == "des":
            porous = "porous" in row["body"]
            board.against("cross-validation" if porous else "comparison", f"$C_D$, {row['body']}, unsteady", row["reference"],
                          row["unsteady, standard error"], "build-check/bench/bench_bodies in-time 16", "bodies-in-time", error=row["error, unsteady"])
    plates = {row["angle, deg"]: number(row["C_T"]) for row in tables("plates")[0]}
    command = "build-check/bench/bench_attack plate 12 0 30 45 60"
    board.against("comparison", "$C_N$, square plate across the stream, 12 cells, unsteady", "1.170", f"{plates['0']:.3f}", command, "plates")
    board.against("comparison", "$C_N$ at 30 degrees incidence over that at 90, square plate, unsteady", "1.24",
                  f"{plates['60'] / plates['0']:.2f}", command, "plates")
    for row in tables("plate")[0]:
        incidence = 90 - number(row["angle, deg"])
        measured = 1 / (0.222 + 0.283 / math.sin(math.radians(incidence)))  # Hoerner1965
        board.against("comparison", f"$C_N$, plate between walls at {incidence:g} degrees incidence, 8 cells, unsteady", f"{measured:.3f}", row["C_T"],
                      "build-check/bench/bench_attack between-walls 2.5 8 0 30 45 60", "plate")
    for row in tables("judge")[0]:
        board.against("cross-validation", f"$C_D$ on the frontal area, {row['body']}, OpenFOAM", row["OpenFOAM"], row["C_D on the frontal area, built-in"],
                      "make judge", "judge", error=row["built-in compared with OpenFOAM"])
    for row in tables("tunnel-disks")[0]:
        if row["air"] != "free air":
            board.add("cross-validation", f"tunnel correction of $C_D$, disk {row['disk']}, {row['air']}, blockage {row['blockage']}",
                      row["theory"], row["change from free air"],
                      100 * ((1 + number(row["change from free air"]) / 100) / (1 + number(row["theory"]) / 100) - 1),
                      "build-check/bench/bench_tunnel disks 8", "tunnel-disks")


def printed(board):
    """Stratos IV with the coefficients that [NFM] fitted to it."""
    for row in tables("stratos-iv")[0]:
        what = f"drag of Stratos IV at nominal {row['nominal m/s']} m/s, printed coefficients"
        board.against("reproduction", what, row["measured N"], row["computed N"], "make validate", "stratos-iv", " N", row["error %"])
        board.against("cross-validation", f"{what}, computed by [NFM]", row["printed N"], row["computed N"], "make validate", "stratos-iv", " N")


def signed(value):
    """With one decimal and a sign, except for zero."""
    return f"{value:+.1f}" if round(value, 1) else "0.0"


def wrapped(text):
    return textwrap.wrap(text, 120, break_long_words=False, break_on_hyphens=False)


def page(rows):
    lines = ["# Scoreboard", "", "    python3 validation/scoreboard.py", "", *wrapped(ABOUT), "",
             "| kind | comparisons | mean absolute error % | largest error % | meaning |", "|---|---|---|---|---|"]
    for kind, meaning in KINDS.items():
        errors = [row[4] for row in rows if row[0] == kind]
        lines.append(f"| [{kind}](#{kind.replace(' ', '-')}) | {len(errors)} | {statistics.mean(map(abs, errors)):.1f} | "
                     f"{signed(max(errors, key=abs))} | {meaning} |")
    lines += ["", *wrapped(TERMS)]
    for kind in KINDS:
        lines += ["", f"## {kind.capitalize()}", "", "| comparison | reference | computed | error % | command | table |", "|---|---|---|---|---|---|"]
        lines += [f"| {what} | {reference} | {computed} | {signed(error)} | `{command}` | [`{table}`](../tables/{table}.md) |"
                  for _, what, reference, computed, error, command, table in
                  sorted((row for row in rows if row[0] == kind), key=lambda row: -abs(row[4]))]
    lines += ["", "## References", "", *wrapped(REFERENCES)]
    return "\n".join(lines) + "\n"


def scoreboard():
    board = Board()
    for part in (campaign, families, bodies, printed):
        part(board)
    return page(board.rows)


if __name__ == "__main__":
    PAGE.write_text(scoreboard())
    print(PAGE.relative_to(ROOT))
