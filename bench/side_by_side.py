#!/usr/bin/env python3
"""Speed of two builds, run alternately: bench/side_by_side.py OLD NEW [ROUNDS [BENCH ...]]

OLD and NEW are build folders with bench_flow, bench_cloth and bench_inflation. Prints for each quantity the best of all
rounds of each build, their ratio, and the median of the ratios of the rounds; a ratio below 1 means that NEW is slower.
"""
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys


def flow(text):
    """Million cell-iterations, or cell-steps in time, a second."""
    rates = {}
    for line in text.splitlines():
        if row := re.match(r"\s*(\d+)\s+(des|wale)?\s*([\d.]+) M\s+([\d.]+) M", line):
            cells, eddies, one, two = row.groups()
            for threads, rate in ((1, one), (2, two)):
                rates[f"flow, {cells} cells{', in time, ' + eddies if eddies else ''}, {threads} thread(s)"] = float(rate)
        if row := re.search(r"([\d.]+) s of processor time", line):
            rates["flow, cold solutions a processor hour"] = 3600 / float(row[1])
    return rates


def cloth(text):
    """Million node updates a second, the best of many short runs; relaxation steps a second."""
    rates = {}
    for line in text.splitlines():
        number = r"\s+([\d.]+)"
        if row := re.match(rf"(\S.*?\S)\s{{2,}}([\d.]+){number}{number}{number}{number}{number}$", line):
            rates[f"cloth, {row[1]}, 1 thread"], rates[f"cloth, {row[1]}, 2 threads"] = float(row[3]), float(row[5])
        elif row := re.match(rf"(\S.*?\S)\s+(1e-\d+)\s+(\d+){number}{number}", line):
            rates[f"relaxation, {row[1]}, {row[2]}"] = 1e6 / float(row[5])
    return rates


def inflation(text):
    """Simulated time over wall time."""
    return {re.sub("/(iterations|real_time).*", "", row["name"]): 1e3 / row["real_time"] for row in json.loads(text)["benchmarks"]}


BENCHES = {"flow": (["bench_flow"], flow), "in-time": (["bench_flow", "--in-time"], flow), "cloth": (["bench_cloth"], cloth),
           "inflation": (["bench_inflation", "--benchmark_format=json"], inflation)}


def main():
    if len(sys.argv) < 3 or not set(sys.argv[4:]) <= set(BENCHES):
        sys.exit(f"{__doc__}BENCH: {', '.join(BENCHES)}; default all")
    builds = [pathlib.Path(build).resolve() for build in sys.argv[1:3]]
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    found = {}  # quantity: a pair of rates for each round
    for number in range(rounds):
        for name in sys.argv[4:] or BENCHES:
            (program, *options), rates_of = BENCHES[name]
            rates = [None, None]
            for which in (0, 1) if number % 2 == 0 else (1, 0):
                command = [builds[which] / "bench" / program, *options]
                data = {**os.environ, "RIPSTOP_DATA": str(builds[which].parent)}  # cases have the keys of their time
                done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=data)
                rates[which] = rates_of(done.stdout)
            for quantity in rates[0]:
                found.setdefault(quantity, []).append((rates[0][quantity], rates[1][quantity]))
    print("| quantity | old, best | new, best | ratio of the best | median of the ratios |\n| --- | --- | --- | --- | --- |")
    for quantity, pairs in found.items():
        old, new = (max(pair[which] for pair in pairs) for which in (0, 1))
        median = statistics.median(pair[1] / pair[0] for pair in pairs)
        print(f"| {quantity} | {old:.4g} | {new:.4g} | {new / old:.3f} | {median:.3f} |")


main()
