"""Checks a built site: every link leads to a file and an anchor, and no page loads anything from another host."""
import html.parser
import pathlib
import re
import urllib.parse

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "video": "src", "audio": "src", "object": "data"}
ADDRESS = re.compile(r"^(?:[a-z][a-z0-9+.-]*:|//)", re.IGNORECASE)


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.anchors, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors.update(found[key] for key in ("id", "name") if found.get(key))
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        elif tag in LOADED and found.get(LOADED[tag]) and found.get("rel") != "canonical":
            self.loaded.append(found[LOADED[tag]])


def styles(text):
    """Addresses that a style sheet loads."""
    return [address.strip("'\" ") for address in re.findall(r"url\(([^)]*)\)", text) + re.findall(r"@import\s+['\"]([^'\"]+)", text)]


def faults(site):
    site = pathlib.Path(site).resolve()
    pages = {file: Page(file.read_text(errors="replace")) for file in sorted(site.rglob("*.html"))}
    found = []
    for file, page in pages.items():
        name = file.relative_to(site)
        if name.name == "404.html":  # its links begin at the root of a server
            continue
        for address in page.loaded:
            if address.startswith(("data:", "javascript:")):
                continue
            if ADDRESS.match(address):
                found.append(f"{name}: loads {address}")
            elif not (file.parent / urllib.parse.unquote(address.partition("?")[0].partition("#")[0])).exists():
                found.append(f"{name}: no such file: {address}")
        for link in page.links:
            if ADDRESS.match(link):
                continue
            path, _, anchor = urllib.parse.unquote(link).partition("#")
            target = (file.parent / path).resolve() if path else file
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                found.append(f"{name}: no such file: {link}")
            elif anchor and target in pages and anchor not in pages[target].anchors and "cpp" not in name.parts:  # Doxygen omits some
                found.append(f"{name}: no such anchor: {link}")
    for file in site.rglob("*.css"):
        found += [f"{file.relative_to(site)}: loads {address}" for address in styles(file.read_text()) if re.match(r"https?:|//", address)]
    return found
