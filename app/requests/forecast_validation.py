"""What the schema can't tell of orders that may come."""

import re
from collections.abc import Iterator

from app.requests.draft import Draft
from app.requests.validation import semantic_errors
from app.schemas.customer import CustomerInput
from app.schemas.errors import InputError
from app.schemas.forecast import MAX_PAST_ORDERS, ComingInput
from app.schemas.request import PlanRequest

_CUSTOMER = re.compile(r"\$\.customers\[(\d+)\](.*)", re.DOTALL)


def forecast_errors(request: PlanRequest, draft: Draft) -> Iterator[InputError]:
    """Yield what is wrong with the forecast of a request that is valid without."""
    forecast = request.forecast
    if forecast is None:
        return
    for name, is_stated in (
            ("shipments", bool(request.shipments)), ("relations", bool(request.relations)),
            ("fairness", request.fairness != type(request.fairness)()),
            ("alternatives", any(each.alternatives for each in request.customers))):
        if is_stated:
            yield InputError(code="CONTRADICTION", path="$.forecast", message=f"With {name} it "
                             "isn't decided who waits: remove the forecast, or them.")
    orders = orders_to_come(forecast)
    if len(orders) > MAX_PAST_ORDERS:
        yield InputError(code="WRONG_LENGTH", path="$.forecast", message=f"There are {len(orders)} "
                         f"orders, and at most {MAX_PAST_ORDERS} are allowed: leave some days out.")
        return
    paths = list(_paths(forecast))
    for error in semantic_errors(Draft(
            draft.coordinate_system, draft.planar_unit, draft.depots, orders, draft.fleet,
            draft.matrices, draft.matrices_known, draft.airspace, draft.options,
            planar_rounding=draft.planar_rounding, load_dimensions=draft.load_dimensions,
            day=draft.day, incompatible_goods=draft.incompatible_goods,
            launch_sites=draft.launch_sites), None):
        match = _CUSTOMER.fullmatch(error.path)
        if match is not None:
            yield error.model_copy(update={"path": paths[int(match[1])] + match[2]})


def orders_to_come(forecast: ComingInput) -> list[CustomerInput]:
    """Return the orders of a forecast as customers with names of their own."""
    names = CustomerInput.model_fields
    return [CustomerInput.model_construct(None, **{
        **{name: getattr(order, name) for name in names}, "id": f"to come/{number}",
        "alternatives": [], "vehicles": None, "vehicle_costs": {}})
        for number, order in enumerate(forecast.orders())]


def _paths(forecast: ComingInput) -> Iterator[str]:
    for name, lists in (("past_days[{}]", forecast.past_days),
                        ("rates[{}].like", [rate.like for rate in forecast.rates])):
        for index, orders in enumerate(lists):
            for place in range(len(orders)):
                yield f"$.forecast.{name.format(index)}[{place}]"
