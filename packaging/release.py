#!/usr/bin/env python3
"""Collects the artefacts of a release with their checksums: archive of the sources, portable archive, wheel, Debian packages. It refuses a
tree with changes, a CHANGELOG without the release's section, and artefacts of another version; `--draft` does so for a trial."""
import argparse
import hashlib
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version_of(root):
    """The version of the project, which is in CMakeLists.txt only; all other files take it from there."""
    return re.search(r"project\(ripstop VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text())[1]


def problems(root, version):
    """Reasons why this tree is not the release `version`."""
    found = []
    changed = subprocess.run(["git", "-C", str(root), "status", "--porcelain"], capture_output=True, text=True, check=True).stdout.split("\n")
    if any(changed):
        found.append(f"the tree has changes that are not committed: {changed[0].strip()}")
    headings = re.findall(r"^## (\S+)", (root / "CHANGELOG.md").read_text(), re.MULTILINE)
    if headings[:1] != [version]:
        found.append(f"the first section of CHANGELOG.md is {headings[0] if headings else 'missing'}, not {version}")
    if not re.search(rf"^version: {re.escape(version)}$", (root / "CITATION.cff").read_text(), re.MULTILINE):
        found.append(f"CITATION.cff is not of version {version}")
    return found


def artefacts(build, version):
    """The built files by kind. Each kind must be there, and in this version alone."""
    kinds = {"portable archive": "portable/ripstop-*-linux-*.tar.gz", "wheel": "wheel*/ripstop-*.whl", "Debian package": "*.deb",
             "Debian package of the documentation": "ripstop-doc_*.deb"}
    files, missing = set(), []
    for kind, pattern in kinds.items():
        found = sorted(build.glob(pattern))
        if not found:
            missing.append(f"{build}/{pattern}: there is no {kind}; run `make release`")
        missing += [f"{file.name} is not of version {version}" for file in found if not re.search(rf"[-_]{re.escape(version)}[-_]", file.name)]
        files.update(found)
    return sorted(files), missing


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="the sources")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--draft", action="store_true", help="only warn of a tree that is not a release")
    options = parser.parse_args()
    version = version_of(options.root)
    files, wrong = artefacts(options.build, version)
    not_released = problems(options.root, version)
    for text in wrong + not_released:
        print(("Warning: " if text in not_released and options.draft else "Error: ") + text)
    if wrong or (not_released and not options.draft):
        raise SystemExit(1)
    shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True)
    source = options.out / f"ripstop-{version}-source.tar.gz"
    subprocess.run(["git", "-C", str(options.root), "archive", "--format=tar.gz", f"--prefix=ripstop-{version}/", "-o", str(source.resolve()), "HEAD"],
                   check=True)
    for file in files:
        shutil.copy(file, options.out)
    sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in sorted(options.out.iterdir())]
    (options.out / "SHA256SUMS").write_text("".join(sums))
    for file in sorted(options.out.iterdir()):
        print(f"{file}: {file.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
