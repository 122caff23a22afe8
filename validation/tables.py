"""Writes a page of docs/tables: the table, its command, and the machine and day."""
import datetime
import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent


def table(head, rows):
    """Lines of a Markdown table, with an empty one after it."""
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows), ""]


def made_by(runs):
    """Processors, first and last day of runs, from their run.json."""
    days = sorted({run["started"][:10] for run in runs})
    named = [f"{day.day} {day:%B %Y}" for day in map(datetime.date.fromisoformat, days)]
    return "; ".join(sorted({run["processor"] for run in runs})) + ", " + " to ".join(dict.fromkeys([named[0], named[-1]]))


def machine():
    """Model of the processor of this machine."""
    return next((line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name")), "unknown")


def here():
    """This machine and today, as the run of a table that is made without run folders."""
    return [{"started": f"{datetime.date.today()}", "processor": machine()}]


def rows_of(name):
    """Cells of the rows of a table of docs/tables, without its head; none where the page does not exist."""
    page = ROOT / "docs/tables" / f"{name}.md"
    lines = [line for line in page.read_text().splitlines() if line.startswith("| ")] if page.exists() else []
    return [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines[1:]]


def replace_rows(name, rows, keys):
    """Replaces the rows of a page of docs/tables that have the same number of cells and the same first `keys` cells."""
    page = ROOT / "docs/tables" / f"{name}.md"
    new = {(len(row), *row[:keys]): row for row in rows}
    lines = []
    for line in page.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("| ") else []
        row = new.pop((len(cells), *cells[:keys]), None)
        lines.append("| " + " | ".join(row) + " |" if row else line)
    if new:
        raise ValueError(f"{page.name} has no row of {', '.join(' '.join(key[1:]) for key in new)}")
    page.write_text("\n".join(lines) + "\n")


def runs_below(folder):
    """The run.json of all runs in a folder."""
    return [json.loads(path.read_text()) for path in sorted(pathlib.Path(folder).rglob("run.json"))]


def write(name, title, command, runs, lines):
    text = [f"# {title}", "", f"`{command}`: {made_by(runs)}.", "", *lines]
    (ROOT / "docs/tables").mkdir(exist_ok=True)
    (ROOT / "docs/tables" / f"{name}.md").write_text("\n".join(text).rstrip("\n") + "\n")
