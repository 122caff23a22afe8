#!/usr/bin/env python3
"""Submits scripts of `--batch slurm` to a Slurm of two nodes on this machine and compares them with the same commands run directly:
docs/tables/slurm.md."""
import argparse
import datetime
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest.mock

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "reliability")]
import localhost  # noqa: E402
import tables  # noqa: E402
import trial  # noqa: E402

# A name that does harm where it is not quoted. OpenFOAM refuses such a folder.
HOSTILE = "it's $(touch harm) `touch harm` #1 %j \"; touch harm; é"
STEADY = ["steady", "{case}"]
OPENFOAM = [*trial.COMMANDS["openfoam"].split(), "--ranks", "2"]
SHEET = ["steady", "{case}", "--flow", "openfoam", "--ranks", "2"]
FITTED = [*SHEET, "--set", "flow.mesh=fitted", "--set", "flow.cloth_levels=1"]
SWEEP = ["sweep", "{case}", "--speeds", "20,22,24"]


THREADS_OF_REPORT = re.compile(rb'\["threads","\d+"\]')
THREADS = re.compile(rb'"threads": \d+')  # a run has its job's cores, a sweep here shares this machine's


def differences(folder, whole):
    """As after a kill, except the number of threads, on which no number depends."""
    with (unittest.mock.patch.object(trial, "TIMES", [*trial.TIMES, (THREADS, b"")]),
          unittest.mock.patch.object(trial, "TIMES_OF_REPORT", [*trial.TIMES_OF_REPORT, (THREADS_OF_REPORT, b"")])):
        return trial.differences(folder, whole)


class Trial:
    def __init__(self, program, slurm, folder):
        self.program, self.slurm, self.folder = program.resolve(), slurm, folder
        self.rows = []
        (folder / HOSTILE).mkdir(parents=True)
        self.case = folder / HOSTILE / "line\nbreak.toml"
        self.case.write_text(trial.CASE)

    def ripstop(self, arguments, out, *more):
        words = [str(self.case) if word == "{case}" else word for word in arguments]
        return subprocess.run([str(self.program), *words, *more, "--out", str(out)], capture_output=True, text=True, cwd=self.folder,
                              env=self.slurm.environment)

    def local(self, name, arguments):
        out = self.folder / "here" / name  # a report has the folder's name
        done = self.ripstop(arguments, out)
        assert done.returncode == 0, done.stderr
        return out

    def submit(self, arguments, out, *options):
        """By the printed command; options of sbatch precede the name of a script and follow `submit`."""
        written = self.ripstop(arguments, out, "--batch", "slurm")
        assert written.returncode == 0, written.stderr
        command = re.search(r"^Submit: (.*)$", written.stdout, re.MULTILINE).group(1)
        words = " ".join(options)
        command = command.replace("sbatch ", f"sbatch {words} ") if command.startswith("sbatch") else f"{command} {words}"
        done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, cwd="/", env=self.slurm.environment)
        assert done.returncode == 0, f"{command}: {done.stderr}"
        return written.stdout, max(int(job.split("_")[0]) for job in self.slurm.jobs())

    def ended(self, seconds=900):
        states = self.slurm.wait_for_all(seconds)
        self.harmless()
        return states

    def harmless(self):
        assert not list(self.folder.rglob("harm")) and not pathlib.Path("/harm").exists(), "a name was run"

    def tell(self, what, jobs, unlike):
        print(f"{'ok' if not unlike else 'FAILED'}: {what} [{jobs}] {' '.join(unlike[:8])}", flush=True)
        self.rows.append([what, jobs, "the same" if not unlike else f"{len(unlike)} differ: {unlike[0]}"])

    def states(self, since):
        """States of the jobs from number `since` on, in words."""
        count = {}
        for job, state in self.slurm.jobs().items():
            if int(job.split("_")[0]) >= since:
                count[state.lower()] = count.get(state.lower(), 0) + 1
        return ", ".join(f"{n} {state}" for state, n in sorted(count.items()))


def one_run(t):
    whole = t.local("steady", STEADY)
    out = t.folder / HOSTILE / "steady"
    _, job = t.submit(STEADY, out)
    t.ended()
    t.tell("`steady`, every path with quotes, `$`, blanks, `%` and a line break in the case's name", t.states(job), differences(out, whole))
    log = (out.parent / "steady.slurm" / f"{job}.log").read_text()
    assert "Drag" in log or "drag" in log, log


