"""Common parts of the trials of torture.py: tiny cases, a run of the program with a fault, and the comparison of folders."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIMIT_S = 300  # of one run of the program, which takes a few seconds

CASE = """title = "Torture"
[parachute]
type = "flat-circular"
nominal_diameter_m = 1.0
vent_diameter_m = 0.1
gores = 12
lines = { count = 12, length_m = 1.0 }
[parachute.mesh]
cloth_nodes = 500
folds = 12
line_segment_m = 0.2
[flow]
speed_m_s = 20
density_kg_m3 = 1.2
cells = [20, 20, 24]
residual = 1e-2
max_iterations = 60
[coupling]
threads = 1
load = "uniform"
cloth_tolerance = 1e-3
drag_tolerance = 0.1
shape_tolerance_m = 0.05
max_iterations = 5
[inflation]
duration_s = 0.006
frames = 6
pressure_pa = 200
initial_radius_m = 0.2
measured_peak_n = 125
"""
MEASURED = "speed_m_s,density_kg_m3,drag_n\n20,1.2,104\n"
BENCH = ROOT / "examples/fit-ripstop/bench.toml"

# name -> arguments, with {case}, {measured} and {bench} for files; --out comes after them.
COMMANDS = {
    "steady": "steady {case}",
    "inflate": "inflate {case}",
    "sweep": "sweep {case} --speeds 20,22 --jobs 1",
    "sweep-2": "sweep {case} --speeds 20,22,24 --jobs 2",
    "damping": "calibrate damping {case} --points 3 --refinements 1",
    "porosity": "calibrate porosity {case} --measured {measured} --gammas 0.2,0.24 --shifts 1 --jobs 1",
    "openfoam": "steady {case} --flow openfoam --set parachute.canopy_material=f-111 --set flow.residual=1e-1 --set coupling.max_iterations=3",
    "fabric": "fabric {case} --pressure 200",
    "coupon": "coupon f-111 --points 2 --cells 4 --threads 1",
    "fit": "fit {bench} --no-coupons --threads 1",
}
# Two threads write files in any order, so that the n-th write is not always the same one.
IN_ORDER = [name for name in COMMANDS if name != "sweep-2"]
# Every frame of an opening shall be a checkpoint: its ten seconds pass in a millisecond.
FASTER = {"inflate": {"TORTURE_FASTER": "10000"}}
NOT_CONVERGED = 4  # the exit code of an opening as short as this one


class Bench:
    """Folder and program of the trials."""

    def __init__(self, program, work):
        self.program, self.work = program.resolve(), work.resolve()
        self.work.mkdir(parents=True, exist_ok=True)
        self.case, self.measured = self.work / "case.toml", self.work / "measured.csv"
        self.case.write_text(CASE)
        self.measured.write_text(MEASURED)
        self.preload = self.work / "interpose.so"
        source = pathlib.Path(__file__).parent / "interpose.c"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", self.preload, source, "-ldl"], check=True)
        own = [source, *sorted(source.parent.glob("*.py"))]
        self.hash = hashlib.sha256(b"".join(path.read_bytes() for path in [self.program, *own])).hexdigest()[:12]
        self.known, self.lock = {}, threading.RLock()  # made once, by the first lane that needs it

    def folder(self, name):
        """A new, empty folder; "trial" differs between lanes."""
        path = self.work / (f"{name}-{threading.current_thread().name}" if name == "trial" else name)
        shutil.rmtree(path, ignore_errors=True)
        path.mkdir(parents=True)
        return path

    def command(self, name, out, more=()):
        words = COMMANDS[name].format(case=self.case, measured=self.measured, bench=BENCH).split()
        return [str(self.program), *words, *more, "--out", str(out)]

    def environment(self, preloaded=None, **more):
        # Pages of two megabytes: pictures and fields are new memory in every one of the short runs.
        env = {**os.environ, "RIPSTOP_DATA": str(ROOT), "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1", **more}
        if preloaded is not None:
            env |= {"LD_PRELOAD": str(self.preload), **preloaded}
        return env

    def start(self, arguments, preloaded=None, **more):
        return subprocess.Popen(arguments, env=self.environment(preloaded, **more), cwd=self.work, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True)

    def run(self, arguments, preloaded=None, **more):
        """Exit code (negative: signal), standard output, standard error."""
        child = self.start(arguments, preloaded, **more)
        try:
            out, err = child.communicate(timeout=LIMIT_S)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            out, err = child.communicate()
            err += f"\nstill running after {LIMIT_S} s"
        return child.returncode, out, err

    def undisturbed(self, name):
        """(folder, exit code, seconds, counted calls) of the undisturbed run; made once."""
        with self.lock:
            return self.undisturbed_alone(name)

    def undisturbed_alone(self, name):
        if name not in self.known:
            root = self.folder(f"whole-{name}")
            log = root / "calls"
            begin = time.monotonic()
            code, _, err = self.run(self.command(name, root / "out"), {**FASTER.get(name, {}), "TORTURE_ROOT": str(root / "out"), "TORTURE_LOG": str(log)})
            seconds = time.monotonic() - begin
            if code not in (0, NOT_CONVERGED):
                raise SystemExit(f"{name}: the undisturbed run ends with {code}: {err[-500:]}")
            calls = [line.split(" ", 2)[1:] for line in log.read_text().splitlines()]
            self.known[name] = (root / "out", code, seconds, calls)
        return self.known[name]


# Wall times, the time of day, and values derived from them: hashes, random words, the process number. OpenFOAM repeats its
# record of iterations in its own case at every start.
IGNORED = re.compile(r"^(.*/)?\.ripstop/(lock|seal|started)$|^(.*/)?checkpoint/(odd|even)/state$|^wall_time\.(svg|png)$|^(.*/)?flow/(log\.|postProcessing/)|^calls$")
TIMES = [(re.compile(rb'"(wall_time_s|seconds)": [-+0-9.e]+'), rb'"\1": 0'), (re.compile(rb'"started": "[^"]*"'), b'"started": ""')]
TIMES_OF_REPORT = [(re.compile(rb'("text":"wall time","unit":"s","value":)[-+0-9.e]+'), rb"\1"), (re.compile(rb'\["wall time","s",[^\]]*\]'), b"[]"),
                   (re.compile(rb'\["started","[^"]*"\]'), b"[]"), (re.compile(rb"nonce(=\"|-)[0-9a-f]{32}"), b"nonce")]


# Cairo numbers the parts of an SVG from the beginning of the process on.
NUMBERED = re.compile(rb"\b(surface|source|image|mask|clip|glyph|pattern|linear|radial|group|compositing-group|filter)-?[0-9]+(-[0-9]+)*\b")


def columns_without_time(text):
    rows = [line.split(",") for line in text.decode().splitlines()]
    if not rows or "wall_time_s" not in rows[0]:
        return text
    at = rows[0].index("wall_time_s")
    return "\n".join(",".join(row[:at] + row[at + 1:]) for row in rows).encode()


def contents(folder):
    """name -> bytes without times, of every file below it."""
    found = {}
    for path in sorted(pathlib.Path(folder).rglob("*")):
        name = str(path.relative_to(folder))
        if not path.is_file() or IGNORED.match(name):
            continue
        text = path.read_bytes()
        if name.endswith(".ripstop/files"):  # in any order
            text = b"\n".join(sorted(text.splitlines()))
        if name.endswith(".csv"):
            text = columns_without_time(text)
        if name.endswith(".svg"):
            text = NUMBERED.sub(rb"\1", text)
        for pattern, plain in TIMES if name.endswith(".json") else TIMES_OF_REPORT if name.endswith(".html") else []:
            text = pattern.sub(plain, text)
        found[name] = text
    return found


def differences(folder, whole, but=lambda name: False):
    """Names of files that differ, or that only one of both folders has."""
    one, other = contents(folder), contents(whole)
    unlike = [name for name in one.keys() | other.keys() if one.get(name) != other.get(name) and not but(name)]
    return sorted(unlike, key=lambda name: (not name.endswith((".csv", ".json", ".toml")), name))  # numbers first


def last_line(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1][:300] if lines else ""


class Log:
    """Finished trials, a JSON line each; the last line of a trial counts."""

    def __init__(self, path, program):
        self.path, self.program, self.done = path, program, {}
        if path.exists():
            for line in path.read_text().splitlines():
                try:
                    row = json.loads(line)
                    self.done[row["trial"]] = row
                except ValueError:  # the last line of a campaign that was killed
                    pass

    def wants(self, trial):
        """A failed trial is repeated with another program."""
        row = self.done.get(trial)
        return row is None or (not row["ok"] and row["program"] != self.program)

    def add(self, row):
        row = {**row, "program": self.program}
        self.done[row["trial"]] = row
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
