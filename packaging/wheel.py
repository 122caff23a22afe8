#!/usr/bin/env python3
"""The Python package as a wheel that needs only Python, NumPy and the system's C and C++ library. It contains the module, the program,
their renamed libraries, materials, examples and fonts. Its tag names the oldest glibc that can load it. No network is used."""
import argparse
import os
import pathlib
import platform
import shutil
import subprocess
import sys

import libraries

ROOT = pathlib.Path(__file__).resolve().parent.parent


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--package", type=pathlib.Path, required=True, help="the built package, a folder `ripstop`")
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--project", type=pathlib.Path, required=True, help="pyproject.toml with the version")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    shutil.rmtree(options.out, ignore_errors=True)
    source = options.out / "source"
    package = source / "ripstop"
    shutil.copytree(options.package, package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "bin").mkdir()
    shutil.copy(options.program, package / "bin/ripstop")
    for data in ("materials", "examples"):
        shutil.copytree(ROOT / data, package / "data" / data)
    libraries.fonts(package / "data/fonts")
    files = [package / "bin/ripstop", *package.glob("*.so")]
    for file in files:
        libraries.run("strip", "--strip-unneeded", file)
    taken = libraries.bundle(files, package / "lib", keep_out=libraries.SYSTEM_OF_WHEELS, rename=True)
    libraries.licences(taken, package / "lib/licences")
    glibc = libraries.glibc_of([*files, *(package / "lib").glob("*.so*")])
    for file in (options.project, ROOT / "python/setup.py", ROOT / "LICENSE"):
        shutil.copy(file, source)
    tag = f"manylinux_{glibc[0]}_{glibc[1]}_{platform.machine()}"
    subprocess.run([sys.executable, "-m", "pip", "wheel", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
                    "--wheel-dir", str(options.out), str(source)], check=True, env={**os.environ, "RIPSTOP_PLATFORM": tag})


if __name__ == "__main__":
    main()
