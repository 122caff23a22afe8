#!/usr/bin/env python3
"""Regimes of an opening: filling distance and load over mass, size, speed and cloth, from the closed mouth.

    make validate-regimes             (or: regimes.py --ripstop build/bin/ripstop --runs runs/regimes)

Coupled openings of flat circular canopies on the default cells with 2,500 cloth nodes, compared with the handbook
(`ripstop load`). Nothing is fitted. Writes docs/tables/regimes.md and its plots. A finished run is not computed again,
and an interrupted one continues. `--rows c-9,base-100` computes these rows only. `--tables` runs nothing: page and plots
have the finished rows.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "validation"))
import openings  # pylint: disable=wrong-import-position
import panels  # pylint: disable=wrong-import-position
import tables  # pylint: disable=wrong-import-position

FLAT, C_9 = "validation/flight/flat-circular.toml", "validation/opening/c-9.toml"
SPEED, MASS, DIAMETER = 20.0, 2.4, 1.76  # of the base: [m/s], [kg], [m]
BASE = {"inflation.mass": "payload", "inflation.flight_angle_deg": "0", "inflation.frames": "100", "parachute.mesh.cloth_nodes": "2500"}
FLAT_BASE = {"parachute.tape.material": "nylon-tape-200-lbf", "inflation.cloth_damping_s": "1e-5"}  # damping as in the examples
LOW_PASS = 8.8  # cutoff frequency times D0 / v: 100 Hz for the base
CLOTHS = {"100": {}, "3": {"parachute.canopy_material": "f-111-physical"}}  # CFM: changed keys; the cases have 100 CFM
DRAG_COEFFICIENT = 0.8  # of the handbook methods: that of the infinite-mass load
METHODS = {"Pflanz": "", "Ludtke": "8 3", "momentum-impulse": "2 3"}  # dashes of their lines
COLOURS, HANDBOOK = {"100": "#0072B2", "3": "#D55E00"}, "#555"  # Okabe and Ito (2008)
MISSING = "not computed"
LINES_FIRST = {"deployment.order": "lines-first"}


def size(diameter, kilograms, gores=12, lines="nylon-line-type-ii", tape="nylon-tape-200-lbf"):
    """Changed keys of a canopy of this diameter: vent and length of the lines have the same share of it as in the base."""
    return {"parachute.nominal_diameter_m": f"{diameter:g}", "parachute.vent_diameter_m": f"{0.1 * diameter:g}",
            "parachute.gores": f"{gores}", "parachute.lines.count": f"{gores}", "parachute.lines.length_m": f"{diameter:g}",
            "parachute.lines.material": lines, "parachute.tape.material": tape, "payload.mass_kg": f"{kilograms:g}"}


def mass(kilograms):
    return {"payload.mass_kg": f"{kilograms:g}"}


def speed(metres):
    return {"flow.speed_m_s": f"{metres:g}"}


# name: (group, subject, changed keys, duration as a distance at the speed of deployment [D0]), for both cloths
BOTH = {
    "held": ("mass", "fixed in the stream", {"inflation.mass": "infinite"}, 3.6),
    "mass-150": ("mass", "150 kg", mass(150), 3.6),
    "mass-40": ("mass", "40 kg", mass(40), 3.6),
    "mass-10": ("mass", "10 kg", mass(10), 3.6),
    "base": ("mass", "2.4 kg", {}, 4.6),
    "mass-0.6": ("mass", "0.6 kg", mass(0.6), 7.0),
    "speed-15": ("speed", "15 m/s", speed(15), 4.6),
    "speed-40": ("speed", "40 m/s", speed(40), 4.6),
    "speed-80": ("speed", "80 m/s", speed(80), 6.5),
    "size-1": ("size", "1 m", size(1, 0.32), 4.6),
    "size-3": ("size", "3 m", size(3, 13.1), 4.6),
    "size-10": ("size", "10 m", size(10, 509, 24, "nylon-line-type-iii", "nylon-tape-1000-lbf"), 6.5),
}
LONGER = {"size-3-100": 6.5}  # durations of single rows that had not filled [D0]
# name: (case, cloth CFM, group, subject, changed keys, duration as a distance at the speed of deployment [D0])
ROWS = {"c-9": (C_9, "100", "handbook", "C-9 class, lines first", {"flow.speed_m_s": "60", **LINES_FIRST}, 5.5)}
ROWS.update({f"{name}-{cloth}": (FLAT, cloth, group, subject, {**keys, **changed}, LONGER.get(f"{name}-{cloth}", distance))
             for cloth, changed in CLOTHS.items() for name, (group, subject, keys, distance) in BOTH.items()})


# The container of the default strip force (1.6 N), and slower ones.
ROWS.update({f"{name}-3": (FLAT, "3", "container", subject, {**CLOTHS["3"], "deployment.container": "bag", **keys}, distance)
             for name, subject, keys, distance in (("bag", "bag", {}, 4.6), ("bag-7", "bag, strip force 7 N", {"deployment.strip_force_n": "7"}, 6.0),
                                                   ("bag-8", "bag, strip force 8 N", {"deployment.strip_force_n": "8"}, 7.5))})


def nominal(name):
    """Nominal diameter [m] and speed of deployment [m/s] of a row."""
    case, *_, keys, _ = ROWS[name]
    return float(keys.get("parachute.nominal_diameter_m", 8.5 if case == C_9 else DIAMETER)), float(keys.get("flow.speed_m_s", SPEED))


def keys_of(name):
    """All keys of a row that are set for its opening."""
    case, *_, keys, distance = ROWS[name]
    diameter, velocity = nominal(name)
    first = {**BASE, "flow.speed_m_s": f"{SPEED:g}", "payload.mass_kg": f"{100 if case == C_9 else MASS:g}"}
    first |= FLAT_BASE if case == FLAT else {}
    return {**first, **keys, "inflation.low_pass_hz": f"{LOW_PASS * velocity / diameter:.4g}",
            "inflation.duration_s": f"{distance * diameter / velocity:.4g}"}


def folder_of(options, name):
    return options.runs.resolve() / f"{name}-{ROWS[name][-1]:g}"


def result_of(options, name):
    """result.json of a row, whose opening runs or continues if it has not finished."""
    finished = folder_of(options, name) / "result.json"
    if not options.tables:
        return openings.run(options, ROWS[name][0], keys_of(name), folder_of(options, name))
    if not finished.exists():
        raise openings.Failed(MISSING)
    return json.loads(finished.read_text())


def handbook(options, name, *more, kilograms=None):
    """Result of `ripstop load` for a row, on a horizontal path and with the upper end of the handbook's drag coefficients."""
    keys = keys_of(name)
    parachute = {key: value for key, value in keys.items() if key.startswith("parachute.")}
    with tempfile.TemporaryDirectory() as folder:
        command = [str(options.ripstop.resolve()), "load", ROWS[name][0], "--mass", kilograms or keys["payload.mass_kg"],
                   "--speed", keys["flow.speed_m_s"], "--angle", "0", "--drag-coefficient", f"{DRAG_COEFFICIENT:g}", "--out", folder, *openings.keys_of(parachute), *more]
        subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
        return json.loads((pathlib.Path(folder) / "result.json").read_text())


