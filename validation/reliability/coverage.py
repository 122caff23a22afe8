#!/usr/bin/env python3
"""Writes the lines of src/ that the tests run into docs/tables/coverage.md, by gcov from the objects in build-coverage/.

    make coverage

The tests with OpenFOAM and those in Python are left out. A line counts once, although templates and kernels of several instruction
sets are compiled several times; a header counts in every file that includes it.
"""
import collections
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent))
import tables  # pylint: disable=wrong-import-position

BUILD = ROOT / "build-coverage"


def lines_run():
    """{file: {line: whether a test runs it}} of src/."""
    found = collections.defaultdict(lambda: collections.defaultdict(bool))
    for notes in sorted(note for part in ("ripstop", "ripstop_text") for note in (BUILD / f"CMakeFiles/{part}.dir").rglob("*.gcno")):
        told = subprocess.run(["gcov-12", "--json-format", "--stdout", str(notes)], cwd=BUILD, text=True, check=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
        for report in map(json.loads, told.splitlines()):
            for file in report["files"]:
                path = (BUILD / file["file"]).resolve()
                if not path.is_relative_to(ROOT / "src"):
                    continue
                for line in file["lines"]:
                    found[str(path.relative_to(ROOT / "src/ripstop"))][line["line_number"]] |= line["count"] > 0
    return found


def main():
    found = lines_run()
    if not any(any(lines.values()) for lines in found.values()):
        sys.exit("no test has run in build-coverage/")
    rows, rooms = [], collections.defaultdict(lambda: [0, 0])

    def row(name, run, all_of):
        return [name, str(all_of), str(run), f"{100 * run / all_of:.1f} %"]

    for path, lines in sorted(found.items()):
        run, all_of = sum(lines.values()), len(lines)
        rows.append(row(path, run, all_of))
        for name in (path.split("/")[0], "all"):
            rooms[name][0] += run
            rooms[name][1] += all_of
    head = ["room or file", "lines", "executed", "share"]
    in_all = rooms.pop("all")
    lines = tables.table(head, [*(row(name, *rooms[name]) for name in sorted(rooms)), row("all", *in_all)])
    lines += ["## By file", "", *tables.table(head, rows)]
    tables.write("coverage", "Lines of the sources that the tests execute, without those of OpenFOAM", "make coverage",
                 tables.here(), lines)
    print(f"{100 * in_all[0] / in_all[1]:.1f} % of {in_all[1]} lines")


if __name__ == "__main__":
    main()
