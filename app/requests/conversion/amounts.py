"""How finely amounts are counted: in thousandths, or in smaller parts where a request needs them.

Inside `model`, amounts are whole numbers, so that a load is exactly what its parts add up to. An
amount that would have to be rounded for that is refused: a hundred customers of 0.0004 each don't
fit a capacity of 0.001.
"""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from app.schemas.customer import CustomerInput
from app.schemas.errors import InputError, json_path
from app.schemas.vehicle import VehicleTypeInput
from model.problem import MAX_QUANTITY, USUAL_DECIMALS, BoolArray, FloatArray

MAX_DECIMALS = 9
"""Most decimals that are counted, of amounts up to a thousand; fewer of larger ones."""

NOISE = 2e-13
"""What sums of floats may be off, such as 0.1 + 0.2, as a share. A third is off by more."""

Path = tuple[str | int, ...]
Customers = Iterable[CustomerInput | None]
Fleet = Iterable[VehicleTypeInput | None]


def amount_errors(customers: Customers, fleet: Fleet) -> Iterator[InputError]:
    """Yield an error for each amount that can't be held as it is."""
    stated = list(_stated(customers, fleet))
    for dimension in range(max([len(amounts) for _, amounts in stated], default=0)):
        column = [(path, amounts[dimension]) for path, amounts in stated
                  if len(amounts) > dimension]
        values = np.array([amount for _, amount in column])
        decimals = _decimals_for(values)
        for index in np.flatnonzero(~_fits(values, decimals)).tolist():
            path, amount = column[index]
            yield InputError(
                code="TOO_FINE", path=json_path((*path, dimension)),
                message=f"Beside an amount of {values.max():g}, amounts are counted in steps of "
                f"{10.0**-decimals:g}, and {amount!r} lies between two: round it, or state "
                "amounts of this dimension in a smaller unit.")


def decimals_of(customers: Customers, fleet: Fleet) -> tuple[int, ...]:
    """Return how many decimals are counted of each dimension of a valid request."""
    columns = zip(*(amounts for _, amounts in _stated(customers, fleet)), strict=True)
    return tuple([_decimals_for(np.array(column)) for column in columns])


def counted(amounts: Iterable[float], decimals: Iterable[int]) -> tuple[int, ...]:
    """Return amounts as whole numbers."""
    return tuple([round(amount * 10**places)
                  for amount, places in zip(amounts, decimals, strict=True)])


def _stated(customers: Customers, fleet: Fleet) -> Iterator[tuple[Path, Sequence[float]]]:
    """Yield all amounts with their paths."""
    for index, vehicle_type in enumerate(fleet):
        if vehicle_type is not None:
            yield ("fleet", index, "capacity"), vehicle_type.capacity
            for path, drones in vehicle_type.drones_by_path:
                yield ("fleet", index, *path, "capacity"), drones.capacity
            for number, each in enumerate(vehicle_type.breaks):
                if each.max_load is not None:
                    yield ("fleet", index, "breaks", number, "max_load"), each.max_load
    for index, customer in enumerate(customers):
        if customer is not None:
            yield ("customers", index, "demand"), customer.demand
            if customer.pickup is not None:
                yield ("customers", index, "pickup"), customer.pickup


def _decimals_for(amounts: FloatArray) -> int:
    """Return how many decimals hold all amounts, or as many as can be counted."""
    odd = amounts[~_fits(amounts, USUAL_DECIMALS)]
    if not len(odd):
        return USUAL_DECIMALS
    countable = [decimals for decimals in range(USUAL_DECIMALS, MAX_DECIMALS + 1)
                 if amounts.max() * 10**decimals <= MAX_QUANTITY]
    return next((decimals for decimals in countable if _fits(odd, decimals).all()), countable[-1])


def _fits(amounts: FloatArray, decimals: int) -> BoolArray:
    """Tell which amounts have no more than so many decimals, but for a float's own noise."""
    parts = amounts * 10**decimals
    fits: BoolArray = np.abs(parts - np.rint(parts)) <= NOISE * parts
    return fits
