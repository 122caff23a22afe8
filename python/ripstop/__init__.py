"""Prediction of the inflated shape, drag, stresses and opening loads of parachutes.

    import ripstop

    case = ripstop.Case.read("case.toml", set={"flow.speed_m_s": 20})
    run = ripstop.steady(case, progress=lambda i: print(i.iteration, i.drag_n))
    print(run.drag_n, run.shape)

The functions correspond to commands of the program: check, steady, stability, inflate, fly, fabric, sweep, materials, fit,
pattern, size, load, descent, recovery, calibrate_damping, export, report. fastest_deployment is load --fastest. `add_engine` adds a flow engine written in Python,
and `Mesh` is a canopy that is put together in Python.
Results have the members of result.json as attributes, whose names end with the unit, and arrays that are views of
memory of the library. Every failure raises Error with the message of the program.
"""

import os
import pathlib

from . import _notebook, _ripstop
from ._ripstop import *  # noqa: F403 - all that the stub of _ripstop lists
from ._ripstop import __version__

__all__ = [name for name in dir(_ripstop) if not name.startswith("_")]


def _restored_case(*state):
    """A case from its pickle."""
    return _ripstop.Case._restored(*state)


_notebook.add_to(_ripstop)

# A wheel contains materials and examples; an installed or built library finds its own.
_data = pathlib.Path(__file__).parent / "data"
if _data.is_dir():
    os.environ.setdefault("RIPSTOP_DATA", str(_data))
del os, pathlib
