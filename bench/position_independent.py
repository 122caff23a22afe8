#!/usr/bin/env python3
"""Compares the instructions of the kernels of two builds: docs/tables/position-independent.md.

    python3 bench/position_independent.py build-check build-fixed
"""
import difflib
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
KERNELS = ("src/ripstop/cloth", "src/ripstop/flow/cartesian")


def instructions(build, file):
    """The names of the instructions in order, without operands, because addresses and registers may differ."""
    objects = pathlib.Path(build, "CMakeFiles/ripstop.dir", file + ".o")
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", objects], capture_output=True, text=True, check=True).stdout
    return [line.split("\t")[1].split()[0] for line in text.splitlines() if "\t" in line and line.split("\t")[1].strip()]


def main(one, other):
    total = every = 0
    print("| file | instructions | differ |\n|---|---|---|")
    for source in sorted(source for folder in KERNELS for source in (SOURCE / folder).glob("*.cpp")):
        file = str(source.relative_to(SOURCE))
        a, b = instructions(one, file), instructions(other, file)
        total += len(a)
        lines = [] if a == b else difflib.unified_diff(a, b, n=0, lineterm="")
        differ = sum(line[0] in "+-" and not line.startswith(("+++", "---")) for line in lines)
        every += differ
        if differ:
            print(f"| {file} | {len(a)} | {differ} |")
    print(f"| all | {total} | {every} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