def factors(loads):
    """X_1 of the handbook methods: load over infinite-mass load."""
    methods = {row["method"]: row["load_n"] for row in loads["stages"][0]["methods"]}
    return {method: load / methods["infinite mass"] for method, load in methods.items()}


def measures(options, name, result):
    """Quantities of a row, from the result of its opening and from the handbook."""
    folder, (diameter, velocity) = folder_of(options, name), nominal(name)
    loads = handbook(options, name)
    outside = None
    if result.get("deployment"):
        velocity = {phase["phase"]: phase for phase in result["deployment"]["phases"]}["canopy leaves the bag"]["payload_speed_m_s"]
    if "canopy_outside" in result:
        left = result.get("container_left_s")
        outside = number(velocity * left / diameter) if left else f"not outside ({100 * result['canopy_outside']:.0f} % at the end)"
    dynamic = loads["density_kg_m3"] / 2 * velocity ** 2
    found = {"mass_ratio": loads["stages"][0]["mass_ratio"], "peak": result["low_pass_peak_load_n"], "outside": outside,
             "held": keys_of(name)["inflation.mass"] == "infinite", "energy": 100 * result["energy_residual"], "usable": result["usable"],
             "strain": 100 * result["max_cloth_strain"], "parachute": 100 * loads["parachute_mass_kg"] / (
                 loads["parachute_mass_kg"] + loads["payload_mass_kg"]),
             "to_peak": openings.travelled(folder, velocity, result["low_pass_peak_time_s"]) / diameter, "handbook": factors(loads),
             "constant": loads["stages"][0]["filling_constant"],
             "half": openings.travelled(folder, velocity, openings.half_area_time(folder)) / diameter,
             "on_area": result["low_pass_peak_load_n"] / (dynamic * math.pi / 4 * diameter ** 2),
             "filled": result["filled"], "way": None, "nominal": None, "exponent": None, "with_computed": None}
    found["on_handbook"] = found["on_area"] / (DRAG_COEFFICIENT * loads["opening_coefficient"])
    if found["filled"]:
        found |= {"way": result["filling_distance_diameters"], "nominal": velocity * result["filling_time_s"] / diameter,
                  "exponent": result["area_growth_exponent"]}
        computed = ("--filling-constant", f"{found['nominal']:.4g}", "--filling-exponent", f"{found['exponent']:.4g}")
        found["with_computed"] = factors(handbook(options, name, *computed))["Pflanz"]
    return found


