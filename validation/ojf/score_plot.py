"""Draws docs/validation/blind-test.svg: computed over measured loads, and their error over the measured load."""
import math

# Colours that colour-blind readers can distinguish (Okabe and Ito, 2008), and a shape for each parachute.
STYLES = {"stratos-iv": ("#0072B2", "circle"), "walrus": ("#D55E00", "square"), "adept": ("#009E73", "triangle")}
LOADS = (20, 1500)  # N, both axes of the left panel
ERRORS = (-30, 40)  # %, vertical axis of the right panel
SIZE, TOP, HEIGHT = (960, 560), 70, 380
PANELS = {"left": (70, 380), "right": (560, 380)}  # left edge, width


def marker(shape, x, y, colour, filled, size=5):
    fill = colour if filled else "#fff"
    paint = f'fill="{fill}" stroke="{colour}" stroke-width="1.5"'
    if shape == "circle":
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size}" {paint}/>'
    corners = {"square": [(-1, -1), (1, -1), (1, 1), (-1, 1)], "triangle": [(-1.15, 0.9), (1.15, 0.9), (0, -1.2)],
               "star": [(math.sin(i * math.pi / 5) * (1.5 if i % 2 == 0 else 0.65),
                         -math.cos(i * math.pi / 5) * (1.5 if i % 2 == 0 else 0.65)) for i in range(10)]}[shape]
    points = " ".join(f"{x + size * a:.1f},{y + size * b:.1f}" for a, b in corners)
    return f'<polygon points="{points}" {paint}/>'


def text(x, y, words, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{words}</text>'


def line(x1, y1, x2, y2, colour="#000", width=1.0, more=""):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'stroke-width="{width}"{more}/>')


def across(panel, load):
    left, width = PANELS[panel]
    return left + width * math.log(load / LOADS[0]) / math.log(LOADS[1] / LOADS[0])


def up_load(load):
    return TOP + HEIGHT * (1 - math.log(load / LOADS[0]) / math.log(LOADS[1] / LOADS[0]))


def up_error(percent):
    return TOP + HEIGHT * (ERRORS[1] - percent) / (ERRORS[1] - ERRORS[0])


def axes():
    drawn = []
    for panel, (left, width) in PANELS.items():
        drawn.append(f'<rect x="{left}" y="{TOP}" width="{width}" height="{HEIGHT}" fill="none" stroke="#000"/>')
        for load in (20, 50, 100, 200, 500, 1000):
            x = across(panel, load)
            drawn += [line(x, TOP, x, TOP + HEIGHT, "#ddd"), text(x, TOP + HEIGHT + 18, str(load))]
            if panel == "left":
                drawn += [line(left, up_load(load), left + width, up_load(load), "#ddd"),
                          text(left - 8, up_load(load) + 4, str(load), "end")]
        drawn.append(text(left + width / 2, TOP + HEIGHT + 40, "measured, N"))
    left, width = PANELS["right"]
    for error in range(ERRORS[0], ERRORS[1] + 1, 10):
        drawn += [line(left, up_error(error), left + width, up_error(error), "#000" if error == 0 else "#ddd"),
                  text(left - 8, up_error(error) + 4, f"{error:+d}" if error else "0", "end")]
    turned = ' transform="rotate(-90 {:.0f} {:.0f})"'
    for x, words in ((20, "computed, N"), (515, "computed / measured - 1, %")):
        drawn.append(text(x, TOP + HEIGHT / 2, words, more=turned.format(x, TOP + HEIGHT / 2)))
    ends = [(across("left", load), up_load(load)) for load in LOADS]
    drawn.append(line(*ends[0], *ends[1]))
    return drawn


def bar(x, low, high, colour):
    return [line(x, low, x, high, colour), line(x - 3, low, x + 3, low, colour), line(x - 3, high, x + 3, high, colour)]


def point(load):
    """Markers and error bars of a load in both panels. A load has its parachute, its kind ("nominal" or "measured"
    speed, or "peak"), the measured and the computed load and the stated uncertainty (None: none was stated), in N."""
    colour, shape = STYLES[load["parachute"]]
    measured, computed, pm = load["measured"], load["computed"], load["pm"]
    shape, filled = ("star", True) if load["kind"] == "peak" else (shape, load["kind"] == "nominal")
    x, right = across("left", measured), across("right", measured)
    drawn = []
    if pm:
        drawn += bar(x, up_load(computed - pm), up_load(computed + pm), colour)
        drawn += bar(right, *(up_error(100 * ((computed + of) / measured - 1)) for of in (-pm, pm)), colour)
    return drawn + [marker(shape, x, up_load(computed), colour, filled),
                    marker(shape, right, up_error(100 * (computed / measured - 1)), colour, filled)]


def legend(names):
    drawn, x, y = [], 70, TOP + HEIGHT + 70
    for parachute, name in names.items():
        colour, shape = STYLES[parachute]
        drawn += [marker(shape, x, y - 4, colour, True), text(x + 12, y, name, "start")]
        x += 100
    for shape, filled, words, step in (("circle", True, "drag, nominal speed", 170),
                                       ("circle", False, "drag, measured speed", 180),
                                       ("star", True, "peak load of the opening", 0)):
        drawn += [marker(shape, x, y - 4, "#555", filled), text(x + 12, y, words, "start")]
        x += step
    return drawn


def draw(path, loads, names):
    """Every load as a marker in each panel; in the right one a dotted line joins the two speed bases of a point."""
    drawn = axes()
    by_basis = {}
    for load in loads:
        if load["kind"] != "peak":
            by_basis.setdefault((load["parachute"], load["measured"]), []).append(load["computed"])
    for (parachute, measured), computed in by_basis.items():
        ends = [up_error(100 * (one / measured - 1)) for one in computed]
        x = across("right", measured)
        drawn.append(line(x, ends[0], x, ends[-1], STYLES[parachute][0], 1, ' stroke-dasharray="2 3"'))
    for kind in ("measured", "nominal", "peak"):
        drawn += [mark for load in loads if load["kind"] == kind for mark in point(load)]
    note = ("Bars: uncertainty stated with the prediction, drawn for the nominal speeds and the peaks; "
            "none was stated for the drag of ADEPT.")
    drawn += [text(SIZE[0] / 2, 28, "Uncalibrated predictions against the Open Jet Facility", more=' font-size="17"'),
              text(SIZE[0] / 2, 50, "drag: unsteady flow in the open jet; peaks: coupled inflation; "
                   "WALRUS and ADEPT are blind, Stratos IV is not"),
              *legend(names), text(70, SIZE[1] - 12, note, "start")]
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIZE[0]}" height="{SIZE[1]}" '
                    f'viewBox="0 0 {SIZE[0]} {SIZE[1]}" font-family="sans-serif" font-size="13">\n'
                    '<rect width="100%" height="100%" fill="#fff"/>\n' + "\n".join(drawn) + "\n</svg>\n")
