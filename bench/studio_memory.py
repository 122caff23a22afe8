#!/usr/bin/env python3
"""Memory of Studio's server and of its page over changes of all families at a fixed rate.

    studio_memory.py RIPSTOP [MINUTES [SECONDS]]

Every SECONDS (5) the next case is chosen in a headless browser, and one of its lengths is multiplied by 1.05 or set back.
The memory of the page is that of its JavaScript after a collection of garbage. Writes a table in Markdown."""
import json
import os
import pathlib
import shutil
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path += [str(ROOT / "tests/studio"), str(ROOT / "tests/report")]
from browser import Browser  # noqa: E402
from studio import Studio  # noqa: E402

PROGRAM, MINUTES, INTERVAL = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 60, float(sys.argv[3]) if len(sys.argv) > 3 else 5
ROWS = 13
MIB = 2**20


class Page:
    def __init__(self, folder):
        self.studio, self.browser = Studio(PROGRAM, folder), Browser(1280, 800)
        self.browser.call("Page.navigate", url=self.studio.address)
        while self.browser.evaluate("document.documentElement?.dataset.ready || ''") != "yes":
            time.sleep(0.2)
        self.browser.call("HeapProfiler.enable")
        self.begin, self.changes, self.missed = time.time(), 0, 0

    def change(self, file, key, value):
        """Whether the page showed a shape of the case in the interval."""
        shown = self.browser.evaluate("document.querySelector('[data-part=timing]').dataset.shape")
        self.browser.evaluate(f"""(async () => {{ const select = document.getElementById('case');
            if (select.value !== {json.dumps(file)}) {{ select.value = {json.dumps(file)}; select.dispatchEvent(new Event('change')); }}
            while (Studio.design().data.file !== {json.dumps(file)}) await new Promise((resolve) => setTimeout(resolve, 50));
            await Studio.design().change({json.dumps(key)}, {value}); }})()""")
        self.changes += 1
        time.sleep(max(0, self.begin + self.changes * INTERVAL - time.time()))
        self.missed += self.browser.evaluate("document.querySelector('[data-part=timing]').dataset.shape") == shown

    def row(self):
        self.browser.call("HeapProfiler.collectGarbage")
        heap = self.browser.call("Runtime.getHeapUsage")["usedSize"]
        nodes = self.browser.call("Memory.getDOMCounters")["nodes"]
        geometries = self.browser.evaluate("Studio.design().shape.section.viewer.renderer.info.memory.geometries")
        print(f"| {(time.time() - self.begin) / 60:.0f} | {self.changes} | {self.missed} | {self.studio.memory() / MIB:.0f} | {heap / MIB:.1f} | {nodes} | {geometries} |", flush=True)

    def end(self):
        self.browser.close()
        self.studio.end()


def lengths(case):
    """The lengths of a parachute that a designer would change, with their values."""
    written = case["written"]
    return [(key, float(written[key])) for key in sorted(written)
            if key.startswith("parachute.") and key.endswith("_m") and ".mesh." not in key and written[key].replace(".", "", 1).isdigit()]


def main():
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-studio-memory-"))
    for case in sorted((ROOT / "examples").glob("*/case.toml")):
        shutil.copy(case, folder / f"{case.parent.name}.toml")
    page = Page(folder)
    cases = [(path.name, lengths(page.studio.get("/api/case", file=path.name)[1])) for path in sorted(folder.glob("*.toml"))]
    print("# Memory of Studio over many changes of a design\n")
    print(f"`python3 bench/studio_memory.py build/bin/ripstop {MINUTES:g} {INTERVAL:g}`: {len(cases)} families, a change every {INTERVAL:g} s, load average "
          f"{os.getloadavg()[1]:.1f}, {time.strftime('%-d %B %Y')}. Memory of server and scripts in MiB.\n")
    print("| minute | changes | changes without a shape in time | server | scripts of the page | DOM nodes of the page | geometries of its 3D view |\n|---|---|---|---|---|---|---|")
    rows = 0
    while time.time() - page.begin < 60 * MINUTES:
        file, keys = cases[page.changes % len(cases)]
        turn = page.changes // len(cases)
        key, value = keys[turn // 2 % len(keys)]
        page.change(file, key, round((1.05, 1)[turn % 2] * value, 6))
        if time.time() - page.begin >= rows * 60 * MINUTES / (ROWS - 1):
            page.row()
            rows += 1
    page.row()
    page.end()
    shutil.rmtree(folder)


main()
