"""Where the trips of a route begin and end, if not all do so at one place."""

from model.kernel.compiled import inlined
from model.kernel.leg import leg, legs_of
from model.kernel.plain import is_plain
from model.kernel.records import Record, Records
from model.search.route.layout import END, MODE_APART, World


@inlined
def is_apart(world: World, k: int) -> bool:
    """Tell whether trips of a type don't all begin and end at one place."""
    return not is_plain(world.type[k]) and world.mode[k] & MODE_APART > 0


@inlined
def place_ends(world: World, k: int, route: Record, stops: Records) -> None:
    """Let each trip begin and end where it may. In place.

    Where one ends and the next begins stays as it is, if it may be there.
    """
    kind = world.type[k]
    stops[0].node = kind.begins_at
    for p in range(1, route.length - 1):
        if stops[p].kind == END:
            if not world.reload[k, stops[p].node]:
                stops[p].node = kind.depot
            stops[p + 1].node = stops[p].node
    stops[route.length - 1].node = kind.ends_at


@inlined
def nearest_reload(world: World, k: int, before: int, behind: int) -> tuple[int, int]:
    """Return how far it is from a node to another by a place to reload at, and which."""
    legs = legs_of(world.leg, world.type[k].travel)
    place = world.type[k].depot
    best = leg(legs, before, place).distance + leg(legs, place, behind).distance
    for node in range(world.num_depots):
        if world.reload[k, node]:
            distance = leg(legs, before, node).distance + leg(legs, node, behind).distance
            if distance < best:
                best, place = distance, node
    return best, place


@inlined
def detour_by_reload(world: World, k: int, before: int, node: int, behind: int,
                     first: bool) -> int:
    """Return how much further it is by a customer and a place to reload at.

    `first` tells that the customer comes first.
    """
    legs = legs_of(world.leg, world.type[k].travel)
    direct = leg(legs, before, behind).distance
    if first:
        by, _ = nearest_reload(world, k, node, behind)
        return leg(legs, before, node).distance + by - direct
    by, _ = nearest_reload(world, k, before, node)
    return by + leg(legs, node, behind).distance - direct
