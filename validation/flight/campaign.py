#!/usr/bin/env python3
"""Free flights of eleven families and studies of vent, cloth and grid, compared with Knacke's manual.

    make validate-flights            (or: campaign.py --ripstop build/bin/ripstop --runs runs/flights --jobs 2)

Runs `ripstop fly` on the cases of this folder with one payload for all, and writes docs/tables/flights.md and the plots of the
guide. Nothing is fitted. Finished runs are not repeated, and interrupted runs continue. With names of flights only these
are run. `--tables` runs nothing: the tables have the finished flights, and the rows of the present page for the others.
"""
import argparse
import concurrent.futures
import csv
import dataclasses
import json
import math
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation"))
import tables  # pylint: disable=wrong-import-position
import vent_plot  # pylint: disable=wrong-import-position

PAYLOAD_KG, RELEASED_AT_DEG = 2.4, 10
BEGIN_S = 2  # of the force balance: the canopy has adapted from its start shape


@dataclasses.dataclass
class Flight:
    """One run: a case of this folder, the duration of its flight and its changes to the case."""
    case: str
    duration_s: float
    changes: tuple = ()


# Duration [s]: ten periods of canopies that swing take 30 s and more, of the others 15 s.
FAMILIES = {"flat-circular": 40, "conical": 40, "elliptical": 30, "extended-skirt": 40, "hemispherical": 40,
            "quarter-spherical": 30, "cross": 15, "annular": 25, "ringslot": 15, "ringsail": 15, "disk-gap-band": 20}
F_111 = "parachute.canopy_material=f-111-physical"  # 3 CFM; the cases have MIL-C-7020 type I of 100 CFM
CLOTHS = {"flat-circular, 3 CFM (F-111)": "flat-circular-f-111", "flat-circular, 30 CFM": "flat-circular-30-cfm",
          "flat-circular, 100 CFM": "flat-circular", "extended-skirt, 3 CFM (F-111)": "extended-skirt-f-111",
          "extended-skirt, 100 CFM": "extended-skirt", "cross, 3 CFM (F-111)": "cross-f-111", "cross, 100 CFM": "cross"}
# Percent of the nominal diameter; a vent of 1 % is smaller than a cell of the cloth and needs 7,854 nodes.
VENTS = {4: "flat-circular-vent-4", 10: "flat-circular", 20: "flat-circular-vent-20"}
GRIDS = {"flat-circular, 20 cells across": "flat-circular", "flat-circular, 24 cells across": "flat-circular-24",
         "flat-circular, 28 cells across": "flat-circular-28",
         "flat-circular, half the time step": "flat-circular-half-step", "cross, 20 cells across": "cross",
         "cross, 24 cells across": "cross-24", "cross, half the time step": "cross-half-step"}
FLIGHTS = {
    **{name: Flight(name, duration) for name, duration in FAMILIES.items()},
    **{f"flat-circular-vent-{share}": Flight("flat-circular", 15, (f"parachute.vent_diameter_m={0.0176 * share:g}",)) for share in (4, 20)},
    **{f"{case}-f-111": Flight(case, duration, (F_111,)) for case, duration in
       (("flat-circular", 25), ("extended-skirt", 20), ("cross", 25))},
    "flat-circular-30-cfm": Flight("flat-circular", 15, (F_111, "materials.f-111-physical.permeability_cfm=30")),
    **{f"{case}-24": Flight(case, duration, ("flight.cells_across=24",)) for case, duration in (("flat-circular", 30), ("cross", 6))},
    "flat-circular-28": Flight("flat-circular", 20, ("flight.cells_across=28",)),
    **{f"{case}-half-step": Flight(case, duration, ("flight.courant=0.28",)) for case, duration in
       (("flat-circular", 30), ("cross", 6))},
}

# Average angle of oscillation [deg], Knacke's Tables 5-1 and 5-2. Slotted canopies as OSCALC's manual reprints them
# (mwitty.com/content.php?id=5709156, text by character recognition); all others from memory, not verified in print.
KNACKE_ANGLE = {"flat-circular": (10, 40), "conical": (10, 30), "extended-skirt": (10, 15), "hemispherical": (10, 15),
                "cross": (0, 3), "annular": (0, 6), "ringslot": (0, 5), "ringsail": (5, 10), "disk-gap-band": (10, 15)}
