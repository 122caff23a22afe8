#!/usr/bin/env python3
"""Sizes parachutes for 1,000 combinations of payload mass, descent rate, height and family with `ripstop size`.

Each run must find a parachute whose drag equals the weight of payload and parachute, or refuse the request with exit
code 2 and a known message. The script computes the balance with its own model of the atmosphere. It writes
docs/tables/size-grid.md: outcomes, processor time and memory. The exit code is 1 if a run fails or exceeds a limit.

    make test-sizes
"""

import argparse
import collections
import itertools
import json
import math
import pathlib
import os
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import tables  # pylint: disable=wrong-import-position

GRAVITY = 9.80665
MASSES = [0.001, 0.01, 0.1, 0.5, 2.4, 20, 150, 1e3, 1e4, 1e5]  # kg
RATES = [0.1, 0.5, 1, 2, 4, 6, 10, 20, 50, 100]  # m/s
HEIGHTS = [0, 3000, 12000, 30000, 80000]  # m
FAMILIES = [row["family"] for row in json.loads((tables.ROOT / "examples/families.json").read_text())["families"]]
LAYERS = [(0, 288.15, -0.0065), (11000, 216.65, 0.0), (20000, 216.65, 0.001), (32000, 228.65, 0.0028), (47000, 270.65, 0.0),
          (51000, 270.65, -0.0028), (71000, 214.65, -0.002)]


def density(height):
    """U.S. Standard Atmosphere, 1976 [kg/m3]."""
    gas, level, pressure = 287.053, 6356766 * height / (6356766 + height), 101325.0
    for index, (bottom, temperature, lapse) in enumerate(LAYERS):
        top = LAYERS[index + 1][0] if index + 1 < len(LAYERS) else math.inf
        rise = min(level, top) - bottom
        warmer = temperature + lapse * rise
        pressure *= (temperature / warmer) ** (GRAVITY / (gas * lapse)) if lapse else math.exp(-GRAVITY * rise / (gas * temperature))
        if level <= top:
            return pressure / (gas * warmer)
    raise ValueError(height)


def balance(result, mass, rate, height):
    """Ratio of drag to weight of the parachute."""
    drag = 0.5 * density(height) * rate**2 * result["drag_coefficient"] * math.pi / 4 * result["nominal_diameter_m"] ** 2
    return drag / ((mass + result["parachute_mass_kg"]) * GRAVITY)


def measured(command):
    """Exit code, standard output, standard error, processor time [s] and largest memory [MB] of a command."""
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen(command, stdout=out, stderr=err)  # pylint: disable=consider-using-with
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0), err.seek(0)
        return process.returncode, out.read(), err.read(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


REFUSALS = {"this cloth": "refused: the cloth alone descends faster", "larger parachute": "refused: larger than a case file describes",
            "smaller parachute": "refused: smaller than a case file describes"}


def combinations():
    """Every mass, rate and height with two of the families, which alternate."""
    for (i, mass), (j, rate), (k, height) in itertools.product(*map(enumerate, (MASSES, RATES, HEIGHTS))):
        for other in (0, len(FAMILIES) // 2):
            yield mass, rate, height, FAMILIES[(i + j + k + other) % len(FAMILIES)]


def run(options, folder, mass, rate, height, family):
    """Outcome, processor time [s] and memory [MB] of a combination."""
    code, out, err, seconds, megabytes = measured(
        [str(options.ripstop), "size", "--mass", str(mass), "--descent-rate", str(rate), "--height", str(height), "--family", family, "--json", "--force",
         "--out", str(folder / "case.toml")])
    if code == 2 and err.strip():
        return next((name for text, name in REFUSALS.items() if text in err), "FAILED: refused with " + err[:200]), seconds, megabytes
    if code != 0:
        return f"FAILED with {code}: {err[:200]}", seconds, megabytes
    result = json.loads(out)
    share = balance(result, mass, rate, height)
    if abs(share - 1) >= 3e-3:
        return f"FAILED: drag is {share:.3f} of the weight", seconds, megabytes
    if (result["line_used"] > 1 or result["tape_used"] > 1) and "exceeds its allowable load" not in err:
        return "FAILED: a load exceeds the allowable one, without a warning", seconds, megabytes
    return "found" if "exceeds its allowable load" not in err else "found, with the warning that a load exceeds the allowable one", seconds, megabytes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=pathlib.Path("build/bin/ripstop"))
    parser.add_argument("--seconds", type=float, default=0.1, help="most processor time of a run")
    parser.add_argument("--megabytes", type=float, default=200, help="most memory of a run")
    options = parser.parse_args()
    outcomes, times, memory, wrong = collections.Counter(), [], [], []
    with tempfile.TemporaryDirectory() as name:
        for mass, rate, height, family in combinations():
            outcome, seconds, megabytes = run(options, pathlib.Path(name), mass, rate, height, family)
            label = f"{mass:g} kg, {rate:g} m/s, {height} m, {family}"
            outcomes[outcome] += 1
            times.append((seconds, label))
            memory.append(megabytes)
            if outcome.startswith("FAILED"):
                wrong.append(f"{label}: {outcome}")
    slow = [time for time in times if time[0] > options.seconds]
    slowest = max(times)
    lines = [f"`ripstop size` computes {len(times):,} combinations of payload mass ({MASSES[0]:g} kg to {MASSES[-1] / 1000:g} t), "
             f"descent rate ({RATES[0]:g} to {RATES[-1]:g} m/s), "
             f"height ({HEIGHTS[0]} to {HEIGHTS[-1] // 1000} km) and family ({', '.join(FAMILIES)}). A combination without a solution must be refused. "
             "Drag and weight of each parachute that is found agree within 0.3 %; "
             "the script computes both with its own model of the atmosphere.", "",
             *tables.table(["outcome", "combinations"], [[outcome, str(count)] for outcome, count in outcomes.most_common()]),
             f"Processor time: median {1000 * statistics.median(time[0] for time in times):.0f} ms, largest {1000 * slowest[0]:.0f} ms ({slowest[1]}); "
             f"{len(slow)} runs above the limit of {1000 * options.seconds:g} ms. Largest memory of a run {max(memory):.0f} MB."]
    tables.write("size-grid", "Parachute sizes over mass, descent rate, height and family", "make test-sizes",
                 tables.here(), lines)
    print("\n".join(lines + wrong + [f"slow: {seconds:.3f} s, {label}" for seconds, label in slow]))
    return 1 if wrong or slow or max(memory) > options.megabytes else 0


if __name__ == "__main__":
    sys.exit(main())
