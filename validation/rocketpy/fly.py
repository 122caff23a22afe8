#!/usr/bin/env python3
"""The descent under an exported file in RocketPy, compared with the result of `ripstop recovery`.

    ripstop recovery main.toml --drogue drogue.toml --mass 22 --apogee 3048 --ground 200 --steady runs/main \\
        --drogue-steady runs/drogue --out runs/recovery
    ripstop export rocketpy runs/main --trigger 300 --deployment-speed 24 --drogue runs/drogue --drogue-speed 20 \\
        --out parachutes.py
    /usr/bin/python3 validation/rocketpy/fly.py parachutes.py runs/recovery/result.json

Still air. Needs RocketPy 1.12 or later. The rocket is a mass without drag that begins at apogee.
"""
import importlib.util
import json
import pathlib
import sys

try:
    from rocketpy import Environment, Flight, Rocket, StochasticRocket
except ImportError as error:
    sys.exit(f"RocketPy cannot be imported ({error}): install it, or set PYTHONPATH to its sources")

SPEED, DRAWS = 20, 4000  # horizontal at apogee [m/s], the default of ripstop recovery; of every parachute


def read(path):
    spec = importlib.util.spec_from_file_location("parachutes", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def fly(module, result, overshoot):
    environment = Environment(elevation=result["ground_m"], gravity=9.80665)
    environment.set_atmospheric_model(type="standard_atmosphere")
    rocket = Rocket(radius=0.1, mass=result["total_mass_kg"], inertia=(10, 10, 0.1), power_off_drag=0, power_on_drag=0,
                    center_of_mass_without_motor=0)
    added = module.add_to(rocket)
    begin = [0, 0, 0, result["ground_m"] + result["apogee_m"], SPEED, 0, 0, 1, 0, 0, 0, 0, 0, 0]
    flight = Flight(rocket=rocket, environment=environment, rail_length=5, inclination=90, heading=0, initial_solution=begin,
                    max_time=3600, time_overshoot=overshoot)
    return rocket, added, flight


def main():
    module, result = read(sys.argv[1]), json.loads(pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"))
    for overshoot in (True, False):
        rocket, added, flight = fly(module, result, overshoot)
        print(f"time_overshoot={overshoot}")
        for time, parachute in flight.parachute_events:
            print(f"  {parachute.name}: trigger {time:.2f} s, {flight.z(time) - result['ground_m']:.1f} m, "
                  f"{-flight.vz(time):.2f} m/s down; lag {parachute.lag:.3f} s, drag area {parachute.cd_s:.4f} m2")
        print(f"  landing {flight.t_final:.2f} s, {-flight.vz(flight.t_final):.4f} m/s")
    print("ripstop recovery")
    for stage in result["stages"]:
        print(f"  {stage['stage']}: {stage['time_s']:.2f} s, {stage['height_m']:.1f} m, {stage['speed_m_s']['value']:.2f} m/s; "
              f"filling time {stage['filling_time_s']:.3f} s")
    print(f"  landing {result['time_s']['value']:.2f} s, {result['landing_speed_m_s']['value']:.4f} m/s")
    stochastic = StochasticRocket(rocket=rocket)
    module.add_stochastic_to(stochastic, added)
    print(f"StochasticParachute, {DRAWS} draws: mean and standard deviation of the drag area [m2] and the lag [s], least lag [s]")
    for parachute in stochastic.parachutes:
        drawn = [parachute.create_object() for _ in range(DRAWS)]
        area, lag = [p.cd_s for p in drawn], [p.lag for p in drawn]
        print("  " + ", ".join(f"{value:.4f}" for value in (*moments(area), *moments(lag), min(lag))))


def moments(values):
    mean = sum(values) / len(values)
    return mean, (sum((v - mean) ** 2 for v in values) / len(values)) ** 0.5


if __name__ == "__main__":
    main()
