#!/usr/bin/env python3
"""Studio in a browser: from mass and descent rate to a design, its shape, numbers and pattern, a steady run, its report and RocketPy;
every family, two designs side by side, tables of bodies and hardware, a material from records, two tabs, the kill of the server during a run.

    browser_test.py RIPSTOP [FOLDER]

Screenshots are written to FOLDER."""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from studio import ROOT, Studio

sys.path.insert(0, str(ROOT / "tests/report"))
from browser import Browser  # noqa: E402

PROGRAM = sys.argv[1]
PICTURES = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None


DEADLINE = time.monotonic() + 850  # of all tests; they wait for states, whatever the speed of the machine


class StudioPage(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-studio-page-"))
        self.studio = Studio(PROGRAM, self.folder)
        self.browser = Browser(1280, 800)
        self.browser.width(1280, 800)

    def tearDown(self):
        self.browser.close()
        if self.studio.process.poll() is None:
            self.studio.end()
        shutil.rmtree(self.folder)

    def until(self, expression):
        while time.monotonic() < DEADLINE:
            value = self.browser.evaluate(expression)
            if value:
                return value
            time.sleep(0.1)
        if PICTURES:
            self.browser.screenshot(PICTURES / "failed.png")
        self.fail(f"not reached: {expression}; page: {self.browser.evaluate('document.body.innerText')[:2000]}; {self.browser.errors}")

    def open(self):
        self.browser.call("Page.navigate", url=self.studio.address)
        self.assertEqual(self.until("document.documentElement?.dataset.ready || ''"), "yes")

    def type_into(self, selector, text, browser=None):
        (browser or self.browser).evaluate(f"(() => {{ const i = document.querySelector({selector!r}); i.value = {text!r}; i.dispatchEvent(new Event('change')); }})()")

    def enter(self, key, value):
        """A value into the field of a key; once the server has read the file again."""
        version = self.browser.evaluate("Studio.design().data.version")
        self.type_into(f"[id={json.dumps('key-' + key)}]", value)
        self.until(f"Studio.design().data.version !== {version!r}")

    def add(self, group, **fields):
        """A new table of a group by its form, with the values of the form's fields."""
        self.browser.evaluate(f"document.querySelector('[data-group=\"new {group}\"]').open = true")
        for field, value in fields.items():
            self.type_into(f"[id={json.dumps(f'new-{group}-{field}')}]", value)
        version = self.browser.evaluate("Studio.design().data.version")
        self.click(f"[id={json.dumps(f'new-{group}-go')}]")
        self.until(f"Studio.design().data.version !== {version!r}")

    def key(self, name, what):
        """Of the field of a key: `what` is an expression in `row`."""
        return self.browser.evaluate(f"((row) => {what})(document.querySelector('[data-key={json.dumps(name)}]'))")

    def click(self, selector):
        self.until(f"document.querySelector({selector!r}) !== null")
        self.browser.evaluate(f"document.querySelector({selector!r}).click()")

    def picture(self, name):
        if not PICTURES:
            return
        PICTURES.mkdir(parents=True, exist_ok=True)
        for theme in ("light", "dark"):
            self.browser.theme(theme)
            self.browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 300))))")
            self.browser.screenshot(PICTURES / f"{name}-{theme}.png")
        self.browser.theme("light")

    def drop(self, files):
        """Files onto the records of the materials view."""
        given = {file.name: file.read_text() for file in files}
        self.browser.evaluate(f"""(() => {{ const data = new DataTransfer();
            for (const [name, text] of Object.entries({json.dumps(given)})) data.items.add(new File([text], name));
            document.querySelector('[data-part=drop]').dispatchEvent(new DragEvent('drop', {{ dataTransfer: data }})); }})()""")

    def shape_number(self):
        return int(self.browser.evaluate("document.querySelector('[data-part=timing]').dataset.shape || 0"))

    def size_a_case(self):
        self.open()
        self.until("document.getElementById('create').open")
        self.until("document.querySelector('#create-drawing img')?.naturalWidth > 0")
        self.picture("new-case")
        self.click("#create-go")
        self.until("document.querySelector('[data-part=timing]').dataset.file === 'my-canopy.toml'")
        self.until("document.querySelector('[data-part=loads]').dataset.file === 'my-canopy.toml'")
        self.until("document.querySelector('[data-piece] img') || Studio.design().pieces.children.length")

    def test_a_design_from_mass_and_rate_to_its_run(self):
        self.size_a_case()
        file = self.folder / "my-canopy.toml"
        original = file.read_text()
        self.picture("design")
        shapes = self.shape_number()

        # A key changes in place and the shape follows; undo restores every byte.
        self.type_into("#key-parachute\\.mesh\\.cloth_nodes", "1000")
        self.until("!document.getElementById('undo').disabled")
        self.assertIn("cloth_nodes = 1000", file.read_text())
        others = [line for line in original.splitlines() if "cloth_nodes" not in line]
        self.assertEqual([line for line in file.read_text().splitlines() if line in others], others)
        self.until(f"Number(document.querySelector('[data-part=timing]').dataset.shape) > {shapes}")
        self.click("#undo")
        self.until("!document.getElementById('redo').disabled")
        self.until("document.getElementById('undo').disabled")
        self.assertEqual(file.read_text(), original)
        self.click("#redo")
        self.until("!document.getElementById('undo').disabled")

        # A problem is at its field.
        self.type_into("#key-parachute\\.gores", "-3")
        self.until("document.querySelector('#key-parachute\\\\.gores').getAttribute('aria-invalid') === 'true'")
        self.assertIn("at least 3", self.browser.evaluate("document.querySelector('[data-key=\"parachute.gores\"] .problem').textContent"))
        self.until("document.querySelector('[data-part=timing]').textContent.includes('last valid case') && !document.querySelector('[data-part=stale]').hidden")
        self.picture("problem")
        self.click("#undo")
        self.until("document.querySelector('#key-parachute\\\\.gores').getAttribute('aria-invalid') === 'false'")

        # A change by another program is noticed.
        coarse = file.read_text().replace("cloth_nodes = 1000", "cloth_nodes = 1000\nline_segment_m = 0.3")
        file.write_text("# by hand\n" + coarse + "\n[coupling]\nthreads = 1\nload = \"uniform\"\n")
        self.until("!document.getElementById('notice').hidden && document.getElementById('notice').textContent.includes('changed outside')")
        self.assertTrue(self.browser.evaluate("Studio.design().text.value.startsWith('# by hand')"))
        self.click("#notice button")

        self.click("[data-view=pattern]")
        self.until("document.querySelector('[data-piece] img')?.naturalWidth > 0")
        self.click("[data-control=save-pattern]")
        self.until("document.querySelector('#view-pattern [role=status]').textContent.includes('saved in')")
        saved = {path.suffix for path in (self.folder / "my-canopy-pattern").iterdir()}
        self.assertLessEqual({".dxf", ".svg", ".pdf"}, saved)
        self.picture("pattern")
        self.click("[data-view=text]")
        self.picture("text")

        # A run, a reload of the page during it, and its report.
        self.click("[data-view=runs]")
        self.type_into("[data-option=\"--grid\"]", "48,48,64")
        self.click("[data-control=start]")
        self.until("/^ +[0-9]/m.test(document.querySelector('.log')?.textContent ?? '')")
        self.picture("runs")
        self.open()
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('[data-job]').length"), 1)
        self.until("!['queued', 'running'].includes(document.querySelector('[data-job]')?.dataset.state ?? 'queued')")
        self.assertEqual(self.browser.evaluate("document.querySelector('[data-job]').dataset.state"), "finished",
                         self.browser.evaluate("document.querySelector('[data-job] .line').textContent"))
        self.click("[data-job] [data-focus^=Output]")
        self.until("document.querySelector('[data-plot=forces] canvas') !== null && document.querySelector('[data-part=detail] .stage canvas') !== null")
        self.picture("runs-done")
        self.browser.evaluate("[...document.querySelectorAll('[data-job] button')].find((one) => one.textContent === 'RocketPy').click()")
        self.until("document.querySelector('.log').textContent.includes('add_parachute')")
        self.browser.evaluate("[...document.querySelectorAll('[data-job] button')].find((one) => one.textContent === 'Report').click()")
        self.until("document.querySelector('#view-report')?.dataset.loaded === 'my-canopy-steady'")
        self.picture("report")
        own = f"http://127.0.0.1:{self.studio.port}/"
        self.assertEqual([url for url in self.browser.requests if not url.startswith((own, "data:", "blob:"))], [])
        self.assertEqual([error for error in self.browser.errors if "400" not in error], [])

    def test_two_designs_are_side_by_side(self):
        self.size_a_case()
        self.click("#copy")
        self.until("[...document.querySelectorAll('[data-control=against] option')].some((one) => one.value === 'my-canopy-2.toml')")
        self.assertEqual((self.folder / "my-canopy-2.toml").read_text(), (self.folder / "my-canopy.toml").read_text())
        self.click("#notice button")
        self.enter("parachute.vent_diameter_m", "0.6")
        self.type_into("[data-control=against]", "my-canopy-2.toml")
        self.until("document.querySelector('[data-part=loads]').dataset.against === 'my-canopy-2.toml'")
        self.until("[...document.querySelectorAll('.panes [data-part=timing]')].filter((one) => ['equilibrium', 'final'].includes(one.dataset.state)).length === 2")
        self.until("Studio.design().packed > 0 && Studio.design().otherPacked > 0 && document.querySelectorAll('[data-part=facts] tr:first-child td').length === 4")
        vent = self.browser.evaluate("[...document.querySelectorAll('[data-part=facts] tr')].find((row) => row.textContent.startsWith('vent')).innerText.split('\\t')")
        self.assertGreater(float(vent[1]), 3 * float(vent[2]))
        self.picture("compare")
        self.type_into("[data-control=against]", "")
        self.until("document.querySelectorAll('[data-part=facts] tr:first-child td').length === 2")
        self.assertEqual(self.browser.errors, [])

    def test_messages_name_the_fields_of_the_page(self):
        self.open()
        self.until("document.getElementById('create').open")
        for field, value, name in (("mass", "x y", "Payload mass"), ("rate", "-1", "Descent rate"), ("speed", "", "Largest deployment speed"), ("height", "1e9", "Height above sea level")):
            before = self.browser.evaluate(f"document.getElementById('create-{field}').value")
            self.browser.evaluate("document.getElementById('create-problem').textContent = ''")
            self.type_into(f"#create-{field}", value)
            self.click("#create-go")
            problem = self.until("document.getElementById('create-problem').textContent")
            self.assertIn(f'"{name}"', problem)
            self.assertNotIn("--", problem)
            self.type_into(f"#create-{field}", before)
        self.picture("new-case-problem")
        self.type_into("#create-mass", "5 lb")
        self.click("#create-go")
        self.until("document.querySelector('[data-part=loads]').dataset.file === 'my-canopy.toml' && document.querySelector('[data-part=loads] table') !== null")
        self.assertIn("mass_kg = 2.26796", (self.folder / "my-canopy.toml").read_text())
        self.type_into("[data-control=speed]", "fast")
        self.assertIn('"Deployment speed" = fast', self.until("document.querySelector('[data-part=loads] .problem')?.textContent ?? ''"))

        # Every text field of every run: the line of the failed run names it.
        self.browser.evaluate("""(async () => {
            const runs = Studio.runs(), wrong = [];
            for (const [command, options] of Object.entries(runs.options))
                for (const [option, text, value, kind] of options) if (!kind) {
                    const others = Object.fromEntries(options.filter((one) => one[2] && one[0] !== option).map((one) => [one[0], one[2]]));
                    await Server.post('/api/jobs/start', { name: `wrong-${wrong.length}`, command, case: 'my-canopy.toml', options: { ...others, [option]: 'x y' } });
                    wrong.push([command, Words.name(text)]);
                }
            window.wrong = wrong;
        })()""")
        wrong = self.until("window.wrong")
        self.assertGreater(len(wrong), 25)
        self.click("[data-view=runs]")
        self.until(f"document.querySelectorAll('[data-job][data-state=failed]').length === {len(wrong)}")
        lines = self.browser.evaluate("Object.fromEntries([...document.querySelectorAll('[data-job]')].map((one) => [one.dataset.job, one.querySelector('.line').textContent]))")
        for i, (command, name) in enumerate(wrong):
            self.assertIn(f'"{name}"', lines[f"wrong-{i}"], command)
            self.assertNotIn("--", lines[f"wrong-{i}"], command)
        self.picture("runs-failed")

    def test_tables_that_a_file_can_repeat_are_edited_in_the_form(self):
        case = (ROOT / "examples/conical/case.toml").read_text().replace("cloth_nodes = 12000", "cloth_nodes = 1000")
        file = self.folder / "a.toml"
        file.write_text(case)
        self.open()
        self.until("document.querySelector('[data-part=loads]').dataset.file === 'a.toml'")
        self.add("body", name="rocket", kind="cylinder", diameter_m="0.16", length_m="0.8")
        self.assertTrue(file.read_text().startswith(case))
        self.assertIn("[body.rocket]", file.read_text())
        self.assertEqual(self.key("body.rocket.diameter_m", "row.querySelector('label').textContent"), "diameter [m]")
        self.assertIn("above 0", self.key("body.rocket.diameter_m", "row.querySelector('.help').textContent"))
        self.assertEqual(self.key("body.rocket.nose_length_m", "[row.querySelector('input').placeholder, row.querySelector('.from').textContent]"), ["0", "default"])
        self.enter("body.rocket.diameter_m", "-1")
        self.assertEqual(self.key("body.rocket.diameter_m", "row.querySelector('input').getAttribute('aria-invalid')"), "true")
        self.enter("body.rocket.diameter_m", "0.12")
        self.add("hardware", name="swivel")
        self.enter("hardware.swivel.breaking_load_n", "5000")
        self.add("inflation.reefing", line_m="1.2", cut_s="2")
        self.enter("inflation.reefing[0].cut_s", "1.5")
        self.enter("deployment.order", "canopy-first")
        self.enter("flow.symmetry", "auto")
        self.enter("flight.angle_deg", "5")
        self.assertEqual(self.browser.evaluate("Studio.design().data.check.problems"), [])
        written = self.browser.evaluate("Studio.design().data.written")
        expected = {"body.rocket.shape": '"cylinder"', "body.rocket.diameter_m": "0.12", "hardware.swivel.breaking_load_n": "5000", "inflation.reefing[0].line_m": "1.2",
                    "inflation.reefing[0].cut_s": "1.5", "deployment.order": '"canopy-first"', "flow.symmetry": '"auto"', "flight.angle_deg": "5"}
        self.assertEqual({key: written.get(key) for key in expected}, expected)
        self.browser.evaluate("document.querySelector('[data-group=\"body.rocket\"]').scrollIntoView()")
        self.picture("tables")
        version = self.browser.evaluate("Studio.design().data.version")
        self.browser.evaluate("document.querySelector('[data-group=\"body.rocket\"] .row button').click()")
        self.until(f"Studio.design().data.version !== {version!r}")
        self.assertNotIn("rocket", file.read_text())
        self.assertEqual(self.browser.evaluate("Studio.design().data.check.problems"), [])

        # Recovery from apogee with this canopy, its trajectory and its output.
        self.click("[data-view=runs]")
        self.type_into("[data-control=command]", "recovery")
        self.type_into("[data-option=\"--mass\"]", "2.4")
        self.click("[data-control=start]")
        self.until("!['queued', 'running'].includes(document.querySelector('[data-job]')?.dataset.state ?? 'queued')")
        self.assertEqual(self.browser.evaluate("document.querySelector('[data-job]').dataset.state"), "finished", self.browser.evaluate("document.querySelector('[data-job] .line').textContent"))
        self.until("document.querySelector('[data-plot=height] canvas') !== null && document.querySelector('.log').textContent.includes('landing')")
        self.picture("recovery")
        self.assertEqual([error for error in self.browser.errors if "400" not in error], [])

    def test_a_run_survives_the_kill_of_the_server(self):
        case = (ROOT / "examples/flat-circular/case.toml").read_text().replace("cloth_nodes = 12000", "cloth_nodes = 1000\nline_segment_m = 0.3")
        (self.folder / "a.toml").write_text(case + "\n[coupling]\nthreads = 1\nload = \"uniform\"\n")
        self.open()
        self.click("[data-view=runs]")
        self.type_into("[data-option=\"--grid\"]", "60,60,72")
        self.click("[data-control=start]")
        self.until("/^ +[0-9]/m.test(document.querySelector('.log')?.textContent ?? '')")
        self.studio.end(signal.SIGKILL)
        self.until("document.getElementById('notice').textContent.includes('The server has ended')")
        self.picture("server-ended")
        self.studio = Studio.reopened(PROGRAM, self.folder)
        self.open()
        self.click("[data-view=runs]")
        self.assertEqual(self.browser.evaluate("document.querySelector('[data-job]').dataset.state"), "stopped")
        self.click("[data-job] [data-focus^=Resume]")
        self.until("!['queued', 'running', 'stopped'].includes(document.querySelector('[data-job]').dataset.state)")
        self.assertEqual(self.browser.evaluate("document.querySelector('[data-job]').dataset.state"), "finished", self.browser.evaluate("document.querySelector('[data-job] .line').textContent"))
        subprocess.run([str(pathlib.Path(PROGRAM).resolve()), "steady", "a.toml", "--grid", "60,60,72", "--out", "runs/printed"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        results = [json.loads((self.folder / f"runs/{run}/result.json").read_text()) for run in ("a-steady", "printed")]
        for result in results:
            for key in [key for key in result if "time_s" in key]:
                del result[key]
        self.assertEqual(*results)

    def test_every_family_has_a_shape(self):
        families = self.studio.get("/api/folder")[1]["families"]
        self.assertGreaterEqual(len(families), 12)
        for family in families:
            (self.folder / f"{family}.toml").write_text((ROOT / f"examples/{family}/case.toml").read_text())
        self.open()
        drawings = self.studio.get("/api/drawings")[1]
        for family in families:
            self.assertIn("<svg", drawings["types"][drawings["families"][family]], family)
            self.type_into("#case", f"{family}.toml")
            self.until(f"document.querySelector('[data-part=timing]').dataset.file === '{family}.toml'")
            self.until(f"document.querySelector('[data-part=loads]').dataset.file === '{family}.toml'")
            self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('[data-key] .problem')].filter((one) => !one.hidden).map((one) => one.textContent)"), [], family)
        self.assertTrue(self.browser.evaluate("document.getElementById('notice').hidden"), self.browser.evaluate("document.getElementById('notice').textContent"))
        self.picture("family")
        self.assertEqual([error for error in self.browser.errors if "400" not in error], [])  # some have no usual drag coefficient

    def test_a_record_becomes_a_material(self):
        (self.folder / "a.toml").write_text((ROOT / "examples/conical/case.toml").read_text())
        self.open()
        self.click("[data-view=materials]")
        self.drop(sorted((ROOT / "examples/fit-ripstop/records").glob("warp-[12].csv")))
        self.until("document.querySelectorAll('[data-record]').length === 2")
        self.type_into("[data-control=fit-areal]", "-1")
        self.click("[data-control=fit-go]")
        problem = self.until("document.querySelector('[data-part=fit-problem]').textContent")
        self.assertIn('"Mass per area" = -1', problem)
        self.assertNotIn("bench", problem)
        for name, text in (("areal", "0.0407"), ("thick", "7.6e-5"), ("source", "A & B <lab@example.org>"), ("cfm", "3")):
            self.type_into(f"[data-control=fit-{name}]", text)
        self.click("[data-control=fit-go]")
        self.until("document.querySelector('[data-part=fit-result]').dataset.state === 'done' || document.querySelector('[data-part=fit-problem]').textContent")
        self.assertEqual(self.browser.evaluate("document.querySelector('[data-part=fit-problem]').textContent"), "")
        understood = self.browser.evaluate("[...document.querySelectorAll('[data-part=understood] li')].map((one) => one.textContent)")
        self.assertEqual(len(understood), 4)
        self.assertIn("is extension in mm", understood[0])
        self.assertTrue(self.browser.evaluate("document.querySelector('[data-plot=fit-warp] canvas') !== null"))
        self.picture("materials")
        self.click("[data-control=fit-save]")
        self.until("document.querySelector('[data-part=saved]') !== null")
        self.assertTrue((self.folder / "materials/my-cloth.toml").exists())
        self.click("[data-view=design]")
        self.type_into("#key-parachute\\.canopy_material", "my-cloth")
        self.until("document.querySelector('[data-key=\"parachute.canopy_material\"]').classList.contains('given') && Studio.design().data.text.includes('my-cloth')")
        self.assertTrue(self.browser.evaluate("Studio.design().data.check.valid"))
        self.assertEqual([error for error in self.browser.errors if "400" not in error], [])

    def test_two_tabs_see_the_changes_of_each_other(self):
        (self.folder / "a.toml").write_text((ROOT / "examples/conical/case.toml").read_text())
        self.open()
        first, second = self.browser, Browser(1280, 800)
        try:
            self.browser = second
            self.open()
            self.type_into("#key-parachute\\.lines\\.length_m", "1.25", first)
            self.until("document.querySelector('#key-parachute\\\\.lines\\\\.length_m').value === '1.25'")
            self.until("document.getElementById('notice').textContent.includes('changed outside')")
            self.click("#undo")
            self.browser = first
            self.until("document.querySelector('#key-parachute\\\\.lines\\\\.length_m').value !== '1.25'")
        finally:
            self.browser = first
            second.close()
        self.assertEqual((self.folder / "a.toml").read_text(), (ROOT / "examples/conical/case.toml").read_text())

    def press(self, key, code, text=""):
        for kind in ("keyDown", "keyUp"):
            self.browser.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code, **({"text": text} if text and kind == "keyDown" else {}))

    def tab_to(self, expression):
        """Tab until the element with the focus satisfies an expression in `it`."""
        for _ in range(300):
            if self.browser.evaluate(f"((it) => {expression})(document.activeElement)"):
                return
            self.press("Tab", 9)
        self.fail(f"not reached by Tab: {expression}")

    def test_the_keyboard_leads_from_mass_and_rate_to_a_pattern(self):
        self.open()
        self.until("document.getElementById('create').open")
        self.tab_to("it.id === 'create-mass'")
        self.browser.evaluate("document.activeElement.select()")
        self.press("3", 51, "3")
        self.picture("keyboard-new")
        self.press("Enter", 13, "\r")
        self.until("document.querySelector('[data-part=loads]').dataset.file === 'my-canopy.toml'")
        self.assertIn("mass_kg = 3", (self.folder / "my-canopy.toml").read_text())
        self.tab_to("it.id === 'key-parachute.lines.length_m'")
        self.picture("keyboard-field")
        self.tab_to("it.getAttribute('aria-selected') === 'true'")
        self.press("ArrowRight", 39)
        self.until("document.getElementById('view-pattern') !== null")
        self.tab_to("it.dataset.control === 'save-pattern'")
        self.picture("keyboard-pattern")
        self.press("Enter", 13, "\r")
        self.until("document.querySelector('#view-pattern [role=status]').textContent.includes('saved in')")
        self.assertTrue(list((self.folder / "my-canopy-pattern").glob("*.pdf")))
        self.assertEqual(self.browser.errors, [])

    def test_titles_and_names_are_text(self):
        hostile = "<img src=x onerror=window.taken=1></script><script>window.taken=1</script>"
        case = (ROOT / "examples/conical/case.toml").read_text().splitlines()
        case = [f'title = "{hostile}"' if line.startswith("title") else line for line in case]
        (self.folder / "a.toml").write_text("\n".join(case) + "\n[unknown]\n'<b>' = \"<i>\"\n")
        self.open()
        self.until("!document.getElementById('notice').hidden")
        self.assertEqual(self.browser.evaluate("document.querySelector('#key-title').value"), hostile)
        self.assertEqual(self.browser.evaluate("[window.taken ?? 0, document.querySelectorAll('#notice i, #notice b, main img:not(.drawing)').length]"), [0, 0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
