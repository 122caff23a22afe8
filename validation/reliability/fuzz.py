#!/usr/bin/env python3
"""Fuzzes every reader under clang's libFuzzer with the harnesses of build-fuzz/, and counts the executions.

    make fuzz                         (or: fuzz.py --seconds 600 --jobs 2 case chute)
    make fuzz READERS=table FAST=1 LONGEST=256 SECONDS=3600

FAST=1 uses build-fuzz-fast, which has no address sanitizer and traces no comparisons: several times the executions. Both builds have
one corpus. LONGEST is the largest number of bytes of a new input.

The corpus of a reader remains in build-fuzz/corpus/<reader>, and the next call continues with it. A failing input is the file
build-fuzz/find-<reader>-*. A call is a line of build-fuzz/runs.jsonl; docs/tables/fuzz.md has their sums. Every call repeats the
failing inputs. They remain open until the reader accepts them or refuses them with a reason.
"""
import argparse
import collections
import concurrent.futures
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent))
import tables  # pylint: disable=wrong-import-position

BUILD = ROOT / "build-fuzz"
PROGRAMS = {False: BUILD / "fuzz", True: ROOT / "build-fuzz-fast/fuzz"}  # by --fast
MADE_SEEDS = {"stl", "vtk", "checkpoint", "openfoam"}  # readers whose seeds are written by fuzz_make_seeds
READERS = ["case", "setting", "material", "bench", "record", "table", "chute", "measured", "image", "stl", "vtk", "checkpoint", "openfoam", "hosts"]
SLOWEST_S, MEMORY_MB, LONGEST = 10, 1024, 65536
LIMITS = [f"-timeout={SLOWEST_S}", f"-rss_limit_mb={MEMORY_MB}"]
# Of the time of a short input, uniform selection from the corpus, few stack frames of an allocation, and no fill save about half.
QUICK = ["-entropic=0", "-reload=0"]
ENVIRONMENT = {**os.environ, "RIPSTOP_DATA": str(ROOT), "ASAN_OPTIONS": "malloc_context_size=2:quarantine_size_mb=16:max_malloc_fill_size=0"}


def corpus(reader, fast):
    """The folder of the corpus with the seeds. Their names contain their paths, because a corpus has no folders."""
    folder = BUILD / "corpus" / reader
    folder.mkdir(parents=True, exist_ok=True)
    for seed in map(pathlib.Path, filter(None, (PROGRAMS[fast] / f"{reader}.seeds").read_text().splitlines())):
        for file in [seed] if seed.is_file() else sorted(path for path in seed.rglob("*") if path.is_file()):
            (folder / f"seed-{str(file).replace('/', '_')}").write_bytes(file.read_bytes())
    return folder


def number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def fuzz(reader, number_of_call, seconds, longest, fast):
    folder, log = corpus(reader, fast), BUILD / f"{reader}{'-fast' if fast else ''}-{number_of_call}.log"
    begin = time.monotonic()
    with open(log, "w", encoding="utf-8") as out:
        code = subprocess.run([PROGRAMS[fast] / f"fuzz_{reader}", f"-max_total_time={seconds}", *LIMITS, *QUICK, f"-max_len={longest}", "-print_final_stats=1",
                               f"-artifact_prefix={BUILD}/find-{reader}-", folder], env=ENVIRONMENT, stdout=out, stderr=out, check=False).returncode
    text = log.read_text(errors="replace")
    return {"reader": reader, "fast": fast, "longest": longest, "code": code, "executions": number(r"stat::number_of_executed_units: *(\d+)", text),
            "peak_rss_mb": number(r"stat::peak_rss_mb: *(\d+)", text), "edges": number(r"cov: (\d+)", text),
            "corpus": len(list(folder.iterdir())), "seconds": round(time.monotonic() - begin, 1)}


def open_finds(reader, fast):
    """Inputs of this and earlier calls that still fail. Those of a reader that is not called count as open."""
    finds = sorted(BUILD.glob(f"find-{reader}-*"))
    return [find.name for find in finds
            if subprocess.run([PROGRAMS[fast] / f"fuzz_{reader}", *LIMITS, find], env=ENVIRONMENT, capture_output=True, check=False).returncode != 0]


HEAD = ["reader", "executions", "of these fast", "min", "edges reached", "corpus, files", "peak memory, MB", "found", "open", "machine and day"]


