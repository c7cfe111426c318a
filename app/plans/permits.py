"""What of a customer's `vehicles` forbids a type, as remedies name it: all that would change."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from app.plans.replies import Data
from app.requests.conversion.groups import Place, Roster
from app.schemas.customer import VehiclesInput
from app.schemas.request import PlanRequest

_BARRED = re.compile("^fits if .+? may serve it(?=$| and )", re.DOTALL)


@dataclass(frozen=True)
class Permits:
    """Who lets only some vehicles serve him, by the names that he states."""

    roster: Roster | None = None
    indices: Mapping[str, int] = field(default_factory=dict)  # of types, by id
    counts: Mapping[str, int] = field(default_factory=dict)
    choosy: Mapping[str, VehiclesInput] = field(default_factory=dict)  # by id of customer
    found: dict[str, Place | None] = field(default_factory=dict)  # by name, as far as looked for

    @classmethod
    def of(cls, request: PlanRequest) -> "Permits":
        """Return those of a request's customers."""
        choosy = {customer.id: customer.vehicles for customer in request.customers
                  if customer.vehicles is not None and customer.vehicles.names}
        if not choosy:
            return cls()
        return cls(Roster(request.fleet),
                   {kind.id: index for index, kind in enumerate(request.fleet)},
                   {kind.id: kind.count for kind in request.fleet}, choosy)

    def name(self, customer: str, reasons: Iterable[Data]) -> None:
        """Have remedies name all that a customer would have to allow. In place."""
        vehicles = self.choosy.get(customer)
        if vehicles is None:
            return
        for reason in reasons:
            if reason["code"] == "VEHICLE" and reason["remedy"] is not None:
                names = " and ".join(self._barring(vehicles, reason["vehicle_type"]))
                # What else has to change stands behind.
                _, behind = _BARRED.split(reason["remedy"], maxsplit=1)
                reason["remedy"] = f"fits if {names} may serve it{behind}"

    def _barring(self, vehicles: VehiclesInput, kind: str) -> list[str]:
        """Return the fewest names to be allowed, or forbidden no more, for one of a type."""
        if vehicles.forbidden is None:
            return [kind]
        places: dict[Place, str] = {}
        for name in vehicles.forbidden:
            place = self._find(name)
            if place is not None and place[0] == self.indices[kind]:
                places.setdefault(place, name)
        whole = [name for (_, number), name in places.items() if number is None]
        single = [name for (_, number), name in places.items() if number is not None]
        is_each = len(single) == self.counts[kind]
        return [*whole, *single[:is_each]] or [kind]

    def _find(self, name: str) -> Place | None:
        """Return what a name means: thousands of customers may forbid the same thousand."""
        if name not in self.found:
            self.found[name] = None if self.roster is None else self.roster.find(name)
        return self.found[name]
