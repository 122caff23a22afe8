"""Shared libraries of programs for other machines: finds the required ones except libc, copies them next to a program with $ORIGIN run
paths, and finds the oldest sufficient glibc."""
import hashlib
import pathlib
import re
import shutil
import subprocess

# Parts of glibc, which every system has in a version of its own.
GLIBC = re.compile(r"^(ld-linux.*|linux-vdso|lib(c|m|pthread|dl|rt|util|resolv|nsl|anl|mvec))\.so")
# PEP 600 expects these of a system with the glibc of the tag. All modules of Python in a process share one copy.
SYSTEM_OF_WHEELS = re.compile(r"^lib(stdc\+\+|gcc_s)\.so")
FONTS = pathlib.Path("/usr/share/fonts/truetype/dejavu")  # Debian's fonts-dejavu-core
FONT_LIST = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir prefix="relative">.</dir><cachedir prefix="xdg">fontconfig</cachedir></fontconfig>
"""


def run(*words):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True).stdout


def needed_by(file):
    """Paths of all shared libraries that the file loads, by name, without those of glibc."""
    found = dict(re.findall(r"^\s*(\S+) => (\S+)", run("ldd", file), re.MULTILINE))
    missing = [name for name, path in found.items() if path == "not"]
    if missing:
        raise SystemExit(f"{file} needs {', '.join(missing)}, which this machine lacks")
    return {name: pathlib.Path(path).resolve() for name, path in found.items() if not GLIBC.match(name)}


def patch(file, names, run_path):
    """New names of the needed libraries, and the run path. Several changes in one call of patchelf 0.14 damage the file."""
    for needed in run("patchelf", "--print-needed", file).split():
        if names.get(needed, needed) != needed:
            run("patchelf", "--replace-needed", needed, names[needed], file)
    run("patchelf", "--set-rpath", run_path, file)


def bundle(files, folder, keep_out=None, rename=False):
    """Copies the libraries that `files` need into `folder`, where they find each other. With `rename`, a library of the same
    name that the process has loaded before does not replace them. Returns their original paths."""
    libraries = {}
    for file in files:
        libraries |= {name: path for name, path in needed_by(file).items() if not (keep_out and keep_out.match(name))}
    folder.mkdir(parents=True)
    names = {name: name for name in libraries}
    if rename:
        digest = {name: hashlib.sha256(path.read_bytes()).hexdigest()[:8] for name, path in libraries.items()}
        names = {name: name.replace(".so", f"-{digest[name]}.so", 1) for name in libraries}
    for name, path in libraries.items():
        copy = folder / names[name]
        shutil.copy(path, copy)
        copy.chmod(0o755)
        patch(copy, names, "$ORIGIN")
        if names[name] != name:
            run("patchelf", "--set-soname", names[name], copy)
    for file in files:
        up = pathlib.Path(*[".."] * (len(file.relative_to(folder.parent).parts) - 1))
        patch(file, names, f"$ORIGIN/{up / folder.name}")
    return libraries


def licences(libraries, folder):
    """The copyright files of the Debian packages that the libraries come from."""
    folder.mkdir(parents=True)
    for path in sorted({*libraries.values(), FONTS / "DejaVuSans.ttf"}):
        owner = subprocess.run(["dpkg", "-S", str(path)], capture_output=True, text=True)
        if owner.returncode != 0:  # where /lib is a link to /usr/lib, dpkg may list the other name
            owner = subprocess.run(["dpkg", "-S", str(path).removeprefix("/usr")], capture_output=True, text=True, check=True)
        package = owner.stdout.split(":")[0]
        shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)


def fonts(folder):
    """The fonts of the pictures and their list for fontconfig; the program uses them where they are."""
    folder.mkdir(parents=True)
    for name in ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf"):
        shutil.copy(FONTS / name, folder)
    (folder / "fonts.conf").write_text(FONT_LIST)


def glibc_of(files):
    """The newest version of glibc that one of the files requires, as (major, minor)."""
    return max(tuple(map(int, version)) for file in files for version in re.findall(r"GLIBC_(\d+)\.(\d+)", run("readelf", "-V", file)))
