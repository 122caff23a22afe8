#!/usr/bin/env python3
"""Follows the tutorials as a reader does, from their pages alone, in a fresh clone of the repository.

    make test-tutorials        (or: follow.py --ripstop build-check/bin/ripstop --python build-check/python 1 3)

Each tutorial is a page of docs/tutorials. Its files are written and its commands run in the order of the page. Tutorial 7 is followed in a
headless browser by tests/studio/tutorial.py, which presses the labels that its page names. Every line of output on
the page must be in the output of its commands or in a file of the example. The same applies to every number in its prose with three
digits or more and a decimal point.

The last digits of a coupled steady run depend on rounding, which differs between processors. Numbers in the output of such a run are
therefore compared with a relative tolerance: that of the coupling (coupling.drag_tolerance of the case of the first tutorial). Half a unit of
the last digit of both numbers is added. A drag in the prose is compared in the same way. Of a range such as "127.5 to 128.4" the run must
have a drag within it.

Writes docs/tables/tutorials.md: processor time and wall time. Exit code 1 where a page and its outputs differ.
"""

import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import tables  # pylint: disable=wrong-import-position

COMMANDS = ("ripstop", "python3", "cp", "echo", "cat")
NUMBER = re.compile(r"(?<![\w.])\d*\.\d+(?![\w.])")
RANGE = re.compile(r"(\d+\.\d+) to (\d+\.\d+)")
COUPLED = re.compile(r"\bripstop steady\b|\bripstop\.steady\(")
HEAD = ["tutorial", "commands", "numbers and lines compared", "processor s", "wall s"]


def squeezed(text):
    return re.sub(r"\s+", " ", text)


class Page:
    """A tutorial: its steps are pairs of a kind ("file", "append", "command", "output", "prose") and a text. A block without a file name
    before it is an excerpt of a file."""

    def __init__(self, path):
        text = path.read_text()
        self.steps, kind, name, block = [], "file", "", None
        self.exit_codes = {0, *map(int, re.findall(r"exit code is (\d)", text))}
        for line in text.splitlines():
            if line.startswith("```"):
                if block is not None:
                    self.steps.append((kind, (name, "\n".join(block) + "\n")) if name else ("prose", ""))
                    name = ""
                block = [] if block is None else None
            elif block is not None:
                block.append(line)
            elif line.startswith("    "):
                command = line.split()[0] in COMMANDS
                self.steps.append(("command" if command else "output", line.strip()))
            else:
                for verb, file in re.findall(r"(write|append)\b[^`]*`([^`]+)`", line.lower()):
                    kind, name = "append" if verb == "append" else "file", file
                self.steps.append(("prose", line))

    def files(self):
        """Files of the repository that the page names."""
        return set(re.findall(r"`(examples/[^`]+\.\w+)`", "\n".join(text for kind, text in self.steps if kind == "prose")))


def is_coupled(command, folder):
    """Whether a command, or the Python file that it runs, is a coupled steady run."""
    script = re.fullmatch(r"python3 (\S+\.py)", command)
    return bool(COUPLED.search((folder / script[1]).read_text() if script else command))


def half_a_unit(number):
    return 0.5 * 10.0 ** -len(number.partition(".")[2])


def is_near(number, other, tolerance):
    """Whether two numbers, as printed, differ by no more than the relative tolerance and their rounding."""
    allowed = tolerance * max(abs(float(number)), abs(float(other))) + half_a_unit(number) + half_a_unit(other)
    return abs(float(number) - float(other)) <= allowed * (1 + 1e-9)


class CoupledRuns:
    """Outputs of the coupled steady runs of a page."""

    def __init__(self, tolerance):
        self.tolerance, self.text, self.drags, self.used = tolerance, "", [], []

    def add(self, output):
        self.text += squeezed(output) + "\n"
        for line in output.splitlines():
            if line.strip().startswith("drag"):
                self.drags += NUMBER.findall(line)

    def prints_line(self, line):
        """Whether a run prints this line, with decimal numbers within the tolerance. The rest of the line must be the same."""
        numbers = NUMBER.findall(line)
        pattern = r"([\d.]+)".join(re.escape(part) for part in NUMBER.split(squeezed(line)))
        for match in re.finditer(r"(?<![\w.])" + pattern, self.text) if numbers else []:
            if all(NUMBER.fullmatch(other) and is_near(number, other, self.tolerance) for number, other in zip(numbers, match.groups())):
                self.used.append(f"{squeezed(line)}: here {match[0]}")
                return True
        return False

    def have_drag(self, number):
        near = [drag for drag in self.drags if is_near(number, drag, self.tolerance)]
        self.used += [f"{number}: here {near[0]}"] if near else []
        return bool(near)

    def have_drag_within(self, low, high):
        inside = [drag for drag in self.drags if float(low) <= float(drag) <= float(high)]
        self.used += [f"{low} to {high}: here {inside[0]}"] if inside else []
        return bool(inside)

    def report(self):
        """The lines and numbers of the page from which the run differs, but by no more than the tolerance."""
        return [f"within {100 * self.tolerance:g} % (coupling.drag_tolerance) and rounding: {text}" for text in self.used]


def tolerance_of(case, environment):
    """coupling.drag_tolerance of a case."""
    ran = subprocess.run(["ripstop", "check", case, "--resolved"], env=environment, capture_output=True, text=True, check=True)
    return float(re.search(r"^drag_tolerance = (\S+)", ran.stdout, re.MULTILINE)[1])