STEADY_BELOW, SWINGING_FROM = 6, 10  # mean of the peaks of the angle from the vertical [deg]


def folder_of(options, name):
    return options.runs.resolve() / name


def command_of(options, name):
    flight = FLIGHTS[name]
    command = [str(options.ripstop.resolve()), "fly", f"validation/flight/{flight.case}.toml", "--mass", f"{PAYLOAD_KG:g}",
               "--duration", f"{flight.duration_s:g}", "--angle", f"{RELEASED_AT_DEG}", "--threads", "1",
               "--out", str(folder_of(options, name))]
    for change in flight.changes:
        command += ["--set", change]
    return command


def fly(options, name):
    """Whether the flight has a result. Exit code 4 means that the flight must not be used; its result has the reason."""
    command = command_of(options, name)
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    options.runs.mkdir(parents=True, exist_ok=True)
    with open(f"{folder_of(options, name)}.log", "w", encoding="utf-8") as log:
        code = subprocess.run(command, cwd=ROOT, check=False, stdout=log, stderr=subprocess.STDOUT).returncode
    if code not in (0, 4):
        print(f"{name}: ripstop failed ({log.name}); the same command again continues the flight", file=sys.stderr)
    return code in (0, 4)


def results_of(options):
    """Of all flights that are finished."""
    files = {name: folder_of(options, name) / "result.json" for name in FLIGHTS}
    return {name: json.loads(file.read_text()) for name, file in files.items() if file.exists()}


def number(result, key, error, digits):
    if result[key] is None:
        return ""
    text = f"{result[key]:.{digits}f}"
    return text if result[error] is None else f"{text} +- {result[error]:.{digits}f}"


def coefficient(result):
    return number(result, "descent_drag_coefficient", "descent_drag_coefficient_standard_error", 3)


def oscillation(result):
    return number(result, "mean_oscillation_deg", "mean_oscillation_standard_error_deg", 1)


def printed(interval, form):
    return f"{interval[0]:{form}} to {interval[1]:{form}}" if interval else ""


def beyond(value, low, high):
    """How far a value is outside of an interval, as a share of the nearer end."""
    return value / min(max(value, low), high) - 1


def agreement(result):
    interval, value = result.get("known_drag_coefficient"), result["descent_drag_coefficient"]
    if not interval or value is None:
        return ""
    off = beyond(value, *interval)
    return "inside" if off == 0 else f"{100 * off:+.0f} %"


def kind_of(angle):
    return "steady" if angle < STEADY_BELOW else "swinging" if angle >= SWINGING_FROM else "between"


def kind_known(interval):
    return "steady" if interval[1] <= STEADY_BELOW else "swinging" if interval[0] >= SWINGING_FROM else "between"


def families_flown(results):
    """Family, flight and result, with the cloth of the case and with F-111."""
    for family in FAMILIES:
        for name in (family, f"{family}-f-111"):
            if name in results:
                yield family, name, results[name]


def earlier_rows(section):
    """Rows of a section of the present page: flights whose runs are not on this machine."""
    page = ROOT / "docs/tables/flights.md"
    text = page.read_text() if page.exists() else ""
    lines = text.partition(f"\n## {section}\n")[2].split("\n## ")[0].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")][1:]


def flown_on(options, results):
    """A line for every day, with its flights; the days of flights that are not new are those of the page."""
    page = ROOT / "docs/tables/flights.md"
    days = {}
    for line in page.read_text().splitlines() if page.exists() else []:
        if line.startswith("Flown on "):
            day, _, names = line.removeprefix("Flown on ").rstrip(".").partition(": ")
            days[day] = [name for name in names.split(", ") if name not in results]
    for name in results:
        run = json.loads((folder_of(options, name) / "run.json").read_text())
        days.setdefault(tables.made_by([run]).rpartition(", ")[2], []).append(name)
    return [line for day, names in days.items() if names for line in (f"Flown on {day}: {', '.join(names)}.", "")]


def merged(section, rows, keys=1):
    """New rows replace those of the page with the same first cells; the other rows of the page remain."""
    new = {tuple(row[:keys]): row for row in rows}
    kept = [new.pop(tuple(row[:keys]), row) for row in earlier_rows(section)]
    return kept + list(new.values())


