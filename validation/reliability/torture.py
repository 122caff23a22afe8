#!/usr/bin/env python3
"""Tests the guarantees of run folders under kills, full disks, damaged files and false programs.

    make torture                      (or: torture.py --ripstop build/bin/ripstop --stage kill --count 100)

Stages, each a list of trials in an order that a fixed seed gives, so that trial k is always the same:

    kill    SIGKILL at a random moment, and at every call that writes; the same command again must give the folder of an
            undisturbed run, byte for byte except times of day and wall times
    fail    every call that writes fails once (ENOSPC, EIO, half a write, half a write and then no room): exit code 7 and a
            message that names the file; the same command again must give the undisturbed folder
    damage  every file of a finished and of an interrupted folder cut in half, with one byte flipped, and removed: each
            command that reads the folder must report it or give the result of the undisturbed folder
    others  two processes in one folder, a clock that moves backward, programs instead of OpenFOAM that fail

Finished trials are lines of trials.jsonl in --work; the same command continues with the others, and repeats failed
trials when the program has changed. The table is docs/tables/torture.md.
"""
import argparse
import collections
import concurrent.futures
import datetime
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parent.parent)]
import damage  # pylint: disable=wrong-import-position
import others  # pylint: disable=wrong-import-position
import tables  # pylint: disable=wrong-import-position
import trial  # pylint: disable=wrong-import-position

SEED = 21
TABLE = trial.ROOT / "docs/tables/torture.md"
RANDOM_KILLS = {"steady": 50, "inflate": 50, "sweep": 25, "sweep-2": 25, "damping": 20, "porosity": 15, "openfoam": 6}  # trials
KILLED_AT_WRITES = {"steady": 1, "inflate": 1, "sweep": 3, "damping": 1, "porosity": 3, "openfoam": 12}  # one of this many
FAILING = {"steady": 1, "inflate": 1, "sweep": 1, "damping": 1, "porosity": 1, "openfoam": 12, "fabric": 1, "coupon": 1, "fit": 1}
FAILING_IN_RUNS = 12  # in the folders of a sweep's runs: their calls are those of `steady`, which are all tried,
REMOVALS = {"unlink", "unlinkat", "remove", "rmdir"}  # except these, which belong to the sweep


def resumed(bench, name, folder, killed):
    """Repeats the command and compares its folder with the undisturbed one."""
    whole, wanted, _, _ = bench.undisturbed(name)
    code, out, err = bench.run(bench.command(name, folder / "out"), trial.FASTER.get(name))
    said = trial.last_line(err) or trial.last_line(out)
    if code != wanted:
        return {"ok": False, "kills": killed, "said": f"resumed: exit code {code}: {said}"}
    unlike = trial.differences(folder / "out", whole)
    if unlike:
        return {"ok": False, "kills": killed, "said": "differ: " + ", ".join(unlike[:8])}
    if name in ("steady", "inflate", "openfoam"):  # the seal fits, and the finished run is only shown
        code, _, err = bench.run(bench.command(name, folder / "out"))
        if code != wanted or "contains the finished run" not in err:
            return {"ok": False, "kills": killed, "said": f"shown again: exit code {code}: {trial.last_line(err)}"}
    return {"ok": True, "kills": killed}


def killed_at_random(bench, name, number):
    """Up to ten kills in succession, each within the duration of the whole run."""
    rng = random.Random(f"{SEED} {name} {number}")
    seconds = bench.undisturbed(name)[2]
    folder, kills, moments = bench.folder("trial"), 0, []
    for _ in range(rng.randint(1, 10)):
        moments.append(round(rng.uniform(0, seconds), 4))
        child = bench.start(bench.command(name, folder / "out"), trial.FASTER.get(name, {}))
        try:
            child.communicate(timeout=moments[-1])
            break  # it has ended
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            kills += 1
    return {**resumed(bench, name, folder, kills), "moments_s": moments}


def killed_at(bench, name, number):
    """At a write, and up to three times at writes of the continued run."""
    rng = random.Random(f"{SEED} {name} {number} at write")
    folder, kills, writes = bench.folder("trial"), 0, [number]
    while True:
        fault = {**trial.FASTER.get(name, {}), "TORTURE_ROOT": str(folder / "out"), "TORTURE_AT": str(writes[-1]), "TORTURE_DO": "kill"}
        code, _, err = bench.run(bench.command(name, folder / "out"), fault)
        kills += code == -signal.SIGKILL
        if code != -signal.SIGKILL or kills == 4:
            break
        writes.append(rng.randint(1, len(bench.undisturbed(name)[3])))
    if kills == 0:
        return {"ok": False, "kills": 0, "said": f"was not killed but ended with {code}: {trial.last_line(err)}"}
    return {**resumed(bench, name, folder, kills), "writes": writes}


