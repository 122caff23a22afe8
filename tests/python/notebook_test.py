"""Cases, runs and tables show themselves in a notebook without a network, and the example notebook runs."""
import html
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy
import ripstop
import small

NOTEBOOK = small.SOURCE / "examples/python/first_run.ipynb"
FRAME = """<!doctype html><html><body><script>
addEventListener("message", (event) => {{ if (event.data === "report ready") document.documentElement.dataset.ready = "yes"; }});
</script>{}</body></html>"""


def page_in(frame):
    return html.unescape(re.search(r'srcdoc="([^"]*)"', frame)[1])


def data_of(page):
    return json.loads(re.search(r'id="report-data">(.*?)</script>', page, re.DOTALL)[1])["runs"][0]


class Shown(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = small.case()
        cls.run_ = ripstop.steady(small.case(coupling__max_iterations=2, flow__max_iterations=30))
        cls.opening = ripstop.inflate(small.opening_case(), pressure_pa=300)
        cls.fabric = ripstop.fabric(cls.case, pressure_pa=240)

    def test_a_case_and_a_result_are_tables_of_their_values(self):
        text = small.case(title="<b>mine</b> & yours")._repr_html_()
        self.assertIn("&lt;b&gt;mine&lt;/b&gt; &amp; yours", text)
        area = f"{ripstop.check(self.case).nominal_area_m2:.6g}"
        self.assertIn(f">{area}<", text)
        size = ripstop.size(2.4, 5)
        self.assertIn(f">{size.nominal_diameter_m:.6g}<", size._repr_html_())
        self.assertIn(f">{size.margins.members[0].margin_of_safety:.6g}<", size._repr_html_())  # a row of the table of members
        for name in ripstop.__all__:
            member = getattr(ripstop, name)
            if isinstance(member, type) and hasattr(member, "__match_args__"):
                self.assertTrue(hasattr(member, "_repr_html_"), name)

    def test_a_table_shows_its_rows_and_its_columns_are_arrays(self):
        table = self.run_.iterations
        text = table._repr_html_()
        self.assertIn(">drag_n<", text)
        self.assertEqual(text.count("<tr>"), len(table) + 1)
        self.assertIs(type(table["drag_n"]), numpy.ndarray)
        self.assertEqual(table["drag_n"][-1], self.run_.drag_n)
        self.assertFalse(table.flags.writeable)
        self.assertEqual(self.run_.stress._repr_html_().count("<tr>"), 1 + 20 + 1)  # the head, and a row for the omitted ones
        self.assertIn(f"{len(self.run_.stress)} rows", self.run_.stress._repr_html_())

    def test_a_run_is_its_report_with_shape_plots_and_values(self):
        for run, kind, frames, plots in ((self.run_, "steady", 1, {"forces", "changes"}), (self.fabric, "fabric", 1, set()),
                                         (self.opening, "opening", len(self.opening.shots), {"load", "size", "stress", "energy"})):
            data = data_of(page_in(run._repr_html_()))
            self.assertEqual(data["kind"], kind)
            self.assertEqual(data["title"], run.title)
            self.assertEqual(len(data["shape"]["frames"]), min(frames, 25))
            self.assertEqual({plot["id"] for plot in data["plots"]}, plots)
            values = {value["key"]: value["value"] for value in data["values"]}
            for key in data["headline"][:2]:
                self.assertEqual(values[key], run.asdict()[key])
            self.assertGreater(len(data["shape"]["frames"][0]["cells"]), 0)  # stresses to colour by

    def test_a_run_in_a_folder_is_the_report_of_its_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            run = ripstop.steady(small.case(coupling__max_iterations=1, flow__max_iterations=5), out=folder)
            self.assertEqual(page_in(run._repr_html_()), pathlib.Path(folder, "report.html").read_text())

    @unittest.skipUnless(shutil.which("chromium"), "chromium is not installed")
    def test_the_pages_open_in_a_browser_within_their_frame_without_a_request(self):
        sys.path.insert(0, str(small.SOURCE / "tests/report"))
        from browser import Browser
        browser = Browser()
        with tempfile.TemporaryDirectory() as folder:
            try:
                for run in (self.run_, self.fabric, self.opening):
                    file = pathlib.Path(folder, "notebook.html")
                    file.write_text(FRAME.format(run._repr_html_()))
                    self.assertEqual(browser.open(file), "yes")
                self.assertEqual(browser.errors, [])
                self.assertEqual([url for url in browser.requests if not url.startswith(("file:", "data:", "blob:", "about:"))], [])
            finally:
                browser.close()


class Notebook(unittest.TestCase):
    def test_the_example_runs(self):
        cells = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
        self.assertFalse(any(cell["outputs"] for cell in cells))
        if importlib.util.find_spec("nbconvert") is None or importlib.util.find_spec("ipykernel") is None:
            self.skipTest("python3-nbconvert and python3-ipykernel are not installed")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", folder, NOTEBOOK],
                                  capture_output=True, text=True, env={**os.environ, "HOME": folder})
            self.assertEqual(done.returncode, 0, done.stderr)
            cells = json.loads(pathlib.Path(folder, NOTEBOOK.name).read_text())["cells"]
        shown = ["".join(output["data"].get("text/html", "")) for cell in cells for output in cell.get("outputs", []) if "data" in output]
        self.assertEqual(len(shown), 5)
        case, run, iterations, _, size = shown
        self.assertIn("A flat circular canopy of 1 m", case)
        self.assertTrue(data_of(page_in(run))["converged"])
        self.assertIn(">drag_n<", iterations)
        self.assertIn("nominal diameter", size)


if __name__ == "__main__":
    unittest.main()