def held_of(name, done):
    """Row of the canopy with the same cloth that is fixed in the stream."""
    return done.get(f"held-{ROWS[name][1]}")


def held_on_page(name):
    """Peak over q S0 of the canopy that is fixed in the stream, of the present page."""
    label, cloth = ROWS["held-3"][3], ROWS[name][1]
    return next((float(row[HEAD.index("peak over q S0")]) for row in tables.rows_of("regimes") if row[:2] == [label, cloth]), None)


def factor(name, m, done):
    """X_1: peak over q S0, divided by that of the canopy that is fixed in the stream."""
    if m["held"] or ROWS[name][0] != FLAT:
        return None
    held = held_of(name, done)
    on_area = held["on_area"] if held else held_on_page(name)
    return m["on_area"] / on_area if on_area else None


def number(value, digits=2):
    return "" if value is None else f"{value:.{digits}f}"


def row_of(name, m, done):
    cloth, subject = ROWS[name][1], ROWS[name][3]
    methods = {} if m["held"] else m["handbook"]
    return [subject if m["usable"] else subject + " (must not be used)", cloth, "0" if m["held"] else f"{m['mass_ratio']:.2g}",
            number(m["way"]) if m["filled"] else "not filled", number(m["nominal"]), number(m["exponent"], 1), number(m["half"]), number(m["to_peak"]),
            number(m["peak"], 0), number(m["on_area"]), number(factor(name, m, done)), number(m["on_handbook"]),
            *(number(methods.get(method), 3) for method in ("Pflanz", "Ludtke", "momentum-impulse")),
            number(None if m["held"] else m["with_computed"]), number(m["strain"], 0), "" if m["held"] else number(m["parachute"], 0), number(m["energy"])]


HEAD = ["changed", "cloth CFM", "R_m", "filling distance / D0", "v t_f / D0", "area exponent j", "distance to half of the largest area / D0",
        "distance to the peak / D0", "peak N", "peak over q S0", "X_1", "peak over infinite-mass load of the handbook", "X_1 Pflanz", "X_1 Ludtke",
        "X_1 momentum-impulse", "X_1 Pflanz with computed t_f and j", "largest strain of the cloth %", "parachute, share of the mass %", "energy residual %"]


