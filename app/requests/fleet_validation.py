"""What the schema can't tell of a vehicle type."""

import re
from collections.abc import Mapping, Sequence
from math import inf

from app.requests.conversion.amounts import counted, decimals_of
from app.requests.conversion.energy import is_countable
from app.requests.conversion.units import thousandths
from app.requests.draft import Draft, Errors, Path, error_at
from app.schemas.driving import REST_ID
from app.schemas.drones import Flyer, TurnaroundInput
from app.schemas.energy import EnergyInput
from app.schemas.launch_site import HoursInput
from app.schemas.vehicle import BreakInput, SpeedChangeInput, VehicleTypeInput
from app.schemas.times import Written
from model.problem import MAX_QUANTITY


def shift_errors(draft: Draft) -> Errors:
    """Say which shifts end before they start."""
    for path, vehicle_type in draft.vehicle_types():
        earliest, latest = vehicle_type.shift.earliest, vehicle_type.shift.latest
        if latest is not None and latest < earliest:
            yield error_at("SHIFT_ENDS_BEFORE_START", (*path, "shift", "latest"),
                           f"The shift ends at {draft.told(latest)}, before it starts at "
                           f"{draft.told(earliest)}: {draft.next_day(earliest, latest)}raise "
                           "latest or lower earliest.")


def hours_errors(draft: Draft) -> Errors:
    """Say which depots' hours can't be, or leave a vehicle type no day of its own."""
    depots = draft.depots or ()
    for index, depot in enumerate(depots):
        hours = HoursInput() if depot is None else depot.time_window
        if hours.latest is not None and hours.latest < hours.earliest:
            yield error_at("WINDOW_ENDS_BEFORE_START", ("depots", index, "time_window", "latest"),
                           f"The window ends at {draft.told(hours.latest)}, before it starts at "
                           f"{draft.told(hours.earliest)}: raise latest or lower earliest.")
    known = {depot.id: depot.time_window for depot in depots if depot is not None}
    if (len(known) < len(depots) or all(hours == HoursInput() for hours in known.values())
            or any(_closing(hours) < hours.earliest for hours in known.values())):
        return
    first = next(iter(known))
    for path, kind in draft.vehicle_types():
        if {kind.depot or first, *kind.reload_depots} <= known.keys():
            yield from _hours_of_type(kind, path, known, kind.depot or first)


def _hours_of_type(kind: VehicleTypeInput, path: Path, known: Mapping[str, HoursInput],
                   home: str) -> Errors:
    """Say what a vehicle type's day misses, or can't be told, by the hours of its depots."""
    overtime, shift = kind.overtime, kind.shift
    over = 0.0 if overtime is None else overtime.max_duration
    last = inf if shift.latest is None or over is None else shift.latest + over
    opens, closes, hours = shift.earliest, last, known[home]
    starts_there = kind.start_location is None and kind.start_location_index is None
    if starts_there:
        opens = max(opens, hours.earliest)
    if kind.end == "depot":
        closes = min(closes, _closing(hours))
    leaves = _closing(hours) if starts_there else inf
    if opens > min(closes, leaves) or (shift.latest is not None
                                       and shift.earliest <= shift.latest < opens):
        yield error_at("DEPOT_CLOSED", (*path, "shift"),
                       f"The depot {home!r} isn't open during the shift: change the depot's "
                       "time_window or the shift.")
    elif kind.flies and any(known[place].earliest > opens for place in kind.reload_depots):
        yield error_at("HOURS_DIFFER", path,
                       "A depot that it lands at opens after its day begins, and nobody waits in "
                       "the air for that: let its shift begin later, or the depot open sooner.")


def _closing(hours: HoursInput) -> float:
    return inf if hours.latest is None else hours.latest


def _start_errors(path: Path, each: BreakInput) -> Errors:
    """Say which ends of a break's start are written as what they aren't."""
    for name, end in (("earliest", each.start.earliest), ("latest", each.start.latest)):
        if not isinstance(end, Written) or end.is_length == each.after_departure:
            continue
        if end.is_length:
            yield error_at("WRONG_TYPE", (*path, "start", name),
                           f"{end.text} is a length of time, and the break is stated by instants: "
                           "state after_departure, or write a time such as 12:30.")
        else:
            clock = re.fullmatch(r"(\d\d?):(\d\d)(?::\d\d)?", end.text)
            length = "PT5H30M" if clock is None else f"PT{int(clock[1])}H{int(clock[2])}M"
            yield error_at("WRONG_TYPE", (*path, "start", name),
                           f"{end.text} is an instant, and with after_departure this is a length "
                           f"of time from then on: write it as seconds or such as {length}.")


