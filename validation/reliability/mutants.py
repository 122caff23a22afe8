#!/usr/bin/env python3
"""Mutation of the sources: does a test fail when the code is changed?

    make mutants        (or: mutants.py --number 400 --jobs 2)

The operators of sites.py change the .cpp files of src/ripstop. A sample of these mutants has lines of each room in proportion to
its size, with one mutant a line. A hash of the line selects them, so that a change of one file does not change the sample of
the others. All are compiled together into build-mutants/, each behind a condition that an environment variable makes true; mutants
that do not compile are dropped. Every test runs once by itself and records the mutants whose code it runs. A mutant is then tested
by these tests, those of its room first, until one fails, or takes three times as long twice, and does not do so without it. Tests
that take longer than --slowest seconds, and those in Python or a browser, are left out.

The log, build-mutants/log.jsonl, has a line for each verdict with the hash of the file. A logged mutant is not tested again, except
survivors with --again (after new tests). A reviewed survivor is in judged.json with the reason why it is equivalent (no input shows
it), harmless (speed, text, a tie, an arbitrary limit) or a hole. The table is docs/tables/mutants.md. --fresh 300 adds as many
mutants for which no test was written, tests them first, and writes mutants-fresh.md. Where tests were written for the survivors
of an earlier such sample, --after 900 begins after the first 900 of the order.
"""
import argparse
import collections
import concurrent.futures
import datetime
import hashlib
import json
import mmap
import os
import pathlib
import queue
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import mutants_table  # pylint: disable=wrong-import-position
import sites  # pylint: disable=wrong-import-position

WORK = ROOT / "build-mutants"
TREE, LOG, REACH = WORK / "tree", WORK / "log.jsonl", WORK / "reach.json"
NAMED = HERE / "named.json"
BUILD = TREE / "build-check"
SLOWER = 3  # a test that takes this many times as long as without a mutant has failed
PLAIN_FILES = {"assets.cpp", "build_info.cpp"}  # data; version

HEADER = """#pragma once
namespace ripstop_mutants {
extern bool active;
bool chosen(int number);
inline bool on(int number) { return active && chosen(number); }
struct Not { bool chosen; };
template <class T>
inline bool operator->*(Not n, const T& value) { return n.chosen ? bool(value) : !value; }
}  // namespace ripstop_mutants
"""
CHOICE = """#include "ripstop_mutants.h"
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <cstdlib>
namespace ripstop_mutants {
static unsigned char* reached = nullptr;
static int number_of_this = -1;
bool active = [] {
  if (const char* file = std::getenv("RIPSTOP_MUTANTS_REACHED")) {
    const int f = open(file, O_RDWR);
    void* at = mmap(nullptr, 65536, PROT_READ | PROT_WRITE, MAP_SHARED, f, 0);
    if (f >= 0 && at != MAP_FAILED) reached = static_cast<unsigned char*>(at);
    close(f);
  }
  if (const char* number = std::getenv("RIPSTOP_MUTANT")) number_of_this = std::atoi(number);
  return reached || number_of_this >= 0;
}();
bool chosen(int number) {
  if (reached) reached[number] = 1;
  return number == number_of_this;
}
}  // namespace ripstop_mutants
"""


def sha(*texts):
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:16]


def room_of(path):
    """src/ripstop/flow/cartesian/sheet.cpp belongs to the room cartesian, core/toml to core."""
    parts = path.split("/")[2:-1]
    return parts[-1] if parts[-1] in ("cartesian", "openfoam") else parts[0]


def sample(number):
    """Mutants in the order of their numbers: a share of lines of every room."""
    rooms, lines = collections.defaultdict(list), collections.Counter()
    for file in sorted((ROOT / "src/ripstop").rglob("*.cpp")):
        path = str(file.relative_to(ROOT))
        text = file.read_text()
        lines[room_of(path)] += text.count("\n")
        if file.name in PLAIN_FILES:
            continue
        by_line, times = collections.defaultdict(list), collections.Counter()
        for m in sites.Source(text).mutations():
            by_line[m.line].append(m)
        for line, found in by_line.items():
            says = text.splitlines()[line - 1].strip()
            times[says] += 1
            kind = min({m.kind for m in found}, key=lambda k: sha(path, says, str(times[says]), k))
            m = min((m for m in found if m.kind == kind), key=lambda m: sha(path, says, m.text, m.mutant))
            name = f"{path.removeprefix('src/ripstop/')}: {' '.join(m.text.split())} => {' '.join(m.mutant.split())}"
            if times[says] > 1:
                name += f" #{times[says]}"
            rooms[room_of(path)].append((sha(path, says, str(times[says])), name, path, sha(text), m))
    chosen, total = [], sum(lines.values())
    for room in sorted(rooms):
        taken = []
        for _, name, path, of, m in sorted(rooms[room], key=lambda r: r[0]):
            if len(taken) >= max(1, round(number * lines[room] / total)):
                break
            if all(path != p or m.end <= other.start or other.end <= m.start for _, p, _, other in taken):
                taken.append((name, path, of, m))
        chosen += taken
    return [{"name": name, "path": path, "of": of, "room": room_of(path), "m": m} for name, path, of, m in chosen]


