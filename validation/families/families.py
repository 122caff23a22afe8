#!/usr/bin/env python3
"""Computes the example of every family and the three parachutes of the campaign in steady flow, under the load of the flow and a uniform
one.

    make validate-families            (or: families.py --ripstop build/bin/ripstop --runs runs/families)

Runs `ripstop steady` on each with cloth of the library as a sheet of its specified permeability, without calibration. `coupling.load` is
"of-flow", the default, and then "uniform". docs/tables/families.md compares the drag with Knacke's manual, and examples/families.json
has it as data for `ripstop size` (shipped.py). docs/tables/loads.md compares both loads, and docs/tables/first-estimates.md the first estimate of a run with its result. Pictures and plots, first of all `load.png`
and `pressure.png`, remain in the run folders. Finished runs are not repeated. `--grid 40 40 50 --set KEY=VALUE` are passed to `ripstop`
for a quick test; the loads are then only printed.

`families.py --in-time` (make validate-families-in-time) computes the families of Knacke's manual with an unsteady wake: means over time
with their standard errors, in docs/tables/families-in-time.md.

`families.py --symmetry` (make validate-symmetry) computes every example in the full flow domain and in a quarter of it, on the default
cells or `--grid`, one thread each: docs/tables/symmetry.md.

`families.py --openings` (make validate-openings) computes their coupled inflation with a fixed riser, from a skirt of a quarter of the
nominal diameter: docs/tables/families-openings.md.
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import statistics
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "validation"), str(ROOT / "validation/ojf")]
import shipped  # pylint: disable=wrong-import-position
import tables  # pylint: disable=wrong-import-position
from campaign import SHEET_SPECIFIED  # pylint: disable=wrong-import-position

CALIBRATED = "f-111"  # on Stratos IV: the cloth of the campaign, whose cases have the paper's box and porosity
LOADS = ["of-flow", "uniform"]
# Cloth of the usual permeability, like that of the canopies in the handbook.
OPENING = ["parachute.canopy_material=mil-c-7020-type-i", "inflation.duration_s=0.4", "inflation.frames=80",
           "inflation.cloth_damping_s=1e-5", "inflation.low_pass_hz=100"]
# Narrow rings that wrinkle turn over, and the canopy then remains half open: docs/theory/inflation.md.
OPENING_OF = {"ringslot": ["inflation.cloth_compression=0.1"]}
MOUTHS = {"cross": 0.15}  # radius of the folded skirt [m] where 0.12 m cannot be folded
IN_TIME = "in-time"  # instead of a load: that of the flow, in time
PARTS = ["full", "auto"]  # likewise: flow.symmetry, under the load of the flow


def examples():
    """Families and the parachutes of the campaign: one canopy without bodies."""
    cases = {case.parent.name: tomllib.loads(case.read_text()) for case in sorted((ROOT / "examples").glob("*/case.toml"))}
    names = {name: case["parachute"].get("canopy_material") == CALIBRATED
             for name, case in cases.items() if "body" not in case and "cluster" not in case}
    return [name for name, of_campaign in names.items() if not of_campaign], [name for name, of_campaign in names.items() if of_campaign]


FAMILIES, CAMPAIGN = examples()


def folder_of(options, name, load):
    return options.runs.resolve() / (name if load == LOADS[0] else f"{name}-{load}")


def run(options, name, load):
    command = [str(options.ripstop.resolve()), "steady", f"examples/{name}/case.toml", "--out", str(folder_of(options, name, load))]
    how = {IN_TIME: ["flow.unsteady=true"], **{part: [f"flow.symmetry={part}", "coupling.threads=1"] for part in PARTS}}
    settings = [*(SHEET_SPECIFIED if name in CAMPAIGN else []), *how.get(load, [f"coupling.load={load}"]), *options.set]
    for setting in settings:
        command += ["--set", setting]
    if options.grid:
        command += ["--grid", *map(str, options.grid)]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode != 0:
        print(f"{name}, {load}: ripstop failed; the same command again goes on from here", file=sys.stderr)
        return None
    return json.loads((folder_of(options, name, load) / "result.json").read_text())


def printed_range(r):
    known = r.get("known_drag_coefficient")
    return f"{known[0]:.2f} to {known[1]:.2f}" if known else ""


def in_time_table(options, results):
    rows = []
    for name, r in results.items():
        with open(folder_of(options, name, IN_TIME) / "iterations.csv", encoding="utf-8") as file:
            steady = [float(row["drag_n"]) for row in csv.DictReader(file) if row["in_time"] == "0"][-1]
        per_newton, (low, high) = r["drag_coefficient"] / r["drag_n"], r["known_drag_coefficient"]
        error = per_newton * r["unsteady"]["drag_standard_error_n"]
        off = r["drag_coefficient"] / min(max(r["drag_coefficient"], low), high) - 1  # relative to the nearer end of the range
        inside = "yes" if abs(off) * low <= error else f"{100 * off:+.0f} %"
        rows.append([name, f"{per_newton * steady:.3f}", f"{r['drag_coefficient']:.3f} +- {error:.3f}", printed_range(r), inside,
                     f"{r['drag_n']:.1f}", str(r["coupling_iterations"]), f"{r['wall_time_s']:.0f}"])
    return tables.table(["example", "steady", "drag coefficient, unsteady, standard error", "Knacke, in descent", "within the range, or difference", "drag N",
                         "iterations", "wall s"], rows)


def families_table(results):
    rows = []
    for name in FAMILIES:
        r = results[name, LOADS[0]]
        nominal = (4 / math.pi * r["reference_area_m2"]) ** 0.5
        rows.append([name, f"{r['drag_coefficient']:.3f}", printed_range(r), f"{r['projected_diameter_m'] / nominal:.3f}",
                     f"{r['drag_n']:.1f}", str(r["coupling_iterations"]), f"{r['wall_time_s']:.0f}"])
    return tables.table(["example", "drag coefficient", "Knacke, in descent", "projected / nominal diameter", "drag N", "iterations",
                         "wall s"], rows)


def median_of(folder, column):
    with open(folder / "pressure.csv", encoding="utf-8") as rows:
        return statistics.median(float(row[column]) for row in csv.DictReader(rows))


def loads_table(options, results):
    rows = []
    for (name, load), r in results.items():
        if r is None:
            rows.append([name, load, "failed", *[""] * 9])
            continue
        folder = folder_of(options, name, load)
        moment = r["axial_moment_n_m"] / (r["drag_n"] * r["projected_diameter_m"] / 2)
        count = f"{r['coupling_iterations']}" + ("" if r["converged"] else ", not converged")
        remainder = f"{100 * r['load_remainder']:.2f}" if load == "of-flow" else ""
        rows.append([name, load, f"{r['drag_n']:.1f}", f"{r['projected_diameter_m']:.3f}", f"{r['skirt_diameter_m']:.3f}",
                     f"{r['max_line_tension_n']:.1f}",
                     f"{median_of(folder, 'cp_inside'):.2f}", f"{median_of(folder, 'cp_outside'):.2f}", remainder,
                     f"{100 * abs(moment):.2f}", f"{100 * r['section_gap']:.1f}", count])
    return tables.table(["example", "load", "drag N", "projected diameter m", "skirt diameter m", "maximum line tension N",
                         "Cp inside", "Cp outside", "residual traction %", "axial moment %", "section imbalance %",
                         "coupling iterations"], rows)


def estimates_table(results):
    """First estimates of the runs under the load of the flow, and their differences from the results."""
    rows = []
    for name, r in results.items():
        first = r["first_estimate"]
        rows.append([name, f"{first['drag_n']:.1f}", f"{r['drag_n']:.1f}", f"{100 * (first['drag_n'] / r['drag_n'] - 1):+.1f}",
                     f"{first['projected_diameter_m']:.3f}", f"{r['projected_diameter_m']:.3f}",
                     f"{100 * (first['projected_diameter_m'] / r['projected_diameter_m'] - 1):+.1f}"])
    return tables.table(["example", "drag estimated N", "drag N", "difference %", "projected diameter estimated m", "projected diameter m",
                         "difference %"], rows)


def in_handbook():
    """Family -> its row of examples/families.json."""
    return {row["family"]: row for row in json.loads((ROOT / "examples/families.json").read_text())["families"]
            if row["handbook_drag_coefficient"]}


def opened(options, name):
    """Result of the opening, and the filling distance of the handbook."""
    ripstop, case, folder = str(options.ripstop.resolve()), f"examples/{name}/case.toml", folder_of(options, name, "opening")
    command = [ripstop, "inflate", case, "--air", "coupled", "--out", str(folder)]
    for setting in [*OPENING, *OPENING_OF.get(name, []), f"inflation.initial_radius_m={MOUTHS.get(name, 0.12)}", *options.set]:
        command += ["--set", setting]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    if subprocess.run(command, cwd=ROOT, check=False).returncode not in (0, 4):  # 4: the load is not yet steady, but the peak is complete
        sys.exit(f"{name}: ripstop failed; the same command again goes on from here")
    load = subprocess.run([ripstop, "load", case, "--mass", "1", "--speed", "20", "--json", "--out", str(folder.parent / f"{name}-load")],
                          cwd=ROOT, check=True, capture_output=True, text=True)
    return json.loads((folder / "result.json").read_text()), json.loads(load.stdout)


def pull_of_last_fifth(folder):
    """Force of the flow on canopy and lines [N], and its angle to the stream [deg], because a free canopy swings."""
    with open(folder / "air.csv", encoding="utf-8") as file:
        rows = [{key: float(row[key]) for key in ("time_s", "step_s", "drag_n", "side_force_x_n", "side_force_y_n")}
                for row in csv.DictReader(file)]
    rows = [row for row in rows if row["time_s"] > 0.8 * rows[-1]["time_s"]]
    side = [math.hypot(row["side_force_x_n"], row["side_force_y_n"]) for row in rows]
    steps = [row["step_s"] for row in rows]
    pull = statistics.fmean([math.hypot(row["drag_n"], aside) for row, aside in zip(rows, side)], steps)
    return pull, statistics.fmean([math.degrees(math.atan2(aside, row["drag_n"])) for row, aside in zip(rows, side)], steps)


def over_whole_area(r, known, nominal_diameter):
    """The peak over the product of dynamic pressure and nominal area, and the same of the handbook's C_x and drag coefficients."""
    of_area = known["density_kg_m3"] / 2 * known["speed_m_s"] ** 2 * math.pi / 4 * nominal_diameter ** 2  # [N]
    low, high = (r["knacke_coefficient"] * drag for drag in known["handbook_drag_coefficient"])
    return f"{r['low_pass_peak_load_n'] / of_area:.2f}", f"{low:.2f} to {high:.2f}"