def break_errors(draft: Draft) -> Errors:
    """Say which breaks can't begin, or can't be told from others of their driver."""
    for path, vehicle_type in draft.vehicle_types():
        seen: dict[str, int] = {}
        for index, each in enumerate(vehicle_type.breaks):
            here, start = (*path, "breaks", index), each.start
            miswritten = list(_start_errors(here, each))
            yield from miswritten
            if not miswritten and start.latest is not None and start.latest < start.earliest:
                ends, starts = ([f"{end:g} s" for end in (start.latest, start.earliest)]
                                if each.after_departure
                                else map(draft.told, (start.latest, start.earliest)))
                yield error_at("WINDOW_ENDS_BEFORE_START", (*here, "start", "latest"),
                               f"The window ends at {ends}, before it starts at {starts}: raise "
                               "latest or lower earliest.")
            if seen.setdefault(each.id, index) != index:
                yield error_at("DUPLICATE_ID", (*here, "id"),
                               f"breaks[{seen[each.id]}] has the same id: give each its own.")
            if each.id == REST_ID and vehicle_type.driving_rules is not None:
                yield error_at("DUPLICATE_ID", (*here, "id"),
                               "So are rests by driving_rules called: give the break another id.")


def driving_errors(draft: Draft) -> Errors:
    """Say which driving rules lack a number."""
    for path, kind in draft.vehicle_types():
        rules = kind.driving_rules
        if rules is None:
            continue
        if rules.break_duration is None:
            yield error_at("MISSING_BREAK_DURATION", (*path, "driving_rules", "break_duration"),
                           "Nothing says how long a rest is: state break_duration, or a preset.")


def depot_errors(draft: Draft) -> Errors:
    """Say which types name a depot that isn't there."""
    if draft.depots is None or None in draft.depots:
        return
    known = {depot.id for depot in draft.depots if depot is not None}
    for path, vehicle_type in draft.vehicle_types():
        if vehicle_type.depot is not None and vehicle_type.depot not in known:
            yield error_at("UNKNOWN_DEPOT", (*path, "depot"),
                           f"No depot has the id {vehicle_type.depot!r}: use the id of one in "
                           "depots, or add it there.")
        for index, name in enumerate(vehicle_type.reload_depots):
            if name not in known:
                yield error_at("UNKNOWN_DEPOT", (*path, "reload_depots", index),
                               f"No depot has the id {name!r}: use the id of one in depots, or "
                               "add it there.")


def drone_errors(draft: Draft) -> Errors:
    """Say which types of drones can't be told from others of their truck."""
    for path, vehicle_type in draft.vehicle_types():
        seen: dict[str, int] = {}
        if not isinstance(vehicle_type.drones, list):
            continue
        for index, drones in enumerate(vehicle_type.drones):
            here = (*path, "drones", index, "id")
            if drones.id is None:
                yield error_at("MISSING_DRONE_ID", here,
                               "Each type of drones in a list needs an id: give it one.")
            elif seen.setdefault(drones.id, index) != index:
                yield error_at("DUPLICATE_ID", here,
                               f"drones[{seen[drones.id]}] has the same id: give each its own.")


def energy_errors(draft: Draft) -> Errors:
    """Say what is wrong with what flying takes."""
    for path, drones in draft.flyers():
        if drones.energy is None:
            continue
        here, energy = (*path, "energy"), drones.energy
        if (energy.power is None) == (energy.preset is None):
            yield error_at("POWER_OR_PRESET", here,
                           "What flying takes is stated by power or by preset: state exactly one.")
        elif energy.weight_dimension >= len(drones.capacity):
            yield error_at("DIMENSION_MISMATCH", (*here, "weight_dimension"),
                           f"There are {len(drones.capacity)} dimensions, numbered from 0: use a "
                           "smaller number.")
        elif not _is_countable(draft, drones, energy):
            yield error_at("OUT_OF_RANGE", here,
                           "With the most that the drone lifts, flying takes more power than can "
                           "be counted: check kg_per_unit, capacity and the powers per kg.")


def turnaround_errors(draft: Draft) -> Errors:
    """Say what is wrong with how drones get ready again."""
    for path, drones in draft.flyers():
        turnaround = drones.turnaround
        if turnaround is None or not turnaround.charge_w:
            continue
        here = (*path, "turnaround", "charge_w")
        if drones.energy is None:
            yield error_at("CHARGE_WITHOUT_ENERGY", here,
                           "Nothing says what flights take of the battery that is charged: state "
                           "energy, or leave charge_w out.")
        if turnaround.swap_duration or turnaround.batteries is not None:
            yield error_at("SWAP_OR_CHARGE", here,
                           "Batteries are either swapped or charged aboard: leave out charge_w, or "
                           "swap_duration and batteries.")