def named():
    """Mutants requested by name: [file, original text, mutant, which of several]."""
    for path, old, new, *place in json.loads(NAMED.read_text()):
        text, at = (ROOT / "src/ripstop" / path).read_text(), -1
        for _ in range(place[0] if place else 1):
            at = text.find(old, at + 1)
        if at < 0:
            sys.exit(f"{NAMED}: {path} has no `{old}`")
        both = f"{{ if (ON) {{ {new} }} else {{ {old} }} }}" if old.endswith(";") else f"(ON ? ({new}) : ({old}))"
        m = sites.Mutation("named", at, at + len(old), text.count("\n", 0, at) + 1, old, new, both)
        yield {"name": f"{path}: {old} => {new}" + (f" #{place[0]}" if place else ""), "path": f"src/ripstop/{path}", "of": sha(text),
               "room": room_of(f"src/ripstop/{path}"), "m": m}


def all_mutants(number):
    """The sample without the mutants of named.json, followed by these."""
    asked = list(named())
    taken = [(n["path"], n["m"].start, n["m"].end) for n in asked]
    free = [m for m in sample(number) if all(m["path"] != p or m["m"].end <= a or b <= m["m"].start for p, a, b in taken)]
    return free + asked


def put(path, text):
    """Writes a file that differs, so that only changed files are compiled."""
    if not path.exists() or path.read_bytes() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)


def mutated(path, mutants, dropped):
    """A source with its mutants, and the lines of each."""
    text, made, lines, at = (ROOT / path).read_text(), '#include "ripstop_mutants.h"\n', {}, 0
    at_place = collections.defaultdict(list)
    for number, mutant in mutants:
        if number not in dropped:
            at_place[mutant["m"].start].append((number, mutant["m"]))
    for start in sorted(at_place):
        made += text[at:start]
        first = made.count("\n") + 1
        replaced = text[start:at_place[start][0][1].end]
        for number, m in at_place[start]:  # several named ones may be at one place
            both = m.both.replace("ON", f"::ripstop_mutants::on({number})", 1)
            replaced = both if replaced == m.text else both[:both.rindex(m.text)] + replaced + both[both.rindex(m.text) + len(m.text):]
        made += replaced
        for number, m in at_place[start]:
            lines[number] = (first, made.count("\n") + 1)
        at = at_place[start][0][1].end
    return made + text[at:], lines


def lay_out(mutants, dropped):
    """The tree with all mutants in it."""
    by_file = collections.defaultdict(list)
    for number, mutant in enumerate(mutants):
        by_file[mutant["path"]].append((number, mutant))
    places, kept = {}, {"src/ripstop_mutants.h", "src/ripstop/mutants.cpp"}
    for path in subprocess.check_output(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True).splitlines():
        kept.add(path)
        if not (ROOT / path).is_file():
            continue
        text = (ROOT / path).read_bytes()
        if path in by_file:
            by_place = sorted(by_file[path], key=lambda n: n[1]["m"].start)
            source, places[path] = mutated(path, by_place, dropped)
            text = source.encode()
        if path == "CMakeLists.txt":  # the last option counts: mutants cause warnings, and kernels take minutes at higher levels
            # Without the files that have mutants, unity builds would combine the others in new groups, where names may clash.
            text += b"\nset_target_properties(ripstop_text PROPERTIES UNITY_BUILD OFF)"
            text += "".join(f'\nset_property(SOURCE {p} APPEND PROPERTY COMPILE_OPTIONS "-w;-O1")' for p in sorted(by_file)).encode() + b"\n"
        put(TREE / path, text)
    put(TREE / "src/ripstop_mutants.h", HEADER.encode())
    put(TREE / "src/ripstop/mutants.cpp", CHOICE.encode())
    for folder in ("src", "tests"):
        for file in (TREE / folder).rglob("*.[ch]*"):
            if str(file.relative_to(TREE)) not in kept:
                file.unlink()
    return places