def openings(options):
    rows, made = [], []
    for name, known in in_handbook().items():
        if name not in options.names:
            continue
        r, handbook = opened(options, name)
        made += tables.runs_below(folder_of(options, name, "opening"))
        way = known["speed_m_s"] * r["low_pass_peak_time_s"] / handbook["nominal_diameter_m"]
        settled = "" if r["settled"] else ", not settled"
        pull, aside = pull_of_last_fifth(folder_of(options, name, "opening"))
        label = ", ".join([name, *(f"`{setting}`" for setting in OPENING_OF.get(name, []))])
        rows.append([label, f"{r['low_pass_peak_load_n']:.0f}", f"{1000 * r['low_pass_peak_time_s']:.0f}",
                     f"{r['last_load_n']:.0f} +- {100 * r['last_load_deviation']:.0f} %{settled}",
                     f"{pull:.0f}, {aside:.0f} deg", f"{r['low_pass_peak_load_n'] / pull:.2f}",
                     f"{r['knacke_coefficient']:g}", *over_whole_area(r, known, handbook["nominal_diameter_m"]), f"{way:.1f}",
                     f"{handbook['filling_constant']:g}", f"{100 * r['pierced_edges']:.1f}"])
    table = tables.table(["example", "peak at 100 Hz N", "at ms", "mean axial load of the last fifth N", "resultant N, inclination",
                          "peak over the resultant", "Knacke C_x", "peak over q S0", "Knacke C_x C_D", "distance to the peak in nominal diameters",
                          "filling distance of the handbook in nominal diameters", "edges that pierce cloth %"], rows)
    print("\n".join(table))
    foot = ["The filling distance of the handbook is that of `ripstop load`, for a payload in free flight (finite mass)."]
    if len(rows) == len(in_handbook()) and not options.set:
        tables.write("families-openings", "Coupled inflation of the families", "make validate-openings", made, table + foot)


