#!/usr/bin/env python3
"""Builds the site of the documentation into build-docs/site: the pages of the repository, KaTeX, and the C++ interface by Doxygen.
It needs Debian's packages mkdocs-material, libjs-katex and doxygen, and no network. A broken link is an error."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import check_site

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
OUT = ROOT / "build-docs"
KATEX = pathlib.Path("/usr/share/javascript/katex")
LINK = re.compile(r"\]\(([^)\s]+)\)")

CPP = """# C++ library

The program is a library with a thin command line. `find_package(ripstop)` gives the target `ripstop::ripstop`;
[examples/library](../../examples/library/main.cpp) makes a canopy in code, checks it and computes its steady state. The
[map of the sources](../../src/README.md) explains the folders.

**[All public headers, classes and functions](cpp/index.html)** (made by Doxygen).
"""


def tracked():
    """Files of the work tree that git tracks or would track."""
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True)
    return sorted(name for name in names.stdout.splitlines() if (ROOT / name).exists())


def title_of(page):
    return next(line[2:] for line in page.read_text().splitlines() if line.startswith("# "))


def copy_pages(pages):
    """Copies every page, and every file that a page links, to the place that it has in the repository."""
    names = [name for name in tracked() if name.endswith(".md") and not name.startswith((".github/", "tests/"))]
    for name in names:
        text = (ROOT / name).read_text()
        target = pages / name
        target.parent.mkdir(parents=True, exist_ok=True)
        for link in LINK.findall(text):
            path = link.partition("#")[0]
            file = (ROOT / name).parent / path
            if "://" in link or not path or path.endswith(".md"):
                continue
            if file.is_dir():
                text = text.replace(f"]({link})", f"]({path.rstrip('/')}/README.md)")
            elif file.exists():
                inside = file.resolve().relative_to(ROOT)
                (pages / inside).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, pages / inside)
        title = next((line[2:] for line in text.splitlines() if line.startswith("# ")), "")
        if "`" in title:  # the navigation would show the marks of code
            text = f'---\ntitle: "{title.replace("`", "")}"\n---\n\n{text}'
        target.write_text(text)


def add_pages(pages):
    """Pages of the site alone: the list of the tables, and the entry to the C++ interface."""
    tables = sorted((pages / "docs/tables").glob("*.md"))
    rows = "".join(f"- [{title_of(page)}]({page.name})\n" for page in tables)
    (pages / "docs/tables/README.md").write_text(f"# Tables\n\nEach table names the command that made it, the machine and the day.\n\n{rows}")
    (pages / "docs/reference/cpp.md").write_text(CPP)


def add_assets(pages):
    """KaTeX with its fonts, and the site's own style and scripts."""
    folder = pages / "site"
    (folder / "katex/fonts").mkdir(parents=True)
    for name in ("katex.min.js", "katex.min.css", "contrib/auto-render.js"):
        shutil.copy(KATEX / name, folder / "katex" / pathlib.Path(name).name)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, folder / "katex/fonts")
    style = (folder / "katex/katex.min.css").read_text()
    (folder / "katex/katex.min.css").write_text(re.sub(r',\s*url\([^)]*\.(?:woff|ttf)\) format\("[a-z]+"\)', "", style))
    for name in ("ripstop.css", "equations.js", "offline.js"):
        shutil.copy(HERE / name, folder / name)


def version():
    return re.search(r"project\(\w+[^)]*VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def run_doxygen(pages):
    settings = (HERE / "Doxyfile").read_text() + f"OUTPUT_DIRECTORY = {pages}/docs/reference\nHTML_OUTPUT = cpp\nPROJECT_NUMBER = {version()}\n"
    with open(OUT / "doxygen.log", "w") as log:
        subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, text=True, check=True, stdout=log, stderr=subprocess.STDOUT)


def run_mkdocs():
    shutil.copytree(HERE / "theme", OUT / "theme")
    settings = (HERE / "mkdocs.yml").read_text()
    tutorials = sorted((ROOT / "docs/tutorials").glob("*.md"))
    listed = ", ".join(str(page.relative_to(ROOT)) for page in tutorials)
    (OUT / "mkdocs.yml").write_text(settings.replace("TUTORIALS", f"[{listed}]").replace("VERSION", version()))
    environment = {**os.environ, "PYTHONPATH": str(HERE), "PYTHONDONTWRITEBYTECODE": "1"}
    subprocess.run(["mkdocs", "build", "--quiet", "--config-file", OUT / "mkdocs.yml"], check=True, env=environment)
    for name in ("sitemap.xml", "sitemap.xml.gz"):  # for search engines of the web; the compressed one contains the time
        (OUT / "site" / name).unlink()
    index = json.loads((OUT / "site/search/search_index.json").read_text())
    script = f"var __search = {{index: Promise.resolve({json.dumps(index)})}}\n"
    (OUT / "site/site/search_index.js").write_text(script)


def build():
    shutil.rmtree(OUT, ignore_errors=True)
    pages = OUT / "pages"
    pages.mkdir(parents=True)
    copy_pages(pages)
    add_pages(pages)
    add_assets(pages)
    run_doxygen(pages)
    run_mkdocs()
    faults = check_site.faults(OUT / "site")
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"{OUT / 'site/index.html'}: {len(list((OUT / 'site').rglob('*.html')))} pages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(build())