def compile_all(mutants, jobs):
    """Builds, and returns the numbers of mutants that do not compile."""
    note = WORK / "dropped.json"
    key = sha(*(m["name"] + m["of"] for m in mutants))
    dropped = set()
    if note.exists():
        earlier = json.loads(note.read_text())
        dropped = {n for n, m in enumerate(mutants) if m["name"] + m["of"] in earlier}
    while True:
        places = lay_out(mutants, dropped)
        if not (BUILD / "build.ninja").exists():
            subprocess.run(["cmake", "--preset", "release", "-DRIPSTOP_BENCH=OFF", "-DRIPSTOP_PYTHON=OFF"], cwd=TREE, check=True,
                           stdout=subprocess.DEVNULL)
        library = subprocess.run(["cmake", "--build", str(BUILD), "-j", str(jobs), "--target", "ripstop", "--", "-k", "0"],
                                 text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        (WORK / "build.log").write_text(library.stdout)
        if library.returncode == 0:
            break
        found, failed = set(), set()
        for match in re.finditer(r"(src/ripstop/\S+?\.cpp):(\d+):\d+:\s+(error|required|note)?", library.stdout):
            path, line = match.group(1), int(match.group(2))
            if match.group(3) in ("error", "required"):
                failed.add(path)
                found |= {n for n, (first, last) in places.get(path, {}).items() if first <= line <= last}
        if not found - dropped:
            found = {n for path in failed for n in places.get(path, {})}
        if not found - dropped:
            sys.exit(f"the tree does not build: {WORK / 'build.log'}")
        dropped |= found
        note.write_text(json.dumps([mutants[n]["name"] + mutants[n]["of"] for n in sorted(dropped)]))
        print(f"{len(dropped)} mutants do not compile", flush=True)
    targets = [f"test_{room}" for room in test_rooms()]
    subprocess.run(["cmake", "--build", str(BUILD), "-j", str(jobs), "--target", "ripstop_program", *targets], check=True,
                   stdout=(WORK / "build-tests.log").open("w"))
    return dropped, key


def test_rooms():
    """The folder of each test program's tests, as in tests/CMakeLists.txt."""
    return {p.parent.name: p.parent for p in sorted((ROOT / "tests").glob("*/*_test.cpp"))} | {"cartesian": ROOT / "tests/flow/cartesian"}


class Bench:
    """Runs tests in a folder of its own."""

    def __init__(self, number):
        self.place = WORK / f"worker-{number}"
        self.reached = WORK / f"reached-{number}"
        self.reached.write_bytes(bytes(65536))

    def run(self, room, tests, seconds, mutant=None):
        """(passed, failed tests or the reason, seconds); without a mutant also the mutants whose code it ran."""
        shutil.rmtree(self.place, ignore_errors=True)
        self.place.mkdir(parents=True)
        environment = dict(os.environ, TMPDIR=str(self.place), TEST_TMPDIR=str(self.place))
        if mutant is None:
            self.reached.write_bytes(bytes(65536))
            environment["RIPSTOP_MUTANTS_REACHED"] = str(self.reached)
        else:
            environment["RIPSTOP_MUTANT"] = str(mutant)
        began = time.monotonic()
        program = subprocess.Popen(["nice", "-n", "5", str(BUILD / f"tests/test_{room}"), "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)],
                                   cwd=self.place, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        why = ""
        try:
            output = program.communicate(timeout=seconds)[0].decode(errors="replace")
            failed = re.findall(r"^\[  FAILED  \] (\S+?)(?:,| \()", output, re.MULTILINE)
            began_last = re.findall(r"^\[ RUN      \] (\S+)", output, re.MULTILINE)
            if program.returncode != 0:
                why = failed[0] if failed else (began_last[-1] if began_last else tests[0])
        except subprocess.TimeoutExpired:
            os.killpg(program.pid, signal.SIGKILL)
            output = program.communicate()[0].decode(errors="replace")
            begun = re.findall(r"^\[ RUN      \] (\S+)", output, re.MULTILINE)
            why = begun[-1] if begun else tests[0]
        return why == "", why, time.monotonic() - began

    def came_by(self):
        with self.reached.open("r+b") as file, mmap.mmap(file.fileno(), 65536) as bytes_of:
            return [n for n in range(65536) if bytes_of[n]]


def all_tests():
    for room in test_rooms():
        listed = subprocess.check_output([str(BUILD / f"tests/test_{room}"), "--gtest_list_tests"], text=True)
        suite = ""
        for line in listed.splitlines():
            name = line.split("#")[0].rstrip()
            if line.startswith("  "):
                yield room, suite + name.strip()
            elif name.endswith("."):
                suite = name


def side_by_side(jobs, work, what):
    """Applies `what` to each element of `work`, with this many benches at a time."""
    benches = queue.Queue()
    for number in range(jobs):
        benches.put(Bench(number))

    def one(item):
        bench = benches.get()
        try:
            return what(bench, item)
        finally:
            benches.put(bench)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(one, item) for item in work]):
            yield done.result()


def reach(jobs, key, slowest, which):
    """The mutants whose code each test runs, by a run without a mutant, for tests named by `which` or already known."""
    sources = {room: {p.name: p.read_text() for p in sorted(folder.rglob("*.[ch]*"))} for room, folder in test_rooms().items()}

    def made_of(room, test):
        """The hash of the mutants and of the sources of the test: its file and the headers of the room."""
        suite, name = test.split(".")[0].split("/")[-1], test.split(".")[1].split("/")[0]
        own = [n for n, text in sources[room].items() if n.endswith(".cpp") and suite in text and name in text] or list(sources[room])
        return sha(key, *(text for n, text in sources[room].items() if n in own or n.endswith(".h")))

    known = json.loads(REACH.read_text()) if REACH.exists() else {}
    tests = [(room, test) for room, test in all_tests()]
    known = {name: known[name] for name in (f"{room}.{test}" for room, test in tests) if name in known}
    known = {name: entry for name, entry in known.items()
             if entry["key"] == made_of(*name.split(".", 1)) and (entry["passed"] or entry.get("limit", 0) >= slowest)}
    missing = [(room, test) for room, test in tests if f"{room}.{test}" not in known and re.search(which, f"{room}.{test}")]

    def one(bench, item):
        room, test = item
        passed, _, seconds = bench.run(room, [test], slowest)
        return item, {"key": made_of(room, test), "passed": passed, "seconds": round(seconds, 2), "by": bench.came_by(), "limit": slowest}

    for k, ((room, test), entry) in enumerate(side_by_side(jobs, missing, one)):
        known[f"{room}.{test}"] = entry
        if not entry["passed"]:
            print(f"{room}.{test}: left out, it fails or takes longer than {slowest} s", flush=True)
        if k % 20 == 0 or k + 1 == len(missing):
            REACH.write_text(json.dumps(known))
    return {name: entry for name, entry in known.items() if entry["passed"]}


def batches(mutant, number, tests, most, passed):
    """Tests that run a mutant and have not passed with it, by program: those of its room first, quick ones together."""
    by_room, left_out = collections.defaultdict(list), 0
    for name, entry in tests.items():
        if number in entry["by"] and passed.get(name) != entry["key"]:
            room, test = name.split(".", 1)
            by_room[room].append((entry["seconds"], test))
    own = {"openfoam": "flow"}.get(mutant["room"], mutant["room"])
    found = []
    for room, list_of in by_room.items():
        quick = [(s, t) for s, t in sorted(list_of) if s < 1]
        for k in range(0, len(quick), 40):
            part = quick[k:k + 40]
            found.append((room != own, False, sum(s for s, _ in part), room, [t for _, t in part]))
        found += [(room != own, True, s, room, [t]) for s, t in list_of if s >= 1]
    spent = 0
    for _, _, seconds, room, names in sorted(found, key=lambda b: (b[0] and b[1], b[0], b[2] / len(b[4]))):
        if spent + seconds > most and spent > 0:
            left_out += len(names)
            continue
        spent += seconds
        yield seconds, room, names
    if left_out:
        yield 0, "", left_out


def meet(bench, number, mutant, tests, most, earlier):
    """The verdict on a mutant, after that of an earlier run."""
    ran = dict(earlier.get("passed", {}))
    verdict = {"name": mutant["name"], "of": mutant["of"], "room": mutant["room"], "kind": mutant["m"].kind, "line": mutant["m"].line,
               "caught": False, "by": "", "tests": len(ran), "left_out": 0, "seconds": earlier.get("seconds", 0.0), "day": f"{datetime.date.today()}"}
    for seconds, room, names in batches(mutant, number, tests, most, dict(ran)):
        if not room:
            verdict["left_out"] = names
            break
        while names and not verdict["caught"]:
            passed, why, took = bench.run(room, names, 10 + SLOWER * seconds, number)
            verdict["seconds"] += took
            verdict["tests"] += len(names)
            if passed:
                ran.update({f"{room}.{name}": tests[f"{room}.{name}"]["key"] for name in names})
                break
            alone = tests.get(f"{room}.{why}", {"seconds": 5})["seconds"]
            longer = 20 + 2 * SLOWER * alone
            if took < 10 + SLOWER * seconds or (not bench.run(room, [why], longer, number)[0] and bench.run(room, [why], longer)[0]):
                verdict["caught"], verdict["by"] = True, f"{room}.{why}"
            names = [n for n in names if n != why] if why in names else []
        if verdict["caught"]:
            break
    verdict["seconds"] = round(verdict["seconds"], 1)
    if not verdict["caught"]:
        verdict["passed"] = ran
    return verdict


def read_log():
    found = {}
    if LOG.exists():
        for line in LOG.read_text().splitlines():
            entry = json.loads(line)
            found[entry["name"], entry["of"]] = entry
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--number", type=int, default=mutants_table.NUMBER, help="mutants of the sample")
    parser.add_argument("--fresh", type=int, default=0, help="as many more beyond it, which are told by themselves")
    parser.add_argument("--after", type=int, default=0, help="where in the order of the mutants the fresh ones begin (default: behind the sample)")
    parser.add_argument("--count", type=int, default=0, help="of the fresh ones only so many, picked by a hash of their names; 0: all")
    parser.add_argument("--skip", type=int, default=0, help="and without so many, the first by that hash, that were met before")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--slowest", type=float, default=mutants_table.SLOWEST, help="a test that takes longer, s, is left out")
    parser.add_argument("--tests", default="", help="only those tests whose names, room.Suite.Test, this expression finds")
    parser.add_argument("--most", type=float, default=mutants_table.MOST, help="seconds of tests, as without a mutant, that a mutant is met by")
    parser.add_argument("--again", action="store_true", help="run survivors again that are not judged equivalent or harmless")
    parser.add_argument("--table", action="store_true", help="only the table of what the log has")
    options = parser.parse_args()
    WORK.mkdir(exist_ok=True)
    options.after = max(options.after, options.number)
    asked = {m["name"] for m in all_mutants(options.number)}
    seen = {m["name"] for m in sample(options.after)} - asked
    mutants = [m for m in all_mutants(options.after + options.fresh) if m["name"] not in seen]
    log, left_out = read_log(), set()

    def pick(dropped):
        """With --skip and --count: the numbers of the other fresh ones."""
        fresh = sorted((n for n, m in enumerate(mutants) if m["name"] not in asked and n not in dropped), key=lambda n: sha(mutants[n]["name"]))
        return set(fresh) - set(fresh[options.skip:][:options.count or None])

    if options.table:
        dropped = json.loads((WORK / "dropped.json").read_text()) if (WORK / "dropped.json").exists() else []
        dropped = {n for n, m in enumerate(mutants) if m["name"] + m["of"] in dropped}
        left_out = pick(dropped)
    else:
        dropped, key = compile_all(mutants, options.jobs)
        tests = reach(options.jobs, key, options.slowest, options.tests)
        left_out = pick(dropped)
        settled = {name for name, (kind, _) in mutants_table.judged().items() if kind != "hole"}
        work = [(n, m) for n, m in enumerate(mutants) if n not in dropped | left_out and
                not (entry := log.get((m["name"], m["of"]), {})).get("caught", False) and (not entry or (options.again and m["name"] not in settled))]
        work.sort(key=lambda w: (w[1]["name"] in asked, sha(w[1]["name"])))  # the fresh ones first
        print(f"{len(mutants) - len(dropped)} mutants, {len(work)} to run, {len(tests)} tests", flush=True)
        lock = threading.Lock()
        with LOG.open("a", encoding="utf-8") as file:
            def one(bench, item):
                verdict = meet(bench, *item, tests, options.most, log.get((item[1]["name"], item[1]["of"]), {}))
                with lock:
                    file.write(json.dumps(verdict) + "\n")
                    file.flush()
                return verdict
            for verdict in side_by_side(options.jobs, work, one):
                log[verdict["name"], verdict["of"]] = verdict
                print(("caught  " if verdict["caught"] else "SURVIVED"), verdict["name"], verdict["by"], flush=True)
    mutants_table.write_both([(n, m) for n, m in enumerate(mutants) if n not in left_out], asked, dropped, log, options)


if __name__ == "__main__":
    main()