def failing_at(bench, name, number, reason):
    """felt: the command failed; otherwise the failed call had no effect."""
    folder = bench.folder("trial")
    whole, wanted, _, calls = bench.undisturbed(name)
    kind, path = calls[number - 1]
    code, out, err = bench.run(bench.command(name, folder / "out"),
                               {**trial.FASTER.get(name, {}), "TORTURE_ROOT": str(folder / "out"), "TORTURE_AT": str(number), "TORTURE_DO": reason})
    file = named_by(path)
    row = {"call": f"{kind} {file}", "felt": code != wanted}
    if code == wanted:
        unlike = trial.differences(folder / "out", whole)
        if unlike:
            return {**row, "ok": False, "said": "exit code as if nothing had been, but these differ: " + ", ".join(unlike[:8])}
        return {**row, **resumed(bench, name, folder, 0)}
    if code != 7 or (file not in err + out and str(folder) not in err + out):
        return {**row, "ok": False, "said": f"exit code {code}: {trial.last_line(err)}"}
    if reason == "short":
        return {**row, "ok": False, "said": f"half a write is no failure, yet exit code {code}: {trial.last_line(err)}"}
    return {**row, **resumed(bench, name, folder, 0)}


def named_by(path):
    """The file that a call is about: ".result.json.4711-3.tmp" is result.json."""
    name = pathlib.Path(path).name
    return name[1:].rsplit(".", 2)[0] if name.endswith(".tmp") else name


def kill_trials(bench, rng):
    trials = [(f"kill {name} at random {k}", name, killed_at_random, (name, k)) for name, count in RANDOM_KILLS.items() for k in range(count)]
    for name, every in KILLED_AT_WRITES.items():
        for n in range(1, len(bench.undisturbed(name)[3]) + 1, every):
            trials.append((f"kill {name} at write {n}", name, killed_at, (name, n)))
    rng.shuffle(trials)
    return trials


def fail_trials(bench, rng):
    """Every call fails for one reason, then every call for the next one: --count limits the reasons, not the calls."""
    rounds = [[] for _ in range(4)]
    for name, every in FAILING.items():
        root, _, _, calls = bench.undisturbed(name)
        in_run = [kind not in REMOVALS and any("=" in part for part in pathlib.Path(path).relative_to(root).parts[:1]) for kind, path in calls]
        numbers = [n for n in range(1, len(calls) + 1) if not in_run[n - 1]][::every] + [n for n in range(1, len(calls) + 1) if in_run[n - 1]][::FAILING_IN_RUNS]
        for n in numbers:
            reasons = ["ENOSPC", "EIO", *(["short", "full"] if calls[n - 1][0] == "write" else [])]
            first = rng.randrange(len(reasons))
            for k, reason in enumerate(reasons[first:] + reasons[:first]):
                rounds[k].append((f"fail {name} {reason} at {n}", name, failing_at, (name, n, reason)))
    for trials in rounds:
        rng.shuffle(trials)
    return sum(rounds, [])


STAGES = {"kill": kill_trials, "fail": fail_trials, "damage": damage.trials, "others": others.trials}


