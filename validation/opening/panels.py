"""Panels of an SVG: points and lines over a logarithmic axis."""
import math

WIDTH, HEIGHT, TOP, MARGIN = 290, 240, 40, 70  # [px]


class Panel:
    """One panel; `x` is a logarithmic range with its labels, `y` a linear range from 0 with its step."""

    def __init__(self, number, title, subject, x, labels, y, step):
        self.left, self.x, self.y = MARGIN + number * (WIDTH + 90), x, y
        middle = self.left + WIDTH / 2
        self.drawn = [f'<rect x="{self.left}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#000"/>',
                      self.text(middle, TOP - 12, title), self.text(middle, TOP + HEIGHT + 36, subject)]
        for value, label in labels.items():
            self.drawn += [f'<path d="M{self.across(value):.1f} {TOP}v{HEIGHT}" stroke="#ddd"/>',
                           self.text(self.across(value), TOP + HEIGHT + 16, label)]
        for k in range(round(y / step) + 1):
            self.drawn += [f'<path d="M{self.left} {self.up(k * step):.1f}h{WIDTH}" stroke="#ddd"/>',
                           self.text(self.left - 8, self.up(k * step) + 4, f"{k * step:g}", "end")]

    @staticmethod
    def text(x, y, words, anchor="middle", colour="#000"):
        return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{words}</text>'

    def across(self, value):
        low, high = map(math.log, self.x)
        return self.left + WIDTH * (math.log(value) - low) / (high - low)

    def up(self, value):
        return TOP + HEIGHT * (1 - value / self.y)

    def line(self, points, colour, dashes=""):
        places = " ".join(f"{self.across(x):.1f},{self.up(y):.1f}" for x, y in points if 0 <= y <= self.y)
        self.drawn.append(f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="1.5" stroke-dasharray="{dashes}"/>')

    def marks(self, points, colour, filled=True):
        for x, y in points:
            self.drawn.append(f'<circle cx="{self.across(x):.1f}" cy="{self.up(y):.1f}" r="4" stroke="{colour}" stroke-width="1.5" '
                              f'fill="{colour if filled else "#fff"}"/>')

    def words(self, x, y, words, colour, anchor="start"):
        self.drawn.append(self.text(self.across(x), self.up(y) - 5, words, anchor, colour))


def write(path, panels, legend):
    """`legend`: lines of (colour, dashes, marker: "filled", "open" or "", words)."""
    width, low = MARGIN + len(panels) * (WIDTH + 90) - 50, TOP + HEIGHT + 60
    drawn = [part for panel in panels for part in panel.drawn]
    for i, (colour, dashes, marker, words) in enumerate(legend):
        x, y = MARGIN + (i % 2) * (WIDTH + 90), low + 18 * (i // 2)
        drawn.append(f'<path d="M{x} {y}h30" stroke="{colour}" stroke-width="1.5" stroke-dasharray="{dashes}"/>')
        if marker:
            drawn.append(f'<circle cx="{x + 15}" cy="{y}" r="4" stroke="{colour}" stroke-width="1.5" '
                         f'fill="{"#fff" if marker == "open" else colour}"/>')
        drawn.append(Panel.text(x + 38, y + 4, words, "start"))
    height = low + 18 * ((len(legend) + 1) // 2) + 4
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            'font-family="sans-serif" font-size="12">', f'<rect width="{width}" height="{height}" fill="#fff"/>']
    path.write_text("\n".join([*head, *drawn, "</svg>"]) + "\n")
