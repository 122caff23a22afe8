#!/usr/bin/env python3
"""Sizes 1,000 combinations of payload mass, descent rate, height and family with `ripstop size`.

Each one has to end in a parachute whose drag equals the weight of payload and parachute, or in a refusal with exit code
2 and a message. The balance is computed here, with an atmosphere of its own. Prints a table of the outcomes, the
slowest run and the largest memory; exit status 1 where a run is wrong, takes more than --seconds or more than --megabytes.

    python3 validation/reliability/size_grid.py --ripstop build/bin/ripstop
"""

import argparse
import collections
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

GRAVITY = 9.80665
MASSES = [0.001, 0.01, 0.1, 0.5, 2.4, 20, 150, 1e3, 1e4, 1e5]  # kg
RATES = [0.1, 0.5, 1, 2, 4, 6, 10, 20, 50, 100]  # m/s
HEIGHTS = [0, 3000, 12000, 30000, 80000]  # m
FAMILIES = ["flat-circular", "cross"]
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
    """Drag over weight of the parachute that was found."""
    drag = 0.5 * density(height) * rate**2 * result["drag_coefficient"] * math.pi / 4 * result["nominal_diameter_m"] ** 2
    return drag / ((mass + result["parachute_mass_kg"]) * GRAVITY)


def run(options, folder, mass, rate, height, family):
    command = [str(options.ripstop), "size", "--mass", str(mass), "--descent-rate", str(rate), "--height", str(height), "--family", family,
               "--json", "--force", "--out", str(folder / "case.toml")]
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    seconds = time.monotonic() - begin
    if done.returncode == 2 and done.stderr.strip():
        return "refused: " + " ".join(word for word in done.stderr.split(":")[1].split() if not any(c.isdigit() for c in word))[:60], seconds
    if done.returncode != 0:
        return f"FAILED with {done.returncode}: {done.stderr[:200]}", seconds
    share = balance(json.loads(done.stdout), mass, rate, height)
    return ("found" if abs(share - 1) < 3e-3 else f"FAILED: drag is {share:.3f} of the weight"), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=pathlib.Path("build/bin/ripstop"))
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--megabytes", type=float, default=200)
    options = parser.parse_args()
    outcomes, slowest, wrong = collections.Counter(), (0.0, None), []
    with tempfile.TemporaryDirectory() as name:
        for mass in MASSES:
            for rate in RATES:
                for height in HEIGHTS:
                    for family in FAMILIES:
                        outcome, seconds = run(options, pathlib.Path(name), mass, rate, height, family)
                        outcomes[outcome.split(";")[0]] += 1
                        slowest = max(slowest, (seconds, f"{mass:g} kg, {rate:g} m/s, {height} m, {family}"))
                        if outcome.startswith("FAILED"):
                            wrong.append(f"{mass:g} kg, {rate:g} m/s, {height} m, {family}: {outcome}")
    for outcome, count in outcomes.most_common():
        print(f"{count:5d}  {outcome}")
    megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"slowest {slowest[0]:.3f} s ({slowest[1]}), largest memory {megabytes:.0f} MB")
    print("\n".join(wrong))
    return 1 if wrong or slowest[0] > options.seconds or megabytes > options.megabytes else 0


if __name__ == "__main__":
    sys.exit(main())