def of(done, group, cloth, value):
    """Points of one group and cloth where `value` of the measures exists, the base included; a canopy fixed in the stream is omitted."""
    named = {name: m for name, m in done.items() if ROWS[name][1] == cloth and not m["held"] and ROWS[name][0] == FLAT
             and (ROWS[name][2] == group or name.startswith("base"))}
    places = {"mass": lambda name, m: m["mass_ratio"], "speed": lambda name, m: nominal(name)[1], "size": lambda name, m: nominal(name)[0]}
    points = [(places[group](name, m), value(name, m)) for name, m in named.items()]
    return sorted(point for point in points if point[1] is not None)


def plot_mass(options, done):
    """Filling distance and X_1 over the mass ratio."""
    labels = {value: f"{value:g}" for value in (0.01, 0.1, 1, 10)}
    way = panels.Panel(0, "filling distance / D0", "mass ratio", (0.01, 10), labels, 10, 2)
    highest = max(factor(name, m, done) or 0 for name, m in done.items())
    load = panels.Panel(1, "X_1", "mass ratio", (0.01, 10), labels, 0.2 * math.ceil(max(highest, 1) / 0.2), 0.2)
    base = next(m for name, m in done.items() if name.startswith("base"))
    for value, words in ((8, "Knacke: 8"), (base["constant"], f"Berndt at 20 m/s: {base['constant']:.1f}")):
        way.line([(0.01, value), (10, value)], HANDBOOK, "6 3")
        way.words(0.012, value if value == 8 else value - 0.7, words, HANDBOOK)
    for cloth, colour in COLOURS.items():
        way.line(of(done, "mass", cloth, lambda name, m: m["way"]), colour)
        way.marks(of(done, "mass", cloth, lambda name, m: m["way"]), colour)
        way.marks(of(done, "mass", cloth, lambda name, m: m["nominal"]), colour, False)
        load.line(of(done, "mass", cloth, lambda name, m: factor(name, m, done)), colour)
        load.marks(of(done, "mass", cloth, lambda name, m: factor(name, m, done)), colour)
    masses = [0.1 * 10 ** (k / 8) for k in range(30)]
    curves = [handbook(options, "base-100", kilograms=f"{kilograms:.4g}") for kilograms in masses]
    for method, dashes in METHODS.items():
        load.line([(loads["stages"][0]["mass_ratio"], factors(loads)[method]) for loads in curves
                   if 0.01 <= loads["stages"][0]["mass_ratio"] <= 10], HANDBOOK, dashes)
    panels.write(ROOT / "docs/tables/regimes-mass.svg", [way, load], [
        *((colour, "", "filled", f"computed, {cloth} CFM") for cloth, colour in COLOURS.items()),
        *((colour, "", "open", f"computed, {cloth} CFM: v t_f / D0") for cloth, colour in COLOURS.items()),
        *((HANDBOOK, dashes, "", method) for method, dashes in METHODS.items())])


def plot_load(done):
    """Peak over q S0, and filling distance, over speed and size."""
    title, labels = "peak over q S0, and filling distance / D0", lambda *values: {value: f"{value}" for value in values}
    highest = 0.5 * math.ceil(2 * max(max(m["on_area"], m["way"] or 0) for name, m in done.items() if not m["held"]))
    speeds = panels.Panel(0, title, "speed, m/s", (10, 100), labels(10, 20, 40, 80), highest, 0.5)
    sizes = panels.Panel(1, title, "nominal diameter, m", (0.8, 12), labels(1, 2, 5, 10), highest, 0.5)
    for cloth, colour in COLOURS.items():
        for panel, group in ((speeds, "speed"), (sizes, "size")):
            for key, filled, dashes in (("on_area", True, ""), ("way", False, "2 3")):
                points = of(done, group, cloth, lambda name, m, key=key: m[key])
                panel.line(points, colour, dashes)
                panel.marks(points, colour, filled)
    panels.write(ROOT / "docs/tables/regimes-load.svg", [speeds, sizes], [
        *((colour, "", "filled", f"peak over q S0, {cloth} CFM") for cloth, colour in COLOURS.items()),
        *((colour, "2 3", "open", f"filling distance / D0, {cloth} CFM") for cloth, colour in COLOURS.items())])


