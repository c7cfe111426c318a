"""Warnings about wind by the hour: whom its worst hour keeps drones from."""

import numpy as np

from app.requests.conversion.names import drones_of
from app.requests.conversion.service import by_any
from app.requests.conversion.winds import Winds
from app.requests.warnings.survey import Survey
from app.requests.warnings.warning import Warnings, amount_text, customers_text, warning_at
from app.schemas.drones import DEFAULT_DRONE_SPEED_KMH, DronesInput, Flyer
from app.schemas.vehicle import VehicleTypeInput
from model.problem import BoolArray, FloatArray
from model.travel.matrices import LocalProjection
from model.travel.wind import Breeze, Wind


def wind_warnings(survey: Survey) -> Warnings:
    """Yield a warning for each type of drones that would reach more customers at its best hour."""
    winds = Winds(survey.request)
    if winds.is_steady or not len(survey.bases) or not len(survey.customers):
        return
    for index, kind in enumerate(survey.request.fleet):
        for inner, drones in kind.flyers_by_path:
            felt = winds.flown(kind, drones)
            if len(felt) < 2 or not drones.count or drones.profile in (
                    survey.request.matrices or {}):
                continue
            lost = int(np.count_nonzero(_lost(survey, kind, drones, felt)))
            if lost:
                strongest = max(speed for speed, _ in felt)
                yield warning_at(
                    "WIND_AT_WORST", ("fleet", index, *inner),
                    f"{customers_text(lost, len(survey.customers))} too far from the depot for "
                    f"drones of {kind.id!r} at the worst hour of the shift, and not at its best: "
                    "all flights take as long as in their worst hour. The wind reaches "
                    f"{amount_text(strongest)} km/h: state max_wind_kmh to leave such hours out, "
                    "or plan a shorter shift.")


def _lost(survey: Survey, kind: VehicleTypeInput, drones: Flyer,
          felt: tuple[Breeze, ...]) -> BoolArray:
    """Mark the customers a drone reaches from the nearest base and back in some wind, not in all.
    """
    away = _metres(survey)
    service = _services(survey, kind, drones)
    airspeed = drones.speed_kmh or DEFAULT_DRONE_SPEED_KMH
    limit = np.inf if drones.endurance is None else drones.endurance
    lengths = np.hypot(*away.T)
    some = np.zeros(len(away), bool)
    worst = np.zeros((2, len(away)))
    for breeze in felt:
        wind = Wind.blowing(*breeze, airspeed)
        ways = np.array([wind.durations(sign * away[:, 0], sign * away[:, 1], lengths)
                         for sign in (1, -1)])
        worst = np.maximum(worst, ways)
        some |= _lasts(ways, service, limit)
    lost: BoolArray = some & ~_lasts(worst, service, limit)
    return lost


def _services(survey: Survey, kind: VehicleTypeInput, drones: Flyer) -> FloatArray:
    """Return (customer,) the seconds that a drone serves each."""
    if not isinstance(drones, DronesInput):
        return np.array([each.service_duration_by_type.get(kind.id, each.service_duration)
                         for each in survey.customers])
    name, own = drones_of(kind.id, drones.id), drones.service_duration
    places = by_any(survey.customers)
    return np.array([each.service_duration_by_type.get(
        name, each.service_duration if own is None or each.id in places else own)
        for each in survey.customers])


def _lasts(ways: FloatArray, service: FloatArray, limit: float) -> BoolArray:
    lasts: BoolArray = np.isfinite(ways).all(axis=0) & (ways.sum(axis=0) + service <= limit)
    return lasts


def _metres(survey: Survey) -> FloatArray:
    """Return (customer, 2) metres east and north from the nearest base; far away if unknown."""
    places = np.concatenate([survey.bases, survey.points])
    if survey.is_geographic:
        places = LocalProjection.around(survey.bases).project(places)
    else:
        places = places * survey.request.planar_unit
    bases, points = np.split(places, [len(survey.bases)])
    steps = points[:, None] - bases
    nearest = np.nan_to_num(np.hypot(*steps.T).T, nan=np.inf).argmin(axis=1)
    return steps[np.arange(len(points)), nearest]