def families_rows(results):
    rows = []
    for family, name, r in families_flown(results):
        angle = KNACKE_ANGLE.get(family)
        mean = r["mean_oscillation_deg"]
        kind = kind_of(mean) if mean is not None else r["ended_by"] if r["descent_drag_coefficient"] is None else ""
        if mean is not None and angle:
            kind += ", as known" if kind == kind_known(angle) else f", known: {kind_known(angle)}"
        rows.append([family, "100" if name == family else "3", f"{r['duration_s']:.0f}",
                     number(r, "rate_of_descent_m_s", "rate_of_descent_standard_error_m_s", 2), f"{r['axial_drag_coefficient']:.3f}", coefficient(r), printed(r.get("known_drag_coefficient"), ".2f"), agreement(r),
                     number(r, "glide_ratio", "glide_ratio_standard_error", 2), oscillation(r), printed(angle, "g"), kind,
                     "" if r["largest_oscillation_deg"] is None else f"{r['largest_oscillation_deg']:.0f}",
                     number(r, "oscillation_period_s", "oscillation_period_standard_error_s", 1), str(r["half_swings"])])
    return merged("Families", rows, keys=2)


FAMILIES_HEAD = ["family", "cloth CFM", "flight s", "rate of descent m/s", "C_D0 on the axis", "C_D0 in descent", "Knacke C_D0", "difference from Knacke's range",
                 "glide ratio", "mean oscillation deg", "Knacke deg", "kind of oscillation", "largest angle deg", "period s", "half-swings"]


def count_line(rows):
    """How many flights agree, of those for which a value is known."""
    off = [row[FAMILIES_HEAD.index("difference from Knacke's range")] for row in rows]
    close = sum(cell == "inside" or abs(float(cell.strip("+ %"))) <= 5 for cell in off if cell)
    kinds = [row[FAMILIES_HEAD.index("kind of oscillation")] for row in rows]
    known = [kind for kind in kinds if "known" in kind]
    right = sum(kind.endswith("as known") for kind in known)
    return (f"C_D0 in descent is within Knacke's range or less than 5 % outside in {close} of {sum(map(bool, off))} flights. "
            f"The kind of oscillation is as known in {right} of {len(known)} flights.")


