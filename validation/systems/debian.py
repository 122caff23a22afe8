#!/usr/bin/env python3
"""The README's two commands, `make demo` and `make check`, in a root of another Debian release: a row of docs/tables/systems.md. With
--wheel only `make wheel`, for the Python of that release.

debootstrap makes the root once, from the packages of the release alone. A clean clone of this repository's last commit is built and
tested in it by chroot. Packages come from apt; after their installation the commands have no network. Run it as root."""
import argparse
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TABLE = ROOT / "docs/tables/systems.md"
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "ripstop/systems"
RELEASES = {"12": "bookworm", "13": "trixie"}
ENVIRONMENT = {"HOME": "/root", "PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LANG": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}

HEAD = """# Systems on which the README's commands pass

`make test-debian13` and `make test-debian12`: an empty root of the release by debootstrap, its own packages, a clean clone. Build and
tests are `make check` (all targets, warnings are errors, all tests); the demo is `make demo` with its own build of the program.
Two of the skipped tests do not apply to their type of canopy; the others need OpenFOAM ([reason](../guide/openfoam.md)).

| system | compiler | build, s | tests | tests, s | demo, s | machine and day |
|---|---|---|---|---|---|---|
"""


def make_root(root, release, mirror):
    """An empty root of the release, which takes its name only when it is complete."""
    if root.exists():
        return
    part = root.with_name(root.name + ".part")
    shutil.rmtree(part, ignore_errors=True)
    part.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["debootstrap", "--variant=minbase", release, str(part), mirror], check=True, stdout=subprocess.DEVNULL)
    part.rename(root)


def clone_tree(root):
    """The last commit of this repository as /ripstop of the root."""
    shutil.rmtree(root / "ripstop", ignore_errors=True)
    subprocess.run(["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(root / "ripstop")], check=True)


# Own mounts, which end with the process. Without a network there is the loopback only, which Open MPI needs.
ENTER = """set -e
mount -t proc proc "$0/proc"
mount --rbind /dev "$0/dev"
mount --rbind /sys "$0/sys"
ip link set lo up
exec chroot "$0" /bin/sh -c "cd /ripstop && $1"
"""


def run_in(root, command, network=False, log=None):
    """Runs a shell command in /ripstop of the root, returns the seconds; a failure ends the program with the command's exit code."""
    print(f"-- {command}", flush=True)
    if network:
        shutil.copy("/etc/resolv.conf", root / "etc/resolv.conf")
    start = time.monotonic()
    alone = ["unshare", "--mount", *([] if network else ["--net"])]
    done = subprocess.Popen([*alone, "sh", "-c", ENTER, str(root), command], env=ENVIRONMENT, text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    lines = []
    for line in done.stdout:
        print(line, end="", flush=True)
        lines.append(line)
    if log is not None:
        log += lines
    if done.wait() != 0:
        print(f"{command}: exit code {done.returncode} in {root}")
        raise SystemExit(done.returncode)
    return time.monotonic() - start


def make_wheel(root, release, jobs):
    """The wheel for the Python of the root, copied to build/wheel-debian13 (or 12) of this repository, where `make release` finds it."""
    run_in(root, f"make wheel JOBS={jobs}", network=True)
    folder = ROOT / f"build/wheel-debian{release}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for file in (root / "ripstop/build/wheel").glob("*.whl"):
        print(shutil.copy(file, folder))


def processor():
    name = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return f"{name[1] if name else 'unknown'}, {len(os.sched_getaffinity(0))} cores"


def write_row(system, row):
    """Adds or replaces the row of one system."""
    rows = TABLE.read_text().splitlines()[len(HEAD.splitlines()):] if TABLE.exists() else []
    rows = sorted([old for old in rows if old.startswith("| ") and not old.startswith(f"| {system} |")] + [row])
    TABLE.write_text(HEAD + "\n".join(rows) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("release", choices=RELEASES)
    parser.add_argument("--root", type=pathlib.Path, help="the root; it is made when it does not exist, and used again")
    parser.add_argument("--mirror", default="http://deb.debian.org/debian")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--ccache", action="store_true", help="compile through ccache, for repeated runs: no row in the table")
    parser.add_argument("--tests", metavar="REGEX", help="only these tests: no row in the table")
    parser.add_argument("--wheel", action="store_true", help="only the wheel for the Python of this release, into build/wheel-debian13 (or 12)")
    options = parser.parse_args()
    if os.geteuid() != 0:
        raise SystemExit("chroot needs root: run this as root or with sudo")
    root = (options.root or CACHE / f"debian{options.release}").resolve()
    make_root(root, RELEASES[options.release], options.mirror)
    clone_tree(root)
    if options.ccache:  # also for sources that include precompiled headers
        ENVIRONMENT["CCACHE_SLOPPINESS"] = "pch_defines,time_macros,include_file_mtime,include_file_ctime"

    run_in(root, "apt-get update -q && apt-get install -y -q make git" + (" ccache" if options.ccache else ""), network=True)
    if options.wheel:
        make_wheel(root, options.release, options.jobs)
        return
    packages = run_in(root, "make check-deps", network=True)
    demo = 0 if options.tests else run_in(root, f"make demo JOBS={options.jobs}")
    log = []
    if options.tests:
        run_in(root, f"make format-check && cmake --preset release && cmake --build --preset release -j {options.jobs}")
        run_in(root, f"ctest --preset release -j {options.jobs} -R '{options.tests}'")
    else:
        check = run_in(root, f"make check JOBS={options.jobs}", log=log)
    if options.ccache or options.tests:
        return
    text = "".join(log)
    tests = float(re.search(r"Total Test time \(real\) =\s*([\d.]+) sec", text)[1])
    skipped = len(re.findall(r"\*\*\*Skipped", text))
    passed = int(re.search(r"tests passed, 0 tests failed out of (\d+)", text)[1]) - skipped
    compiler = subprocess.run(["chroot", str(root), "c++", "-dumpfullversion"], capture_output=True, text=True, check=True).stdout.strip()
    day = datetime.date.today()
    system = f"Debian {options.release}"
    write_row(system, f"| {system} | g++ {compiler} | {check - tests:.0f} | {passed} passed, {skipped} skipped | {tests:.0f} | "
              f"{demo:.0f} | {processor()}; {day.day} {day:%B %Y} |")
    print(f"packages {packages:.0f} s, demo {demo:.0f} s, build {check - tests:.0f} s, tests {tests:.0f} s: docs/tables/systems.md")


if __name__ == "__main__":
    main()