def follow(page, folder, environment, runs):
    """Number of commands, number of comparisons, faults, processor time [s] and wall time [s]."""
    faults, commands, compared = [], 0, 0
    outputs = [(folder / name).read_text() for name in sorted(page.files())]
    begin, used = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    for kind, text in page.steps:
        if kind in ("file", "append"):
            with open(folder / text[0], "a" if kind == "append" else "w", encoding="utf-8") as file:
                file.write(text[1])
            outputs.append(text[1])
        elif kind == "command":
            ran = subprocess.run(["sh", "-c", text], cwd=folder, env=environment, capture_output=True, text=True, check=False)
            commands += 1
            outputs += [text, ran.stdout, ran.stderr]
            if is_coupled(text, folder):
                runs.add(ran.stdout)
            if ran.returncode not in page.exit_codes:
                faults.append(f"{text}: exit code {ran.returncode}: {ran.stderr[-300:]}")
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = ended.ru_utime + ended.ru_stime - used.ru_utime - used.ru_stime, time.monotonic() - begin
    everything = squeezed("\n".join(outputs))
    for kind, text in page.steps:
        if kind == "output":
            compared += 1
            faults += [] if squeezed(text) in everything or runs.prints_line(text) else [f"no command prints: {text}"]
        elif kind == "prose":
            for number in (number for number in NUMBER.findall(text) if len(number) > 3):
                compared += 1
                found = (re.search(rf"(?<![\d.]){re.escape(number)}", everything) or runs.have_drag(number)
                         or any(number in ends and runs.have_drag_within(*ends) for ends in RANGE.findall(text)))
                faults += [] if found else [f"no command prints {number}: {text}"]
    return commands, compared, faults, seconds


def follow_in_browser(program):
    """As follow(); compared are labels that are pressed or filled in, and states of the page. The time is that of the server and its runs."""
    begin = time.monotonic()
    ran = subprocess.run([sys.executable, "-B", tables.ROOT / "tests/studio/tutorial.py", program], capture_output=True, text=True, check=False)
    seconds = time.monotonic() - begin
    if ran.returncode != 0:
        return 2, 0, [ran.stderr[-2000:]], (0, seconds)
    result = json.loads(ran.stdout)
    return 2, result["labels"] + result["compared"], [], (result["processor_s"], seconds)


FOLLOWED = "1234567"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tutorials", nargs="*", help="their numbers; default: all. A later one may need the files of the first")
    parser.add_argument("--ripstop", type=pathlib.Path, default=pathlib.Path("build-check/bin/ripstop"))
    parser.add_argument("--python", type=pathlib.Path, default=pathlib.Path("build-check/python"), help="folder of the package ripstop")
    options = parser.parse_args()
    wanted = options.tutorials or FOLLOWED
    pages = [page for page in sorted((tables.ROOT / "docs/tutorials").glob("*.md")) if page.name[0] in wanted]
    new, failed = {}, False
    with tempfile.TemporaryDirectory(prefix="ripstop-tutorials-") as name:
        clone, programs = pathlib.Path(name) / "clone", pathlib.Path(name) / "bin"
        subprocess.run(["git", "clone", "-q", tables.ROOT, clone], check=True)
        programs.mkdir()
        (programs / "ripstop").symlink_to(options.ripstop.resolve())
        (programs / "python3").symlink_to("/usr/bin/python3")
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "PYTHONPATH": str(options.python.resolve()), "RIPSTOP_DATA": str(clone)}
        first = Page(tables.ROOT / "docs/tutorials/1-first-canopy.md")
        for kind, text in first.steps:
            if kind == "file":
                (clone / text[0]).write_text(text[1])
        tolerance = tolerance_of(clone / "my-canopy.toml", environment)
        print(f"Numbers of coupled steady runs are compared with a tolerance of {100 * tolerance:g} % (coupling.drag_tolerance).", flush=True)
        for path in pages:
            in_browser = path.name == "7-design-in-the-browser.md"
            runs = CoupledRuns(tolerance)
            commands, compared, faults, (processor, wall) = (
                follow_in_browser(programs / "ripstop") if in_browser else follow(Page(path), clone, environment, runs))
            title = path.read_text().splitlines()[0].lstrip("# ")
            new[title] = [title, str(commands), str(compared), f"{processor:.0f}", f"{wall:.0f}"]
            failed = failed or bool(faults)
            print(f"{title}: {commands} commands, {compared} compared, {processor:.0f} s of the processor, {wall:.0f} s", *faults, *runs.report(),
                  sep="\n  ", flush=True)
    titles = [path.read_text().splitlines()[0].lstrip("# ") for path in sorted((tables.ROOT / "docs/tutorials").glob("*.md"))]
    rows = {row[0]: row for row in tables.rows_of("tutorials")} | new
    lines = ["The tutorials, followed from their pages in a fresh clone: each command is executed, and the numbers and lines of output on the "
             "page are compared with its output. Those of coupled steady runs are compared with the tolerance of the coupling, "
             f"{100 * tolerance:g} %. A parachute in the browser is followed in headless Chromium: the labels that the page names are "
             "pressed or filled in. The processor time is that of all threads of the commands, without the browser. The wall time includes "
             "other work on the machine. A tutorial without a row was not measured.", "",
             *tables.table(HEAD, [rows[title] for title in titles if title in rows])]
    if not failed:
        tables.write("tutorials", "Times of the tutorials", "make test-tutorials", tables.here(), lines)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