def deployed_rows(done):
    return [[ROWS[name][3], ROWS[name][1], m["outside"], number(m["way"]) if m["filled"] else "not filled", number(m["nominal"]), number(m["constant"]),
             number(m["on_area"])] for name, m in done.items() if m["outside"] is not None]


def deployed_table(done):
    """Filling distances from line stretch of the rows with a container, and the time until the canopy has left it."""
    return tables.table(["container", "cloth CFM", "v t / D0 until the canopy is outside", "filling distance / D0", "v t_f / D0", "n of the handbook",
                         "peak over q S0"], deployed_rows(done))


def without_result(failures):
    missing = [f"{ROWS[name][3]} ({ROWS[name][1]} CFM)" for name, reason in failures.items() if reason == MISSING]
    failed = [f"{ROWS[name][3]} ({ROWS[name][1]} CFM) failed, {reason}." for name, reason in failures.items() if reason != MISSING]
    return ([f"Not computed: {', '.join(missing)}.", ""] if missing else []) + ([" ".join(failed), ""] if failed else [])


def write(options, done, failures):
    base = [m for name, m in done.items() if name.startswith("base")][0]
    made = [run for name in done for run in tables.runs_below(folder_of(options, name))]
    lines = [
        f"Coupled openings of flat circular canopies from the closed mouth, on the default 80 x 80 x 98 cells with 2,500 cloth nodes "
        "([description](../validation/inflation.md#regimes)). If no other value is stated, the canopy has 1.76 m, 12 gores and 2.4 kg "
        "at 20 m/s. The path is horizontal at the start. A single peak scatters by 10 % (two standard deviations).", "",
        *tables.table(HEAD, [row_of(name, m, done) for name, m in done.items()]),
        *without_result(failures),
        "D0: nominal diameter. 100 CFM: mil-c-7020-type-i; 3 CFM: f-111-physical. R_m: mass ratio of `ripstop load` with the mass of "
        "payload and parachute; 0: fixed in the stream. Distances are those of the payload through the air from the start of the coupled "
        "opening. Filling distance: until the projected area first reaches its mean over the last fifth. v t_f / D0: filling time times "
        "the speed at the start. Peak: low-passed at 8.8 v / D0 (100 Hz at 20 m/s and 1.76 m). X_1: peak over q S0, divided by that of the "
        "canopy of 1.76 m of the same cloth that is fixed in the stream at 20 m/s. "
        f"Handbook: C_D {DRAG_COEFFICIENT:g}, `ripstop load --angle 0`, load over infinite-mass load; its filling distance is "
        f"{base['constant']:.2f} D0 at 20 m/s. Computed t_f and j: `ripstop load` with `--filling-constant` v t_f / D0 and `--filling-exponent` j of that opening.", "",
        "Rows with a container: the canopy opens while it [leaves it](../theory/deployment.md#coupled-opening); distances are from line "
        "stretch, with the speed v there. The handbook defines n with v t_f.", "",
        *deployed_table(done),
        "![Filling distance and X_1 over the mass ratio](regimes-mass.svg)", "",
        "![Peak and filling distance over speed and size](regimes-load.svg)"]
    tables.write("regimes", "Regimes of an opening", "make validate-regimes", made, lines)
    plot_mass(options, done)
    plot_load(done)


def main():
    parser = openings.arguments(__doc__, "regimes", ROWS)
    parser.add_argument("--tables", action="store_true", help="run nothing, and write page and plots of the finished rows")
    options = parser.parse_args()
    done, failures = {}, {}
    for name in options.rows.split(","):
        try:
            done[name] = measures(options, name, result_of(options, name))
        except openings.Failed as failed:
            failures[name] = str(failed)
    print("\n".join(tables.table(HEAD, [row_of(name, m, done) for name, m in done.items()])), failures)
    if options.tables or {*done, *failures} == set(ROWS):
        write(options, done, failures)
    elif not failures:
        tables.replace_rows("regimes", [row_of(name, m, done) for name, m in done.items()] + deployed_rows(done), 2)
        print("replaced in docs/tables/regimes.md; the first line of the page and the plots are unchanged")


if __name__ == "__main__":
    main()
