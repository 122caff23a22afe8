#!/usr/bin/env python3
"""A portable archive of an installed build: program, libraries beyond libc, materials, examples, fonts and documentation in one folder,
which runs from any place without installation."""
import argparse
import pathlib
import platform
import shutil
import subprocess
import tempfile

import libraries

ROOT = pathlib.Path(__file__).resolve().parent.parent
README = """Ripstop {version} for Linux on {machine} with glibc {glibc} or newer.

    bin/ripstop --help
    bin/ripstop steady share/ripstop/examples/flat-circular/case.toml --out runs/first

Nothing has to be installed. The folder can be moved, and bin/ripstop can be linked from another place. `--flow openfoam` needs OpenFOAM of
the system. Documentation: share/doc/ripstop/index.html. Licences of the libraries: share/doc/ripstop/licences.
"""
INDEX = '<!doctype html><meta charset="utf-8"><meta http-equiv="refresh" content="0; url=site/index.html"><a href="site/index.html">Ripstop</a>\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--site", type=pathlib.Path, help="the built documentation")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    version = libraries.run(options.build / "bin/ripstop", "--version").split()[-1]
    name = f"ripstop-{version}-linux-{platform.machine()}"
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work) / name
        subprocess.run(["cmake", "--install", str(options.build), "--component", "program", "--prefix", str(folder), "--strip"], check=True,
                       stdout=subprocess.DEVNULL)
        program = folder / "bin/ripstop"
        taken = libraries.bundle([program], folder / "lib")
        documents = folder / "share/doc/ripstop"
        libraries.licences(taken, documents / "licences")
        libraries.fonts(folder / "share/ripstop/fonts")
        if options.site:
            shutil.copytree(options.site, documents / "site")
            (documents / "index.html").write_text(INDEX)
        glibc = libraries.glibc_of([program, *(folder / "lib").iterdir()])
        (folder / "README").write_text(README.format(version=version, machine=platform.machine(), glibc=".".join(map(str, glibc))))
        options.out.mkdir(parents=True, exist_ok=True)
        archive = options.out / f"{name}.tar.gz"
        subprocess.run(["tar", "--owner=0", "--group=0", "--sort=name", "-czf", str(archive), "-C", work, name], check=True)
        print(f"{archive}: {archive.stat().st_size / 1e6:.1f} MB, needs glibc {'.'.join(map(str, glibc))}; unpacked, MB:")
        for part in ("bin", "lib", "share/ripstop", "share/doc"):
            print(f"  {part:14} {sum(file.stat().st_size for file in (folder / part).rglob('*') if file.is_file()) / 1e6:6.1f}")


if __name__ == "__main__":
    main()