def earlier_rows():
    """Rows of the present table by reader. Readers without runs on this machine keep theirs."""
    rows = {row[0]: row for row in tables.rows_of("fuzz")}
    page = ROOT / "docs/tables/fuzz.md"
    made = re.search(r"^`make fuzz`: (.*)\.$", page.read_text(), re.MULTILINE)[1] if page.exists() else ""
    return {reader: row if len(row) == len(HEAD) else [*row[:2], "0", *row[2:], made] for reader, row in rows.items()}


def write_table(runs, still_open):
    earlier, rows = earlier_rows(), []
    for reader in READERS:
        own = [run for run in runs if run["reader"] == reader]
        if own:
            made = tables.made_by([{"started": run["day"], "processor": tables.machine()} for run in own])
            rows.append([reader, f"{sum(run['executions'] for run in own):,}",
                         f"{sum(run['executions'] for run in own if run.get('fast')):,}", f"{sum(run['seconds'] for run in own) / 60:.0f}", str(own[-1]["edges"]),
                         str(own[-1]["corpus"]), str(max(run["peak_rss_mb"] for run in own)), str(sum(run["code"] != 0 for run in own)),
                         str(len(still_open[reader])), made])
        elif reader in earlier:
            rows.append(earlier[reader])
    executions, fast, minutes, found, left = (sum(int(row[column].replace(",", "")) for row in rows) for column in (1, 2, 3, 7, 8))
    rows.append(["**all**", f"{executions:,}", f"{fast:,}", str(minutes), "", "", "", str(found), str(left), ""])
    commits = collections.Counter(run["commit"] for run in runs)
    lines = [f"Inputs of arbitrary bytes, up to {LONGEST // 1024} kB, mutated from the corpus by coverage, under the address and undefined-behaviour "
             f"sanitizers. A failing input crashes the reader, takes over {SLOWEST_S} s or over {MEMORY_MB} MB (including the sanitizers), or throws "
             "anything but an `Error`. Fast executions (`make fuzz FAST=1 LONGEST=256`) have the undefined-behaviour sanitizer and the "
             "assertions of the standard library, but no address sanitizer. Found: calls with a failing input. Open: inputs that still fail after the last call. "
             "Last calls by commit: " + ", ".join(f"{commit} {count}" for commit, count in sorted(commits.items())) + ".", "",
             *tables.table(HEAD, rows)]
    tables.write("fuzz", "Fuzzing of the file readers", "make fuzz", [{"started": run["day"], "processor": tables.machine()} for run in runs], lines)
    print(f"{executions:,} executions in all")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("readers", nargs="*", choices=[*READERS, []], help="default: all; a reader that is named twice runs in two processes")
    parser.add_argument("--seconds", type=int, default=60, help="of each reader")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="readers at a time")
    parser.add_argument("--longest", type=int, default=LONGEST, help="most bytes of a new input")
    parser.add_argument("--fast", action="store_true", help="the build without the address sanitizer")
    options = parser.parse_args()
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()
    record = BUILD / "runs.jsonl"
    readers = options.readers or READERS
    programs = PROGRAMS[options.fast]
    if MADE_SEEDS & set(readers):
        subprocess.run([programs / "fuzz_make_seeds", programs / "seeds"], check=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for ended in concurrent.futures.as_completed([pool.submit(fuzz, reader, call, options.seconds, options.longest, options.fast) for call, reader in enumerate(readers)]):
            run = {**ended.result(), "day": f"{datetime.date.today()}", "commit": commit}
            with open(record, "a", encoding="utf-8") as file:
                file.write(json.dumps(run) + "\n")
            print(f"{run['reader']}: {run['executions']:,} executions, {run['peak_rss_mb']} MB" + (f", ends with {run['code']}" if run["code"] else ""), flush=True)
    runs = [json.loads(line) for line in record.read_text().splitlines()]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        untried = {reader: [find.name for find in BUILD.glob(f"find-{reader}-*")] for reader in READERS}
        still_open = untried | dict(zip(readers, pool.map(open_finds, readers, [options.fast] * len(readers))))
    write_table(runs, still_open)
    for name in sum(still_open.values(), []):
        print(f"open: build-fuzz/{name}")
    return 1 if any(still_open.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
