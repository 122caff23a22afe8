#!/usr/bin/env python3
"""The portable archive and the wheel in empty roots of Debian releases: `ripstop steady` on the README's case, into docs/tables.

The roots have the packages of debootstrap alone, and for the wheel Python and NumPy; nothing has a network while it runs. As root."""
import argparse
import datetime
import json
import pathlib
import re
import shlex
import shutil
import subprocess

import debian

TABLE = debian.ROOT / "docs/tables/portable.md"
HEAD = """# Archive and wheel in empty systems

`make test-portable`, {day}. `ripstop {arguments}` with the case of the README, in roots that debootstrap made (minbase),
without a network; for the wheel with python3, python3-venv and python3-numpy.

| file | MB | system | drag, N | iterations | pictures as where it was built |
|---|---|---|---|---|---|
"""


def case():
    return re.search(r"```toml\n(.*?)```", (debian.ROOT / "README.md").read_text(), re.DOTALL)[1]


def result_of(folder):
    """Drag, number of iterations and bytes of the pictures of a finished run."""
    result = json.loads((folder / "result.json").read_text())
    if not result["converged"]:
        raise SystemExit(f"{folder} has not converged")
    return {"drag": f"{result['drag_n']:.4f}", "iterations": result["coupling_iterations"],
            "pictures": {path.name: path.read_bytes() for path in sorted(folder.rglob("*.png"))}}


def empty_root(options, release, packages):
    """A root of the release; with packages, a copy that has them."""
    root = options.roots / f"debian{release}-empty"
    debian.make_root(root, debian.RELEASES[release], options.mirror)
    if packages:
        full = root.with_name(f"debian{release}-python")
        if not full.exists():
            subprocess.run(["cp", "-a", str(root), str(full)], check=True)
        debian.run_in(full, f"apt-get update -q && apt-get install -y -q --no-install-recommends {packages}", network=True)
        root = full
    work = root / "ripstop"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    (work / "my-canopy.toml").write_text(case())
    return root, work


def trial(options, release, file):
    """Runs the program of an archive or of a wheel in an empty root."""
    wheel = file.suffix == ".whl"
    root, work = empty_root(options, release, "python3 python3-venv python3-numpy" if wheel else "")
    shutil.copy(file, work)
    if wheel:
        debian.run_in(root, f"python3 -m venv --system-site-packages venv && venv/bin/pip install -q --no-index {file.name}")
        debian.run_in(root, "venv/bin/python -c 'import ripstop; print(ripstop.__version__, ripstop.read_case(\"my-canopy.toml\").title)'")
        program = "venv/bin/ripstop"
    else:
        debian.run_in(root, f"tar -xf {file.name} && ln -s ripstop-*/bin/ripstop ripstop")
        program = "./ripstop"
    debian.run_in(root, f"{program} {options.arguments}")
    return result_of(work / "run")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", type=pathlib.Path, nargs="+", help="archives and wheels; a wheel runs on the release with its Python")
    parser.add_argument("--ripstop", type=pathlib.Path, required=True, help="the program where it was built, for comparison")
    parser.add_argument("--roots", type=pathlib.Path, default=debian.CACHE)
    parser.add_argument("--mirror", default="http://deb.debian.org/debian")
    parser.add_argument("--coarse", action="store_true", help="coarse cells and cloth, for a run of seconds")
    options = parser.parse_args()
    options.arguments = "steady my-canopy.toml --out run"
    if options.coarse:
        options.arguments += (" --set flow.box_m=[2.6,2.6,4] --set flow.cells=[20,20,30] --set flow.residual=1e-2"
                              " --set coupling.drag_tolerance=0.1 --set coupling.shape_tolerance_m=0.05"
                              " --set parachute.mesh.cloth_nodes=500 --set coupling.threads=1")
    here = options.roots / "here"
    here.mkdir(parents=True, exist_ok=True)
    (here / "my-canopy.toml").write_text(case())
    subprocess.run([str(options.ripstop.resolve()), *shlex.split(options.arguments)], cwd=here, check=True)
    expected = result_of(here / "run")
    rows = []
    for file in options.files:
        releases = {"cp311": ["12"], "cp313": ["13"]}[file.name.split("-")[2]] if file.suffix == ".whl" else list(debian.RELEASES)
        for release in releases:
            got = trial(options, release, file)
            same = "the same bytes" if got["pictures"] == expected["pictures"] else "different"
            rows.append(f"| `{file.name}` | {file.stat().st_size / 1e6:.1f} | Debian {release} | {got['drag']} | {got['iterations']} | {same} |")
            print(rows[-1])
    rows.append(f"| the program where it was built | | {' '.join(platform_here())} | {expected['drag']} | {expected['iterations']} | |")
    day = datetime.date.today()
    head = HEAD.format(day=f"{day.day} {day:%B %Y}", arguments=options.arguments)
    if TABLE.exists() and f"`ripstop {options.arguments}`" in TABLE.read_text():  # other files of the same case
        names = {row.split("|")[1] for row in rows}
        rows = [row for row in TABLE.read_text().splitlines()[len(head.splitlines()):] if row.split("|")[1] not in names] + rows
    TABLE.write_text(head + "\n".join(rows) + "\n")


def platform_here():
    return re.findall(r'^(?:ID|VERSION_ID)="?([^"\n]+)', pathlib.Path("/etc/os-release").read_text(), re.MULTILINE)


if __name__ == "__main__":
    main()
