"""Regions of a plan, and what comes back of them."""

from dataclasses import dataclass, replace

from model.solution import Solution, Vehicle



@dataclass(frozen=True)
class Region:
    """Some vehicles' routes with all their customers, in the numbers of the whole problem."""

    plan: Solution  # `unassigned`: those of the whole plan's that this region may serve
    spare: tuple[Vehicle, ...] = ()  # without a route, for this region to use

    @property
    def vehicles(self) -> tuple[Vehicle, ...]:
        """All vehicles that it may use."""
        return (*[route.driven_by for route in self.plan.routes], *self.spare)


def put_back(whole: Solution, region: Region, found: Solution) -> Solution | None:
    """Return a plan with what was found for a region of an earlier one; None if that is stale.

    It is once any of the region's routes has changed, one of its spare vehicles that is needed has
    a route or somebody is served by now whom the region left out. Nothing is judged.
    """
    routes = {route.driven_by: route for route in whole.routes}
    own = {route.driven_by for route in region.plan.routes}
    used = {route.driven_by for route in found.routes}
    left_out = set(whole.unassigned)
    if any(routes.get(route.driven_by) != route for route in region.plan.routes):
        return None
    if not left_out.issuperset(region.plan.unassigned):
        return None
    if not used <= own | (set(region.spare) - set(routes)):
        return None
    kept = [route for vehicle, route in routes.items() if vehicle not in own]
    left_out = left_out.difference(region.plan.unassigned).union(found.unassigned)
    return in_order(Solution((*kept, *found.routes), tuple(left_out)))


def in_order(plan: Solution) -> Solution:
    """Return the same plan by vehicles, so that sums over it are the same in every process."""
    return replace(plan, routes=tuple(sorted(plan.routes, key=lambda route: route.driven_by)),
                   unassigned=tuple(sorted(plan.unassigned)))
