#!/usr/bin/env python3
"""Time from a change of a design to its shape in Studio, over changes of every family.

    live_shape.py RIPSTOP [CHANGES]

Each change multiplies one length of the example of a family by 1.05 or 0.96, or changes the pressure; changes that the
check refuses do not count. The next change follows the equilibrium. Times are those of a client on the same machine: the
change of the file with its check, and the first shape. The processor time is that of the server and of its checks, which
a busy machine changes little. Writes a table in Markdown."""
import json
import os
import pathlib
import platform
import statistics
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/studio"))
from studio import Studio  # noqa: E402

NODES = 3000
PATIENCE = 30  # [s] for the equilibrium before the next change


def lengths(written):
    """Lengths of the parachute that a designer would change."""
    names = [key for key in written if key.startswith("parachute.") and key.endswith("_m") and ".mesh." not in key]
    return [(name, json.loads(written[name])) for name in sorted(names) if written[name].replace(".", "", 1).isdigit()]


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def processor_time(pid):
    """Of the server and the checks that it has started [s]."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(int(field) for field in fields[11:15]) / os.sysconf("SC_CLK_TCK")


class Family:
    def __init__(self, studio, name):
        self.studio, self.name, self.file = studio, name, f"{name}.toml"
        self.case = studio.post("/api/case/create", file=self.file, family=name)[1]
        self.keys = lengths(self.case["written"])
        self.rows = []
        self.count = 0
        self.timed_shape({})  # the page has a shape before the first change

    def timed_shape(self, more):
        """Time and processor time until the first shape, and until the equilibrium if it is reached."""
        begin, before = time.perf_counter(), processor_time(self.studio.process.pid)

        def passed():
            return time.perf_counter() - begin, processor_time(self.studio.process.pid) - before

        status, answer = self.studio.get("/api/shape", view=self.name, file=self.file, nodes=NODES, **more)
        first, at_once = passed(), status == 200 and answer["result"]["converged"]
        while status == 200 and not answer["result"]["converged"] and time.perf_counter() - begin < PATIENCE:
            status, answer = self.studio.get("/api/shape/later", view=self.name, number=answer["number"])
        return first, passed() if status == 200 and answer["result"]["converged"] else None, at_once

    def change(self):
        """Whether the change was one that counts."""
        self.count += 1
        kind, factor = self.count % (len(self.keys) + 1), (1.05, 0.96)[self.count // (len(self.keys) + 1) % 2]
        more, begin, before = {}, time.perf_counter(), processor_time(self.studio.process.pid)
        if kind == 0:
            summary = self.case["check"]
            more = {"pressure": factor * 0.5 * summary["density_kg_m3"] * summary["speed_m_s"] ** 2}
        else:
            key, value = self.keys[kind - 1]
            answer = self.studio.post("/api/case/change", file=self.file, version=self.case["version"], changes={key: round(factor * value, 6)})[1]
            if not answer["check"]["valid"]:
                self.case = self.studio.post("/api/case/write", file=self.file, version=answer["version"], text=self.case["text"])[1]
                return False
            self.case = answer
        writing = time.perf_counter() - begin, processor_time(self.studio.process.pid) - before
        first, rest, at_once = self.timed_shape(more)
        self.rows.append((*(shape and tuple(map(sum, zip(writing, shape))) for shape in (first, rest)), at_once))
        return True


def main():
    program, wanted = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 200
    with tempfile.TemporaryDirectory() as folder:
        studio = Studio(program, folder)
        names = studio.get("/api/folder")[1]["families"]
        families, memory = [], []
        done = 0
        each = -(-wanted // len(names))
        for name in names:
            family = Family(studio, name)
            families.append(family)
            tried = 0
            while len(family.rows) < each and tried < 4 * each:
                done += family.change()
                tried += 1
            memory.append(studio.memory())
            print(name, [round(first[0], 2) for first, *_ in family.rows], file=sys.stderr, flush=True)
        studio.end()
    rows = [row for family in families for row in family.rows]

    def line(name, rows):
        first, rest = [row[0] for row in rows], [row[1] for row in rows if row[1]] or [(float("nan"), float("nan"))]
        wall, spent = 0, 1
        cells = [statistics.median(row[wall] for row in first), percentile([row[wall] for row in first], 0.95), max(row[wall] for row in first),
                 percentile([row[spent] for row in first], 0.95), statistics.median(row[wall] for row in rest), percentile([row[wall] for row in rest], 0.95),
                 percentile([row[spent] for row in rest], 0.95)]
        at_once = sum(row[2] for row in rows)
        return f"| {name} | {len(rows)} | {' | '.join(f'{cell:.2f}' for cell in cells)} | {100 * at_once / len(rows):.0f} | {sum(not row[1] for row in rows)} |"

    print("# Time from a change of a design to its shape in Studio\n")
    print(f"`python3 bench/live_shape.py build/bin/ripstop {wanted}`: {platform.machine()}, {len(os.sched_getaffinity(0))} cores, load average "
          f"{os.getloadavg()[1]:.1f}, {time.strftime('%-d %B %Y')}. {NODES} nodes of cloth. Times from the change in s, to the first shape and to the "
          "equilibrium. CPU: processor time of the server and of the checks it starts, in s.\n")
    print("| family | changes | first shape, median | 95 % | largest | CPU, 95 % | equilibrium, median | 95 % | CPU, 95 % | in equilibrium at once, % | without equilibrium |")
    print("|---|" + 10 * "---|")
    for family in families:
        print(line(family.name, family.rows))
    print(line("all", rows))
    print(f"\nMemory of the server: {memory[0] / 2**20:.0f} MiB after the first family, {memory[-1] / 2**20:.0f} MiB after the last.")


main()
