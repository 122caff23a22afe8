"""Coupled openings of the studies of this folder: runs them, and reads histories from their run folders."""
import argparse
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
UNUSABLE = 4  # exit code of a run that has a result with a caution


class Failed(Exception):
    """A run that failed or was refused, with the reason that the program gives."""


def arguments(description, name, rows):
    """Parser with the options of every study; its runs are below runs/`name`."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=ROOT / "build/bin/ripstop")
    parser.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs" / name)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rows", default=",".join(rows), help="names of rows, comma-separated")
    return parser


def keys_of(keys):
    """Options of ripstop that set these keys of a case."""
    return [option for key, value in keys.items() for option in ("--set", f"{key}={value}")]


def run(options, case, keys, folder, *more):
    """Result of one opening, or with "--samples", "N" of N of them, which run or continue. Throws Failed."""
    command = [str(options.ripstop.resolve()), "inflate", case, "--air", "coupled", "--out", str(folder),
               "--threads", str(options.threads), *more, *keys_of(keys)]
    print("$ ripstop " + " ".join(command[1:]), flush=True)
    done = subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    print(done.stderr, end="", file=sys.stderr, flush=True)
    if done.returncode not in (0, UNUSABLE):
        reasons = [line.removeprefix("ripstop: ") for line in done.stderr.splitlines() if line.startswith("ripstop: ")]
        raise Failed(f"exit code {done.returncode}: {reasons[-1] if reasons else 'no message'}")
    return json.loads((folder / "result.json").read_text())


def columns(folder, name):
    with open(folder / name, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: [float(row[key]) for row in rows] for key in rows[0]}


def travelled(folder, speed, time):
    """Distance of the payload through the air until `time` [m]."""
    air = columns(folder, "air.csv")
    if not any(air["path_m"]):
        return speed * time
    return next((path for t, path in zip(air["time_s"], air["path_m"]) if t >= time), air["path_m"][-1])


def half_area_time(folder):
    """Time at which the projected area reaches half of its largest value [s]."""
    balance = columns(folder, "balance.csv")
    widest = max(balance["projected_area_m2"])
    return next(t for t, a in zip(balance["time_s"], balance["projected_area_m2"]) if a >= 0.5 * widest)