def read_path(folder):
    with open(folder / "path.csv", encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def force_balance(folder, area, density):
    """Means over the flight from BEGIN_S on: angle of attack [deg], rate of descent [m/s] and factors of the coefficient in descent.

    C_T is the force along the line from payload to skirt over the dynamic pressure of the canopy's own motion. The coefficient
    in descent is about C_T times the mean square of that speed over the square of the vertical one.
    """
    rows = read_path(folder)
    force = pressure = square = down = weight = angle = mouth = 0.0
    for before, row, after in zip(rows, rows[1:], rows[2:]):
        if row["time_s"] < BEGIN_S:
            continue
        span, step = after["time_s"] - before["time_s"], row["step_s"]
        air = [row[f"wind_{c}_m_s"] - (after[f"canopy_{c}_m"] - before[f"canopy_{c}_m"]) / span for c in "xyz"]
        line = [math.tan(math.radians(row["tilt_x_deg"])), math.tan(math.radians(row["tilt_y_deg"])), 1.0]
        along = sum(row[f"air_force_{c}_n"] * x for c, x in zip("xyz", line)) / math.hypot(*line)
        speed = math.hypot(*air)
        force += step * along
        pressure += step * density / 2 * speed ** 2 * area
        square, down, weight = square + step * speed ** 2, down - step * row["velocity_z_m_s"], weight + step
        angle, mouth = angle + step * row["angle_of_attack_deg"], mouth + step * row["mouth_area_m2"]
    return {"angle": angle / weight, "along": force / pressure, "ratio": square / weight / (down / weight) ** 2,
            "mouth": mouth / weight / rows[0]["mouth_area_m2"], "descent": down / weight}


def balance_table(options, results):
    rows = []
    for name, r in results.items():
        if r["descent_drag_coefficient"] is None or r["duration_s"] < 1.2 * BEGIN_S:
            continue
        mean = force_balance(folder_of(options, name), r["reference_area_m2"], r["density_kg_m3"])
        whole = r["descent_drag_coefficient"] * (r["rate_of_descent_m_s"] / mean["descent"]) ** 2
        rows.append([name, f"{mean['angle']:.0f}", f"{r['axial_drag_coefficient']:.3f}", f"{mean['along']:.3f}",
                     f"{mean['ratio']:.3f}", f"{whole:.3f}", f"{mean['mouth']:.2f}", f"{r['start_up_time_s']:.0f}", f"{100 * r['energy_residual']:.3f}", f"{100 * r['momentum_residual']:.3f}", f"{r['load_factor']:.2f}"])
    return tables.table(["flight", "mean angle of attack deg", "C_T on the axis", "C_T in flight", "(V / V_v)^2",
                         f"C_D0 from {BEGIN_S} s on", "mouth area over that at the start", "start-up s", "energy residual %", "momentum residual %", "load factor"], merged("Force balance", rows))


def study_table(section, head, flights, results):
    rows = []
    for label, name in flights:
        if name in results:
            r = results[name]
            rows.append([str(label), f"{r['duration_s']:.0f}", number(r, "rate_of_descent_m_s", "rate_of_descent_standard_error_m_s", 2),
                         f"{r['axial_drag_coefficient']:.3f}", coefficient(r), number(r, "glide_ratio", "glide_ratio_standard_error", 2),
                         oscillation(r), str(r["half_swings"])])
    return tables.table([head, "flight s", "rate of descent m/s", "C_D0 on the axis", "C_D0 in descent", "glide ratio",
                         "mean oscillation deg", "half-swings"], merged(section, rows))


def parsed(cell):
    """Value and standard error of a cell "0.742 +- 0.013"; no error: None."""
    value, _, error = cell.partition(" +- ")
    return float(value), float(error) if error else None


def plot_vents():
    """From the rows of the page, whose flights may be of different days."""
    rows = sorted((float(row[0]), row) for row in earlier_rows("Vent"))
    columns = [[(share, *parsed(row[column])) for share, row in rows if row[column]] for column in (3, 4, 6)]
    vent_plot.write(ROOT / "docs/tables/spill-hole.svg", *columns)


def write_tables(options):
    results = results_of(options)
    if not results:
        sys.exit("no flight is finished: no table is written")
    conditions = (f"Payload {PAYLOAD_KG:g} kg, released at {RELEASED_AT_DEG} degrees, nominal diameter 1.76 m, 1.2 kg/m3, still air, cloth of "
                  "100 CFM (MIL-C-7020 type I). C_D0 on the axis: coefficient in the steady flow from which each flight starts.")
    families = families_rows(results)
    lines = [conditions, "", *flown_on(options, results), "## Families", "", *tables.table(FAMILIES_HEAD, families), count_line(families), "",
             f"Half-swing: half a period. Mean oscillation: mean of the largest angles from the vertical in the half-swings. Kind: steady if this mean is "
             f"below {STEADY_BELOW} degrees, swinging from {SWINGING_FROM} degrees. Knacke's coefficients are those of a transcription of his Tables 5-1 and 5-2. "
             "His angles of slotted canopies are from a reprint read by character recognition; those of the others are from memory.", "",
             "## Force balance", "", *balance_table(options, results),
             f"Means from {BEGIN_S} s on. C_T: force along the line from payload to skirt, over the dynamic pressure of the speed V of the canopy through the air. The "
             "coefficient in descent is about C_T times the square of V over the rate of descent V_v.", "",
             "## Vent", "", *study_table("Vent", "vent, % of D0", VENTS.items(), results),
             "## Cloth", "", *study_table("Cloth", "flight", CLOTHS.items(), results),
             "## Cells and time step", "", *study_table("Cells and time step", "flight", GRIDS.items(), results)]
    made = [json.loads((folder_of(options, name) / "run.json").read_text()) for name in results]
    tables.write("flights", "Free flights", "make validate-flights", made, lines)
    plot_vents()
    print("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/flights")
    parser.add_argument("--jobs", type=int, default=max(1, (os.cpu_count() or 2) // 2), help="flights at a time, one thread each")
    parser.add_argument("--tables", action="store_true", help="only the tables, of the flights that are finished")
    parser.add_argument("names", nargs="*", help="flights; all of them without a name: " + ", ".join(FLIGHTS))
    options = parser.parse_args()
    if unknown := set(options.names) - set(FLIGHTS):
        parser.error(f"no such flight: {', '.join(sorted(unknown))}")
    flown = True
    if not options.tables:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            flown = all(list(pool.map(lambda name: fly(options, name), options.names or FLIGHTS)))
    write_tables(options)
    if not flown:
        sys.exit(1)


if __name__ == "__main__":
    main()
