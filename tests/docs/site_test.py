#!/usr/bin/env python3
"""The checks of the built site find broken links and resources of other hosts. Where the packages of `make docs` are installed, the
site is built and opened in a browser: no request leaves the folder, every equation is typeset, and the search finds a page."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "docs/site"), str(ROOT / "tests/report")]
import check_site
from browser import Browser

HAS_PACKAGES = all(map(shutil.which, ("mkdocs", "doxygen", "chromium"))) and pathlib.Path("/usr/share/javascript/katex").exists()
PICTURES = os.environ.get("RIPSTOP_SITE_PICTURES")  # a folder for screenshots


class Checks(unittest.TestCase):
    def faults(self, page, style=""):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "index.html").write_text(page)
            (folder / "style.css").write_text(style)
            (folder / "other.html").write_text('<h1 id="here">Other</h1>')
            return check_site.faults(folder)

    def test_resources_of_other_hosts_are_found(self):
        for page in ['<script src="https://host/a.js"></script>', '<img src="//host/a.png">', '<link rel="stylesheet" href="http://host/a.css">']:
            with self.subTest(page):
                self.assertEqual(len(self.faults(page)), 1)
        self.assertEqual(len(self.faults("", "@import 'https://host/a.css';")), 1)
        self.assertEqual(len(self.faults("", "@font-face { src: url(https://host/a.woff2) }")), 1)

    def test_broken_links_are_found(self):
        for page in ['<a href="none.html">', '<a href="other.html#there">', '<a href="#there">', '<img src="none.png">']:
            with self.subTest(page):
                self.assertEqual(len(self.faults(page)), 1)

    def test_sound_links_are_accepted(self):
        page = '<link rel="stylesheet" href="style.css"><a href="other.html#here">a</a><a href="https://host/page">b</a><p id="x"><a href="#x">c</a>'
        self.assertEqual(self.faults(page), [])


class Navigation(unittest.TestCase):
    def test_every_page_is_in_the_navigation(self):
        listed = (ROOT / "docs/site/mkdocs.yml").read_text()
        pages = [str(page.relative_to(ROOT)) for page in ROOT.glob("docs/**/*.md")]
        pages = [page for page in pages if not page.startswith(("docs/tables/", "docs/tutorials/"))]  # lists of build.py
        self.assertGreater(len(pages), 40)
        self.assertEqual([page for page in pages if page not in listed], [])


@unittest.skipUnless(HAS_PACKAGES, "the packages of make docs are not installed")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([sys.executable, "-B", ROOT / "docs/site/build.py"], check=True)
        cls.site = ROOT / "build-docs/site"
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def open(self, page):
        self.browser.requests.clear()
        self.browser.errors.clear()
        self.browser.call("Page.navigate", url=(self.site / page).as_uri())
        self.wait("document.readyState == 'complete' && document.body.dataset.equations == 'typeset'")

    def wait(self, condition, seconds=30):
        end = time.time() + seconds
        while not self.browser.evaluate(condition):
            self.assertLess(time.time(), end, condition)
            time.sleep(0.05)

    def test_every_equation_is_typeset_and_nothing_is_loaded_from_a_network(self):
        pages = [self.site / "index.html", *(page for page in self.site.rglob("*.html") if 'class="arithmatex"' in page.read_text())]
        self.assertGreater(len(pages), 15)
        for page in pages:
            with self.subTest(str(page.relative_to(self.site))):
                self.open(page)
                self.assertEqual([request for request in self.browser.requests if not request.startswith(("file:", "data:", "about:", "blob:"))], [])
                self.assertEqual(self.browser.errors, [])
                self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('.katex-error')].map(e => e.textContent)"), [])
                shown = self.browser.evaluate("document.querySelectorAll('.arithmatex').length == document.querySelectorAll('.arithmatex .katex').length")
                self.assertTrue(shown)
                left = self.browser.evaluate("[...document.querySelectorAll('article p, article li, article td')].map(e => e.innerText).join('\\n')")
                self.assertEqual(re.findall(r"\$\$|\\frac|\\rho", left), [])

    def test_navigation_shows_no_marks_of_code(self):
        self.open("docs/guide/fly.html")
        titles = self.browser.evaluate("[...document.querySelectorAll('.md-nav__link')].map(e => e.textContent.trim())")
        self.assertIn("Free flight: ripstop fly", titles)
        self.assertEqual([title for title in titles if "`" in title], [])

    def test_every_class_of_a_public_header_is_in_the_interface(self):
        pages = "\n".join(page.name for page in (self.site / "docs/reference/cpp").glob("*.html"))
        excluded = re.search(r"^EXCLUDE = (.*)", (ROOT / "docs/site/Doxyfile").read_text(), re.MULTILINE)[1].split()
        named, missing = 0, []
        for header in sorted((ROOT / "src/ripstop").rglob("*.h")):
            text = "" if str(header.relative_to(ROOT)) in excluded else header.read_text()
            for name in re.findall(r"^(?:class|struct) (\w+)(?: final)?(?: : [^;{]*)? \{", text, re.MULTILINE):
                named += 1
                page = name.replace("_", "__")
                if not re.search(rf"^(?:class|struct|union)ripstop(?:_1_1\w+?)??_1_1{page}\.html$", pages, re.MULTILINE):
                    missing.append(f"{header.relative_to(ROOT)}: {name}")
        self.assertGreater(named, 300)
        self.assertEqual(missing, [])

    def test_search_finds_a_page_without_a_server(self):
        self.open("index.html")
        self.browser.evaluate("document.querySelector('[data-md-toggle=search]').checked = true, document.querySelector('[data-md-component=search-query]').focus()")
        self.browser.call("Input.insertText", text="gershgorin")
        self.wait("[...document.querySelectorAll('.md-search-result__link')].some(a => a.href.includes('theory/cloth.html'))")

    def test_no_page_is_wider_than_a_phone(self):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
        for page in ("index.html", "docs/theory/cloth.html", "docs/reference/case-keys.html", "docs/validation.html", "docs/guide/canopies.html"):
            with self.subTest(page):
                self.open(page)
                self.picture(f"phone-{page}")
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 390)
        self.browser.call("Emulation.clearDeviceMetricsOverride")

    def test_dark_colours_follow_the_system(self):
        for theme, scheme in (("dark", "slate"), ("light", "default")):
            self.browser.theme(theme)
            self.open("docs/theory/flow-cartesian.html")
            self.browser.evaluate("localStorage.clear()")  # a page remembers the colours that it has shown
            self.open("docs/theory/flow-cartesian.html")
            self.picture(f"{theme}-flow-cartesian")
            self.assertEqual(self.browser.evaluate("document.body.dataset.mdColorScheme"), scheme)

    def picture(self, name):
        if PICTURES:
            self.browser.screenshot(pathlib.Path(PICTURES) / (re.sub(r"\W+", "-", name) + ".png"))


if __name__ == "__main__":
    unittest.main()
