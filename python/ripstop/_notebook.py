"""How cases, results and tables show themselves in a notebook: HTML without a network (`_repr_html_` of Jupyter)."""

import html
import re

import numpy

HEIGHT_PX = 760  # of the page of a run
MOST_ROWS = 20  # of a table


def _text(value):
    if isinstance(value, (float, numpy.floating)):
        return f"{value:.6g}"
    if isinstance(value, (bool, numpy.bool_)):
        return "yes" if value else "no"
    if isinstance(value, numpy.ndarray):
        return ", ".join(map(_text, value)) if value.size <= 3 else f"array of {' x '.join(map(str, value.shape))}"
    if isinstance(value, list):
        return ", ".join(map(_text, value)) if len(value) <= 3 else f"list of {len(value)}"
    return "" if value is None else str(value)


def _rows(rows, head=()):
    def row(tag, cells):
        return "<tr>" + "".join(f'<{tag} style="text-align:left">{html.escape(cell)}</{tag}>' for cell in cells) + "</tr>"
    first = f"<thead>{row('th', head)}</thead>" if head else ""
    return f"<table>{first}<tbody>{''.join(row('td', cells) for cells in rows)}</tbody></table>"


class Table(numpy.ndarray):
    """A structured array whose rows a notebook shows. Its columns are plain arrays."""

    def __getitem__(self, key):
        found = super().__getitem__(key)
        return found.view(numpy.ndarray) if isinstance(found, Table) and found.dtype.names is None else found

    def _repr_html_(self):
        if self.dtype.names is None or self.ndim != 1:
            return None
        shown = list(range(len(self)))
        if len(shown) > MOST_ROWS:
            shown[MOST_ROWS // 2:-(MOST_ROWS // 2)] = [None]
        rows = [["..."] * len(self.dtype.names) if i is None else [_text(value) for value in self[i]] for i in shown]
        return f"{_rows(rows, self.dtype.names)}<p>{len(self)} rows</p>"


def _is_result(value):
    return type(value).__module__ == "ripstop" and hasattr(type(value), "__match_args__")


def _words(kind, name):
    """Meaning and unit of an attribute, from its docstring: "drag [N]"."""
    return re.fullmatch(r"(.*?)(?: \[([^]]*)\])?", getattr(kind, name).__doc__ or name, re.DOTALL).groups(default="")


def _values(result, above=""):
    """A row for each value (meaning, value, unit), and the lists of results within it with their names."""
    rows, lists = [], []
    for name in type(result).__match_args__:
        value, (meaning, unit) = getattr(result, name), _words(type(result), name)
        if _is_result(value):
            inner = _values(value, f"{above}{meaning}: ")
            rows += [[words, text, of or unit] for words, text, of in inner[0]]
            lists += inner[1]
        elif isinstance(value, list) and value and _is_result(value[0]):
            lists.append((above + meaning, value))
        else:
            rows.append([above + meaning, _text(value), unit])
    return rows, lists


def _list_html(name, results):
    kind = type(results[0])
    names = [one for one in kind.__match_args__ if not isinstance(getattr(results[0], one), list)]
    head = [" ".join(filter(None, (meaning, unit and f"[{unit}]"))) for meaning, unit in (_words(kind, one) for one in names)]
    return f"<p>{html.escape(name)}</p>" + _rows([[_text(getattr(result, one)) for one in names] for result in results], head)


def _result_html(result):
    rows, lists = _values(result)
    return _rows(rows) + "".join(_list_html(*one) for one in lists)


def _values_html(result):
    return f"<p><b>{html.escape(type(result).__name__)}</b></p>{_result_html(result)}"


def _case_html(case):
    from . import _ripstop
    checked = _ripstop.check(case)
    remarks = "".join(f"<li>{html.escape(text)}</li>" for text in checked.warnings)
    return f"<p><b>{html.escape(case.title or 'Case')}</b></p><ul>{remarks}</ul>{_result_html(checked)}"


def _page_html(run):
    """The report of a run, with 3D view and plots, in a frame that cannot reach the notebook."""
    page = html.escape(run._page(), quote=True)
    return f'<iframe sandbox="allow-scripts" style="width:100%;height:{HEIGHT_PX}px;border:0" srcdoc="{page}"></iframe>'


def add_to(module):
    for member in vars(module).values():
        if isinstance(member, type) and "__match_args__" in vars(member):
            member._repr_html_ = _page_html if hasattr(member, "_page") else _values_html
    module.Case._repr_html_ = _case_html