def near_the_limit(t):
    """Slurm sends USR1 to the batch shell 120 s before the time limit."""
    whole = t.folder / "here/steady"
    out = t.folder / "limited/steady"
    _, job = t.submit(STEADY, out)
    checkpoint = out / "checkpoint/current"
    t.slurm.wait(checkpoint.exists, 300, "a checkpoint")
    t.slurm.call("scancel", "--batch", "--signal=USR1", str(job), check=True)
    t.ended()
    log = (out.parent / "steady.slurm" / f"{job}.log").read_text()
    restarts = re.search(r"Restarts=(\d+)", t.slurm.call("scontrol", "show", "job", str(job))).group(1)
    unlike = differences(out, whole)
    if "the job is queued again" not in log or restarts != "1":
        unlike.append(f"not requeued: {restarts} restarts")
    t.tell("`steady` that meets its time limit after a checkpoint: requeued, continues", f"{t.states(job)}, {restarts} restart", unlike)


def ranks_on_nodes(t, name, arguments, what):
    whole = t.local(name, arguments)
    out = t.folder / "jobs" / name
    _, job = t.submit(arguments, out, "--nodes=2", "--ntasks-per-node=1")
    t.ended()
    nodes = re.search(r"NumNodes=(\d+)", t.slurm.call("scontrol", "show", "job", str(job))).group(1)
    t.tell(f"{what}, a rank on each of {nodes} nodes", t.states(job), differences(out, whole))


def openfoam(t):
    ranks_on_nodes(t, "openfoam", OPENFOAM, "`steady --flow openfoam --ranks 2`, cloth of the `paper` model")


def sheet(t):
    ranks_on_nodes(t, "sheet", SHEET, "the same with sheets, faces of the box's own cells")


def fitted(t):
    ranks_on_nodes(t, "fitted", FITTED, "the same with sheets on a mesh that follows the cloth")


def sweep(t):
    whole = t.local("sweep", SWEEP)
    out = t.folder / "jobs/sweep"
    told, _ = t.submit(SWEEP, out)
    first = min(int(job.split("_")[0]) for job in t.slurm.jobs() if int(job.split("_")[0]) > t.before)
    t.ended()
    t.tell("`sweep` of three speeds: two arrays and the table", t.states(first), differences(out, whole))


def cancelled(t):
    """An element of the second wave is cancelled while it runs; the table reports it, and `ripstop sweep` continues."""
    whole = t.folder / "here/sweep"
    out = t.folder / "cancelled/sweep"
    _, last = t.submit(SWEEP, out)
    wave = last - 1  # the last array; then comes the table
    t.slurm.wait(lambda: t.slurm.jobs().get(f"{wave}_0") == "RUNNING" and (out / "speed_m_s=20/checkpoint").exists(), 300, "the run")
    t.slurm.call("scancel", f"{wave}_0", check=True)
    t.ended()
    states = t.states(wave - 1)
    table = (out / "sweep.csv").read_text()
    unlike = [] if table.count("is not finished") == 1 and table.count("converged") == 2 else [f"the table: {table}"]
    done = t.ripstop(SWEEP, out)
    assert done.returncode == 0, done.stderr
    t.tell("`sweep` with one element cancelled, then `ripstop sweep` here", states, unlike + differences(out, whole))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ripstop", type=pathlib.Path, required=True)
    parser.add_argument("--keep", type=pathlib.Path, help="work in this folder, and leave it")
    parser.add_argument("--trials", nargs="*", help="some of them; the table is then not written")
    options = parser.parse_args()
    trials = {"steady": one_run, "limit": near_the_limit, "openfoam": openfoam, "sheet": sheet, "fitted": fitted,
              "sweep": sweep, "cancelled": cancelled}
    work = options.keep or pathlib.Path(tempfile.mkdtemp(prefix="ripstop-slurm-"))
    shutil.rmtree(work, ignore_errors=True)
    begin = time.monotonic()
    with localhost.Slurm(work / "slurm") as slurm:
        t = Trial(options.ripstop, slurm, work / "work")
        version = slurm.call("sinfo", "--version").strip()
        for name, run in trials.items():
            if not options.trials or name in options.trials:
                t.before = max((int(job.split("_")[0]) for job in slurm.jobs()), default=0)
                run(t)
    failed = [row for row in t.rows if row[2] != "the same"]
    if not options.trials:
        today = datetime.date.today()
        lines = ["# Batch scripts executed by Slurm", "",
                 f"`make test-slurm`: {version}, two nodes on one machine; {today.day} {today:%B %Y}, {time.monotonic() - begin:.0f} s.", "",
                 "Every file of the folder is compared with that of the same command without Slurm, except for times.", "",
                 *tables.table(["command", "jobs", "files"], t.rows)]
        (tables.ROOT / "docs/tables/slurm.md").write_text("\n".join(lines).rstrip("\n") + "\n")
    if not options.keep and not failed:
        shutil.rmtree(work)
    print(f"{len(t.rows)} trials, {len(failed)} failed{f'; see {work}' if failed or options.keep else ''}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