def _is_countable(draft: Draft, drones: Flyer, energy: EnergyInput) -> bool:
    """Tell whether powers can be counted, or can't be looked at for other errors."""
    customers = [customer for _, customer in draft.known_customers()]
    fleet = [vehicle_type for _, vehicle_type in draft.vehicle_types()]
    asked = [amount for customer in customers for amount in (customer.demand, customer.pickup)
             if amount is not None]
    stated = [*asked, *(kind.capacity for kind in fleet),
              *(drones.capacity for _, drones in draft.drone_types())]
    if len(set(map(len, stated))) > 1:
        return True
    decimals = decimals_of(customers, fleet)
    return is_countable(drones, energy, decimals, [counted(each, decimals) for each in asked])


TRUCKS = ("breaks", "driving_rules", "drones", "speed_profile", "max_travel_duration",
          "start_location", "start_location_index", "max_sorties", "max_airborne",
          "truck_waits", "revisits", "avoid")
"""Fields of a vehicle type that nothing has which flies by itself."""

FLYING = ("altitude", "endurance", "max_range", "max_wind_kmh", "preset", "launch_duration",
          "recovery_duration", "energy", "turnaround")
"""Fields that nothing else has."""


def flight_errors(draft: Draft) -> Errors:
    """Say what is stated of vehicles that fly, and can't be, or of others."""
    for path, kind in draft.vehicle_types():
        if not kind.flies:
            for name in _stated(kind, FLYING):
                yield error_at("ONLY_WHERE_IT_FLIES", (*path, name),
                               f"The vehicles don't fly: state flies, or leave {name} out.")
            continue
        for name in _stated(kind, TRUCKS):
            yield error_at("NOT_WHERE_IT_FLIES", (*path, name),
                           f"The vehicles are drones themselves: leave {name} out, or flies.")
        if kind.end != "depot":
            yield error_at("NOT_WHERE_IT_FLIES", (*path, "end"),
                           "Who flies by itself lands at a depot: leave end out.")
        if kind.turnaround is not None and kind.turnaround.batteries is not None:
            yield error_at("NOT_WHERE_IT_FLIES", (*path, "turnaround", "batteries"),
                           "Batteries of vehicles that fly are their depot's: state them there.")
        if kind.turnaround is not None and _too_long(kind, kind.turnaround):
            yield error_at("OUT_OF_RANGE", (*path, "turnaround", "swap_duration"),
                           "Beside reload_duration, that is more than can be counted: lower it.")
        yield from _closed_depots(draft, path, kind)


def _too_long(kind: VehicleTypeInput, turnaround: TurnaroundInput) -> bool:
    """Tell whether swaps and reloads together take longer than can be counted."""
    between = thousandths(kind.reload_duration) + thousandths(turnaround.swap_duration)
    return between > MAX_QUANTITY


def _stated(kind: VehicleTypeInput, names: Sequence[str]) -> list[str]:
    """Return the fields whose values aren't the usual ones."""
    fields = VehicleTypeInput.model_fields
    return [name for name in names if getattr(kind, name) != fields[name].default]


def _closed_depots(draft: Draft, path: Path, kind: VehicleTypeInput) -> Errors:
    """Say at which of its depots nothing takes off or lands."""
    depots = [depot for depot in draft.depots or () if depot is not None]
    closed = {depot.id for depot in depots if not depot.launch}
    if kind.depot in closed or (kind.depot is None and depots and depots[0].id in closed):
        yield error_at("NOT_WHERE_IT_FLIES", (*path, "depot"),
                       "Nothing takes off there, by launch of the depot: name another, or leave "
                       "launch out.")
    for index, name in enumerate(kind.reload_depots):
        if name in closed:
            yield error_at("NOT_WHERE_IT_FLIES", (*path, "reload_depots", index),
                           "Nothing takes off there, by launch of the depot: leave it out.")


def speed_errors(draft: Draft) -> Errors:
    """Say what is wrong with speeds by time of day."""
    for path, vehicle_type in draft.vehicle_types():
        previous = -1
        for index, change in enumerate(vehicle_type.speed_profile):
            here = (*path, "speed_profile", index)
            start = thousandths(change.from_time)
            if start <= previous:
                yield error_at("SPEED_PROFILE_ORDER", (*here, "from"),
                               "The entry begins no later than the one before it: sort the entries "
                               "by from, each time once.")
            previous = start
            yield from _speed_change_errors(draft, here, vehicle_type, change)


def _speed_change_errors(draft: Draft, path: Path, vehicle_type: VehicleTypeInput,
                         change: SpeedChangeInput) -> Errors:
    if (change.speed_kmh is None) == (change.factor is None):
        yield error_at("MISSING_SPEED" if change.factor is None else "TWO_SPEEDS", path,
                       "An entry has either speed_kmh or factor: state exactly one.")
    elif (change.speed_kmh is not None and vehicle_type.speed_kmh is None
          and vehicle_type.profile in (draft.matrices or {})):
        yield error_at("MISSING_SPEED", (*path, "speed_kmh"),
                       "The legs come from a matrix, whose speed is not known: use factor, or "
                       "state speed_kmh of the vehicle type.")
