"""What drones' flight takes by weight, by published models or as a request states.

Constants and sources stand in docs/use/drones.md.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

from app.schemas.energy import ClimbInput, EnergyInput, Preset

G = 9.8
JOULES_PER_WH = 3600.0

Curve = Callable[[float], float]
"""Watts by kilograms aboard."""


class Powers(NamedTuple):
    """Powers by the weight aboard; whether they are straight lines; W for the weight of each Wh."""

    cruise: Curve
    hover: Curve
    climb: Curve
    descent: Curve
    are_linear: bool = True
    per_wh: float = 0.0


class Climb(NamedTuple):
    """Seconds and m/s of climb and descent."""

    up_seconds: float = 0.0
    up_speed: float = 0.0
    down_seconds: float = 0.0
    down_speed: float = 0.0


def climb_of(energy: EnergyInput, speed_kmh: float) -> Climb:
    """Return climb and descent as a request states them, else as its preset does."""
    stated = energy.climb
    if stated is not None:
        up = stated.altitude / stated.up_seconds if stated.up_seconds else 0.0
        down = stated.altitude / stated.down_seconds if stated.down_seconds else 0.0
        return Climb(stated.up_seconds, up, stated.down_seconds, down)
    if energy.preset != "murray-raj-2020":
        return Climb()
    up, down = speed_kmh / 3.6 / 2, speed_kmh / 3.6 / 4
    return Climb(MURRAY_RAJ_ALTITUDE / up + MURRAY_RAJ_HALF_TURN, up, MURRAY_RAJ_ALTITUDE / down,
                 down)


def powers_of(energy: EnergyInput, speed_kmh: float) -> Powers:
    """Return the powers of drones that fly at a speed."""
    if energy.preset is not None:
        return PRESETS[energy.preset](energy, speed_kmh)
    power, climb = energy.power, energy.climb or ClimbInput()
    if power is None:
        raise ValueError("energy power: None is not allowed")
    cruise = _line(power.cruise_w, power.cruise_w_per_kg)
    hover = _line(
        power.cruise_w if power.hover_w is None else power.hover_w,
        power.cruise_w_per_kg if power.hover_w_per_kg is None else power.hover_w_per_kg)
    return Powers(cruise, hover, _line(climb.up_w, climb.up_w_per_kg),
                  _line(climb.down_w, climb.down_w_per_kg))


def _line(empty: float, per_kg: float) -> Curve:
    return lambda weight: empty + per_kg * weight


MURRAY_RAJ_FRAME_KG, MURRAY_RAJ_ALTITUDE, MURRAY_RAJ_HALF_TURN = 1.5, 50.0, 0.5
K1, K2, C2, C4, C5 = 0.8554, 0.3051, 0.3177, 0.0296, 0.0279
ANGLE_OF_ATTACK = math.radians(10.0)


def _murray_raj(energy: EnergyInput, speed_kmh: float) -> Powers:
    """Return the nonlinear model, which is that of Liu et al. (2017)."""
    climb = climb_of(energy, speed_kmh)
    return Powers(lambda weight: murray_raj_flight(weight, speed_kmh / 3.6),
                  lambda weight: murray_raj_vertical(weight, 0.0),
                  lambda weight: murray_raj_vertical(weight, climb.up_speed),
                  lambda weight: murray_raj_vertical(weight, climb.down_speed),
                  are_linear=False)


def _induced(thrust: float, vertical_speed: float) -> float:
    half = vertical_speed / 2
    return K1 * thrust * (half + math.sqrt(half**2 + thrust / K2**2))


def murray_raj_vertical(weight: float, speed: float) -> float:
    """Return the watts of climbing or descending at a speed in m/s, or of hovering at none."""
    thrust = (MURRAY_RAJ_FRAME_KG + weight) * G
    return _induced(thrust, speed) + C2 * thrust**1.5


def murray_raj_flight(weight: float, speed: float) -> float:
    """Return the watts of level flight at a speed in m/s."""
    lift = (MURRAY_RAJ_FRAME_KG + weight) * G - C5 * (speed * math.cos(ANGLE_OF_ATTACK)) ** 2
    thrust = math.hypot(lift, C4 * speed**2)
    return _induced(thrust, 0.0) + C2 * thrust**1.5 + C4 * speed**3


MURRAY_RAJ_FAST = 1391.9916, 24.2368
MURRAY_RAJ_SLOW = 181.2141, 210.8011


def _always(line: Curve) -> Powers:
    """Return one power, whatever the drone does in the air."""
    return Powers(line, line, line, line)


DORLING_W_PER_KG, DORLING_W, DORLING_J_PER_KG = 46.7, 26.9, 650_000.0


def _dorling(energy: EnergyInput, speed_kmh: float) -> Powers:
    """Return a line by what the battery and the parcels weigh together."""
    per_wh = DORLING_W_PER_KG * JOULES_PER_WH / DORLING_J_PER_KG
    battery_kg = energy.battery_wh * JOULES_PER_WH / DORLING_J_PER_KG
    line = _line(DORLING_W + DORLING_W_PER_KG * battery_kg, DORLING_W_PER_KG)
    return _always(line)._replace(per_wh=per_wh)


RODRIGUES_DRONE_KG, AIR_DENSITY = 2.431, 1.225
RODRIGUES_CRUISE, RODRIGUES_UP, RODRIGUES_DOWN = (68.9, 16.8), (80.4, 13.8), (71.5, -24.3)


def _rodrigues(energy: EnergyInput, speed_kmh: float) -> Powers:
    """Return lines by the drone's and the parcels' weight to the power of 1.5."""
    def line(factor: float, offset: float) -> Curve:
        return lambda weight: (
            factor * (RODRIGUES_DRONE_KG + weight) ** 1.5 / math.sqrt(AIR_DENSITY) + offset)

    cruise = line(*RODRIGUES_CRUISE)
    return Powers(cruise, cruise, line(*RODRIGUES_UP), line(*RODRIGUES_DOWN), are_linear=False)


PRESETS: dict[Preset, Callable[[EnergyInput, float], Powers]] = {
    "murray-raj-2020": _murray_raj,
    "murray-raj-2020-linear-fast": lambda *_: _always(_line(*MURRAY_RAJ_FAST)),
    "murray-raj-2020-linear-slow": lambda *_: _always(_line(*MURRAY_RAJ_SLOW)),
    "dorling-2017": _dorling,
    "rodrigues-2022": _rodrigues,
}
