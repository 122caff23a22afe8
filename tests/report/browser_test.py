#!/usr/bin/env python3
"""The report in a browser: it opens without an error or a request, shows the numbers of result.json, and its controls work.

    browser_test.py RIPSTOP TEST_REPORT [FOLDER]

RIPSTOP is the program, and TEST_REPORT the test program of the room, which makes the page with 50,000 moving nodes. Screenshots are written to FOLDER."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from browser import Browser

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CASE = str(ROOT / "examples/stratos-iv/case.toml")
PROGRAM, TESTS = sys.argv[1:3]
PICTURES = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
SMALL = ["--set", "parachute.mesh.cloth_nodes=1000", "--set", "coupling.threads=1", "--set", "parachute.mesh.line_segment_m=0.3"]
STEADY = ["--speed", "10", "--grid", "16,16,24", "--set", "coupling.shape_tolerance_m=1e-3", *SMALL]
OPENING = ["--pressure", "300", "--set", "parachute.lines.count=6", "--set", "parachute.mesh.folds=6", "--set", "inflation.initial_radius_m=0.2",
           "--set", "inflation.duration_s=0.008", "--set", "inflation.frames=8", "--set", "inflation.line_segment_m=0.3", *SMALL]
FLIGHT = ["--deploy", "--mass", "0.8", "--speed", "8", "--duration", "0.03", "--cells-across", "12", "--set", "flight.shapes_per_s=200",
          "--set", "inflation.initial_radius_m=0.12", "--set", "inflation.duration_s=0.02", "--set", "inflation.frames=4", "--threads", "1",
          "--set", "parachute.mesh.cloth_nodes=500", "--set", "parachute.mesh.line_segment_m=0.25"]


def ripstop(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise RuntimeError(f"ripstop {' '.join(arguments)}: {done.stderr}")
    return done.stdout


def number(text):
    return float(text.replace("−", "-"))


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-report-"))
        hostile = (ROOT / "examples/stratos-iv/case.toml").read_text().replace(
            'title = "', "title = \"<img src=x onerror=alert(1)></script><script>document.title='taken'</script> ", 1)
        (cls.folder / "case.toml").write_text(hostile)
        cls.steady, cls.opening, cls.both = cls.folder / "steady", cls.folder / "opening", cls.folder / "both.html"
        cls.said = ripstop("steady", str(cls.folder / "case.toml"), *STEADY, "--out", str(cls.steady))
        ripstop("inflate", CASE, *OPENING, "--out", str(cls.opening))
        cls.flight = cls.folder / "flight"
        ripstop("fly", str(ROOT / "examples/flat-circular/case.toml"), *FLIGHT, "--out", str(cls.flight))
        ripstop("report", str(cls.steady), str(cls.opening), "--out", str(cls.both))
        cls.dome = cls.folder / "dome.html"
        subprocess.run([TESTS, "--gtest_filter=ReportPage.WithFiftyThousand*"], env={**os.environ, "RIPSTOP_DOME": str(cls.dome)},
                       stdout=subprocess.DEVNULL, check=True)
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        shutil.rmtree(cls.folder)

    def open(self, file):
        self.browser.requests.clear()
        self.browser.errors.clear()
        self.assertEqual(self.browser.open(file), "yes")

    def tearDown(self):
        if PICTURES:
            self.browser.screenshot(PICTURES / f"{self._testMethodName}.png")
        self.assertEqual(self.browser.errors, [])
        others = [url for url in self.browser.requests if not url.startswith(("file://" + str(self.folder), "data:", "blob:"))]
        self.assertEqual(others, [])
        self.assertLessEqual(len([url for url in self.browser.requests if url.startswith("file:")]), 1)

    def js(self, expression):
        return self.browser.evaluate(expression)

    def check_values(self, folder):
        result = json.loads((folder / "result.json").read_text())
        shown = self.js("Object.fromEntries([...Page.shown().node.querySelectorAll('tr[data-key]')].map((r) => [r.dataset.key, r.cells[1].innerText]))")
        plain = {key: value for key, value in result.items() if not isinstance(value, dict) and key != "title" and value is not None}
        self.assertGreater(len(plain), 20)
        note = self.js("[...Page.shown().node.querySelectorAll('[data-part=warnings] li')].map((one) => one.innerText)")
        for warning in plain.pop("warnings"):
            self.assertIn(warning, note)
        for key, value in plain.items():
            texts = shown[key].split(", ") if isinstance(value, list) else [shown[key]]
            for text, one in zip(texts, value if isinstance(value, list) else [value]):
                if isinstance(one, bool) or isinstance(one, str):
                    self.assertEqual(text, {True: "yes", False: "no"}.get(one, one) if isinstance(one, bool) else one)
                else:
                    self.assertAlmostEqual(number(text), one, delta=5.01e-5 * abs(one), msg=key)
        return result

    def test_a_flight_has_path_force_and_angles_on_one_time_axis(self):
        self.open(self.flight / "report.html")
        self.assertIn("Flight", self.js("Page.shown().node.querySelector('p.muted').innerText"))
        times = self.js("Page.shown().run.shape.frames.map((frame) => frame.time)")
        self.assertEqual(times, sorted(times))
        self.assertEqual(times[0], 0)
        self.assertAlmostEqual(times[-1], 0.05, places=6)
        self.assertEqual(self.js("Page.shown().run.plots[0].series.map((series) => series.name)"), ["inflation", "flight"])
        self.assertEqual(self.js("[...document.querySelectorAll('.wide-plot')].map((plot) => plot.dataset.plot)"), ["load", "angle"])
        for share in (0.3, 0.7, 1):  # the path ends at the payload
            self.js(f"Page.shown().clock.set({share} * Page.shown().clock.end)")
            gap = self.js("""(() => {
                const canopy = Page.shown().controls.canopy, anchor = 3 * canopy.shape.path.anchor, { array } = canopy.trail.head;
                let nearest = Infinity;
                for (let s = 0; s < array.length; s += 3)
                    nearest = Math.min(nearest, Math.hypot(...[0, 1, 2].map((c) => canopy.trail.tail.array[s + c] - canopy.points[anchor + c])));
                return nearest; })()""")
            self.assertLess(gap, 1e-4)

    def test_a_steady_run_shows_what_its_result_says(self):
        self.assertTrue(self.said.rstrip().endswith(str(self.steady / "report.html")), self.said)
        self.open(self.steady / "report.html")
        result = self.check_values(self.steady)
        ledger = self.js("[...document.querySelectorAll('[data-table=ledger] tbody tr')].map((row) => row.cells[1].innerText)")
        self.assertEqual([round(number(text), 3) for text in ledger], [round(float(f"{value:.5g}"), 3) for value in result["ledger"].values()])
        self.assertIn("cloth_nodes", self.js("document.querySelector('[data-part=case]').textContent"))

    def test_numbers_have_no_exponent_where_digits_fit_and_no_digits_of_rounding(self):
        self.open(self.steady / "report.html")
        self.assertEqual(self.js("Numbers.shown(26390.4, 4)"), "26390")
        self.assertEqual(self.js("Numbers.shown(9999.7, 4)"), "10000")
        self.assertEqual(self.js("Numbers.shown(263.904, 4)"), "263.9")
        self.assertEqual(self.js("Numbers.rounded('[2.8000000000000003, 4], 1e-3')"), "[2.8, 4], 1e-3")
        self.assertEqual(self.js("Tables.comparison({columns: [], rows: [['moment', 'N m', '-0.001', '0.0048']]}).innerText.includes('%')"), False)

    def test_names_of_a_case_stay_text(self):
        self.open(self.steady / "report.html")
        title = self.js("document.getElementById('title').textContent")
        self.assertIn("</script><script>", title)
        self.assertEqual(self.js("document.title"), title)
        self.assertEqual(self.js("document.querySelectorAll('img').length"), 0)

    def test_the_highest_value_on_the_cloth_is_that_of_the_cell_about_which_the_result_has_its_own(self):
        self.open(self.steady / "report.html")
        self.js("document.querySelector('.stage canvas').focus()")
        self.browser.press("h")
        said = self.js("document.querySelector('.probe').innerText")
        highest = json.loads((self.steady / "result.json").read_text())["max_von_mises_n_m"]
        shown = number(re.search(r"stress: (\S+) N/m", said)[1])  # of a cell, where the result has a mean over 50 mm
        self.assertGreaterEqual(shown, highest)
        self.assertLess(shown, 1.05 * highest)
        # The probe of a mouse on the marker belongs to the same cell.
        box = self.js("(() => { const m = document.querySelector('.marker').getBoundingClientRect(); return [m.x + 6, m.y + 6]; })()")
        self.browser.mouse("mouseMoved", *box)
        time.sleep(0.3)
        self.assertRegex(self.js("document.querySelector('.probe').innerText"), r"stress: \S+ N/m")

    def colours(self):
        """Of the picture: mean red, green, blue, and its hash."""
        return self.js("""(() => { const v = Page.shapes().viewer; v.drawNow(); const c = document.createElement('canvas');
            c.width = 200; c.height = 200; const d = c.getContext('2d'); d.drawImage(v.canvas, 0, 0, 200, 200);
            return [...d.getImageData(0, 0, 200, 200).data].reduce((sum, x, i) => (sum * 31 + x) % 1000003, 7); })()""")

    def test_quantity_lines_slice_streamlines_and_keys_change_the_picture(self):
        self.open(self.steady / "report.html")
        seen = {self.colours()}
        for act in ("const s = document.querySelector('[data-control=quantity]'); s.value = 'pressure_difference_applied_pa'; s.dispatchEvent(new Event('change'))",
                    "document.querySelector('[data-control=lines]').click()", "document.querySelector('[data-control=slice]').click()",
                    "const p = document.querySelector('[data-control=slice-place]'); p.value = 0.4; p.dispatchEvent(new Event('input'))",
                    "const q = document.querySelector('[data-control=slice-quantity]'); q.value = 'pressure'; q.dispatchEvent(new Event('change'))",
                    "document.querySelector('[data-control=streamlines]').click()", "document.querySelector('[data-view=below]').click()"):
            self.js("{" + act + "}")
            now = self.colours()
            self.assertNotIn(now, seen, act)
            seen.add(now)
        self.js("document.querySelector('.stage canvas').focus()")
        for key in ("ArrowLeft", "ArrowUp", "+", "2"):
            self.browser.press(key)
            now = self.colours()
            self.assertNotIn(now, seen, key)
            seen.add(now)
        self.assertIn("[Pa]", self.js("document.querySelector('[data-bar=cloth]').innerText"))

    def test_an_opening_plays_shape_and_force_together(self):
        self.open(self.opening / "report.html")
        self.check_values(self.opening)
        self.js("{ const t = document.querySelector('[data-control=time]'); t.value = 0.004; t.dispatchEvent(new Event('input')); }")
        middle = self.colours()
        self.assertEqual(self.js("document.querySelector('.timeline output').textContent"), "4 ms")
        left = "parseFloat(document.querySelector('[data-plot=load] .now').style.left) / document.querySelector('[data-plot=load] .u-over').clientWidth"
        self.assertAlmostEqual(self.js(left), 0.5, delta=0.02)
        self.js("document.querySelector('[data-control=play]').click()")
        time.sleep(1.0)
        self.js("document.querySelector('[data-control=play]').click()")
        self.assertGreater(self.js("Page.shown().clock.time"), 0.004)
        self.assertGreater(self.js(left), 0.5)
        self.assertNotEqual(self.colours(), middle)

    def test_a_sizing_shows_its_numbers_and_every_method(self):
        result = json.loads(ripstop("size", "--mass", "2.4", "--descent-rate", "5", "--json", "--out", str(self.folder / "size.toml")))
        self.open(self.folder / "size.html")
        self.assertIn("Sizing", self.js("Page.shown().node.innerText"))
        shown = self.js("Page.shown().node.querySelector('[data-card=nominal_diameter_m] dd').title")
        self.assertEqual(float(shown), result["nominal_diameter_m"])
        loads = self.js("[...document.querySelectorAll('[data-table=\"opening methods\"] tbody tr')].map((row) => row.cells[1].title || row.cells[1].innerText)")
        for text, method in zip(loads, result["opening"][0]["methods"], strict=True):
            self.assertAlmostEqual(number(text), method["load_n"], delta=1e-4 * method["load_n"])
        self.assertIsNone(self.js("document.querySelector('#comparison')"))

    def test_a_value_that_is_a_text_is_shown_as_one(self):
        self.open(self.steady / "report.html")
        weakest = self.js("Page.shown().node.querySelector('[data-card=weakest_member] dd').innerText.trim()")
        self.assertEqual(weakest, json.loads((self.steady / "result.json").read_text())["margins"]["weakest_member"])

    def test_several_runs_are_compared(self):
        self.open(self.both)
        self.assertEqual(self.js("document.querySelectorAll('#tabs button').length"), 2)
        rows = self.js("[...document.querySelectorAll('[data-table=comparison] tbody tr')].map((row) => [...row.cells].map((c) => c.title || c.innerText))")
        results = [json.loads((folder / "result.json").read_text()) for folder in (self.steady, self.opening)]
        row = next(row for row in rows if row[0] == "maximum line tension")
        self.assertEqual([float(text) for text in row[2:]], [result["max_line_tension_n"] for result in results])
        self.js("document.querySelectorAll('#tabs button')[1].click()")
        self.check_values(self.opening)

    def test_dark_and_light_differ_and_paper_has_pictures(self):
        self.open(self.both)
        ink = "getComputedStyle(document.body).color"
        self.browser.theme("dark")
        dark = self.js(ink)
        self.browser.theme("light")
        self.assertNotEqual(self.js(ink), dark)
        self.js("window.dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.js("[...document.querySelectorAll('section.run .paper')].map((p) => p.querySelectorAll('img').length)"), [1, 6])
        if PICTURES:
            self.browser.pdf(PICTURES / "both.pdf")
        self.js("window.dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.js("document.querySelectorAll('.paper img').length"), 0)

    def test_on_a_phone_nothing_is_wider_than_the_page_and_no_word_is_broken(self):
        self.open(self.steady / "report.html")
        self.browser.width(390)
        self.js("new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")  # plots follow the width in a frame
        self.assertLessEqual(self.js("document.documentElement.scrollWidth"), 390)
        # A word is broken where a range over it has more than one line.
        broken = """[...document.querySelectorAll('.card dt, .table td:first-child')].flatMap((cell) => {
          const text = cell.firstChild;
          if (!text || text.nodeType !== Node.TEXT_NODE || !cell.offsetParent) return [];
          return [...text.data.matchAll(/[A-Za-z]+/g)].filter((word) => {
            const range = document.createRange();
            range.setStart(text, word.index);
            range.setEnd(text, word.index + word[0].length);
            return range.getClientRects().length > 1;
          }).map((word) => word[0]);
        })"""
        self.assertEqual(self.js(broken), [])
        self.browser.width(1280)

    def test_the_first_printed_page_has_more_than_the_title(self):
        self.open(self.steady / "report.html")
        self.browser.media("print")
        self.assertEqual(self.js("getComputedStyle(document.querySelector('section.run')).breakBefore"), "auto")
        self.browser.media("")
        self.open(self.both)
        self.browser.media("print")
        self.assertEqual(self.js("[...document.querySelectorAll('section.run')].map((one) => getComputedStyle(one).breakBefore)"),
                         ["auto", "page", "page"])
        self.browser.media("")

    def test_fifty_thousand_moving_nodes_are_smooth(self):
        self.assertLessEqual(self.dome.stat().st_size, 10_000_000)
        self.open(self.dome)
        # Time of a frame without the work of a graphics processor: a sixtieth of a second at least on an idle machine. The smallest
        # of several is taken, with a margin for other work on the machine.
        least = self.js("""(() => { const c = Page.shown().controls; const times = [];
            for (let i = 0; i < 8; ++i) { const t = performance.now(); c.canopy.set(0.011 * i, c.key); times.push(performance.now() - t); }
            return Math.min(...times); })()""")
        print(f"\na frame of 50,000 nodes: {least:.1f} ms")
        self.assertLess(least, 1000 / 25)


if __name__ == "__main__":
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
