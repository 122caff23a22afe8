"""The trials of torture.py with several processes, with a clock that moves backward, and with replacements of OpenFOAM."""
import os
import shutil
import signal
import stat
import subprocess
import time

import trial

SOLVER = "rhoPorousSimpleFoam"
REAL = shutil.which(SOLVER)
FOAM_CODE = 6

# Replacements of the solver from its n-th run on, which still print its version. {real} is the solver, {n} counts its runs.
STAND_INS = {
    "killed": "kill -9 $$",
    "killed while it writes": '"{real}" "$@" & sleep 0.3; kill -9 $!; wait $!; kill -9 $$',
    "without fields": "exit 0",
    "without fields after all its output": '"{real}" "$@"; code=$?; ls -d [1-9]* processor*/[1-9]* 2>/dev/null | xargs rm -rf; exit $code',
    "out of memory": 'ulimit -v 30000; exec "{real}" "$@"',
    "says that an allocation failed": "echo 'terminate called after throwing an instance of '; echo std::bad_alloc; exit 134",
    "with cut fields": '"{real}" "$@"; code=$?; for f in [1-9]*/U; do head -c 300 "$f" > "$f.cut"; mv "$f.cut" "$f"; done; exit $code',
    "with a field that is not a number": '"{real}" "$@"; code=$?; for f in [1-9]*/p; do sed -i "30s/.*/nan/" "$f"; done; exit $code',
    "of a different version": "",
}


def stand_in(folder, kind, first):
    """A folder for the beginning of PATH."""
    folder.mkdir()
    script = folder / SOLVER
    counter = folder / "runs"
    if kind == "of a different version":
        script.write_text("#!/bin/sh\necho 'Using: OpenFOAM-10 (see https://openfoam.org)'\n")
    else:
        body = STAND_INS[kind].format(real=REAL, n="$n")
        script.write_text(f'#!/bin/sh\nif [ "$1" = -help ]; then exec "{REAL}" -help; fi\n'
                          f'echo x >> {counter}; n=$(wc -l < {counter})\nif [ "$n" -lt {first} ]; then exec "{REAL}" "$@"; fi\n{body}\n')
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    return {"PATH": f"{folder}:{os.environ['PATH']}"}


def openfoam_fails(bench, kind, first):
    """The run reports it, and the same command with the real program gives the undisturbed folder."""
    root = bench.folder("trial")
    whole, wanted, _, _ = bench.undisturbed("openfoam")
    code, _, err = bench.run(bench.command("openfoam", root / "out"), **stand_in(root / "bin", kind, first))
    said = trial.last_line(err)
    if code not in (FOAM_CODE, 3, 5, 7):
        return {"ok": False, "said": f"exit code {code}: {said}"}
    again, _, err = bench.run(bench.command("openfoam", root / "out"))
    unlike = trial.differences(root / "out", whole) if again == wanted else ["all"]
    return {"ok": not unlike, "said": f"{code}: {said}" if not unlike else f"again: {again}, differ: {', '.join(unlike[:8])}; {trial.last_line(err)}"}


def openfoam_hangs(bench, stop):
    """Stopped while OpenFOAM hangs: all its child processes end, and the same command continues."""
    root = bench.folder("trial")
    whole, wanted, _, _ = bench.undisturbed("openfoam")
    mark = root / "hangs"
    path = stand_in(root / "bin", "killed", 2)
    script = root / "bin" / SOLVER
    script.write_text(script.read_text().replace("kill -9 $$", f"echo $$ > {mark}.new; mv {mark}.new {mark}; exec sleep 1000"))
    child = bench.start(bench.command("openfoam", root / "out"), **path)
    while not mark.exists() and child.poll() is None:
        time.sleep(0.02)
    child.send_signal(stop)
    try:
        child.communicate(timeout=trial.LIMIT_S)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        return {"ok": False, "said": f"still running {trial.LIMIT_S} s after {stop.name}"}
    process = int(mark.read_text())
    for _ in range(400):  # the process group ends within five seconds
        if not alive(process):
            break
        time.sleep(0.02)
    else:
        os.kill(process, signal.SIGKILL)
        return {"ok": False, "said": "the solver outlived the program"}
    code, _, err = bench.run(bench.command("openfoam", root / "out"))
    unlike = trial.differences(root / "out", whole) if code == wanted else ["all"]
    return {"ok": not unlike, "said": f"again: {code}, differ: {', '.join(unlike[:8])}; {trial.last_line(err)}" if unlike else ""}


def alive(process):
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def two_at_once(bench, name, after):
    """One process computes; the other displays the run, or reports which process uses the folder."""
    root = bench.folder("trial")
    whole, wanted, seconds, _ = bench.undisturbed(name)
    first = bench.start(bench.command(name, root / "out"), trial.FASTER.get(name, {}))
    time.sleep(after * seconds)
    second = bench.start(bench.command(name, root / "out"), trial.FASTER.get(name, {}))
    ends = [(child.communicate(timeout=trial.LIMIT_S)[1], child.returncode) for child in (first, second)]
    codes = [code for _, code in ends]
    refused = [err for err, code in ends if code == 2]
    if wanted not in codes or any(code not in (wanted, 2) for code in codes):
        return {"ok": False, "said": f"exit codes {codes}: {trial.last_line(ends[0][0])}; {trial.last_line(ends[1][0])}"}
    if any("process " not in err for err in refused):
        return {"ok": False, "said": f"does not say who: {trial.last_line(refused[0])}"}
    unlike = trial.differences(root / "out", whole)
    return {"ok": not unlike, "said": "differ: " + ", ".join(unlike[:8]) if unlike else "", "refused": len(refused)}


def clock_goes_back(bench, name, seconds, share):
    """The run is killed in the middle and continued with a clock that moves back by 24 hours at each reading."""
    root = bench.folder("trial")
    whole, wanted, lasts, calls = bench.undisturbed(name)
    back = {**trial.FASTER.get(name, {}), "TORTURE_BACK": str(seconds)}
    if share:
        at = str(int(share * len(calls)))
        bench.run(bench.command(name, root / "out"), {**back, "TORTURE_ROOT": str(root / "out"), "TORTURE_AT": at, "TORTURE_DO": "kill"})
    code, _, err = bench.run(bench.command(name, root / "out"), back)
    unlike = trial.differences(root / "out", whole) if code == wanted else ["all"]
    return {"ok": not unlike, "said": f"exit code {code}, differ: {', '.join(unlike[:8])}; {trial.last_line(err)}" if unlike else ""}


def trials(bench, rng):
    listed = []
    for name in ("steady", "inflate", "sweep", "damping", "openfoam"):
        listed += [(f"two {name} {after}", name, two_at_once, (name, after)) for after in (0, 0.02, 0.1, 0.3, 0.6, 0.9)]
    for name in ("steady", "inflate", "sweep"):
        listed += [(f"clock back {name} {s} s, killed at {share}", name, clock_goes_back, (name, s, share)) for s in (1, 86400) for share in (0, 0.3, 0.8)]
    for kind in STAND_INS:
        listed += [(f"openfoam {kind} from run {first}", "openfoam", openfoam_fails, (kind, first)) for first in (1, 2)]
    listed += [(f"openfoam hangs, {stop.name}", "openfoam", openfoam_hangs, (stop,)) for stop in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)]
    rng.shuffle(listed)
    return listed
