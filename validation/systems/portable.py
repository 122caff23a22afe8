#!/usr/bin/env python3
"""The portable archive, the wheel, the Debian packages and the image of the Containerfile in empty roots of Debian releases: `ripstop
steady` on the README's case, into docs/tables.

The roots have the packages of debootstrap alone, and for the wheel Python and NumPy; nothing has a network while it runs. As root."""
import argparse
import datetime
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import tarfile
import zipfile

import container
import debian

TABLE = debian.ROOT / "docs/tables/portable.md"
HEAD = """# Archive and wheel in empty systems

`make test-portable`, {day}, with the case of the README:

    ripstop {arguments}

The command was run without a network in empty root folders made by debootstrap (minbase). Those of the wheel also have
python3, python3-venv and python3-numpy, and those of the packages have the packages on which they depend. A wheel for
another Python was built on the release of that Python, so last digits and pictures differ.

| file | MB | system | drag, N | iterations | pictures compared with those of the build machine |
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


def parts_of(file):
    """The largest parts of an archive or a wheel with their unpacked size, for the table."""
    if file.suffix == ".whl":
        with zipfile.ZipFile(file) as wheel:
            members = [(one.filename, one.file_size) for one in wheel.infolist()]
    else:
        with tarfile.open(file) as archive:
            members = [(one.name, one.size) for one in archive if one.isfile()]
    sizes = {}
    for name, size in members:
        folders = pathlib.PurePath(name).parts[1:-1]
        part = "/".join(folders[:3]) or "module" if file.suffix == ".whl" else "/".join(folders[:4])
        sizes[part] = sizes.get(part, 0) + size
    largest = sorted(sizes.items(), key=lambda one: -one[1])[:4]
    return f"`{file.name}` unpacked: {sum(sizes.values()) / 1e6:.0f} MB, of these " + ", ".join(
        f"`{part}` {size / 1e6:.1f}" for part, size in largest) + "."


def empty_root(options, release, packages, copy="python"):
    """A root of the release; with packages, a copy of this name that has them."""
    root = options.roots / f"debian{release}-empty"
    debian.make_root(root, debian.RELEASES[release], options.mirror)
    if packages:
        full = root.with_name(f"debian{release}-{copy}")
        if not full.exists():
            subprocess.run(["cp", "-a", str(root), str(full)], check=True)
        (full / "ripstop").mkdir(exist_ok=True)
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


def trial_of_packages(options, release, files):
    """The packages installed by apt, which needs the network for other packages. Manual pages, completion and documentation are there."""
    shutil.rmtree(options.roots / f"debian{release}-packages", ignore_errors=True)
    root, work = empty_root(options, release, "ca-certificates", "packages")
    for file in files:
        shutil.copy(file, work)
    debian.run_in(root, "apt-get install -y -q --no-install-recommends ./*.deb", network=True)
    for file in ("man/man1/ripstop-steady.1.gz", "bash-completion/completions/ripstop", "zsh/vendor-completions/_ripstop",
                 "fish/vendor_completions.d/ripstop.fish", "doc/ripstop/html/index.html"):
        if not (root / "usr/share" / file).exists():
            raise SystemExit(f"the packages have not installed /usr/share/{file}")
    debian.run_in(root, "python3 -c 'import ripstop; print(ripstop.__version__, ripstop.read_case(\"my-canopy.toml\").title)'")
    debian.run_in(root, f"ripstop {options.arguments}")
    return result_of(work / "run")


def trial_of_image(options, release, archive):
    """The same in a container of the image that the archive makes. Returns the result, and the size of the image [MB]."""
    root, work = empty_root(options, release, "")
    shutil.rmtree(work)
    work = options.roots / "container"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    (work / "my-canopy.toml").write_text(case())
    container.make_base(root)
    try:
        size = container.make_image(archive)
        container.run_in(work, f"ripstop {options.arguments}")
    finally:
        container.remove()
    return result_of(work / "run"), size


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", type=pathlib.Path, nargs="+", help="archives, wheels and Debian packages; a wheel runs on the release with its Python")
    parser.add_argument("--ripstop", type=pathlib.Path, required=True, help="the program where it was built, for comparison")
    parser.add_argument("--roots", type=pathlib.Path, default=debian.CACHE)
    parser.add_argument("--mirror", default="http://deb.debian.org/debian")
    parser.add_argument("--image", action="store_true", help="also the image that packaging/Containerfile makes of the archive")
    parser.add_argument("--coarse", action="store_true", help="coarse cells and cloth, for a run of seconds")
    options = parser.parse_args()
    options.arguments = "steady my-canopy.toml --out run"
    if options.coarse:
        options.arguments += (" --set flow.box_m=[2.6,2.6,4] --set flow.cells=[20,20,30] --set flow.residual=1e-2"
                              " --set coupling.drag_tolerance=0.1 --set coupling.shape_tolerance_m=0.05"
                              " --set parachute.mesh.cloth_nodes=500 --set coupling.threads=1")
    here = options.roots / "here"
    shutil.rmtree(here, ignore_errors=True)
    here.mkdir(parents=True)
    (here / "my-canopy.toml").write_text(case())
    subprocess.run([str(options.ripstop.resolve()), *shlex.split(options.arguments)], cwd=here, check=True)
    expected = result_of(here / "run")
    packages = [file for file in options.files if file.suffix == ".deb"]
    files = [file for file in options.files if file.suffix != ".deb"]
    rows = []

    def add(name, size, release, got):
        same = "identical" if got["pictures"] == expected["pictures"] else "different"
        rows.append(f"| {name} | {size} | Debian {release} | {got['drag']} | {got['iterations']} | {same} |")
        print(rows[-1])

    for file in files:
        releases = {"cp311": ["12"], "cp313": ["13"]}[file.name.split("-")[2]] if file.suffix == ".whl" else list(debian.RELEASES)
        for release in releases:
            add(f"`{file.name}`", megabytes([file]), release, trial(options, release, file))
    if packages:
        names = ", ".join(f"`{file.name}`" for file in packages)
        add(names, megabytes(packages), release_here(), trial_of_packages(options, release_here(), packages))
    for file in [file for file in files if options.image and file.suffix != ".whl"]:
        got, size = trial_of_image(options, "13", file)
        add("image by `packaging/Containerfile`", size, "13", got)
    rows.append(f"| program on the build machine | | Debian {release_here()} | {expected['drag']} | {expected['iterations']} | |")
    day = datetime.date.today()
    head = HEAD.format(day=f"{day.day} {day:%B %Y}", arguments=options.arguments)
    parts = [parts_of(file) for file in files]
    if TABLE.exists() and f"    ripstop {options.arguments}\n" in TABLE.read_text():  # other files of the same case
        names = {row.split("|")[1] for row in rows}
        earlier = TABLE.read_text().splitlines()[len(head.splitlines()):]
        rows = [row for row in earlier if row.startswith("|") and row.split("|")[1] not in names] + rows
        names = {text.split(" ")[0] for text in parts}
        parts = [text for text in earlier if text.startswith("`") and text.split(" ")[0] not in names] + parts
    TABLE.write_text(head + "\n".join([*rows, "", *[line for text in parts for line in (text, "")]][:-1]) + "\n")


def megabytes(files):
    return f"{sum(file.stat().st_size for file in files) / 1e6:.1f}"


def release_here():
    """The number of the Debian release of this machine."""
    return re.search(r'^VERSION_ID="?([^"\n]+)', pathlib.Path("/etc/os-release").read_text(), re.MULTILINE)[1]


if __name__ == "__main__":
    main()
