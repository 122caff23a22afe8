"""A small case made in Python, the program, and functions that the tests of the package share."""
import os
import pathlib
import subprocess
import sys

import ripstop

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ["RIPSTOP_BUILD"])
PROGRAM = os.environ["RIPSTOP_PROGRAM"]
STRATOS = SOURCE / "examples/stratos-iv/case.toml"

TABLES = {
    "title": "A canopy made in code",
    "parachute": {"type": "flat-circular", "nominal_diameter_m": 1.0, "vent_diameter_m": 0.1, "gores": 12, "canopy_material": "f-111",
                  "lines": {"count": 12, "length_m": 1.0}, "mesh": {"cloth_nodes": 500}},
    "flow": {"speed_m_s": 20, "density_kg_m3": 1.2, "cells": [20, 20, 30]},
    "coupling": {"threads": 1},
    "inflation": {"initial_radius_m": 0.1, "duration_s": 0.01},
}


def case(**keys):
    made = ripstop.Case.from_dict(TABLES)
    made.update({key.replace("__", "."): value for key, value in keys.items()})
    return made


def opening_case():
    return ripstop.read_case(STRATOS, set={"parachute.mesh.cloth_nodes": 500, "inflation.duration_s": 0.02, "coupling.threads": 1})


def program(*arguments):
    """Exit code, standard output and error message."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def python(*arguments, **options):
    return subprocess.run([sys.executable, *map(str, arguments)], capture_output=True, text=True, check=False, **options)