def run(options, bench, log, stage):
    listed = STAGES[stage](bench, random.Random(SEED))
    options.listed.update(collections.Counter((kind_of(stage, name), case) for name, case, *_ in listed))
    trials = [t for t in listed if options.only in t[0]]
    todo = [t for t in trials if options.again or log.wants(t[0])]
    if options.failed:
        todo = [t for t in todo if t[0] in log.done and not log.done[t[0]]["ok"]]
    todo = todo[:options.count]
    print(f"{stage}: {len(trials)} trials, {len(todo)} to do", flush=True)
    begin = time.monotonic()

    def tried(name, case, function, arguments):
        started = time.monotonic()
        return {"trial": name, "stage": stage, "case": case, **function(bench, *arguments), "seconds": round(time.monotonic() - started, 2),
                "day": f"{datetime.date.today()}", "commit": options.commit}

    with concurrent.futures.ThreadPoolExecutor(options.jobs, "lane") as pool:
        try:
            for done, ended in enumerate(concurrent.futures.as_completed([pool.submit(tried, *t) for t in todo]), 1):
                row = ended.result()
                log.add(row)
                left = (time.monotonic() - begin) / done * (len(todo) - done)
                if not row["ok"] or done % 20 == 0 or done == len(todo):
                    print(f"{done}/{len(todo)} {row['trial']}: {'ok' if row['ok'] else 'FAILED: ' + row['said']} | about {left / 60:.0f} min left", flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    for folder in bench.work.glob("trial-*"):
        shutil.rmtree(folder, ignore_errors=True)


def kind_of(stage, trial_name):
    return f"{stage}, at random moments" if " at random " in trial_name else f"{stage}, at writes" if stage == "kill" else stage


def write_table(options, log):
    counted = collections.defaultdict(lambda: [0, 0, 0, 0, 0.0])
    for row in log.done.values():
        entry = counted[kind_of(row["stage"], row["trial"]), row["case"]]
        for k, more in enumerate([1, row.get("kills", 0), row.get("felt", False), not row["ok"], row["seconds"]]):
            entry[k] += more
    of = {key: n for key, n in options.listed.items() if n}
    for key in of:
        counted[key]  # pylint: disable=pointless-statement  # what was not tried at all has its line too
    rows = [[kind, case, str(n), str(of.get((kind, case), "")), str(kills) if "kill" in kind else "", str(felt) if kind == "fail" else "", str(failed), f"{seconds / 60:.1f}"]
            for (kind, case), (n, kills, felt, failed, seconds) in sorted(counted.items())]
    total = [sum(column) for column in zip(*counted.values())] or [0] * 5
    rows.append(["**all**", "", str(total[0]), str(sum(of.values())), *map(str, total[1:4]), f"{total[4] / 60:.1f}"])
    days = sorted({row["day"] for row in log.done.values()})
    named = list(dict.fromkeys(f"{d.day} {d:%B %Y}" for d in (datetime.date.fromisoformat(day) for day in (days[0], days[-1]))))
    commits = collections.Counter(row["commit"] for row in log.done.values())
    bad = [[row["trial"], row["said"]] for row in sorted(log.done.values(), key=lambda row: row["trial"]) if not row["ok"]]
    asked = "".join(f" --stage {stage}" for stage in options.stage or [])
    if options.table != TABLE:
        asked += f" --table {options.table}"
    command = f'make torture TORTURE="{asked.strip()}"' if asked else "make torture"
    lines = ["# Killed runs, failing writes, damaged files and wrong programs", "",
             f"`{command}`: {tables.machine()}, {' to '.join(named)}; "
             + "trials by commit: " + ", ".join(f"{commit} {n}" for commit, n in sorted(commits.items())) + ".", "",
             "*Noticed*: the command failed with exit code 7 and the name of the file; otherwise the failing call had no effect and the files "
             "are those of the undisturbed run. *Failed*: the behaviour is not that of [reliability](../reliability.md). *Possible*: number of "
             "possible trials. Of the calls in the folders of the runs of a sweep, which are mostly those of `steady`, every "
             f"{FAILING_IN_RUNS}th was tried, and of those of OpenFOAM every {FAILING['openfoam']}th.", "",
             *tables.table(["kind", "command", "trials", "possible", "SIGKILLs", "noticed", "failed", "min"], rows)]
    if bad:
        lines += ["Failed:", "", *tables.table(["trial", "observation"], [[name, said.replace("|", "/")] for name, said in bad])]
    options.table.write_text("\n".join(lines).rstrip("\n") + "\n")
    print("\n".join(lines))
    return len(bad)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ripstop", type=pathlib.Path, default=trial.ROOT / "build/bin/ripstop")
    parser.add_argument("--work", type=pathlib.Path, default=trial.ROOT / "runs/torture", help="folder of the trials and of trials.jsonl")
    parser.add_argument("--stage", choices=STAGES, action="append", help="only this; repeatable (default: all)")
    parser.add_argument("--count", type=int, help="at most so many trials of each stage, of those that are left")
    parser.add_argument("--jobs", type=int, default=1, help="trials at a time")
    parser.add_argument("--only", default="", help="only trials with these words in their name, as in 'kill sweep'")
    parser.add_argument("--failed", action="store_true", help="only what failed with another program")
    parser.add_argument("--again", action="store_true", help="also what is done")
    parser.add_argument("--table", type=pathlib.Path, default=TABLE)
    options = parser.parse_args()
    options.commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=trial.ROOT, capture_output=True, text=True, check=False).stdout.strip()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # background jobs of a shell ignore it, and so would their child processes
    bench, options.listed = trial.Bench(options.ripstop, options.work), collections.Counter()
    log = trial.Log(options.work / "trials.jsonl", bench.hash)
    try:
        for stage in options.stage or STAGES:
            run(options, bench, log, stage)
    except KeyboardInterrupt:
        print("stopped; the same command goes on", file=sys.stderr)
    return 1 if log.done and write_table(options, log) else 0


if __name__ == "__main__":
    sys.exit(main())
