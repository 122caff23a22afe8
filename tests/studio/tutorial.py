#!/usr/bin/env python3
"""Follows tutorial 7, A parachute in the browser, step by step: controls are found by the labels that its page names.

    tutorial.py RIPSTOP [PICTURES]

Prints the number of labels used, the number of comparisons and the processor time of the server with its runs [s] as JSON. With PICTURES the
screenshots of the page are written to that folder."""
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import time

from studio import ROOT, Studio

sys.path.insert(0, str(ROOT / "tests/report"))
from browser import Browser  # noqa: E402

PAGE = (ROOT / "docs/tutorials/7-design-in-the-browser.md").read_text()
LABELS = set(re.findall(r"(?<!\*)\*([^*]+)\*(?!\*)", PAGE.replace("\n", " ")))
LIMIT = 3000  # [s] of one step, on a machine of any speed


class Tutorial:
    def __init__(self, program, pictures):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-tutorial-")) / "my-parachutes"
        self.folder.mkdir()
        self.studio, self.pictures = Studio(program, self.folder), pictures
        self.browser = Browser(1280, 800)
        self.browser.width(1280, 800)
        self.browser.theme("light")
        self.compared, self.used = 0, set()

    def until(self, expression):
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            if value := self.browser.evaluate(expression):
                return value
            time.sleep(0.2)
        raise RuntimeError(f"not reached: {expression}; page: {self.browser.evaluate('document.body.innerText')[:2000]}")

    def check(self, what, expression):
        self.compared += 1
        if not self.browser.evaluate(expression):
            raise RuntimeError(f"{what}: {expression}; page: {self.browser.evaluate('document.body.innerText')[:2000]}")

    def named(self, label):
        if label not in LABELS:
            raise RuntimeError(f"the page of the tutorial does not name {label}")
        self.used.add(label)
        return json.dumps(label)

    ROOT = "(document.getElementById('create').open ? document.getElementById('create') : document)"

    def press(self, label, within=ROOT):
        """A button or a tab that is shown."""
        name = self.named(label)
        find = f"[...{within}.querySelectorAll('button')].find((one) => one.textContent === {name} && one.offsetParent !== null)"
        self.until(f"({find}) !== undefined")
        self.browser.evaluate(f"({find}).click()")

    def field(self, label, value=None):
        """The control next to a label that is shown; with a value that is then entered."""
        name = self.named(label)
        find = f"[...{self.ROOT}.querySelectorAll('label')].filter((one) => one.textContent.trim().startsWith({name}) && one.offsetParent !== null).map((one) => one.htmlFor ? document.getElementById(one.htmlFor) : one.querySelector('input, select'))[0]"
        self.until(f"Boolean({find})")
        if value is not None:
            self.browser.evaluate(f"(() => {{ const i = {find}; i.value = {json.dumps(value)}; i.dispatchEvent(new Event('change')); }})()")
        return find

    def key(self, group, label, value):
        """A key in a group of the form, once the file has been read again."""
        self.named(label)
        version = self.browser.evaluate("Studio.design().data.version")
        find = f"[...document.querySelectorAll('[data-group={json.dumps(group)}] label')].find((one) => one.textContent.startsWith({json.dumps(label)}))"
        self.browser.evaluate(f"(() => {{ const i = document.getElementById(({find}).htmlFor); i.value = {json.dumps(value)}; i.dispatchEvent(new Event('change')); }})()")
        self.until(f"Studio.design().data.version !== {json.dumps(version)}")

    def settled(self, file="my-canopy.toml"):
        self.until(f"document.querySelector('[data-part=loads]').dataset.file === {json.dumps(file)}")
        self.until("[...document.querySelectorAll('.panes section:not([hidden]) [data-part=timing]')].every((one) => ['equilibrium', 'final'].includes(one.dataset.state))")
        self.until("Studio.design().packed > 0")

    def picture(self, name):
        if name not in PAGE:
            raise RuntimeError(f"the page of the tutorial does not show {name}")
        if self.pictures:
            self.browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 300))))")
            self.browser.screenshot(self.pictures / name)

    def open_studio(self):
        self.browser.call("Page.navigate", url=self.studio.address)
        self.until("document.documentElement?.dataset.ready === 'yes'")
        self.until("document.getElementById('create').open && document.querySelector('#create-drawing img')?.naturalWidth > 0")
        for label, value in (("Payload mass", "2.4"), ("Descent rate", "5"), ("Largest deployment speed", "20")):
            self.check("the value of the page", f"({self.field(label)}).value === {json.dumps(value)}")
        self.picture("studio-new.png")
        self.press("Create")
        self.settled()
        self.check("the new case", "document.getElementById('case').value === 'my-canopy.toml'")

    def look(self):
        self.picture("studio-design.png")
        length = self.browser.evaluate("Studio.design().data.check.case.parachute.lines.length_m")
        self.key("parachute.lines", "length", "2.0")
        self.check("the new length", "Studio.design().data.check.case.parachute.lines.length_m === 2")
        self.press("Undo")
        self.until(f"Studio.design().data.check.case.parachute.lines.length_m === {length}")
        self.key("parachute", "gores", "-3")
        self.check("the range at the field", "document.querySelector('[data-key=\"parachute.gores\"] .problem').textContent.includes('at least')")
        self.press("Undo")
        self.until("Studio.design().data.check.valid")

    def compare(self):
        self.press("Copy")
        self.until("[...document.querySelectorAll('[data-control=against] option')].some((one) => one.value === 'my-canopy-2.toml')")
        self.browser.evaluate("document.querySelector('#notice button').click()")
        self.key("parachute", "vent diameter", "0.5")
        self.field("Compare with", "my-canopy-2.toml")
        self.until("document.querySelector('[data-part=loads]').dataset.against === 'my-canopy-2.toml' && Studio.design().otherPacked > 0")
        self.settled()
        self.check("difference of the vents", "[...document.querySelectorAll('[data-part=facts] tr')].some((row) => row.textContent.startsWith('vent') && row.textContent.includes('%'))")
        self.picture("studio-compare.png")
        self.named("no other")
        self.field("Compare with", "")
        self.press("Undo")
        self.settled()

    def run(self):
        self.press("Runs")
        self.named("Steady flow")
        self.field("Cells", "48,48,64")
        self.press("Start")
        self.until("!['queued', 'running'].includes(document.querySelector('[data-job]')?.dataset.state ?? 'queued')")
        self.check("the run", "document.querySelector('[data-job]').dataset.state === 'finished'")
        self.until("document.querySelector('[data-plot=forces] canvas') !== null && document.querySelector('[data-part=detail] .stage canvas') !== null")
        self.picture("studio-runs.png")
        self.press("Report", "document.querySelector('[data-job]')")
        self.until("document.querySelector('#view-report')?.dataset.loaded === 'my-canopy-steady'")
        self.picture("studio-report.png")

    def cut_and_export(self):
        self.press("Pattern")
        self.until("document.querySelector('[data-piece] img')?.naturalWidth > 0")
        self.picture("studio-pattern.png")
        self.press("Save as DXF, SVG and PDF (A4)")
        self.until("document.querySelector('#view-pattern [role=status]').textContent.includes('saved in')")
        saved = {path.suffix for path in (self.folder / "my-canopy-pattern").iterdir()}
        self.check("the files of the pattern", json.dumps({".dxf", ".svg", ".pdf"} <= saved and (self.folder / "my-canopy-pattern/bill.csv").exists()))
        self.press("Runs")
        self.press("RocketPy")
        self.until("document.querySelector('.log').textContent.includes('def add_to(rocket)')")
        self.check("the name of the file", "document.querySelector('[data-part=detail] h2').textContent.startsWith('my-canopy-steady.py')")

    def processor_time(self):
        """Of the server and the commands that have ended [s]."""
        fields = pathlib.Path(f"/proc/{self.studio.process.pid}/stat").read_text().rpartition(")")[2].split()
        return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")

    def end(self):
        self.browser.close()
        self.studio.end()
        shutil.rmtree(self.folder.parent)


def main():
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    tutorial = Tutorial(sys.argv[1], pictures)
    try:
        for step in (tutorial.open_studio, tutorial.look, tutorial.compare, tutorial.run, tutorial.cut_and_export):
            step()
        if errors := [error for error in tutorial.browser.errors if "400" not in error]:
            raise RuntimeError(f"errors of the page: {errors}")
        print(json.dumps({"labels": len(tutorial.used), "compared": tutorial.compared, "processor_s": tutorial.processor_time()}))
    finally:
        tutorial.end()


if __name__ == "__main__":
    main()
