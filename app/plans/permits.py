"""What of a customer's `vehicles` forbids a type, as remedies name it: all that would change."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from app.requests.conversion.groups import Place, Roster
from app.schemas.customer import VehiclesInput
from app.schemas.request import PlanRequest
from model.counsel.explain import Reason
from model.counsel.remedy import Change


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

    def named(self, customer: str, kind: str, reason: Reason) -> Reason:
        """Return a reason why a type doesn't serve a customer with all that he would have to allow.
        """
        vehicles = self.choosy.get(customer)
        if vehicles is None or not reason.remedies:
            return reason

        def barring(change: Change) -> Change:
            if change.limit != "vehicles":
                return change
            return change._replace(names=tuple(self._barring(vehicles, kind)))

        return replace(reason, remedies=tuple(
            [remedy.with_changes(barring) for remedy in reason.remedies]))

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
