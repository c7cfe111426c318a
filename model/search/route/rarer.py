"""What the search looks at only where a rarer rule may be stated."""

from model.kernel.compiled import pasted
from model.kernel.load import num_tiers, some_apart, some_limited
from model.kernel.plain import is_plain
from model.search.route.layout import MODE_LOADED, Fleet, World


@pasted
def tiers_of(world: World) -> int:
    """Return how many tiers loads have to be looked at in at each stop; 0 if that isn't needed."""
    return 0 if is_plain(world.type[0]) else num_tiers(world.amount)


@pasted
def tiers_aboard(fleet: Fleet) -> int:
    """As `tiers_of`, by the routes."""
    return 0 if is_plain(fleet.route[0]) else fleet.halt.shape[1]


@pasted
def goods_count(world: World) -> bool:
    """Tell whether some goods must not go with others."""
    return not is_plain(world.type[0]) and some_apart(world.goods)


@pasted
def time_aboard_counts(world: World) -> bool:
    """Tell whether some parcels may be aboard for so long and no longer."""
    return not is_plain(world.type[0]) and some_limited(world.fresh_for)


@pasted
def loads_cost(world: World, k: int) -> bool:
    """Tell whether what a vehicle of type `k` has aboard costs by the way that it is driven."""
    return not is_plain(world.type[0]) and world.mode[k] & MODE_LOADED > 0


@pasted
def is_dearer_to_some(world: World) -> bool:
    """Tell whether leaving out some costs more than leaving out others."""
    return not is_plain(world.type[0]) and world.unequal
