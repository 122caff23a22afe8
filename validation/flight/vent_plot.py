"""Draws docs/tables/spill-hole.svg: coefficients and oscillation of a flat circular canopy over the diameter of its vent."""
SIZE, TOP, HEIGHT, WIDTH = (760, 400), 60, 260, 290
COEFFICIENTS, ANGLES, VENTS = (0, 1.2), (0, 40), (0, 25)
AXIAL, FLOWN = "#0072B2", "#D55E00"  # Okabe and Ito (2008)


def across(left, share):
    return left + WIDTH * (share - VENTS[0]) / (VENTS[1] - VENTS[0])


def up(value, scale):
    return TOP + HEIGHT * (scale[1] - value) / (scale[1] - scale[0])


def text(x, y, words, anchor="middle"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def line(x1, y1, x2, y2, colour, width=1.0):
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" stroke-width="{width}"/>'


def axes(left, scale, step, title):
    drawn = [f'<rect x="{left}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#000"/>',
             text(left + WIDTH / 2, TOP - 12, title), text(left + WIDTH / 2, TOP + HEIGHT + 40, "vent diameter, % of nominal diameter")]
    for share in range(VENTS[0], VENTS[1] + 1, 5):
        drawn += [line(across(left, share), TOP, across(left, share), TOP + HEIGHT, "#ddd"),
                  text(across(left, share), TOP + HEIGHT + 18, str(share))]
    for n in range(round((scale[1] - scale[0]) / step) + 1):
        value = scale[0] + n * step
        drawn += [line(left, up(value, scale), left + WIDTH, up(value, scale), "#ddd"),
                  text(left - 8, up(value, scale) + 4, f"{value:g}", "end")]
    return drawn


def series(left, scale, points, colour):
    """Points (share, value, standard error or None) with error bars, joined by lines."""
    places = [(across(left, share), up(value, scale)) for share, value, _ in points]
    drawn = [line(*a, *b, colour, 1.5) for a, b in zip(places, places[1:])]
    for (x, y), (_, value, error) in zip(places, points):
        if error is not None:
            drawn.append(line(x, up(value - error, scale), x, up(value + error, scale), colour, 1.5))
        drawn.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>')
    return drawn


def write(path, axial, flown, angles):
    """Points (vent diameter in % of the nominal diameter, value, standard error or None) of each series."""
    left, right = 60, 60 + WIDTH + 90
    drawn = [*axes(left, COEFFICIENTS, 0.2, "drag coefficient on the nominal area"), *axes(right, ANGLES, 10, "mean oscillation, degrees"),
             *series(left, COEFFICIENTS, axial, AXIAL), *series(left, COEFFICIENTS, flown, FLOWN), *series(right, ANGLES, angles, FLOWN)]
    for x, colour, words in ((left, AXIAL, "on the axis"), (left + 130, FLOWN, "in descent")):
        drawn += [f'<circle cx="{x + 6}" cy="{SIZE[1] - 16}" r="4" fill="{colour}"/>', text(x + 18, SIZE[1] - 12, words, "start")]
    drawn.append(text(SIZE[0] / 2, 24, "Flat circular canopy of 1.76 m with 2.4 kg: size of the vent"))
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{SIZE[0]}" height="{SIZE[1]}" '
                    f'viewBox="0 0 {SIZE[0]} {SIZE[1]}" font-family="sans-serif" font-size="13">\n'
                    '<rect width="100%" height="100%" fill="#fff"/>\n' + "\n".join(drawn) + "\n</svg>\n")
