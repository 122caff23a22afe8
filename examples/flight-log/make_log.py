#!/usr/bin/env python3
"""Writes flight.csv: the log of a flight whose drag areas are known, as a flight computer would record it.

A mass of 22 kg falls from 1,500 m under a drogue of 0.30 m2; at 300 m a main fills to 6.0 m2 within 1.2 s. The barometer
has a lag of 0.3 s and a noise of 0.5 m, the accelerometer a noise of 0.3 m/s2, and 3 % of the rows are missing. The
ground is 200 m above sea level.
"""
import math
import pathlib
import random

MASS, GROUND, DROGUE, MAIN, FILLING = 22.0, 200.0, 0.30, 6.0, 1.2  # kg, m, m2, m2, s
STEP, RATE, GRAVITY = 0.002, 20, 9.80665  # s, 1/s, m/s2


def density(height):
    """Of the standard atmosphere below 11 km [kg/m3]."""
    return 1.225 * (1 - 2.25577e-5 * height) ** 4.25588


def main():
    chance = random.Random(3)
    height, speed, time, opened, sensed, rows = 1500.0, 0.0, 0.0, None, 1500.0, []
    while height > 0:
        if opened is None and height <= 300:
            opened = time
        share = 0 if opened is None else min(1, (time - opened) / FILLING)
        area = DROGUE + (MAIN - DROGUE) * share ** 2
        drag = 0.5 * density(GROUND + height) * area * speed ** 2
        if round(time / STEP) % round(1 / RATE / STEP) == 0 and chance.random() > 0.03:
            felt = drag / MASS + abs(chance.gauss(0, 0.3))
            rows.append(f"{time:.2f},{sensed + chance.gauss(0, 0.5):.2f},{felt:.2f}\n")
        speed += STEP * (GRAVITY - drag / MASS)
        height -= STEP * speed
        sensed += (height - sensed) * (1 - math.exp(-STEP / 0.3))
        time += STEP
    file = pathlib.Path(__file__).with_name("flight.csv")
    file.write_text("Time (s),Altitude (m),Acceleration (m/s^2)\n" + "".join(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