def in_time(options):
    known = in_handbook()
    results = {name: run(options, name, IN_TIME) for name in options.names if name in known}
    if None in results.values():
        sys.exit("a run failed: no table is written")
    table = in_time_table(options, results)
    print("\n".join(table))
    if set(known) == set(results) and not options.grid and not options.set:
        made = [run for name in results for run in tables.runs_below(folder_of(options, name, IN_TIME))]
        tables.write("families-in-time", "Families with an unsteady wake", "make validate-families-in-time", made, table)


def part_of_domain(options, name, part):
    """Result of a steady run with flow.symmetry, and its flow iterations and processor seconds, None where it failed."""
    folder = folder_of(options, name, part)
    finished = (folder / "result.json").exists()
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    if run(options, name, part) is None:
        return None
    seconds = folder / "processor-seconds"  # of the run that made the folder
    if not finished:
        seconds.write_text(f"{resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before:.1f}\n")
    with open(folder / "iterations.csv", encoding="utf-8") as file:
        iterations = sum(int(row["flow_iterations"]) for row in csv.DictReader(file))
    return json.loads((folder / "result.json").read_text()), iterations, float(seconds.read_text())


def symmetry(options):
    rows, made = [], []
    for name in options.names:
        parts = [part_of_domain(options, name, part) for part in PARTS]
        if None in parts:
            rows.append([name, "failed", *[""] * 7])
            continue
        made += [made_run for part in PARTS for made_run in tables.runs_below(folder_of(options, name, part))]
        (full, full_steps, full_time), (quarter, steps, time) = parts
        domain = quarter["flow_domain"]
        rows.append([name, f"{full['drag_n']:.2f}", f"{quarter['drag_n']:.2f}", f"{100 * (quarter['drag_n'] / full['drag_n'] - 1):+.2f}",
                     f"{full['coupling_iterations']}, {quarter['coupling_iterations']}", f"{full_steps}, {steps}",
                     f"{full_time:.0f}, {time:.0f}", f"{full_time / time:.1f}", domain["reason"] or "quarter"])
    table = tables.table(["example", "drag in the full domain N", "with `flow.symmetry = \"auto\"` N", "difference %",
                          "coupling iterations", "flow iterations", "processor s", "ratio", "domain"], rows)
    print("\n".join(table))
    cells = "x".join(map(str, options.grid)) if options.grid else "default"
    if options.names == FAMILIES + CAMPAIGN and not options.set:
        command = "make validate-symmetry" + (f' GRID="{" ".join(map(str, options.grid))}"' if options.grid else "")
        tables.write("symmetry", f"Steady drag in the full flow domain and in a quarter of it, {cells} cells", command, made, table)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/families")
    parser.add_argument("--grid", type=int, nargs=3)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--in-time", action="store_true")
    parser.add_argument("--openings", action="store_true")
    parser.add_argument("--symmetry", action="store_true")
    parser.add_argument("names", nargs="*", default=FAMILIES + CAMPAIGN, help="examples; all of them without a name")
    options = parser.parse_args()
    for wanted, table in ((options.in_time, in_time), (options.openings, openings), (options.symmetry, symmetry)):
        if wanted:
            table(options)
            return
    whole = not options.grid and not options.set and options.names == FAMILIES + CAMPAIGN
    of_flow = {name: run(options, name, LOADS[0]) for name in options.names}
    if None not in of_flow.values():
        estimates = estimates_table(of_flow)
        print("\n".join(estimates))
        if whole:
            made = [run for name in of_flow for run in tables.runs_below(folder_of(options, name, LOADS[0]))]
            tables.write("first-estimates", "First estimate of a steady run and its result", "make validate-families", made, estimates)
    uniform = {name: run(options, name, LOADS[1]) for name in options.names}
    results = {(name, load): done[name] for name in options.names for load, done in zip(LOADS, (of_flow, uniform))}
    loads = loads_table(options, results)
    print("\n".join(loads))
    if not whole:
        return
    if None in results.values():
        sys.exit("a run failed: no table is written")
    made = [run for name, load in results for run in tables.runs_below(folder_of(options, name, load))]
    tables.write("families", "Steady drag of the example of every family", "make validate-families", made, families_table(results))
    shipped.write()
    foot = ["Cp: medians along the gore (`pressure.csv`). Residual traction: share of the pressure. Axial moment: share of drag times half the projected diameter."]
    tables.write("loads", "Load of the flow compared with a uniform load", "make validate-families", made, loads + foot)


if __name__ == "__main__":
    main()
